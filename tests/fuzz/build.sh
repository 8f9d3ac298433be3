# shellcheck shell=bash
# Builds the fuzz targets with clang and the sanitizers, in a build tree inside the one that runs the tests. The checks of
# pointers by the sanitizer of undefined behaviour are left out: they take half of the time to compile, and the address
# sanitizer sees most of what they see. The preset `asan` has them.
set -eu
# shellcheck source=../../gis/setup.sh
. "$SUNDER_SOURCE/gis/setup.sh"
setup_has_fuzzer >/dev/null 2>&1 || { echo "skipped: clang with libFuzzer and its sanitizers is not installed"; exit 77; }
undefined=bool,bounds,builtin,enum,integer-divide-by-zero,nonnull-attribute,shift,signed-integer-overflow,unreachable,vla-bound
cmake -S "$SUNDER_SOURCE" -B "$SUNDER_BUILD/fuzz" -DCMAKE_C_COMPILER=clang -DCMAKE_BUILD_TYPE=Debug \
    -DCMAKE_C_FLAGS_DEBUG="-O1 -gline-tables-only" -DSUNDER_FUZZ=ON -DSUNDER_PROGRAM=OFF -DSUNDER_TESTS=OFF \
    -DSUNDER_SANITIZE="fuzzer-no-link,address,$undefined"
cmake --build "$SUNDER_BUILD/fuzz" --target fuzzers -j 2
