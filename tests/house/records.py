"""Is each figure in the summaries of the benchmarks in their records? If the heading of a section in a page of
tests/bench links CSV files, the tables of that section have figures from them: each number in the body of such a
table has to be, rounded to the printed digits, a number of these files. Prints those that are not, pages of 150 lines
and more, and records that no page names."""
import csv
import os
import re
import sys

NUMBER = re.compile(r"(?<![\w.])\d+(?:,\d{3})*(?:\.\d+)?(?:e[+-]?\d+)?(?![\w])")
ORDINARY = re.compile(r"\d+(?:,\d{3})*(?:\.\d+)?(?:e[+-]?\d+)?")


def numbers(text):
    return [found.replace(",", "") for found in ORDINARY.findall(text)]


def is_one_of(shown, recorded):
    """Is the recorded number, rounded to the decimals that are shown, the one that is shown?"""
    if "e" in shown:
        return any(float(shown) == float(each) for each in recorded)
    decimals = len(shown.partition(".")[2])
    return any(abs(float(each) - float(shown)) <= 0.5000001 * 10.0**-decimals for each in recorded)


def sections(text):
    """(heading, body) of each section, which begins with a line of two or three #."""
    parts = re.split(r"^(##+ .*)$", text, flags=re.M)
    return list(zip(parts[1::2], parts[2::2]))


def table_bodies(body):
    """The lines of tables, without their heads."""
    lines = body.split("\n")
    heads = {k - 1 for k, line in enumerate(lines) if re.fullmatch(r"\|[-:| ]+\|", line)}
    return [line for k, line in enumerate(lines) if line.startswith("|") and k not in heads and k - 1 not in heads]


def check(folder):
    wrong, named, compared = [], set(), 0
    for page in sorted(file for file in os.listdir(folder) if file.endswith(".md")):
        with open(os.path.join(folder, page), encoding="utf-8") as file:
            text = file.read()
        if text.count("\n") >= 150:
            wrong.append("%s has %d lines" % (page, text.count("\n")))
        named |= set(re.findall(r"\(([a-z]+/\w+[.]csv)\)", text))
        for heading, body in sections(text):
            files = re.findall(r"\(([a-z]+/\w+[.]csv)\)", heading)
            recorded = []
            for name in files:
                with open(os.path.join(folder, name), newline="", encoding="utf-8") as file:
                    recorded += [number for row in csv.reader(file) for cell in row for number in numbers(cell)]
            for line in table_bodies(body) if files else []:
                for number in (found.replace(",", "") for found in NUMBER.findall(line)):
                    compared += 1
                    if not is_one_of(number, recorded):
                        wrong.append("%s: %s is not in %s: %s" % (page, number, ", ".join(files), line))
    records = {os.path.join(room, file) for room in os.listdir(folder) if os.path.isdir(os.path.join(folder, room))
               for file in os.listdir(os.path.join(folder, room)) if file.endswith(".csv")}
    wrong += ["%s is linked by no page" % name for name in sorted(records - named)]
    return wrong, compared


if __name__ == "__main__":
    found, count = check(sys.argv[1])
    print("\n".join(found + (["%d figures compared" % count] if not found else [])))
    sys.exit(bool(found))
