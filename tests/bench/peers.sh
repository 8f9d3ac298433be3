#!/usr/bin/env bash
# Sunder compared with other libraries in one run, as Markdown: Minkowski sums and least separations (CGAL exactly; GEOS
# and Clipper in doubles and integers), and a million buildings compared with a copy by ogr2ogr. RESULTS.md summarises
# the record in results/, which is made by
#
#   peers.sh | python3 tests/bench/record.py tests/bench/results sums instructions pairs towns
#
#   peers.sh [--instructions] [ROW ...]     all rows unless some are named: FAMILY_N, sums, pairs, million
#
# Installs what is missing and builds (not if SUNDER_BUILD names a build). Sums and pairs are CPU seconds of one thread,
# medians of several runs. Sunder is measured before and after the others and the slower of the two counts. A method of
# another library is stopped when it cannot be the best any more: it may take as long as three runs at the speed of the
# best so far, and three seconds. One that was stopped, or took ten times the best, is not tried on the next size of the
# same family. Rows under a millisecond that the others do in three seconds are also counted in instructions, by
# callgrind; with --instructions rows of all lengths.
#
# Operands are in memory before the clock starts, results in memory when it stops. CGAL computes its own decompositions,
# and they are part of its time; GEOS and Clipper are given the convex subsums and only unite them, see subsums.h.
#
#   SUNDER_BUILD             build directory; unset: build/release, after installing and building
#   SUNDER_BENCH_INPUT       folder of the inputs (../shared/families beside the repository); those that are missing are made
#                            by sunder-families
#   SUNDER_BENCH_METHODS     CGAL's methods (rc ssab hm first; vert tri full greene if the best of these takes under a second)
#   SUNDER_BENCH_SECONDS     seconds to spend on repetitions of one figure (1)
#   SUNDER_BENCH_LIMIT       CPU seconds that the first library of a row may take (200)
#   SUNDER_BENCH_MEMORY      KiB of address space that another library may take (half of what is free)
#   SUNDER_BENCH_PAIRS       pairs for the comparison with CGAL (2000)
#   SUNDER_BENCH_BUILDINGS   sizes of the towns (10000 100000 1000000)
#   SUNDER_BENCH_TOWN        folder for the towns (build/bench; 700 MB for a million)
# shellcheck disable=SC2016 # Markdown's quotes
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
if [[ -z ${SUNDER_BUILD:-} ]]; then
  # shellcheck source=gis/setup.sh
  . "$source_dir/gis/setup.sh"
  SUNDER_BUILD=$source_dir/build/release
  {
    setup_toolchain
    setup_want "a C++ compiler" g++ g++ --version
    setup_want "CGAL" "libcgal-dev libgmp-dev libmpfr-dev" setup_has_header CGAL/version.h
    setup_want "GEOS" libgeos-dev setup_has_header geos_c.h
    setup_want "Clipper" libpolyclipping-dev test -e /usr/include/polyclipping/clipper.hpp
    setup_want "valgrind" valgrind valgrind --version
    setup_want "time" time /usr/bin/time true
    setup_install
    setup_build "$source_dir" "$SUNDER_BUILD" sunder sunder-families sunder-town bench_programs
  } >&2
fi
build=$SUNDER_BUILD
input=${SUNDER_BENCH_INPUT:-$source_dir/../shared/families}
limit=${SUNDER_BENCH_LIMIT:-200}
pairs=${SUNDER_BENCH_PAIRS:-2000}
memory=${SUNDER_BENCH_MEMORY:-$(awk '/MemAvailable/ { print int($2 / 2) }' /proc/meminfo)}
sums=(comb_50 comb_100 comb_200 comb_1000 comb_2000 fork_50 fork_100 fork_200 forkt_50 forkt_100 star_50 star_100 star_200 star_500
      random_50 random_100 random_200 random_500 robot_50 robot_500 robot_2000 cfork_50 cfork_100 cfork_200 fatgrid_50 fatgrid_200
      fatgrid_1000 bldg32_10000 bldg32_100000 coast32_10000 coast32_100000)
all_instructions=no rows=()
for word in "$@"; do
  case $word in
    --instructions) all_instructions=yes ;;
    -*) sed -n '2,/^set/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 2 ;;
    sums) rows+=("${sums[@]}") ;;
    *) rows+=("$word") ;;
  esac
done
if [[ ${#rows[@]} -eq 0 ]]; then rows=("${sums[@]}" pairs million); fi
for program in bench_sum bench_pair sunder sunder-families; do
  [[ -x $build/$program ]] || { echo "peers.sh: no $build/$program; build the target bench_programs, or leave SUNDER_BUILD unset" >&2; exit 1; }
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cached() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt" 2>/dev/null | head -n 1; }
less() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a + 0 < b + 0) }'; }
larger() { awk -v a="$1" -v b="$2" 'BEGIN { print (a + 0 > b + 0 ? a : b) }'; }
ratio() { awk -v a="$1" -v b="$2" 'BEGIN { if (a > 0 && b > 0) printf "%.3g", a / b; else print "-" }'; }
brief() { awk -v a="$1" 'BEGIN { printf(a >= 1000 ? "%.0f" : "%.3g", a) }'; }
named() { [[ " ${rows[*]} " == *" $1 "* ]]; }
version() { dpkg-query -W -f '${Version}' "$1" 2>/dev/null || echo "not installed"; }

header() {
  local cc cxx
  cc=$(cached CMAKE_C_COMPILER)
  cxx=$(cached CMAKE_CXX_COMPILER)
  cat <<END
# Beside the peers

What \`tests/bench/peers.sh\` printed; its beginning says how it measures.

- machine: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(nproc) cores, $(uname -sr), load $(cut -d' ' -f1-3 /proc/loadavg) at the start
- date: $(date -u +%Y-%m-%d)
- commit: $(git -C "$source_dir" describe --always --dirty 2>/dev/null || echo unknown)
- Sunder's compiler: $("${cc:-cc}" --version | head -n 1), $(cached CMAKE_BUILD_TYPE) $(cached CMAKE_C_FLAGS_RELEASE) $(cached CMAKE_C_FLAGS)
- the peers': $([[ -x $cxx ]] && "$cxx" --version | head -n 1 || echo none), -O3 -DNDEBUG; GEOS and Clipper as Debian builds them
- CGAL $(version libcgal-dev) (EPECK), GEOS $(version libgeos-dev), Clipper $(version libpolyclipping-dev) (Clipper2 is not in Debian 12), GMP $(version libgmp-dev), GDAL $(version libgdal-dev), glibc $(version libc6)
- inputs: $([[ -d $input ]] && echo "../shared/families, and what is missing there by sunder-families, seed 1" || echo "sunder-families, seed 1")
- repetitions: for ${SUNDER_BENCH_SECONDS:-1} s a figure, three at least where they take less than ten times that
END
}

# ---- Inputs ----

draw() { # NAME OUT
  local family=${1%_*} size=${1##*_} options=()
  case $family in
    forkt) family=slanted-fork ;;
    cfork) family=covered-fork ;;
    fatgrid) family=fat-grid ;;
    fatcover) family=fat-cover ;;
    bldg32) family=buildings options=(--size-q 32) ;;
    coast32) family=coast options=(--size-q 32) ;;
    robot) options=(--size-q "$size") size=30 ;;
  esac
  "$build/sunder-families" "$family" --size "$size" "${options[@]}" >"$2"
}

find_input() { # NAME; sets file
  file=$input/$1.txt
  if [[ -r $file ]]; then return; fi
  file=$scratch/$1.txt
  draw "$1" "$file" 2>/dev/null
}

find_pairs() { # NAME; sets file
  file=$scratch/$1.txt
  if [[ -r $input/$1.txt.gz ]]; then
    gzip -dc "$input/$1.txt.gz" >"$file"
  elif [[ $1 == pairs_buildings ]]; then
    "$build/sunder-families" overlap --count 20000 >"$file"
  else
    "$build/sunder-families" tight --size 8 --count 5000 >"$file"
  fi
}

# ---- Sums ----

methods_of() { # FAMILY: CGAL's methods, the likely best first
  if [[ -n ${SUNDER_BENCH_METHODS:-} ]]; then echo "$SUNDER_BENCH_METHODS"; return; fi
  case $1 in
    comb | robot | bldg32 | coast32) echo rc ssab hm ;;
    fork | forkt | fatgrid | fatcover) echo ssab hm rc ;;
    *) echo hm rc ssab ;;
  esac
}

declare -A hopeless=() # family, program, method

# Tries PROGRAM METHOD on the file; sets best, best_method and best_program if it is better than those.
try() {
  local most=$limit line status=0 kind="${name%_*} $1 $2"
  if [[ ! -x $build/$1 || -n ${hopeless[$kind]:-} ]]; then return 0; fi
  if [[ -n $best ]]; then most=$(awk -v b="$best" 'BEGIN { printf "%d", 3.999 + 3 * b }'); fi
  line=$(ulimit -t "$most" -v "$memory"; SUNDER_BENCH_BEST=${best:-0} exec "$build/$1" "$2" "$file" 2>"$scratch/err") || status=$?
  echo "$name $1 $2 $([[ $status -eq 0 ]] && echo "$line" || echo "status $status within $most s")" >&2
  if [[ $status -ne 0 ]] || { [[ -n $best ]] && less "$(awk -v b="$best" 'BEGIN { print 10 * b }')" "${line##* }"; }; then
    hopeless[$kind]=1
  fi
  if [[ $status -eq 0 ]] && { [[ -z $best ]] || less "${line##* }" "$best"; }; then
    best=${line##* } best_method=$2 best_program=$1
  fi
}

best_exact() {
  local method
  best='' best_method=- best_program=''
  for method in $(methods_of "${name%_*}"); do try cgal_sum "$method"; done
  if [[ -z ${SUNDER_BENCH_METHODS:-} && -n $best ]] && less "$best" 1; then
    for method in vert tri full greene; do try cgal_sum "$method"; done
  fi
}

best_inexact() {
  best='' best_method=- best_program=''
  if [[ ${name%_*} == *32 ]]; then
    try geos_sum buffer
    try clipper_sum offset
  fi
  try geos_sum union
  try clipper_sum union
}

sum_row() {
  local first second seconds exact exact_by inexact inexact_by
  local -a fields
  find_input "$name" || { echo "peers.sh: $name: no such input" >&2; return 0; }
  first=$("$build/bench_sum" "$file") || { echo "peers.sh: $name: failed" >&2; return 0; }
  read -r -a fields <<<"${first#"$file" }"
  best_exact
  exact=$best exact_by=$best_method
  best_inexact
  inexact=$best inexact_by=$(peer "${best_program:--}" "$best_method")
  second=$("$build/bench_sum" "$file")
  seconds=$(larger "${first##* }" "${second##* }")
  echo "| $name | ${fields[0]} + ${fields[1]} | ${fields[2]} | ${fields[3]} | $(brief "$seconds") |" \
    "$(brief "${exact:-0}") | $exact_by | $(ratio "${exact:-0}" "$seconds") |" \
    "$(brief "${inexact:-0}") | $inexact_by | $(ratio "${inexact:-0}" "$seconds") |"
  if { less "$seconds" 0.001 || [[ $all_instructions == yes ]]; } && less "${exact:-0}" 3 && less "${inexact:-0}" 3; then
    echo "$name $file $([[ -n $exact ]] && echo cgal_sum || echo -) $exact_by ${best_program:--} $best_method" >>"$scratch/to_count"
  fi
}

count() { # PROGRAM ARGUMENTS...: instructions of one sum, from operands to result
  SUNDER_BENCH_RUNS=1 valgrind --tool=callgrind --toggle-collect='*bench_once*' --callgrind-out-file=/dev/null "$build/$1" "${@:2}" 2>&1 >/dev/null |
    sed -n 's/.*Collected : //p'
}

count_rows() {
  local name file exact method inexact by ours a b
  [[ -s $scratch/to_count ]] && command -v valgrind >/dev/null || return 0
  printf '\n## In instructions\n\nOne sum each by callgrind, millions: the best peers of the table above.\n\n'
  echo "| input | Sunder | CGAL | method | to CGAL | best inexact | peer | to that peer |"
  echo "|---|---|---|---|---|---|---|---|"
  while read -r name file exact method inexact by; do
    ours=$(count bench_sum "$file")
    a=$([[ $exact == - ]] || count "$exact" "$method" "$file")
    b=$([[ $inexact == - ]] || count "$inexact" "$by" "$file")
    echo "| $name | $(million "$ours") | $(million "${a:-0}") | ${a:+$method} | $(ratio "${a:-0}" "$ours") | $(million "${b:-0}") | $(peer "$inexact" "$by") | $(ratio "${b:-0}" "$ours") |"
  done <"$scratch/to_count"
}

peer() { # PROGRAM METHOD: their names in words
  case $1 in
    geos_sum) echo "GEOS $2" ;;
    clipper_sum) echo "Clipper $2" ;;
    *) echo - ;;
  esac
}

million() { awk -v a="$1" 'BEGIN { printf "%.3f", a / 1e6 }'; }

# ---- Least separations ----

# The second lines of pairs_fit in ../shared contain the moving polygon turned by half a turn: reflected, the pieces
# overlap their plates, and for many of them the nearest free places are exact fits. The same is true of `tight`.
pair_rows() {
  local row name turn line ours theirs again
  printf '\n## Least separating translations\n\nMicroseconds a pair; %s pairs, and Sunder alone on every pair of the file. CGAL loses exact fits: its lengths are larger where\nthey are the nearest places.\n\n' "$pairs"
  echo "| input | Sunder us, all | Sunder us | CGAL us | ratio | sum of lengths by Sunder | by CGAL | pairs CGAL could not do |"
  echo "|---|---|---|---|---|---|---|---|"
  for row in 'pairs_buildings as-is' 'pairs_fit reflect'; do
    read -r name turn <<<"$row"
    find_pairs "$name"
    line=$("$build/bench_pair" "$file" 0 "$turn")
    read -r -a ours <<<"$("$build/bench_pair" "$file" "$pairs" "$turn")"
    theirs=(0 0 - -)
    if [[ -x $build/cgal_pair ]]; then
      read -r -a theirs <<<"$( (ulimit -t 600; exec "$build/cgal_pair" "$file" "$pairs" "$turn" 2>/dev/null) || echo 0 0 - -)"
    fi
    read -r -a again <<<"$("$build/bench_pair" "$file" "$pairs" "$turn")"
    ours[1]=$(larger "${ours[1]}" "${again[1]}")
    echo "| $name | $(cut -d' ' -f2 <<<"$line") | ${ours[1]} | ${theirs[1]} | $(ratio "${theirs[1]}" "${ours[1]}") | ${ours[2]} | ${theirs[2]} | ${theirs[3]} |"
  done
}

# ---- Towns ----

# LABEL COMMAND...: appends CPU seconds, wall-clock seconds and MB; status 3 (conflicts are left or found) is a success
timed() {
  local label=$1 status=0
  shift
  /usr/bin/time -q -f '%U %S %e %M' -o "$scratch/time" "$@" >/dev/null 2>"$scratch/err" || status=$?
  if [[ $status -ne 0 && $status -ne 3 ]]; then
    echo "peers.sh: $label: status $status: $(tail -n 1 "$scratch/err")" >&2
    return
  fi
  awk '{ print $1 + $2, $3, $4 / 1000 }' "$scratch/time" >>"$scratch/$label"
}

middle() { # LABEL FIELD: the median
  [[ -s $scratch/$1 ]] || { echo 0; return; }
  cut -d' ' -f"$2" "$scratch/$1" | sort -g | sed -n "$((($(wc -l <"$scratch/$1") + 1) / 2))p"
}

town_row() { # SIZE LABEL WHAT
  echo "| $1 | $3 | $(brief "$(middle "$2" 1)") | $(ratio "$(middle "$2" 1)" "$(middle copy 1)") |" \
    "$(brief "$(middle "$2" 2)") | $(ratio "$(middle "$2" 2)" "$(middle copy 2)") | $(brief "$(middle "$2" 3)") |"
}

town_rows() {
  local size folder=${SUNDER_BENCH_TOWN:-$build/bench}
  printf '\n## Towns beside a copy\n\n`sunder-town --seed 7`, GeoPackage to GeoPackage: `ogr2ogr` copies the buildings and their index. User and system CPU seconds, seconds\n'
  printf 'on the wall on %s cores, and peak memory; medians of three alternating runs (the default effort: of one).\n\n' "$(nproc)"
  echo "| buildings | program | CPU s | CPU by copy | wall s | wall by copy | MB |"
  echo "|---|---|---|---|---|---|---|"
  mkdir -p "$folder"
  for size in ${SUNDER_BENCH_BUILDINGS:-10000 100000 1000000}; do
    [[ -s $folder/town_$size.gpkg ]] || "$build/sunder-town" --buildings "$size" --seed 7 "$folder/town_$size.gpkg" >&2
    rm -f "$scratch"/{copy,separate,alone,check,effort}
    for _ in 1 2 3; do
      rm -f "$folder/copy.gpkg" "$folder/apart.gpkg"
      timed copy ogr2ogr -q -f GPKG "$folder/copy.gpkg" "$folder/town_$size.gpkg" buildings
      timed separate "$build/sunder" separate --quiet --gap 3 --effort 0 --input-layer buildings "$folder/town_$size.gpkg" "$folder/apart.gpkg"
      rm -f "$folder/apart.gpkg"
      timed alone "$build/sunder" separate --quiet --gap 3 --effort 0 --threads 1 --input-layer buildings "$folder/town_$size.gpkg" "$folder/apart.gpkg"
      timed check "$build/sunder" check --quiet --gap 3 --input-layer buildings "$folder/town_$size.gpkg"
    done
    rm -f "$folder/apart.gpkg"
    timed effort "$build/sunder" separate --quiet --gap 3 --input-layer buildings "$folder/town_$size.gpkg" "$folder/apart.gpkg"
    town_row "$size" copy '`ogr2ogr`'
    town_row "$size" separate '`separate --gap 3 --effort 0`'
    town_row "$size" alone '`separate --gap 3 --effort 0 --threads 1`'
    town_row "$size" effort '`separate --gap 3`'
    town_row "$size" check '`check --gap 3`'
    rm -f "$folder/copy.gpkg" "$folder/apart.gpkg"
  done
}

header
first=yes
for name in "${rows[@]}"; do
  case $name in
    pairs | million) continue ;;
  esac
  if [[ $first == yes ]]; then
    printf '\n## Minkowski sums\n\nCPU seconds; n: vertices of P and Q; out: vertices of the sum.\n\n'
    echo "| input | n | out | holes | Sunder s | CGAL s | method | to CGAL | best inexact s | peer | to that peer |"
    echo "|---|---|---|---|---|---|---|---|---|---|---|"
    first=no
  fi
  sum_row
done
count_rows
if named pairs; then pair_rows; fi
if named million; then town_rows; fi
printf '\nLoad at the end: %s.\n' "$(cut -d' ' -f1-3 /proc/loadavg)"
