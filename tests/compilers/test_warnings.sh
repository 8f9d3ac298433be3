#!/usr/bin/env bash
# Do gcc and clang take every C file of the build without a warning, in the stated dialect? Each of them looks at each file
# once, with the flags that the build has for it, warnings as errors. No code is made: warnings that need the optimizer, as
# those of variables that may be read before they are set, come from the compiler that the build is made with.
set -euo pipefail
build=${SUNDER_BUILD:?}
skip() { echo "skipped: $1"; exit 77; }

[[ -f $build/compile_commands.json ]] || skip "no $build/compile_commands.json"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Files with the same flags are looked at by one call: a line has flags, then files. JSON's backslashes go; the first word
# that is an option comes after the compiler and what starts it.
sed -n 's/^ *"command": "\(.*\)",*$/\1/p' "$build/compile_commands.json" | sed 's/\\\(["\\]\)/\1/g' |
    awk -v most=20 '
        /\.c$/ && !seen[$NF]++ {
            file = $NF
            sub(/ -c [^ ]*$/, "")
            sub(/ -o [^ ]+/, "")
            sub(/^[^ ]* ([^-][^ ]* )*/, "")
            if (n[$0]++ % most == 0) { line[++lines] = $0; last[$0] = lines }
            line[last[$0]] = line[last[$0]] " " file
        }
        END { for (k = 1; k <= lines; k++) print line[k] }' >"$work/calls"
files=$(grep -oE '[^ ]+\.c( |$)' "$work/calls" | wc -l)
((files > 500)) || { echo "FAILED: only $files files in $build/compile_commands.json"; exit 1; }

failures=0
look() { # COMPILER
    if ! command -v "$1" >/dev/null; then
        echo "$1 is not installed: left out"
        return
    fi
    sed "s/^/$1 -fsyntax-only -Werror -Wpedantic /" "$work/calls" >"$work/$1"
    if (cd "$build" && xargs -d '\n' -P "$(nproc 2>/dev/null || echo 2)" -n 1 bash -c <"$work/$1") >"$work/said" 2>&1; then
        echo "$1: no warning in $files files"
    else
        echo "FAILED: $1: $(grep -cE '(error|warning):' "$work/said") warnings and errors in $files files"
        grep -E '(error|warning):' -A 2 "$work/said" | head -n 40
        failures=$((failures + 1))
    fi
}
look gcc
look clang
exit $((failures > 0))
