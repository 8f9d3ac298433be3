#!/usr/bin/env bash
# Do the unit tests of the library pass on a big-endian machine? The library and its unit tests are compiled for s390x
# by Debian's cross compiler, with Debian's GMP and cmocka for s390x, and run by qemu-user, which is some 15 times
# slower than a real machine. So random tests make a quarter of their cases, and tests that would take above 15 seconds are
# left to `ctest -C long -L long` (SUNDER_LAWS=all).
set -euo pipefail
source=${SUNDER_SOURCE:?}
work=${SUNDER_BUILD:?}/s390x
skip() { echo "skipped: $1"; exit 77; }
command -v s390x-linux-gnu-gcc >/dev/null || skip "gcc-s390x-linux-gnu is not installed"
command -v qemu-s390x >/dev/null || skip "qemu-user is not installed"
[[ -d /usr/s390x-linux-gnu/lib ]] || skip "libc6-dev-s390x-cross is not installed"
mkdir -p "$work"

# GMP and cmocka are downloaded and unpacked inside the build; apt uses lists of its own there, so the system does not
# change.
if [[ ! -f $work/root/complete ]]; then
    for tool in apt-get dpkg-deb; do
        command -v $tool >/dev/null || skip "there is no $tool to fetch GMP for s390x"
    done
    rm -rf "$work/apt" "$work/root"
    mkdir -p "$work/apt/lists/partial" "$work/apt/archives/partial" "$work/root"
    : >"$work/apt/status"
    apt=(apt-get -q -o "Dir::State::Lists=$work/apt/lists" -o "Dir::Cache=$work/apt" -o APT::Architecture=s390x
         -o "Dir::State::status=$work/apt/status" -o APT::Architectures=s390x)
    (cd "$work/apt" && "${apt[@]}" update && "${apt[@]}" download libgmp-dev libgmp10 libcmocka-dev libcmocka0) \
        >"$work/log" 2>&1 || skip "no packages for s390x: $(tail -n 1 "$work/log")"
    for package in "$work"/apt/*.deb; do dpkg-deb -x "$package" "$work/root"; done
    rm -rf "$work/apt"
    touch "$work/root/complete"
fi

# In strict C17 this compiler evaluates floats as doubles on s390x, and then rejects operators on vectors of floats; with
# "fast" it evaluates floats as floats, as for other targets.
library=$work/root/usr/lib/s390x-linux-gnu
cmake -S "$source" -B "$work/build" -D CMAKE_BUILD_TYPE=Release -D SUNDER_PROGRAM=OFF \
    -D CMAKE_SYSTEM_NAME=Linux -D CMAKE_SYSTEM_PROCESSOR=s390x -D CMAKE_LIBRARY_ARCHITECTURE=s390x-linux-gnu \
    -D CMAKE_C_COMPILER=s390x-linux-gnu-gcc -D CMAKE_C_FLAGS=-fexcess-precision=fast \
    -D CMAKE_FIND_ROOT_PATH="$work/root;/usr/s390x-linux-gnu" -D CMAKE_FIND_ROOT_PATH_MODE_INCLUDE=ONLY \
    -D CMAKE_FIND_ROOT_PATH_MODE_LIBRARY=ONLY -D GMP_INCLUDE_DIR="$work/root/usr/include/s390x-linux-gnu" \
    -D GMP_LIBRARY="$library/libgmp.a" -D CMOCKA_INCLUDE_DIR="$work/root/usr/include" \
    -D CMOCKA_LIBRARY="$library/libcmocka.so" >"$work/log" 2>&1 || { tail -n 20 "$work/log"; exit 1; }

# test_memory_limit sets a limit of its address space, which the emulator does not apply.
left_out=(unit/test_memory_limit)
if [[ ${SUNDER_LAWS:-} == all ]]; then
    export SUNDER_TEST_SCALE=${SUNDER_TEST_SCALE:-1}
else
    left_out+=(unit/displacement/test_separate_layer_calls unit/displacement/solve/clusters/test_given_up
               unit/displacement/solve/search/test_shake unit/displacement/report/test_area_bounds
               unit/displacement/report/test_cluster_needs unit/displacement/report/test_no_room
               unit/displacement/solve/clusters/test_grow_crowds unit/displacement/prove/areas/test_areas
               unit/displacement/levels/test_level_blocks unit/displacement/rows/test_find_rows
               unit/displacement/solve/search/test_constrain unit/displacement/prove/proofs/test_plane_kept
               unit/displacement/prove/optimum/test_forbidden unit/displacement/test_separate_layer_memory
               unit/displacement/quadratic/test_quadratic unit/unions/test_unions)
    export SUNDER_TEST_SCALE=${SUNDER_TEST_SCALE:-0.25}
fi
mapfile -t all < <(cd "$source/tests" && find unit -name 'test_*.c' | sed 's|\.c$||' | LC_ALL=C sort)
mapfile -t programs < <(printf '%s\n' "${all[@]}" | grep -vxFf <(printf '%s\n' "${left_out[@]}") |
    sed 's|^unit/||; s|^\(.*/\)test_|test_\1|; s|/|_|g') # unit/number/test_big: test_number_big
((${#programs[@]} == ${#all[@]} - ${#left_out[@]} && ${#programs[@]} > 75)) ||
    { echo "FAILED: ${#programs[@]} of ${#all[@]} unit tests, ${#left_out[@]} left out by name"; exit 1; }
cmake --build "$work/build" -j "$(nproc)" --target "${programs[@]}" >"$work/log" 2>&1 ||
    { grep -E 'error|FAILED' "$work/log" | head -n 30; exit 1; }

export library tests=$work/build/tests
run() {
    local status=0
    qemu-s390x -L /usr/s390x-linux-gnu -E LD_LIBRARY_PATH="$library" "$tests/$1" >"$tests/$1.out" 2>&1 || status=$?
    ((status == 0)) || { echo "FAILED: $1 ($status):"; grep -aE 'ERROR|LINE|FAILED|SUNDER_SEED' "$tests/$1.out" | head -n 5; }
}
export -f run
printf '%s\n' "${programs[@]}" | xargs -P "$(nproc)" -I NAME bash -c 'run NAME' >"$work/failed"
cat "$work/failed"
[[ ! -s $work/failed ]] || exit 1
echo "${#programs[@]} programs of unit tests pass on s390x, ${#left_out[@]} left out: ${left_out[*]}"
