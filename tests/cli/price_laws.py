"""Rows of houses with larger and larger prices: python3 price_laws.py SUNDER SEED LAYERS.

With springs of the same stiffness K along and across a row, the cost is M + K S, where M is of the moves and S the sum
of w u^2 over both directions of all springs. The least of M + K S over a fixed set has an S that does not grow with K,
and an M that does not fall. The same holds of --ease K, where S is the sum of w s^2 over all pairs, s is what a pair
lacks, and M is the rest of the cost. Each layer has one or two bent rows, some with a road in front, limits, weights and
a fixed house; for --ease a road passes so near that some houses lack room, and there are no springs. Two runs are
compared if both are proved nearly optimal and the same pairs are listed; both sums may then differ from the law by what
the proofs leave open. Uses only Python's standard library, and no code of the program."""
import json
import math
import os
import random
import sqlite3
import subprocess
import sys

NEARLY = 0.01  # the greatest optimality gap of runs that are compared
LAWS = {"--row-stiffness": (0.3, 1, 3, 10, 40), "--ease": (0.5, 3, 30, 300)}


def house(x, y, angle, wide, deep):
    c, s = math.cos(angle), math.sin(angle)
    ring = [(x + a * c - b * s, y + a * s + b * c) for a, b in ((0, 0), (wide, 0), (wide, deep), (0, deep), (0, 0))]
    return "POLYGON((%s))" % ",".join("%r %r" % p for p in ring)


def town(rng, narrow):
    """Rows of (polygon, limit, weight), and roads. narrow: roads pass so near that houses lack room."""
    houses, roads, gap = [], [], 3.0
    for k in range(rng.randrange(1, 3)):
        angle, x, y = rng.uniform(0, 2 * math.pi), 300.0 * k, rng.uniform(-50, 50)
        c, s = math.cos(angle), math.sin(angle)
        limit = rng.choice((2.0, 4.0) if narrow else (None, None, 4.0, 9.0))
        at, n = 0.0, rng.randrange(3, 5 if narrow else 8)
        for _ in range(n):
            wide, back = rng.uniform(8, 14), rng.uniform(0, 1.5)
            own = 0.0 if rng.random() < 0.06 else limit
            houses.append((house(x + at * c - back * s, y + at * s + back * c, angle + rng.uniform(-0.1, 0.1), wide,
                                 rng.uniform(8, 12)), own, rng.choice((1.0, 1.0, rng.uniform(0.3, 4)))))
            at += wide + (rng.uniform(4, 9) if narrow else rng.choice((rng.uniform(0.2, 2.5), rng.uniform(1, 5))))
        if narrow or rng.random() < 0.5:
            front = rng.uniform(-1, 3) if narrow else rng.uniform(3, 6)
            roads.append("LINESTRING(%r %r,%r %r)" % (x - 20 * c + front * s, y - 20 * s - front * c,
                                                      x + (at + 20) * c + front * s, y + (at + 20) * s - front * c))
    return houses, roads, gap


def write(name, rows, fields):
    """A CSV file with WKT, which GDAL reads as a layer named like the file."""
    with open(name, "w", encoding="utf-8") as f:
        f.write("WKT,%s\n" % ",".join(fields))
        for row in rows:
            f.write('"%s",%s\n' % (row[0], ",".join("" if v is None else repr(v) for v in row[1:])))
    with open(name + "t", "w", encoding="utf-8") as f:
        f.write(",".join(["WKT"] + ["Real"] * len(fields)))


def squares_short(houses, listed, missing):
    """The sum of w s^2 over the listed pairs."""
    total = 0.0
    for (a, b, _, _), s in zip(listed, missing):
        weights = [houses[fid - 1][2] for fid in (a, b) if fid is not None and houses[fid - 1][1] != 0]
        total += min(weights) * s * s if weights else 0
    return total


def run(sunder, gap, houses, roads, law, k):
    """(the rest of the cost, S, room that the proof leaves, listed pairs) of a run, or None if it is not proved to be nearly optimal."""
    prices = ["--rows", "auto", "--row-stiffness", "%r,%r" % (k, k), "--ease", "no"] if law == "--row-stiffness" else ["--rows", "no", "--ease", repr(k)]
    words = [sunder, "separate", "town.csv", "out.gpkg", "--overwrite", "--quiet", "--gap", repr(gap), *prices,
             "--max-shift-field", "most", "--weight-field", "w", "--stats", "stats.json", "--threads", "1", "--no-styles"]
    words += ["--barrier", "road.csv,width=4"] if roads else []
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 3):
        sys.exit("status %d: %s\n%s" % (done.returncode, " ".join(words), done.stderr))
    with open("stats.json", encoding="utf-8") as f:
        stats = json.load(f)
    d = stats["displacement"]
    if d["optimality_gap"] > NEARLY:
        return None
    base = sqlite3.connect("out.gpkg")
    found = base.execute("select fid_a, fid_b, barrier, barr_fid, missing from town_conflicts order by 1, 2, 3, 4").fetchall()
    base.close()
    listed = [row[:4] for row in found]
    s = d["cost_rows"] / k if law == "--row-stiffness" else squares_short(houses, listed, [row[4] for row in found])
    return d["cost"] - k * s, s, d["cost"] - d["lower_bound"] + 1e-9 * (1 + d["cost"]), listed


def ask(sunder, seed, layers, law):
    """Returns whether the law holds, and was asked often enough."""
    rng = random.Random(seed)
    compared = paid = wrong = 0
    for number in range(layers):
        houses, roads, gap = town(rng, law == "--ease")
        write("town.csv", houses, ("most", "w"))
        if roads:
            write("road.csv", [(r, 1) for r in roads], ("n",))
        before = None
        for k in LAWS[law]:
            now = run(sunder, gap, houses, roads, law, k)
            if before and now and before[1][3] == now[3]:
                # M + k S <= M' + k S' + room, and the same for the other run: the sum of both bounds S - S'.
                room = (before[1][2] + now[2]) / (k - before[0])
                compared += 1
                paid += now[1] > 0
                if now[1] > before[1][1] + room or now[0] < before[1][0] - before[1][2] - before[0] * room:
                    wrong += 1
                    print("layer %d of seed %d: %s %r has the rest %r, squares %r; %r has %r, %r" %
                          (number, seed, law, before[0], *before[1][:2], k, *now[:2]))
            before = (k, now) if now else None
    print("%s: %d pairs of runs compared, %d with squares above 0, %d break the law" % (law, compared, paid, wrong))
    return not wrong and compared >= layers and paid >= layers / 2


def main():
    held = [ask(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), law) for law in LAWS]
    sys.exit(not all(held))


if __name__ == "__main__":
    main()
