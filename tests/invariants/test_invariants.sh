# shellcheck shell=bash
# Runs the tests of the library in a build without NDEBUG, so that its assertions and checkers run
# (src/base/invariant.h). The longest random tests, of the label `thorough`, are left to the build without assertions.
set -eu
build=$SUNDER_BUILD/invariants
cmake -S "$SUNDER_SOURCE" -B "$build" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS=-O2 -DCMAKE_C_FLAGS_DEBUG= \
    -DSUNDER_PROGRAM=OFF -DSUNDER_FUZZ=OFF >"$build.log" 2>&1 ||
    { cat "$build.log"; exit 1; }
programs=$(cd "$SUNDER_SOURCE/tests" && find unit property golden -name 'test_*.c' | # unit/number/test_big.c: test_number_big
    sed 's|^[a-z]*/||; s|^\(.*/\)test_|test_\1|; s|/|_|g; s|\.c$||')
# shellcheck disable=SC2086 # words
cmake --build "$build" -j "$(nproc)" --target $programs sunder-families >"$build.log" 2>&1 || { tail -50 "$build.log"; exit 1; }
# Can the check fail? A broken invariant has to end the program.
cat >"$build/broken.c" <<'X'
#include "base/invariant.h"
int main(int argc, char **argv)
{
    (void)argv;
    SUNDER_I_ASSERT(argc != 1);
    SUNDER_I_CHECK(argc == 2 ? "two" : 0, 1);
    return 0;
}
X
cc -I "$SUNDER_SOURCE/src" -o "$build/broken" "$build/broken.c" "$(find "$build" -name libsunder.a)" -lgmp -lm -pthread
! ("$build/broken" 2>/dev/null) && ! ("$build/broken" x 2>/dev/null) && "$build/broken" x x || { echo "assertions are off"; exit 1; }
cd "$build"
ctest --output-on-failure -j "$(nproc)" -L '^(unit|golden|property)$' -LE '^thorough$'
