"""The side anchor of a feature cut by lines, by the documented rule (src/displacement/layer/side_anchor.c), in
fractions and by another algorithm. The plane is cut into horizontal slabs between all corners, ends and crossings,
and each slab into cells between neighbouring edges. Cells that share an uncovered piece of a slab's border belong to
one part.
"""
from fractions import Fraction

import exact_plane as plane


class Cell:
    """A cell of one slab, between two edges that are neighbours in it."""

    def __init__(self, low, high, left, right):
        self.low, self.high, self.left, self.right, self.part = low, high, left, right, None

    def interval(self, y):
        return at_height(self.left, y), at_height(self.right, y)

    def area(self):
        (a, b), (c, d) = self.interval(self.low), self.interval(self.high)
        return (self.high - self.low) * (b - a + d - c) / 2


def at_height(e, y):
    (ax, ay), (bx, by) = e
    return ax + Fraction((bx - ax) * (y - ay)) / (by - ay)


def levels_of(edges):
    found = {Fraction(p[1]) for e in edges for p in e}
    for i, e in enumerate(edges):
        for f in edges[:i]:
            if plane.boxes_near(plane.edge_box(e), plane.edge_box(f)):
                p = plane.crossing(e, f)
                if p is not None:
                    found.add(Fraction(p[1]))
    return sorted(found)


class Parts:
    """outline: a member of the feature; lines: segments; both in integers."""

    def __init__(self, outline, lines):
        self.edges = [(e, True) for e in outline.edges] + [(e, False) for e in lines]
        self.levels = levels_of([e for e, _ in self.edges])
        self.slabs = [self.cells(y, z) for y, z in zip(self.levels, self.levels[1:])]
        self.borders = [self.border(k) for k in range(1, len(self.slabs))]
        self.join()

    def cells(self, low, high):
        middle = (low + high) / 2
        across = sorted((at_height(e, middle), own, e) for e, own in self.edges
                        if min(e[0][1], e[1][1]) <= low and max(e[0][1], e[1][1]) >= high)
        found, inside = [], False
        for (x, own, e), (x1, _, f) in zip(across, across[1:]):
            inside ^= own
            if inside and x < x1:
                found.append(Cell(low, high, e, f))
        return found

    def border(self, k):
        """The uncovered border between slabs k - 1 and k: intervals, each with the cells below and above."""
        y = self.levels[k]
        flat = [sorted((e[0][0], e[1][0])) for e, _ in self.edges if e[0][1] == e[1][1] == y]
        found = []
        for below in self.slabs[k - 1]:
            for above in self.slabs[k]:
                (a, b), (c, d) = below.interval(y), above.interval(y)
                free = [(max(a, c), min(b, d))]
                for p, q in flat:
                    free = [piece for u, v in free for piece in ((u, min(v, Fraction(p))), (max(u, Fraction(q)), v))]
                    free = [(u, v) for u, v in free if u < v]
                found += [(u, v, below, above) for u, v in free if u < v]
        return found

    def join(self):
        every = [c for slab in self.slabs for c in slab]
        near = {id(c): [] for c in every}
        for border in self.borders:
            for _, _, below, above in border:
                near[id(below)].append(above)
                near[id(above)].append(below)
        self.parts = []
        for c in every:
            if c.part is not None:
                continue
            c.part, stack, members = len(self.parts), [c], []
            while stack:
                d = stack.pop()
                members.append(d)
                for other in near[id(d)]:
                    if other.part is None:
                        other.part = c.part
                        stack.append(other)
            self.parts.append(members)

    def intervals(self, y):
        """Intervals of all parts at a height, as (left, right, part)."""
        if y in self.levels:
            k = self.levels.index(y)
            border = self.borders[k - 1] if 0 < k < len(self.slabs) else []
            return [(a, b, below.part) for a, b, below, _ in border]
        return [(*c.interval(y), c.part) for slab in self.slabs for c in slab if c.low < y < c.high]

    def holder(self, x, y):
        for a, b, part in self.intervals(y):
            if a < x < b:
                return part
        return None

    def area(self, k):
        return sum(c.area() for c in self.parts[k])

    def point(self, k):
        y = (min(c.low for c in self.parts[k]) + max(c.high for c in self.parts[k])) / 2
        width, left, right = max((b - a, -a, b) for a, b, part in self.intervals(y) if part == k)
        return (-left + right) / 2, y


def room(point, box, lines, reach):
    """The free distance beyond the point, in the direction away from the centre of the box: the square of the
    distance to the first line, if it is within the reach."""
    px, py = point
    dx, dy = px - Fraction(box[0] + box[2], 2), py - Fraction(box[1] + box[3], 2)
    best = reach * reach
    for (ax, ay), (bx, by) in lines:
        den = dx * (by - ay) - dy * (bx - ax)
        if den == 0:
            continue
        along = ((ax - px) * (by - ay) - (ay - py) * (bx - ax)) / den
        across = ((ax - px) * dy - (ay - py) * dx) / den
        if along > 0 and 0 <= across <= 1:
            best = min(best, along * along * (dx * dx + dy * dy))
    return best


def size_of(box, unit):
    """Width plus height, added in doubles as the library does."""
    low_x, low_y, high_x, high_y = (float(Fraction(v) / unit) for v in box)
    return (high_x - low_x) + (high_y - low_y)


def side_anchor(members, lines, plain, unit, tolerance=0.0):
    """members: outlines of the feature's polygons; lines: all that may cut it or be visible from it; plain: the plain
    anchor, in doubles; unit: the number of integer units in one unit of the layer; tolerance: a double. Returns None if
    no line cuts the feature."""
    lines = [e for e in lines if e[0] != e[1]]
    box = plane.box_of([p for o in members for e in o.edges for p in e])
    about = [e for e in lines if plane.boxes_near(plane.edge_box(e), box)]
    if not about or not any(plane.interiors_meet(o, plane.Outline(lines=[list(e) for e in about])) for o in members):
        return None
    every = [(cut, k) for cut in (Parts(o, about) for o in members) for k in range(len(cut.parts))]
    slack, reach = Fraction(tolerance * size_of(box, unit)) * unit * unit, Fraction(2 * size_of(box, unit)) * unit
    left = largest(every, slack)
    if len(left) > 1:
        rooms = [room(cut.point(k), box, lines, reach) for cut, k in left]
        left = largest([part for part, own in zip(left, rooms) if own == max(rooms)], 0)
    if any(cut.holder(*(Fraction(v) * unit for v in plain)) == k for cut, k in left):
        return plain
    x, y, at = min((*cut.point(k), n) for n, (cut, k) in enumerate(left))
    cut, k = left[at]
    near = float(x / unit), float(y / unit)
    return near if cut.holder(*(Fraction(v) * unit for v in near)) == k else plain


def largest(parts, slack):
    """The candidates that no other exceeds by more than the slack."""
    areas = [cut.area(k) for cut, k in parts]
    return [part for part, area in zip(parts, areas) if area + slack >= max(areas)]
