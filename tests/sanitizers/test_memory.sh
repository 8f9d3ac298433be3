#!/usr/bin/env bash
# Is memory read that nobody wrote, or that was given back, or kept for ever? valgrind's memcheck on the golden cases, on every tenth
# call of the program that the tests of the command make, and on every tenth program of the unit tests. It sees what the
# address sanitizer does not: memory that GDAL, GMP and SQLite hand over, and what was never written.
#
# The verdict is valgrind's alone. A test under it may come to another end than by itself: valgrind's long doubles are doubles,
# and limits of memory and signals meet valgrind, too.
set -eu
skip() { echo "skipped: $1"; exit 77; }
command -v valgrind >/dev/null || skip "valgrind is not installed"
command -v flock >/dev/null || skip "flock is not installed"
part=${SUNDER_MEMORY_PART:-10} only=${SUNDER_MEMORY_ONLY:-.} # every so manyth; of tests whose names match
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
logs=$work/logs
mkdir "$logs" "$work/bin"
options="-q --error-exitcode=0 --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite
    --suppressions=$SUNDER_SOURCE/tests/sanitizers/memory.supp --gen-suppressions=no --log-file=$logs/%p"

# In the program's place: every tenth call of it goes through valgrind.
cat >"$work/bin/sunder" <<SH
#!/usr/bin/env bash
n=\$(flock "$work/count" bash -c 'n=\$((\$(cat "$work/count") + 1)); echo \$n >"$work/count"; echo \$n')
if [ \$((n % $part)) -eq 0 ]; then
    printf '%s\n' "\$*" >>"$work/asked"
    exec valgrind $(echo $options) "$SUNDER" "\$@"
fi
exec "$SUNDER" "\$@"
SH
chmod +x "$work/bin/sunder"
echo 0 >"$work/count"
: >"$work/asked"

# Left to themselves: they end the program by signals, or by limits of memory, size and time that valgrind would meet first.
left_out='test_interrupt|test_io_killed|test_same_everywhere|test_io_full_disk'
for test in "$SUNDER_SOURCE"/tests/cli/test_*.sh; do
    name=$(basename "$test" .sh)
    [[ $name =~ ^($left_out)$ || ! $name =~ $only ]] && continue
    SUNDER=$work/bin/sunder timeout 1800 bash "$test" >"$work/$name.out" 2>&1 || echo "$name ends with $? under valgrind"
done

programs=$(find "$SUNDER_BUILD/tests" -maxdepth 1 -name 'test_*' -type f -perm -u+x | LC_ALL=C sort)
units=$(for file in "$SUNDER_SOURCE"/tests/unit/test_*.c; do basename "$file" .c; done | LC_ALL=C sort | awk -v part="$part" 'NR % part == 1')
asked=0
for name in test_golden $units; do
    [[ $name =~ $only ]] && grep -q "/$name\$" <<<"$programs" || continue
    asked=$((asked + 1))
    # shellcheck disable=SC2086 # words
    timeout 1800 valgrind $options "$SUNDER_BUILD/tests/$name" >"$work/$name.out" 2>&1 || echo "$name ends with $? under valgrind"
done

found=$(find "$logs" -type f -size +0 | LC_ALL=C sort)
echo "calls of the program: $(cat "$work/count"), of them under valgrind: $(wc -l <"$work/asked"); programs: $asked; with complaints: $(grep -c . <<<"$found" || true)"
[ -n "$found" ] || exit 0
# shellcheck disable=SC2086
cat $found | head -n 200
exit 1
