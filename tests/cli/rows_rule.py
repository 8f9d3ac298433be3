"""Neighbours in rows, found by a direct implementation of the rule in src/displacement/rows/README.md, in doubles. A quantity within
MARGIN of its threshold raises Undecided. Uses only Python's standard library, and no code of the program."""
import cmath
import math
from fractions import Fraction

MARGIN = 1e-9
REACH, ANGLE, STRAIGHT, SHARED, DEPTHS, DEEP, LEAST = 4, 15, 0.1, 0.5, 2.5, 1.75, 3
STEP, STEP_GAPS = 0.4, 1.5  # of the smaller depth; in gaps


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


class Block:
    """A body: its houses, and all of their corners."""

    def __init__(self, houses):
        self.houses, self.corners = houses, [p for h in houses for p in h.corners]


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
    """Two houses, and their distance."""

    def __init__(self, f, g, p, q, reach):
        self.f, self.g, self.p, self.q = f, g, p, q
        self.distance = math.inf
        off = off_box((p.box[:2], p.box[2:]), q.box)
        if off > reach + 1:
            return
        for e in p.edges:
            if off_box(e, q.box) <= self.distance + 1:
                self.distance = min(self.distance, *(math.dist(*k) for d in q.edges for k in links_of_edges(e, d)))
        if off > 0:
            return
        if any(cross(e, d) for e in p.edges for d in q.edges):
            self.distance = 0
        elif self.distance <= MARGIN:  # if it is not 0, is_nearer() finds it undecided among others as near
            self.distance = 0 if self.exact_square() == 0 else self.distance
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


def extent(block, axis):
    at = [x * axis[0] + y * axis[1] for x, y in block.corners]
    return min(at), max(at)


def apart(e, f):
    return max(e[0] - f[1], f[0] - e[1])


def stand_side_by_side(p, q, blocks, gap):
    """None: not neighbours; else the direction towards q, as a unit vector, the offset, the vector from middle to middle along the row
    and to its left, and the link along the row. p, q: the nearest houses of the two blocks, whose walls have that direction."""
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
    stand = [[extent(block, axis) for block in blocks] for axis in axes]
    separation = [apart(*s) for s in stand]
    deepest = [[max(b - a for a, b in (extent(h, axis) for h in block.houses)) for block in blocks] for axis in axes]
    one = [judge(axes[k], stand[k], stand[1 - k], deepest[1 - k], (1, -1)[k], gap) for k in (0, 1)]
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


def judge(axis, along, across, deepest, left, gap):
    """deepest: the depth of the deepest house of each block. left: -1 if `across` was measured to the right of the axis, else 1."""
    shorter = [min(b - a for a, b in extents) for extents in (along, across)]
    depths = sorted(b - a for a, b in across)
    if sum(along[0]) > sum(along[1]):
        axis, left = (-axis[0], -axis[1]), -left
        along = [(-b, -a) for a, b in along]
    low, high = across[1][0] - across[0][0], across[1][1] - across[0][1]
    offsets = sorted([low, high, (low + high) / 2], key=abs)
    answer = all_of(at_most(-SHARED * shorter[0], apart(*along)), at_most(apart(*across), -SHARED * shorter[1]),
                    at_most(depths[1], DEPTHS * depths[0]), at_most(abs(offsets[0]), STEP * depths[0]),
                    at_most(abs(offsets[0]), STEP_GAPS * gap),
                    *(at_most(b - a, DEEP * deep) for (a, b), deep in zip(across, deepest)))
    if answer is False:
        return None
    if answer is None or abs(abs(offsets[0]) - abs(offsets[1])) <= MARGIN < abs(offsets[0] - offsets[1]):
        return "open"
    at = left * (max(e[0] for e in across) + min(e[1] for e in across)) / 2
    link = [(end * axis[0] - at * axis[1], end * axis[1] + at * axis[0]) for end in (along[0][1], along[1][0])]
    middle = ((sum(along[1]) - sum(along[0])) / 2, left * (sum(across[1]) - sum(across[0])) / 2)
    return axis, left * offsets[0], middle, link


class Edge:
    """Two bodies side by side: i, j; their houses f, g that are nearest to each other; direction, offset, middle to middle."""

    def __init__(self, i, j, near, axis, offset, middle):
        self.i, self.j, self.f, self.g, self.near = i, j, near.f, near.g, near
        self.axis, self.offset, self.middle = axis, offset, middle

    def towards(self, body):
        return self.axis if body == self.j else (-self.axis[0], -self.axis[1])

    def other(self, body):
        return self.j if body == self.i else self.i


def is_crossed(link, lines):
    """Does a line of a barrier cross the link?"""
    box = [f(p[c] for p in link) for f, c in ((min, 0), (min, 1), (max, 0), (max, 1))]
    near = [e for e in lines if all(min(p[c] for p in e) <= box[c + 2] + 1 and max(p[c] for p in e) >= box[c] - 1 for c in (0, 1))]
    return any_of(cross(link, line) for line in near)


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
    """Are the two neighbours in the relative neighbourhood graph? bodies: those that may be between."""
    third = [k for k in bodies if (pair[0], k) in distance and (pair[1], k) in distance]
    between = [all_of(*(tried(distance[b, k].is_nearer, near) for b in pair)) for k in third]
    return {True: False, None: None, False: True}[any_of(between)]


def made_edge(i, j, near, houses, blocks, lines, gap):
    """The edge; False: the two are not side by side; None: undecided."""
    try:
        found = stand_side_by_side(houses[near.f], houses[near.g], blocks, gap)
    except Undecided:
        return None
    if found is None:
        return False
    crossed = is_crossed(found[3], lines)
    return None if crossed is None else False if crossed else Edge(i, j, near, *found[:3])


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
    block = [Block([houses[f] for f in body]) for body in bodies]
    edges = []
    for (i, j), nears in nearest.items():
        alone = i < j and at_most(nears[0].distance, reach) and stand_alone((i, j), nears[0], distance, range(len(bodies)))
        if alone is False:
            continue
        # If several members of a block are equally near, the choice makes no difference as long as none makes an edge.
        made = [made_edge(i, j, n, houses, (block[i], block[j]), lines, gap) for n in nears]
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
