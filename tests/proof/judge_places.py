"""Which relative places features and barriers may have, by docs/PROOF.md, section 1; decided for one place at a time,
in integers of the lattice."""
import math
from fractions import Fraction

from exact import plane

APART = ("too_close", "barrier_drawn", "barrier_near")


class Places:
    def __init__(self, problem):
        self.problem, self.unit = problem, problem.lattice.unit
        self.start, self.kinds, self.rows = {}, {}, {}

    def list_conflicts(self, conflicts):
        self.kinds = {frozenset((c["a"], c["b"])): c["kind"] for c in conflicts if not c.get("inside_block") and c["kind"] != "tight"}

    def list_rows(self, lines):
        """What the lines say of neighbours in rows: of two bodies, the first one, the direction from it, and the separation."""
        self.rows = {}
        for line in lines:
            one, other = self.body(line["a"]), self.body(line["b"])
            self.rows[frozenset((one, other))] = one, tuple(map(Fraction, line["along"])), Fraction(line["apart"])

    def keeps_row(self, one, other, u, asked=None):
        """Does the relative move of two bodies keep the rule of rows, if they are neighbours? asked: a listed pair, if any, that is to be
        solved."""
        if frozenset((one, other)) not in self.rows:
            return True
        first, along, apart = self.rows[frozenset((one, other))]
        if apart <= 0:
            return True
        gap, least_gap = (min(Fraction(self.problem.gaps_of(a, b)[c]) for a in self.problem.blocks.block(one[0])
                              for b in self.problem.blocks.block(other[0])) for c in (1, 0))
        pairs = [(a, b) for a in one for b in other]
        pushed = not any(self.kind(*p) for p in pairs if set(p) != asked) and \
            not all(self.pair_may(a, b, (0, 0), None, self.problem.full(a, b)) for a, b in pairs)
        least = max(least_gap - apart, min(0, gap - apart)) if pushed else min(0, gap - apart)
        sign = 1 if first == one else -1
        return sign * (along[0] * u[0] + along[1] * u[1]) >= least * self.unit

    def kind(self, a, b):
        return self.kinds.get(frozenset((a, b)))

    def required(self, a, b):
        return self.problem.required(a, b)

    def is_barrier(self, key):
        return self.problem.is_barrier(key)

    def body(self, key):
        return (key,) if self.is_barrier(key) else self.problem.block(key)

    def limit(self, body):
        return self.problem.body_limit(body)

    def box(self, key):
        return self.problem.whole(key).box

    # ---- A pair

    def moved(self, a, b, u):
        p, q = self.problem.whole(a), self.problem.whole(b).moved(*u)
        return (p, q) if p.area else (q, p)

    def meet(self, a, b, u):
        p, q = self.moved(a, b, u)
        return p.area and plane.interiors_meet(p, q)

    def stood(self, a, b):
        """Returns (the square of the distance, or -1; the square of the least translation; whether one was inside the
        other)."""
        if (a, b) not in self.start:
            p, q = self.moved(a, b, (0, 0))
            meet = p.area and plane.interiors_meet(p, q)
            inside = any(plane.lies_in(self.problem.whole(x), self.problem.whole(y)) for x, y in ((a, b), (b, a))
                         if not self.is_barrier(x) and self.problem.whole(y).area)
            self.start[a, b] = (-1, plane.least_square(p, q), inside) if meet else (plane.distance_square(p, q), 0, inside)
        return self.start[a, b]

    def depth(self, a, b):
        found = self.stood(a, b)[1]
        return math.inf if found is None else found

    def pair_may(self, a, b, u, kind, owed=None):
        """May b be at its original place plus u, relative to a at its original place? owed: another distance than the one that they
        have to keep."""
        p, q = self.moved(a, b, u)
        parted = not (p.area and plane.interiors_meet(p, q))
        if kind is None:
            owed = self.required(a, b) if owed is None else owed
            features = not (self.is_barrier(a) or self.is_barrier(b))
            if not parted and features and self.problem.options.contained == "ignore":
                return plane.lies_in(q, p) or (q.area and plane.lies_in(p, q))
            return parted and not (owed > 0 and plane.nearer(p, q, owed))
        square, depth, inside = self.stood(a, b)
        if kind in ("contained", "duplicate") or (square < 0 and inside):
            return True
        if square >= 0:
            return parted and plane.distance_square(p, q) >= square
        if parted or kind in APART:
            return parted
        least = plane.least_square(p, q)
        return depth is not None and least is not None and least <= depth

    def lacks_less(self, a, b, u, most):
        """Do the two lack less than that, in units of the layer, if b is moved by u?"""
        p, q = self.moved(a, b, u)
        rest = Fraction(most) * self.unit - self.problem.full(a, b)
        if p.area and plane.interiors_meet(p, q):
            depth = plane.least_square(p, q)
            return rest > 0 and depth is not None and depth < rest * rest
        return rest >= 0 or plane.distance_square(p, q) > rest * rest

    # ---- Paths

    def may_go(self, a, b, u):
        """Is the relative move of b by u no jump, and does it cross no side, for any members of their blocks?"""
        if self.is_barrier(a) or self.is_barrier(b):
            feature, barrier, t = (b, a, u) if self.is_barrier(a) else (a, b, (-u[0], -u[1]))
            return barrier not in self.problem.sides or all(self.keeps_side(k, barrier, t) for k in self.body(feature))
        if self.problem.options.allow_jumps:
            return True
        return all(self.goes_by(k, l, (-u[0], -u[1])) and self.goes_by(l, k, u) for k in self.body(a) for l in self.body(b))

    def goes_by(self, feature, other, t):
        at, thing = self.problem.lattice.point(self.problem.anchor(feature)), self.problem.things[other]
        if self.problem.original.get(other, thing).holds_place(at):
            return True
        way = at, (at[0] + t[0], at[1] + t[1])
        return not any(plane.edges_meet(way, e) for e in self.problem.whole(other).edges)

    def keeps_side(self, feature, barrier, t):
        at, thing = self.problem.lattice.point(self.problem.side_anchor(feature)), self.problem.things[barrier]
        way = at, (at[0] + t[0], at[1] + t[1])
        lines = [e for line in thing.lines for e in zip(line, line[1:] or line)]
        if not any(plane.on_edge(e, at) for e in lines) and any(plane.edges_meet(way, e) for e in lines):
            return False
        for outline in thing.outlines:
            for e in outline.edges:
                middle, along = (e[0][0] + e[1][0], e[0][1] + e[1][1]), (e[1][0] - e[0][0], e[1][1] - e[0][1])
                left = plane.on_its_left(outline.scaled(2), middle, along)
                outer = plane.side(*e, at) < 0 if left else plane.side(*e, at) > 0
                if outer and plane.edges_meet(way, e):
                    return False
        return True

    def bodies_may(self, one, other, u):
        """Are these relative places allowed to two bodies: for every pair of their members, and without a jump?"""
        pairs = [(a, b) for a in one for b in other if not {a, b} & self.problem.skipped]
        listed = [p for p in pairs if self.kind(*p)]  # computing the depths of overlaps takes longest
        return (self.keeps_row(one, other, u) and all(self.pair_may(a, b, u, None) for a, b in pairs if not self.kind(a, b)) and
                self.may_go(one[0], other[0], u) and all(self.pair_may(a, b, u, self.kind(a, b)) for a, b in listed))


def polygon_between(centre, reach, sides):
    """The part of a square that satisfies x X + y Y >= d for all constraints (x, y, d): its corners, in doubles."""
    reach = min(float(reach), 1e12)
    corners = [(centre[0] + sx * reach, centre[1] + sy * reach) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    for x, y, d in ((float(a), float(b), float(c)) for a, b, c in sides):
        found = []
        for p, q in zip(corners, corners[1:] + corners[:1]):
            s, t = (x * v[0] + y * v[1] - d for v in (p, q))
            if s >= 0:
                found.append(p)
            if s * t < 0:
                found.append((p[0] + s / (s - t) * (q[0] - p[0]), p[1] + s / (s - t) * (q[1] - p[1])))
        corners = found
    return corners
