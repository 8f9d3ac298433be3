"""The trees of the lower bound: docs/PROOF.md, section 3, line by line."""
from fractions import Fraction
from math import isqrt

from bodies import Bodies
from cover import Beyond, Piece, clip, is_covered, is_nowhere, line_of, region_of, square
from eased import Ahead, Sloped
from form import demand, index, shown


FINE = 1 << 60  # places of discs are rounded to this share of the lattice, and the test is stricter by that


class Tree(Bodies):
    def __init__(self, problem, told):
        super().__init__(problem, told)
        self.pieces_told, self.pieces = told["pieces"], {}
        self.nodes = told["nodes"]
        self.cuts = [{**spring, "d": 0} for spring in told.get("springs", [])]  # as in the file; springs come first
        self.owner = [0] * len(self.cuts)  # for each cut its node
        self.springs = [self.read_spring(spring) for spring in self.cuts]
        self.exact = {}  # (i, j, n, d, stiffness, share) of cuts that have been verified; stiffness 0: no spring; j None: fixed ground
        self.reach = {}
        self.prices = [((i, j), *self.read_price(i, j)) for i, j in told.get("eased", ())]
        self.priced = {at: price for at, *price in self.prices}

    def mass(self, i, j):
        return sum(1 / self.weights[k] for k in (i, j) if self.weights[k] is not None)

    def read_spring(self, told):
        i, j = (index(told[c], len(self.bodies), "body") for c in "ij")
        demand(self.problem.rows and i != j, "a spring without a row")
        return self.problem.rows.spring(self.bodies[i], self.bodies[j], tuple(map(Fraction, told["n"])), Fraction(told["stiff"]))

    def read_price(self, i, j):
        """(the pair, linear, square): lacking s costs linear s + square s^2."""
        one, other = (self.bodies[index(k, len(self.bodies), "body")] for k in (i, j))
        eased = self.problem.eased
        demand(eased.has_price(frozenset((one, other))), "there is no price of", *one, *other)
        pair = frozenset((one, other))
        return pair, *eased.price(pair)

    def proved(self):
        return super().proved()._replace(springs=self.springs, prices=[pair for _, pair, _, _ in self.prices])

    # ---- Bounds by forces

    def read_forces(self, told, node):
        """Reads [(cut, force)]; all cuts have to be on the path to the node."""
        forces = []
        for cut, force in told:
            index(cut, len(self.cuts), "cut")
            at, above = node, self.owner[cut]
            while at is not None and at > above:
                at = self.nodes[at]["parent"]
            demand(at == above, "a force on a cut that is not on the way to its node")
            forces.append((self.cut(cut), Fraction(force)))
        return forces

    def cut(self, k):
        if k not in self.exact:
            told = self.cuts[k]
            self.exact[k] = (told["i"], told.get("j"), tuple(map(Fraction, told["n"])), Fraction(told["d"]),
                             Fraction(told.get("stiff", 0)), Fraction(told.get("share", 0)))
        return self.exact[k]

    def push(self, forces):
        """Returns (value, the net force on each body)."""
        value, net, pushed = Fraction(0), {}, {}
        for (i, j, n, d, stiff, share), f in forces:
            if share:
                pushed[i, j] = pushed.get((i, j), 0) + f * share
            own = d - f / (4 * stiff) if stiff else d
            for k, sign in ((i, -1), (j, 1)):
                if k is None:
                    continue
                a = self.shifts[k]
                own -= sign * (n[0] * a[0] + n[1] * a[1])
                g = net.get(k, (0, 0))
                net[k] = g[0] + sign * f * n[0], g[1] + sign * f * n[1]
            value += f * own
        for k, (x, y) in net.items():
            if self.weights[k] is not None:
                value -= (x * x + y * y) / (4 * self.weights[k])
        return value + sum(self.least_price(*self.priced[pair], f) for pair, f in pushed.items()), net

    def least_price(self, pair, linear, square, force):
        """The least of linear s + square s^2 - force s for all s that the pair may lack."""
        lacks = (force - linear) / (2 * square)
        if lacks <= 0:
            return 0
        most = self.problem.eased.most(pair)
        lacks = lacks if most is None else min(lacks, most)
        return (linear + square * lacks - force) * lacks

    def least_at(self, k, net):
        g, a, w = net.get(k, (0, 0)), self.shifts[k], self.weights[k]
        return a if w is None else (a[0] + g[0] / (2 * w), a[1] + g[1] / (2 * w))

    # ---- Regions and pieces

    def root(self, i, j):
        """The square that contains all relative moves that cost less than the bound and keep the limits, in units of the lattice."""
        centre = [(self.shifts[j][c] - self.shifts[i][c]) * self.unit for c in (0, 1)]
        squared = max(self.bound, Fraction(0)) * self.mass(i, j) * self.unit ** 2
        reach = isqrt(-(-squared.numerator // squared.denominator)) + 1
        limits = [self.problem.body_limit(self.bodies[k]) for k in (i, j)]
        if None not in limits:
            most = sum(Fraction(v) + sum(map(abs, self.shifts[k])) for k, v in zip((i, j), limits)) * self.unit
            reach = min(reach, int(most) + 1)
        low = [int(v // 1) - reach for v in centre]
        high = [int(-(-v // 1)) + reach for v in centre]
        self.reach[i, j] = max(map(abs, low + high))
        return square(*low, *high)

    def same_move(self, i, j):
        """The pair that stands for this one: the move relative to anything that does not move is the same."""
        return (i, None) if self.weights[j] is None else (i, j)

    def region(self, regions, i, j):
        found = regions.get(self.same_move(i, j))
        return self.root(i, j) if found is None else found

    def piece(self, k, i, j):
        index(k, len(self.pieces_told), "piece")
        if k not in self.pieces:
            self.pieces[k] = self.read_piece(self.pieces_told[k])
        at, piece = self.pieces[k]
        demand(at == (i, j), "a piece of another pair")
        return piece

    def read_piece(self, told):
        problem, i, j, a, b = self.problem, told["i"], told["j"], told["a"], told["b"]
        index(i, len(self.bodies), "body")
        index(j, len(self.bodies), "body")
        demand(i != j and a in self.bodies[i] and b in self.bodies[j], "a piece is not of its bodies")
        problem.demand_owed(a, b)
        if told.get("row"):
            demand(problem.rows, "a rule without a row")
            if told.get("priced"):
                return (i, j), self.read_row_price(i, j)
            return (i, j), Beyond(line_of(*problem.rows.rule(self.bodies[i], self.bodies[j]), self.unit))
        if "joined" in told:
            return (i, j), self.read_joined(told)
        shadow, priced = told.get("shadow", False), told.get("priced", False)
        if priced:
            problem.eased.demand_no_deeper(a, b)
        if shadow:
            parts = problem.demand_shadow(a, told["A"], b, told["B"])
        else:
            self.root(i, j)
            problem.demand_outside(a, b, self.reach[i, j])
            parts = problem.demand_part(a, told["A"]), problem.demand_part(b, told["B"])
        owed = 0 if shadow else problem.full(a, b) if priced else problem.clearance(a, b, told.get("clearance"))
        return (i, j), Piece(*parts, owed, shadow, priced)

    def read_row_price(self, i, j):
        """What the two lack at least of the rule of rows with the full gap."""
        rule = self.problem.has_slack and self.problem.rows.full(self.bodies[i], self.bodies[j])
        demand(rule, "nothing of a row is lacked by", *self.bodies[i], *self.bodies[j])
        return Ahead(*rule, self.unit)

    def read_joined(self, told):
        """A polygon that lies in the union of those of priced pieces of the same two things."""
        of = [self.pieces_told[index(k, len(self.pieces_told), "piece")] for k in told["pieces"]]
        demand(all("A" in p and p.get("priced") and all(p[key] == told[key] for key in "ijab") for p in of), "a polygon joined of other pieces")
        pieces = [self.piece(k, told["i"], told["j"]) for k in told["pieces"]]
        corners = [self.problem.lattice.point(p) for p in told["joined"]]
        inner = [Piece(piece.corners, [(0, 0)], 0, False) for piece in pieces]
        demand(is_covered(region_of(corners), inner), "a joined polygon is not in the union:", told["a"], told["b"])
        return Piece(corners, [(0, 0)], pieces[0].owed, False, True)

    def check_price(self, region, i, j, n, d, _, share, named):
        """Fails unless whatever violates the cut is forbidden, or lacks more than the cut says."""
        demand((i, j) in self.priced, "a cut by the price of a pair without one")
        line = line_of(n, d, self.unit)
        pieces = [Sloped(self.piece(k, i, j), n, d, share, self.unit) for k in named]
        demand(is_covered(clip(region, tuple(-v for v in line)), pieces, Sloped.leaving), "the pair may lack less:", *self.bodies[i], *self.bodies[j])

    def demand_covered(self, region, i, j, named):
        demand(is_covered(region, [self.piece(k, i, j) for k in named]), "what is taken away is not forbidden:",
               self.bodies[i], self.bodies[j])

    # ---- Nodes

    def check(self):
        """Verifies the tree; returns the bound that it proves."""
        children = [[] for _ in self.nodes]
        for k, node in enumerate(self.nodes):
            parent = node["parent"]
            demand((parent is None) == (k == 0) and (k == 0 or 0 <= parent < k), "node", k, "has no place in the tree")
            if k:
                children[parent].append(k)
        state = {}  # node: (value, regions, children that are left)
        value = None
        for k, node in enumerate(self.nodes):
            parent = node["parent"]
            above = (Fraction(0) if parent is None else state[parent][0], {} if parent is None else state[parent][1])
            own, regions, empty = self.check_node(k, node, *above, 0 if k == 0 else len(children[parent]))
            if k:
                state[parent][2] -= 1
                if not state[parent][2]:
                    del state[parent]
            if children[k]:
                if len(children[k]) == 3:
                    self.demand_cones([self.nodes[c]["cuts"] for c in children[k]])
                state[k] = [own, regions, len(children[k])]
            elif not empty:
                value = own if value is None or own < value else value
        demand(value is None or value >= self.bound, "the tree proves", value and shown(value), "and not",
               shown(self.bound))
        return self.bound

    def check_node(self, k, node, value, regions, siblings):
        regions, discs = dict(regions), None
        first = len(self.cuts)
        self.cuts += node["cuts"]
        self.owner += [k] * len(node["cuts"])
        for at, told in enumerate(node["cuts"]):
            i, j = told["i"], told.get("j")
            for body in (i, j):
                demand(body is None or body < len(self.bodies), "a cut of no bodies")
            if told["kind"] == "limit":
                self.check_limit(*self.cut(first + at))
                continue
            line = line_of(told["n"], told["d"], self.unit)
            region = self.region(regions, i, j)
            if told["kind"] == "price":
                self.check_price(region, *self.cut(first + at), told["pieces"])
                continue
            if told["kind"] == "cone":
                demand(siblings == 3 and at < 2, "a cone that is no child's first cut")
            elif told["kind"] == "hull":
                self.demand_covered(clip(region, tuple(-v for v in line)), i, j, told["pieces"])
            else:  # a disc
                if discs is None:
                    discs = Discs(self, *self.forces_below(node))
                    value = max(value, discs.value)
                discs.demand_beyond(i, j, line)
            regions[self.same_move(i, j)] = clip(region, line)
        if "empty" in node:
            i, j = (index(node["empty"][c], len(self.bodies), "body") for c in "ij")
            self.demand_covered(self.region(regions, i, j), i, j, node["empty"]["pieces"])
            return value, regions, True
        if node["forces"]:
            value = max(value, self.push(self.read_forces(node["forces"], k))[0])
        return value, regions, False

    def check_limit(self, i, j, n, d, *_):
        """Fails unless -n.t_i >= d excludes no move with |t_i| <= L."""
        limit = self.problem.body_limit(self.bodies[i])
        demand(j is None and limit is not None and d <= 0 and d * d >= (n[0] ** 2 + n[1] ** 2) * Fraction(limit) ** 2,
               "a limit's cut takes away what the limit leaves")

    def forces_below(self, node):
        """The bound by the forces that the discs of a node use: these are forces of the nodes above. There are none at
        the root."""
        parent = node["parent"]
        told = node["by"] if "by" in node else [] if parent is None else self.nodes[parent]["forces"]
        return self.push(self.read_forces(told, parent))

    def demand_cones(self, cuts):
        """Three cones of one pair that cover the plane: no place violates a side of each."""
        lines = []
        for own in cuts:
            demand(len(own) >= 2 and own[0]["kind"] == own[1]["kind"] == "cone", "a child without its cone")
            demand(all((c["i"], c["j"]) == (cuts[0][0]["i"], cuts[0][0]["j"]) for c in own[:2]), "cones of two pairs")
            lines.append([line_of(c["n"], c["d"], self.unit) for c in own[:2]])
        for one in lines[0]:
            for two in lines[1]:
                for three in lines[2]:
                    demand(is_nowhere([one, two, three]), "the children do not cover their parent")


class Discs:
    """The relative moves that are possible at a node if forces prove `value`: a disc for each pair, with its centre
    rounded and the square of its radius rounded up."""

    def __init__(self, tree, value, net):
        self.tree, self.value, self.net, self.found = tree, value, net, {}

    def disc(self, i, j):
        if (i, j) not in self.found:
            tree, scale = self.tree, self.tree.unit * FINE
            p, q = tree.least_at(i, self.net), tree.least_at(j, self.net)
            left = max(tree.bound - self.value, Fraction(0)) * tree.mass(i, j) * scale ** 2
            self.found[i, j] = (round((q[0] - p[0]) * scale), round((q[1] - p[1]) * scale),
                                -(-left.numerator // left.denominator))
        return self.found[i, j]

    def demand_beyond(self, i, j, line):
        """Demands that everything the line excludes is outside the disc."""
        (a, b, c), (x, y, left) = line, self.disc(i, j)
        beyond = a * x + b * y - c * FINE - abs(a) - abs(b)
        demand(beyond >= 0 and beyond * beyond >= left * (a * a + b * b), "a disc's cut takes away what may be cheap")


def add_up(trees):
    """The bound that trees prove together, by groups that share no movable body."""
    group_of, total = {}, Fraction(0)
    by_group, stiff, priced = {}, {}, set()
    for tree in trees:
        for pair in tree.prices:
            demand(pair not in priced, "a price that is there twice")
            priced.add(pair)
        for key, share, most in tree.springs:
            stiff[key] = stiff.get(key, 0) + share
            demand(stiff[key] <= most, "the shares of a spring are more than its stiffness")
        by_group.setdefault(tree.group, []).append(tree)
        for body, weight in zip(tree.bodies, tree.weights):
            if weight is not None:
                demand(group_of.setdefault(body, tree.group) == tree.group, "two groups have", *body)
    for members in by_group.values():
        total += group_bound(members)
    return total


def group_bound(trees):
    """sum of (bound - sum w |a|^2) - sum |sum w a|^2 / (own weight - sum w)."""
    used, pull, own = {}, {}, {}
    total = Fraction(0)
    for tree in trees:
        total += tree.bound
        for body, w, a in zip(tree.bodies, tree.weights, tree.shifts):
            if w is None:
                continue
            total -= w * (a[0] ** 2 + a[1] ** 2)
            used[body] = used.get(body, 0) + w
            p = pull.get(body, (0, 0))
            pull[body] = p[0] + w * a[0], p[1] + w * a[1]
            own[body] = tree.own_weight[body]
    for body, (x, y) in pull.items():
        demand(used[body] <= own[body], "the shares of a body are more than its weight")
        if (x, y) != (0, 0):
            demand(used[body] < own[body], "shifts that do not cancel out have to be paid for")
            total -= (x * x + y * y) / (own[body] - used[body])
    return total
