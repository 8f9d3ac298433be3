#!/usr/bin/env python3
"""Runs a page of the documentation as it is written, as a reader would: in one shell, from one folder.

    guide.py PAGE.md FOLDER              runs it in FOLDER, which is empty; status 1 and the differences if the output differs
    guide.py PAGE.md FOLDER --record     the same, and writes the output into the page

Fenced blocks of `sh` are run, one after another, by one bash -eu (with pipefail), so that a `cd` or an `export` holds
for later blocks. A block of `text` that follows has the expected output, of standard output and standard error. A
block of another language is a file: the last word in backticks before it is its name. Times are not compared: if a
line ends with "1.29 s", only the text before that is compared. <address of the repository> stands for SUNDER_SOURCE.

An HTML comment before a block, invisible to the reader, says how the test differs from what the reader does:

    <!-- first: COMMANDS -->       run before the block, in the same shell: prepares data in place of the reader's own
    <!-- status 3 -->              commands of the block may end with status 3, since the block shows conflicts
    <!-- needs: COMMAND -->        the block is left out, with a message, if the command fails
    <!-- not run: REASON -->       the block is left out, with a message
"""
import difflib
import functools
import os
import re
import subprocess
import sys


def blocks_of(lines):
    """For each fenced block: (language, first line, line after the last, name of the file, comments before it)."""
    blocks, start, prose, comments = [], None, "", []
    for at, line in enumerate(lines):
        if line.startswith("```"):
            if start is None:
                start, language = at + 1, line[3:].strip()
            else:
                names = re.findall(r"`([^`]+)`", prose)
                blocks.append((language, start, at, names[-1] if names else None, comments))
                start, comments = None, []
        elif start is None:
            told = re.fullmatch(r"<!-- (first: .*|status 3|needs: .*|not run: .*) -->", line)
            comments += [told.group(1)] if told else []
            prose = prose + " " + line if line.strip() and lines[at - 1].strip() else line or prose
    if start is not None:
        sys.exit(f"line {start}: the block does not end")
    return blocks


def without_seconds(text):
    return re.sub(r"[0-9.]+ s$", "... s", text, flags=re.M)


@functools.lru_cache(maxsize=None)
def succeeds(command):
    return subprocess.run(["bash", "-c", command], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                          check=False).returncode == 0


def reason_to_leave_out(comments):
    """The reason why a block is not run; empty if it is run."""
    for each in comments:
        if each.startswith("not run: "):
            return each[len("not run: "):]
        if each.startswith("needs: ") and not succeeds(each[len("needs: "):]):
            return "it needs " + each[len("needs: "):]
    return ""


def script_of(blocks, folder):
    """The script of one shell: blocks are read from files in .blocks, by number, and the output of each is written to
    another file."""
    script = ["set -euo pipefail"]
    for number, (language, body, name, comments) in enumerate(blocks):
        file = os.path.join(folder, ".blocks", str(number))
        if language == "text" or reason_to_leave_out(comments):
            continue
        with open(file, "w", encoding="utf-8") as written:
            written.write(body.replace("<address of the repository>", os.environ["SUNDER_SOURCE"]))
        if language != "sh":
            script.append(f"cp '{file}' '{name}'")
            continue
        script += [each[len("first: "):] for each in comments if each.startswith("first: ")]
        if "status 3" in comments:
            script.append("set +e; trap 'status=$?; [ $status -eq 3 ] || exit $status' ERR")
        script.append(f". '{file}' >'{file}.said' 2>&1")
        if "status 3" in comments:
            script.append("trap - ERR; set -e")
    return "\n".join(script)


def said_in(folder, number):
    """The output of a block; None if it was not run."""
    file = os.path.join(folder, ".blocks", f"{number}.said")
    if not os.path.exists(file):
        return None
    with open(file, encoding="utf-8") as opened:
        return opened.read()


def parts_of(page, lines):
    """The blocks with their text, and their lines; ends the program if a file has no name."""
    parts, places = [], []
    for language, start, end, name, comments in blocks_of(lines):
        if language not in ("sh", "text") and (not name or os.path.basename(name) != name):
            sys.exit(f"{page}:{start}: a file without a name")
        if reason_to_leave_out(comments):
            print(f"{page}:{start + 1}: left out: {reason_to_leave_out(comments)}")
        parts.append((language, "\n".join(lines[start:end]) + "\n", name, comments))
        places.append((start, end))
    return parts, places


def main():
    page, folder, record = sys.argv[1], os.path.abspath(sys.argv[2]), "--record" in sys.argv[3:]
    with open(page, encoding="utf-8") as file:
        lines = file.read().split("\n")
    parts, places = parts_of(page, lines)
    if not any(language == "sh" for language, *_ in parts):
        sys.exit(f"{page}: there is nothing to run")
    os.mkdir(os.path.join(folder, ".blocks"))
    run = subprocess.run(["bash", "-c", script_of(parts, folder)], cwd=folder, stdin=subprocess.DEVNULL,
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, encoding="utf-8")
    said = [said_in(folder, number) for number in range(len(parts))]
    if run.returncode:
        last = max((number for number, text in enumerate(said) if text is not None), default=0)
        print(f"{page}:{places[last][0] + 1}: status {run.returncode}\n{said[last] or ''}{run.stdout}", end="")
        return 1
    trouble, printed_at = 0, []
    for number, (language, wanted, _, _) in enumerate(parts):
        start, end = places[number]
        if language != "text":
            continue
        if number == 0 or parts[number - 1][0] != "sh":
            print(f"{page}:{start}: an output without a command before it")
            trouble = 1
            continue
        if said[number - 1] is None:
            continue
        found = without_seconds(said[number - 1])
        printed_at.append((start, end, found))
        if without_seconds(wanted) != found and not record:
            print(f"{page}:{start}: prints something else")
            sys.stdout.writelines(difflib.unified_diff(without_seconds(wanted).splitlines(True), found.splitlines(True),
                                                       "the page", "the program"))
            trouble = 1
    if record:
        for start, end, said in reversed(printed_at):
            lines[start:end] = said.rstrip("\n").split("\n")
        with open(page, "w", encoding="utf-8") as file:
            file.write("\n".join(lines))
    return trouble


sys.exit(main())
