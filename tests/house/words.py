"""Measures the language of comments and pages, in counts per 1,000 words:

    python3 words.py ROOT [--rooms] [--show KIND]

There are four counts, each with its limit (LIMITS). `person`: who, whom, nobody, he and him, which are for people and
not for bodies, pairs and files. `so many`: so many, so much and so often, in place of which the name of a variable is
clearer. `of which`: of which and of whom. `long`: sentences of more than 40 words. Comments are those of C, Python
(docstrings too), shell and CMake. Pages are Markdown, without their code, and the man page; in pages people may be
`who`, and the limit for long sentences is higher. --rooms prints the counts of each folder; --show prints the places
of one kind.
"""
import argparse
import io
import pathlib
import re
import subprocess
import sys
import tokenize

LONG = 40
COUNTED = {
    "person": re.compile(r"\b(who|whom|nobody|he|him)\b", re.I),
    "so many": re.compile(r"\bso (many|much|often)\b", re.I),
    "of which": re.compile(r"\bof (which|whom)\b", re.I),
}
PAGE_PERSON = re.compile(r"\b(whom|nobody|he|him)\b", re.I)
LIMITS = {
    "comments": {"person": 0.2, "so many": 0.2, "of which": 0.3, "long": 1.2},
    "pages": {"person": 0.2, "so many": 0.2, "of which": 0.3, "long": 3.0},
}
WORD = re.compile(r"[A-Za-z][A-Za-z'’-]*")
C_TOKEN = re.compile(r"""//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'""", re.S)
SENTENCE_END = re.compile(r"(?<=[.!?])[)\"'*_`]*\s+(?=[A-Z`(\"*_\d])")
ROW = re.compile(r"\S {2,}\S")  # a row of a table or a drawing in a comment: it has several blanks within the line
ITEM = re.compile(r"\s*(?:[-*+]|\d+\.)\s|\s*#+ |\s*\|")


def c_comments(text):
    """(line, text) of each comment; consecutive // lines are one comment."""
    last = None
    for match in C_TOKEN.finditer(text):
        token = match.group()
        if token[0] in "\"'":
            continue
        line = text.count("\n", 0, match.start()) + 1
        if token.startswith("//"):
            if last and last[0] + last[1].count("\n") + 1 == line:
                last = (last[0], last[1] + "\n" + token[2:])
                continue
            if last:
                yield last
            last = (line, token[2:])
        else:
            if last:
                yield last
                last = None
            yield line, re.sub(r"\n\s*\* ?", "\n", token[2:-2])
    if last:
        yield last


def hash_comments(text):
    """(line, text) of the comments of shell and CMake; consecutive comment lines are one comment."""
    run, first = [], 0
    for number, line in enumerate(text.split("\n"), 1):
        stripped = line.strip()
        if stripped.startswith("#") and not stripped.startswith(("#!", "# shellcheck")):
            if not run:
                first = number
            run.append(stripped.lstrip("#"))
        else:
            if run:
                yield first, "\n".join(run)
            run = []
    if run:
        yield first, "\n".join(run)


def python_comments(text):
    yield from hash_comments(text)
    try:
        tokens = list(tokenize.generate_tokens(io.StringIO(text).readline))
    except (tokenize.TokenError, IndentationError):
        return
    before = tokenize.NEWLINE
    for token in tokens:
        if token.type == tokenize.STRING and before in (tokenize.NEWLINE, tokenize.INDENT, tokenize.NL, tokenize.ENCODING):
            yield token.start[0], token.string.strip("rRbB\"'")
        before = token.type


def markdown(text):
    """(line, text) of a page's paragraphs, items and rows, without its code."""
    text = re.sub(r"^( *)```.*?^ *```", lambda m: "\n" * m.group().count("\n"), text, flags=re.S | re.M)
    text = re.sub(r"<!--.*?-->", lambda m: "\n" * m.group().count("\n"), text, flags=re.S)
    text = "\n".join("" if line.startswith("    ") else line for line in text.split("\n"))
    yield 1, re.sub(r"`[^`\n]*`", "code", text)


def manual(text):
    lines = ["" if line.startswith((".", "'")) and not re.match(r"\.(B|I|BR|IR|RB) ", line) else re.sub(r"^\.[A-Z]+ ", "", line)
             for line in text.split("\n")]
    yield 1, "\n".join(lines)


READERS = {".c": c_comments, ".h": c_comments, ".cpp": c_comments, ".py": python_comments, ".sh": hash_comments,
           ".cmake": hash_comments, ".txt": hash_comments, ".md": markdown, ".1": manual}


def sentences(line, text):
    """(line, sentence) of a comment or a page: blank lines, items and rows end a sentence, too."""
    run, first = [], line
    for offset, part in enumerate(text.split("\n") + [""]):
        if not part.strip() or ITEM.match(part) or ROW.search(part):
            if run:
                yield from split(first, "\n".join(run))
            run = []
        if part.strip():
            if not run:
                first = line + offset
            run.append(part)


def split(line, text):
    at = 0
    for match in SENTENCE_END.finditer(text):
        yield line + text.count("\n", 0, at), text[at:match.start()]
        at = match.end()
    yield line + text.count("\n", 0, at), text[at:]


def files_of(root):
    """The files under version control, or all files if there is no version control."""
    listed = subprocess.run(["git", "-C", root, "ls-files", "-z"], capture_output=True, check=False)
    names = listed.stdout.decode().split("\0") if listed.returncode == 0 else [
        str(path.relative_to(root)) for path in pathlib.Path(root).rglob("*") if "build" not in path.parts]
    for name in sorted(filter(None, names)):
        path = pathlib.Path(root, name)
        if path.suffix in READERS and path.is_file() and (path.suffix != ".txt" or path.name == "CMakeLists.txt"):
            yield name, path


def count(root):
    """{form: {room: {kind: count, "words": n}}}, and every place found: (kind, name, line, text)."""
    counts, places = {"comments": {}, "pages": {}}, []
    for name, path in files_of(root):
        form = "pages" if path.suffix in (".md", ".1") else "comments"
        room = counts[form].setdefault(name.rpartition("/")[0] or ".", dict.fromkeys(("words", *LIMITS[form]), 0))
        for line, text in READERS[path.suffix](path.read_text(encoding="utf-8")):
            for at, sentence in sentences(line, text):
                words = len(WORD.findall(sentence))
                room["words"] += words
                found = {kind: len((PAGE_PERSON if form == "pages" and kind == "person" else rule).findall(sentence))
                         for kind, rule in COUNTED.items()}
                found["long"] = int(words > LONG)
                for kind, times in found.items():
                    room[kind] += times
                    if times:
                        places.append((kind, name, at, " ".join(sentence.split())))
    return counts, places


def row(name, room):
    per = 1000 / max(room["words"], 1)
    return f"{name:44} {room['words']:7} " + " ".join(f"{kind} {room[kind] * per:.2f}" for kind in COUNTED | {"long": 0})


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("root")
    parser.add_argument("--rooms", action="store_true")
    parser.add_argument("--show", choices=(*COUNTED, "long"))
    parser.add_argument("--under", default="")
    options = parser.parse_args()
    counts, places = count(options.root)
    for kind, name, line, text in places:
        if kind == options.show and name.startswith(options.under):
            print(f"{name}:{line}: {text}")
    wrong = 0
    for form, rooms in counts.items():
        if options.rooms:
            for name, room in sorted(rooms.items()):
                if name.startswith(options.under):
                    print(row(f"{form} {name}", room))
        total = {key: sum(room[key] for room in rooms.values()) for key in ("words", *LIMITS[form])}
        print(row(form, total))
        if total["words"] < 1000:
            print(f"{form}: hardly a word was found")
            wrong += 1
        for kind, limit in LIMITS[form].items():
            if total[kind] * 1000 > limit * total["words"]:
                print(f"{form}: {kind}: {total[kind] * 1000 / total['words']:.2f} per 1,000 words, at most {limit} are allowed")
                wrong += 1
    return int(wrong > 0)


sys.exit(main())
