"""Is what an accepted line claims true? For each statement it searches for a contradiction.

check_proof.py verifies proofs; this file tries places. Doubles propose a place, integers and fractions decide whether
it contradicts a statement, so a contradiction that is found is real, whatever was rounded. If none is found, nothing
is proved. It shares no code with the verification of trees, prices and verdicts; the layer and the list of conflicts
are those of the checker's problem.

- A tree, or prices: the written result is one of the placements that its bound is about.
- A group: its bound is no more than the cost of its bodies in the result.
- A member of a body: compared with what the program said about it. A piece: places that it forbids are forbidden.
- A hull or an empty node: it excludes no allowed place. A disc, a leaf: no moves within the cuts above cost less (judge_moves.py).
- A question of a verdict: no allowed place is behind all ways. A leaf: no moves within the limits satisfy the ways that lead to it.
"""
import math
import random
from fractions import Fraction

from cover import hull
from form import shown
from judge_hiding import HidingJudge
from judge_moves import cheapest, meeting
from judge_places import Places, polygon_between

TRIES = 10       # random places tried for a statement
MOST_NODES = 10  # nodes tested, of those that a change affects


class Judge:
    def __init__(self, problem, result, lines, hiding=None):
        self.problem, self.result, self.lines = problem, result, lines
        self.places, self.unit = Places(problem), problem.lattice.unit
        self.hides = HidingJudge(problem, hiding)
        self.said = {f["fid"]: f for line in lines for b in line.get("bodies", ()) for f in b.get("features", ())}
        self.still = {fids(b) for line in lines for b in line.get("bodies", ()) if b["weight"] is None}

    def wrong_with(self, lines):
        """Returns a statement of the first line that is false, or None."""
        old = {id(line) for line in self.lines}
        self.places.list_conflicts([line for line in lines if "conflict" in line])
        self.places.list_rows([line for line in lines if "row" in line])
        by_group = {}
        for line in lines:
            if "group" in line:
                by_group.setdefault(line["group"], []).append(line)
        for members in by_group.values():
            wrong = self.wrong_with_group(members)
            if wrong:
                return wrong
        for line in lines:
            if id(line) not in old and ("clause" in line or "choice" in line):
                wrong = self.hides.wrong_with(line, lines)
                if wrong:
                    return wrong
        for line in lines:
            if id(line) not in old and not {"clause", "choice", "hidden"} & set(line):
                before = next((t for t in self.lines if kind_of(t) == kind_of(line)), None)
                wrong = self.wrong_with_tree(line, before) if "group" in line else \
                    self.wrong_with_verdict(line, before) if "proof" in line else None
                if wrong:
                    return wrong
        return None

    # ---- Bounds

    def wrong_with_group(self, trees):
        if any("barrier" in b and b["weight"] is not None for t in trees for b in t["bodies"]):
            return "a barrier that moves"
        own = {fids(b): sum(Fraction(self.said[f["fid"]]["weight"]) for f in b["features"]) for t in trees for b in t["bodies"]
               if b["weight"] is not None and all(f["fid"] in self.said for f in b["features"])}
        shares = {}
        for t in trees:
            for b in t["bodies"]:
                if fids(b) in own and b["weight"] is not None:
                    shares[fids(b)] = shares.get(fids(b), 0) + Fraction(b["weight"])
        if any(shares[body] > w for body, w in own.items()):
            return "shares of a body that are more than its weight"
        if any(b["shift"] != [0, 0] for t in trees for b in t["bodies"]):
            return None  # what such trees prove together is tested for the sum
        if self.shares_springs_twice(trees, own):
            return "shares of a spring that are more than its stiffness"
        cost = sum(w * square(self.move(body)) for body, w in own.items())
        cost += sum(self.cost_of_springs(TreeOf(t)) + self.cost_of_prices(TreeOf(t)) for t in trees)
        bound = sum(Fraction(t["bound"]) for t in trees)
        return f"a group of at least {shown(bound)}, which costs {shown(cost)}" if bound > cost else None

    def shares_springs_twice(self, trees, own):
        used = {}
        for t in map(TreeOf, trees):
            for s in t.line.get("springs", ()):
                key = t.keys[s["i"]], t.keys[s["j"]], tuple(s["n"])
                key = key if key[0] < key[1] else (key[1], key[0], (-key[2][0], -key[2][1]))
                used[key] = used.get(key, 0) + Fraction(s["stiff"])
        for (one, other, n), stiff in used.items():
            if frozenset((one, other)) not in self.places.rows:
                return True
            first, along, _ = self.places.rows[frozenset((one, other))]
            across = abs(along[0] * Fraction(n[0]) + along[1] * Fraction(n[1])) < Fraction(1, 2)
            w = min(own.get(k, math.inf) for k in (one, other))  # the weight of a body that stands still is not known here
            if stiff > w * Fraction(self.problem.options.row_stiffness[0 if across else 1]):
                return True
        return False

    def cost_of_springs(self, tree):
        """In the result."""
        moves = {k: self.move(body) for k, body in enumerate(tree.keys)}
        return sum(Fraction(stiff) * min(Fraction(0), sum(x * moves[k][0] + y * moves[k][1] for k, x, y in terms)) ** 2
                   for terms, stiff in tree.springs)

    def cost_of_prices(self, tree):
        """In the result."""
        return sum(self.problem.eased.cost_of(pair, self.result.moves.get) for pair in map(tree.pair, tree.eased) if self.problem.eased.has_price(pair))

    def wrong_with_tree(self, line, before):
        for body in line["bodies"]:
            for feature in body.get("features", ()):
                known = self.said.get(feature["fid"])
                for key in known or ():
                    if key in feature and feature[key] != known[key]:
                        return f"of {feature['fid']} another {key}"
            if body["weight"] is None and body["shift"] != [0, 0]:
                return "what stands still is shifted"
            if body["weight"] is None and "features" in body and (fids(body) not in self.still or self.move(fids(body)) != (0, 0)):
                return "what moves stands still"
            own = sum(Fraction(f["weight"]) for f in body.get("features", ()))
            if body["weight"] is not None and Fraction(body["weight"]) > own:
                return "a body that weighs more than its members"
        tree, cost = TreeOf(line), self.cost_of(line)
        if tree.bound > cost:
            return f"a bound of {shown(tree.bound)}, where the result costs {shown(cost)}"
        return self.wrong_with_nodes(tree, before) if "nodes" in line and before and "nodes" in before else None

    def cost_of(self, line):
        """The bound compared with the cost in the result, by the weights and shifts of the line."""
        tree, total = TreeOf(line), Fraction(0)
        for body, w, a in zip(tree.keys, tree.weights, tree.shifts):
            if w is not None:
                x, y = self.move(body)
                total += w * square((x - a[0], y - a[1]))
        return total + self.cost_of_springs(tree) + self.cost_of_prices(tree)

    def move(self, body):
        return tuple(map(Fraction, self.result.moves.get(body[0], (0, 0))))

    # ---- Trees

    def wrong_with_nodes(self, tree, before):
        line = tree.line
        shaken = line["bound"] > before["bound"] or any(line.get(key) != before.get(key) for key in ("bodies", "springs", "eased"))
        for k, piece in enumerate(line["pieces"]):
            if shaken or k >= len(before["pieces"]) or piece != before["pieces"][k]:
                if self.contradicts_piece(tree, piece):
                    return f"piece {k} forbids what is allowed"
        said, now = [] if shaken else claims_of(before), claims_of(line)
        own = {k: [claim for claim in claims if k >= len(said) or claim not in said[k]] for k, claims in enumerate(now)}
        changed = [k for k, claims in own.items() if claims]
        nodes = line["nodes"]
        altered = [k for k in changed if k < len(said) and nodes[k] != before["nodes"][k]][:MOST_NODES]
        others = [k for k in changed if k not in altered]
        for k in altered + random.Random(1).sample(others, min(len(others), MOST_NODES)):
            wrong = next((what for what in (self.wrong_with_claim(tree, *claim) for claim in own[k]) if what), None)
            if wrong:
                return f"node {k}: {wrong}"
        for parent in {nodes[k]["parent"] for k in changed} - {None}:
            children = [n["cuts"] for n in nodes if n["parent"] == parent]
            if len(children) > 1 and self.leaves_out([cuts[:2] for cuts in children]):
                return f"node {parent}: a place that is in no cone"
        return None

    def wrong_with_claim(self, tree, kind, told, premises):
        if kind == "hull" and self.finds_place(tree, told["i"], told["j"], premises, told):
            return "a hull takes away what is allowed"
        if kind == "price" and self.finds_place(tree, told["i"], told["j"], premises, None, self.lacks_less(tree, told)):
            return "a pair lacks less"
        if kind == "disc" and self.finds_moves(tree, premises, told):
            return "a disc takes away what is cheap"
        if kind == "limit" and self.is_kept_by_limit(tree, told):
            return "a limit's cut takes away what the limit leaves"
        if kind == "empty" and self.finds_place(tree, told["i"], told["j"], premises, None):
            return "an empty node is not"
        if kind == "leaf" and self.finds_moves(tree, premises, None):
            return "there are cheaper moves"
        return None

    def finds_moves(self, tree, cuts, beyond):
        prices = []
        for ends in tree.eased:
            if not self.problem.eased.has_price(tree.pair(ends)):
                return False
            prices.append((self.problem.eased.price(tree.pair(ends)),
                           [(*side_of(c), c["share"]) for c in cuts if c["kind"] == "price" and [c["i"], c["j"]] == ends]))
        return tree.finds_moves([c for c in cuts if c["kind"] != "price"], beyond, prices)

    def lacks_less(self, tree, cut):
        """A test of relative places: does the pair lack less there than the cut says?"""
        eased, ends = self.problem.eased, [tree.keys[cut[c]] for c in "ij"]
        pairs = [(a, b) for a in ends[0] for b in ends[1]] if self.problem.has_slack else eased.members.get(frozenset(ends), [])

        def test(u):
            slope = (Fraction(cut["d"]) - sum(Fraction(n) * Fraction(v) for n, v in zip(cut["n"], u))) / Fraction(cut["share"])
            return eased.ahead(ends, u) < slope and all(self.places.lacks_less(*p, self.seen_from(tree, cut["i"], p[0], u), slope) for p in pairs)
        return test

    def seen_from(self, tree, i, a, u):
        """The move of the second of two things, if a is the first, on the lattice."""
        x, y = self.on_lattice(u)
        return (x, y) if a in tree.keys[i] else (-x, -y)

    def is_kept_by_limit(self, tree, cut):
        limits = [f["max_shift"] for f in tree.line["bodies"][cut["i"]].get("features", ()) if f["max_shift"] is not None]
        if not limits:
            return True
        if math.isinf(math.hypot(*cut["n"])):
            return False
        nx, ny = map(Fraction, cut["n"])
        size = Fraction(math.hypot(*cut["n"]) or 1)
        t = [v / size * Fraction(min(limits)) * (1 - Fraction(1, 1 << 40)) for v in (nx, ny)]
        return -nx * t[0] - ny * t[1] < Fraction(cut["d"])

    def leaves_out(self, cones):
        """Relative places of each named pair that violate a side of each."""
        drawn = random.Random(1)
        sides = [[((c["i"], c.get("j")), *map(Fraction, c["n"]), Fraction(c["d"])) for c in own] for own in cones]
        largest = min(max([abs(d) for own in sides for *_, d in own] + [1]), 10 ** 100)
        for _ in range(60):
            size = float(largest) * 10 ** drawn.uniform(-4, 4)
            u = {pair: [Fraction(drawn.gauss(0, size)) for _ in "xy"] for own in sides for pair, *_ in own}
            if all(any(nx * u[pair][0] + ny * u[pair][1] < d for pair, nx, ny, d in own) for own in sides):
                return True
        return False

    def finds_place(self, tree, i, j, earlier, cut, also=None):
        """A relative place that two bodies may have within the cuts on them, at a cost below the bound, and beyond
        that one cut; one that passes the test `also`."""
        own = [(*turned(c, i, j), c["d"]) for c in earlier if c["kind"] not in ("price", "limit") and
               ({c["i"], c["j"]} == {i, j} or (c["i"] == i and tree.weights[j] is None and tree.weights[c["j"]] is None))]
        beyond = [] if cut is None else [(-cut["n"][0], -cut["n"][1], -cut["d"])]
        centre, reach = tree.reach(i, j)
        corners = polygon_between(centre, min(reach, 10 ** 24) ** 0.5, own + beyond)
        for u in tried(corners):
            far = square([Fraction(v) - c for v, c in zip(u, map(Fraction, centre))])
            if far < reach and self.is_within_limits(tree, i, j, u) and all(keeps(c, u) for c in own) and (cut is None or not keeps((*cut["n"], cut["d"]), u)):
                if (not also or also(u)) and self.places.bodies_may(tree.keys[i], tree.keys[j], self.on_lattice(u)):
                    return True
        return False

    def is_within_limits(self, tree, i, j, u):
        limits = [0 if tree.weights[k] is None else self.places.limit(tree.keys[k]) for k in (i, j)]
        return None in limits or square(list(map(Fraction, u))) <= sum(map(Fraction, limits)) ** 2

    def contradicts_piece(self, tree, piece):
        """A place that the piece forbids although its bodies may have it."""
        i, j = piece["i"], piece["j"]
        if piece["a"] not in tree.keys[i] or piece["b"] not in tree.keys[j]:
            return True
        if piece.get("row"):
            return frozenset((tree.keys[i], tree.keys[j])) not in self.places.rows or (piece.get("priced", False) and not self.problem.has_slack)
        if "priced" in piece or "joined" in piece:
            return self.says_too_much(piece)
        drawn = random.Random(1)
        owed = float(Fraction(self.places.required(piece["a"], piece["b"])) / self.unit) if "clearance" not in piece else piece["clearance"]
        for k in range(2 * TRIES):
            p, q = (inner(drawn, piece[key]) for key in "AB")
            u = [a - b for a, b in zip(p, q)]
            if piece.get("shadow"):
                share = drawn.uniform(0.3, 1)
                u = [v / share for v in u]
            elif owed > 0:
                x, y = drawn.gauss(0, 1), drawn.gauss(0, 1)
                size = 0.999 * owed * drawn.random() ** 0.2 / ((x * x + y * y) ** 0.5 or 1)
                u = [u[0] + size * x, u[1] + size * y]
            if owed < 0 or not all(abs(v) < 1e15 for v in u):
                continue
            if self.places.bodies_may(tree.keys[i], tree.keys[j], self.on_lattice(u)):
                return True
        return owed < 0 and self.places.depth(piece["a"], piece["b"]) > Fraction(owed) ** 2 * self.unit ** 2

    def says_too_much(self, piece):
        """A place near the middle of a priced piece, at which the two lack less than its depth there."""
        corners = piece.get("joined") or [[p[c] - q[c] for c in (0, 1)] for p in piece["A"] for q in piece["B"]]
        corners = hull([tuple(map(Fraction, p)) for p in corners])
        u = tuple(sum(p[c] for p in corners) / len(corners) for c in (0, 1))
        deep = min((abs(float((q[0] - p[0]) * (u[1] - p[1]) - (q[1] - p[1]) * (u[0] - p[0]))) / (math.dist(p, q) or 1)
                    for p, q in zip(corners, corners[1:] + corners[:1])), default=0)
        says = Fraction(self.problem.full(piece["a"], piece["b"])) / self.unit + Fraction(deep * 0.999)
        return len(corners) > 2 and self.places.lacks_less(piece["a"], piece["b"], self.on_lattice(u), says)

    def on_lattice(self, u):
        return tuple(int(Fraction(v) * self.unit) for v in u)

    # ---- Verdicts

    def wrong_with_verdict(self, line, before):
        nodes, old = line["proof"], before["proof"] if before and "proof" in before else []
        verdict = VerdictOf(line, self.places)
        changed = {k for k, n in enumerate(nodes) if k >= len(old) or n != old[k]}
        if any(line.get(key) != before.get(key) for key in ("reason", "crowded", "a", "b", "within")) if before else True:
            changed = set(range(len(nodes)))
            if "within" in line and verdict.is_near_beyond(Fraction(line["within"])):
                return "the two are too near, farther out"
        for k in sorted(changed):
            if "ways" in nodes[k] and self.finds_way_out(verdict, nodes[k]):
                return f"node {k} has no way for a place that is allowed"
        for path in verdict.paths():
            if changed & set(n for n, _ in path) or path[-1][1] is None and path[-1][0] in changed:
                if verdict.finds_moves(path):
                    return f"leaf {path[-1][0]} is no contradiction"
        return None

    def finds_way_out(self, verdict, node):
        """A place that the two bodies of a question may have, and that no way leads to."""
        ways = [(*w["n"], w["d"]) for w in verdict.ways(node)]
        if not verdict.asks_no_more(node):
            return True
        reach = verdict.reach(node)
        corners = polygon_between((0.0, 0.0), reach, [(-x, -y, -d) for x, y, d in ways])
        for u in tried(corners):
            if not any(keeps(w, u) for w in ways) and verdict.may(node, self.on_lattice(u)):
                return True
        return False


def claims_of(line):
    """The claims of each node of a tree, as (kind, what it is about, the cuts that it presupposes). The forces of a leaf and
    the pieces of a hull are reasons, and no part of the claim."""
    nodes, first = line["nodes"], [len(line.get("springs", []))]
    for node in nodes:
        first.append(first[-1] + len(node["cuts"]))
    every = [None] * first[0] + [cut for node in nodes for cut in node["cuts"]]
    parents, found = {node["parent"] for node in nodes}, []
    for k, node in enumerate(nodes):
        above, at = [], node["parent"]
        while at is not None:
            above += range(first[at], first[at + 1])
            at = nodes[at]["parent"]
        by = node["by"] if "by" in node else nodes[node["parent"]]["forces"] if above else []
        forced = [every[m] for m, _ in by if m in above]
        path = [every[m] for m in above]
        claims = [("disc", cut, forced) if cut["kind"] == "disc" else (cut["kind"], cut, path + node["cuts"][:c])
                  for c, cut in enumerate(node["cuts"])]
        if "empty" in node:
            claims.append(("empty", node["empty"], path + node["cuts"]))
        elif k not in parents:
            claims.append(("leaf", None, path + node["cuts"]))
        found.append(claims)
    return found


class TreeOf:
    """Bodies by their members, with their weights (None: fixed) and shifts."""

    def __init__(self, line):
        self.line, self.bound = line, Fraction(line["bound"])
        self.keys = [fids(b) for b in line["bodies"]]
        self.weights = [None if b["weight"] is None else Fraction(b["weight"]) for b in line["bodies"]]
        self.shifts = [tuple(map(Fraction, b["shift"])) for b in line["bodies"]]
        self.springs = [([(s["i"], *(-Fraction(v) for v in s["n"])), (s["j"], *map(Fraction, s["n"]))], Fraction(s["stiff"]))
                        for s in line.get("springs", ())]

        self.eased = [list(pair) for pair in line.get("eased", ())]

    def pair(self, ends):
        return frozenset(self.keys[k] for k in ends)

    def reach(self, i, j):
        """The range of the relative move at a cost below the bound: a centre, and the square of a radius."""
        mass = sum((1 / self.weights[k] for k in (i, j) if self.weights[k] is not None), Fraction(0))
        return [float(b - a) for a, b in zip(self.shifts[i], self.shifts[j])], self.bound * mass

    def finds_moves(self, cuts, beyond, prices=()):
        """Moves that satisfy the cuts, except for the last one, and cost less than the bound."""
        sides = [side_of(c) for c in cuts]
        if beyond is not None:
            terms, d = side_of(beyond)
            sides.append(([(k, -x, -y) for k, x, y in terms], -d))
        return cheapest(self.weights, self.shifts, sides, self.bound, self.springs, prices)


class VerdictOf:
    """The kinds of questions that the reason of a conflict allows."""

    def __init__(self, line, places):
        self.line, self.nodes, self.places = line, line["proof"], places
        self.own = {line["a"], line["b"]}
        self.crowded, self.reason = bool(line.get("crowded")), line["reason"]
        self.alone = not self.crowded and self.reason != "no_room"

    def asks_no_more(self, node):
        """Is the question within the subject of the reason?"""
        if node.get("row"):
            return not self.crowded and self.reason in ("row", "no_room")
        if self.alone and not node.get("shadow") and {node["a"], node["b"]} != self.own:
            return False
        if self.alone and node.get("shadow") and self.reason == "max_shift":
            return False
        used = not node.get("shadow") and (node.get("slack") or not node.get("held"))
        if used and Fraction(node["clearance"]) * self.places.unit > self.places.required(node["a"], node["b"]):
            return False
        depth = node.get("slack") and self.places.depth(node["a"], node["b"])
        return not node.get("slack") or depth <= Fraction(node["clearance"]) ** 2 * self.places.unit ** 2

    def is_near_beyond(self, within):
        """Is there a place, moved by more than that, where the two are too near each other?"""
        a, b = self.line["a"], self.line["b"]
        steps = [(x, y) for x in range(-4, 5) for y in range(-4, 5) if max(abs(x), abs(y)) == 4]
        moves = [[int(within * self.places.unit * v / Fraction(math.hypot(*step))) for v in step] for step in steps]
        return any(not self.places.pair_may(a, b, u, None) for u in moves)

    def ways(self, node):
        if not (node.get("slack") and node.get("held")):
            return node["ways"]
        first, *rest = node["ways"]
        x, y = map(Fraction, first["n"])
        most = max(x * (Fraction(p[0]) - Fraction(q[0])) + y * (Fraction(p[1]) - Fraction(q[1])) for p in node["A"] for q in node["B"])
        return [{**first, "d": most}, *rest]

    def reach(self, node):
        p, q = (self.places.box(k) for k in (node["a"], node["b"]))
        return 3.0 * float(max(max(abs(p[x + 2] - q[x]), abs(p[x] - q[x + 2])) for x in (0, 1)) +
                           self.places.required(node["a"], node["b"])) / self.places.unit

    def may(self, node, u):
        a, b = node["a"], node["b"]
        if node.get("row"):
            return self.places.keeps_row(self.places.body(a), self.places.body(b), u, self.own)
        if node.get("shadow"):
            others = [b] if "c" not in node else [b, node["c"]]
            return all(self.places.may_go(a, other, u) for other in others)
        if node.get("slack"):
            return not self.places.meet(a, b, u)
        return self.places.pair_may(a, b, u, None if self.crowded or {a, b} == self.own else self.places.kind(a, b))

    def paths(self):
        """The paths [(node, its way)] down to each leaf; the way of a leaf is None."""
        todo = [[(0, None)]]
        while todo:
            path = todo.pop()
            node = self.nodes[path[-1][0]]
            if "ways" not in node:
                yield path
                continue
            for k, way in enumerate(node["ways"]):
                if way["next"] < len(self.nodes) and len(path) <= len(self.nodes):
                    todo.append([*path[:-1], (path[-1][0], k), (way["next"], None)])

    def finds_moves(self, path):
        """Searches for moves within the limits that satisfy the ways of a path, and none of the earlier ways."""
        sides, resting = [], self.resting(path)
        for at, taken in path[:-1]:
            node = self.nodes[at]
            ways = self.ways(node)
            for k, way in enumerate(ways[:taken + 1]):
                sign = 1 if k == taken else -1
                x, y = (sign * v for v in way["n"])
                terms = [(body, s * x, s * y) for body, s in ((self.places.body(node["a"]), -1), (self.places.body(node["b"]), 1))
                         if not self.places.is_barrier(body[0]) and body != resting]
                if node.get("slack"):  # if the two are named in the other order, the sign is opposite
                    turned_round = str(node["a"]) > str(node["b"])
                    slack = "slack", frozenset((node["a"], node["b"])), node["clearance"]
                    terms.append((slack, -x, -y) if turned_round else (slack, x, y))
                sides.append((terms, sign * way["d"]))
        return meeting(sides, self.limit)

    def resting(self, path):
        """The body that two opposite lines keep at its original place."""
        leaf, taken = self.nodes[path[-1][0]], dict(path[:-1])
        if "still" not in leaf or any(n not in taken or taken[n] != w for n, w in leaf["still"]):
            return None
        (m, p), (n, q) = ((self.nodes[n], self.nodes[n]["ways"][w]) for n, w in leaf["still"])
        if any(Fraction(way["d"]) != 0 and not node.get("slack") for node, way in ((m, p), (n, q))):
            return None
        (a, b), (c, d) = (tuple(map(Fraction, v["n"])) for v in (p, q))
        bodies = [[body for body in (self.places.body(v["a"]), self.places.body(v["b"])) if self.limit(body) != 0] for v in (m, n)]
        return bodies[0][0] if a * d == b * c and bodies[0] == bodies[1] and len(bodies[0]) == 1 else None

    def limit(self, body):
        if body[0] == "slack":
            return -body[2]
        if self.places.is_barrier(body[0]):
            return 0
        limit = self.places.limit(body)
        return self.line.get("within") if limit is None else limit


# ---- Helpers

def fids(body):
    return (body["barrier"],) if "barrier" in body else tuple(f["fid"] for f in body["features"])


def kind_of(line):
    """The key that identifies a line."""
    if "conflict" in line:
        return "conflict", frozenset((line["a"], line["b"]))
    return ("group", frozenset(frozenset(fids(b)) for b in line["bodies"])) if "group" in line else None


def square(v):
    return v[0] ** 2 + v[1] ** 2


def turned(cut, i, j):
    return cut["n"] if cut["i"] == i else (-cut["n"][0], -cut["n"][1])


def keeps(side, u):
    terms = float(side[0]) * float(u[0]), float(side[1]) * float(u[1]), -float(side[2])
    size, found = sum(map(abs, terms)), sum(terms)
    if 1e-200 < size < 1e200 and abs(found) > 1e-9 * size:
        return found > 0
    return Fraction(side[0]) * Fraction(u[0]) + Fraction(side[1]) * Fraction(u[1]) >= Fraction(side[2])


def side_of(cut):
    """The terms (body, x, y) of a sum, and d, which the sum has to reach at least."""
    (x, y), j = cut["n"], cut.get("j")
    return [(cut["i"], -x, -y)] + ([] if j is None else [(j, x, y)]), cut["d"]


def inner(drawn, corners):
    """A random place of the convex hull of corners, usually near one of them."""
    shares = [drawn.random() ** 3 + 1e-9 for _ in corners]
    shares[drawn.randrange(len(corners))] += drawn.choice((0, 2, 1000))
    return [sum(s * c[k] for s, c in zip(shares, corners)) / sum(shares) for k in (0, 1)]


def tried(corners):
    """Places of a convex polygon: near its corners, and random ones."""
    drawn = random.Random(1)
    n = len(corners)
    if n < 3 or not all(math.isfinite(v) for c in corners for v in c):
        return
    middle = [sum(c[k] for c in corners) / n for k in (0, 1)]
    for c in corners:
        yield [v + (m - v) * 1e-3 for v, m in zip(c, middle)]
    for k in range(n):
        yield [(v + w) / 2 + (m - (v + w) / 2) * 1e-3 for v, w, m in zip(corners[k - 1], corners[k], middle)]
    for _ in range(TRIES):
        yield inner(drawn, corners)
