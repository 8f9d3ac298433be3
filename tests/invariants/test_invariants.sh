#!/usr/bin/env bash
# Do the assertions and checkers of the library (src/base/invariant.h) hold in its own tests, and do these pass in the
# build of another compiler? One build answers both: by clang if the ordinary build is by gcc, by gcc if it is by clang,
# without NDEBUG and with warnings as errors. Without a second compiler the first one makes it.
#
# What this leaves out: code by gcc with assertions, and code by clang without, where only gcc reports variables that
# nothing but an assertion uses. The random tests run in the ordinary build; `ctest -C long -L long` (SUNDER_LAWS=all)
# runs them here, too.
set -euo pipefail
source=${SUNDER_SOURCE:?}
build=${SUNDER_BUILD:?}
first=$(sed -n 's/^CMAKE_C_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt" | head -n 1)
second=clang
if "$first" -dM -E -x c /dev/null | grep -q '__clang__'; then second=gcc; fi
command -v $second >/dev/null || { echo "$second is not installed: the build is by $first"; second=$first; }
second_build=$build/invariants
mkdir -p "$second_build"

failed() {
    echo "FAILED: $second: $(grep -cE '(error|warning):' "$second_build/log") warnings and errors"
    grep -E '(error|warning):' -A 2 "$second_build/log" | head -n 40 || tail -n 20 "$second_build/log"
    exit 1
}
generator=$(sed -n 's/^CMAKE_GENERATOR:INTERNAL=//p' "$build/CMakeCache.txt")
jobs=$(nproc 2>/dev/null || echo 2)
cmake -S "$source" -B "$second_build" -G "$generator" -D CMAKE_C_COMPILER="$second" -D CMAKE_BUILD_TYPE=Debug \
    -D CMAKE_C_FLAGS_DEBUG=-O1 -D SUNDER_PROGRAM=OFF -D SUNDER_WERROR=ON >"$second_build/log" 2>&1 || failed
grep -q -- '-Wpedantic .*-Werror' "$second_build/compile_commands.json" || { echo "FAILED: warnings are not errors"; exit 1; }

folders=(unit golden)
[[ ${SUNDER_LAWS:-} != all ]] || folders+=(property)
mapfile -t programs < <(cd "$source/tests" && find "${folders[@]}" -name 'test_*.c' |
    sed 's|^[a-z]*/||; s|^\(.*/\)test_|test_\1|; s|/|_|g; s|\.c$||') # unit/number/test_big.c: test_number_big
keep_going=(-k) # every file is compiled, even if others have warnings
if [[ $generator == Ninja* ]]; then keep_going=(-k 0); fi
cmake --build "$second_build" -j "$jobs" --target "${programs[@]}" sunder-families -- "${keep_going[@]}" \
    >"$second_build/log" 2>&1 || failed

# Can the check fail? A broken invariant has to end the program.
cat >"$second_build/broken.c" <<'X'
#include "base/invariant.h"
int main(int argc, char **argv)
{
    (void)argv;
    SUNDER_I_ASSERT(argc != 1);
    SUNDER_I_CHECK(argc == 2 ? "two" : 0, 1);
    return 0;
}
X
$second -I "$source/src" -o "$second_build/broken" "$second_build/broken.c" "$second_build/src/libsunder.a" -lgmp -lm -pthread
! ("$second_build/broken" 2>/dev/null) && ! ("$second_build/broken" x 2>/dev/null) && "$second_build/broken" x x ||
    { echo "FAILED: assertions are off"; exit 1; }
cd "$second_build"
kinds=${folders[*]}
ctest --output-on-failure -j "$jobs" -L "^(${kinds// /|})\$" -LE '^thorough$'
