"""Every kind of path that an option or operand takes, at lengths on both sides of the sizes of buffers.

    long_paths.py CALLS DIR     CALLS: tests/calls, which calls the program. DIR holds in.gpkg and wkt. Failures are
                                printed, a line each, then the number of calls and the number of those that succeeded

A call does the same as with a short path, or it ends with 1 or 2 and one sentence. It never makes, changes or opens
another file: files of the same names are in the current directory, which a path that became empty would refer to."""

import os
import subprocess
import sys

LENGTHS = (255, 256, 511, 512, 1023, 1024, 1900, 1901, 2047, 2048, 4000, 4095, 4096, 5000)
GDAL_TAKES = 1900 # base/path.h
SQLITE_TAKES = 400 # SQLite's paths have at most 512 bytes, including the suffixes that it appends
# A kind of path: the file's name, the call ({} is the path), and the longest path with which the call has to succeed.
WRITTEN = {
    "gpkg": ("o.gpkg", "separate in.gpkg {}", SQLITE_TAKES),
    "fgb": ("o.fgb", "separate in.gpkg {} --layers main", GDAL_TAKES),
    "shp": ("o.shp", "separate in.gpkg {}", GDAL_TAKES),
    "geojson": ("o.geojson", "buffer in.gpkg {} --shape square:1", GDAL_TAKES),
    "csv": ("o.csv", "check in.gpkg {}", GDAL_TAKES),
    "overwrite": ("w.gpkg", "separate in.gpkg {} --overwrite", SQLITE_TAKES),
    "stats": ("s.json", "check in.gpkg --stats {}", 4000),
    "report": ("r.html", "separate in.gpkg /vsimem/x.fgb --layers main --report {}", 4000),
    "proof": ("p.jsonl", "separate in.gpkg /vsimem/x.fgb --layers main --proof {}", 4000),
    "log": ("l.txt", "check in.gpkg --log {}", 4000),
    "plan": ("q.plan", "plan in.gpkg {} --shards 1", 4000),
}
READ = {
    "input": ("in.fgb", "check {}", GDAL_TAKES),
    "sqlite": ("in.gpkg", "check {}", SQLITE_TAKES),
    "barrier": ("in.fgb", "check in.gpkg --barrier {}", GDAL_TAKES),
    "operand": ("wkt", "pair @{} square:1", 4000),
    "shape": ("wkt", "buffer in.gpkg /vsimem/x.fgb --shape @{}", 4000),
    "robot": ("wkt", "route in.fgb --robot @{} --from 90,90 --to 91,91", 4000),
}


def parts_of(length, name, tag):
    """Nested directories that form, together with the name, a path of the given number of bytes."""
    parts, left = [tag], length - len(tag) - 1 - len(name)
    while left > 0:
        n = left if left <= 101 else min(100, left - 2)
        if left == 1:
            parts[-1] += "d"
            break
        parts.append("d" * (n - 1))
        left -= n
    path = "/".join(parts + [name])
    assert len(path) == length, (len(path), length)
    return parts, path


def descend(parts):
    """Makes the directories, and returns the innermost one, opened."""
    at = os.open(".", os.O_RDONLY)
    for part in parts:
        try:
            os.mkdir(part, dir_fd=at)
        except FileExistsError:
            pass
        inner = os.open(part, os.O_RDONLY, dir_fd=at)
        os.close(at)
        at = inner
    return at


def copy(source, directory, name):
    to = os.open(name, os.O_WRONLY | os.O_CREAT, 0o644, dir_fd=directory)
    with open(source, "rb") as file:
        os.write(to, file.read())
    os.close(to)


def content(name):
    if os.path.isdir(name):
        return sorted(os.listdir(name))
    with open(name, "rb") as file:
        return file.read()


def prepare():
    cases = []
    for kinds, reads in ((WRITTEN, False), (READ, True)):
        for kind, (name, call, takes) in kinds.items():
            for length in LENGTHS:
                tag = f"t{len(cases)}"
                parts, path = parts_of(length, name, tag)
                directory = descend(parts)
                if reads:
                    copy(name, directory, name)
                if kind == "overwrite":
                    copy("in.gpkg", directory, name)
                cases.append((kind, length, path, call.format(path), takes, reads, directory, set(os.listdir(directory)), name))
    return cases


def judge(case, status, said):
    kind, length, path, call, takes, reads, directory, before, name = case
    here, after = f"{kind}, {length} bytes", set(os.listdir(directory))
    if status in (0, 3):
        if not reads and name not in after:
            yield f"{here}: done, and there is no such file"
        if not reads and any(n.startswith(".") or ".sunder-" in n for n in after):
            yield f"{here}: left behind {after}"
        if length > 4095:
            yield f"{here}: done, and no file can have such a path"
    else:
        if status not in (1, 2):
            yield f"{here}: status {status}: {said[:300]}"
        if said.count("sunder: error: ") != 1:
            yield f"{here}: no sentence: {said[:300]}"
        if after != before:
            yield f"{here}: failed, and made {after - before}"
        if length <= takes:
            yield f"{here}: refused: {said[:300]}"


def main(calls, where):
    os.chdir(where)
    baits = {name: None for name, _, _ in list(WRITTEN.values()) + list(READ.values())}
    for name in baits:
        if not os.path.exists(name):
            with open(name, "w") as file:
                file.write("bait\n")
        baits[name] = content(name)
    cases = prepare()
    top = set(os.listdir("."))
    asked = "".join(case[3] + "\n" for case in cases)
    answers = subprocess.run([calls], input=asked, capture_output=True, text=True, check=True).stdout.splitlines()
    assert len(answers) == len(cases)
    done = 0
    for case, answer in zip(cases, answers):
        status, said = answer.split("\t", 1)
        done += status in ("0", "3")
        for wrong in judge(case, int(status), said):
            print(wrong)
    for name, was in baits.items():
        if not os.path.exists(name) or content(name) != was:
            print(f"{name} in the current directory was changed")
    if set(os.listdir(".")) != top:
        print(f"made in the current directory: {set(os.listdir('.')) - top}")
    print(f"{len(cases)} calls, {done} done", file=sys.stderr)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
