#!/usr/bin/env bash
# Does the second compiler (clang if the build uses gcc, gcc if it uses clang) compile all C files of the project
# without a warning, and do the unit tests pass in its build? That build is inside the one that runs the tests. In
# continuous integration warnings of the first compiler are errors, too (SUNDER_WERROR).
set -euo pipefail
source=${SUNDER_SOURCE:?}
build=${SUNDER_BUILD:?}
skip() { echo "skipped: $1"; exit 77; }

first=$(sed -n 's/^CMAKE_C_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt" | head -n 1)
second=clang
if "$first" -dM -E -x c /dev/null | grep -q '__clang__'; then second=gcc; fi
command -v $second >/dev/null || skip "$second is not installed"
second_build=$build/$second
mkdir -p "$second_build"

failed() {
    echo "FAILED: $second: $(grep -cE '(error|warning):' "$second_build/log") warnings and errors"
    grep -E '(error|warning):' -A 2 "$second_build/log" | head -n 40 || tail -n 20 "$second_build/log"
    exit 1
}
generator=$(sed -n 's/^CMAKE_GENERATOR:INTERNAL=//p' "$build/CMakeCache.txt")
cmake -S "$source" -B "$second_build" -G "$generator" -D CMAKE_C_COMPILER=$second -D CMAKE_BUILD_TYPE=Release \
    -D SUNDER_WERROR=ON >"$second_build/log" 2>&1 || failed
# The C programs of the benchmarks are not part of `all`. Every file is compiled, even if others have warnings.
mapfile -t benches < <(sed -n 's|.*CMakeFiles/\([a-z_]*\)[.]dir/bench/[a-z_]*[.]c[.]o .*|\1|p' "$second_build/compile_commands.json" |
    grep -v '^naive_' | LC_ALL=C sort -u)
((${#benches[@]} > 3)) || { echo "FAILED: the programs of the benchmarks were not found"; exit 1; }
keep_going=(-k)
if [[ $generator == Ninja* ]]; then keep_going=(-k 0); fi
cmake --build "$second_build" -j "$(nproc 2>/dev/null || echo 2)" --target all "${benches[@]}" -- "${keep_going[@]}" \
    >"$second_build/log" 2>&1 || failed
files=$(grep -c '"file": .*\.c"' "$second_build/compile_commands.json")
((files > 500)) || { echo "FAILED: only $files files"; exit 1; }
grep -q -- '-Wpedantic .*-Werror' "$second_build/compile_commands.json" || { echo "FAILED: warnings are not errors"; exit 1; }
echo "$second: no warning"
cd "$second_build"
ctest --output-on-failure -j "$(nproc 2>/dev/null || echo 2)" -L '^unit$'
