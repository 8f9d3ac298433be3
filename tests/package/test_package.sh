# shellcheck shell=bash
# Installs to a scratch prefix and builds a small program against the installed files: by pkg-config and by
# find_package, with the shared and with the static library. The prefix is moved after installing, as packagers do. A
# second program uses all headers, in C and in C++, also as a caller that was compiled with older headers.
set -eu
work=$SUNDER_BUILD/package-test
rm -rf "$work"
mkdir -p "$work"

# The libraries of a sanitized build require their users to link the sanitizer's runtime; installed libraries do not.
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

# The completion for bash is installed with the program.
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

# All headers in C and in C++, each of them included first, and a program that uses all of them and was compiled as an
# older caller.
libdir=$(dirname "$(find "$prefix" -name 'libsunder.so' | head -n 1)")
flags=(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror "-I$prefix/include")
link=("-L$libdir" -lsunder -lm)
said='sizes: 1 1, total 0.25
moved 1 by 2.000, verified: 1, worlds: 1, trees: 1
area 16
refused: the options begin with the size 12345, which no struct of options has: call its _init function, or set `size` to sizeof of the struct'
interface() { # name of the language, compiler, the compiler's option for the language, standards...
    local name=$1 compiler=$2 language=$3 standard header got
    shift 3
    for standard in "$@"; do
        for header in "$SUNDER_SOURCE"/src/sunder*.h; do
            printf '#include <%s>\n' "${header##*/}" >"$work/first.c"
            "$compiler" -x "$language" "-std=$standard" "${flags[@]}" -fsyntax-only "$work/first.c"
        done
        "$compiler" -x "$language" "-std=$standard" "${flags[@]}" "$SUNDER_SOURCE/tests/package/interface.c" -x none \
            -o "$work/interface" "${link[@]}"
        got=$(LD_LIBRARY_PATH=$libdir "$work/interface")
        if [ "$got" != "$said" ]; then
            echo "the headers in $standard: '$got' instead of '$said'"
            exit 1
        fi
        echo "the headers in $standard: ok"
    done
}
interface C "$cc" c c11 c17
cxx=$(command -v c++ || command -v g++ || command -v clang++ || true)
if [ -n "$cxx" ]; then
    interface C++ "$cxx" c++ c++11 c++17
else
    echo "there is no C++ compiler: left out"
fi

# The files that the headers mention are installed.
for page in REFERENCES.md api.md; do
    if ! [ -s "$prefix/share/doc/sunder/$page" ]; then
        echo "$page is named in the headers, and not installed"
        exit 1
    fi
done

# The shared library exports only the functions that the headers declare.
if command -v nm >/dev/null; then
    nm -D --defined-only "$libdir/libsunder.so" | awk '$2 ~ /[TDBR]/ {print $3}' | sort >"$work/exported"
    # Each declaration is marked stable or experimental; in a header that is experimental as a whole all are marked so.
    cat "$prefix"/include/sunder*.h >"$work/headers"
    grep -E '^(SUNDER_API|SUNDER_EXPERIMENTAL) ' "$work/headers" | grep -o 'sunder_[a-z_]*(' | tr -d '(' | sort >"$work/declared"
    if grep -n '^SUNDER_API' "$prefix/include/sunder_proof.h" "$prefix/include/sunder_parts.h" "$prefix/include/sunder_hiding.h" \
        "$prefix/include/sunder_legible.h"; then
        echo "stable, in a header that says that all of it is experimental"
        exit 1
    fi
    comm -3 "$work/exported" "$work/declared" >"$work/differ"
    if [ -s "$work/differ" ]; then
        echo "exported, but declared in no header (left), or declared, but not in the library (right):"
        cat "$work/differ"
        exit 1
    fi
    echo "exports: ok"
fi
