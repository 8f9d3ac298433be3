"""The proofs that a conflict has no solution: docs/PROOF.md, section 4, line by line."""
import math
from fractions import Fraction
from itertools import combinations

import decided

from exact import plane
from cover import crossing, hull, line_of, meets_segment
from form import demand, index
from problem import root_above


class Verdict:
    def __init__(self, problem, told):
        self.problem, self.told, self.nodes = problem, told, told["proof"]
        self.kinds = problem.listed
        self.own = self.key(told["a"], told["b"])
        self.unit = problem.lattice.unit
        self.crowded = told.get("crowded", False)
        self.alone = told["reason"] != "no_room" and not self.crowded
        self.within = told.get("within")
        if self.within is not None:
            self.check_within()

    @staticmethod
    def key(a, b):
        return tuple(sorted((str(a), str(b))))

    def check_tree(self):
        """Checks all nodes. Returns the things that they name."""
        seen, todo, named = set(), [(0, ())], set()
        while todo:
            at, way_here = todo.pop()
            index(at, len(self.nodes), "node")
            demand(at not in seen, "a node has two parents:", at)
            seen.add(at)
            node = self.nodes[at]
            if "ways" not in node:
                self.check_leaf(node, way_here)
                continue
            self.check_question(node)
            named |= {node["a"], node["b"], node.get("c", node["b"])}
            todo += [(w["next"], (*way_here, (at, k))) for k, w in enumerate(node["ways"])]
        return named

    def check(self):
        named = self.check_tree() - {self.told["a"], self.told["b"]}
        blamed = self.told["blocked_by"]
        demand(named == set(blamed) and len(named) == len(blamed), "blocked_by is not what the proof is about")

    # ---- The requirement of a node

    def check_question(self, node):
        problem, a, b = self.problem, node["a"], node["b"]
        problem.demand_owed(a, b)
        if node.get("row"):
            self.check_row(node)
            return
        ways = [line_of(w["n"], w["d"], self.unit) for w in node["ways"]]
        if self.alone:
            self.check_alone(node)
        demand("c" not in node or (node.get("shadow") and "side_b" in node and "side_c" in node), "a chord without its sides, or its shadow")
        demand("clearance" in node or node.get("shadow") or (node.get("held") and not node.get("slack")), "a question without a clearance")
        demand(not (node.get("shadow") and node.get("slack")), "a shadow with a slack")
        if node.get("shadow"):
            parts = problem.demand_chord(node) if "c" in node else problem.demand_shadow(a, node["A"], b, node["B"])
            self.check_shadow(difference(*parts), ways)
            return
        self.demand_outside(a, b)
        parts = problem.demand_part(a, node["A"]), problem.demand_part(b, node["B"])
        if node.get("held") and not node.get("slack"):
            self.check_ways(difference(*parts), ways, *self.stood(a, b))
            return
        clearance = Fraction(node["clearance"]) * self.unit
        self.check_clearance(a, b, clearance)
        demand(not node.get("slack") or clearance < 0, "slack, where nothing is held to an overlap")
        if node.get("held"):  # the first way is exactly where the two parts just touch
            h = farthest(difference(*parts), ways[0])
            demand(ways[0][2] <= h, "a line beyond where the parts let go of each other")
            ways[0] = (*ways[0][:2], h)
        self.check_ways(difference(*parts), ways, *((False, 0) if node.get("slack") else (clearance < 0, clearance ** 2)))

    def check_row(self, node):
        """The rule of rows for the bodies of the two, as one way."""
        a, b = node["a"], node["b"]
        bodies = self.body_of(a), self.body_of(b)
        demand(not self.crowded, "a rule without a row")
        demand(self.told["reason"] == "no_room" or (self.told["reason"] == "row" and set(bodies) == set(map(self.body_of, (
            self.told["a"], self.told["b"])))), "a row that the reason does not heed:", a, b)
        self.check_row_of(node)

    def check_row_of(self, node):
        a, b, way = node["a"], node["b"], node["ways"][0]
        bodies = self.body_of(a), self.body_of(b)
        demand(self.problem.rows, "a rule without a row")
        demand(None not in map(self.problem.body_limit, bodies), "a row without a limit:", a, b)
        n, d = self.problem.rows.rule(*bodies, {self.told["a"], self.told["b"]})
        demand(tuple(map(Fraction, way["n"])) == n and Fraction(way["d"]) <= d, "a way that is not the rule of the row of", a, b)

    def demand_outside(self, a, b):
        """With --contained ignore: no move within the limits brings one of two features into the other."""
        limits = [self.limit_of(self.body_of(k)) for k in (a, b)]
        reach = None if None in limits else sum(map(Fraction, limits)) * self.unit
        self.problem.demand_outside(a, b, reach, None if reach is None else reach * reach)

    def check_alone(self, node):
        """For a pair by itself: only the nodes that its reason allows."""
        a, b, reason = node["a"], node["b"], self.told["reason"]
        if not node.get("shadow"):
            demand(self.key(a, b) == self.own, "a pair by itself has no neighbours:", a, b)
            return
        own = {self.body_of(k) for k in (self.told["a"], self.told["b"]) if not self.problem.is_barrier(k)}
        barrier = self.problem.is_barrier(a) or self.problem.is_barrier(b)
        demand(reason in ("jump", "row") or (reason == "side" and barrier), "no ways are heeded by the reason", reason)
        demand(not barrier or self.within is None or reason == "side", "a side, where there is no limit")
        for k in (a, b):
            demand(self.problem.is_barrier(k) or self.body_of(k) in own, "the way of a bystander:", k)

    def check_within(self):
        """Fails unless moves longer than `within` leave these pairs farther apart than required: the two, a feature and
        a barrier with a side, all members of two blocks, or all members of a block and the barriers that are named."""
        a, b = self.told["a"], self.told["b"]
        sided = self.told["reason"] == "side" and self.problem.is_barrier(b)
        joint = self.is_joint()
        demand(sided or joint or self.told["reason"] == "jump", "a length for those without a limit, with the reason",
               self.told["reason"])
        pairs = [(a, b)]
        if joint:
            among = self.problem.is_barrier(b)
            bodies = {self.body_of(a), self.body_of(b)}
            named = {k for node in self.nodes if "ways" in node for k in (node["a"], node["b"], node.get("c", node["b"]))} | {b}
            for k in named:
                demand(among if self.problem.is_barrier(k) else self.body_of(k) in bodies,
                       "a bystander, where there is no limit:", k)
            others = [k for k in named if self.problem.is_barrier(k)] if among else self.body_of(b)
            pairs = [(k, l) for k in self.body_of(a) for l in others]
        within = Fraction(self.within) * self.unit
        for k, l in pairs:
            (p, q), owed = (self.problem.whole(x).box for x in (k, l)), self.problem.required(k, l)
            reach = [max(abs(p[x + 2] - q[x]), abs(p[x] - q[x + 2])) + owed for x in (0, 1)]
            demand(within * within >= reach[0] ** 2 + reach[1] ** 2, "farther out the two could still be too near:", k, l)

    def is_joint(self):
        return self.told["reason"] == "no_room" or self.crowded

    def is_listed(self, a, b):
        """In a crowd all pairs have to keep their distance, whether listed or not."""
        return not self.crowded and self.key(a, b) in self.kinds and self.key(a, b) != self.own

    def check_clearance(self, a, b, clearance):
        """No more than the distance required of the pair or, for another listed pair, than its distance at the
        start."""
        if not self.is_listed(a, b):
            demand(clearance <= self.problem.required(a, b), "more is asked of", a, b, "than they owe")
            return
        demand(self.kinds[self.key(a, b)] not in ("contained", "duplicate"), "what is contained may stay so")
        square, depth, inside = self.problem.how_it_stood(a, b)
        if square < 0:
            demand(not inside, "what is in another may go deeper:", a, b)
            demand(clearance < 0 and depth is not None and depth <= clearance * clearance,
                   "a listed pair is held to more than it had:", a, b)
        elif clearance > 0:
            demand(clearance * clearance <= square, "a listed pair is held to more than it had:", a, b)

    def stood(self, a, b):
        """State of another listed pair at the start: did the interiors meet, and the square of the least translation,
        or of the distance."""
        square, depth, inside = self.problem.how_it_stood(a, b)
        self.demand_held(a, b, square, inside)
        if square < 0:
            demand(depth is not None, "held to a depth that is not known:", a, b)
            return True, depth
        return False, square

    def demand_held(self, a, b, square, inside):
        """May the pair be held to what it had?"""
        demand(self.is_listed(a, b), "held to what it had, and not listed:", a, b)
        demand(self.kinds[self.key(a, b)] not in ("contained", "duplicate"), "what is contained may stay so")
        demand(square >= 0 or not inside, "what is in another may go deeper:", a, b)

    def check_ways(self, polygon, ways, inside, square):
        """The set behind all ways is bounded, and each of its corners is in conflict: its squared distance from the
        polygon is at most `square`, or, with `inside`, a disc of that size around it lies inside the polygon."""
        for w in ways:
            for along in ((w[1], -w[0]), (-w[1], w[0])):
                demand(any(m[0] * along[0] + m[1] * along[1] > 0 for m in ways), "the ways leave a direction out")
        for corner in corners_behind(ways):
            if inside:
                demand(holds_disc(polygon, corner, square), "a move that is no worse has no way")
            else:
                demand(is_near(polygon, corner, square), "a move that keeps the clearance has no way")

    def check_shadow(self, polygon, ways):
        for w in ways:
            for along in ((w[1], -w[0]), (-w[1], w[0])):
                endless = all(m[0] * along[0] + m[1] * along[1] <= 0 for m in ways)
                demand(not endless or is_shaded(polygon, along, True), "the ways leave a direction out")
        for corner in corners_behind(ways):
            demand(is_shaded(polygon, corner, False), "a move that jumps over nothing has no way")

    # ---- Leaves

    def check_leaf(self, leaf, way_here):
        taken = dict(way_here)
        for f in leaf["forces"]:
            node, way = f["node"], f["way"]
            demand(node in taken, "a force that is not on the way, or none")
            demand(0 <= way < taken[node] if f["behind"] else way == taken[node], "a force is on another case")
        self.resting = self.check_still(leaf["still"], taken) if "still" in leaf else None
        demand(self.wins(leaf), "a leaf is no contradiction")

    def check_still(self, lines, taken):
        """The body that is between the lines of two ways, and has no place there but its original one; see
        docs/PROOF.md."""
        found = []
        for node, way in lines:
            demand(node in taken and way == taken[node], "a line that is not on the way")
            node = self.nodes[node]
            way = node["ways"][way]
            if node.get("slack"):
                self.demand_far(node, way)
            else:
                demand(way["d"] == 0, "a line that does not pass where the two stood")
            bodies = [self.body_of(node[k]) for k in "ab"]
            moving = [k for k in (0, 1) if self.limit_of(bodies[k]) != 0]
            demand(len(moving) == 1, "a line between two that move")
            sign = 2 * moving[0] - 1
            found.append((bodies[moving[0]], sign * Fraction(way["n"][0]), sign * Fraction(way["n"][1])))
        (body, px, py), (other, qx, qy) = found
        demand(body == other, "two lines of two bodies")
        demand(px * qy == py * qx and px * qx + py * qy < 0, "lines that are not opposite to each other")
        # `within` is None: some of the longer moves are not multiples of a shorter one
        limit = self.problem.body_limit(body)
        demand(limit is not None, "a lattice without a limit")
        unit = [self.unit_of(body, x, Fraction(limit)) for x in (0, 1)]
        # p i + q j = 0 for integers i and j of units: they are multiples of q and -p, divided by their greatest common
        # divisor.
        p, q = px * unit[0], py * unit[1]
        whole = p.denominator * q.denominator
        p, q = int(p * whole), int(q * whole)
        share = math.gcd(p, q)
        i, j = q // share * unit[0], p // share * unit[1]
        demand(i * i + j * j > Fraction(limit) ** 2, "there is another place on the line")
        return body

    def demand_far(self, node, way):
        """Fails unless the line is so far away that no slack alone can reach it, so that the two may not come nearer
        to it."""
        demand(node.get("held") and way is node["ways"][0], "a line that is not told exactly")
        a, b = node["a"], node["b"]
        inside, square = self.stood(a, b)
        parts = self.problem.demand_part(a, node["A"]), self.problem.demand_part(b, node["B"])
        n = line_of(way["n"], way["d"], self.unit)
        h = farthest(difference(*parts), n)
        demand(inside and h > 0 and h * h >= square * (n[0] * n[0] + n[1] * n[1]),
               "a line that the slack may reach by itself")

    def unit_of(self, body, x, limit):
        """The unit of which the coordinate of every corner is a multiple, at every place within the limit that is a
        double."""
        things = [self.problem.things[k] for k in body]
        at = [Fraction(p[x], self.unit) for t in things for o in [*t.polygons] for ring in o for p in ring]
        low = min(map(abs, at)) - limit  # no coordinate is nearer to 0, if this is positive
        unit = Fraction(1, 1 << 1074)
        if low > 0:
            unit = max(unit, Fraction(2) ** (low.numerator.bit_length() - low.denominator.bit_length() - 54))
        while unit * 2 ** 53 <= low:
            unit *= 2
        return unit

    def is_strict(self, force):
        """Does n.u > d follow, not only n.u >= d? The sides of barriers are closed: what is not in their shadow is strictly
        beyond a line. What is behind a line of anything else is not on it."""
        node = self.nodes[force["node"]]
        closed = bool(node.get("shadow")) and self.problem.is_barrier(node["b"])
        return bool(force["behind"]) != closed

    def wins(self, leaf):
        """Is the sum of the forces greater than the greatest loss by the limits, or equal to it where a force is strict?
        In fractions, since products of doubles may underflow."""
        won, net = Fraction(0), {}
        strict = any(Fraction(f["force"]) > 0 and self.is_strict(f) for f in leaf["forces"])
        for f in leaf["forces"]:
            node = self.nodes[f["node"]]
            way, sign = node["ways"][f["way"]], -1 if f["behind"] else 1
            x, y, d = (Fraction(f["force"]) * Fraction(v) for v in (*way["n"], way["d"]))
            won += sign * d
            a, b = node["a"], node["b"]
            sides = [(self.body_of(a), -sign), (self.body_of(b), sign)]
            if node.get("slack"):  # if a node names the two in the other order, its slack has the opposite sign
                pair = self.key(a, b)
                sides.append((("slack", pair, node["clearance"]), sign if str(a) == pair[0] else -sign))
            for body, side in sides:
                g = net.get(body, (0, 0))
                net[body] = g[0] + side * x, g[1] + side * y
        lost = Fraction(0)
        for body, (x, y) in net.items():
            limit = 0 if body == self.resting else self.limit_of(body)
            if limit == 0 or (x, y) == (0, 0):
                continue
            if limit is None:
                return False
            lost += Fraction(limit) * root_above(x * x + y * y)
        return won > lost or (strict and won == lost)

    def body_of(self, key):
        return key if self.problem.is_barrier(key) else self.problem.block(key)

    def limit_of(self, body):
        """The limit of a body: 0 for a barrier, None if there is none; for a slack, identified by its pair and its
        clearance, the clearance."""
        if isinstance(body, tuple) and body[0] == "slack":
            return -body[2]
        if not isinstance(body, tuple):
            return 0
        limit = self.problem.body_limit(body)
        return self.within if limit is None else limit


def difference(a, b):
    return hull([(p[0] - q[0], p[1] - q[1]) for p in a for q in b])


def farthest(polygon, line):
    """The maximum of the polygon along the normal of a line."""
    return max(line[0] * x + line[1] * y for x, y in polygon)


def corners_behind(ways):
    """The crossings of the lines of two ways that are beyond no way, as homogeneous integers."""
    for p, q in combinations(ways, 2):
        x, y, w = crossing(p, q)
        if w and all(m[0] * x + m[1] * y <= m[2] * w for m in ways):
            yield x, y, w


def sides(polygon, w):
    """The polygon scaled by w."""
    grown = [(w * x, w * y) for x, y in polygon]
    return list(zip(grown, grown[1:] + grown[:1]))


def is_near(polygon, corner, most):
    """Is the place at most the root of `most` from a convex polygon, which may be a segment or a point?"""
    x, y, w = corner
    edges = sides(polygon, w)
    if len(polygon) > 2 and all(plane.side(p, q, (x, y)) >= 0 for p, q in edges):
        return True
    most = Fraction(most) * w * w
    n, d = most.numerator, most.denominator
    return any(square * d <= n * whole for square, whole in (plane.square_to_edge((x, y), e) for e in edges))


def holds_disc(polygon, corner, square):
    """Is the disc around the place within the polygon? square: of its radius."""
    x, y, w = corner
    square = Fraction(square) * w * w
    n, d = square.numerator, square.denominator
    for p, q in sides(polygon, w):
        ex, ey = q[0] - p[0], q[1] - p[1]
        cross = ex * (y - p[1]) - ey * (x - p[0])
        if cross < 0 or cross * cross * d < n * (ex * ex + ey * ey):
            return False
    return len(polygon) > 2


def is_shaded(polygon, v, far):
    """Is s v in the polygon for some s >= 0, with s <= 1 unless `far`? v: a homogeneous place, or a direction."""
    x, y, w = v if len(v) == 3 else (*v, 1)
    if len(polygon) < 3:
        return meets_segment(polygon, x, y, None if far else w)
    low, high = Fraction(0), None if far else Fraction(1, w)
    for p, q in sides(polygon, 1):
        ex, ey = q[0] - p[0], q[1] - p[1]
        slope, level = ex * y - ey * x, ex * p[1] - ey * p[0]
        if slope == 0:
            if level > 0:
                return False
        elif slope > 0:
            low = max(low, Fraction(level, slope))
        else:
            high = Fraction(level, slope) if high is None else min(high, Fraction(level, slope))
    return high is None or low <= high


def check(problem, told):
    """Verifies the conflict by its proof, if it has one."""
    demand(not told.get("crowded") or told["reason"] == "unresolved", "crowded, of another reason:", told["reason"])
    demand((told["reason"] == "same_block") == bool(told.get("inside_block")), "the reason", told["reason"], "of", told["a"],
           "and", told["b"])
    if "proof" not in told:
        decided.check(problem, told)
        return 0
    demand(told["reason"] in ("no_room", "side", "jump", "max_shift", "row") or told.get("crowded"),
           "a proof that nothing is claimed of, with the reason", told["reason"])
    Verdict(problem, told).check()
    return 1
