"""Symbols without a limit on moves, each alone among random barriers (SUNDER_SEED): lines and areas, convex and
concave, with sides and without, and with as=boundary; corridors, rooms with a door and closed rooms; with a gap and
without. The script computes the nearest free place of each symbol by brute force, which shares no code with the
program: in rationals without a gap, as described in alone_with_gap.py with one.

    alone_in_rooms.py make       writes NAME.gpkg and NAME_KIND_SIDE.gpkg for each group NAME, as copies of
                                 empty_symbols.gpkg and empty_KIND_SIDE.gpkg, and NAME.symbol and NAME.gap
    alone_in_rooms.py check      compares NAME.out.gpkg with the computed places

A move t of the symbol S, a convex polygon about the point a, is free if no barrier meets the interior of S + t, and
the segment from a to a + t meets no line with sides and no edge of an area with sides, except edges by which the
anchor leaves the area (a feature that starts inside may leave, once). The forbidden set is bounded by parts of these
lines:

    the sides of E + (-S), for each edge E of a barrier
    the lines with sides, and the rays from their ends, away from a

So the free place nearest to a is a itself, the foot of a perpendicular on one of these, an end of one, or a crossing
of two. These candidates are tested in order of distance. Lines with sides are closed sets: if the free places near
such a candidate do not include it, the minimum is not attained, and the program may come arbitrarily near to it.

If a symbol has no free place, some of its conflicts remain, and each of them needs a proof: that no place resolves it
without making another conflict of the symbol worse, or (`crowded`) that there is no free place. The move of a symbol without conflicts
is proved to be the cheapest.

With small integers all free places near the nearest one may lie on a line that bounds the forbidden set. Then doubles
may not represent them, or the nearest one is not attained; such a symbol may stay in conflict, or move farther."""
import json
import itertools
import os
import random
import shutil
import sqlite3
import struct
import sys
from fractions import Fraction as F

import alone_with_gap

INFINITE = float("inf")
SURELY = 1e-6  # for products of coordinates of at most some hundred, which doubles compute to within 1e-10


def cross(o, p, q):
    return (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0])


def add(p, q):
    return (p[0] + q[0], p[1] + q[1])


def sub(p, q):
    return (p[0] - q[0], p[1] - q[1])


def dot(p, q):
    return p[0] * q[0] + p[1] * q[1]


def hull(points):
    """Convex hull, counter-clockwise."""
    points = sorted(set(points))
    if len(points) < 3:
        return points
    out = []
    for some in (points, points[::-1]):
        chain = []
        for p in some:
            while len(chain) > 1 and cross(chain[-2], chain[-1], p) <= 0:
                chain.pop()
            chain.append(p)
        out += chain[:-1]
    return out


def edges(ring):
    return list(zip(ring, ring[1:] + ring[:1]))


def is_inside(ring, p):
    """Is p in the interior of the simple ring? None on its boundary."""
    inside = False
    for a, b in edges(ring):
        side = cross(a, b, p)
        if side == 0 and dot(sub(a, p), sub(b, p)) <= 0:
            return None
        if (a[1] > p[1]) != (b[1] > p[1]):
            inside ^= (side > 0) == (b[1] > a[1])
    return inside


def segment_meets_open(convex, p, q):
    """Does the closed segment meet the interior of a convex, counter-clockwise polygon?"""
    low, high = F(0), F(1)
    strict_low, strict_high = False, False
    for a, b in edges(convex):
        s, e = cross(a, b, p), cross(a, b, q)
        if s <= 0 and e <= 0:
            return False
        if s > 0 and e > 0:
            continue
        at = F(s) / (s - e)
        if s <= 0:
            if at >= low:
                low, strict_low = at, True
        elif at <= high:
            high, strict_high = at, True
    return low < high or (low == high and not strict_low and not strict_high)


def segments_cross(a, b, c, d):
    """Do two open segments cross in one point?"""
    return cross(a, b, c) * cross(a, b, d) < 0 and cross(c, d, a) * cross(c, d, b) < 0


def segments_meet(a, b, c, d):
    """Do two closed segments have a point in common?"""
    def within(p, q, r):
        return cross(p, q, r) == 0 and dot(sub(p, r), sub(q, r)) <= 0
    if within(a, b, c) or within(a, b, d) or within(c, d, a) or within(c, d, b):
        return True
    return segments_cross(a, b, c, d)


class World:
    """anchor, symbol (about the origin, convex, counter-clockwise); barriers: (kind, points, sides), kind 'line', 'area' or
    'boundary'."""

    def __init__(self, anchor, symbol, barriers, gap):
        self.anchor, self.barriers, self.gap = anchor, barriers, gap
        self.body = [add(anchor, p) for p in symbol]
        self.pieces = []  # segments whose neighbourhood is forbidden
        self.walls = []   # segments that the path of the anchor may not meet
        self.areas = []
        for kind, points, sides in barriers:
            own = edges(points) if kind != "line" else list(zip(points, points[1:]))
            own = [(p, q) for p, q in own if p != q]
            self.pieces += own
            if kind == "area":
                self.areas.append(points)
            if not sides:
                continue
            turn = sum(p[0] * q[1] - p[1] * q[0] for p, q in edges(points))
            for p, q in own:
                side = cross(p, q, anchor) * (1 if turn > 0 else -1)
                if kind == "area" and side >= 0:
                    continue
                if cross(p, q, anchor) == 0 and dot(sub(p, anchor), sub(q, anchor)) <= 0:
                    continue  # the path begins on this line
                self.walls.append((p, q))

    def is_free(self, t):
        moved = [add(p, t) for p in self.body]
        if any(segment_meets_open(moved, p, q) for p, q in self.pieces):
            return False
        if self.gap and any(alone_with_gap.is_too_near(moved, p, q, self.gap) for p, q in self.pieces):
            return False
        inner = (sum(p[0] for p in moved) / F(len(moved)), sum(p[1] for p in moved) / F(len(moved)))
        if any(is_inside(ring, inner) is not False for ring in self.areas):
            return False
        if t == (0, 0):
            return True
        return not any(segments_meet(self.anchor, add(self.anchor, t), p, q) for p, q in self.walls)

    def lines(self):
        """The segments (p, d, bounded) that bound the forbidden set."""
        out = []
        for p, q in self.pieces:
            ring = hull([sub(e, b) for e in (p, q) for b in self.body])
            out += [(a, sub(b, a), True) for a, b in edges(ring)]
        for p, q in self.walls:
            a, b = sub(p, self.anchor), sub(q, self.anchor)
            out += [(a, sub(b, a), True), (a, a, False), (b, b, False)]
        return list(dict.fromkeys(out))

    def is_near_free(self, t, lines):
        """Is t free, or a limit of free places?"""
        if self.is_free(t):
            return True
        through, others = set(), []
        for p, d, bounded in lines:
            if cross(t, add(t, d), p) == 0:
                through.add(d)
                through.add((-d[0], -d[1]))
        order = sorted(through, key=lambda d: (half(d), Slope(d)))
        directions = list(order)
        for d, e in zip(order, order[1:] + order[:1]):
            turn = d[0] * e[1] - d[1] * e[0]
            middle = add(scaled(d), scaled(e)) if turn > 0 else None
            if middle is None:  # an angle of 180 degrees or more
                middle = (-d[1], d[0])
            directions.append(middle)
        return any(self.is_free_beside(t, d, lines) for d in directions)

    def is_free_beside(self, t, d, lines):
        near = None
        for p, e, _ in lines:
            turn = d[0] * e[1] - d[1] * e[0]
            if turn == 0:
                if cross(t, add(t, d), p) == 0:  # ends of other segments on the same line
                    for x in (p, add(p, e)):
                        at = F(dot(sub(x, t), d)) / dot(d, d)
                        if at > 0 and (near is None or at < near):
                            near = at
                continue
            at = F((p[0] - t[0]) * e[1] - (p[1] - t[1]) * e[0]) / turn
            if at > 0 and (near is None or at < near):
                near = at
        step = near / 2 if near is not None else 1
        return self.is_free((t[0] + step * d[0], t[1] + step * d[1]))

    def is_surely_taken(self, x, y, rings, walls):
        """Computed in doubles: does the place lie so deep in the forbidden set of one obstacle that its neighbourhood
        is forbidden, too?"""
        for ring in rings:
            if all((bx - ax) * (y - ay) - (by - ay) * (x - ax) > SURELY for (ax, ay), (bx, by) in ring):
                return True
        return any(side(p, q, (x, y)) * side(p, q, (0, 0)) < -SURELY and side((0, 0), p, (x, y)) * turn > SURELY and
                   side((0, 0), q, (x, y)) * turn < -SURELY for p, q, turn in walls)

    def candidates(self, lines):
        """Feet of perpendiculars, ends and crossings, as pairs: the place in doubles, and the function and arguments
        that compute it exactly."""
        yield 0.0, 0.0, lambda: (F(0), F(0))
        for k, (p, d, bounded) in enumerate(lines):
            at = F(-dot(p, d), dot(d, d))
            for s in {F(0)} | ({F(1)} if bounded else set()) | ({at} if at >= 0 and (not bounded or at <= 1) else set()):
                yield float(p[0] + s * d[0]), float(p[1] + s * d[1]), lambda p=p, d=d, s=s: (p[0] + s * d[0], p[1] + s * d[1])
            for q, e, other in lines[:k]:
                turn = d[0] * e[1] - d[1] * e[0]
                if turn == 0:
                    continue
                w = (q[0] - p[0], q[1] - p[1])
                s, r = w[0] * e[1] - w[1] * e[0], w[0] * d[1] - w[1] * d[0]
                if turn < 0:
                    turn, s, r = -turn, -s, -r
                if s >= 0 and r >= 0 and not (bounded and s > turn) and not (other and r > turn):
                    yield (p[0] + s / turn * d[0], p[1] + s / turn * d[1],
                           lambda p=p, d=d, s=s, turn=turn: (p[0] + F(s, turn) * d[0], p[1] + F(s, turn) * d[1]))

    def nearest(self):
        """Returns the distance of the nearest free place; None: there is none, or with a gap none was found."""
        rings = [edges(hull([sub(e, b) for e in (p, q) for b in self.body])) for p, q in self.pieces]
        walls = [(sub(p, self.anchor), sub(q, self.anchor)) for p, q in self.walls]
        if self.gap:
            return alone_with_gap.nearest(rings, walls, self.gap, self.is_free)
        found = self.nearest_in_rationals(rings, walls)
        self.exact = found is not None and self.is_free(found[1]) and all(F(float(x)) == x for x in found[1])
        return None if found is None else float(found[0]) ** 0.5

    def nearest_in_rationals(self, rings, walls):
        """Returns the square of the distance of the nearest free place, and that place, beside which there are free ones if
        it is not free itself; None if there is none."""
        lines, found = self.lines(), None
        walls = [(p, q, 1 if side((0, 0), p, q) > 0 else -1) for p, q in walls]
        last = (INFINITE, 0)
        for off, x, y, exactly in sorted(((x * x + y * y, x, y, exactly) for x, y, exactly in self.candidates(lines)), key=lambda c: c[:3]):
            if found is not None and off > float(found[0]) * (1 + SURELY) + SURELY:
                break  # much more than the error of doubles here
            if (x, y) == last or self.is_surely_taken(x, y, rings, walls):
                continue
            last, t = (x, y), exactly()
            if (found is None or dot(t, t) < found[0]) and self.is_near_free(t, lines):
                found = dot(t, t), t
        return found


def side(p, q, x):
    return (q[0] - p[0]) * (x[1] - p[1]) - (q[1] - p[1]) * (x[0] - p[0])


def half(d):
    return 0 if d[1] > 0 or (d[1] == 0 and d[0] > 0) else 1


class Slope:
    def __init__(self, d):
        self.d = d

    def __lt__(self, other):
        return self.d[0] * other.d[1] - self.d[1] * other.d[0] > 0

    def __eq__(self, other):
        return self.d[0] * other.d[1] - self.d[1] * other.d[0] == 0


def scaled(d):
    size = max(abs(d[0]), abs(d[1]))
    return (F(d[0]) / size, F(d[1]) / size)


# ---- Worlds ----------------------------------------------------------------------------------------------------------


def simple_ring(r, span):
    """A star-shaped ring about a point, of three to seven vertices."""
    while True:
        n = r.randint(3, 7)
        centre = (r.randint(-span, span), r.randint(-span, span))
        some = {(centre[0] + r.randint(-9, 9), centre[1] + r.randint(-9, 9)) for _ in range(n)} - {centre}
        around = sorted(some, key=lambda p: (half(sub(p, centre)), Slope(sub(p, centre))))
        turns = [sub(p, centre) for p in around]
        if len(around) >= 3 and all(a[0] * b[1] - a[1] * b[0] > 0 for a, b in zip(turns, turns[1:] + turns[:1])):
            return around


def room(r, span):
    """Walls around the anchor: a room with a corridor, a room with a door, or a closed one."""
    w, h = r.randint(1, 6), r.randint(1, 6)
    arm = r.randint(3, 30)
    if r.random() < 0.5:  # a corridor that leads to a room: the anchor is in the corridor
        big = r.randint(3, 14)
        ring = [(-w, arm), (-w, -arm), (-big - w, -arm), (-big - w, -arm - big), (big + w, -arm - big), (big + w, -arm), (w, -arm), (w, arm)]
    else:
        ring = [(-w, -h), (w, -h), (w, h), (-w, h)]
        if r.random() < 0.5:
            x = r.randint(w + 3, w + 25)
            ring[1:3] = [(w, -h), (w, -1), (x, -1), (x, -1 - r.randint(1, 12)), (x + r.randint(4, 20), -1 - r.randint(1, 12)), (x + 21, 1), (w, 1), (w, h)]
    turn = r.choice([lambda x, y: (x, y), lambda x, y: (-y, x), lambda x, y: (-x, -y), lambda x, y: (y, -x)])
    ring = [turn(*p) for p in ring]
    kind = r.choice(["boundary", "boundary", "line", "open"])
    if kind == "boundary":
        return "boundary", ring
    at = r.randrange(len(ring))
    ring = ring[at:] + ring[:at]
    return "line", ring + ring[:1] if kind == "line" else ring


SHAPES = [
    [(-1, -1), (1, -1), (1, 1), (-1, 1)],
    [(-3, -3), (3, -3), (3, 3), (-3, 3)],
    [(-4, -1), (4, -1), (4, 1), (-4, 1)],
    [(-2, -1), (3, -1), (0, 4)],
    [(0, -3), (3, 0), (0, 3), (-3, 0)],
]


def is_simple(ring):
    own = edges(ring)
    return all(not segments_meet(*own[i], *own[k]) for k in range(len(own)) for i in range(k - 1) if (i, k) != (0, len(own) - 1))


def draw(r, shape, spread, gap):
    """A world with its coordinates multiplied by `spread` and, unless that is 1, perturbed; None if it is degenerate
    (the anchor on a line, a ring that crosses itself) or if the symbol is free at its start."""
    def place(p):
        return tuple(spread * x + (r.randint(-spread // 3, spread // 3) if spread > 1 else 0) for x in p)
    barriers = []
    if r.random() < 0.7:
        kind, points = room(r, 8)
        barriers.append((kind, [place(p) for p in points], r.random() < 0.8))
    for _ in range(r.randint(0 if barriers else 1, 3)):
        if r.random() < 0.5:
            barriers.append((r.choice(["area", "boundary"]), [place(p) for p in simple_ring(r, 8)], r.random() < 0.6))
        else:
            points = [place((r.randint(-12, 12), r.randint(-12, 12))) for _ in range(r.randint(2, 4))]
            points = [p for k, p in enumerate(points) if k == 0 or p != points[k - 1]]
            if len(points) > 1:
                barriers.append(("line", points, r.random() < 0.7))
    symbol = [(spread * x, spread * y) for x, y in shape]
    world = World((0, 0), symbol, barriers, gap)
    a = world.anchor
    on = any(cross(p, q, a) == 0 and dot(sub(p, a), sub(q, a)) <= 0 for p, q in world.pieces)
    fair = not on and all(kind == "line" or is_simple(points) for kind, points, _ in barriers)
    return world if fair and not world.is_free((F(0), F(0))) else None


# ---- Files -----------------------------------------------------------------------------------------------------------

APART = 1 << 16  # distance between worlds, which are laid out in rows of ROW
ROW = 16
GROUPS = {"square": (1, 16, 0), "flat": (2, 16, 0), "triangle": (3, 16, 0), "diamond": (4, 1, 0), "small": (0, 1, 0),
                    "square_gap": (0, 16, 11), "triangle_gap": (3, 16, 5)}  # the number of the shape, the spread, and the gap
KINDS = ("line", "area", "boundary")


# Worlds, as (seed, index of the world), in which an earlier version left a conflict without a proof, moved the symbol
# farther than to the nearest free place, or had its proof refused.
AGAIN = {"square": [(8, 23), (18, 12), (24, 23), (35, 2), (41, 10), (59, 3)],
         "flat": [(3, 23), (22, 0), (30, 15), (42, 8), (90, 19), (106, 5), (5, 21), (8, 5)],
         "triangle": [(21, 12), (96, 23)],
         "diamond": [(3, 93), (9, 82), (10, 83), (17, 52), (10, 7), (17, 19), (30, 7), (69, 24), (1, 16), (13, 23), (201, 986)],
         "small": [(12, 97)],
         "square_gap": [(2, 12), (5, 23), (11, 12), (12, 4)],
         "triangle_gap": [(2, 6), (5, 16), (7, 17), (18, 19)]}


def drawn(name, seed):
    shape, spread, gap = GROUPS[name]
    r = random.Random(f"{seed} {name}")
    while True:
        world = draw(r, SHAPES[shape], spread, gap)
        if world:
            yield world


def worlds(name):
    """The worlds of a group: those of the seed, then those listed in AGAIN."""
    count = 25 * int(os.environ.get("SUNDER_TEST_SCALE", "1"))
    out = list(itertools.islice(drawn(name, os.environ.get("SUNDER_SEED", "1")), count))
    return out + [next(itertools.islice(drawn(name, seed), k, None)) for seed, k in AGAIN.get(name, [])]


def points(list_of):
    return struct.pack("<I", len(list_of)) + b"".join(struct.pack("<dd", *p) for p in list_of)


def write(name, layer, geometries):
    shutil.copy(f"empty_{layer}.gpkg", name + ".gpkg")
    base = sqlite3.connect(name + ".gpkg")
    head = b"GP\0\1" + struct.pack("<i", 25832)
    base.executemany(f"INSERT INTO {layer}(geom) VALUES (?)", [(head + geometry,) for geometry in geometries])
    base.commit()


def make(name):
    all_of, at = worlds(name), [(k % ROW * APART, k // ROW * APART) for k in range(25 * 1000)]
    write(name, "symbols", [struct.pack("<BIdd", 1, 1, *at[k]) for k in range(len(all_of))])
    for kind in KINDS:
        for side in (True, False):
            own = []
            for k, world in enumerate(all_of):
                for barrier in world.barriers:
                    if barrier[0] == kind and barrier[2] == side:
                        ring = [add(p, at[k]) for p in barrier[1]]
                        own.append(struct.pack("<BI", 1, 2) + points(ring) if kind == "line" else
                                   struct.pack("<BII", 1, 3, 1) + points(ring + ring[:1]))
            layer = f"{kind}_{'yes' if side else 'no'}"
            write(f"{name}_{layer}", layer, own)
    shape, spread, gap = GROUPS[name]
    ring = [f"{spread * x} {spread * y}" for x, y in SHAPES[shape]]
    with open(name + ".symbol", "w", encoding="ascii") as f:
        f.write(f"POLYGON(({','.join(ring + ring[:1])}))")
    with open(name + ".gap", "w", encoding="ascii") as f:
        f.write(str(gap))


def proofs(name):
    """For each world with conflicts: has each of them a proof?"""
    proved = {}
    with open(f"{name}.jsonl", encoding="utf-8") as lines:
        for told in map(json.loads, lines):
            if "conflict" in told:
                proved[told["a"] - 1] = proved.get(told["a"] - 1, True) and "proof" in told
    return proved


def bounds(name):
    """For each world the proved lower bound of the cost of its symbol's move."""
    proved = {}
    with open(f"{name}.jsonl", encoding="utf-8") as lines:
        for told in map(json.loads, lines):
            for body in told.get("bodies", ()):
                for feature in body.get("features", ()):
                    proved[feature["fid"] - 1] = proved.get(feature["fid"] - 1, 0) + told["bound"]
    return proved


def check(name):
    """What is wrong in a group."""
    base = sqlite3.connect(f"{name}.out.gpkg")
    moves = dict((fid - 1, row) for fid, *row in base.execute("SELECT fid, sunder_dx, sunder_dy, sunder_st FROM symbols"))
    proved, least = proofs(name), bounds(name)
    wrong, round_numbers = [], GROUPS[name][1] == 1
    for k, world in enumerate(worlds(name)):
        dx, dy, status = moves[k]
        found = world.nearest()
        off = float(F(dx) ** 2 + F(dy) ** 2) ** 0.5
        is_free = status != "blocked" and world.is_free((F(dx), F(dy)))
        if found is None and not (world.gap and is_free):
            right = status == "blocked" and proved[k]
        elif status == "blocked":
            right = round_numbers and not world.exact
        elif world.gap:
            right = is_free and (found is None or off <= found * (1 + 1e-6))
        else:
            far = round_numbers and not world.exact
            right = is_free and found * (1 - 1e-12) <= off and (far or off <= found * (1 + 1e-6) + 1e-6)
        if not right:
            wrong.append(f"{name} {k}: {status} by {off}, proved: {proved.get(k)}; right: {found}")
        elif k not in proved and not round_numbers and least.get(k, 0) < off * off * (1 - 1e-5) - 1e-6:
            wrong.append(f"{name} {k}: moved by {off}, and only a cost of {least.get(k, 0)} is proved")
    return wrong


def main():
    if sys.argv[1] == "make":
        for name in GROUPS:
            make(name)
        return
    wrong = [line for name in GROUPS for line in check(name)]
    print(*wrong, sep="\n")
    sys.exit(bool(wrong))


main()
