#!/usr/bin/env bash
# Is the default ever slower than the best of our other algorithms? A line of Markdown per family and size: the time of
# the default as a ratio to that of the best other algorithm, its decomposition included.
#
#   roads.sh [FAMILY ...]     all families unless some are named; needs a build with bench_sum and sunder-families
#
# Every algorithm with both orders and four decompositions (for sizes above SUNDER_ROADS_DECOMPOSED only the angle
# bisector) runs once, and is stopped when it has taken three times as long as the best, and a second. The three best
# and the default are then compared: by callgrind's instructions, or, above a second or without valgrind, by medians of
# five runs in turn. Seed 1.
#
#   SUNDER_BUILD               build directory (build/release)
#   SUNDER_ROADS_SIZES         (10 20 50 100 200 500)
#   SUNDER_ROADS_DECOMPOSED    (100)
#   SUNDER_ROADS_LIMIT         CPU seconds that the default may take (60)
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
build=${SUNDER_BUILD:-$source_dir/build/release}
names=("$@")
if [[ $# -eq 0 ]]; then
  names=(convex comb comb-swapped fork slanted-fork covered-fork star random robot fat-grid fat-cover tight)
fi
for program in bench_sum sunder-families; do
  [[ -x $build/$program ]] || { echo "roads.sh: no $build/$program" >&2; exit 1; }
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

less() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a + 0 < b + 0) }'; }

seconds() { # LIMIT ROAD...: seconds of one run; prints nothing if it was stopped
  local line
  line=$(ulimit -t "$1"; SUNDER_BENCH_RUNS=1 exec "$build/bench_sum" "${@:2}" "$scratch/input" 2>/dev/null) && echo "${line##* }"
}

instructions() { # ROAD...
  SUNDER_BENCH_RUNS=1 valgrind --tool=callgrind --toggle-collect='*bench_once*' --callgrind-out-file=/dev/null \
    "$build/bench_sum" "$@" "$scratch/input" 2>&1 >/dev/null | sed -n 's/.*Collected : //p'
}

roads() { # SIZE
  local algorithm decomposition order decompositions='angle-bisector hertel-mehlhorn optimal vertical'
  if (($1 > ${SUNDER_ROADS_DECOMPOSED:-100})); then decompositions=angle-bisector; fi
  for order in fat random; do
    for algorithm in incremental divide arrangement; do
      for decomposition in $decompositions; do echo "$algorithm $decomposition $order"; done
    done
  done
}

# The three best algorithms and the default, in the file `compared`: number and algorithm; sets unit.
compare() {
  local road words run
  : >"$scratch/compared"
  unit=instructions
  if ! command -v valgrind >/dev/null || ! less "$best" 1; then unit='s'; fi
  { echo "auto auto random"; sort -g "$scratch/tried" | head -n 3 | cut -d' ' -f2-; } >"$scratch/candidates"
  if [[ $unit == instructions ]]; then
    while read -r road; do
      read -r -a words <<<"$road"
      echo "$(instructions "${words[@]}") $road" >>"$scratch/compared"
    done <"$scratch/candidates"
    return
  fi
  for run in 1 2 3 4 5; do
    while read -r road; do
      read -r -a words <<<"$road"
      echo "$(seconds unlimited "${words[@]}") $road" >>"$scratch/$run"
    done <"$scratch/candidates"
  done
  while read -r road; do
    echo "$(sed -n "s/ $road\$//p" "$scratch"/[1-5] | sort -g | sed -n 3p) $road" >>"$scratch/compared"
  done <"$scratch/candidates"
  rm -f "$scratch"/[1-5]
}

row() { # FAMILY SIZE
  local swap=() road words this most best unit ours
  if [[ $1 == *-swapped ]]; then swap=(--swap); fi
  "$build/sunder-families" "${1%-swapped}" --size "$2" "${swap[@]}" >"$scratch/input"
  best=$(seconds "${SUNDER_ROADS_LIMIT:-60}") || { echo "| $1 | $2 | stopped | | | |"; return; }
  : >"$scratch/tried"
  while read -r road; do
    read -r -a words <<<"$road"
    most=$(awk -v b="$best" 'BEGIN { printf "%d", 1.999 + 3 * b }')
    this=$(seconds "$most" "${words[@]}") || continue
    echo "$this $road" >>"$scratch/tried"
    if less "$this" "$best"; then best=$this; fi
  done < <(roads "$2")
  compare
  ours=$(sed -n 's/ auto auto random$//p' "$scratch/compared")
  sed '/ auto auto random$/d' "$scratch/compared" | sort -g | head -n 1 | {
    read -r this road || { this=0 road='- (all stopped)'; }
    echo "| $1 | $2 | $unit | $ours | $this | $road | $(awk -v a="$ours" -v b="$this" 'BEGIN { if (b > 0) printf "%.2f", a / b; else print "-" }') |"
  }
}

echo "The default beside the best of the other roads: commit $(git -C "$source_dir" describe --always --dirty 2>/dev/null || echo unknown)."
echo
echo "| family | n | measured in | default | best road | which | default / best |"
echo "|---|---|---|---|---|---|---|"
for name in "${names[@]}"; do
  for size in ${SUNDER_ROADS_SIZES:-10 20 50 100 200 500}; do row "$name" "$size"; done
done
