# shellcheck shell=bash
# Runs one fuzz target: inputs that once failed, recorded inputs (corpus/, by pieces.sh), then a fixed number of new
# ones. The number is fixed, and not the time, so that a seed replays a run; an input that takes minutes counts as a
# failure (a hang). Targets that read texts start from seeds/, since random bytes would hardly ever form a valid text.
set -eu
name=$1
program=$SUNDER_BUILD/fuzz/$name
[ -x "$program" ] || { echo "skipped: $name was not built"; exit 77; }
# Freed memory is kept from use for a while, to find late accesses: 16 MB instead of 256, which is still more than an
# input allocates, take a third less time.
export ASAN_OPTIONS=${ASAN_OPTIONS:-quarantine_size_mb=16:thread_local_quarantine_size_kb=64}
seed=${SUNDER_SEED:-1} runs=$((${2:-10000} * ${SUNDER_TEST_SCALE:-1}))
work=$SUNDER_BUILD/fuzz/found
mkdir -p "$work"
echo "SUNDER_SEED=$seed, $runs runs"
shopt -s nullglob
known=("$SUNDER_SOURCE/tests/fuzz/known/$name"/*)
[ "${#known[@]}" -eq 0 ] || "$program" "${known[@]}"
kept=$SUNDER_SOURCE/tests/fuzz/corpus/$name.tar.gz corpus=$SUNDER_BUILD/fuzz/corpus/$name
rm -rf "$corpus"
mkdir -p "$corpus/kept" "$corpus/new"
if [ -f "$kept" ]; then
    # An ordinary run takes at most two thousand recorded inputs, at regular steps in the order of their names, which
    # are hashes.
    tar -tzf "$kept" | grep -v '/$' | LC_ALL=C sort >"$corpus/names"
    every=1
    [ "${SUNDER_TEST_SCALE:-1}" != 1 ] || every=$(($(wc -l <"$corpus/names") / 2000 + 1))
    awk -v every=$every 'NR % every == 1 % every' "$corpus/names" | tar -xzf "$kept" -C "$corpus/kept" -T -
    "$program" "$corpus/kept" -runs=0 -max_len=600 -entropic=0 -timeout=100 -rss_limit_mb=4096 >"$corpus/log" 2>&1 || { tail -n 60 "$corpus/log"; exit 1; }
fi
seeds=() longest=400
if [ -d "$SUNDER_SOURCE/tests/fuzz/seeds/$name" ]; then seeds=("$corpus/new" "$SUNDER_SOURCE/tests/fuzz/seeds/$name") longest=600; fi
"$program" ${seeds[@]+"${seeds[@]}"} -seed="$seed" -runs="$runs" -max_len=$longest -timeout=100 -rss_limit_mb=4096 -artifact_prefix="$work/$name-" \
    -print_final_stats=1 -verbosity=1 2>&1 | tail -n 40
exit "${PIPESTATUS[0]}"
