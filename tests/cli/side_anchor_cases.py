"""Compares anchors and side anchors of the library with those of anchor.py and side_anchor.py: cases made by hand,
and random ones on coarse grids, where lines run along edges, through corners and cross each other: python3
side_anchor_cases.py ANCHORS [COUNT [SEED]]
"""
import random
import subprocess
import sys
from fractions import Fraction

import exact_plane as plane
from anchor import anchor
from side_anchor import side_anchor

UNIT = 1 << 40  # coordinates are multiples of 2^-40


def words_of_set(polygons):
    words = [len(polygons)]
    for rings in polygons:
        words.append(len(rings))
        for ring in rings:
            words.append(len(ring))
            words += [float(v).hex() for p in ring for v in p]
    return words


def ask(program, cases):
    text = []
    for k, (_, polygons, lines, areas) in enumerate(cases):
        words = [k, *words_of_set(polygons), len(lines)]
        for line in lines:
            words += [len(line), *(float(v).hex() for p in line for v in p)]
        words.append(len(areas))
        for area in areas:
            words += words_of_set(area)
        text.append(" ".join(map(str, words)) + "\n")
    done = subprocess.run([program], input="".join(text), capture_output=True, text=True, check=True)
    return [tuple(map(float.fromhex, line.split()[1:])) for line in done.stdout.splitlines()]


def whole(chain):
    return [(int(Fraction(x) * UNIT), int(Fraction(y) * UNIT)) for x, y in chain]


def wanted(polygons, lines, areas, plain):
    members = [plane.Outline([whole(r) for r in rings]) for rings in polygons]
    sides = plane.Outline([whole(r) for area in areas for rings in area for r in rings], [whole(c) for c in lines])
    return side_anchor(members, sides.edges, plain, UNIT) or plain


def anchor_wanted(polygons):
    return anchor([plane.Outline([whole(r) for r in rings]).edges for rings in polygons], UNIT)


def box(x, y, w, h):
    return [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]


square, yard = [[box(0, 0, 8, 8)]], [[box(0, 0, 8, 8), box(2, 2, 4, 4)[::-1]]]
HAND = [
    ("nothing near", square, [[(20, 0), (20, 9)]], []),
    ("through", square, [[(3, -1), (3, 9)]], []),
    ("ends inside", square, [[(3, -1), (3, 6)]], []),
    ("ends at the anchor", square, [[(-3, 4), (4, 4)]], []),
    ("through the anchor", square, [[(-3, 4), (14, 4)]], []),
    ("both ends inside", square, [[(3, 4), (5, 4)]], []),
    ("a ring inside", square, [[(1, 1), (7, 1), (7, 7), (1, 7), (1, 1)]], []),
    ("a ring inside, and a tail", square, [[(1, 1), (7, 1), (7, 7), (1, 7), (1, 1), (-1, -1)]], []),
    ("a small ring about the anchor", square, [[(3, 3), (5, 3), (5, 5), (3, 5), (3, 3)]], []),
    ("several that cross", square, [[(-1, 3), (9, 5)], [(3, -1), (5, 9)], [(-1, -1), (9, 9)]], []),
    ("along an edge", square, [[(0, -1), (0, 9)]], []),
    ("along an edge, and inward", square, [[(0, -1), (0, 2), (9, 2)]], []),
    ("at a corner", square, [[(-4, 4), (4, -4)]], []),
    ("from corner to corner", square, [[(0, 0), (8, 8)]], []),
    ("halves", square, [[(4, -1), (4, 9)]], []),
    ("halves, a line beyond the left one", square, [[(4, -1), (4, 9)], [(-9, -1), (-9, 9)]], []),
    ("halves, a line beyond the right one", square, [[(4, -1), (4, 9)], [(29, -1), (29, 9)]], []),
    ("halves, lines beyond both", square, [[(4, -1), (4, 9)], [(-9, -1), (-9, 9)], [(16, -1), (16, 9)]], []),
    ("halves, a line across and one too far", square, [[(4, -1), (4, 9)], [(-9, 4.5), (9, 4.5)], [(90, -1), (90, 9)]], []),
    ("halves, a slanting line beyond", square, [[(-1, 4), (9, 4)], [(-9, -3), (30, -20)]], []),
    ("quarters", square, [[(4, -1), (4, 9)], [(-1, 4), (9, 4)]], []),
    ("a yard, one line", yard, [[(4, -1), (4, 9)]], []),
    ("a yard, one side of it", yard, [[(4, 3), (4, 9)]], []),
    ("within the yard", yard, [[(3, 3), (5, 5)]], []),
    ("two parts, one is cut", [[box(0, 0, 8, 8)], [box(10, 0, 7, 8)]], [[(4, -1), (4, 9)]], []),
    ("two parts, between them", [[box(0, 0, 8, 8)], [box(10, 0, 7, 8)]], [[(9, -1), (9, 9)]], []),
    ("two parts that meet in a corner", [[box(0, 0, 4, 4)], [box(4, 4, 4, 4)]], [[(-1, -1), (9, 9)]], []),
    ("an area about it", square, [], [[[box(-1, -1, 20, 20)]]]),
    ("an area over a part of it", square, [], [[[box(5, -1, 20, 20)]]]),
    ("an area inside", square, [], [[[box(1, 1, 6, 6)]]]),
    ("an area and a line", square, [[(-1, 1), (9, 2)]], [[[box(5, -1, 20, 20)]]]),
    ("two that overlap", [[box(0, 0, 8, 8)], [box(5, 3, 9, 9)]], [], []),
    ("two that overlap, a line through both", [[box(0, 0, 8, 8)], [box(5, 3, 9, 9)]], [[(6, -1), (7, 14)]], []),
    ("two that share a wall, a line along it", [[box(0, 0, 8, 8)], [box(8, 0, 5, 8)]], [[(8, -1), (8, 9)]], []),
    ("two that share a wall", [[box(0, 0, 8, 8)], [box(8, 0, 5, 8)]], [], []),
    ("two that share a part of a level wall", [[box(0, 0, 8, 4)], [box(2, 4, 12, 4)]], [], []),
    ("two that meet in a corner at the middle", [[box(0, 0, 8, 4)], [box(8, 4, 8, 4)]], [], []),
    ("one above the other", [[box(0, 0, 3, 1)], [box(5, 9, 8, 1)]], [], []),
    ("four, none of them in the middle", [[box(0, 0, 3, 1)], [box(5, 1.5, 8, 1)], [box(0, 9, 3, 1)], [box(4, 3, 1, 1)]],
     [], []),
    ("a notch at the middle", [[[(0, 0), (8, 0), (8, 8), (4, 4), (0, 8)]]], [], []),
    ("notches from above and below", [[[(0, 0), (3, 4), (9, 0), (9, 8), (5, 4), (0, 8)]]], [], []),
    ("equal arms", [[[(0, 0), (9, 0), (9, 8), (6, 8), (6, 2), (3, 2), (3, 8), (0, 8)]]], [], []),
    ("nearly equal arms", [[[(0, 0), (9, 0), (9, 8), (6 - 2**-40, 8), (6, 2), (3, 2), (3, 8), (0, 8)]]], [], []),
    ("a level edge at the middle", [[[(0, 0), (9, 0), (9, 4), (3, 4), (3, 8), (0, 8)]]], [], []),
    ("an area that crosses itself", square, [], [[[[(1, -1), (10, 9), (1, 9), (10, -1)]]]]),
    ("an area with a hole about it", square, [], [[[box(-9, -9, 30, 30), box(-1, -1, 10, 10)[::-1]]]]),
    ("a feature that crosses itself", [[[(0, 0), (8, 8), (8, 0), (0, 8)]]], [[(1, -1), (1, 9)]], []),
    ("thinner than doubles tell", [[[(2.0**20, 0), (2.0**20 + 2**-20, 0), (2.0**20 + 2**-20, 8), (2.0**20, 8)]]],
     [[(2.0**20 + 2**-21, -1), (2.0**20 + 2**-21, 9)]], []),
    ("between two neighbouring doubles", [[[(2.0**12, 0), (2.0**12 + 2**-40, 0), (2.0**12 + 2**-40, 8), (2.0**12, 8)]]],
     [[(2.0**12 - 1, 0), (2.0**12 + 1, 9)]], []),
]


def ring_of(r, scale):
    kind = r.randrange(4)
    x, y, w, h = r.randrange(3), r.randrange(3), r.randrange(3, 7), r.randrange(3, 7)
    if kind == 0:
        ring = box(x, y, w, h)
    elif kind == 1:
        ring = [(x, y), (x + w, y), (x + w, y + 1), (x + 1, y + 1), (x + 1, y + h), (x, y + h)]
    elif kind == 2:
        ring = [(x, y), (x + w, y + r.randrange(2)), (x + r.randrange(3), y + h)]
    else:
        ring = [(x, y), (x + w, y + 1), (x + w - 1, y + h + 1), (x - 1, y + h)]
    return [(scale * px, scale * py) for px, py in ring]


def random_case(r, k):
    scale = r.choice([1, 0.125, 0.7, 1234.5678])
    at = [(0, 0), (scale * 2**20, scale * 2**21)][r.randrange(2)]

    def put(chain):
        # Sums of coordinates have to be on the lattice, too.
        return [(round((x + at[0]) * 2**30) / 2**30, round((y + at[1]) * 2**30) / 2**30) for x, y in chain]
    rings = [ring_of(r, scale)]
    if r.randrange(4) == 0:
        (x, y), side = rings[0][0], scale * r.choice([0.25, 0.5])
        rings.append([(x + side, y + side), (x + side, y + 1.5 * side), (x + 1.5 * side, y + 1.5 * side)])
    polygons = [[put(c) for c in rings]]
    if r.randrange(4) == 0:
        polygons.append([put([(px + 12 * scale, py) for px, py in ring_of(r, scale)])])

    def point():
        if r.randrange(3) == 0:
            return r.choice(rings[0])
        step = r.choice([1, 1, 0.5, 0.3])
        return scale * step * r.randrange(-3, 10), scale * step * r.randrange(-3, 10)
    lines = [put([point() for _ in range(r.randrange(1, 5))]) for _ in range(r.randrange(0, 4))]
    areas = []
    if r.randrange(3) == 0:
        areas = [[[put([point() for _ in range(r.choice([3, 3, 4]))])]]]
        corners = areas[0][0][0]
        if len(set(corners)) < 3 or len(corners) == 4:
            areas = [[[put(ring_of(r, scale))]]]
    return f"random {k}", polygons, lines, areas


def main():
    program, count, seed = sys.argv[1], int((sys.argv + ["300"])[2]), int((sys.argv + ["300", "1"])[3])
    r = random.Random(seed)
    cases = HAND + [random_case(r, k) for k in range(count)]
    wrong = cut = 0
    for (name, polygons, lines, areas), (px, py, sx, sy) in zip(cases, ask(program, cases), strict=True):
        right = wanted(polygons, lines, areas, (px, py))
        cut += right != (px, py)
        if anchor_wanted(polygons) != (px, py):
            wrong += 1
            print(f"seed {seed}, {name}: anchor {(px, py)}, not {anchor_wanted(polygons)}", polygons, sep="\n")
        if right != (sx, sy):
            wrong += 1
            print(f"seed {seed}, {name}: {(sx, sy)}, not {right}; anchor {(px, py)}", polygons, lines, areas, sep="\n")
    print(f"{len(cases)} side anchors, {cut} of them not the anchor, {wrong} wrong")
    sys.exit(1 if wrong or cut < count / 20 else 0)


if __name__ == "__main__":
    main()
