"""Rows found by an independent program: python3 rows_oracle.py SUNDER SEED LAYERS.

Makes layers of small towns that are far from each other, finds their rows by a direct implementation of the rule in
src/displacement/rows/README.md, and compares them with LAYER_rows and with the numbers of --stats. Blocks are taken
from the output. A town in which a quantity is within MARGIN of its threshold is left out, and counted. The same layer
is then written in other ways (rings, order, place, mirrored, turned), and must have the same rows.

Uses only Python's standard library, and no code of the program."""
import cmath
import json
import math
import random
import sqlite3
import struct
import subprocess
import sys

from rows_rule import MARGIN, House, Undecided, holds, rows_of

GRID = 2.0**20  # coordinates are multiples of 1 / GRID, so that towns are shifted without rounding
APART = 4096.0  # distance between the origins of two towns
TOWNS = 12  # towns in a layer
FAR = 10 * TOWNS * APART


class Row:
    """A row as it should be written: its houses by FID, its kinks before the moves, and the changes by the moves."""

    def __init__(self, row, ring, fids):
        chain = []
        self.edges = []
        for b, edge in row:
            f, g = (edge.f, edge.g) if b == edge.i else (edge.g, edge.f)
            chain += [fids[f], fids[g]] if not chain or chain[-1] != fids[f] else [fids[g]]
            self.edges.append((fids[edge.f], fids[edge.g], edge.axis, edge.offset, edge.middle))
        self.bodies = len({b for b, _ in row} | {e.other(b) for b, e in row})
        self.ring = ring
        if ring and chain[-1] == chain[0]:
            chain.pop()
        self.houses = chain
        self.chain = self.listed(lambda fid: fid)

    def listed(self, number):
        """The houses from the end with the lower number; those of a ring start and end with its lowest number."""
        chain = list(self.houses)
        if not self.ring:
            return chain if number(chain[0]) < number(chain[-1]) else chain[::-1]
        at = chain.index(min(chain, key=number))
        chain = chain[at:] + chain[:at]
        if number(chain[-1]) < number(chain[1]):
            chain[1:] = chain[:0:-1]
        return chain + chain[:1]

    def kink_before(self):
        return max(abs(offset) for *_, offset, _ in self.edges)

    def bends(self, move):
        return [v[1] for v in self.moves(move)]

    def moves(self, move):
        """The relative moves of neighbours, along the row and to its left."""
        return [((move[g][0] - move[f][0]) * x + (move[g][1] - move[f][1]) * y, (move[g][1] - move[f][1]) * x - (move[g][0] - move[f][0]) * y)
                for f, g, (x, y), _, _ in self.edges]

    def turns(self, move):
        """The angles by which the lines between neighbours turn, in degrees."""
        return [math.degrees(abs(cmath.phase(complex(a + u, b + v) / complex(a, b))))
                for (u, v), (*_, (a, b)) in zip(self.moves(move), self.edges)]

    def kink_after(self, move):
        return max(abs(e[3] + bend) for e, bend in zip(self.edges, self.bends(move)))


# ---- Towns ---------------------------------------------------------------------------------------------------------------


def snap(p):
    return (round(p[0] * GRID) / GRID, round(p[1] * GRID) / GRID)


def turned(points, angle, at):
    c, s = math.cos(angle), math.sin(angle)
    return [snap((at[0] + c * x - s * y, at[1] + s * x + c * y)) for x, y in points]


def box(w, d):
    return [(0, 0), (w, 0), (w, d), (0, d)]


def outline(rng, w, d):
    """A house of about that size: a box, or a more complicated form."""
    kind = rng.randrange(12)
    if kind == 0:  # an L
        return [(0, 0), (w, 0), (w, d / 2), (w / 2, d / 2), (w / 2, d), (0, d)]
    if kind == 1:  # a bay
        return [(0, 0), (w / 3, 0), (w / 3, -d / 6), (w / 2, -d / 6), (w / 2, 0), (w, 0), (w, d), (0, d)]
    if kind == 2:  # round: it has no direction
        n = rng.choice((6, 8, 12))
        return [(w / 2 * (1 + math.cos(2 * math.pi * k / n)), w / 2 * (1 + math.sin(2 * math.pi * k / n))) for k in range(n)]
    if kind == 3:  # with walls that are nearly collinear
        return [(0, 0), (w / 2, rng.choice((0, 2.0**-20))), (w, 0), (w, d), (0, d)]
    return box(w, d)


def house(rng, w, d, angle, at):
    parts = [[turned(outline(rng, w, d), angle, at)]]
    if rng.random() < 0.06:  # with a second part
        parts.append([turned([(x, y + d + 1.5) for x, y in box(w / 2, 2)], angle, at)])
    elif rng.random() < 0.04:  # with a courtyard
        parts = [[turned(box(w, d), angle, at), turned([(2, 2), (2, d - 2), (w - 2, d - 2), (w - 2, 2)], angle, at)]]
    return House(parts, fixed=int(rng.random() < 0.1), ignored=int(rng.random() < 0.04))


def street(rng, gap, n, lines):
    """Houses along a street that may bend, with gaps, sheds behind, and a road, a fence or a pond between."""
    houses, x, y, angle = [], 0.0, 0.0, rng.choice((0, 0, math.pi / 2, rng.uniform(-3, 3)))
    bend = rng.choice((0, 0, rng.uniform(-0.2, 0.2)))
    shake, askew = gap * rng.choice((0.1, 0.4, 1.1)), rng.choice((0.01, 0.1, 0.3))
    w, d = rng.uniform(5, 12), rng.uniform(5, 12)
    for _ in range(n):
        ux, uy = math.cos(angle), math.sin(angle)
        back = rng.uniform(-shake, shake)
        size = (w * rng.uniform(0.7, 1.4), d * rng.choice((1, 1, rng.uniform(0.3, 2.8))))
        at = (x - uy * back, y + ux * back)
        houses.append(house(rng, *size, angle + rng.uniform(-askew, askew), at))
        if rng.random() < 0.2:
            shed = (at[0] - uy * (size[1] + 1.5 * gap * rng.random()), at[1] + ux * (size[1] + 1.5 * gap * rng.random()))
            houses.append(house(rng, 2, 2.5, angle, shed))
        step = size[0] + gap * rng.choice((rng.uniform(0.15, 1.5), rng.uniform(0.15, 1.5), rng.uniform(1, 4.5), -0.3))
        if rng.random() < 0.1:
            to = step - gap / 9
            a, b = ((x + ux * to - uy * k, y + uy * to + ux * k) for k in (-9, rng.uniform(4, 25)))
            lines.append((snap(a), snap(b)))
        x, y, angle = x + ux * step, y + uy * step, angle + bend
    return houses


def terrace(rng, gap, n):
    """Houses that touch, in blocks; coordinates have few digits, so that many distances and offsets are equal."""
    houses, x = [], 0.0
    for _ in range(n):
        w, d = rng.choice((6, 7.5, 8)), rng.choice((8, 8, 9.25))
        houses.append(House([[[(x + px, py) for px, py in box(w, d)]]]))
        x += w + rng.choice((0, 0, gap / 2 + rng.randrange(1, 64) / 64, gap + rng.randrange(64) / 64))
    return houses


def corners(rng, gap, n):
    """Terraces in a line: some have a wing across it at one end, some a wing at both, and some close around a yard."""
    houses, x = [], 0.0

    def add(w, d, at):
        houses.append(House([[[(at[0] + px, at[1] + py) for px, py in box(w, d)]]]))

    for _ in range(n):
        long, wing, deep = rng.randrange(2, 5), rng.choice((0, 0, 1, 1, 2)), rng.choice((5, 6.5, 7))
        for k in range(long):
            add(7, 8, (x + 7 * k, 0))
        for k in range(rng.randrange(1, 3) if wing else 0):
            for end in (0, long - 1)[:wing]:
                add(7, deep, (x + 7 * end, 8 + k * deep))
        if wing == 2 and rng.random() < 0.5:
            add(7 * long, deep, (x, 8 + deep))
        x += 7 * long + rng.choice((gap / 2 + 1 / 64, gap + rng.randrange(1, 64) / 64))
    return houses


def ring(rng, gap, n):
    """Houses around a green."""
    angle, w = 2 * math.pi / n, 7.0
    radius = (w + gap * rng.uniform(0.5, 1.5)) / angle
    hole = rng.choice((None, None, rng.randrange(n)))
    return [House([[turned([(px - w / 2, radius + py) for px, py in box(w, 6)], k * angle + rng.uniform(-0.01, 0.01),
                           (radius, radius))]]) for k in range(n) if k != hole]


def grid(rng, gap, m, n):
    step = 8 + gap * rng.choice((0.5, 1, 2, 3.9))
    shake = rng.choice((0, gap / 8, gap))
    return [house(rng, 8, 8, 0, (i * step + rng.uniform(-shake, shake), j * (step + 0.5) + rng.uniform(-shake, shake)))
            for i in range(m) for j in range(n)]


def heap(rng, n):
    """Houses at random places: overlapping, nested, and huge ones next to tiny ones."""
    return [house(rng, rng.choice((0.5, 5, 9, 30)), rng.choice((5, 9)), rng.choice((0, rng.uniform(-3, 3))),
                  (rng.uniform(0, 60), rng.uniform(0, 60))) for _ in range(n)]


def moved(house, x, y):
    parts = [[[snap((px + x, py + y)) for px, py in r] for r in rings] for rings in house.parts]
    return House(parts, house.fixed, house.ignored, house.block)


def town(rng, gap, number, blocks):
    """Houses and lines of barriers."""
    houses, lines = [], []
    for k in range(rng.randrange(1, 4)):
        kind, own = rng.randrange(9), []
        part = (street(rng, gap, rng.randrange(4, 14), own) if kind < 4 else terrace(rng, gap, rng.randrange(5, 14))
                if kind == 4 else ring(rng, gap, rng.randrange(22, 30)) if kind == 5 else
                grid(rng, gap, rng.randrange(2, 6), rng.randrange(2, 5)) if kind == 6 else
                corners(rng, gap, rng.randrange(4, 8)) if kind == 7 else heap(rng, rng.randrange(5, 14)))
        x, y = (0, 0) if k == 0 else (rng.choice((rng.uniform(0, 30), 400.0 * k)), rng.choice((rng.uniform(10, 30), 0)))
        houses += [moved(h, x, y) for h in part]
        lines += [(snap((a[0] + x, a[1] + y)), snap((b[0] + x, b[1] + y))) for a, b in own]
    houses = houses[:60]
    rng.shuffle(houses)
    for h in houses if blocks else ():
        h.block = rng.choice((None,) * 8 + (2 * number, 2 * number + 1))
    return houses, lines


# ---- Layers --------------------------------------------------------------------------------------------------------------


class Layer:
    """Random towns, the options of the program, and the way in which the layer is written."""

    def __init__(self, rng):
        self.gap = rng.choice((1.0, 3.0, 3.0, 5.0, 12.0, 0.0))
        self.words = ["--gap", repr(self.gap), "--effort", "0", "--fixed-where", "fixed = 1"]
        self.words += ["--ignore-where", "ignored = 1"]
        blocks = rng.random() < 0.5
        self.words += [["--block-field", "block"], ["--no-blocks", "--contained", "separate"], [], []][rng.randrange(4)] \
            if not blocks else ["--block-field", "block"]
        self.words += rng.choice(([], ["--max-shift", "0"], ["--max-shift", "4"]))
        self.town = [town(rng, self.gap, t, blocks) for t in range(TOWNS)]
        self.areas = rng.random() < 0.3  # barriers are triangles along the lines
        self.block_of, self.skipped = {}, set()

    def place(self, t):
        return APART * t, APART * (t % 3)

    def houses(self):
        """All houses with their FIDs and towns."""
        fid = 0
        for t, (houses, _) in enumerate(self.town):
            for h in houses:
                fid += 1
                yield fid, t, h


def write_geojson(path, features):
    crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}}
    with open(path, "w", encoding="utf-8") as f:
        json.dump({"type": "FeatureCollection", "crs": crs, "features": features}, f)


def as_written(h, place, change, rings):
    def ring_of(ring):
        points = [change(x + place[0], y + place[1]) for x, y in ring]
        points = rings(points)
        return [list(p) for p in points + points[:1]]

    parts = [[ring_of(ring) for ring in part] for part in h.parts]
    if rings is not AS_IS:
        parts.reverse()
    return {"type": "MultiPolygon", "coordinates": parts}


def AS_IS(points):
    return points


def rewritten(points):
    points = points[::-1]
    k = len(points) // 2
    return points[k:] + points[:k] + points[k:k + 1]  # the closing point repeated


def lines_as_written(layer, towns, change):
    def point(p, t):
        return list(change(p[0] + layer.place(t)[0], p[1] + layer.place(t)[1]))

    for t in towns:
        for a, b in layer.town[t][1]:
            if layer.areas:
                c = third_corner(a, b)
                yield {"type": "Polygon", "coordinates": [[point(a, t), point(b, t), point(c, t), point(a, t)]]}
            else:
                yield {"type": "LineString", "coordinates": [point(a, t), point(b, t)]}


def third_corner(a, b):
    return snap((b[0] + (b[1] - a[1]) / 32, b[1] - (b[0] - a[0]) / 32))


def barrier_lines(layer, t):
    for a, b in layer.town[t][1]:
        yield a, b
        if layer.areas:
            yield b, third_corner(a, b)
            yield third_corner(a, b), a


class Output:
    def __init__(self, path):
        base = sqlite3.connect(path)
        names = [r[0] for r in base.execute("SELECT table_name FROM gpkg_contents")]
        rows = base.execute("SELECT fid, geom, sunder_dx, sunder_dy, sunder_st, sunder_blk FROM l").fetchall()
        self.move = {r[0]: (r[2] or 0.0, r[3] or 0.0) for r in rows}
        self.status = {r[0]: r[4] for r in rows}
        self.block = {r[0]: r[5] for r in rows}
        self.rows = base.execute("SELECT row, houses, kink_bef, kink_aft, geom FROM l_rows ORDER BY fid").fetchall() \
            if "l_rows" in names else []
        base.close()


def line_of(blob):
    """The points of a line string in a GeoPackage's geometry."""
    at = 8 + {0: 0, 1: 32}[blob[3] >> 1 & 7]
    order = "<" if blob[at] else ">"
    n = struct.unpack_from(order + "I", blob, at + 5)[0]
    numbers = struct.unpack_from(order + f"{2 * n}d", blob, at + 9)
    return list(zip(numbers[::2], numbers[1::2]))


def same(x, y):
    return x, y


def run(sunder, layer, towns, rows, change=same, rings=AS_IS, backwards=False, threads=1):
    """Writes these towns, runs the program, and returns the output and the statistics."""
    features = []
    for fid, t, h in layer.houses():
        if t in towns:
            features.append({"type": "Feature", "id": fid,
                             "properties": {"fixed": h.fixed, "ignored": h.ignored, "block": h.block},
                             "geometry": as_written(h, layer.place(t), change, rings)})
    far = House([[box(9, 9)]])
    features.append({"type": "Feature", "id": 100000, "properties": {"fixed": 0, "ignored": 0, "block": None},
                     "geometry": as_written(far, (FAR, FAR), change, rings)})
    if backwards:
        features.reverse()
    write_geojson("l.geojson", features)
    words = [sunder, "separate", "l.geojson", "o.gpkg", "--overwrite", "-q", "--ease", "no", "--allow-conflicts", "--output-layer", "l",
             "--threads", str(threads), "--stats", "o.json", "--rows", "auto" if rows else "no"] + layer.words
    lines = [{"type": "Feature", "properties": {}, "geometry": g} for g in lines_as_written(layer, towns, change)]
    if lines:
        write_geojson("b.geojson", lines)
        words += ["--barrier", "b.geojson"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(words)}: status {done.returncode}: {done.stderr}")
    with open("o.json", encoding="utf-8") as f:
        return Output("o.gpkg"), json.load(f)


def expected_rows(layer, t, output):
    """The rows of a town. Raises Undecided."""
    houses, fids, bodies = [], [], {}
    for fid, of, h in layer.houses():
        if of != t or output.status[fid] == "skipped":
            continue
        block = output.block[fid]
        bodies.setdefault(("block", block) if block is not None else ("alone", fid), []).append(len(houses))
        houses.append(h)
        fids.append(fid)
    lines = list(barrier_lines(layer, t))
    return [Row(row, closed, fids) for row, closed in rows_of(list(bodies.values()), houses, lines, layer.gap)]


# ---- Comparison ----------------------------------------------------------------------------------------------------------


def differ(a, b):
    """Kinks are sums of a few numbers of the size of a town, hence the tolerance."""
    return abs(a - b) > 1e-6


def unlike(row, chain, written, layer, output, change, exactly):
    """How the written row differs from the expected one; None: it does not."""
    least, bodies, before, after, blob = written
    if least != min(chain) or bodies != row.bodies:
        return f"row {least} of {bodies}"
    line = line_of(blob)
    if len(line) != len(chain):
        return f"{len(line)} points"
    place = {fid: (layer.place(t), h) for fid, t, h in layer.houses() if fid in chain}
    for fid, point in zip(chain, line):
        move, ((x, y), h) = output.move[fid], place[fid]
        there = House([[[change(px + x, py + y) for px, py in r] for r in part] for part in h.parts])
        if not holds(there, (point[0] - move[0], point[1] - move[1])):
            return f"{fid} is not at {point}"
    if differ(before, row.kink_before()):
        return f"kink before {before}, not {row.kink_before()}"
    if exactly and differ(after, row.kink_after(output.move)):
        return f"kink after {after}, not {row.kink_after(output.move)}"
    return None


def compare(what, layer, expected, output, change=same, exactly=True):
    """Returns the differences between the rows of all towns and those that were written."""
    trouble, left = [], list(expected)
    for written in output.rows:
        reasons = []
        for r in (r for r in left if min(r.chain) == written[0]):
            # A row begins at its end that comes first in the layer; here the layer is written backwards.
            chain = r.listed(lambda fid: -fid) if what == "order" else r.chain
            reasons.append(unlike(r, chain, written, layer, output, change, exactly))
            if reasons[-1] is None:
                left.remove(r)
                break
        if None not in reasons:
            trouble.append(f"{what}: row {written[:4]} of {len(line_of(written[4]))} points: {reasons}")
    return trouble + [f"{what}: no row {r.chain} of {r.bodies}" for r in left]


def compare_figures(layer, expected, output, stats):
    kinks = [abs(b) for r in expected for b in r.bends(output.move)]
    measured = {"kink": kinks, "spacing": [abs(v[0]) for r in expected for v in r.moves(output.move)],
                "turn": [t for r in expected for t in r.turns(output.move)]}
    n = len(kinks)
    most = layer.gap / 10
    figures = {"rows": len(expected), "features": 0, "kink_share": sum(k > most for k in kinks) / max(n, 1)}
    for name, values in measured.items():
        figures[name + "_mean"] = sum(values) / max(n, 1)
        figures[name + "_p95"] = sorted(values)[n - 1 - n // 20] if n else 0
    bodies = set()
    for r in expected:
        bodies |= {output.block[f] or -f for f in r.chain}
    figures["features"] = len(bodies)
    close = any(abs(k - most) <= MARGIN for k in kinks)
    return [f"figures: {name} is {stats['rows'][name]}, not {figure}" for name, figure in figures.items()
            if differ(stats["rows"][name], figure) and not (close and name == "kink_share")]


def ask(sunder, seed, tally):
    rng = random.Random(seed)
    layer = Layer(rng)
    blocks, _ = run(sunder, layer, range(TOWNS), False)
    expected, towns = [], []
    for t in range(TOWNS):
        try:
            expected += expected_rows(layer, t, blocks)
            towns.append(t)
        except Undecided:
            tally["undecided"] += 1
    tally["towns"] += len(towns)
    tally["rows"] += len(expected)
    tally["rings"] += sum(r.ring for r in expected)
    if not towns:
        return []
    output, stats = run(sunder, layer, towns, True)
    changed = [f for f in output.block if (output.block[f] is None) != (blocks.block[f] is None)]
    if changed:
        return [f"blocks of {changed} are others without some of the towns"]
    trouble = compare("as it is", layer, expected, output) + compare_figures(layer, expected, output, stats)
    shifted = 2.0**18
    for what, words in {
            "rings": {"rings": rewritten}, "order": {"backwards": True},
            "shifted": {"change": lambda x, y: (x + shifted, y - shifted)}, "mirrored": {"change": lambda x, y: (-x, y)},
            "turned": {"change": lambda x, y: (-y, x)}}.items():
        if rng.random() < tally["share"]:
            again, _ = run(sunder, layer, towns, True, **words)
            trouble += compare(what, layer, expected, again, words.get("change", same),
                               exactly=what in ("rings", "order") or "0" in layer.words[-1:])
            tally[what] = tally.get(what, 0) + 1
    again, _ = run(sunder, layer, towns, True, threads=4)
    if again.rows != output.rows:
        trouble.append("the rows depend on the number of threads")
    return trouble


def main():
    sunder, seed, layers = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    tally = {"towns": 0, "undecided": 0, "rows": 0, "rings": 0, "share": 1.0 if layers > 20 else 0.25}
    trouble = []
    for k in range(layers):
        found = ask(sunder, seed + k, tally)
        trouble += [f"seed {seed + k}: {t}" for t in found]
    print(", ".join(f"{n} {what}" for what, n in tally.items() if what != "share"))
    for t in trouble[:20]:
        print(t)
    if tally["undecided"] > tally["towns"] / 4:
        trouble.append("too many towns are undecided")
        print(trouble[-1])
    sys.exit(1 if trouble else 0)


if __name__ == "__main__":
    main()
