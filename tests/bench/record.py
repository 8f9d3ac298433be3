"""Writes the Markdown tables that a benchmark prints as CSV, one file for each table in the order of the names.

    bash tests/bench/peers.sh | python3 tests/bench/record.py tests/bench/results sums instructions pairs towns

The input is passed on to stdout. A table with the name `-` is left out. Thousands separators are removed from
numbers. A last column is added with the commit that is checked out."""
import csv
import os
import re
import subprocess
import sys


def tables(lines):
    """The tables of a page as lists of rows of cells, without the line that divides head and body."""
    found, inside = [], False
    for line in lines:
        if not line.startswith("|"):
            inside = False
            continue
        cells = [cell.strip().strip("`") for cell in line.strip().strip("|").split("|")]
        if not inside:
            found.append([])
            inside = True
        if not all(re.fullmatch(":?-+:?", cell) for cell in cells):
            found[-1].append([re.sub(r"(?<=\d),(?=\d{3}\b)", "", cell) for cell in cells])
    return found


def main(folder, *names):
    lines = []
    for line in sys.stdin:
        sys.stdout.write(line)
        lines.append(line)
    found = tables(lines)
    if len(found) != len(names):
        sys.exit("record.py: %d tables for %d names: nothing is written" % (len(found), len(names)))
    commit = subprocess.run(["git", "-C", os.path.dirname(os.path.abspath(__file__)), "describe", "--always", "--dirty"],
                            capture_output=True, text=True, check=True).stdout.strip()
    os.makedirs(folder, exist_ok=True)
    for name, table in zip(names, found):
        if name != "-":
            with open(os.path.join(folder, name + ".csv"), "w", newline="", encoding="utf-8") as file:
                csv.writer(file, lineterminator="\n").writerows(row + [commit if k else "commit"] for k, row in enumerate(table))


if __name__ == "__main__":
    main(*sys.argv[1:])
