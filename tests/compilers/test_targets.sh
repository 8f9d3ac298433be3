#!/usr/bin/env bash
# CMake refuses a target for which the sources are not made, with a sentence that names the missing property.
set -euo pipefail
source=${SUNDER_SOURCE:?}
cc=$(sed -n 's/^CMAKE_C_COMPILER:[A-Z]*=//p' "${SUNDER_BUILD:?}/CMakeCache.txt" | head -n 1)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

configure() { # OPTIONS...: returns the status; the messages are in $work/said, on one line
    local status=0
    rm -rf "$work/build"
    # Without a C library for the target no program can be linked, so CMake tries the compiler with a static library.
    cmake -S "$source" -B "$work/build" -D CMAKE_C_COMPILER="$cc" -D SUNDER_PROGRAM=OFF -D SUNDER_TESTS=OFF "$@" \
        >"$work/log" 2>&1 || status=$?
    tr -s ' \n' ' ' <"$work/log" >"$work/said"
    return $status
}
refused() { # SENTENCE OPTIONS...
    local sentence="Sunder cannot be built for this target: $1"
    shift
    if configure "$@"; then
        echo "FAILED: $*: not refused"
        failures=$((failures + 1))
    elif ! grep -qF "$sentence" "$work/said"; then
        echo "FAILED: $*: refused without '$sentence'"
        tail -n 20 "$work/log"
        failures=$((failures + 1))
    else
        echo "$*: $(grep -oF "$sentence" "$work/said")"
    fi
}
takes() { echo 'int unused;' | "$cc" "$@" -x c -c - -o "$work/probe.o" 2>/dev/null; }
gmp() { # LINES: makes a header of GMP with another limb
    mkdir -p "$work/gmp"
    printf '%s\n' "$@" >"$work/gmp/gmp.h"
}

if ! configure; then
    echo "FAILED: this machine is refused"
    tail -n 20 "$work/log"
    exit 1
fi

library=(-D CMAKE_TRY_COMPILE_TARGET_TYPE=STATIC_LIBRARY)
refused "its compiler has no __int128" "${library[@]}" -D CMAKE_C_FLAGS=-D__int128=no
if takes -m32; then
    refused "its compiler has no __int128" "${library[@]}" -D CMAKE_C_FLAGS=-m32
fi
if takes -mx32; then
    refused "its long and its pointers do not have 64 bits" "${library[@]}" -D CMAKE_C_FLAGS=-mx32
fi
if takes -mfpmath=387 && "$cc" -mfpmath=387 -dM -E -x c /dev/null | grep -q '__FLT_EVAL_METHOD__ 2'; then
    refused "its doubles are not the 64 bits of IEEE 754, or are computed with excess precision" -D CMAKE_C_FLAGS=-mfpmath=387
fi
for limb in "unsigned int" "unsigned long"; do # 32 bits, and 64 with nails
    gmp "typedef $limb mp_limb_t;" "#define GMP_LIMB_BITS (8 * (int)sizeof(mp_limb_t))" "#define GMP_NAIL_BITS 4"
    refused "the limbs of its GMP, $work/gmp/gmp.h, do not have 64 bits" -D GMP_INCLUDE_DIR="$work/gmp"
done
gmp "#error no header for this target"
refused "$work/gmp/gmp.h does not compile" -D GMP_INCLUDE_DIR="$work/gmp"
exit $((failures > 0))
