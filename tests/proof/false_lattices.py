"""False verdicts for false_proofs.py by leaves that are `still`: they claim that a house has no place on a line but
its own.

House 1 has to move by 1 up, out of a floor, or aside. What is beside it is claimed to keep it between two lines with
opposite normals.
"""
from drafts import asked, box, chain, conflict, leaf, part, proof, ring, shifted, ways_out
from false_proofs import STUMBLES, Case

CASES = []
AT = 600000, 5000000  # coordinates at which the units of doubles are 2^-33 and 2^-30
N = 0.9912345678901234, 0.0123456789012345  # so that places on the line are far from each other
BACK = -N[0], -N[1]
HOUSE, FLOOR = box(0, 0, 10, 10, m=5), box(4.5, -20, 5.5, 1, m=0)


def case(name, refusal, layer, questions, last, moves, listed=(), own=None, on=0, **more_told):
    """own: the pair of the false conflict, by default that of the last question. questions: (a, b, parts, ways,
    more). on: see chain()."""
    layer = {fid: shifted(f, *AT) for fid, f in layer.items()}
    questions = [asked(a, b, *([[x + AT[0], y + AT[1]] for x, y in p] for p in parts), ways, **{"clearance": 0, **more})
                 for a, b, parts, ways, more in questions]
    a, b = own or (questions[-1]["a"], questions[-1]["b"])
    blamed = sorted({k for q in questions for k in (q["a"], q["b"])} - {a, b})
    told = [conflict(a, b, "no_room", blocked_by=blamed, proof=chain(questions, last, on), **more_told), *listed]
    CASES.append(Case(name, refusal, layer, lambda problem: proof(problem, told), moves,
                      "--no-blocks --contained separate --max-shift-field m --allow-jumps", conflict=0))


def about(layer, a, b, ways, part_a=None, **more):
    return a, b, (part_a or part(layer[a]), part(layer[b])), ways, more


def lines(n, d, *others):
    """The first way has that normal, the others are parallel to the axes."""
    return [(n, d), *others]


LEFT, RIGHT = (((-1, 0), 200), ((0, 1), 40), ((0, -1), 40)), (((1, 0), 200), ((0, 1), 40), ((0, -1), 40))
UP = [((0, 1), 1), ((0, -1), 30), ((1, 0), 5.5), ((-1, 0), 5.5)]
RESTS = leaf((2, 0), still=[[0, 0], [1, 0]])

# Lines that do not pass through the original place: there is room between its neighbours.
LAYER = {1: HOUSE, 2: box(-200, -100, -8, 110, m=0), 3: box(18, -100, 210, 110, m=0), 4: FLOOR}
case("lines-far-away", "does not pass where", LAYER, [about(LAYER, 2, 1, lines(N, -9, *LEFT)), about(LAYER, 3, 1, lines(BACK, -9, *RIGHT)),
                                                      about(LAYER, 4, 1, UP)], RESTS, {1: (0, 1)})
# Neighbours that may move, too.
LAYER = {1: HOUSE, 2: box(-200, -100, 4, 110, m=20), 3: box(6, -100, 210, 110, m=20), 4: FLOOR}
case("between-two-that-move", "line between two that move", LAYER, [
    about(LAYER, 1, 2, lines(BACK, 0, *RIGHT)), about(LAYER, 1, 3, lines(N, 0, *LEFT)), about(LAYER, 4, 1, UP)], RESTS,
    {1: (0, 1), 2: (-4, 0), 3: (4, 0)})
# One line of each of two houses.
LAYER = {1: HOUSE, 2: box(-200, -100, 4, 110, m=0), 4: FLOOR, 5: box(1000, 0, 1010, 10, m=5), 6: box(1006, -100, 1210, 110, m=0)}
case("lines-of-two-bodies", "two lines of two bodies", LAYER, [
    about(LAYER, 2, 1, lines(N, 0, *LEFT)), about(LAYER, 6, 5, lines(BACK, 0, *RIGHT)), about(LAYER, 4, 1, UP)], RESTS,
    {1: (4, 1), 5: (-4, 0)})
# A single line, given twice.
case("one-line-twice", "not opposite", LAYER, [about(LAYER, 2, 1, lines(N, 0, *LEFT)), about(LAYER, 4, 1, UP)],
     leaf((1, 0), still=[[0, 0], [0, 0]]), {1: (4, 1), 5: (-4, 0)})
# Two walls between which it can slide, in steps of a unit.
DIAMOND = {**ring((0, 0), (5, -5), (10, 0), (5, 5)), "m": 6}
LAYER = {1: DIAMOND, 2: {**ring((100, -100), (-100, 100), (-100, -100)), "m": 0}, 3: {**ring((110, -100), (110, 100), (-90, 100)), "m": 0},
         4: {**ring((-100, -102), (100, 98), (-100, 98)), "m": 0}}
case("places-on-the-line", "another place on the line", LAYER, [
    about(LAYER, 2, 1, lines((1, 1), 0, ((-1, 0), 20), ((0, -1), 20))), about(LAYER, 3, 1, lines((-1, -1), 0, ((1, 0), 20), ((0, 1), 20))),
    about(LAYER, 4, 1, lines((1, -1), 2, ((-1, 0), 20), ((0, 1), 20)))], RESTS, {1: (1, -1)})
# No limit: `within` replaces it, although longer moves along the line exist. The ways to this leaf are checked first.
WALLS = [box(-200, -100, 4, 110)["polygons"][0], box(6, -100, 210, 110)["polygons"][0]]
LAYER = {1: {**HOUSE, "m": None}, 2: {"polygons": WALLS, "m": 0}}
case("lattice-without-limit", "without a limit", LAYER, [
    about(LAYER, 2, 1, [*LEFT, (N, 0)]), about(LAYER, 2, 1, [*RIGHT, (BACK, 0)], part(LAYER[2], 1))],
    leaf((0, 3), still=[[0, 3], [1, 3]]), STUMBLES, on=3, within=1000)


# ---- With a listed pair that has to keep its depth

# A floor that the house overlaps by 2. Its slanted way claims less than the line on which the two parts just touch.
N = 0.6012345678901234, 0.7990123456789012
BACK = -N[0], -N[1]
LAYER = {1: box(0, 0, 10, 10, m=2.05), 2: box(-20, -40, 30, 2, m=0), 3: {**ring((-99, 91), (101, -59), (101, 91)), "m": 0},
         4: box(8, -50, 40, 60, m=0)}
case("line-not-told-exactly", "not told exactly", LAYER, [
    about(LAYER, 4, 1, lines((-1, 0), 2, ((1, 0), 40), ((0, 1), 50), ((0, -1), 50))),
    about(LAYER, 3, 1, lines(BACK, 0, ((1, 0), 20), ((0, 1), 20))),
    about(LAYER, 2, 1, [(N, -1), ((0, 1), 2, leaf((2, 0, 1, True), (2, 1, N[1]))), ((-1, 0), 28), ((0, -1), 18)], slack=True, clearance=-2)],
    leaf((0, 0), still=[[1, 0], [2, 0]]), {1: (-2, 0)}, [conflict(2, 1)], own=(4, 1))
# A floor and a wall, which it overlaps by 0.5 and by 2: the slack of the two is longer than the way out of the floor.
RISE = 3 * 2.0 ** -30
FLOOR, WALL = [(-20, -40), (30, -40), (30, 0.5 + RISE), (-20, 0.5)], box(-40, -30, 2, 40)["polygons"][0]
LAYER = {1: box(0, 0, 10, 10, m=2), 2: {"polygons": [[FLOOR], WALL], "m": 0}, 3: box(-50, 9.75, 60, 60, m=0)}
case("slack-beyond-the-line", "slack may reach by itself", LAYER, [
    about(LAYER, 3, 1, lines((RISE, -50), 0, ((0, 1), 50), ((1, 0), 20), ((-1, 0), 20))),
    about(LAYER, 3, 1, lines((0, -1), 0.25, ((0, 1), 60), ((1, 0), 50), ((-1, 0), 50))),
    about(LAYER, 2, 1, [((-RISE, 50), 25), ((-1, 0), 28), ((1, 0), 20), ((0, -1), 40)], slack=True, held=True, clearance=-2.0625)],
    leaf((1, 0), still=[[0, 0], [2, 0]]), {1: (1, -0.3125)}, [conflict(2, 1)], own=(3, 1))
