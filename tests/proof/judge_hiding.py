"""Is what an accepted line says about hidden features true? Of a clause it searches for a layout of the members and the features of class 0,
without a conflict; of a tree for a choice that costs less than its bound and hides a member of each of its clauses."""
import random
from fractions import Fraction
from itertools import combinations, product

from judge_places import Places

TRIES = 150


class HidingJudge:
    def __init__(self, problem, hiding):
        self.problem, self.hiding = problem, hiding

    def wrong_with(self, line, lines):
        return self.wrong_with_clause(line) if "clause" in line else self.wrong_with_tree(line, [k for k in lines if "clause" in k])

    def wrong_with_clause(self, line):
        problem, members, before, level = self.problem, dict(line["members"]), self.problem.visible, self.problem.level
        problem.look_at(lambda fid: fid in members or self.hiding.rank(fid) == 0)
        problem.set_levels({**{fid: len(own) for fid, own in problem.smaller.items()}, **members})
        try:
            found = self.layout()
        finally:
            problem.look_at(before)
            problem.set_levels(level)
        return f"a clause that has a layout: {found}" if found else None

    def layout(self):
        """Moves of the bodies with which no pair has a conflict, or None."""
        problem, places, drawn = self.problem, Places(self.problem), random.Random(1)
        for fid, key in product(problem.place, problem.half):
            if problem.is_crossed(fid, key):
                places.kinds[frozenset((fid, key))] = "barrier"
        present = [fid for fid in problem.place if fid not in problem.skipped and not problem.is_hidden(fid)]
        bodies = list(dict.fromkeys(problem.block(fid) for fid in present))
        for trial in range(TRIES):
            moves = {(key,): (0, 0) for key in problem.half}
            for body in bodies:
                moves[body] = self.move(drawn, body) if trial else (0, 0)
            if all(self.may(places, moves, p, q) for p, q in combinations(moves, 2)):
                return {str(body): tuple(map(float, moves[body])) for body in bodies}
        return None

    def move(self, drawn, body):
        limit = self.problem.body_limit(body)
        limit = 100.0 if limit is None else limit
        x, y = (drawn.choice((-1, -0.75, 0, 0.75, 1, drawn.uniform(-1, 1))) * limit for _ in "xy")
        size = (x * x + y * y) ** 0.5
        share = limit / size if size > limit else 1
        return Fraction(x * share * (1 - 2 ** -40)), Fraction(y * share * (1 - 2 ** -40))

    def may(self, places, moves, p, q):
        if not (self.problem.may_move(p[0]) or self.problem.may_move(q[0])) and self.problem.is_barrier(p[0]) and self.problem.is_barrier(q[0]):
            return True
        return places.bodies_may(p, q, tuple(int((t - s) * self.problem.lattice.unit) for s, t in zip(moves[p], moves[q])))

    def wrong_with_tree(self, line, clauses):
        named = {k for node in line["nodes"] for k in [node.get("unmet"), *(share[0] for share in node.get("shares", ()))] if k is not None}
        sets = [{fid for fid, _ in clauses[k]["members"]} for k in named]
        features = sorted({node["split"] for node in line["nodes"] if "split" in node}.union(*sets))
        bound = self.vector(line["bound"])
        for n in range(len(features) + 1):
            for hidden in combinations(features, n):
                cost = {}
                for fid in hidden:
                    for c, weight in self.hiding.cost(fid, 1).items():
                        cost[c] = cost.get(c, 0) + weight
                if all(s & set(hidden) for s in sets) and self.is_less(cost, bound):
                    return f"a bound of {bound} where {hidden} cost {cost}"
        return None

    @staticmethod
    def vector(told):
        return {(1 << 32) - 1 if c is None else c: weight for c, weight in told}

    @staticmethod
    def is_less(p, q):
        classes = sorted({*p, *q})
        return [p.get(c, 0) for c in classes] < [q.get(c, 0) for c in classes]
