#!/usr/bin/env python3
"""Broken links among the pages of a folder: links.py FOLDER prints "PAGE: TARGET" for each; status 1 if there are
any.

Checks href and src in all .html files: the file has to exist and, if a #part is named, contain an element with that
id or name. Links to the network are not checked.
"""
import os
import sys
from html.parser import HTMLParser
from urllib.parse import unquote


class Page(HTMLParser):
    def __init__(self):
        super().__init__()
        self.targets, self.parts = [], {""}

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value:
                self.targets.append(value)
            elif name in ("id", "name") and value:
                self.parts.add(value)


def main():
    top = os.path.realpath(sys.argv[1])
    pages = {}
    for folder, _, names in os.walk(top):
        for name in names:
            if name.endswith(".html"):
                path = os.path.join(folder, name)
                pages[path] = Page()
                with open(path, encoding="utf-8") as file:
                    pages[path].feed(file.read())
    dead, asked = [], 0
    for path, page in pages.items():
        for target in page.targets:
            if target.split(":", 1)[0] in ("http", "https", "mailto", "javascript", "data"):
                continue
            asked += 1
            name, _, part = unquote(target).partition("#")
            there = os.path.realpath(os.path.join(os.path.dirname(path), name)) if name else path
            inside = there == top or there.startswith(top + os.sep)
            if not inside or not os.path.isfile(there) or (there in pages and part not in pages[there].parts):
                dead.append(f"{os.path.relpath(path, top)}: {target}")
    print("\n".join(sorted(set(dead)) or [f"{len(pages)} pages, {asked} links"]))
    return 1 if dead or not asked else 0


sys.exit(main())
