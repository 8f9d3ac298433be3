#!/usr/bin/env bash
# Benchmarks beside CGAL in the same run.
#
#   run.sh [sums|pairs] [FAMILY_N ...]     both unless said; all the families below unless some are named
#
# `cmake --build BUILD --target bench` builds what is needed and runs this. CPU seconds of one thread, medians; Sunder is
# measured before and after CGAL and the worse of the two counts. A method of CGAL that is stopped (the limit is five seconds
# and ten times the best so far) could not have been the best.
#
#   SUNDER_BUILD           build directory (./build)
#   SUNDER_BENCH_INPUT     folder of the inputs (../shared/families beside the repository)
#   SUNDER_BENCH_METHODS   CGAL's methods for sums (rc ssab hm vert tri full greene; `optimal` too is known)
#   SUNDER_BENCH_SECONDS   seconds to spend on repetitions of one figure (1)
#   SUNDER_BENCH_PAIRS     pairs for the comparison with CGAL (2000)
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=${SUNDER_BUILD:-$source_dir/build}
input=${SUNDER_BENCH_INPUT:-$source_dir/../shared/families}
methods=${SUNDER_BENCH_METHODS:-rc ssab hm vert tri full greene}
count=${SUNDER_BENCH_PAIRS:-2000}
what=all
if [[ ${1:-} == sums || ${1:-} == pairs ]]; then what=$1; shift; fi
files=("$@")
if [[ ${#files[@]} -eq 0 ]]; then
  files=(comb_50 comb_100 comb_200 comb_500 fork_50 fork_100 star_50 star_100 star_200 random_50 random_100 random_200
         randmap_200 robot_500 fatgrid_100 bldg32_1000 coast32_1000)
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cached() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt" 2>/dev/null | head -n 1; }
less() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a + 0 < b + 0) }'; }
larger() { awk -v a="$1" -v b="$2" 'BEGIN { print (a + 0 > b + 0 ? a : b) }'; }

header() {
  local cc
  cc=$(cached CMAKE_C_COMPILER)
  echo "machine   $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(nproc) cores, $(uname -sr), load $(cut -d' ' -f1 /proc/loadavg)"
  echo "compiler  $("${cc:-cc}" --version | head -n 1), $(cached CMAKE_BUILD_TYPE) $(cached CMAKE_C_FLAGS_RELEASE) $(cached CMAKE_C_FLAGS)"
  if [[ -x $build/cgal_sum ]]; then
    echo "peer      CGAL $(sed -n 's/^#define CGAL_VERSION //p' /usr/include/CGAL/version.h 2>/dev/null), EPECK, $("$(cached CMAKE_CXX_COMPILER)" --version | head -n 1), -O3 -DNDEBUG"
  else
    echo "peer      none: CGAL or a C++ compiler is not installed"
  fi
  echo "commit    $(git -C "$source_dir" describe --always --dirty 2>/dev/null || echo unknown)"
  echo "inputs    $input"
}

sunder_line() { "$build/bench_sum" "$1"; }

# Sets best and best_method, and prints one column for each method.
cgal_columns() {
  local file=$1 method line seconds status limit
  best='' best_method=-
  for method in $methods; do
    limit=20
    if [[ -n $best ]]; then limit=$(awk -v b="$best" 'BEGIN { printf "%.0f", 5 + 10 * b }'); fi
    status=0
    line=$(timeout "$limit" "$build/cgal_sum" "$method" "$file" 2>"$scratch/err") || status=$?
    case $status in
      0) seconds=${line##* }
         if [[ -z $best ]] || less "$seconds" "$best"; then best=$seconds best_method=$method; fi
         printf ' %10.6f' "$seconds" ;;
      124) printf ' %10s' ">$limit" ;;
      3) printf ' %10s' holes ;;
      *) printf ' %10s' failed ;;
    esac
  done
}

sums() {
  local name file first second seconds fields method
  printf '\nMinkowski sums, seconds (n: vertices of P and Q; out: vertices, holes, degenerate segments and points of the sum)\n'
  printf '%-14s %11s %22s %10s' input n out sunder
  if [[ -x $build/cgal_sum ]]; then
    for method in $methods; do printf ' %10s' "$method"; done
    printf ' %7s %7s' best ratio
  fi
  printf '\n'
  for name in "${files[@]}"; do
    file=$input/$name.txt
    if [[ ! -r $file ]]; then echo "$name: no $file"; continue; fi
    first=$(sunder_line "$file") || { echo "$name: failed"; continue; }
    read -r -a fields <<<"$first"
    printf '%-14s %11s %22s' "$name" "${fields[1]}+${fields[2]}" "${fields[3]},${fields[4]},${fields[5]},${fields[6]}"
    if [[ -x $build/cgal_sum ]]; then
      cgal_columns "$file" >"$scratch/columns"
      second=$(sunder_line "$file")
      seconds=$(larger "${first##* }" "${second##* }")
      printf ' %10.6f%s' "$seconds" "$(cat "$scratch/columns")"
      if [[ -n $best ]]; then printf ' %7s %7.1f' "$best_method" "$(awk -v a="$best" -v b="$seconds" 'BEGIN { print a / b }')"; fi
    else
      printf ' %10.6f' "${first##* }"
    fi
    printf '\n'
  done
}

# The second lines of pairs_fit hold the mover turned by half a turn: reflected, the pieces overlap their plates, and the exact fits
# are the nearest places for many of them. As the file stands nothing overlaps; both are measured.
pairs() {
  local row name turn line ours theirs
  printf '\nLeast separating translations, microseconds a pair (%s pairs; all: every pair of the file, Sunder alone)\n' "$count"
  printf '%-18s %10s %10s %10s %7s  %s\n' input all sunder cgal ratio 'sum of lengths: sunder, cgal (pairs it could not do)'
  for row in 'pairs_buildings as-is' 'pairs_fit reflect' 'pairs_fit as-is'; do
    read -r name turn <<<"$row"
    if [[ ! -r $input/$name.txt.gz ]]; then echo "$name: no $input/$name.txt.gz"; continue; fi
    gzip -dc "$input/$name.txt.gz" >"$scratch/$name.txt"
    line=$("$build/bench_pair" "$scratch/$name.txt" 0 "$turn")
    read -r -a ours <<<"$("$build/bench_pair" "$scratch/$name.txt" "$count" "$turn")"
    if [[ $turn == reflect ]]; then name+=' (P, -Q)'; fi
    printf '%-18s %10.2f %10.2f' "$name" "$(cut -d' ' -f2 <<<"$line")" "${ours[1]}"
    if [[ -x $build/cgal_pair ]]; then
      if read -r -a theirs <<<"$(timeout 600 "$build/cgal_pair" "$scratch/${name%% *}.txt" "$count" "$turn" 2>/dev/null)" &&
         [[ ${#theirs[@]} -eq 4 ]]; then
        printf ' %10.2f %7.1f  %s, %s (%s)' "${theirs[1]}" "$(awk -v a="${theirs[1]}" -v b="${ours[1]}" 'BEGIN { print a / b }')" \
          "${ours[2]}" "${theirs[2]}" "${theirs[3]}"
      else
        printf ' %10s %7s  %s' failed - "${ours[2]}"
      fi
    fi
    printf '\n'
  done
}

for program in bench_sum bench_pair; do
  if [[ $program == bench_sum && $what == pairs || $program == bench_pair && $what == sums ]]; then continue; fi
  if [[ ! -x $build/$program ]]; then
    echo "run.sh: no $build/$program; build the target bench, or set SUNDER_BUILD" >&2
    exit 1
  fi
done
header
if [[ ! -d $input ]]; then
  echo "no $input: nothing to measure (SUNDER_BENCH_INPUT names another folder)"
  exit 0
fi
if [[ $what != pairs ]]; then sums; fi
if [[ $what != sums ]]; then pairs; fi
