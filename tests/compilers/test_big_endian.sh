#!/usr/bin/env bash
# Do the unit tests of the library pass on a big-endian machine? The library and its unit tests are compiled for s390x
# by Debian's cross compiler, with Debian's GMP and cmocka for s390x, and run by qemu-user, which is some 15 times
# slower than a real machine. So a plain run takes the rooms of numbers, predicates, shapes and planar maps, which have
# nearly all code that depends on the order of bytes or on the compiler's arithmetic, and a quarter of the random cases.
# `ctest -C long -L long` (SUNDER_LAWS=all) takes all rooms and all cases.
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
libraries=$work/root/usr/lib/s390x-linux-gnu headers=$work/root/usr/include
export libraries objects=$work/objects
export flags="-std=c17 -D_XOPEN_SOURCE=700 -DNDEBUG -O1 -ffp-contract=off -fexcess-precision=fast -w
    -Isrc -Itests -Itests/support -I$headers/s390x-linux-gnu -I$headers"
cd "$source"
if [[ ${SUNDER_LAWS:-} == all ]]; then
    rooms=(.)
    left_out=(-path '*/test_memory_limit.c') # sets a limit of its address space, which the emulator does not apply
else
    rooms=(base number predicate shape spatial planar_map) # include nothing of the others
    left_out=(-name test_sized_struct.c)                   # calls all of the library
    export SUNDER_TEST_SCALE=${SUNDER_TEST_SCALE:-0.25}
fi
mapfile -t sources < <(find "${rooms[@]/#/src/}" tests/support -name '*.c' -not '(' "${left_out[@]}" ')')
mapfile -t programs < <(find "${rooms[@]/#/tests/unit/}" -name 'test_*.c' -not '(' "${left_out[@]}" ')')
((${#sources[@]} > 100 && ${#programs[@]} >= 25)) || { echo "FAILED: ${#sources[@]} sources, ${#programs[@]} programs"; exit 1; }

compile() { # FILES: each becomes an object of the same path
    local file object
    for file; do
        object=$objects/${file%.c}.o
        mkdir -p "${object%/*}"
        # shellcheck disable=SC2086 # words
        s390x-linux-gnu-gcc $flags -DSUNDER_SOURCE="\"$PWD\"" -c "$file" -o "$object" || return 255 # ends xargs
    done
}
try() { # FILE: links the program of this test, and runs it
    local object=$objects/${1%.c}.o status=0
    s390x-linux-gnu-gcc -o "${object%.o}" "$object" "$objects/library.a" "$libraries/libcmocka.so" "$libraries/libgmp.a" -lm \
        -pthread || return 255
    qemu-s390x -L /usr/s390x-linux-gnu -E LD_LIBRARY_PATH="$libraries" "${object%.o}" >"$object.out" 2>&1 || status=$?
    ((status == 0)) || { echo "FAILED: $1 ($status):"; grep -aE 'ERROR|LINE|FAILED|SUNDER_SEED' "$object.out" | head -n 5; }
}
export -f compile try
each() { xargs -P "$(nproc 2>/dev/null || echo 2)" "$@"; }
rm -rf "$objects"
mkdir "$objects"
printf '%s\n' "${sources[@]}" "${programs[@]}" | each -n 8 bash -c 'compile "$@"' - >"$work/log" 2>&1 ||
    { grep -E 'error|FAILED' "$work/log" | head -n 30; exit 1; }
printf '%s\n' "${sources[@]}" | sed "s|\(.*\)\.c$|$objects/\1.o|" | xargs s390x-linux-gnu-ar qc "$objects/library.a"
s390x-linux-gnu-ranlib "$objects/library.a"
printf '%s\n' "${programs[@]}" | each -I FILE bash -c 'try FILE' >"$work/failed" 2>&1 || { head -n 30 "$work/failed"; exit 1; }
cat "$work/failed"
[[ ! -s $work/failed ]] || exit 1
echo "${#programs[@]} programs of unit tests pass on s390x"
