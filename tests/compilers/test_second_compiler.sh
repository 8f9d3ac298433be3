#!/usr/bin/env bash
# Does the second compiler (clang if the build uses gcc, gcc if it uses clang) accept the C files of the program, of its
# tests and of the benchmarks without a warning? Each is parsed once, with the flags of the first target that it belongs
# to. The library and its unit tests are not among them: invariants/test_invariants compiles these with the second
# compiler.
# In continuous integration warnings of the first compiler are errors, too (SUNDER_WERROR).
set -euo pipefail
source=${SUNDER_SOURCE:?}
build=${SUNDER_BUILD:?}
skip() { echo "skipped: $1"; exit 77; }
first=$(sed -n 's/^CMAKE_C_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt" | head -n 1)
second=clang
if "$first" -dM -E -x c /dev/null | grep -q '__clang__'; then second=gcc; fi
command -v $second >/dev/null || skip "$second is not installed"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# A line for each file: the command that compiles it, without the flags for output. Files that the build makes are left
# out: they are tables of text and numbers.
python3 - "$source" "$build" $second >"$work/commands" <<'PYTHON'
import json
import re
import shlex
import sys

source, build, second = sys.argv[1:]
compiled = re.compile(re.escape(source) + "/(src|tests/(support|unit|golden))/")
commands = {}
with open(f"{build}/compile_commands.json", encoding="utf-8") as file:
    entries = json.load(file)
for entry in entries:
    path, words = entry["file"], shlex.split(entry["command"])
    if path.endswith(".c") and not path.startswith(build + "/") and not compiled.match(path):
        at = words.index("-o")
        del words[at:at + 2]
        words.remove("-c")
        commands.setdefault(path, shlex.join([second] + words[1:] + ["-Werror", "-fsyntax-only"]))
for path, command in sorted(commands.items()):
    print(command)
PYTHON
files=$(wc -l <"$work/commands")
((files > 250)) || { echo "FAILED: only $files files"; exit 1; }
status=0
(cd "$build" && xargs -P "$(nproc 2>/dev/null || echo 2)" -d '\n' -n 1 sh -c <"$work/commands" >"$work/said" 2>&1) || status=1
if ((status)); then
    echo "FAILED: $second: $(grep -cE '(error|warning):' "$work/said") warnings and errors"
    grep -E '(error|warning):' -A 2 "$work/said" | head -n 40 || tail -n 20 "$work/said"
    exit 1
fi
echo "$second: no warning in $files files"
