"""The rows of --rows FIELD that a file of --proof may name: bodies with equal values are one path, for which the two nearest are joined
first, and so on, unless one of them has two neighbours already or both are in one path.

That holds of a path if each pair that it does not join is not nearer than what prevents it: the second neighbour of one of the two, or
all steps of the path between them. As in rows.py, a comparison of distances within MARGIN counts in favour of the file.
"""
import math
from fractions import Fraction

from exact import rows_rule as rule
from form import demand
from geopackage import value_of
from rows import ALIKE, Rows, axes_along, axes_of

ULPS = 8  # by so many units in the last place of the coordinates the ends of a link may differ from the exact ones


class GivenRows(Rows):
    def find(self):
        """Nothing is found: what the file says is compared with the values of the field."""
        self.known = {}  # pairs of bodies: see nearest()
        return {}, []

    # ---- What the file says

    def demand_all(self, told):
        """The lines about neighbours: of each row a path through all of its bodies."""
        problem, self.told, self.of = self.problem, told, {}
        row_of, next_to = self.rows_of_bodies(), {}
        for line in told:
            a, b = line["a"], line["b"]
            demand(a in self.house and b in self.house and problem.place[a] < problem.place[b], "no neighbours in a row:", a, b)
            bodies = problem.blocks.block(a), problem.blocks.block(b)
            i, j = (self.number[body] for body in bodies)
            demand(i != j and row_of.get(i) is not None and row_of.get(i) == row_of.get(j) and bodies not in self.of,
                   "these are no neighbours in a row:", a, b)
            demand((a, b) in self.nearest(i, j)[1], "these are not the members that are nearest to each other:", a, b)
            self.of[bodies] = self.of[bodies[::-1]] = line
            for one, other in ((i, j), (j, i)):
                next_to.setdefault(one, []).append(other)
            self.demand_direction(line)
        rows = {}
        for body, value in row_of.items():
            rows.setdefault(value, []).append(body)
        for bodies in rows.values():
            self.demand_path(bodies, next_to)

    def rows_of_bodies(self):
        """The value of each body that has one."""
        found = {}
        for fid in self.house:
            value = value_of(self.problem.attributes[fid], self.problem.options.rows_field)
            if value is not None:
                known = found.setdefault(self.number[self.problem.blocks.block(fid)], value)
                demand(known == value, "a block in two rows:", fid)
        return found

    def demand_path(self, bodies, next_to):
        """Fails unless the bodies are one path, and each pair is prevented that it does not join."""
        path, before = [b for b in bodies if len(next_to.get(b, ())) < 2][:1], None
        demand(all(len(next_to.get(b, ())) <= 2 for b in bodies), "a row that branches:", *self.bodies[bodies[0]])
        while path and any(b != before for b in next_to.get(path[-1], ())):
            before, last = path[-1], before
            path.append(next(b for b in next_to[before] if b != last))
        demand(len(path) == len(bodies), "a row is not one path:", *self.bodies[bodies[0]])
        steps = [self.nearest(*pair)[0] for pair in zip(path, path[1:])]
        second = [max(pair) for pair in zip([math.inf] + steps, steps + [math.inf])]
        for k, one in enumerate(path):
            between = 0
            for m in range(k + 1, len(path)):
                between = max(between, steps[m - 1])
                least = min(between, second[k], second[m]) - rule.MARGIN
                if m > k + 1 and least > self.off(one, path[m]):
                    demand(least <= self.nearest(one, path[m])[0], "a row that does not join the nearest:", *self.bodies[one],
                           *self.bodies[path[m]])

    # ---- Distances

    def off(self, i, j):
        """A lower bound of the distance of two bodies."""
        return min(rule.off_box((p.box[:2], p.box[2:]), q.box) for p in self.houses(i) for q in self.houses(j))

    def houses(self, body):
        return [self.house[fid] for fid in self.bodies[body] if fid in self.house]

    def nearest(self, i, j):
        """The distance of two bodies, and the pairs of members at that distance, in the order of the input."""
        if (i, j) not in self.known:
            pairs = [sorted((f, g), key=self.problem.place.get) for f in self.bodies[i] for g in self.bodies[j] if f in self.house and g in self.house]
            far = {(f, g): links(self.house[f], self.house[g])[0] for f, g in pairs}
            least = min(far.values())
            self.known[i, j] = self.known[j, i] = least, {pair for pair, d in far.items() if d <= least + rule.MARGIN}
        return self.known[i, j]

    # ---- Directions

    def directions(self, f, g):
        """Those of the walls or, if these have no common direction, those of the shortest links."""
        p, q, blocks = self.house[f], self.house[g], self.blocks_of(f, g)
        u, v = (h.walls / abs(h.walls) if h.walls else 0 for h in (p, q))
        straight = rule.all_of(*(rule.at_most(h.length * rule.STRAIGHT, abs(h.walls)) for h in (p, q)),
                               rule.at_most(rule.STRAIGHT, abs((u + v).real) + abs((u + v).imag)))
        found = [] if straight is False else [(axis, ALIKE) for axis in axes_of(p, q, blocks)]
        return found if straight else found + [(axis, alike) for link in self.links(p, q) for axis, alike in self.along(link, blocks)]

    @staticmethod
    def links(p, q):
        distance, found = links(p, q)
        return found if distance > 0 else found + [((0, 0), (0, 0))]

    def along(self, link, blocks):
        """The axes by a link. Where it is short, the rounding of its ends matters."""
        (ax, ay), (bx, by) = link
        length = math.hypot(bx - ax, by - ay)
        last = max(abs(v) for o in self.origin for v in (o, 1)) + max(abs(v) for p in link for v in p) * Fraction(2) ** self.scale
        alike = ALIKE + (ULPS * last / Fraction(2) ** (52 + self.scale) / Fraction(length) if length else 0)
        return [(axis, alike) for axis in axes_along(complex(bx - ax, by - ay) / length if length else 1 + 0j, blocks)]

    def separations(self, line, apart):
        """0 if a line of a barrier lies between the two: then there is no rule."""
        x, y = map(float, line["along"])
        blocks = self.blocks_of(line["a"], line["b"])
        along, across = ([rule.extent(block, axis) for block in blocks] for axis in ((x, y), (-y, x)))
        at = (max(e[0] for e in across) + min(e[1] for e in across)) / 2
        crossed = rule.is_crossed([(end * x - at * y, end * y + at * x) for end in (along[0][1], along[1][0])], self.lines)
        return [apart] * (crossed is not True) + [min(apart, Fraction(0))] * (crossed is not False)


def links(p, q):
    """The distance of two houses, and the shortest links from the first to the second; 0 if they overlap."""
    found = [link for e in p.edges for d in q.edges for link in rule.links_of_edges(e, d)]
    far = [math.dist(*link) for link in found]
    least = min(far)
    found = [link for link, d in zip(found, far) if d <= least + rule.MARGIN]
    if rule.off_box((p.box[:2], p.box[2:]), q.box) == 0 and (
            any(rule.cross(e, d) for e in p.edges for d in q.edges) or
            any(rule.holds(a, rings[0][0]) for a, b in ((p, q), (q, p)) for rings in b.parts)):
        return 0.0, found
    return least, found
