"""What a file of --proof says about hidden features (docs/PROOF.md, section 6): which are hidden, the clauses, and the bound.

A feature has the level 0 as given, k with its smaller shape number k, and one more if it is hidden. What it costs to hide is a whole number
of its class; costs are vectors {class: number}, compared in the order of the classes. In trees only two levels count: 0, visible with
whatever shape, and 1, hidden.
"""
import math
from collections import defaultdict
from fractions import Fraction

import decided
from exact import plane
from form import NotRead, demand, index
from geopackage import number_of
from problem import Thing
from repair import area_of, repaired
from rungs import Rungs
from verdicts import Verdict

LAST, UNIT, MOST = (1 << 32) - 1, 1000.0, 1 << 40
HIDDEN = 1


def plus(p, q, sign=1):
    return {c: p.get(c, 0) + sign * q.get(c, 0) for c in {*p, *q}}


def is_less(p, q):
    """Does the first class in which the two differ have less in p?"""
    return next((p.get(c, 0) < q.get(c, 0) for c in sorted({*p, *q}) if p.get(c, 0) != q.get(c, 0)), False)


def vector(told):
    found = {}
    for c, weight in told:
        c = LAST if c is None else c
        found[c] = found.get(c, 0) + weight
    return found


class Clause(Verdict):
    """A proof that all members, beside the features of class 0 and the barriers, cannot be without a conflict together. So no pair is
    listed, except those that are crossed and kept; and what is asked of a pair may be less than that it has no conflict, and never more."""

    def __init__(self, problem, told):
        super().__init__(problem, {**told, "blocked_by": []})
        self.kinds = defaultdict(lambda: "barrier")  # of those that are crossed
        self.alone = self.crowded = False

    def check(self):
        self.check_tree()

    def is_joint(self):
        return self.told["reason"] == "no_room" or self.told.get("crowded", False)

    def is_listed(self, a, b):
        return self.problem.is_crossed(a, b)

    def check_row(self, node):
        self.check_row_of(node)

    def demand_held(self, a, b, square, inside):
        """A pair that is held to its distance at the start owes as much. If its interiors met, it has to do better in any case."""
        if self.is_listed(a, b):
            super().demand_held(a, b, square, inside)
            return
        demand(square <= Fraction(self.problem.required(a, b)) ** 2, "more is asked of", a, b, "than they owe")


class Hiding:
    def __init__(self, problem, options):
        self.problem, self.field, self.weighting = problem, options.hierarchy_field, options.hide_weight
        self.hidden, self.clauses, self.total, self.used = [], [], {}, set()
        self.rungs = Rungs(problem, options)

    # ---- What it costs

    def rank(self, fid):
        """The class; 0: it is never hidden."""
        problem = self.problem
        if problem.is_barrier(fid) or fid in problem.skipped:
            return 0
        if not problem.options.hide:
            return 0
        if self.field is None:
            return 1
        value = number_of(problem.attributes[fid], self.field)
        if value is None:
            return LAST
        if not (value >= 0 and value == math.floor(value) and value < LAST):
            raise NotRead(f"the class of {fid} is {value}")
        return int(value)

    def cost(self, fid, level):
        if level == 0:
            return {}
        area = self.problem.area(fid)
        weight = {"1": 1.0, "area": area, "sqrt-area": math.sqrt(area)}[self.weighting]
        return {self.rank(fid): int(max(1, min(round(UNIT * weight), MOST)))}

    # ---- The lines

    def begin(self, hidden):
        """hidden: the features that are left out, as the file says."""
        problem = self.problem
        demand(len(set(hidden)) == len(hidden), "a feature is hidden twice")
        for fid in hidden:
            demand(fid in problem.place and fid not in problem.skipped, "there is no feature", fid)
            demand(self.rank(fid), fid, "is of a class that is never hidden")
        self.hidden, self.clauses, self.total, self.used = hidden, [], {}, set()
        left_out = set(hidden)
        self.visible = lambda fid: fid not in left_out
        problem.look_at(self.visible)

    def read_shapes(self, lines):
        """The smaller shapes of features, as the file says: each lies in the one before it, and keeps enough of the area."""
        problem = self.problem
        problem.set_levels({})
        problem.smaller, problem.taken, self.taken = {}, {}, {}
        self.rungs.begin()
        for told in lines:
            fid, level, rung, polygons = told["fid"], told["level"], told["rung"], told["polygons"]
            demand(rung < len(self.rungs.rungs), "a smaller shape of", fid, "on a rung that is not wanted")
            demand(fid in problem.place and fid not in problem.skipped, "there is no feature", fid)
            demand(fid not in problem.rigid, "a smaller shape of", fid, ", whose shape never changes")
            own, rungs = problem.smaller.setdefault(fid, []), self.rungs.of.setdefault(fid, [])
            demand(level == len(own) + 1 and all(rung > last for last in rungs), "smaller shapes of", fid, "are not in order, or too many")
            polygons = [[[tuple(p) for p in ring] for ring in polygon] for polygon in polygons]
            demand(all(repaired(p) is p for p in polygons), "a smaller shape of", fid, "is no polygon")
            shape, before = Thing(problem.lattice, polygons, []), own[-1].whole() if own else problem.whole(fid)
            demand(plane.lies_in(shape.whole(), before), "a smaller shape of", fid, "does not lie in the one before")
            if self.rungs.is_trimmed(rung):
                area = float(sum(map(area_of, polygons), Fraction(0)))
                demand(area >= problem.options.trim_keep * problem.area_at_home(fid) * (1 - 2 ** -40), "a smaller shape of", fid, "keeps too little")
                self.demand_cut_back(fid, shape)
            own.append(shape)
            rungs.append(rung)
            if told.get("taken"):
                demand(fid not in self.hidden and fid not in self.taken, fid, "has two shapes, or is hidden")
                self.taken[fid], problem.taken[fid] = level, polygons
        self.rungs.demand_all()

    def demand_cut_back(self, fid, shape):
        """Fails unless the shape keeps its distance from barriers, except where its feature is crossed and kept."""
        problem, whole = self.problem, shape.whole()
        for key in problem.half:
            barrier, owed = problem.whole(key), problem.required(fid, key)
            crosses = plane.boxes_near(problem.whole(fid).box, barrier.box) and problem.crosses(fid, key)
            demand(not crosses or problem.options.crossed != "hide", "a smaller shape of", fid, ", which a line crosses")
            if not (crosses and problem.options.crossed == "keep"):
                demand(not plane.interiors_meet(whole, barrier) and not (owed > 0 and plane.nearer(whole, barrier, owed)),
                       "a smaller shape of", fid, "is too near", key)

    def check_clause(self, told):
        """Returns the members."""
        members = [fid for fid, _ in told["members"]]
        demand(len(set(members)) == len(members), "a member is there twice")
        for fid, level in told["members"]:
            demand(fid in self.problem.place and (self.rank(fid) or level < self.shapes(fid)), "a member that is never hidden:", fid)
            demand(level <= self.shapes(fid), "there is no clause about the level", level, "of", fid)
        among = set(members)
        self.problem.look_at(lambda fid: fid in among or self.rank(fid) == 0)
        self.problem.set_levels({**{fid: len(own) for fid, own in self.problem.smaller.items()}, **dict(map(tuple, told["members"]))})
        listed, self.problem.listed = self.problem.listed, {}
        try:
            self.check_conflict(told)
        finally:
            self.problem.listed = listed
            self.problem.look_at(self.visible)
            self.problem.set_levels(self.taken)
        return told["members"]

    def check_conflict(self, told):
        a, b, reason = told["a"], told["b"], told["reason"]
        if "proof" not in told or "within" in told:  # otherwise the two may be no members, and nothing depends on them
            self.problem.demand_pair(a, b)
            demand(b not in self.problem.block(a), a, "and", b, "are of one block")
        if "proof" in told:
            Clause(self.problem, told).check()
            return
        demand(reason in ("fixed", "max_shift"), "no proof of a clause of", a, "and", b)
        demand(not self.problem.is_crossed(a, b), a, "and", b, "may stay as they stand")
        decided.check(self.problem, {**told, "blocked_by": [], "kind": "overlap"})

    def check_choice(self, told):
        """A tree, in preorder. Returns (its bound, the features that it is about)."""
        bound, self.features, range_of = vector(told["bound"]), set(), {}
        ranges, nodes = [range_of], iter(told["nodes"])
        for node in nodes:
            demand(ranges, "nodes after the last leaf")
            at = ranges.pop()
            if "split" in node:
                fid, level = node["split"], node["level"]
                low, high = at.get(fid, (0, HIDDEN))
                demand(fid in self.problem.place and self.rank(fid) and low < level <= high, "a division at no level of", fid)
                self.features.add(fid)
                ranges += [{**at, fid: (low, level - 1)}, {**at, fid: (level, high)}]
            elif "unmet" in node:
                demand(all(at.get(fid, (0, HIDDEN))[1] <= level for fid, level in self.members(node["unmet"])), "a clause that may be met")
            else:
                demand(not is_less(self.proved(node["shares"], at), bound), "the shares prove less than the bound")
        demand(not ranges, "leaves are missing")
        return bound, frozenset(self.features)

    def shapes(self, fid):
        """The number of smaller shapes."""
        return len(self.problem.smaller.get(fid, ()))

    def members(self, k):
        """Of a clause that only hidden features satisfy, with the levels of trees."""
        found = self.clauses[index(k, len(self.clauses), "clause")]
        demand(all(level == self.shapes(fid) for fid, level in found), "a clause that smaller features may meet:", k)
        found = [(fid, 0) for fid, _ in found]
        self.features |= {fid for fid, _ in found}
        return found

    def proved(self, shares, at):
        """What the least levels cost, and the shares. For each feature and level, the shares of the clauses that it meets then are no more
        than the level costs beyond the least."""
        of, total = {}, {}
        for k, c, weight in shares:
            of[k] = plus(of.get(k, {}), {LAST if c is None else c: weight})
        used = {}
        for k, share in of.items():
            demand(not is_less(share, {}), "a share less than nothing")
            total = plus(total, share)
            for fid, level in self.members(k):
                low, high = at.get(fid, (0, HIDDEN))
                demand(low <= level, "a share of a clause that is met")
                for met in range(level + 1, high + 1):
                    used[fid, met] = plus(used.get((fid, met), {}), share)
        for (fid, level), sums in used.items():
            low = at.get(fid, (0, HIDDEN))[0]
            demand(not is_less(plus(self.cost(fid, level), self.cost(fid, low), -1), sums), "shares of more than what", fid, "costs")
        for fid, (low, _) in at.items():
            total = plus(total, self.cost(fid, low))
        return total

    def add_choice(self, found):
        bound, features = found
        demand(not features & self.used, "two trees are about one feature")
        self.used |= features
        self.total = plus(self.total, bound)

    def end(self, head):
        """Returns what was verified, in words."""
        bound, hides = vector(head["bound"]), {}
        demand(not is_less(self.total, bound), "the trees prove less than the bound of what is hidden")
        for fid in self.hidden:
            hides = plus(hides, self.cost(fid, HIDDEN))
        demand(not is_less(hides, bound), "the bound is more than what is hidden")
        shapes = f"{len(self.taken)} of {sum(map(len, self.problem.smaller.values()))} smaller shapes, " if self.problem.smaller else ""
        return f"hidden {len(self.hidden)}, {shapes}{len(self.clauses)} clauses with proofs; "
