#!/usr/bin/env bash
# Does the second compiler (clang if the build uses gcc, gcc if it uses clang) accept all C files of the project without
# a warning, and do the unit tests pass in its build? That build is inside the one that runs the tests. In continuous
# integration warnings of the first compiler are errors, too (SUNDER_WERROR).
#
# Code is made for the library and its unit tests only. All other files are parsed once, with the flags of the first
# target that they belong to.
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
jobs=$(nproc 2>/dev/null || echo 2)
cmake -S "$source" -B "$second_build" -G "$generator" -D CMAKE_C_COMPILER=$second -D CMAKE_BUILD_TYPE=Release \
    -D SUNDER_WERROR=ON >"$second_build/log" 2>&1 || failed
grep -q -- '-Wpedantic .*-Werror' "$second_build/compile_commands.json" || { echo "FAILED: warnings are not errors"; exit 1; }

mapfile -t programs < <(cd "$source/tests" && find unit -name 'test_*.c' | # unit/number/test_big.c: test_number_big
    sed 's|^unit/||; s|^\(.*/\)test_|test_\1|; s|/|_|g; s|\.c$||')
keep_going=(-k) # every file is compiled, even if others have warnings
if [[ $generator == Ninja* ]]; then keep_going=(-k 0); fi
cmake --build "$second_build" -j "$jobs" --target "${programs[@]}" -- "${keep_going[@]}" >"$second_build/log" 2>&1 || failed

# A line for each other file: the command that compiles it, without the flags for output. Files that the build makes are
# left out: they are tables of text and numbers.
python3 - "$second_build" >"$second_build/commands" <<'PYTHON'
import json
import os
import shlex
import sys

build = sys.argv[1]
commands = {}
with open(f"{build}/compile_commands.json", encoding="utf-8") as file:
    entries = json.load(file)
for entry in entries:
    words = shlex.split(entry["command"])
    at = words.index("-o")
    compiled = os.path.exists(os.path.join(entry["directory"], words[at + 1]))
    del words[at:at + 2]
    words.remove("-c")
    if entry["file"].endswith(".c") and not entry["file"].startswith(build + "/"):
        command = None if compiled else shlex.join(words + ["-fsyntax-only"])
        if commands.setdefault(entry["file"], command):
            commands[entry["file"]] = command
for path, command in sorted(commands.items()):
    print(command or "true")
PYTHON
files=$(wc -l <"$second_build/commands")
((files > 800)) || { echo "FAILED: only $files files"; exit 1; }
(cd "$second_build" && xargs -P "$jobs" -d '\n' -n 1 sh -c <commands >log 2>&1) || failed
echo "$second: no warning in $files files; $(grep -cx true "$second_build/commands") are compiled, the others parsed"

cd "$second_build"
ctest --output-on-failure -j "$jobs" -L '^unit$'
