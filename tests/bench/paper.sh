#!/usr/bin/env bash
# The experiments on planar Minkowski sums, in one command: every algorithm for a sum, every convex decomposition and
# both orders of insertion, on the families of datasets-synthetic.
#
#   paper.sh [FAMILY ...]     all families unless some are named
#   paper.sh pictures         only figures 1 to 4 and 7
#
# Installs what is missing and builds (not if SUNDER_BUILD names a build), runs, and writes to the output folder
#
#   paper.csv                 a line a run: sizes, seconds by phase, counts by phase, memory, hash of the exact result
#   pieces.csv                for each convex decomposition of each input: pieces, subsums and their sides, seconds
#   orders.csv                the incremental union in random order, in the given order and by three measures of fatness
#   run.txt                   machine, compiler, commit, seed, limits
#   tables.md                 exponents in n fitted over the sizes; phases; orders; decompositions
#   roads.md                  the default as a ratio to the best other algorithm, for each family and size (roads.sh)
#   figure-5.svg ... -7.svg   bar charts; figure-1.svg ... -4.svg and figure-7-*.svg are pictures of inputs and sums
#
# A run that takes longer than the limit or more memory than allowed is recorded as such, and larger sizes of the same
# kind are not tried. PAPER.md describes the findings.
#
#   SUNDER_PAPER_OUT            output folder (build/paper)
#   SUNDER_PAPER_SIZES          sizes of both operands (10 20 50 100)
#   SUNDER_PAPER_LARGE          further sizes, for the convolution alone (200 500 1000)
#   SUNDER_PAPER_SEED           seed of the families and of random orders (1)
#   SUNDER_PAPER_SECONDS        limit of one run (60)
#   SUNDER_PAPER_MEMORY         limit of one run in KiB (4194304)
#   SUNDER_PAPER_DECOMPOSED     largest size on which all decompositions are compared (50)
#   SUNDER_PAPER_ALL            largest size on which every order is tried with every decomposition (10)
#   SUNDER_PAPER_COMPARED       largest size on which the exact results of all runs are compared (50)
#   SUNDER_PAPER_BASE           decomposition for the comparison of algorithms (angle-bisector)
#   SUNDER_PAPER_REPEAT         number of runs whose median counts, if they are short (3)
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
if [[ -z ${SUNDER_BUILD:-} ]]; then
  # shellcheck source=../../gis/setup.sh
  . "$source/gis/setup.sh"
  SUNDER_BUILD=$source/build/release
  setup_toolchain
  setup_need jq jq jq --version
  setup_need gnuplot gnuplot-nox gnuplot --version
  setup_need Python python3 python3 --version
  setup_install
  setup_build "$source" "$SUNDER_BUILD" sunder sunder-families bench_paper bench_sum
fi
sunder=$SUNDER_BUILD/sunder families=$SUNDER_BUILD/sunder-families pieces=$SUNDER_BUILD/bench_paper
for tool in "$sunder" "$families" jq gnuplot python3; do
  command -v "$tool" >/dev/null || { echo "paper.sh: no $tool" >&2; exit 1; }
done

out=${SUNDER_PAPER_OUT:-$source/build/paper}
sizes=${SUNDER_PAPER_SIZES:-10 20 50 100}
large=${SUNDER_PAPER_LARGE-200 500 1000}
seed=${SUNDER_PAPER_SEED:-1}
limit=${SUNDER_PAPER_SECONDS:-60}
memory=${SUNDER_PAPER_MEMORY:-4194304}
decomposed=${SUNDER_PAPER_DECOMPOSED:-50}
all=${SUNDER_PAPER_ALL:-10}
compared=${SUNDER_PAPER_COMPARED:-50}
base=${SUNDER_PAPER_BASE:-angle-bisector}
repeat=${SUNDER_PAPER_REPEAT:-3}
names=("$@")
if [[ $# -eq 0 ]]; then
  names=(convex comb comb-swapped fork slanted-fork covered-fork star random robot fat-grid fat-cover tight)
fi
mkdir -p "$out/inputs"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# The values of an option, from the program's own help; empty if there is no such option.
choices() { "$sunder" sum --help | sed -n "s/.*$1 \([a-z-]*|[a-z|-]*\).*/\1/p" | tr '|' ' '; }
algorithms=$(choices --algorithm) decompositions=$(choices --decomposition) orders=$(choices --order)

phases='decompose subsums union'
counts='comparisons orientation_tests segment_intersections exact_fallbacks'
columns="family,size,seed,algorithm,decomposition,used,order,p_vertices,q_vertices,status"
columns+=",polygons,holes,vertices,degenerate_segments,degenerate_points"
columns+=",seconds,seconds_decompose,seconds_subsums,seconds_union,peak_rss_bytes"
for count in $counts; do columns+=",$count"; done
for phase in $phases; do for count in $counts; do columns+=",${phase}_$count"; done; done
columns+=",result"
# The runs are stored as lines of JSON, [[family, size, ...], status, summary or null, result], and made into a table at
# the end.
# shellcheck disable=SC2016 # jq's variables
row='def counts: [.comparisons, .orientation_tests, .segment_intersections, .exact_fallbacks];
     .[0] as $kind | .[2] as $s | ($s.result // {}) as $r | ($s.seconds // {}) as $t |
     $kind + [$s.decomposition] + [.[3][0], $s.p.vertices, $s.q.vertices, .[1]] +
     [$r.polygons, $r.holes, $r.vertices, $r.degenerate_segments, $r.degenerate_points,
      $t.compute, $t.decompose, $t.subsums, $t.union, $s.peak_rss_bytes] +
     ($s.operations | counts) + ([$s.operations.phases | .decompose, .subsums, .union | counts] | add) + [.[3][1]] | @csv'

header() {
  local cc
  cc=$(sed -n 's/^CMAKE_C_COMPILER:[A-Z]*=//p' "$SUNDER_BUILD/CMakeCache.txt")
  echo "machine    $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(nproc) cores, $(uname -sr), load $(cut -d' ' -f1 /proc/loadavg)"
  echo "compiler   $("$cc" --version | head -n 1), $(sed -n 's/^CMAKE_BUILD_TYPE:[A-Z]*=//p' "$SUNDER_BUILD/CMakeCache.txt") $(sed -n 's/^CMAKE_C_FLAGS_RELEASE:[A-Z]*=//p' "$SUNDER_BUILD/CMakeCache.txt")"
  echo "commit     $(git -C "$source" describe --always --dirty 2>/dev/null || echo unknown)"
  echo "inputs     sunder-families, sizes $sizes (${large:-none} for the convolution alone), seed $seed"
  echo "limits     $limit s and $memory KiB a run; median of $repeat runs below a second"
  echo "roads      ${algorithms:-none but the default}; decompositions: ${decompositions:-none}; orders: ${orders:-none}"
}

# The two operands of a family as $p and $q.
draw() {
  local family=${1%-swapped} swap=()
  [[ $1 == *-swapped ]] && swap=(--swap)
  local stem=$out/inputs/${1}_$2
  "$families" "$family" --size "$2" --seed "$seed" "${swap[@]}" >"$stem.wkt"
  p=$stem.p.wkt q=$stem.q.wkt
  sed -n 1p "$stem.wkt" >"$p"
  sed -n 2p "$stem.wkt" >"$q"
}

limited() { (ulimit -v "$memory" && exec timeout "$limit" "$sunder" sum "$@" "@$p" "@$q" 2>"$scratch/err"); }

number() { # NAME FILE: the first number of that name in a summary
  local text
  text=$(<"$2")
  [[ $text =~ \"$1\":\ ([0-9.e+-]+) ]] && echo "${BASH_REMATCH[1]}"
}

# Runs once or, if the run is short, several times; the summary of the median in $scratch/stats. Sets status.
measure() {
  local i code=0 times=() seconds median
  for ((i = 0; i < repeat; i++)); do
    limited --stats - "$@" >"$scratch/stats.$i" || code=$?
    case $code in
      0) ;;
      124) status=timeout; return ;;
      *) status=failed
         if grep -qi memory "$scratch/err"; then status=memory; fi
         return ;;
    esac
    seconds=$(number compute "$scratch/stats.$i")
    times+=("$seconds $i")
    if awk -v s="$seconds" 'BEGIN { exit !(s > 1) }'; then break; fi
  done
  status=ok
  median=$(printf '%s\n' "${times[@]}" | sort -g | sed -n "$(((${#times[@]} + 1) / 2))s/.* //p")
  mv "$scratch/stats.$median" "$scratch/stats"
}

# Checksum of the exact result, for sizes at which results are compared.
result() {
  if ((size > compared)); then return; fi
  limited --exact "$@" >"$scratch/exact" && sed '1,/"seconds"/d' "$scratch/exact" | cksum | tr ' ' '-' || echo failed
}

# A run of one kind (algorithm decomposition order) on the current input, unless a smaller size of it was stopped or it has been run.
one() {
  local algorithm=$1 decomposition=$2 order=$3 options=(--algorithm "$1") kind="$name $*" summary=null hash=''
  if [[ -n ${seen["$kind $size"]:-} ]]; then return; fi
  seen["$kind $size"]=1
  [[ -n $decomposition ]] && options+=(--decomposition "$decomposition")
  [[ -n $order ]] && options+=(--order "$order" --seed "$seed")
  if [[ -n ${stopped[$kind]:-} ]]; then
    status=skipped
  else
    measure "${options[@]}"
  fi
  if [[ $status == ok ]]; then
    summary=$(tr -d '\n' <"$scratch/stats")
    hash=$(result "${options[@]}")
    echo "$name $size $* $(number compute "$scratch/stats") s"
  else
    [[ $status == skipped ]] || stopped[$kind]=$status
    echo "$name $size $* $status"
  fi
  echo "[[\"$name\",$size,$seed,\"$algorithm\",\"$decomposition\"],\"$status\",$summary,[\"$order\",\"$hash\"]]" >>"$scratch/runs"
}

# Measurements that need the library's internals, if that program was built: pieces at every size, measures of fatness
# up to the time limit.
count_inside() { # pieces|orders
  if [[ -x $pieces ]]; then
    SUNDER_BENCH_SECONDS=0.1 timeout "$((2 * limit))" "$pieces" "$out/inputs/${name}_$size.wkt" "$1" | sed "s/^/$name,$size,/" >>"$out/$1.csv" ||
      echo "$name $size: the $1 could not be counted"
  fi
}

experiments() {
  local algorithm decomposition order
  for name in "${names[@]}"; do
    for size in $sizes; do
      draw "$name" "$size"
      count_inside pieces
      count_inside orders
      one convolution '' ''
      for algorithm in $algorithms; do
        case $algorithm in auto | convolution) continue ;; esac
        for order in random fat; do one "$algorithm" "$base" "$order"; done
        for decomposition in $decompositions; do
          if ((size <= decomposed)); then one "$algorithm" "$decomposition" random; fi
          if ((size <= all)); then for order in $orders; do one "$algorithm" "$decomposition" "$order"; done; fi
        done
      done
    done
    for size in $large; do
      draw "$name" "$size"
      one convolution '' ''
    done
  done
  jq -r "$row" "$scratch/runs" | tr -d '"' >>"$out/paper.csv"
}

# picture NAME TITLE FAMILY OPTIONS... [-- OPTIONS OF sum]: a picture of P, Q and P + Q from what the program prints.
picture() {
  local file=$1 title=$2
  shift 2
  local family=() p=$scratch/p q=$scratch/q
  while [[ $# -gt 0 && $1 != -- ]]; do family+=("$1"); shift; done
  [[ $# -gt 0 ]] && shift
  "$families" "${family[@]}" >"$scratch/pair"
  sed -n 1p "$scratch/pair" >"$p"
  sed -n 2p "$scratch/pair" >"$q"
  "$sunder" sum "$@" "@$p" "@$q" >"$scratch/sum.json"
  local map=()
  if [[ $picture_map == yes ]] && command -v ogr2ogr >/dev/null; then
    "$sunder" sum --quiet --planar-map --algorithm arrangement --decomposition "$base" "$@" "@$p" "@$q" "$scratch/map.gpkg" --overwrite >/dev/null &&
      rm -f "$scratch/faces.json" && ogr2ogr -f GeoJSON "$scratch/faces.json" "$scratch/map.gpkg" sum_faces && map=("$scratch/faces.json")
  fi
  python3 "$source/tests/bench/paper_picture.py" "$title" "$p" "$q" "$scratch/sum.json" "${map[@]}" >"$out/$file.svg"
}

pictures() {
  picture_map=no
  picture figure-1 "A robot among obstacles: P the obstacles, Q the robot, P + -Q where its reference point may not be" \
    robot --size 12 --size-q 48 --swap --seed 4 -- --reflect
  picture figure-2 "One operand convex: order mn" comb --size 16 --size-q 12
  picture figure-3 "A tight passage: the inner room is reached along a degenerate segment only" tight --size 10 --size-q 8 --seed 5 -- --reflect
  picture figure-4 "Two forks: order m²n²" fork --size 40
  picture figure-7-fat-grid "Fat grid" fat-grid --size 28
  if "$sunder" sum --help | grep -q -- --planar-map; then picture_map=yes; fi
  picture figure-7-covered-fork "Covered fork: the arrangement beneath, darker where more subsums lie" covered-fork --size 24
  picture figure-7-fat-cover "Fat cover: bars, one over the other, on blocks" fat-cover --size 48
}

# If exact results for one input differ, it is our error.
agreement() {
  awk -F, 'NR > 1 && $NF != "" { k = $1 " " $2; n[k]++; if ((k in h) && h[k] != $NF) bad[k] = 1; h[k] = $NF }
           END { for (k in n) { inputs++; runs += n[k] }; for (k in bad) { print "results differ: " k; wrong = 1 }
                 print runs + 0 " runs on " inputs + 0 " inputs compared exactly" (wrong ? "" : ", all equal"); exit wrong }' "$out/paper.csv"
}

if [[ ${names[*]} == pictures ]]; then
  pictures
  exit
fi
declare -A seen=() stopped=()
header | tee "$out/run.txt"
echo "$columns" >"$out/paper.csv"
echo family,size,decomposition,used,pieces_p,pieces_q,subsums,sides,seconds_decompose,seconds_subsums >"$out/pieces.csv"
echo family,size,order,subsums,edges,comparisons,orientation_tests,segment_intersections,seconds >"$out/orders.csv"
pictures
experiments
python3 "$source/tests/bench/paper_charts.py" "$out"
if [[ -x $SUNDER_BUILD/bench_sum ]]; then
  SUNDER_ROADS_SIZES="$sizes $large" SUNDER_ROADS_DECOMPOSED=$decomposed SUNDER_ROADS_LIMIT=$limit \
    "$source/tests/bench/roads.sh" "${names[@]}" >"$out/roads.md"
fi
agreement | tee -a "$out/run.txt"
echo "$out"
