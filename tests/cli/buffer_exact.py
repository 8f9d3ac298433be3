"""Compares sunder buffer with brute force in exact arithmetic (plane_sets.py), which shares no code with the library.

    buffer_exact.py PROGRAM SCENES SEED

Membership. Polygons and shapes have small even coordinates and sides in eight directions, so that every corner of a
result is a double. Polygons have many parts that overlap and share walls, holes as large as the shape, and rooms
exactly as wide as it. The test asks at corners, midpoints, differences of corners, and other places whether they
belong to the result, including its parts without area.

Rounding. Triangles at unfavourable places and scales. The written geometry has to be valid, and no corner or midpoint
of a side may be farther from the boundary of the exact sum (`sunder sum --exact`) than max_deviation says.
"""
import json
import os
import random
import subprocess
import sys
from fractions import Fraction as F

from plane_sets import (edges, fault, in_closed, moved, on_segment, overlap, square_of_distance, touch, within)

PROGRAM, SCENES, SEED = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
EIGHT = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)]
DIGITS = ("--lco", "SIGNIFICANT_FIGURES=25")  # with 17, GDAL writes 0.30000000000000004 for 0.3
wrong = 0


def report(*what):
    global wrong
    wrong += 1
    if wrong < 5:
        print("seed", SEED, *what)


def run(*arguments):
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{arguments}: {done.stderr}")
    return json.loads(done.stdout)


def text(polygons):
    rings = ["(" + ", ".join("(" + ", ".join(f"{x!r} {y!r}" for x, y in ring + ring[:1]) + ")" for ring in polygon) + ")"
             for polygon in polygons]
    return "MULTIPOLYGON (" + ", ".join(rings) + ")"


def write(path, features):
    with open(path, "w", encoding="utf-8") as file:
        json.dump({"type": "FeatureCollection", "features": [
            {"type": "Feature", "id": i + 1, "properties": {}, "geometry": {
                "type": "MultiPolygon", "coordinates": [[ring + ring[:1] for ring in polygon] for polygon in p]}}
            for i, p in enumerate(features)]}, file)


def read(path, key):
    """Reads geometries by FID. The decimals in the file are read exactly."""
    if not os.path.exists(path):
        sys.exit(f"{path} is missing")
    with open(path, encoding="utf-8") as file:
        layer = json.load(file)
    found = {}
    for feature in layer["features"]:
        found.setdefault(key(feature), []).append(feature["geometry"])
    return found


def exact(point):
    """Integers where possible, for speed."""
    return tuple(int(v) if v == int(v) else F(v) for v in point)


def polygons_of(geometry):
    parts = geometry["coordinates"] if geometry["type"] == "MultiPolygon" else [geometry["coordinates"]]
    return [[[exact(v) for v in ring[:-1]] for ring in part] for part in parts if part]


# ---- Membership ------------------------------------------------------------------------------------------------------


def rectangle(x, y, w, h):
    return [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]


def outline(draw, x, y):
    k, w, h = draw.randrange(6), draw.randrange(1, 4) * 2, draw.randrange(1, 4) * 2
    if k < 2:
        return rectangle(x, y, w, h)
    if k == 2:
        return [(x, y), (x + w, y), (x, y + w)]
    if k == 3:
        return [(x, y), (x + w + 2, y), (x + w + 2, y + 2), (x + 2, y + 2), (x + 2, y + h + 2), (x, y + h + 2)]
    if k == 4:
        return [(x, y), (x + w, y - w), (x + 2 * w, y), (x + w, y + w)]
    return [(x, y), (x + 6, y), (x + 6, y + h + 2), (x + 4, y + h + 2), (x + 4, y + 2), (x + 2, y + 2),
            (x + 2, y + h + 2), (x, y + h + 2)]


def shape(draw):
    parts = []
    for _ in range(draw.choice((1, 1, 2))):
        x, y = draw.randrange(-2, 3) * 2, draw.randrange(-2, 3) * 2
        holed = draw.random() < 0.2
        parts.append([rectangle(x, y, 8, 8), rectangle(x + 2, y + 2, 4, 4)] if holed else [outline(draw, x, y)])
    return parts


def figure(draw, b):
    parts = []
    for _ in range(draw.randrange(1, 4)):
        k, x, y = draw.randrange(5), draw.randrange(-6, 7) * 2, draw.randrange(-6, 7) * 2
        if k == 0:
            parts.append([rectangle(x, y, draw.randrange(1, 8) * 2, draw.randrange(1, 8) * 2)])
        elif k == 1:
            parts.append([outline(draw, x, y)])
        elif k == 2:  # the shape itself, as a hole: it fits in at exactly one place
            parts += moved(b, (x, y))
        elif k == 3:  # a plate with a hole of the same form
            ring = moved([[b[0][0]]], (x, y), draw.choice((1, -1)))[0][0]
            parts.append([rectangle(x - 16, y - 16, 40, 40), ring])
        else:  # rooms, and a corridor exactly as wide as one of the shape's parts
            xs = [v[0] for v in b[0][0]]
            w = max(xs) - min(xs)
            parts.append([[(x, y), (x + w, y), (x + w, y + 8), (x + w + 6, y + 8), (x + w + 6, y + 20), (x - 6, y + 20),
                           (x - 6, y + 8), (x, y + 8)]])
    return parts


class Result:
    def __init__(self, polygons, segments, points):
        self.polygons, self.segments, self.points = polygons, segments, points

    def has(self, at):
        return in_closed(self.polygons, at) or self.slim(at)

    def slim(self, at):
        return at in self.points or any(on_segment(a, b, at) for a, b in self.segments)

    def places(self, draw):
        own = [v for polygon in self.polygons for ring in polygon for v in ring]
        found = draw.sample(own, min(8, len(own))) + self.points[:4]
        for a, b in self.segments[:4] + draw.sample(edges(self.polygons), min(4, len(own))):
            found += [a, b, ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2), (2 * b[0] - a[0], 2 * b[1] - a[1])]
        return found


def results(operation, b):
    stats = run("buffer", "in.json", "out.json", "--overwrite", "--shape", text(b), "--operation", operation,
                "--degenerate", "--stats", "-", *DIGITS)
    if stats["max_deviation"] != 0 or stats["rounded_again"] != 0:
        report("results in doubles were rounded", stats)
    main = read("out.json", lambda f: f["id"])
    segments = read("out_degenerate_segments.json", lambda f: f["properties"]["fid"])
    points = read("out_degenerate_points.json", lambda f: f["properties"]["fid"])
    return {fid: Result(polygons_of(geometry),
                        [tuple(exact(v) for v in s["coordinates"]) for s in segments.get(fid, [])],
                        [exact(p["coordinates"]) for p in points.get(fid, [])])
            for fid, (geometry,) in main.items()}


def ask(draw, p, b, made, what):
    reflected, asked = moved(b, (0, 0), -1), {"dilate": 0, "erode": 0, "open": 0, "close": 0}
    grown, shrunk = made["dilate"], made["erode"]
    truth = {"dilate": lambda at: touch(moved(reflected, at), p),
             "erode": lambda at: within(moved(b, at), p),
             "open": lambda at: touch(moved(reflected, at), shrunk.polygons, shrunk.segments, shrunk.points),
             "close": lambda at: within(moved(b, at), grown.polygons)}
    corners, own = [v for s in p for ring in s for v in ring], [v for s in b for ring in s for v in ring]
    for operation, result in made.items():
        places = result.places(draw)
        for _ in range(8):
            u, v, s = draw.choice(corners), draw.choice(own), draw.choice((-1, 0, 1))
            places.append((F(u[0] + s * v[0]), F(u[1] + s * v[1])))
        places += [(F(draw.randrange(-99, 99), 7), F(draw.randrange(-99, 99), 5)) for _ in range(3)]
        for at in places:
            asked[operation] += 1
            if truth[operation](at) != result.has(at):
                report(operation, "of", what, text(p), "by", text(b), "at", at, "says", result.has(at))
            if operation == "dilate" and result.slim(at) and overlap(moved(reflected, at), p):
                report("no degenerate hole of", text(p), "by", text(b), "at", at)
    return sum(asked.values())


def membership(draw):
    asked = slim = 0
    each = 8  # figures per shape
    for _ in range(max(1, SCENES // each)):
        b = shape(draw)
        figures = [f for f in (figure(draw, b) for _ in range(each)) if not any(fault([part]) for part in f)]
        if fault(b[:1]) or fault(b[1:]) or not figures:
            continue
        write("in.json", figures)
        made = {operation: results(operation, b) for operation in ("dilate", "erode", "open", "close")}
        for i, p in enumerate(figures):
            mine = {operation: by_fid[i + 1] for operation, by_fid in made.items()}
            slim += len(mine["erode"].segments) + len(mine["erode"].points)
            asked += ask(draw, p, b, mine, i + 1)
    if asked < 100 or slim == 0:
        report("nothing was asked:", asked, slim)
    return asked


# ---- Rounding --------------------------------------------------------------------------------------------------------


def triangle(draw, x, y, unit):
    corner = [(x + draw.randrange(9) * unit, y + draw.randrange(9) * unit) for _ in range(3)]
    return [corner]


def whole(polygons):
    """The same, scaled up so that all numbers are whole."""
    scale = max([F(v).denominator for p in polygons for ring in p for at in ring for v in at], default=1)
    return [[[(int(x * scale), int(y * scale)) for x, y in ring] for ring in p] for p in polygons]


def ask_rounded(draw, p, b, geometry, allowed):
    written, exact_sum = polygons_of(geometry), run("sum", text(p), text(b), "--exact")
    truth = edges([[[(F(x), F(y)) for x, y in ring] for ring in [s["outer"], *s["holes"]]]
                   for s in exact_sum["polygons"]])
    if fault(whole(written)):
        report(fault(whole(written)), text(p), "by", text(b))
    for a, c in draw.sample(edges(written), min(5, len(edges(written)))):
        for at in (a, (F(a[0] + c[0]) / 2, F(a[1] + c[1]) / 2)):
            if min(square_of_distance(at, *side) for side in truth) > allowed ** 2:
                report("off by more than", float(allowed), text(p), "by", text(b), "at", at)


def rounding(draw, scenes):
    repaired = rounded = 0
    each = 5  # figures per run
    for _ in range(scenes // each):
        unit = draw.choice((0.1, 1e-8, 1e-9))
        x, y = draw.choice((0.1, 1e7)), draw.choice((0, 1 / 7, 3e6))
        figures = [[t for t in (triangle(draw, x, y, unit) for _ in range(5)) if not fault([t])] for _ in range(each)]
        b = [[[(0.0, 0.0), (2 * unit, 0.0), (0.0, unit)]], [[(3 * unit, 0.0), (4 * unit, 0.0), (4 * unit, unit)]]]
        write("in.json", figures)
        stats = run("buffer", "in.json", "out.json", "--overwrite", "--shape", text(b), "--stats", "-", *DIGITS)
        for i, (geometry,) in read("out.json", lambda f: f["id"] - 1).items():
            if figures[i]:
                ask_rounded(draw, figures[i], b, geometry, F(stats["max_deviation"]))
        repaired += stats["rounded_again"]
        rounded += stats["max_deviation"] > 0
    if rounded == 0 or repaired == 0:
        report("nothing was rounded, or repaired")
    return repaired


def main():
    draw = random.Random(SEED)
    asked = membership(draw)
    repaired = rounding(draw, max(60, SCENES))
    print(f"{asked} places tested, {repaired} polygons repaired in rounding, {wrong} wrong")
    sys.exit(1 if wrong else 0)


main()
