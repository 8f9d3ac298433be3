# shellcheck shell=bash
# Installs to a scratch prefix and builds a small program against what lies there: by pkg-config and by find_package,
# with the shared and with the static library. The prefix is moved after installing, as packagers do.
set -eu
work=$SUNDER_BUILD/package-test
rm -rf "$work"
mkdir -p "$work"

# The libraries of a sanitized build ask their users for the sanitizer's runtime; that is not what is installed.
if grep -q '^SUNDER_SANITIZE:STRING=.' "$SUNDER_BUILD/CMakeCache.txt"; then
    echo "skipped: the build carries a sanitizer"
    exit 77
fi

cmake --install "$SUNDER_BUILD" --prefix "$work/first" >"$work/install.log"
mv "$work/first" "$work/prefix"
prefix=$work/prefix

expect() { # what, command...: the sum of a 4 x 4 and a 1 x 2 rectangle has the area 5 * 6
    local what=$1 got
    shift
    got=$("$@")
    if [ "$got" != 30 ]; then
        echo "$what: area '$got' instead of 30"
        exit 1
    fi
    echo "$what: ok"
}

# The program's completion for bash comes with it.
if [ -x "$prefix/bin/sunder" ]; then
    bash -n "$prefix/share/bash-completion/completions/sunder"
    for page in sunder sunder-separate sunder-check sunder-sum sunder-pair sunder-buffer sunder-route; do
        [ -s "$prefix/share/man/man1/$page.1" ]
    done
    echo "completion, manual pages: ok"
fi

cc=$(sed -n 's/^CMAKE_C_COMPILER:[A-Z]*=//p' "$SUNDER_BUILD/CMakeCache.txt")
if command -v pkg-config >/dev/null; then
    PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name sunder.pc)")
    export PKG_CONFIG_PATH
    libdir=$(pkg-config --variable=libdir sunder)
    # shellcheck disable=SC2046 # the flags are words
    "$cc" -std=c17 -Wall -Wextra -Werror "$SUNDER_SOURCE/tests/package/sum.c" -o "$work/by_pkg_config" \
        $(pkg-config --cflags --libs sunder)
    expect "pkg-config" env LD_LIBRARY_PATH="$libdir" "$work/by_pkg_config"
    [ "$(pkg-config --modversion sunder)" = "$(sed -n 's/^#define SUNDER_VERSION "\(.*\)"/\1/p' "$prefix/include/sunder.h")" ]
else
    echo "pkg-config is not installed: left out"
fi

cmake -S "$SUNDER_SOURCE/tests/package" -B "$work/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$cc" \
    >"$work/configure.log"
cmake --build "$work/build" >"$work/build.log"
expect "find_package, shared" "$work/build/shared"
expect "find_package, static" "$work/build/static"

# Only what the header declares leaves the shared library.
if command -v nm >/dev/null; then
    library=$(find "$prefix" -name 'libsunder.so' | head -n 1)
    nm -D --defined-only "$library" | awk '$2 ~ /[TDBR]/ {print $3}' | sort >"$work/exported"
    grep -o 'sunder_[a-z_]*(' "$prefix/include/sunder.h" | tr -d '(' | sort -u >"$work/declared"
    comm -23 "$work/exported" "$work/declared" >"$work/surplus"
    if [ -s "$work/surplus" ]; then
        echo "exported, but not in sunder.h:"
        cat "$work/surplus"
        exit 1
    fi
    # ... and everything that it declares is there (names in comments, and types of functions, are not functions).
    grep '^SUNDER_API' "$prefix/include/sunder.h" | grep -o 'sunder_[a-z_]*(' | tr -d '(' | sort -u >"$work/promised"
    comm -13 "$work/exported" "$work/promised" >"$work/missing"
    if [ -s "$work/missing" ]; then
        echo "declared in sunder.h, but not in the library:"
        cat "$work/missing"
        exit 1
    fi
    echo "exports: ok"
fi
