"""False verdicts for false_proofs.py: each claims that a pair has no solution although it has one."""
import math

from drafts import (asked, box, chain, conflict, first, leaf, line, part, proof, question, ring, ways_out)
from false_proofs import STUMBLES, Case

CASES = []
LIMITS = "--no-blocks --contained separate --max-shift-field m"


def case(name, refusal, layer, told, moves, options=LIMITS, **more):
    """told: the conflicts; the first is the false one."""
    CASES.append(Case(name, refusal, layer, lambda problem: proof(problem, told), moves, options, conflict=0, **more))


# ---- Reasons without a proof in the file

OVERLAPPING = {1: box(0, 0, 10, 10, m=1), 2: box(9, 0, 19, 10, m=1)}
FAR = {1: box(0, 0, 10, 10, m=0, k=1), 2: box(90, 0, 100, 10, m=0, k=1)}
OUT = {2: (1, 0)}
case("limits-that-suffice", "none is found", OVERLAPPING, [conflict(1, 2, "max_shift")], OUT)
case("no-room-unproved", "no solution, and no proof", OVERLAPPING, [conflict(1, 2, "no_room")], OUT)
case("fixed-though-it-moves", "may move", OVERLAPPING, [conflict(1, 2, "fixed")], lambda problem: problem.may_move(1))
case("inside-a-block-of-none", "are of one block, or are not", OVERLAPPING, [conflict(1, 2, "same_block", inside_block=True)],
     lambda problem: problem.block(1) != problem.block(2))
case("same-block-of-none", "the reason", OVERLAPPING, [conflict(1, 2, "same_block")], lambda problem: problem.block(1) != problem.block(2))
case("apart-in-a-block", "do not overlap", FAR, [conflict(1, 2, "same_block", inside_block=True)],
     lambda problem: problem.block(1) == problem.block(2), LIMITS + " --block-field k")
case("proof-in-a-block", "the reason", FAR, [conflict(1, 2, "no_room", inside_block=True, proof=[leaf((0, 0))])],
     lambda problem: problem.block(1) == problem.block(2), LIMITS + " --block-field k")
case("kept-by-no-rule", "may not overlap", OVERLAPPING, [conflict(1, 2, "kept")], lambda problem: problem.options.contained != "ignore")
case("fixed-and-apart", "as far apart as they owe", FAR, [conflict(1, 2, "fixed")], {})
case("blamed-for-nothing", "blocked_by", {1: box(0, 0, 10, 10, m=0.25), 2: box(9, 0, 19, 10, m=0.25), 3: FAR[2]},
     [conflict(1, 2, "max_shift", blocked_by=[3])], lambda problem: problem.may_move(1) and not problem.may_move(3))
case("limit-of-the-ignored", "has no conflict", {1: box(0, 0, 10, 10, m=0.5), 2: OVERLAPPING[2]}, [conflict(1, 2, "max_shift")],
     lambda problem: 2 in problem.ignored, LIMITS + " --ignore-where fid=2")
case("barriers-in-conflict", "are barriers", FAR, [conflict("w:1", "w:2", "max_shift")], {},
     barriers={"w": ({1: box(0, 20, 9, 29), 2: box(5, 20, 14, 29)}, "")})
YARD = {1: {"polygons": [[[(-10, -10), (30, -10), (30, 30), (-10, 30)], [(0, 0), (0, 20), (20, 20), (20, 0)]]]}, 2: box(1, 1, 19, 19)}
case("jump-that-is-allowed", "jumps are allowed", YARD, [conflict(1, 2, "jump", "too_close")], {2: (100, 0)},
     "--no-blocks --contained separate --gap 3 --allow-jumps")
INSIDE = {1: box(0, 0, 100, 100, m=0), 2: box(96, 50, 101, 55, m=2)}
IGNORED = "--no-blocks --contained ignore --max-shift-field m --touch-tolerance 0"
case("in-another-unproved", "lie in each other", INSIDE, [conflict(1, 2, "max_shift")], {2: (-1, 0)}, IGNORED)
case("in-another", "lie in each other", INSIDE, [conflict(1, 2, "max_shift", proof=chain(
    [asked(1, 2, part(INSIDE[1]), part(INSIDE[2]), ways_out(-101, -55, 4, 50), clearance=0)], leaf((0, 0))))], {2: (-1, 0)}, IGNORED)


# ---- Forces and premises

BOTH_WAYS = ways_out(-19, -10, 1, 10)
case("force-of-another-case", "another case", OVERLAPPING, [conflict(1, 2, "max_shift", proof=chain(
    [asked(1, 2, part(OVERLAPPING[1]), part(OVERLAPPING[2]), [(*way, leaf((0, 0), (0, 1))) for way in BOTH_WAYS], clearance=0)],
    leaf((0, 0), (0, 1))))], OUT)
case("way-that-is-left-out", "leave a direction out", OVERLAPPING, [conflict(1, 2, "max_shift", proof=chain(
    [asked(1, 2, part(OVERLAPPING[1]), part(OVERLAPPING[2]), BOTH_WAYS[1:], clearance=0)], leaf((0, 0))))], OUT)
ASIDE = {3: box(100, 0, 110, 10), 4: box(101, 0, 111, 10)}  # which have enough room
AWAY = {4: (9, 0)}


def aside(name, refusal, layer, questions, last, listed=(), **more):
    """A pair that another feature is falsely claimed to block."""
    blamed = sorted({k for q in questions for k in (q["a"], q["b"])})
    case(name, refusal, {**layer, **ASIDE}, [conflict(3, 4, "no_room", blocked_by=blamed, proof=chain(questions, last)), *listed], AWAY,
         **more)


NEAR = {1: box(0, 0, 10, 10, m=0.125), 2: box(1, 0, 11, 10, m=0.125)}
LEAVE = asked(1, 2, part(NEAR[1]), part(NEAR[2]), ways_out(-11, -10, 9, 10), clearance=0)
aside("in-the-way-though-ignored", "ignored", NEAR, [LEAVE], leaf((0, 0)), options=LIMITS + " --ignore-where fid=2")
aside("in-the-way-of-its-own-block", "are of one block", {k: {**f, "k": 1} for k, f in NEAR.items()}, [LEAVE], leaf((0, 0)),
      options=LIMITS + " --block-field k")
aside("in-the-way-though-fixed", "neither", {k: {**f, "m": 0} for k, f in NEAR.items()}, [LEAVE], leaf((0, 0)))

case("fixed-by-a-proof", "nothing is claimed", NEAR, [conflict(1, 2, "fixed", proof=chain([LEAVE], leaf((0, 0))))],
     lambda problem: problem.may_move(1))

# A feature in a corridor exactly as wide as itself may slide along it: the claims meet in a line, and neither is strict.
SNUG = {1: box(0, 0, 10, 10, m=1), 2: box(-20, -10, 30, 0, m=0), 3: box(-20, 10, 30, 20, m=0), 4: box(9, 0, 19, 10, m=0)}
case("corridor-without-a-wall", "no contradiction", SNUG, [conflict(1, 4, "no_room", blocked_by=[2, 3], proof=chain(
    [asked(1, 2, part(SNUG[1]), part(SNUG[2]), first(ways_out(-30, 0, 30, 20), 3), clearance=0),
     asked(1, 3, part(SNUG[1]), part(SNUG[3]), first(ways_out(-30, -20, 30, 0), 2), clearance=0)], leaf((0, 0), (1, 0))))], {1: (-1, 0)})
# A wall with sides that begins on that line allows moves away from it. It shuts the case beyond its border (the last leaf),
# since it is closed; but moves behind its border may be on it.
WALL_FROM_THE_LINE = [((0, 1), 0), ((1, 0), -15, leaf((2, 0, 1, True), (1, 0))), ((5, -15), 0, leaf((2, 1, 1, True)))]
case("behind-a-closed-border", "no contradiction", SNUG, [conflict(1, 4, "no_room", blocked_by=[2, 3, "w:1"], proof=chain(
    [asked(1, 2, part(SNUG[1]), part(SNUG[2]), first(ways_out(-30, 0, 30, 20), 3), clearance=0),
     asked(1, 3, part(SNUG[1]), part(SNUG[3]), first(ways_out(-30, -20, 30, 0), 2), clearance=0),
     asked(1, "w:1", [[5, 5]], [[20, 5], [20, 10]], WALL_FROM_THE_LINE, shadow=True)], leaf((0, 0), (2, 0))))], {1: (-1, 0)},
    barriers={"w": ({1: line((20, 5), (20, 10))}, "side=yes")})

# Two listed features that overlap by 8. A slack of 8 separates them, so nothing has to move.
DEEP = {1: box(0, 0, 10, 10, m=0.125), 2: box(2, 0, 12, 10, m=0.125)}
THERE, BACK = ways_out(-12, -10, 8, 10), ways_out(-8, -10, 12, 10)


def there_and_back():
    """The second question names the two in the other order; then the opposite slack separates them."""
    nodes = [None] * 5
    for k, (n, d) in enumerate(THERE):
        ways = []
        for m, (_, e) in enumerate(BACK):
            ways.append((BACK[m][0], e, len(nodes)))
            nodes.append(leaf((0, k, d), (1 + k, m, e)))
        nodes[1 + k] = question(2, 1, part(DEEP[2]), part(DEEP[1]), ways, slack=True, clearance=-8)
    nodes[0] = question(1, 2, part(DEEP[1]), part(DEEP[2]), [(*way, 1 + k) for k, way in enumerate(THERE)], slack=True, clearance=-8)
    return nodes


case("slack-there-and-back", "no contradiction", {**DEEP, **ASIDE},
     [conflict(3, 4, "no_room", blocked_by=[1, 2], proof=there_and_back()), conflict(1, 2)], AWAY)
aside("beyond-where-parts-let-go", "let go of each other", DEEP,
      [asked(1, 2, part(DEEP[1]), part(DEEP[2]), [((1, 0), 1e6), *THERE[1:]], slack=True, held=True, clearance=-8)],
      leaf((0, 0)), [conflict(1, 2)])
case("slack-of-a-shadow", "a shadow with a slack", OVERLAPPING, [conflict(1, 2, "jump", proof=chain(
    [asked(1, 2, part(OVERLAPPING[1]), [[14, 5]], [((1, 0), -4), ((5, 4), 0), ((5, -4), 0)], shadow=True, slack=True, clearance=1e9)],
    leaf((0, 0))))], OUT)
CORNERS = {1: box(0, 0, 10, 10, m=0), 2: box(13, 13, 23, 23, m=1)}
case("slack-of-the-apart", "slack, where nothing", CORNERS, [conflict(1, 2, "max_shift", "too_close", proof=chain(
    [asked(1, 2, part(CORNERS[1]), part(CORNERS[2]), [((1, 0), -3), ((0, 1), -3), ((-1, 0), 23), ((0, -1), 23)], slack=True,
           clearance=5)], leaf((0, 0))))], {2: (0.5625, 0.5625)}, LIMITS + " --gap 5")


# ---- Bystanders

WIDE = {1: box(0, 0, 10, 10, m=0), 2: box(5, 0, 15, 10), 3: box(-500, -500, 500, 500, m=0)}
case("bystander-farther-out", "a bystander", WIDE, [conflict(1, 2, "no_room", blocked_by=[3], within=30, proof=chain(
    [asked(3, 2, part(WIDE[3]), part(WIDE[2]), ways_out(-515, -510, 495, 500), clearance=0)], leaf((0, 0))))], {2: (600, 0)},
    LIMITS + " --allow-jumps")
case("crowd-farther-out", "a bystander", WIDE, [conflict(
    1, 2, "unresolved", blocked_by=[3], crowded=True, within=30, proof=chain(
        [asked(3, 2, part(WIDE[3]), part(WIDE[2]), ways_out(-515, -510, 495, 500), clearance=0)], leaf((0, 0))))], {2: (600, 0)},
    LIMITS + " --allow-jumps")
case("alone-farther-out", "a length for those without", {1: WIDE[1], 2: WIDE[2]}, [conflict(1, 2, "max_shift", within=1, proof=chain(
    [asked(1, 2, part(WIDE[1]), part(WIDE[2]), ways_out(-15, -10, 5, 10), clearance=0)], leaf((0, 0))))], {2: (20, 0)},
    LIMITS + " --allow-jumps")
case("barrier-farther-out", "farther out", {1: {**WIDE[2], "m": None}}, [conflict(
    1, "wall:1", "no_room", blocked_by=["wall:2"], within=30, proof=chain(
        [asked("wall:2", 1, part(WIDE[3]), part(WIDE[2]), ways_out(-515, -510, 495, 500), clearance=0)], leaf((0, 0))))], {1: (600, 0)},
    LIMITS + " --allow-jumps", barriers={"wall": ({1: WIDE[1], 2: WIDE[3]}, "")})
RING = {"polygons": [[[(3, 1), (11, 1), (11, 9), (3, 9)], [(4, 2), (10, 2), (10, 8), (4, 8)]]], "m": 0}


def shut_in():
    """A house that has to move away from the first one by 8 to the right or 10 up or down, out of a ring around its
    anchor."""
    layer = {1: box(0, 0, 10, 10, m=0), 2: box(2, 0, 12, 10, m=11), 3: RING}
    sides = [(part(box(10, 1, 11, 9)), (1, 0), 8), (part(box(3, 8, 11, 9)), (0, 1), 10), (part(box(3, 1, 11, 2)), (0, -1), 10)]
    ways = [(n, d, 1 + k) for k, (_, n, d) in enumerate(sides)] + [((-1, 0), 12, 4)]
    nodes = [question(1, 2, part(layer[1]), part(layer[2]), ways, clearance=0), None, None, None, leaf((0, 3))]
    for k, (wall, (x, y), _) in enumerate(sides):  # beyond the wall, between two lines at a slope of 4/3 to its normal
        ways = [((-x, -y), -3), ((-4 * x - 3 * y, -4 * y + 3 * x), 0), ((-4 * x + 3 * y, -4 * y - 3 * x), 0)]
        nodes[1 + k] = question(3, 2, wall, [[7, 5]], [(n, d, len(nodes) + m) for m, (n, d) in enumerate(ways)], shadow=True)
        nodes += [leaf((0, k), (1 + k, 0)), *(leaf((0, k, 5), (1 + k, m)) for m in (1, 2))]
    return layer, nodes


LAYER, NODES = shut_in()
case("way-of-a-bystander", "a bystander", LAYER, [conflict(1, 2, "jump", blocked_by=[3], proof=NODES)], {2: (8, 0)})


def past_a_wall(name, refusal, reason, wall, ways, moves):
    """A house that has to move by 4 to the right, past a wall that belongs to the same feature as what is on its
    left."""
    layer = {1: {"polygons": [box(-20, -50, 4, 60)["polygons"][0], wall["polygons"][0]], "m": 0}, 2: box(0, 0, 10, 10, m=12)}
    about = [(n, 0, leaf((0, 0, -n[0]), (1, 1 + k))) for k, n in enumerate(ways)]
    nodes = [asked(1, 2, part(layer[1]), part(layer[2]), ways_out(-30, -50, 4, 50), clearance=0),
             asked(1, 2, part(layer[1], 1), [[5, 5]], [((-1, 0), -2), *about], shadow=True)]
    case(name, refusal, layer, [conflict(1, 2, reason, proof=chain(nodes, leaf((0, 0), (1, 0))))], moves)


past_a_wall("ways-that-limits-heed", "no ways are heeded", "max_shift", box(7, -50, 7.5, 60), [(-55, 2), (-55, -2)], {2: (8, 0)})
past_a_wall("past-the-end-of-a-wall", "leave a direction out", "jump", box(7, 4, 7.5, 30), [(-25, 2)], {2: (8, -7)})


# ---- Requirements on listed pairs: a house that has to move by 1 to the right, deeper into another

def pushed(name, refusal, other, ways, kind="overlap", **more):
    layer = {1: box(0, 0, 10, 10, m=2), 2: other, 3: box(-10, 0, 1, 10, m=0)}
    questions = [asked(3, 1, part(layer[3]), part(layer[1]), ways_out(-20, -10, 1, 10), clearance=0),
                 asked(2, 1, part(other), part(layer[1]), first(ways, 1), **more)]
    case(name, refusal, layer, [conflict(3, 1, "no_room", blocked_by=[2], proof=chain(questions, leaf((0, 0), (1, 0)))),
                                conflict(2, 1, kind=kind)], {1: (1, 0)})


def neighbour(name, refusal, reason, kind="overlap", **more):
    """A third house that it touches, or is listed with."""
    layer = {1: box(0, 0, 10, 10, m=2), 2: box(10 if kind == "overlap" else 8, 0, 30, 10, m=0), 3: box(-10, 0, 1, 10, m=0)}
    edge = -layer[2]["polygons"][0][0][0][0] + 10
    questions = [asked(3, 1, part(layer[3]), part(layer[1]), ways_out(-20, -10, 1, 10), clearance=0),
                 asked(2, 1, part(layer[2]), part(layer[1]), first(ways_out(-edge, -10, 30, 10), 1), clearance=0)]
    listed = [conflict(2, 1, kind=kind)] if kind != "overlap" else []
    case(name, refusal, layer, [conflict(3, 1, reason, blocked_by=[2], proof=chain(questions, leaf((0, 0), (1, 0))), **more), *listed],
         {1: (1, 0)})


neighbour("neighbour-of-a-pair", "has no neighbours", "max_shift")
neighbour("crowd-of-the-listed", "crowded, of another reason", "no_room", "contained", crowded=True)
BESIDE, AROUND = box(8, 0, 30, 10, m=0), box(-1, -50, 30, 60, m=0)
pushed("contained-held-to-depth", "may stay so", BESIDE, ways_out(0, -8, 28, 8), "contained", clearance=-2)
pushed("contained-held", "may stay so", BESIDE, ways_out(0, -8, 28, 8), "contained", held=True)
pushed("inside-held-to-depth", "may go deeper", AROUND, ways_out(0, -49, 19, 49), clearance=-11)
pushed("inside-held", "may go deeper", AROUND, ways_out(0, -49, 19, 49), held=True)


def hemmed(name, refusal, other, limit, below, ways, up, kind="overlap", options=LIMITS, **more):
    """A house that has to move up along another one, which is claimed to block it."""
    layer = {1: box(0, 0, 10, 10, m=limit), 2: other, 3: box(-10, -20, 20, below, m=0)}
    questions = [asked(2, 1, part(other)[:4], part(layer[1]), first(ways, 1), **more)]
    moves = up if up == STUMBLES else {1: (0, up)}
    case(name, refusal, layer, [conflict(3, 1, "no_room", blocked_by=[2], proof=chain(questions, leaf((0, 0)))),
                                conflict(2, 1, kind=kind)], moves, options)


hemmed("held-farther-than-it-was", "more than it had", box(11, -50, 30, 60, m=0), 1, -2.5, ways_out(-1.5, -60, 30, 60), 0.5,
       "too_close", LIMITS + " --gap 3", clearance=2.5)
hemmed("held-higher-than-it-was", "more than it had", box(8, -50, 30, 60, m=0), 0.5, 0.25, ways_out(-1, -59, 29, 59), 0.25, clearance=-1)
ROUND = ring(*[(18 + 10 * math.cos(k * math.pi / 60), 5 + 10 * math.sin(k * math.pi / 60)) for k in range(120)])
STAR = ring(*[(5 + 10 * math.cos(k * math.pi / 60), 5 + 10 * math.sin(k * math.pi / 60)) for k in range(120)])
case("held-to-a-depth-unknown", "not known", {1: {**STAR, "m": 1}, 2: {**ROUND, "m": 0}, **ASIDE},
     [conflict(3, 4, "no_room", blocked_by=[2, 1], proof=chain(
         [asked(2, 1, part(ROUND)[::40], part(STAR)[::40], ways_out(-1, -1, 1, 1), held=True)], leaf((0, 0)))), conflict(1, 2)], STUMBLES)


# ---- Chords: a small house moves by 8 to the right, and its anchor past the corner of a line with sides

def chord(name, refusal, corners, at, moves):
    layer = {1: box(-20, -50, 12, 60, m=0), 2: box(4, 4, 6, 6, m=9)}
    up, corner, down = ([*p] for p in corners)
    nodes = [asked(1, 2, part(layer[1]), part(layer[2]), ways_out(-26, -50, 8, 50), clearance=0),
             asked(2, "bow:1", [[5, 5]], [[at, 64], [at, -54]],
                   [((1, 0), 5 - at), ((59, at - 5), 0, leaf((0, 0, 59), (1, 1))), ((59, 5 - at), 0, leaf((0, 0, 59), (1, 2)))],
                   shadow=True, c="bow:1", side_b=[corner, up], side_c=[corner, down])]
    case(name, refusal, layer, [conflict(1, 2, "no_room", blocked_by=["bow:1"], proof=chain(nodes, leaf((0, 0), (1, 0))))], moves,
         barriers={"bow": ({1: line(*corners)}, "")})


chord("chord-before-the-corner", "before the corner", [(6, 66), (40, 5), (6, -56)], 8, {2: (8, 0)})
chord("chord-beyond-the-sides", "no side shadows", [(10, 5.125), (10, 5), (10, 4.875)], 11, {2: (8, 1)})

# Two sides with ends on one ray from the anchor, one above the ray and one below it, far away. The chord meets the ray
# between the two ends: just below the ray the house passes the end of the first side, and no side is behind it.
LAYER = {1: box(-20, -50, 12, 60, m=0), 2: box(4, 4, 6, 6, m=9)}
case("chord-between-two-ends", "before the corner", LAYER, [conflict(1, 2, "no_room", blocked_by=["bow:1", "bow:2"], proof=chain(
    [asked(1, 2, part(LAYER[1]), part(LAYER[2]), ways_out(-26, -50, 8, 50), clearance=0),
     asked(2, "bow:1", [[5, 5]], [[8, 64], [42, -1995]],
           [((2059, 34), -8183), ((59, -3), 0, leaf((0, 0, 59), (1, 1))), ((2000, 37), 0, leaf((0, 0, 2000), (1, 2)))],
           shadow=True, c="bow:2", side_b=[[6, 5], [6, 66]], side_c=[[40, 5], [40, -2500]])], leaf((0, 0, 2059), (1, 0))))],
     {2: (8, -0.5)}, barriers={"bow": ({1: line((6, 5), (6, 66)), 2: line((40, 5), (40, -2500))}, "")})

# Two lines with sides whose ends lie on no ray from the anchor: between them the house passes.
case("chord-across-a-door", "no corner, nor a ray", LAYER, [conflict(1, 2, "no_room", blocked_by=["bow:1", "bow:2"], proof=chain(
    [asked(1, 2, part(LAYER[1]), part(LAYER[2]), ways_out(-26, -50, 8, 50), clearance=0),
     asked(2, "bow:1", [[5, 5]], [[11, 64], [11, -54]],
           [((1, 0), -6), ((59, 6), 0, leaf((0, 0, 59), (1, 1))), ((59, -6), 0, leaf((0, 0, 59), (1, 2)))],
           shadow=True, c="bow:2", side_b=[[10, 7], [10, 66]], side_c=[[10, 3], [10, -56]])], leaf((0, 0), (1, 0))))],
     {2: (8, 0)}, barriers={"bow": ({1: line((10, 7), (10, 66)), 2: line((10, 3), (10, -56))}, "")})


# ---- A file whose second reading differs from the first: first the content of limits-that-suffice, then less

class Changing:
    def __init__(self, before, after):
        self.before, self.after, self.times = before, after, 0

    def __iter__(self):
        self.times += 1
        return iter(self.before if self.times % 2 else self.after)


CASES.append(Case("file-that-changes", "another than it was", OVERLAPPING, lambda problem: Changing(
    proof(problem, [conflict(1, 2, "max_shift")]), proof(problem, [conflict(1, 2)])), lambda problem: True, LIMITS))
