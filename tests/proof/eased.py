"""The prices of pairs that are left in conflict (docs/PROOF.md, section 1): which pairs have one, what they cost by themselves, and what
they cost in the result.

A pair is two bodies, or a body and a barrier: here the set of both, each as the tuple of its members. Lengths are in units of the layer.
"""
import math
from fractions import Fraction
from math import isqrt

from cover import Beyond, FINE as PLACE, hull
from exact import plane
from form import Refused, demand

FINE = 1 << 100
BEHIND = 1 << 12      # a shadow is drawn up to so many times as far as what casts it
LEAVING_ROOM = 2.0 ** -10  # of the way from the middle of a part to where it leaves a piece


def root_below(value):
    return Fraction(isqrt(value.numerator * FINE * FINE // value.denominator), FINE)


def root_above(value):
    return root_below(value) + Fraction(1, FINE)


class Eased:
    def __init__(self, problem, ease):
        self.problem, self.ease, self.members, self.known = problem, Fraction(ease or 0), {}, {}

    def list_conflicts(self, conflicts):
        """Conflicts and tight pairs, as the file lists them, between two of which one moves, unless they may overlap."""
        self.members = {}
        for told in conflicts if self.ease else ():
            a, b = told["a"], told["b"]
            if not told.get("inside_block") and told["reason"] != "kept" and (self.problem.may_move(a) or self.problem.may_move(b)):
                self.members.setdefault(self.pair(a, b), []).append((a, b))

    def body(self, key):
        return (key,) if self.problem.is_barrier(key) else self.problem.block(key)

    def pair(self, a, b):
        return frozenset((self.body(a), self.body(b)))

    def demand_no_deeper(self, a, b):
        """Fails if one of the two lay in the other: then they may come to lack more than at the start."""
        demand(not self.problem.how_it_stood(a, b)[2], a, "and", b, "may come to lie deeper in each other")

    def price(self, pair):
        """(linear, square): lacking s costs linear s + square s^2."""
        problem = self.problem
        limits = {body: problem.body_limit(body) for body in pair if not problem.is_barrier(body[0])}
        weight = min(sum(Fraction(problem.weight(fid)) for fid in body) for body, limit in limits.items() if limit != 0)
        one, other = pair
        owed = min(problem.full(a, b) for a in one for b in other)
        far = min((Fraction(v) for v in limits.values() if v), default=Fraction(owed) / problem.lattice.unit)
        return 4 * weight * far, weight * self.ease

    # ---- What pairs lack

    def lack(self, a, b, u):
        """Bounds of what the two lack if b is moved by u, in units of the lattice; an upper one may be None."""
        problem = self.problem
        owed = problem.full(a, b)
        if u == (0, 0):
            square, depth, _ = problem.how_it_stood(a, b)
        else:
            p, q = problem.whole(a), problem.whole(b).moved(*u)
            p, q = (p, q) if p.area else (q, p)
            square, depth = (-1, plane.least_square(p, q)) if plane.interiors_meet(p, q) else (plane.distance_square(p, q), 0)
        if square >= 0:
            return [Fraction(v) / problem.lattice.unit for v in (owed - root_above(Fraction(square)), owed - root_below(Fraction(square)))]
        if depth is None:
            return Fraction(owed) / problem.lattice.unit, None
        return [Fraction(v) / problem.lattice.unit for v in (owed + root_below(Fraction(depth)), owed + root_above(Fraction(depth)))]

    def at_home(self, a, b):
        if (a, b) not in self.known:
            self.known[a, b] = self.lack(a, b, (0, 0))
        return self.known[a, b]

    def most(self, pair):
        """The most that the pair may lack by those conflicts of which a tree may make use: what it lacked at the start. None: unknown, or
        with a least gap any pair may lack more."""
        if self.problem.has_slack:
            return None
        found = [self.at_home(a, b)[1] for a, b in self.members[pair] if not self.problem.how_it_stood(a, b)[2]]
        return None if None in found else max(found, default=Fraction(0))

    def alone(self, pair):
        """The least price of the pair, wherever its bodies go within their limits: that of what it lacks after both have moved apart as
        far as they may."""
        limits = [0 if self.problem.is_barrier(body[0]) else self.problem.body_limit(body) for body in pair]
        if None in limits:
            return Fraction(0)
        reach = sum(map(Fraction, limits))
        lacks = max([self.at_home(a, b)[0] - reach for a, b in self.members.get(pair, ()) if self.stay_apart(a, b, reach)], default=Fraction(0))
        lacks = max(lacks, self.ahead(pair, (0, 0)) - reach)
        linear, square = self.price(pair)
        return lacks * (linear + square * lacks) if lacks > 0 else Fraction(0)

    def stay_apart(self, a, b, reach):
        """Does neither of the two come to lie in the other, where that is allowed?"""
        try:
            self.problem.demand_outside(a, b, None, square=(reach * self.problem.lattice.unit) ** 2)
        except Refused:
            return False
        return True

    def rest(self, used):
        """What all pairs cost at least whose prices no tree has."""
        return sum(self.alone(pair) for pair in self.pairs() if pair not in used)

    # ---- With a least gap

    def has_price(self, pair):
        """With a least gap all pairs have one: those that stand between the two gaps have to pay."""
        ends = [body for body in pair if not self.problem.is_barrier(body[0])]
        return pair in self.members or bool(self.ease and self.problem.has_slack and len(pair) == 2 and ends and
                                            any(self.problem.body_limit(body) != 0 for body in ends))

    def pairs(self):
        """The pairs that are named, and neighbours in a row that lack some of its rule with the full gap."""
        found, rows = dict(self.members), self.problem.rows if self.problem.has_slack else None
        for line in rows.told if rows else ():
            ends = line["a"], line["b"]
            if not any(map(self.problem.is_hidden, ends)) and self.has_price(self.pair(*ends)):
                found.setdefault(self.pair(*ends), ())
        return found

    def ahead(self, pair, u):
        """What the pair, of which the second one moves by u relative to the first one, lacks of that rule."""
        one, other = pair
        rows = self.problem.rows if self.problem.has_slack else None
        rule = rows and rows.line(one, other) and rows.full(one, other)
        return rule[1] - rule[0][0] * u[0] - rule[0][1] * u[1] if rule else Fraction(0)

    def cost(self, move):
        """No more than this is what all pairs cost; move: of a feature."""
        return sum(self.cost_of(pair, move) for pair in self.pairs())

    def cost_of(self, pair, move):
        linear, square = self.price(pair)
        lacks = max([self.lack(a, b, self.between(a, b, move))[1] for a, b in self.members.get(pair, ())], default=Fraction(0))
        s, t = ((0, 0) if self.problem.is_barrier(body[0]) else tuple(map(Fraction, move(body[0]))) for body in pair)
        lacks = max(lacks, self.ahead(pair, (t[0] - s[0], t[1] - s[1])))
        return max(Fraction(0), lacks) * (linear + square * max(Fraction(0), lacks))

    def between(self, a, b, move):
        s, t = ((0, 0) if self.problem.is_barrier(k) else self.problem.lattice.point(move(k)) for k in (a, b))
        return t[0] - s[0], t[1] - s[1]


class Ahead:
    """What neighbours in a row lack at least of its rule with the full gap: d - n.u. It forbids nothing."""

    def __init__(self, n, d, unit):
        self.n, self.d, self.corners, self.shadow, self.priced = n, d * unit, (), False, True

    def holds(self, *_):
        return False

    def line(self, n, d):
        """Where they lack at least d - n.u, as the half-plane a.u <= c, in units of the lattice."""
        return [p - q for p, q in zip(self.n, n)], self.d - d


class Sloped:
    """What a piece says of the points (u, s) below a plane n.u + share s = d: those at which u is forbidden, or lacks more than s."""

    def __init__(self, piece, n, d, share, unit):
        self.piece, self.corners, self.shadow = piece, piece.corners, piece.shadow
        self.n, self.d = [v / share for v in n], d * unit / share
        self.outline = hull([(k * x, k * y) for x, y in piece.corners for k in (1, BEHIND)]) if piece.shadow else piece.corners

    def holds(self, fine, corner):
        if not self.piece.priced:
            return self.piece.holds(fine, corner)
        x, y, w = corner
        if isinstance(self.piece, Ahead):
            (a, b), c = self.piece.line(self.n, self.d)
            return a * x + b * y <= c * w
        return self.piece.is_within(fine, self.piece.owed - self.d + (self.n[0] * x + self.n[1] * y) / w)

    def leaving(self, places, middle):
        """A line that cuts these places, corners of a part with that middle, just inside the piece: across the way to the corner that is
        farthest outside. None: it would hardly cut them. It only has to be near, as any line may cut the part."""
        far, (nx, ny), p = max(((*self.outside(p), p) for p in places))
        slope = math.hypot(nx, ny)
        if not (far > 0 and slope > 0):  # where the slope of the plane is that of the distance, no way leads inside
            return None
        nx, ny = nx / slope, ny / slope
        deep = nx * float(p[0] - middle[0]) + ny * float(p[1] - middle[1]) - far / slope  # from the middle to the line
        a, b = round(-nx * 2 ** 40), round(-ny * 2 ** 40)
        if not deep > 4 or (a, b) == (0, 0):
            return None
        back = far / slope + deep * LEAVING_ROOM
        x, y = p[0] - round(nx * back), p[1] - round(ny * back)
        return a * PLACE, b * PLACE, a * x + b * y

    def outside(self, p):
        """How far the place is outside, in doubles, and the gradient of that."""
        if isinstance(self.piece, Beyond):
            a, b, c = self.piece.line
            size = math.hypot(a, b)
            return float(a * p[0] + b * p[1] - c * PLACE) / size, (a / size, b / size)
        if isinstance(self.piece, Ahead):
            (a, b), c = self.piece.line(self.n, self.d)
            return float(a * p[0] + b * p[1] - c * PLACE), (float(a), float(b))
        corners = [(float(p[0] - PLACE * x), float(p[1] - PLACE * y)) for x, y in self.outline]
        far, (nx, ny) = self.inside(corners) or min((at_edge(q, r) for q, r in zip(corners, corners[1:] + corners[:1])), key=lambda v: v[0])
        if not self.piece.priced:
            return far - PLACE * float(self.piece.owed), (nx, ny)
        slope = float(self.d * PLACE - sum(v * c for v, c in zip(self.n, p)))
        return far + slope - PLACE * float(self.piece.owed), (nx - float(self.n[0]), ny - float(self.n[1]))

    @staticmethod
    def inside(corners):
        """The same for the polygon itself, around a place within it: none if the place, here the origin, is not."""
        sides = []
        for (px, py), (qx, qy) in zip(corners, corners[1:] + corners[:1]):
            ex, ey = px - qx, py - qy  # the sides are seen from the place: the corners have the opposite signs
            size = math.hypot(ex, ey)
            sides.append(((ey * px - ex * py) / size, (ey / size, -ex / size)))
        most = max(sides)
        return most if most[0] <= 0 else None


def at_edge(q, r):
    """The distance to a segment, of which q and r are the ways from its ends to the place; and its gradient."""
    ex, ey = q[0] - r[0], q[1] - r[1]
    share = min(1.0, max(0.0, (ex * q[0] + ey * q[1]) / (ex * ex + ey * ey)))
    x, y = q[0] - share * ex, q[1] - share * ey
    size = math.hypot(x, y) or 1.0
    return size, (x / size, y / size)
