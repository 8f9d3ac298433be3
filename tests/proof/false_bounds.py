"""False bounds for false_proofs.py: trees and prices, each with one step that does not follow."""
from drafts import body, box, conflict, cut, empty, line, node, part, piece, proof, tree
from false_proofs import STUMBLES, Case

CASES = []
SQUARES = {1: box(0, 0, 10, 10, w=1), 2: box(9, 0, 19, 10, w=1), 3: box(500, 0, 510, 10, w=100)}
APART = {1: (-0.5, 0), 2: (0.5, 0)}


def case(name, refusal, layer, lines, moves, options="--no-blocks", **more):
    CASES.append(Case(name, refusal, layer, lines, moves, options, **more))


# ---- Trees

def force_from_elsewhere(problem):
    """Two of three children use the force on a cut of the third."""
    far, all_of_it = cut("cone", [1, 0], 1000), cut("cone", [0, 0], 0)
    nodes = [node(None), node(0, [far, far], [[0, 1]]), *[node(0, [all_of_it] * 2, [[0, 1]])] * 2]
    return proof(problem, trees=[tree(problem, [1, 2], 100, [], nodes)])


case("force-from-elsewhere", "not on the way", SQUARES, force_from_elsewhere, APART)
case("piece-of-others", "another pair", SQUARES, lambda problem: proof(problem, trees=[tree(
    problem, [3, 1, 2], 0.9, [piece(1, 2, 1, 2, part(SQUARES[1]), part(SQUARES[2]))], empty([0]))]), APART,
    "--no-blocks --weight-field w")

# A single child that covers half of its parent's moves; a cut beyond a limit; a distance required of more than two
# bodies.
HALF = [node(None), node(0, [cut("cone", [1, 0], 1000)], [[0, 1]])]
case("cone-of-an-only-child", "no child's first cut", SQUARES, lambda problem: proof(problem, trees=[tree(problem, [1, 2], 100, [], HALF)]),
     APART)
case("cut-within-a-limit", "what the limit leaves", {3: SQUARES[3]}, lambda problem: proof(problem, trees=[tree(
    problem, [3], 100, [], [node(None, [cut("limit", [1, 0], 50)], [[0, 4]])])]), {}, "--no-blocks --max-shift 100")
case("more-than-is-owed", "more is asked", SQUARES, lambda problem: proof(problem, trees=[tree(
    problem, [1, 2], 100, [piece(0, 1, 1, 2, part(SQUARES[1]), part(SQUARES[2]), clearance=100)], empty([0]))]), APART)

# Two houses that are not a block, presented as one body: one has to move, the other does not.
PUSHED = {1: box(0, 0, 10, 10), 2: box(500, 0, 510, 10), 3: box(-20, -20, 1, 30, m=0)}


def one_of_two(problem):
    both = body(problem, 1, features=[f for fid in (1, 2) for f in body(problem, fid)["features"]], weight=2)
    return proof(problem, trees=[tree(problem, [3, both], 1.875, [piece(0, 1, 3, 1, part(PUSHED[3]), part(PUSHED[1]))], empty([0]))])


case("body-of-two", "no block", PUSHED, one_of_two, {1: (1, 0)}, "--no-blocks --max-shift-field m")

INSIDE = {1: box(0, 0, 100, 100, m=0), 2: box(96, 50, 101, 55, m=2)}
IGNORED = "--no-blocks --contained ignore --max-shift-field m --touch-tolerance 0"
case("out-of-another", "lie in each other", INSIDE, lambda problem: proof(problem, trees=[tree(
    problem, [1, 2], 4, [piece(0, 1, 1, 2, part(INSIDE[1]), part(INSIDE[2]))], empty([0]))]), {2: (-1, 0)}, IGNORED)
case("limit-of-no-barrier", "there is no barrier", SQUARES, lambda problem: proof(problem, trees=[tree(
    problem, ["street:1", 1], 0, [], [node(None, [cut("limit", [1, 0], -1)])])]), STUMBLES)

FIXED = {1: box(0, 0, 10, 10, m=0), 2: box(5, 0, 15, 10, m=0), 3: box(100, 0, 110, 10)}
case("between-fixed", "neither", FIXED, lambda problem: proof(problem, trees=[tree(
    problem, [1, 2, 3], 1e9, [piece(0, 1, 1, 2, part(FIXED[1]), part(FIXED[2]))], empty([0]))]), {},
    "--no-blocks --max-shift-field m")
case("between-barriers", "neither", {1: FIXED[3]}, lambda problem: proof(problem, trees=[tree(
    problem, ["walls:1", "walls:2", 1], 1e9, [piece(0, 1, "walls:1", "walls:2", part(FIXED[1]), part(FIXED[2]))], empty([0]))]), {},
    barriers={"walls": ({1: box(0, 0, 10, 10), 2: box(5, 0, 15, 10)}, "")})

COLLECTION = {1: {**box(0, 0, 10, 10), "lines": [[(5, 5), (30, 5)]]}, 2: box(20, 0, 29, 10)}
case("line-of-a-feature", "does not lie in", COLLECTION, lambda problem: proof(problem, trees=[tree(
    problem, [1, 2], 1, [piece(0, 1, 1, 2, [[5, 5], [30, 5]], part(COLLECTION[2]))], empty([0]))]), {})


# ---- The gate: a house moves 8 to the right, out of a fixed feature. A tree claims that the gate blocks its anchor.

WALL, HOUSE = box(-20, -50, 8, 60, m=0), box(0, 0, 10, 10)
GATE = [[7, -50], [7, 60]]


def behind_the_gate(key, gate, anchor):
    def lines(problem):
        pieces = [piece(1, 0, 1, 2, part(WALL), part(HOUSE)), piece(2, 0, key, 2, gate, [anchor], shadow=True)]
        before, beyond = cut("cone", [-1, 0], -7.5, 2, 0), cut("cone", [1, 0], 7.5, 2, 0)
        nodes = [node(None, [cut("hull", [1, 0], 7.875, 1, 0, pieces=[0])]), node(0, [before] * 2, [[0, 1000], [1, 1000]]),
                 *[node(0, [beyond] * 2, empty={"i": 2, "j": 0, "pieces": [1]})] * 2]
        return proof(problem, trees=[tree(problem, [2, 1, key], 100, pieces, nodes)])
    return lines


def gate(name, refusal, feature, spec="", segment=GATE, anchor=(5, 5)):
    case(name, refusal, {1: WALL, 2: HOUSE}, behind_the_gate("gate:1", segment, list(anchor)), {2: (8, 0)},
         "--no-blocks --max-shift-field m --contained separate", barriers={"gate": ({1: feature}, spec)})


gate("side-of-none", "has no sides", line(*GATE), "side=no")
gate("side-of-its-own-line", "lies on", {"lines": [GATE, [(5, 5), (5, 5)]]})
gate("side-from-within", "faces away", box(-60, -50, 7, 60), segment=GATE[::-1])
gate("side-from-elsewhere", "not the side anchor", line((3, -50), (3, 60)), segment=[[3, -50], [3, 60]], anchor=(1, 5))
THIN = box(7, -50, 7.5, 60, m=0)
case("jump-allowed", "jumps are allowed", {1: WALL, 2: HOUSE, 3: THIN}, behind_the_gate(3, part(THIN), [5, 5]), {2: (8, 0)},
     "--no-blocks --max-shift-field m --contained separate --allow-jumps")
case("shadow-of-a-place", "does not lie in the block", {1: WALL, 2: HOUSE, 3: box(70, -50, 70.5, 60, m=0)},
     behind_the_gate(3, part(THIN), [5, 5]), {2: (8, 0)}, "--no-blocks --max-shift-field m --contained separate")
case("jump-out-of-its-holder", "holds the anchor", {1: WALL, 2: HOUSE}, lambda problem: proof(problem, trees=[tree(
    problem, [1, 2], 100, [piece(0, 1, 1, 2, part(WALL), part(HOUSE)),
                           piece(0, 1, 1, 2, [[7, -50], [8, -50], [8, 60], [7, 60]], [[5, 5]], shadow=True)], empty([0, 1]))]),
    {2: (8, 0)}, "--no-blocks --max-shift-field m --contained separate")
case("shadow-without-anchor", "without the anchor", {1: WALL, 2: HOUSE}, lambda problem: proof(problem, trees=[tree(
    problem, [1, 2], 0, [piece(0, 1, 1, 2, part(WALL), part(HOUSE), shadow=True)], empty([0]))]), STUMBLES,
    "--no-blocks --max-shift-field m --contained separate")


# ---- Prices: two houses that overlap by 4, so that each has to move by 2

PAYERS = {1: box(-8, 0, 2, 10), 2: box(-2, 0, 8, 10)}
ROW = [0, 0, 140, 280, 420, 280, 140]  # from the fourth column on, these prices prove 5.8
PRICES = {"side": 1, "unit": 2 ** -10, "x": -3, "y": -2, "columns": 7, "rows": [[]] * 2 + [ROW] * 11 + [[]] * 2}


def priced(bound, conflicts=(), weights=(1, 1), **prices):
    def lines(problem):
        bodies = [body(problem, fid, weight=w) for fid, w in zip((1, 2), weights)]
        return proof(problem, conflicts, [{"bound": bound, "bodies": bodies, "prices": {**PRICES, **prices}}])
    return lines


def stands_still(layer, *fids):
    return {fid: {**feature, **({"m": 0} if fid in fids else {})} for fid, feature in layer.items()}


case("prices-of-other-squares", "side is a power of two", PAYERS, priced(13, side=1.5), {1: (-2, 0), 2: (2, 0)})
case("prices-of-a-listed-pair", "are listed", PAYERS, priced(5, [conflict(1, 2)]), {})
case("prices-within-another", "may lie in each other", {1: box(-8, 0, 8, 10), 2: PAYERS[2]}, priced(5), {},
     "--no-blocks --contained ignore")
case("prices-of-what-stands", "stand still", stands_still(PAYERS, 1, 2), priced(0.5), {}, "--no-blocks --max-shift-field m")
case("prices-without-weight", "who pays prices moves", stands_still(PAYERS, 1), priced(5, weights=(None, 1)), STUMBLES,
     "--no-blocks --max-shift-field m")
case("prices-without-end", "too many nodes", PAYERS, priced(5, columns=1 << 62), STUMBLES)
case("prices-paid-twice", "there twice", {1: box(-2, 0, 2, 10)}, lambda problem: proof(problem, trees=[{
    "bound": 0.125, "bodies": [body(problem, 1, weight=0.5)] * 2, "prices": PRICES}]), {})


def against_each_other(problem):
    """Prices with half of the weight, shifted in the direction of the moves; and a tree with the other half, shifted
    in the opposite direction."""
    def halves(shift):
        return [body(problem, 1, weight=0.5, shift=[-shift, 0]), body(problem, 2, weight=0.5, shift=[shift, 0])]
    pieces = [piece(0, 1, 1, 2, part(PAYERS[1]), part(PAYERS[2]))]
    nodes = [node(None, [cut("hull", [1, 0], 3.9375, pieces=[0])], [[0, 3.96875]])]
    lines = proof(problem, trees=[{"bound": 2.5, "bodies": halves(2), "prices": {**PRICES, "unit": 2 ** -11}},
                                  tree(problem, halves(-2), 15.75, pieces, nodes)], bound=10)
    return [{**line, "group": 0} if "group" in line else line for line in lines]


case("prices-that-are-shifted", "has no shift", PAYERS, against_each_other, {1: (-2, 0), 2: (2, 0)})
