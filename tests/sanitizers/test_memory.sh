#!/usr/bin/env bash
# Is uninitialised or freed memory read, or does memory leak? valgrind's memcheck runs on the golden cases, on every
# tenth program of the unit tests, and on the first call of the program and every tenth after it in each test of the
# command. It detects what the address sanitizer cannot: faults in memory of GDAL, GMP and SQLite, and reads of memory
# that was never written.
#
# SUNDER_MEMORY_PART=N takes every Nth in place of every tenth. SUNDER_MEMORY_ONLY=REGEX selects tests by name, so that
# a run can be made in parts that together test the same.
#
# The verdict is valgrind's alone. A test under it may fail for other reasons: valgrind computes long doubles as
# doubles, and limits of memory and signals affect valgrind itself.
set -eu
skip() { echo "skipped: $1"; exit 77; }
command -v valgrind >/dev/null || skip "valgrind is not installed"
command -v flock >/dev/null || skip "flock is not installed"
# every Nth call and program; a pattern of the names of tests
part=${SUNDER_MEMORY_PART:-10} only=${SUNDER_MEMORY_ONLY:-.}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
logs=$work/logs
mkdir "$logs" "$work/bin"
options="-q --error-exitcode=0 --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite
    --suppressions=$SUNDER_SOURCE/tests/sanitizers/memory.supp --gen-suppressions=no --log-file=$logs/%p"

# A script in place of the program: it counts calls, and runs every tenth under valgrind.
cat >"$work/bin/sunder" <<SH
#!/usr/bin/env bash
exec 9>>"$work/lock"
flock 9
printf x >>"$work/count"
read -r n <"$work/count"
exec 9>&-
if [ \$(((\${#n} - 1) % $part)) -eq 0 ]; then
    printf '%s\n' "\$*" >>"$work/asked"
    exec valgrind $(echo $options) "$SUNDER" "\$@"
fi
exec "$SUNDER" "\$@"
SH
chmod +x "$work/bin/sunder"
: >"$work/asked"

told() { echo "$1: asked; complaints so far: $(find "$logs" -type f -size +0 | wc -l)"; }

programs=$(find "$SUNDER_BUILD/tests" -maxdepth 1 -name 'test_*' -type f -perm -u+x | LC_ALL=C sort)
units=$(cd "$SUNDER_SOURCE/tests/unit" && find . -name 'test_*.c' | # number/test_big.c: test_number_big
    sed 's|^\./||; s|^\(.*/\)test_|test_\1|; s|/|_|g; s|\.c$||' | LC_ALL=C sort | awk -v part="$part" 'NR % part == 1')
asked=0
for name in test_golden $units; do
    [[ $name =~ $only ]] && grep -q "/$name\$" <<<"$programs" || continue
    asked=$((asked + 1))
    # shellcheck disable=SC2086 # words
    timeout 7200 valgrind $options "$SUNDER_BUILD/tests/$name" >"$work/$name.out" 2>&1 || echo "$name ends with $? under valgrind"
    told "$name"
done

# Left out: they end the program by signals, or by limits of memory, size and time that valgrind itself would exceed
# first.
left_out='test_interrupt|test_io_killed|test_same_everywhere|test_io_full_disk'
calls=0
for test in "$SUNDER_SOURCE"/tests/cli/test_*.sh; do
    name=$(basename "$test" .sh)
    [[ $name =~ ^($left_out)$ || ! $name =~ $only ]] && continue
    : >"$work/count"
    SUNDER=$work/bin/sunder timeout 7200 bash "$test" >"$work/$name.out" 2>&1 || echo "$name ends with $? under valgrind"
    calls=$((calls + $(wc -c <"$work/count")))
    told "$name"
done

found=$(find "$logs" -type f -size +0 | LC_ALL=C sort)
echo "calls of the program: $calls, of them under valgrind: $(wc -l <"$work/asked"); programs: $asked; with complaints: $(grep -c . <<<"$found" || true)"
[ -n "$found" ] || exit 0
# shellcheck disable=SC2086
cat $found | head -n 200
exit 1
