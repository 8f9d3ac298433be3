#!/usr/bin/env python3
"""Functions of a header that its reference lacks: described.py HEADER PAGE prints a line for each; status 1 if there are any.

A function belongs to the reference if the page by Doxygen names it and, where the header has a comment directly before
it, shows the first words of that comment. The words come from the header, so that no text of it is repeated here.
"""
import html
import re
import sys

DECLARATION = re.compile(r"^(?:SUNDER_API|SUNDER_EXPERIMENTAL|static inline)\b[^;{]*?\b(sunder_[a-z_0-9]*)\s*\(", re.M)
COMMENT = re.compile(r"/\*\*?((?:(?!\*/).)*)\*/\s*$", re.S)
WORDS = 6


def words(text):
    """Sequences of letters and digits, since Doxygen changes punctuation and links."""
    return re.findall(r"\w+", text)


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        header = file.read()
    with open(sys.argv[2], encoding="utf-8") as file:
        page = html.unescape(re.sub(r"<[^>]*>", " ", file.read()))
    shown = " ".join(words(page))
    lacking, described = [], 0
    for declaration in DECLARATION.finditer(header):
        name = declaration.group(1)
        if name not in shown:
            lacking.append(name)
            continue
        comment = COMMENT.search(header[:declaration.start()])
        if comment:
            described += 1
            first = " ".join(words(comment.group(1))[:WORDS])
            if first not in shown:
                lacking.append(f"{name}: {first} ...")
    for line in lacking:
        print(line)
    sys.exit(1 if lacking or not described else 0)


if __name__ == "__main__":
    main()
