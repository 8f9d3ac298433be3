#!/usr/bin/env python3
"""Inputs that occur in maps and on which geometry code is slow.

    hard_inputs.py KIND SIZE [SEED]     P and Q, a line of WKT each, or, for a layer, a CSV of WKT with a field "fixed"

Coordinates are printed so that they read back as the same doubles. Kinds, and what is hard about them:

pairs   arcs, bows     two round outlines that overlap deeply; bows: the same, two neighbouring vertices swapped in each; bows4: at four places
        scribble       a ring through random places: about SIZE^2 / 6 crossings; Q a small square
        track          a random walk that is closed at the end: about SIZE crossings; Q a small square
        versions       SIZE copies of one outline, every corner displaced by up to a millimetre; Q a disc's polygon
        slivers        SIZE long rectangles, shifted by up to a micrometre; Q an L
        pile           SIZE nearly coincident rectangles as one set; Q an L
        stairs         an outline traced along pixels, and the same next to it
        copies         a coast, and the same coast digitised again
        ragged         a star of long thin spikes, and another a little aside
        rough          the same with spikes of two thirds of the radius
        even           two stars with spikes of equal length
        round          a star of spikes, and a round outline of the same size
        even-round     the same with spikes of equal length
        coast          a star of spikes, and a coast of the same size
        hollow         a plate with a star-shaped hole, and a star that does not quite fit into it
        combs          two combs, one upside down in the other
        spikes-box     a star, and a small square at its centre
        detail         SIZE vertices on a small outline, far from a large simple one; Q a triangle
layers  pairs          SIZE pairs of squares that overlap, far from each other
        pairs-far      the same, and another pair whose squares overlap deeply
        outline        SIZE houses, every third too near its neighbour, along the inside and on the boundary of one fixed outline
        versions-layer the features of versions, one by one
        heap           SIZE nearly coincident rectangles
        houses         SIZE detached houses on a grid
        houses-bows    the same, 40 of them with a tiny crossing
        crowd          SIZE houses that are too near each other, hundreds in one crowd, and among them two walled courtyards
                       with two houses each, one of them in the gate
        crowd-full     the same with four houses in each courtyard, for which there is no room
"""
import math
import random
import sys

EAST, NORTH = 451234.567, 5411234.567


def ring(points):
    return "(" + ", ".join("%r %r" % p for p in points + points[:1]) + ")"


def polygon(points):
    return "POLYGON (" + ring(points) + ")"


def multipolygon(members):
    return "MULTIPOLYGON (" + ", ".join("(" + ring(m) + ")" for m in members) + ")"


def rectangle(x, y, width, height, turn=0.0):
    c, s = math.cos(turn), math.sin(turn)
    return [(x + c * u - s * v, y + s * u + c * v) for u, v in ((0, 0), (width, 0), (width, height), (0, height))]


def disc(radius, corners=32):
    return [(radius * math.cos(2 * math.pi * i / corners), radius * math.sin(2 * math.pi * i / corners))
            for i in range(corners)]


def swapped(points, places):
    """Swaps neighbouring vertices, so that the ring crosses itself there."""
    points = list(points)
    for k in range(places):
        i = (2 * k + 1) * len(points) // (2 * places) % (len(points) - 1)
        points[i], points[i + 1] = points[i + 1], points[i]
    return points


def stadium(n, x, y):
    """A line of 80 m dilated by 60 m, finely flattened, rounded to the micrometre."""
    half = n // 2
    turn = [math.pi * (i / (half - 1) - 0.5) for i in range(half)]
    right = [(x + 80 + 60 * math.cos(a), y + 60 * math.sin(a)) for a in turn]
    left = [(x - 60 * math.cos(a), y - 60 * math.sin(a)) for a in turn]
    return [(round(u, 6), round(v, 6)) for u, v in right + left]


def arcs(n, _, bows=0):
    return [polygon(swapped(stadium(n, EAST, NORTH), bows)), polygon(swapped(stadium(n, EAST + 12.5, NORTH + 19.75), bows))]


def scribble(n, draw):
    return [polygon([(round(EAST + draw.uniform(0, 900), 3), round(NORTH + draw.uniform(0, 900), 3)) for _ in range(n)]),
            polygon(rectangle(0.0, 0.0, 1.0, 1.0))]


def track(n, draw):
    x, y, heading, walk = EAST, NORTH, 0.0, []
    for _ in range(n):
        heading += draw.gauss(0, 0.6)
        x, y = x + 2 * math.cos(heading), y + 2 * math.sin(heading)
        walk.append((round(x, 3), round(y, 3)))
    return [polygon(walk), polygon(rectangle(0.0, 0.0, 1.0, 1.0))]


def outline_versions(n, draw):
    c, s = math.cos(0.7), math.sin(0.7)
    corners = [(0, 0), (18, 0), (18, 9), (11, 9), (11, 15), (0, 15)]
    return [[(EAST + c * u - s * v + draw.uniform(-1e-3, 1e-3), NORTH + s * u + c * v + draw.uniform(-1e-3, 1e-3))
             for u, v in corners] for _ in range(n)]


def versions(n, draw):
    return [multipolygon(outline_versions(n, draw)), polygon(disc(5.0))]


def slivers(n, draw):
    members = [rectangle(draw.uniform(0, 1e-6), draw.uniform(0, 1e-6), 1000.0, 1.0, 0.3) for _ in range(n)]
    return [multipolygon(members), "POLYGON ((0 0, 4 0, 4 1, 1 1, 1 4, 0 4, 0 0))"]


def blob(draw):
    waves = [(k, draw.uniform(-1, 1) / k, draw.uniform(0, 2 * math.pi)) for k in range(1, 60)]
    return lambda angle: 1 + 0.12 * sum(a * math.sin(k * angle + p) for k, a, p in waves)


def stairs(n, draw):
    shape, pixels, steps = blob(draw), [], n // 2
    for i in range(steps):
        angle = 2 * math.pi * i / steps
        r = steps / 6 * shape(angle)
        pixel = (round(r * math.cos(angle)), round(r * math.sin(angle)))
        if not pixels or pixel != pixels[-1]:
            if pixels and pixel[0] != pixels[-1][0] and pixel[1] != pixels[-1][1]:
                pixels.append((pixel[0], pixels[-1][1]))
            pixels.append(pixel)
    at = lambda dx, dy: [(654900.0 + 0.5 * x + dx, 5294900.0 + 0.5 * y + dy) for x, y in pixels]
    return [polygon(at(0.0, 0.0)), polygon(at(2.0, 1.5))]


def copies(n, draw):
    shape = blob(draw)
    coast = [1000 * (shape(2 * math.pi * i / n) + draw.uniform(-0.002, 0.002)) for i in range(n)]
    at = lambda i, r: (EAST + r * math.cos(2 * math.pi * i / n), NORTH + r * math.sin(2 * math.pi * i / n))
    again = [at(i, r) for i, r in enumerate(coast) if draw.random() >= 0.1]
    return [polygon([at(i, r) for i, r in enumerate(coast)]),
            polygon([(x + 1.0 + draw.uniform(-0.3, 0.3), y + 0.5 + draw.uniform(-0.3, 0.3)) for x, y in again])]


def star(n, draw, x, y, least, most):
    return [(x + r * math.cos(2 * math.pi * i / n), y + r * math.sin(2 * math.pi * i / n))
            for i in range(n) for r in (draw.uniform(least, most),)]


def ragged(n, draw, least=10):
    return [polygon(star(n, draw, EAST, NORTH, least, 1000)),
            polygon(star(n, draw, EAST + 30.5, NORTH + 20.25, least, 1000))]


def even_star(n, x, y):
    return [(x + r * math.cos(2 * math.pi * i / n), y + r * math.sin(2 * math.pi * i / n))
            for i in range(n) for r in ((1000, 10)[i % 2],)]


def even(n, _):
    return [polygon(even_star(n, EAST, NORTH)), polygon(even_star(n, EAST + 30.5, NORTH + 20.25))]


def round_outline(n):
    return [(EAST + 30.5 + x, NORTH + 20.25 + y) for x, y in disc(1000.0, n)]


def against_round(n, draw, even=False):
    return [polygon(even_star(n, EAST, NORTH) if even else star(n, draw, EAST, NORTH, 10, 1000)), polygon(round_outline(n))]


def coast(n, draw):
    shape = blob(draw)
    return [polygon(star(n, draw, EAST, NORTH, 10, 1000)),
            polygon([(EAST + 30.5 + (x - EAST - 30.5) * shape(2 * math.pi * i / n),
                      NORTH + 20.25 + (y - NORTH - 20.25) * shape(2 * math.pi * i / n))
                     for i, (x, y) in enumerate(round_outline(n))])]


def hollow(n, draw):
    plate = rectangle(EAST - 1100.0, NORTH - 1100.0, 2200.0, 2200.0)
    hole = star(n, draw, EAST, NORTH, 300, 1000)
    return ["POLYGON (%s, %s)" % (ring(plate), ring(hole)), polygon(star(n, draw, EAST + 20.0, NORTH + 30.25, 10, 310))]


def combs(n, draw):
    def comb(x, y, up):
        step, points = 4000.0 / n, [(0.0, -50.0), (1000.0, -50.0)]
        for i in reversed(range(n // 4)):
            foot, top = draw.uniform(0, 15), draw.uniform(90, 300)
            points += [(step * (i + u), v) for u, v in ((0.6, top), (0.35, top), (0.3, foot), (0.0, foot))]
        return [(x + up * u, y + up * v) for u, v in points]
    return [polygon(comb(EAST, NORTH, 1)), polygon(comb(EAST + 1003.0, NORTH + 500.0, -1))]


def spikes_box(n, draw):
    return [polygon(star(n, draw, EAST, NORTH, 10, 1000)), polygon(rectangle(EAST - 5.0, NORTH - 5.0, 10.0, 10.0))]


def detail(n, draw):
    small = [(EAST + r * math.cos(2 * math.pi * i / n), NORTH + r * math.sin(2 * math.pi * i / n))
             for i in range(n) for r in (draw.uniform(0.9, 1.0),)]
    return [multipolygon([small, rectangle(EAST + 1e5, NORTH + 1e5, 5000.0, 5000.0)]),
            "POLYGON ((0 0, 0.01 0, 0 0.01, 0 0))"]


def pairs(n, _, far=False):
    side = math.ceil(math.sqrt(n))
    rows = []
    for i in range(n):
        x, y = EAST + 40.0 * (i % side), NORTH + 40.0 * (i // side)
        rows += [(rectangle(x, y, 10.0, 10.0), 0), (rectangle(x + 8.0, y + 3.0, 10.0, 10.0), 0)]
    if far:
        x = EAST - 3000.0
        rows += [(rectangle(x, NORTH, 1000.0, 1000.0), 0), (rectangle(x + 200.0, NORTH + 100.0, 1000.0, 1000.0), 0)]
    return rows


def outline(n, _):
    side = 20.0 * n / 4
    rim = [(20.0 * i + (8.5 if i % 3 == 0 else 0.0), -4.0 + 3.0 * (i % 2)) for i in range(n // 4)]
    turned = [lambda u, v: (u, v), lambda u, v: (side - v, u), lambda u, v: (side - u, side - v), lambda u, v: (v, side - u)]
    rows = [(rectangle(EAST, NORTH, side, side), 1)]
    for turn in turned:
        rows += [([(EAST + x, NORTH + y) for x, y in (turn(u + a, v + b) for a, b in ((0, 0), (10, 0), (10, 3.5), (0, 3.5)))], 0)
                 for u, v in rim]
    return rows


def heap(n, draw):
    return [(rectangle(EAST + draw.uniform(0, 1e-3), NORTH + draw.uniform(0, 1e-3), 20.0 + draw.uniform(0, 1e-3),
                       12.0 + draw.uniform(0, 1e-3), 0.4 + draw.uniform(0, 1e-5)), 0) for _ in range(n)]


def pile(n, draw):
    return [multipolygon([body for body, _ in heap(n, draw)]), "POLYGON ((0 0, 4 0, 4 1, 1 1, 1 4, 0 4, 0 0))"]


def houses(n, draw, bows=0):
    side, rows = math.ceil(math.sqrt(n)), []
    for i in range(n):
        body = rectangle(EAST + 25.0 * (i % side), NORTH + 25.0 * (i // side), draw.uniform(8, 14), draw.uniform(7, 12),
                         draw.uniform(-0.2, 0.2))
        a, b = body[1], body[2]
        body[2:2] = [(a[0] + t * (b[0] - a[0]) + 0.4 * k, a[1] + t * (b[1] - a[1])) for t, k in ((0.3, 1), (0.6, 1))]
        rows.append(([(round(x, 3), round(y, 3)) for x, y in body], 0))
    step = max(1, n // bows) if bows else n + 1
    return [(swapped(body, 1), fixed) if i % step == step // 2 else (body, fixed) for i, (body, fixed) in enumerate(rows)]


def crowd(n, draw, full=False):
    side, rows = math.ceil(math.sqrt(n)), []
    yards = [(0.3 * side, 0.3 * side), (0.7 * side, 0.6 * side)]
    for i in range(n):
        u, v = i % side, i // side
        if any(abs(u - a) < 2.2 and abs(v - b) < 2.2 for a, b in yards):
            continue
        rows.append((rectangle(EAST + 13.6 * u + draw.uniform(-1, 1), NORTH + 13.6 * v + draw.uniform(-1, 1),
                               draw.uniform(8, 13), draw.uniform(7, 11), draw.uniform(-0.1, 0.1)), 0))
    for a, b in yards:
        x, y = EAST + 13.6 * a - 8.0, NORTH + 13.6 * b - 8.0
        rows += [(rectangle(x + u, y + v, width, height), 1) for u, v, width, height in
                 ((-1, -1, 28, 1), (-1, 0, 1, 27), (26, 0, 1, 27), (0, 26, 6, 1), (20, 26, 6, 1))]
        places = ((3, 3), (13.5, 3.5), (2.5, 13), (13, 14)) if full else ((8, 3), (8, 22))
        rows += [(rectangle(x + u, y + v, 10, 10), 0) for u, v in places]
    return rows


PAIRS = {"arcs": arcs, "bows": lambda n, draw: arcs(n, draw, 1), "bows4": lambda n, draw: arcs(n, draw, 4),
         "scribble": scribble, "track": track, "versions": versions,
         "slivers": slivers, "stairs": stairs, "pile": pile, "copies": copies, "ragged": ragged,
         "rough": lambda n, draw: ragged(n, draw, 333), "even": even, "round": against_round,
         "even-round": lambda n, draw: against_round(n, draw, True), "coast": coast, "hollow": hollow, "combs": combs, "spikes-box": spikes_box, "detail": detail}
LAYERS = {"pairs": pairs, "pairs-far": lambda n, draw: pairs(n, draw, True), "outline": outline, "heap": heap,
          "versions-layer": lambda n, draw: [(body, 0) for body in outline_versions(n, draw)], "houses": houses,
          "houses-bows": lambda n, draw: houses(n, draw, 40), "crowd": crowd,
          "crowd-full": lambda n, draw: crowd(n, draw, True)}


def main(kind, size, seed="1"):
    draw = random.Random(int(seed))
    if kind in PAIRS:
        print("\n".join(PAIRS[kind](int(size), draw)))
    else:
        print("WKT,fixed")
        for body, fixed in LAYERS[kind](int(size), draw):
            print('"%s",%d' % (polygon(body), fixed))


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4) or sys.argv[1] not in {**PAIRS, **LAYERS}:
        sys.exit(__doc__)
    main(*sys.argv[1:])
