#!/usr/bin/env python3
"""Runs a page of the guide as it is written.

    guide.py PAGE.md FOLDER              runs it in FOLDER, which is empty; status 1, and what differs, if it is not as it says
    guide.py PAGE.md FOLDER --record     the same, and puts into the page what was printed

A fenced block of `sh` is given to bash -eu (with pipefail), block after block in the same folder; a block of `text` that comes next says
what it prints, on standard output and standard error. A block of another language is a file: the last word in backticks
before it is its name. Seconds are no result: of "1.29 s" at the end of a line only the words before it are compared.
"""
import difflib
import os
import re
import subprocess
import sys


def blocks_of(lines):
    """(language, first line, line after the last, name of the file) of each fenced block."""
    blocks, start, prose = [], None, ""
    for at, line in enumerate(lines):
        if line.startswith("```"):
            if start is None:
                start, language = at + 1, line[3:].strip()
            else:
                names = re.findall(r"`([^`]+)`", prose)
                blocks.append((language, start, at, names[-1] if names else None))
                start = None
        elif start is None:
            prose = prose + " " + line if line.strip() and lines[at - 1].strip() else line or prose
    if start is not None:
        sys.exit(f"line {start}: the block does not end")
    return blocks


def without_seconds(text):
    return re.sub(r"[0-9.]+ s$", "... s", text, flags=re.M)


def main():
    page, folder, record = sys.argv[1], sys.argv[2], "--record" in sys.argv[3:]
    with open(page, encoding="utf-8") as file:
        lines = file.read().split("\n")
    blocks = blocks_of(lines)
    if not any(language == "sh" for language, *_ in blocks):
        sys.exit(f"{page}: there is nothing to run")
    trouble, printed_at = 0, []
    for number, (language, start, end, name) in enumerate(blocks):
        body = "\n".join(lines[start:end]) + "\n"
        if language == "sh":
            run = subprocess.run(["bash", "-euo", "pipefail", "-c", body], cwd=folder, stdin=subprocess.DEVNULL,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, encoding="utf-8")
            if run.returncode:
                print(f"{page}:{start + 1}: status {run.returncode}\n{run.stdout}", end="")
                return 1
            follows = blocks[number + 1] if number + 1 < len(blocks) else None
            if follows and follows[0] == "text":
                said = without_seconds(run.stdout)
                printed_at.append((follows[1], follows[2], said))
                wanted = "\n".join(lines[follows[1]:follows[2]]) + "\n"
                if without_seconds(wanted) != said and not record:
                    print(f"{page}:{start + 1}: prints something else")
                    sys.stdout.writelines(difflib.unified_diff(without_seconds(wanted).splitlines(True),
                                                               said.splitlines(True), "the page", "the program"))
                    trouble = 1
        elif language == "text":
            if number == 0 or blocks[number - 1][0] != "sh":
                print(f"{page}:{start}: no command comes before what is printed")
                trouble = 1
        else:
            if not name or os.path.basename(name) != name:
                sys.exit(f"{page}:{start}: a file without a name")
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(body)
    if record:
        for start, end, said in reversed(printed_at):
            lines[start:end] = said.rstrip("\n").split("\n")
        with open(page, "w", encoding="utf-8") as file:
            file.write("\n".join(lines))
    return trouble


sys.exit(main())
