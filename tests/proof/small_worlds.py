"""Small worlds by seed: two to six buildings in each other's way, perhaps one or two barriers, options drawn at random.

    python3 small_worlds.py SEED
        writes SEED.csv and, if there are barriers, SEED.road.csv, both for layer() of tests/cli/lib.sh; prints the options
        of separate, one word a line
    python3 small_worlds.py --search SUNDER FIRST LAST
        prints for each kind of statement (statements.py) the seed of the shortest line that makes one

The proofs of the seeds in forged_runs.sh together make all kinds of statements. If a change of the program's search
removes one, the second call finds other seeds."""
import json
import os
import subprocess
import sys
import tempfile
from math import cos, sin
from random import Random

from statements import statements_of

LONGEST = 30000  # characters of a line


def corners_of(r, x, y, least, most):
    """Of a rectangle, a triangle, or an L, in any direction."""
    a, w, h = r.uniform(0, 6), r.uniform(least, most), r.uniform(least, most)
    cut = [(w, h / 3), (w / 3, h / 3), (w / 3, h)] if r.random() < 0.15 else [(w, h)]
    corners = [(0, 0), (w, 0), *cut, (0, h)] if r.random() < 0.6 else [(0, 0), (w, 0), (w / 2, h)]
    return ",".join(f"{x + cos(a) * u - sin(a) * v:.1f} {y + sin(a) * u + cos(a) * v:.1f}" for u, v in corners)


def barrier_of(r, wide):
    if r.random() < 0.2:
        return f"POLYGON(({corners_of(r, r.uniform(-3, wide), r.uniform(-3, wide), 3, 12)}))"
    x, y = r.uniform(0, wide), r.uniform(0, wide)
    a = r.uniform(0, 6)
    places = [(x - 20 * cos(a), y - 20 * sin(a)), (x, y), (x + 20 * cos(a + r.gauss(0, .5)), y + 20 * sin(a + r.gauss(0, .5)))]
    if r.random() < 0.6:
        del places[1]
    return "LINESTRING(" + ",".join(f"{u:.1f} {v:.1f}" for u, v in places) + ")"


def options_of(r):
    words = ["--gap", r.choice(("0", "0.5", "1", "2"))]
    if r.random() < 0.85:
        words += ["--max-shift", r.choice(("0.5", "1", "2", "4"))]
    if r.random() < 0.5:
        words += ["--no-blocks"]
    elif words[1] == "2" and r.random() < 0.5:
        words += ["--touch-tolerance", r.choice(("0.5", "1"))]
    if r.random() < 0.3:
        words += ["--allow-jumps"]
    if r.random() < 0.3:
        words += ["--contained", r.choice(("separate", "ignore"))]
    if r.random() < 0.2:
        words += ["--effort", "0"]
    if r.random() < 0.25:
        words += ["--fixed-where", "w = '3'"]
    return words


def write(path, rows):
    with open(path, "w", encoding="utf-8") as file:
        file.write("WKT,w\n" + "".join(f'"{wkt}",{w}\n' for wkt, w in rows))


def make(seed, name):
    """Writes the files; returns the options. `name` is the path without its ending."""
    r = Random(seed)
    wide = r.choice((6, 10, 14))
    write(name + ".csv", [(f"POLYGON(({corners_of(r, r.uniform(0, wide), r.uniform(0, wide), 3, 8)}))", r.choice((1, 1, 1, 2, 3)))
                          for _ in range(r.randint(2, 6))])
    words = options_of(r)
    if r.random() < 0.7:
        write(name + ".road.csv", [(barrier_of(r, wide), 1) for _ in range(r.randint(1, 2))])
        words += ["--barrier", name + ".road.csv" + (",width=" + r.choice(("1", "2")) if r.random() < 0.5 else "") +
                  (",gap=" + r.choice(("0", "1")) if r.random() < 0.3 else "") + (",side=no" if r.random() < 0.3 else "")]
    return words


def search(sunder, first, last):
    best = {}
    with tempfile.TemporaryDirectory() as directory:
        name = os.path.join(directory, "world")
        for seed in range(first, last):
            done = subprocess.run([sunder, "separate", name + ".csv", name + ".gpkg", "--overwrite", "-q", "--rows", "no", "--ease", "no", "--layers", "conflicts", "--proof",
                                   name + ".jsonl", *make(seed, name)], capture_output=True, check=False)
            if done.returncode not in (0, 3):
                continue
            with open(name + ".jsonl", encoding="utf-8") as file:
                for line in (line for line in file if len(line) < LONGEST):
                    for what in statements_of(json.loads(line)):
                        best[what] = min(best.get(what, (len(line), seed)), (len(line), seed))
    for what, (size, seed) in sorted(best.items()):
        print(f"{seed:6} {size:6} {what}")


if __name__ == "__main__":
    if sys.argv[1] == "--search":
        search(sys.argv[2], *map(int, sys.argv[3:5]))
    else:
        print("\n".join(make(int(sys.argv[1]), sys.argv[1])))
