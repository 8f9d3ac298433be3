"""The rows that a file of --proof may name, found from the layer alone: tests/cli/rows_rule.py has the rule, in doubles. Those of
--rows FIELD are in given_rows.py.

A decision of that rule within MARGIN of its limit, in units of about the gap, counts in favour of the file: a pair of neighbours that it
names has to be possible, and none that is certain may be missing. The direction and the separation that it states have to be those of
the layer up to a share of 2^-40; the statements of trees and verdicts are about these numbers, exactly.
"""
import cmath
import math
from fractions import Fraction

import decided
from exact import rows_rule as rule
from form import demand

ALIKE = Fraction(1, 1 << 40)


class Candidate:
    """Two bodies that may be neighbours; certain: they are, if their sides are free."""

    def __init__(self, pair, near, certain):
        self.i, self.j, self.near, self.certain = *pair, near, certain
        self.sides = {}  # of each body; None: undecided


class Rows:
    def __init__(self, problem, stiffness):
        self.problem, self.stiffness = problem, [Fraction(k) for k in stiffness]
        present = [fid for fid in problem.place if fid not in problem.skipped]
        self.bodies = sorted({problem.blocks.block(fid) for fid in present}, key=lambda fids: problem.place[fids[0]])
        self.number = {fids: k for k, fids in enumerate(self.bodies)}
        gap = problem.greatest_gap()
        self.scale = math.frexp(gap)[1] if gap else 0  # coordinates are divided by this power of two
        corners = [p for fid in present for polygon in problem.polygons_at_home(fid) for ring in polygon for p in ring]
        self.origin = tuple(Fraction(min((p[c] for p in corners), default=0.0)) for c in (0, 1))
        self.house = {fid: rule.House([[[self.seen(p) for p in ring] for ring in polygon] for polygon in problem.polygons_at_home(fid)])
                      for fid in present}
        self.gap = math.ldexp(gap, -self.scale)
        things = [t for key, t in problem.things.items() if problem.is_barrier(key)]
        edges = [e for t in things for o in t.outlines for e in o.edges] + [e for t in things for c in t.lines for e in zip(c, c[1:])]
        self.lines = [tuple(self.seen([Fraction(v) / problem.lattice.unit for v in p]) for p in e) for e in edges]
        self.possible, self.certain = self.find()
        self.told, self.of, self.near_at_start = [], {}, {}

    def seen(self, p):
        return tuple(float((Fraction(v) - o) / Fraction(2) ** self.scale) for v, o in zip(p, self.origin))

    # ---- What may be a row

    def find(self):
        """The neighbours that are possible, and those that are certain."""
        candidates = self.candidates()
        about = {}
        for c in candidates:
            for body in (c.i, c.j):
                c.sides[body] = self.side(c, body)
                about.setdefault(body, []).append(c)
        possible = [c for c in candidates if not any(self.is_beaten(c, b, about[b]) for b in (c.i, c.j))]
        certain = [c for c in candidates if c.certain and all(self.is_alone(c, b, about[b]) for b in (c.i, c.j))]
        return ({(c.i, c.j, c.near.f, c.near.g): c for c in possible if has_next(c, possible, lambda s, t: None in (s, t) or s == t ^ 2)},
                [c for c in certain if has_next(c, certain, lambda s, t: s == t ^ 2)])

    def candidates(self):
        """The pairs that may stand side by side, with no third body between, nor a line."""
        reach, nearest = rule.REACH * self.gap, {}
        for f, g in self.pairs(reach):
            i, j = (self.number[self.problem.blocks.block(fid)] for fid in (f, g))
            near = rule.Near(f, g, self.house[f], self.house[g], reach)
            if i != j and near.distance <= reach + 1:
                nearest.setdefault((min(i, j), max(i, j)), []).append(near)
        distance, around = {}, {}
        for (i, j), nears in nearest.items():
            least = min(n.distance for n in nears)
            nearest[i, j] = [n for n in nears if n.distance <= least + rule.MARGIN]
            distance[i, j] = distance[j, i] = min(nears, key=lambda n: n.distance)
            around.setdefault(i, set()).add(j)
            around.setdefault(j, set()).add(i)
        found = []
        for pair, nears in nearest.items():
            third = around[pair[0]] & around[pair[1]]
            local = {(b, k): distance[b, k] for b in pair for k in third}
            alone = rule.all_of(rule.at_most(nears[0].distance, reach),
                                rule.stand_alone(pair, nears[0], {**local, **{(b, a): d for (a, b), d in local.items()}}, third))
            made = [] if alone is False else [self.made_edge(pair, n) for n in nears]
            found += [Candidate(pair, n, alone is True and len(made) == 1 and m is not None)
                      for n, m in zip(nears, made) if m is not False]
        return found

    def pairs(self, reach):
        """Pairs of features whose boxes are within reach, in the order of the layer."""
        order = sorted(self.house, key=lambda fid: self.house[fid].box[0])
        for k, f in enumerate(order):
            box = self.house[f].box
            for g in order[k + 1:]:
                other = self.house[g].box
                if other[0] > box[2] + reach + 1:
                    break
                if other[1] <= box[3] + reach + 1 and box[1] <= other[3] + reach + 1:
                    yield sorted((f, g), key=self.problem.place.get)

    def made_edge(self, pair, near):
        return rule.made_edge(*pair, near, self.house, self.blocks_of(near.f, near.g), self.lines, self.gap)

    def blocks_of(self, *fids):
        return [rule.Block([self.house[fid] for fid in self.problem.blocks.block(k)]) for k in fids]

    def axes_of(self, f, g):
        return axes_of(self.house[f], self.house[g], self.blocks_of(f, g))

    def side(self, c, body):
        """The side of the body that faces the other one; None where it is undecided."""
        towards = self.axes_of(c.near.f, c.near.g)
        from_f = self.problem.blocks.block(c.near.f) == self.bodies[body]
        sides = {rule.tried(rule.side_of, self.bodies[body], self.house, (x, y) if from_f else (-x, -y)) for x, y in towards}
        return sides.pop() if len(sides) == 1 else None

    def is_beaten(self, c, body, others):
        """Is another certainly the nearer one on its side?"""
        return c.sides[body] is not None and any(
            d.certain and d.sides[body] == c.sides[body] and d is not c and rule.tried(d.near.is_nearer, c.near) is True for d in others)

    def is_alone(self, c, body, others):
        return c.sides[body] is not None and all(
            d is c or d.sides[body] not in (None, c.sides[body]) or rule.tried(c.near.is_nearer, d.near) is True for d in others)

    # ---- What the file says

    def demand_all(self, told):
        """The lines about neighbours in rows: possible ones, and all that are certain."""
        problem, self.told, self.of = self.problem, told, {}
        for line in told:
            a, b = line["a"], line["b"]
            demand(a in self.house and b in self.house, "no neighbours in a row:", a, b)
            bodies = problem.blocks.block(a), problem.blocks.block(b)
            i, j = (self.number[body] for body in bodies)
            found = self.possible.get((min(i, j), max(i, j), a, b))
            demand(found and bodies not in self.of, "these are no neighbours in a row:", a, b)
            self.demand_direction(line)
            self.of[bodies] = self.of[bodies[::-1]] = line
        for c in self.certain:
            demand((self.bodies[c.i], self.bodies[c.j]) in self.of, "neighbours in a row are missing:", c.near.f, c.near.g)

    def demand_direction(self, line):
        """The direction is that of their walls, and the separation that of the two blocks along it."""
        a, b, along = line["a"], line["b"], tuple(map(Fraction, line["along"]))
        demand(any(max(abs(v - Fraction(w)) for v, w in zip(along, axis)) <= alike for axis, alike in self.directions(a, b)) and
               abs(along[0] ** 2 + along[1] ** 2 - 1) <= ALIKE, "that is not the direction of the row:", a, b)
        sides = [[(Fraction(p[0]) - self.origin[0]) * along[0] + (Fraction(p[1]) - self.origin[1]) * along[1]
                  for fid in self.problem.blocks.block(k) for polygon in self.problem.polygons_at_home(fid) for ring in polygon for p in ring]
                 for k in (a, b)]
        apart, size = min(sides[1]) - max(sides[0]), max(map(max, sides)) - min(map(min, sides))
        demand(any(abs(Fraction(line["apart"]) - v) <= ALIKE * size for v in self.separations(line, apart)),
               "that is not the separation of", a, "and", b)

    def directions(self, f, g):
        """The directions that a row may have from f to g, each with the greatest difference that is allowed."""
        return [(axis, ALIKE) for axis in self.axes_of(f, g)]

    def separations(self, line, apart):
        """What a line may say of two bodies that are `apart` along their row."""
        return [apart]

    # ---- Their rule, and their springs

    def line(self, one, other):
        """The line about two bodies; None: they are no neighbours, or the end of one is hidden."""
        line = self.of.get(tuple(self.problem.blocks.block(body[0]) for body in (one, other)))
        return line if line and not any(map(self.problem.is_hidden, (line["a"], line["b"]))) else None

    def edge(self, one, other):
        """The line about two bodies, and the direction from the first to the second."""
        line = self.line(one, other)
        demand(line, "no neighbours in a row:", *one, *other)
        sign = 1 if line["a"] in one else -1
        return line, tuple(sign * Fraction(v) for v in line["along"])

    def gaps(self, one, other):
        """The least gap, and the full one, of two bodies: the least ones of any two members."""
        pairs = [self.problem.gaps_of(k, l) for k in self.problem.blocks.block(one[0]) for l in self.problem.blocks.block(other[0])]
        return [min(Fraction(pair[c]) for pair in pairs) for c in (0, 1)]

    def rule(self, one, other, asked=None):
        """(n, d): the move of the second relative to the first has n.u >= d, in units of the layer. asked: a listed pair, if any, that is
        to be solved."""
        line, along = self.edge(one, other)
        apart, (least_gap, gap) = Fraction(line["apart"]), self.gaps(one, other)
        demand(apart > 0, "there is no rule for those that do not stand apart:", *one, *other)
        owed = not any(self.problem.is_listed(k, l) for k in one for l in other if {k, l} != asked)
        least = min(Fraction(0), gap - apart)
        return along, max(least_gap - apart, least) if owed and self.stood_too_near(one, other) else least

    def full(self, one, other):
        """(n, d): with the relative move u the two lack at least d - n.u of the rule of rows with the full gap; None: it asks for nothing."""
        line, along = self.edge(one, other)
        apart = Fraction(line["apart"])
        return (along, self.gaps(one, other)[1] - apart) if apart > 0 and self.stood_too_near(one, other) else None

    def stood_too_near(self, one, other):
        """Were members of the two, with the shapes of their present levels, nearer than the full gap?"""
        key = one, other, *(self.problem.level.get(fid, 0) for fid in one + other)
        if key not in self.near_at_start:
            self.near_at_start[key] = any(decided.is_too_near(self.problem, k, l, self.problem.full(k, l)) for k in one for l in other)
        return self.near_at_start[key]

    def spring(self, one, other, n, stiff):
        """(what identifies one sign of a spring, its stiffness in the tree, all that it has)"""
        line, (x, y) = self.edge(one, other)
        ways = [(-y, x), (y, -x), (x, y), (-x, -y)]
        demand(n in ways, "a spring that is neither across a row nor along it:", *one, *other)
        way = ways.index(n)  # the same from both ends, since the direction and the relative move change their signs together
        own = min(sum(Fraction(self.problem.weight(fid)) for fid in body) for body in (one, other))
        return (line["row"], way), stiff, own * self.stiffness[way // 2]

    def cost(self, move):
        """What the springs cost; move: of a feature."""
        total = Fraction(0)
        for line in self.told:
            if self.problem.is_hidden(line["a"]) or self.problem.is_hidden(line["b"]):
                continue
            bodies = self.problem.block(line["a"]), self.problem.block(line["b"])
            (x, y), (s, t) = map(Fraction, line["along"]), (Fraction(q) - Fraction(p) for p, q in zip(move(line["a"]), move(line["b"])))
            own = min(sum(Fraction(self.problem.weight(fid)) for fid in body) for body in bodies)
            total += own * (self.stiffness[0] * (x * t - y * s) ** 2 + self.stiffness[1] * (x * s + y * t) ** 2)
        return total


def has_next(c, others, opposite):
    """Does the row go on from one of the two, on the opposite side?"""
    return any(d is not c and b in (d.i, d.j) and opposite(c.sides[b], d.sides[b]) for b in (c.i, c.j) for d in others)


def axes_of(p, q, blocks):
    """The directions from p to q that a row may have there. blocks: those of p and q"""
    u, v = (h.walls / abs(h.walls) if h.walls else 0 for h in (p, q))
    return axes_along(cmath.rect(1, cmath.phase(u + v) / 4), blocks) if u + v else []


def axes_along(direction, blocks):
    """The same if the row runs in that direction or at right angles to it."""
    axes = [(direction.real, direction.imag), (-direction.imag, direction.real)]
    stand = [[rule.extent(block, axis) for block in blocks] for axis in axes]
    apart = [rule.apart(*s) for s in stand]
    return [(sign * x, sign * y) for k, (x, y) in enumerate(axes) if apart[k] >= max(apart) - rule.MARGIN
            for sign in (1, -1) if sign * (sum(stand[k][1]) - sum(stand[k][0])) >= -rule.MARGIN]
