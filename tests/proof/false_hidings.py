"""False statements about hidden features for false_proofs.py, each with one step that does not follow."""
from drafts import asked, box, chain, leaf, line, part, proof
from false_proofs import Case
from hiding import Hiding
from judge_hiding import HidingJudge

CASES = []
OPTIONS = "--no-blocks --contained separate --gap 1 --max-shift 3 --hide --hide-weight 1 --crossed hide"


def lines_of(hidden, clauses, choices, bound):
    """clauses: (members, a, b, reason, perhaps more); choices: (bound, nodes)."""
    def lines(problem):
        head, *rest = proof(problem)
        head["hide"] = {"hidden": len(hidden), "shapes": 0, "clauses": len(clauses), "choices": len(choices), "bound": bound}
        told = [{"clause": k, "members": [[fid, 0] for fid in members], "a": a, "b": b, "reason": reason, **(more[0] if more else {})}
                for k, (members, a, b, reason, *more) in enumerate(clauses)]
        trees = [{"choice": k, "bound": own, "nodes": nodes} for k, (own, nodes) in enumerate(choices)]
        return [head, *rest, *({"hidden": k, "fid": fid} for k, fid in enumerate(hidden)), *told, *trees]
    return lines


def case(name, refusal, layer, hidden, clauses, choices, bound, options=OPTIONS, barriers=None, best=None):
    """best: a choice with a layout that costs less than the bound; None: the last clause has a layout."""
    made = lines_of(hidden, clauses, choices, bound)

    def is_false(problem):
        judge = HidingJudge(problem, Hiding(problem, problem.options))
        if best is None:
            return bool(judge.wrong_with([told for told in made(problem) if "clause" in told][-1], made(problem)))
        before = problem.visible
        problem.look_at(lambda fid: fid not in best)
        found = judge.layout()
        problem.look_at(before)
        return found is not None and 1000 * len(best) < sum(weight for _, weight in bound)
    CASES.append(Case(name, refusal, layer, made, is_false, options, barriers))


# Two squares at one place, of which one has to go.
SQUARES = {1: box(0, 0, 10, 10), 2: box(1, 0, 11, 10)}
EITHER = [([1, 2], 1, 2, "max_shift")]
ONE = [[1, 1000]]
SHARE = {"shares": [[0, 1, 1000]]}
case("shares-beyond-the-cost", "shares of more than what", SQUARES, [1, 2], EITHER, [([[1, 2000]], [{"shares": [[0, 1, 2000]]}])], [[1, 2000]], best={1})
case("bound-of-nothing", "the trees prove less than the bound of what is hidden", SQUARES, [1, 2], EITHER, [(ONE, [SHARE])], [[1, 2000]], best={1})
case("two-trees-of-a-pair", "two trees are about one feature", SQUARES, [1, 2], EITHER, [(ONE, [SHARE])] * 2, [[1, 2000]], best={1})
case("unmet-that-may-be-met", "a clause that may be met", SQUARES, [1, 2], EITHER, [([[1, 2000]], [{"unmet": 0}])], [[1, 2000]], best={1})
case("half-a-tree", "leaves are missing", SQUARES, [1, 2], EITHER, [([[1, 2000]], [{"split": 1, "level": 1}])], [[1, 2000]], best={1})
case("share-of-a-met-clause", "a share of a clause that is met", SQUARES, [1, 2], EITHER,
     [([[1, 2000]], [{"split": 1, "level": 1}, SHARE, {"split": 2, "level": 1}, {"shares": [[0, 1, 1000]]}, {"unmet": 0}])], [[1, 2000]], best={1})
WALLS = {"road": ({1: line((5, -50), (5, 50)), 2: line((45, -50), (45, 50))}, "side=no")}
ROADS = {1: box(0, 0, 10, 10), 2: box(40, 0, 50, 10), 3: box(80, 0, 90, 10)}
EACH = [([1], 1, "road:1", "max_shift"), ([2], 2, "road:2", "max_shift"), ([1, 2], 1, "road:1", "max_shift")]
case("share-below-nothing", "a share less than nothing", ROADS, [1, 2, 3], EACH,
     [([[1, 3000]], [{"shares": [[0, 1, 2000], [1, 1, 2000], [2, 1, -1000]]}])], [[1, 3000]], barriers=WALLS, best={1, 2})
case("clause-of-a-kept-pair", "may stay as they stand", {1: ROADS[1]}, [1], [EACH[0]], [(ONE, [SHARE])], ONE,
     OPTIONS.replace(" --crossed hide", ""), WALLS)
APART = {1: box(0, 0, 10, 10), 2: box(15, 0, 25, 10)}
case("clause-without-a-reason", "no proof of a clause", APART, [1], [([1, 2], 1, 2, "unresolved")], [(ONE, [SHARE])], ONE)
case("clause-of-a-block", "are of one block", {1: box(0, 0, 10, 10, k=1), 2: box(1, 0, 11, 10, k=1)}, [1], [([1, 2], 1, 2, "max_shift")], [(ONE, [SHARE])], ONE,
     OPTIONS + " --block-field k")
case("clause-of-a-stranger", "is hidden", {**SQUARES, 3: box(40, 0, 50, 10)}, [3], [([3], 1, 2, "max_shift")], [(ONE, [SHARE])], ONE)
CASES.append(Case("hidden-that-stays", "never hidden", {1: box(0, 0, 10, 10, c=0), 2: box(1, 0, 11, 10, c=1)}, lines_of([1], [], [], []),
                  lambda problem: Hiding(problem, problem.options).rank(1) == 0, OPTIONS + " --hierarchy-field c"))

# The first one stands 1 too near to a line, and can go 3 to the right, where the second one, which is fixed, stands 5 away. It is asked to
# keep those 5.
WALL = {"wall": ({1: line((-1, -50), (-1, 50))}, "gap=2,side=no")}
HELD = asked(1, 2, part(APART[1]), part(APART[2]), [((1, 0), 0), ((-1, 0), 30), ((0, 1), 10), ((0, -1), 10)], held=True)
OFF = asked("wall:1", 1, [[-1, -50], [-1, 50]], part(APART[1]), [((1, 0), 1), ((-1, 0), 13), ((0, 1), 50), ((0, -1), 60)], clearance=2)
case("held-to-more-than-owed", "than they owe", APART, [1],
     [([1, 2], 1, 2, "no_room", {"proof": chain([HELD, OFF], leaf((0, 0), (1, 0)))})], [(ONE, [SHARE])], ONE,
     OPTIONS + " --fixed-where fid=2", WALL)
