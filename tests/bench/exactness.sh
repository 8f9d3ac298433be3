#!/usr/bin/env bash
# The cost of exactness: instructions of a sum (callgrind), and those of the same library built to trust all doubles
# (naive/number/trust.h). Two Markdown tables; EXACTNESS.md summarises the record in exactness/, which is made by
#
#   exactness.sh | python3 tests/bench/record.py tests/bench/exactness small_integers map_coordinates
#
#   small integers       for which doubles decide correctly: instructions of both, and whether both compute the same sum
#   map coordinates      for which they do not: the share of instructions in predicates beyond their filters (exact_*), and the
#                        outcome of the other library, which is stopped after ten seconds
#
#   exactness.sh [FAMILY ...]     all families unless some are named
#
#   SUNDER_BUILD                  build directory with bench_programs and sunder-families (build/release)
#   SUNDER_EXACTNESS_SIZES        (50 100)
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
build=${SUNDER_BUILD:-$source_dir/build/release}
read -r -a sizes <<<"${SUNDER_EXACTNESS_SIZES:-50 100}"
names=("$@")
if [[ $# -eq 0 ]]; then
  names=(convex comb fork slanted-fork covered-fork star random robot fat-grid fat-cover tight)
fi
for program in bench_sum bench_digest naive_sum naive_digest sunder-families; do
  [[ -x $build/$program ]] || { echo "exactness.sh: no $build/$program" >&2; exit 1; }
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

instructions() { # PROGRAM: the instructions of one sum; leaves the profile
  SUNDER_BENCH_RUNS=1 valgrind --tool=callgrind --toggle-collect='*bench_once*' --callgrind-out-file="$scratch/profile" \
    "$build/$1" "$scratch/input" 2>&1 >/dev/null | sed -n 's/.*Collected : //p'
}

digest() { # PROGRAM
  local line
  line=$(timeout 10 "$build/$1" "$scratch/input" 2>/dev/null) && echo "${line##* }"
}

# The functions beyond the filters do not call each other, so their inclusive counts can be added.
beyond() {
  callgrind_annotate --inclusive=yes --threshold=100 "$scratch/profile" |
    awk '/:exact_[a-z_]+ / { gsub(",", "", $1); n += $1 } END { print n + 0 }'
}

small() { # FAMILY SIZE
  local ours theirs same=no
  "$build/sunder-families" "$1" --size "$2" >"$scratch/input"
  ours=$(instructions bench_sum) theirs=$(instructions naive_sum)
  if [[ $(digest bench_digest) == "$(digest naive_digest)" ]]; then same=yes; fi
  awk -v n="$1" -v s="$2" -v a="$ours" -v b="$theirs" -v same=$same \
    'BEGIN { printf "| %s | %d | %.2f | %.2f | %.3f | %s |\n", n, s, a / 1e6, b / 1e6, a / b, same }'
}

map() { # FAMILY SIZE
  local all share theirs state=0
  "$build/sunder-families" "$1" --size "$2" --coordinates map >"$scratch/input"
  all=$(instructions bench_sum) share=$(beyond)
  theirs=$(digest naive_digest) || state=$?
  if ((state == 124)); then theirs='does not end'
  elif ((state)); then theirs='fails'
  elif [[ $theirs == "$(digest bench_digest)" ]]; then theirs='the same sum'
  else theirs='another sum'
  fi
  awk -v n="$1" -v s="$2" -v a="$all" -v b="$share" -v t="$theirs" \
    'BEGIN { printf "| %s | %d | %.2f | %.1f %% | %s |\n", n, s, a / 1e6, 100 * b / a, t }'
}

printf '%s\n' "| family | n | instructions, M | trusting doubles, M | ratio | same sum |" "|---|---|---|---|---|---|"
for name in "${names[@]}"; do for size in "${sizes[@]}"; do small "$name" "$size"; done; done
printf '\n%s\n%s\n' "| family | n | instructions, M | beyond the filters | trusting doubles |" "|---|---|---|---|---|"
for name in "${names[@]}"; do for size in "${sizes[@]}"; do map "$name" "$size"; done; done
