"""Barrier areas all of whose corners are far away, drawn by SUNDER_SEED: half planes, strips, areas with a notch or a
hole, along an axis or slanted through (0, 0). Their edges pass among houses. With the corners at 1e10 up to the
greatest double no more conflicts remain than with the corners at 1.7e7; if the numbers are equal, the cost is no
greater."""
import csv
import json
import os
import random
import subprocess
import sys

SEED = int(os.environ.get("SUNDER_SEED", "1"))
COUNT = 2 * int(os.environ.get("SUNDER_TEST_SCALE", "1"))
NEAR, FAR = 2.0**24, [1e10, 1e12, 1e14, 1e16, 1e20, 1e100, 1.7e308]


def ring(points):
    return "(" + ",".join(f"{x} {y}" for x, y in points + points[:1]) + ")"


def slanted(r):
    """A half plane beside a line through (0, 0), with all corners at multiples of an eighth of the far value."""
    dx, dy = r.choice([(1, 1), (1, 2), (3, 1), (2, -1), (-1, 1), (4, -3)])
    side = r.choice([-1, 1])

    def barrier(v):
        v /= 8
        return ring([(-dx * v, -dy * v), (dx * v, dy * v), (-dy * v * side, dx * v * side)])

    return barrier, lambda along, across: (dx * along / 2 + across, dy * along / 2 - across)


def along_an_axis(r, kind):
    """An area with an edge along an axis."""
    x, y = 500000 + r.randint(0, 64) / 8, 5300000 + r.randint(0, 64) / 8
    swap, side, wide, corners = r.random() < 0.5, r.choice([-1, 1]), r.randint(8, 80) / 8, r.choice([3, 4])
    along, across = (y, x) if swap else (x, y)

    def barrier(v):
        left, right, beyond = (-v, across), (v, across), side * v
        rings = {
            "strip": [[left, right, (v, across + wide), (-v, across + wide)]],
            "half plane": [[left, right, (0.0, beyond)] if corners == 3 else [left, right, (v, beyond), (-v, beyond)]],
            "notch": [[left, (along, across), (along, across - 20 * side), (along + 15, across - 20 * side),
                       (along + 15, across), right, (v, beyond), (-v, beyond)]],
            "hole": [[(-v, across - v), (v, across - v), (v, across + v), (-v, across + v)],
                     [(-v / 2, across), (v / 2, across), (v / 2, across + 30 * wide), (-v / 2, across + 30 * wide)]],
        }[kind]
        return ",".join(ring([(q, p) for p, q in points] if swap else points) for points in rings)

    return barrier, lambda u, w: (across + w, along + u) if swap else (along + u, across + w)


def houses(r, place):
    rows = []
    for k in range(r.randint(1, 6)):
        wide, high = r.randint(40, 160) / 8, r.randint(40, 160) / 8
        x, y = place(60 * k + r.randint(0, 80) / 8, r.randint(-80, 160) / 8)
        rows.append(ring([(x - wide / 2, y - high / 2), (x + wide / 2, y - high / 2), (x + wide / 2, y + high / 2),
                          (x - wide / 2, y + high / 2)]))
        if r.random() < 0.4:
            x += wide / 2
            rows.append(ring([(x - 1, y), (x + 9, y), (x + 9, y + high / 2), (x - 1, y + high / 2)]))
    return rows


def write_table(name, rows):
    with open(name, "w", encoding="ascii", newline="") as f:
        out = csv.writer(f)
        out.writerow(["id", "WKT"])
        out.writerows((k, f"POLYGON ({row})") for k, row in enumerate(rows))


def separate(rows, barrier, extra):
    write_table("houses.csv", rows)
    write_table("far.csv", [barrier])
    done = subprocess.run([os.environ["SUNDER"], "separate", "houses.csv", "houses.geojson", "--overwrite", "--quiet",
                           "--oo", "GEOM_POSSIBLE_NAMES=WKT", "--no-blocks", "--stats", "-", "--barrier", "far.csv",
                           *extra], capture_output=True, text=True)
    if done.returncode not in (0, 3):
        sys.exit(f"{barrier}: status {done.returncode}: {done.stderr}")
    stats = json.loads(done.stdout)
    if not stats["verified"]:
        sys.exit(f"{barrier}, {extra}: not verified")
    return sum(stats["conflicts"]["after"].values()), stats["displacement"]["cost"]


def main():
    for case in range(COUNT):
        for kind in ("half plane", "strip", "notch", "hole", "slanted"):
            r = random.Random(f"{SEED} {case} {kind}")
            barrier, place = slanted(r) if kind == "slanted" else along_an_axis(r, kind)
            rows = houses(r, place)
            extra = ["--gap", r.choice(["0", "1", "3"])] + r.choice([[], ["--max-shift", "10"], ["--max-shift", "90"]])
            expected = separate(rows, barrier(NEAR), extra)
            for value in r.sample(FAR, 2):
                found = separate(rows, barrier(value), extra)
                if found[0] > expected[0] or (found[0] == expected[0] and not found[1] <= expected[1] * (1 + 1e-6)):
                    sys.exit(f"seed {SEED}, case {case}, {kind}, {value}, {extra}: conflicts and cost {found}, "
                             f"with near corners {expected}")


main()
