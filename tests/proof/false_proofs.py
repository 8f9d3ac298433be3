"""False proofs, made from scratch with knowledge of the checker. Each has to be refused, with a message about its
defect.

    python3 false_proofs.py DIRECTORY [NAME ...]

Unlike forgeries.py this does not change valid files: each case has a layer, options and lines of its own, and
violates one rule only. That the proof is false is shown as well. Either there are moves that keep all requirements of
the claim and cost less than the bound, or resolve a conflict that is claimed to have no solution (judge_places.py
decides that); or the claimed fact is looked up. In some cases only the form is wrong, and a checker without the test
in question would end in an exception of Python. DIRECTORY receives the layers.
"""
import os
import sys
from fractions import Fraction

import check_proof
import form
from drafts import write_layer
from judge_places import Places

STUMBLES = "the form"


class Case:
    """name; words of the refusal; layer (FID: feature); barriers (name: features); options, as of the command;
    lines(problem); moves (FID: move) that contradict the claim, or a function of the problem that looks it up, or
    STUMBLES; the number of the false conflict, None if the bound is false."""

    def __init__(self, name, refusal, layer, lines, moves, options="", barriers=None, conflict=None):
        self.name, self.refusal, self.layer, self.lines_of, self.moves = name, refusal, layer, lines, moves
        self.options, self.barriers, self.conflict = options, barriers or {}, conflict

    def prepare(self, directory):
        path = os.path.join(directory, self.name + ".gpkg")
        write_layer(path, "buildings", self.layer)
        self.words = words = ["none.jsonl", path, "--layer", "buildings", "--rows", "no", "--ease", "no", *self.options.split()]
        for name, (features, spec) in self.barriers.items():
            file = os.path.join(directory, f"{self.name}.{name}.gpkg")
            write_layer(file, name, features)
            words += ["--barrier", f"{file},{spec}" if spec else file]
        self.checker = check_proof.Checker(check_proof.read_options(words))
        self.problem = self.checker.problem
        self.lines = self.lines_of(self.problem)

    def answer(self):
        return check_proof.answer(self.checker, lambda: self.lines)

    # ---- Is it false?

    def is_false(self):
        if self.moves == STUMBLES:
            return True
        if callable(self.moves):
            return self.moves(self.problem)
        moves = {fid: tuple(map(Fraction, t)) for fid, t in self.moves.items()}
        told = next(line for line in self.lines if line.get("conflict") == self.conflict) if self.conflict is not None else None
        cost = sum(Fraction(self.problem.weight(f)) * (x * x + y * y) for f, (x, y) in moves.items())
        self.problem.eased.list_conflicts([line for line in self.lines if "conflict" in line])
        cost += self.problem.eased.cost(lambda fid: moves.get(fid, (0, 0)))
        return self.allows(told, moves) and (told is not None or cost < Fraction(self.lines[0]["lower_bound"]))

    def allows(self, told, moves):
        """Do these moves satisfy all requirements that the bound, or the verdict, is about?"""
        problem, places = self.problem, Places(self.problem)
        places.list_conflicts([line for line in self.lines if "conflict" in line and line is not told])
        bodies = list(dict.fromkeys(problem.block(k) for k in problem.place if k not in problem.skipped))
        for members in bodies:
            x, y = moves.get(members[0], (0, 0))
            limit = problem.body_limit(members)
            if limit is not None and x * x + y * y > Fraction(limit) ** 2:
                return False
        bodies += [(key,) for key in problem.half]
        pairs = [(p, q) for k, p in enumerate(bodies) for q in bodies[k + 1:] if problem.may_move(p[0]) or problem.may_move(q[0])]
        return all(self.pair_allows(told, places, p, q, self.relative(moves, p, q)) for p, q in pairs)

    def relative(self, moves, p, q):
        return tuple(int((Fraction(v) - Fraction(w)) * self.problem.lattice.unit)
                     for v, w in zip(moves.get(q[0], (0, 0)), moves.get(p[0], (0, 0))))

    def pair_allows(self, told, places, p, q, u):
        """Are the moves allowed by the question that the reason answers: for the pair alone, with sides, without
        jumps, or with all unlisted pairs?"""
        if told is None or told["reason"] == "no_room":
            return places.bodies_may(p, q, u)
        a, b = told["a"], told["b"]
        if told.get("crowded"):
            crowd = {a, b, *told["blocked_by"]}
            return all(places.pair_may(k, l, u, None) for k in p for l in q if {k, l} <= crowd) and places.may_go(p[0], q[0], u)
        own = [(k, l) for k in p for l in q if {k, l} == {a, b}]
        barrier = self.problem.is_barrier(p[0]) or self.problem.is_barrier(q[0])
        if not all(places.pair_may(k, l, u, None) for k, l in own):
            return False
        if told["reason"] == "jump" and {p, q} == {places.body(a), places.body(b)} or (barrier and told["reason"] in ("side", "jump")):
            return places.may_go(p[0], q[0], u)
        return True

    def wrong(self):
        """Returns None, or what is wrong with the case."""
        if not self.is_false():
            return "what it claims is not shown to be false"
        status, said = self.answer()
        if status != 1 or self.refusal not in said or "not in the form of a proof" in said:
            return f"not refused for what is wrong: {said}"
        return None


def all_cases():
    import false_bounds
    import false_enlargings
    import false_hidings
    import false_lattices
    import false_prices
    import false_rows
    import false_rungs
    import false_verdicts
    return [case for module in (false_bounds, false_enlargings, false_hidings, false_prices, false_rows, false_rungs, false_verdicts, false_lattices) for case in module.CASES]


def prepared(directory, names=()):
    cases = [case for case in all_cases() if not names or case.name in names]
    for case in cases:
        case.prepare(directory)
    return cases


def main(words):
    cases = prepared(words[0], words[1:])
    wrong = [f"{case.name}: {said}" for case in cases for said in [case.wrong()] if said]
    print("\n".join([*wrong, f"{len(cases)} false proofs: {len(wrong)} wrong"]))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
