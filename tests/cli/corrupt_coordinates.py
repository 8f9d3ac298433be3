"""Houses next to features with one corrupt vertex, drawn by SUNDER_SEED: single houses, chains of two to five, rows,
on all sides of the corrupt feature, next to several corrupt features. With the vertex at 1.4e8 and beyond, no more
conflicts remain than with the corrupt features declared fixed; if the numbers are equal, the cost is no greater. If
the houses stand along one straight side, far from the corrupt vertex, the cost is no greater than beside a fixed
feature with the vertex at 1e7 or 1e8. Beside features that the user fixed the cost does not grow with the distance of the
vertex. With the vertex at 1e16 and beyond, where the feature could only move by
multiples of the vertex's last place, it does not move."""
import csv
import json
import os
import random
import subprocess
import sys

SEED = int(os.environ.get("SUNDER_SEED", "1"))
COUNT = 3 * int(os.environ.get("SUNDER_TEST_SCALE", "1"))
BEYOND = ["1.4e8", "3e8", "6e8", "1e9", "2e9", "4e9"]  # beyond any on the Earth
NEARER = ["1e10", "1e11", "5e11", "1e12", "2e12", "5e12", "1e13", "1e14", "1e15"]
FARTHER = ["1e16", "1e17", "1e20", "1e30", "1e100", "1.7e308", "1.7976931348623157e308"]
FIXED = ["--fixed-where", "kind = 'wild'"]
# (seed, case, number of the kind) of layers in which houses beside a fixed feature cost more with its vertex beyond 1e8 than at 1e8
AGAIN = [(4, 0, 3), (4, 1, 0), (2, 2, 1), (6, 0, 1), (9, 0, 3), (32, 0, 1), (37, 0, 1), (121, 0, 3), (201, 0, 3), (102, 0, 1)]


def polygon(points):
    return "POLYGON ((" + ",".join(f"{x} {y}" for x, y in points + points[:1]) + "))"


def house(x, y, wide, high):
    ring = polygon([(x, y), (x + wide, y), (x + wide, y + high), (x, y + high)])
    return "house", lambda _: ring


def wild(r, x, y):
    """A rectangle with one corrupt corner, in x or in y, in the positive or negative direction; and its size."""
    wide, high, corner = r.randint(40, 400) / 8, r.randint(160, 1200) / 8, r.randint(0, 3)

    def drawn(value):
        points = [(x, y), (x + wide, y), (x + wide, y + high), (x, y + high)]
        px, py = points[corner]
        points[corner] = [(px, "-" + value), (value, py), (px, value), ("-" + value, py)][corner]
        return polygon(points)

    return ("wild", drawn), wide, high


def chain(r, x, y, wide, high, houses):
    """A chain of houses outwards from an edge of a rectangle: the first overlaps the rectangle, each other one
    overlaps the one before, or is nearly touching it."""
    dx, dy = r.choice([(0, -1), (1, 0), (0, 1), (-1, 0)])
    at_x = x + wide * {0: r.random(), 1: 1, -1: 0}[dx]
    at_y = y + high * {0: r.random(), 1: 1, -1: 0}[dy]
    gone = -r.randint(2, 40) / 8
    for _ in range(houses):
        w, h = r.randint(5, 15), r.randint(5, 15)
        depth = w if dx else h
        middle = round(8 * (at_x + dx * (gone + depth / 2))) / 8, round(8 * (at_y + dy * (gone + depth / 2))) / 8
        yield house(middle[0] - w / 2, middle[1] - h / 2, w, h)
        gone += depth + r.randint(-16, 8) / 8


def all_about(r, features):
    """Chains around several corrupt features, which are stacked vertically; single houses stand at the ends."""
    x, y, rows = 500000 + r.randint(0, 64) / 8, 5300000 + r.randint(0, 64) / 8, []
    for k in range(features):
        feature, wide, high = wild(r, x, y + 500 * k)
        rows.append(feature)
        for _ in range(r.randint(1, 3)):
            rows.extend(chain(r, x, y + 500 * k, wide, high, r.randint(2, 5)))
        rows.append(house(x - 300, y + 500 * k, 10, 10))
    return rows


def on_one_side(r, houses):
    """Left of a corrupt feature with a straight side: single houses, or rows that lead away from it."""
    x, y, high = 500000 + r.randint(0, 64) / 8, 5300000 + r.randint(0, 64) / 8, 400
    rows = [("wild", lambda v: polygon([(x, y), (v, y), (x + 20, y + high), (x, y + high)]))]
    for k in range(r.randint(1, 4)):
        right = x + r.randint(8, 40) / 8
        for _ in range(r.randint(1, houses)):
            rows.append(house(right - 20, y + 10 + 90 * k, 20, 60))
            right -= 20 + r.randint(0, 8) / 8
    return rows


def beside_fixed(seed, case, number):
    """Rows of one kind, options, and a place of the corrupt vertex."""
    r = random.Random(seed * 1000003 + case)
    for kind in [lambda: all_about(r, 1), lambda: all_about(r, r.randint(2, 3)), lambda: on_one_side(r, 1), lambda: on_one_side(r, 5)][:number + 1]:
        rows = kind()
        r.shuffle(rows)
        extra = ["--gap", r.choice(["0", "1", "3"])] + r.choice([[], ["--max-shift", "10"], ["--max-shift", "90"]])
        value = [r.choice(values) for values in (BEYOND, NEARER, FARTHER)][0]
    return rows, value, extra + FIXED


def separate(rows, value, extra):
    with open("corrupt.csv", "w", encoding="ascii", newline="") as f:
        out = csv.writer(f)
        out.writerow(["kind", "WKT"])
        out.writerows((kind, wkt(value)) for kind, wkt in rows)
    done = subprocess.run([os.environ["SUNDER"], "separate", "corrupt.csv", "corrupt.geojson", "--overwrite", "--quiet", "--rows", "no", "--ease", "no",
                           "--oo", "GEOM_POSSIBLE_NAMES=WKT", "--no-blocks", "--stats", "-", *extra],
                          capture_output=True, text=True)
    if done.returncode not in (0, 3):
        sys.exit(f"{value}: status {done.returncode}: {done.stderr}")
    stats = json.loads(done.stdout)
    if not stats["verified"]:
        sys.exit(f"{value}, {extra}: not verified")
    return sum(stats["conflicts"]["after"].values()), stats["displacement"]["cost"]


def wild_stays():
    with open("corrupt.geojson", encoding="utf-8") as f:
        return all(f["properties"]["sunder_len"] == 0 for f in json.load(f)["features"] if f["properties"]["kind"] == "wild")


def demand(name, found, expected, stays=True, share=1e-6):
    more = found[0] - expected[0]
    if more > 0 or (more == 0 and not found[1] <= expected[1] * (1 + share)) or not stays:
        sys.exit(f"seed {SEED}, {name}: conflicts and cost {found}, beside fixed ones {expected}; stays: {stays}")


def main():
    for case in range(COUNT):
        r = random.Random(SEED * 1000003 + case)
        for kind in (lambda: all_about(r, 1), lambda: all_about(r, r.randint(2, 3))):
            rows = kind()
            r.shuffle(rows)
            extra = ["--gap", r.choice(["0", "1", "3"])] + r.choice([[], ["--max-shift", "10"], ["--max-shift", "90"]])
            for value in r.choice(BEYOND), r.choice(NEARER), r.choice(FARTHER):
                demand(f"case {case}, {len(rows)} features, {value}, {extra}", separate(rows, value, extra),
                       separate(rows, value, extra + FIXED))
        for houses in (1, 5):
            rows = on_one_side(r, houses)
            r.shuffle(rows)
            extra = ["--gap", r.choice(["0", "1"])] + r.choice([[], ["--max-shift", "90"]])
            expected = max(separate(rows, value, extra + FIXED) for value in ("1e7", "1e8"))
            for value in r.choice(BEYOND), r.choice(NEARER), r.choice(FARTHER):
                found = separate(rows, value, extra)
                demand(f"case {case}, one side, {value}, {extra}", found, expected, value not in FARTHER or wild_stays())
    for drawn in AGAIN:
        rows, value, extra = beside_fixed(*drawn)
        # As the corrupt vertex goes from 1e8 to infinity its edges turn by up to 150 / 1e8, so that they pass houses that are
        # 100 away up to 1.5e-4 beside where they passed them. Moves of some metres cost up to 1e-4 more then.
        demand(f"{drawn}, fixed, {value}, {extra}", separate(rows, value, extra), separate(rows, "1e8", extra), share=1e-4)


main()
