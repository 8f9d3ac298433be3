#!/usr/bin/env bash
# How instructions and memory of a sum grow with n, the number of input plus output vertices: a Markdown table, and for
# each family the exponents of n fitted by least squares over all sizes. Instructions are counted by callgrind, memory
# by massif. The record in PAPER.md is made by
#
#   growth.sh | python3 tests/bench/record.py tests/bench/paper growth -
#
#   growth.sh [FAMILY ...]     star, random and covered-fork unless some are named
#
#   SUNDER_BUILD               build directory with bench_sum and sunder-families (build/release)
#   SUNDER_GROWTH_SIZES        (200 500 1000 2000)
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
build=${SUNDER_BUILD:-$source_dir/build/release}
read -r -a sizes <<<"${SUNDER_GROWTH_SIZES:-200 500 1000 2000}"
names=("$@")
if [[ $# -eq 0 ]]; then names=(star random covered-fork); fi
for program in bench_sum sunder-families; do
  [[ -x $build/$program ]] || { echo "growth.sh: no $build/$program" >&2; exit 1; }
done
for tool in valgrind python3; do
  command -v $tool >/dev/null || { echo "growth.sh: $tool is not installed" >&2; exit 1; }
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

instructions() {
  SUNDER_BENCH_RUNS=1 valgrind --tool=callgrind --toggle-collect='*bench_once*' --callgrind-out-file=/dev/null \
    "$build/bench_sum" "$1" 2>&1 >/dev/null | sed -n 's/.*Collected : //p'
}

peak() { # bytes of the heap, the operands included
  SUNDER_BENCH_RUNS=1 valgrind --tool=massif --massif-out-file="$scratch/heap" --peak-inaccuracy=0 --max-snapshots=10 \
    "$build/bench_sum" "$1" >/dev/null 2>&1
  awk -F= '$1 == "mem_heap_B" && $2 > most { most = $2 } END { print most }' "$scratch/heap"
}

for name in "${names[@]}"; do
  for size in "${sizes[@]}"; do
    "$build/sunder-families" "$name" --size "$size" >"$scratch/input"
    read -r _ p q out _ <<<"$(SUNDER_BENCH_RUNS=1 "$build/bench_sum" "$scratch/input")"
    echo "$name $size $((p + q + out)) $(instructions "$scratch/input") $(peak "$scratch/input")"
  done
done | python3 -c '
import math, sys
rows = [line.split() for line in sys.stdin]

def exponent(family, column):
    at = [(math.log(int(r[2])), math.log(max(1, int(r[column])))) for r in rows if r[0] == family]
    x, y = (sum(p[k] for p in at) / len(at) for k in (0, 1))
    return sum((a - x) * (b - y) for a, b in at) / sum((a - x) ** 2 for a, _ in at)

print("| family | size | n, in and out | instructions, M | memory, MB |\n|---|---|---|---|---|")
for family, size, n, count, heap in rows:
    print(f"| {family} | {size} | {n} | {int(count) / 1e6:.1f} | {int(heap) / 1e6:.2f} |")
print("\n| family | exponent of instructions | of memory |\n|---|---|---|")
for family in dict.fromkeys(r[0] for r in rows):
    print(f"| {family} | {exponent(family, 3):.2f} | {exponent(family, 4):.2f} |")
'
