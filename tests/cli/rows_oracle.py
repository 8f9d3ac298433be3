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
from fractions import Fraction

MARGIN = 1e-9
GRID = 2.0**20  # coordinates are multiples of 1 / GRID, so that towns are shifted without rounding
APART = 4096.0  # distance between the origins of two towns
TOWNS = 12  # towns in a layer
FAR = 10 * TOWNS * APART

# ---- The rule ------------------------------------------------------------------------------------------------------------

REACH, ANGLE, STRAIGHT, SHARED, DEPTHS, LEAST = 4, 15, 0.1, 0.5, 2.5, 3


class Undecided(Exception):
    """A quantity is within the margin of its threshold."""


def at_most(a, b):
    """a <= b; None: undecided."""
    return None if abs(a - b) <= MARGIN and a != b else a <= b


def all_of(*answers):
    """False if one of the answers is; otherwise None if one is undecided."""
    return False if any(a is False for a in answers) else None if None in answers else True


class House:
    """A feature: rings of points without closing ones, relative to the origin of its town."""

    def __init__(self, parts, fixed=0, ignored=0, block=None):
        self.parts = parts  # of its rings
        self.fixed, self.ignored, self.block = fixed, ignored, block
        self.corners = [p for rings in parts for ring in rings for p in ring]
        self.edges = [(r[k - 1], r[k]) for rings in parts for r in rings for k in range(len(r))]
        self.box = [min(p[0] for p in self.corners), min(p[1] for p in self.corners), max(p[0] for p in self.corners),
                    max(p[1] for p in self.corners)]
        self.walls, self.length = walls_of(self.edges)


def walls_of(edges):
    """The sum of the walls as vectors with their angle times four, and their total length."""
    total, length = 0, 0
    for (ax, ay), (bx, by) in edges:
        d = abs(complex(bx - ax, by - ay))
        z = complex(bx - ax, by - ay) / d
        z *= z
        total += d * z * z
        length += d
    return total, length


def holds(house, p):
    """Is the point in the polygon (even-odd)?"""
    odd = False
    for (ax, ay), (bx, by) in house.edges:
        if (ay > p[1]) != (by > p[1]) and p[0] < ax + (p[1] - ay) / (by - ay) * (bx - ax):
            odd = not odd
    return odd


def turn(a, b, c):
    """On which side of ab is c? 0: undecided."""
    area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return 0 if abs(area) <= MARGIN * (1 + math.dist(a, b)) else 1 if area > 0 else -1


def foot(p, a, b):
    """The nearest point of the segment ab."""
    ux, uy = b[0] - a[0], b[1] - a[1]
    square = ux * ux + uy * uy
    t = 0 if square == 0 else max(0.0, min(1.0, ((p[0] - a[0]) * ux + (p[1] - a[1]) * uy) / square))
    return (a[0] + t * ux, a[1] + t * uy)


def links_of_edges(e, f):
    """The links from the ends of each of two segments to the nearest point of the other one."""
    return [(p, foot(p, *f)) for p in e] + [(foot(p, *e), p) for p in f]


def cross(e, f):
    """Do two segments meet? None: undecided."""
    if min(math.dist(*k) for k in links_of_edges(e, f)) > MARGIN:
        sides = turn(*e, f[0]), turn(*e, f[1]), turn(*f, e[0]), turn(*f, e[1])
        return None if 0 in sides and sides[0] * sides[1] <= 0 and sides[2] * sides[3] <= 0 else \
            sides[0] != sides[1] and sides[2] != sides[3]
    return None


def exact_foot_square(p, a, b):
    p, a, b = ([Fraction(v) for v in q] for q in (p, a, b))
    u = [b[0] - a[0], b[1] - a[1]]
    t = max(Fraction(0), min(Fraction(1), ((p[0] - a[0]) * u[0] + (p[1] - a[1]) * u[1]) / (u[0] * u[0] + u[1] * u[1])))
    return (a[0] + t * u[0] - p[0])**2 + (a[1] + t * u[1] - p[1])**2


def off_box(segment, box):
    """A lower bound of the distance of a segment from a box; for a segment given by two corners: of its box."""
    return math.hypot(*(max(0, min(p[c] for p in segment) - box[c + 2], box[c] - max(p[c] for p in segment)) for c in (0, 1)))


class Near:
    """Two houses: their distance and their shortest links (the two outermost ones if there are many)."""

    def __init__(self, f, g, p, q, reach):
        self.f, self.g, self.p, self.q = f, g, p, q
        self.distance, self.links = math.inf, []
        off = off_box((p.box[:2], p.box[2:]), q.box)
        if off > reach + 1:
            return
        links = []
        for e in p.edges:
            if off_box(e, q.box) <= self.distance + 1:
                links += [(math.dist(*k), k) for d in q.edges for k in links_of_edges(e, d)]
                self.distance = min(links)[0]
        self.links = [k for length, k in links if length <= self.distance + 10 * MARGIN]
        if off > 0:
            return
        if any(cross(e, d) for e in p.edges for d in q.edges):
            self.distance = 0
        elif self.distance <= MARGIN:
            if self.exact_square() != 0:
                raise Undecided
            self.distance = 0
        elif any(holds(a, rings[0][0]) for a, b in ((p, q), (q, p)) for rings in b.parts):
            self.distance = 0

    def exact_square(self):
        """The squared distance of the two boundaries, unless they cross."""
        return min(exact_foot_square(v, *e) for a, b in ((self.p, self.q), (self.q, self.p)) for e in a.edges
                   for v in b.corners if math.dist(v, foot(v, *e)) <= self.distance + MARGIN)

    def is_exact(self):
        return self.distance == 0 or Fraction(self.distance)**2 == self.exact_square()

    def is_nearer(self, other):
        """Is the distance less than that of the other pair?"""
        if self is other or abs(self.distance - other.distance) > MARGIN:
            return self.distance < other.distance
        if self.distance == other.distance and self.is_exact() and other.is_exact():
            return False
        raise Undecided


def extent(house, axis):
    at = [x * axis[0] + y * axis[1] for x, y in house.corners]
    return min(at), max(at)


def apart(e, f):
    return max(e[0] - f[1], f[0] - e[1])


def stand_side_by_side(p, q, gap):
    """None: not neighbours; else the direction towards q, as a unit vector, and the offset."""
    share = [at_most(h.length * STRAIGHT, abs(h.walls)) for h in (p, q)]
    if False in share:
        return None
    if None in share:
        raise Undecided
    u, v = p.walls / abs(p.walls), q.walls / abs(q.walls)
    parallel = at_most(abs(cmath.phase(u / v)), math.radians(4 * ANGLE))
    if parallel is False:
        return None
    direction = cmath.rect(1, cmath.phase(u + v) / 4)
    axes = [(direction.real, direction.imag), (-direction.imag, direction.real)]
    stand = [[extent(h, axis) for h in (p, q)] for axis in axes]
    separation = [apart(*s) for s in stand]
    one = [judge(axes[k], stand[k], stand[1 - k], (1, -1)[k], gap) for k in (0, 1)]
    if abs(separation[0] - separation[1]) <= MARGIN:
        if one == [None, None]:
            return None
        raise Undecided
    found = one[0] if separation[0] > separation[1] else one[1]
    if found is None:
        return None
    if found == "open" or parallel is None:
        raise Undecided
    return found


def judge(axis, along, across, left, gap):
    """left: -1 if `across` was measured to the right of the axis, else 1."""
    shorter = [min(b - a for a, b in extents) for extents in (along, across)]
    depths = sorted(b - a for a, b in across)
    if sum(along[0]) > sum(along[1]):
        axis, left = (-axis[0], -axis[1]), -left
    low, high = across[1][0] - across[0][0], across[1][1] - across[0][1]
    offsets = sorted([low, high, (low + high) / 2], key=abs)
    answer = all_of(at_most(-SHARED * shorter[0], apart(*along)), at_most(apart(*across), -SHARED * shorter[1]),
                    at_most(depths[1], DEPTHS * depths[0]), at_most(abs(offsets[0]), gap))
    if answer is False:
        return None
    if answer is None or abs(abs(offsets[0]) - abs(offsets[1])) <= MARGIN < abs(offsets[0] - offsets[1]):
        return "open"
    return axis, left * offsets[0]


class Edge:
    """Two bodies side by side: i, j; their houses f, g that are nearest to each other; the direction; the offset."""

    def __init__(self, i, j, near, axis, offset):
        self.i, self.j, self.f, self.g, self.near, self.axis, self.offset = i, j, near.f, near.g, near, axis, offset

    def towards(self, body):
        return self.axis if body == self.j else (-self.axis[0], -self.axis[1])

    def other(self, body):
        return self.j if body == self.i else self.i


def is_crossed(near, lines):
    """Does a line of a barrier cross the shortest link?"""
    if near.distance == 0:
        return False
    first, last = min(near.links), max(near.links)
    links = [first, last] + [tuple(tuple(a[c] + (b[c] - a[c]) * k / 8 for c in (0, 1)) for a, b in zip(first, last))
                             for k in range(1, 8)]
    links += near.links
    answers = {any_of(cross(k, line) for line in lines) for k in links}
    hull = [first[0], first[1], last[1], last[0]]
    if answers == {False} and any(cross((hull[k - 1], hull[k]), line) is not False for line in lines for k in range(4)):
        raise Undecided
    if len(answers) > 1 or None in answers:
        raise Undecided
    return answers == {True}


def any_of(answers):
    answers = list(answers)
    return True if True in answers else None if None in answers else False


def tried(question, *arguments):
    """The answer to the question; None: undecided."""
    try:
        return question(*arguments)
    except Undecided:
        return None


def stand_alone(pair, near, distance, bodies):
    """Are the two neighbours in the relative neighbourhood graph?"""
    third = [k for k in range(bodies) if (pair[0], k) in distance and (pair[1], k) in distance]
    between = [all_of(*(tried(distance[b, k].is_nearer, near) for b in pair)) for k in third]
    return {True: False, None: None, False: True}[any_of(between)]


def made_edge(i, j, near, houses, lines, gap):
    """The edge; False: the two are not side by side; None: undecided."""
    try:
        found = stand_side_by_side(houses[near.f], houses[near.g], gap)
    except Undecided:
        return False if tried(is_crossed, near, lines) else None
    if found is None:
        return False
    crossed = tried(is_crossed, near, lines)
    return None if crossed is None else False if crossed else Edge(i, j, near, *found)


def edges_of(bodies, houses, lines, gap):
    """The edges of all bodies, which are lists of numbers of houses."""
    reach = REACH * gap
    nearest = {}
    for j in range(len(bodies)):
        for i in range(j):
            nears = [Near(f, g, houses[f], houses[g], reach) for f in bodies[i] for g in bodies[j]]
            least = min(n.distance for n in nears)
            if least <= reach + 1:
                nearest[i, j] = nearest[j, i] = [n for n in nears if n.distance <= least + MARGIN]
    distance = {pair: nears[0] for pair, nears in nearest.items()}
    edges = []
    for (i, j), nears in nearest.items():
        alone = i < j and at_most(nears[0].distance, reach) and stand_alone((i, j), nears[0], distance, len(bodies))
        if alone is False:
            continue
        # If several members of a block are equally near, the choice makes no difference as long as none makes an edge.
        made = [made_edge(i, j, n, houses, lines, gap) for n in nears]
        if set(made) == {False}:
            continue
        if alone is None or None in made or len(made) > 1:
            raise Undecided
        edges += made
    return edges


def side_of(body, houses, direction):
    walls = sum(houses[f].walls for f in body)
    if abs(walls) <= MARGIN * sum(houses[f].length for f in body):
        raise Undecided
    axis = cmath.rect(1, cmath.phase(walls) / 4)
    seen = complex(*direction) / axis
    if abs(abs(seen.real) - abs(seen.imag)) <= MARGIN:
        raise Undecided
    return (0 if seen.real > 0 else 2) if abs(seen.real) > abs(seen.imag) else 1 if seen.imag > 0 else 3


def rows_of(bodies, houses, lines, gap):
    """The rows: for each the list of its edges, in order from its first body, and whether it is a ring."""
    side = [{} for _ in bodies]
    for edge in edges_of(bodies, houses, lines, gap):
        for body in (edge.i, edge.j):
            side[body].setdefault(side_of(bodies[body], houses, edge.towards(edge.other(body))), []).append(edge)
    nearest = [{s: [e for e in edges if not any(d.near.is_nearer(e.near) for d in edges)] for s, edges in sides.items()}
               for sides in side]
    if any(len(e) > 1 for sides in nearest for e in sides.values()):
        raise Undecided
    mutual = [{s: e[0] for s, e in sides.items()} for sides in nearest]
    mutual = [{s: e for s, e in sides.items() if e in mutual[e.other(b)].values()} for b, sides in enumerate(mutual)]
    rows, used = [], set()
    ends = [(b, s) for b, sides in enumerate(mutual) for s in sides if s ^ 2 not in sides]
    for b, s in ends + [(b, s) for b, sides in enumerate(mutual) for s in sides]:
        row, first = [], b
        while s in mutual[b] and id(mutual[b][s]) not in used:
            edge = mutual[b][s]
            used.add(id(edge))
            row.append((b, edge))
            b = edge.other(b)
            s = next(k for k, e in mutual[b].items() if e is edge) ^ 2
        if len({c for c, _ in row} | {b}) >= LEAST:
            rows.append((row, b == first))
    return rows


class Row:
    """A row as it should be written: its houses by FID, its kinks before the moves, and the changes by the moves."""

    def __init__(self, row, ring, fids):
        chain = []
        self.edges = []
        for b, edge in row:
            f, g = (edge.f, edge.g) if b == edge.i else (edge.g, edge.f)
            chain += [fids[f], fids[g]] if not chain or chain[-1] != fids[f] else [fids[g]]
            self.edges.append((fids[edge.f], fids[edge.g], edge.axis, edge.offset))
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
        return max(abs(offset) for *_, offset in self.edges)

    def bends(self, move):
        return [(move[g][1] - move[f][1]) * axis[0] - (move[g][0] - move[f][0]) * axis[1] for f, g, axis, _ in self.edges]

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
        kind, own = rng.randrange(8), []
        part = (street(rng, gap, rng.randrange(4, 14), own) if kind < 4 else terrace(rng, gap, rng.randrange(5, 14))
                if kind == 4 else ring(rng, gap, rng.randrange(22, 30)) if kind == 5 else
                grid(rng, gap, rng.randrange(2, 6), rng.randrange(2, 5)) if kind == 6 else heap(rng, rng.randrange(5, 14)))
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
    words = [sunder, "separate", "l.geojson", "o.gpkg", "--overwrite", "-q", "--allow-conflicts", "--output-layer", "l",
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
    kinks = sorted(abs(b) for r in expected for b in r.bends(output.move))
    n = len(kinks)
    most = layer.gap / 10
    figures = {"rows": len(expected), "features": 0, "kink_mean": sum(kinks) / max(n, 1),
               "kink_p95": kinks[n - 1 - n // 20] if n else 0, "kink_share": sum(k > most for k in kinks) / max(n, 1)}
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
