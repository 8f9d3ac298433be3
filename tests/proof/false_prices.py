"""False bounds for false_proofs.py: trees in which pairs that are left in conflict have prices, each with one step that does not follow."""
from drafts import body, box, conflict, cut, empty, node, part, piece, proof, tree
from false_proofs import STUMBLES, Case

CASES = []
OPTIONS = "--no-blocks --max-shift 0.25 --contained separate --ease 30"


def case(name, refusal, layer, lines, moves, options=OPTIONS):
    CASES.append(Case(name, refusal, layer, lines, moves, options))


# Two squares overlap by 1, and each may move by a quarter. If both do, they pay 8.125.
SQUARES = {1: box(0, 0, 10, 10), 2: box(9, 0, 19, 10)}
APART = {1: (-0.25, 0), 2: (0.25, 0)}
LIMITS = [cut("limit", [-1, 0], -0.25, 0), cut("limit", [1, 0], -0.25, 1)]
LISTED = [conflict(1, 2)]


def of_squares(i=0, j=1, **more):
    """A priced piece of the squares, and a cut by it: the one on the right moves by u, and lacks 1 - u."""
    sign, two = (1, (1, 2)) if i < j else (-1, (2, 1))
    made = piece(i, j, *two, part(SQUARES[two[0]]), part(SQUARES[two[1]]), priced=True)
    return made, cut("price", [sign, 0], 1 - 2 ** -20, i, j, **{"share": 1, "pieces": [0], **more})


def squares(bound, pieces, cuts, forces, conflicts=(*LISTED,), eased=([0, 1],)):
    def lines(problem):
        made = tree(problem, [1, 2], bound, pieces, [node(None, [*LIMITS, *cuts], forces)])
        return proof(problem, conflicts, [{**made, **({"eased": list(eased)} if eased else {})}])
    return lines


PIECE, CUT = of_squares()
case("price-twice", "there twice", SQUARES, squares(16, [PIECE, of_squares(1, 0)[0]], [CUT, of_squares(1, 0, pieces=[1])[1]],
                                                    [[0, 61.5], [1, 61.5], [2, 31], [3, 31]], eased=([0, 1], [1, 0])), APART)
case("price-of-no-conflict", "there is no price", {1: SQUARES[1], 2: box(11, 0, 20, 10)}, squares(0, [], [], [], conflicts=()), STUMBLES)
case("cut-without-a-price", "a pair without one", SQUARES, squares(0, [PIECE], [CUT], [[2, 31]], eased=()), STUMBLES)
case("lacks-less", "may lack less", SQUARES, squares(90, [PIECE], [{**CUT, "n": [0, 0], "d": 3}], [[2, 121]]), {})


def in_two_trees(problem):
    """Each tree has half of the weights, and all of the price."""
    halves = [body(problem, fid, weight=0.5) for fid in (1, 2)]
    made = tree(problem, halves, 8, [PIECE], [node(None, [*LIMITS, CUT], [[0, 30.75], [1, 30.75], [2, 31]])])
    lines = proof(problem, LISTED, [{**made, "eased": [[0, 1]]}] * 2)
    return [{**line, "group": 0} if "group" in line else line for line in lines]


case("price-of-two-trees", "there twice", SQUARES, in_two_trees, APART)


# ---- Joined polygons: they claim that a house is deep in its neighbour

def joined(bodies, things, pieces, corners, lacks):
    """A tree of a polygon that is joined of all pieces, in which the pair lacks so much."""
    a, b = things
    told = [*pieces, {"i": 0, "j": 1, "a": a, "b": b, "joined": corners, "pieces": list(range(len(pieces)))}]
    force = 1 + 60 * lacks

    def lines(problem):
        named = [len(pieces)]
        made = tree(problem, bodies, 29 * lacks ** 2, told, [node(None, [cut("price", [0, 0], lacks, share=1, pieces=named)], [[0, force]])])
        return proof(problem, [conflict(x, b) for x in dict.fromkeys(p["a"] for p in pieces)], [{**made, "eased": [[0, 1]]}])
    return lines


SLIT = {1: {"polygons": [box(0, 0, 10, 10)["polygons"][0], box(13, 0, 23, 10)["polygons"][0]]}, 2: box(9.5, 2, 11.5, 8)}
case("joined-across-a-slit", "not in the union", SLIT, joined(
    [1, 2], (1, 2), [piece(0, 1, 1, 2, part(SLIT[1], k), part(SLIT[2]), priced=True) for k in (0, 1)], [[-6, -6], [6, -6], [6, 6], [-6, 6]], 4), {})
WALL = {1: box(0, 0, 10, 10, k=1), 2: box(10, 0, 20, 10, k=1), 3: box(8, 2, 12, 8)}
case("joined-of-two-houses", "joined of other pieces", WALL, joined(
    [1, 3], (1, 3), [piece(0, 1, fid, 3, part(WALL[fid]), part(WALL[3]), priced=True) for fid in (1, 2)], [[-8, -7], [8, -7], [8, 7], [-8, 7]], 6),
    {}, "--no-blocks --block-field k --max-shift 0.25 --contained separate --ease 30")
INNER = {1: box(0, 0, 20, 20), 2: box(1, 9, 3, 11)}
case("price-of-what-lies-within", "lie deeper", INNER, lambda problem: proof(problem, [conflict(1, 2, kind="contained")], [{**tree(
    problem, [1, 2], 1e5, [piece(0, 1, 1, 2, part(INNER[1]), part(INNER[2]), priced=True)],
    [node(None, [cut("price", [0, 0], 1, share=1, pieces=[0])], [[0, 1e5]])]), "eased": [[0, 1]]}]), {})


# ---- With a least gap: two houses that stand between the two gaps, and have too little room for the full one

BETWEEN = {1: box(0, 0, 10, 10), 2: box(12, 0, 22, 10)}
LEAST = "--no-blocks --gap 3 --least-gap 1 --max-shift 0.125 --ease 0.125"
TIGHT = conflict(1, 2, "", "tight")
case("full-gap-as-the-least", "more is asked of", BETWEEN, lambda problem: proof(problem, [TIGHT], [tree(
    problem, [1, 2], 5, [piece(0, 1, 1, 2, part(BETWEEN[1]), part(BETWEEN[2]), clearance=3)], empty([0]))]), {}, LEAST)
case("price-beyond-the-full-gap", "may lack less", BETWEEN, lambda problem: proof(problem, [TIGHT], [{**tree(
    problem, [1, 2], 5, [piece(0, 1, 1, 2, part(BETWEEN[1]), part(BETWEEN[2]), priced=True)],
    [node(None, [cut("price", [1, 0], 9, share=1, pieces=[0])], [[0, 2]])]), "eased": [[0, 1]]}]), {}, LEAST)
case("tight-for-a-reason", "a reason of what is no conflict", BETWEEN, lambda problem: proof(problem, [conflict(1, 2, "fixed", "tight")]), STUMBLES, LEAST)
case("conflict-for-no-reason", "a reason of what is no conflict", BETWEEN, lambda problem: proof(problem, [conflict(1, 2, "", "too_close")]), STUMBLES, LEAST)
STREET = {fid: box(12 * fid, 0, 12 * fid + 10, 10, row="A") for fid in (1, 2)}


def along_the_row(problem):
    told = {"i": 0, "j": 1, "a": 1, "b": 2, "row": True, "priced": True}
    made = tree(problem, [1, 2], 1, [told], [node(None, [cut("price", [1, 0], 1, share=1, pieces=[0])], [[0, 2]])])
    head, *rest = proof(problem, [conflict(1, 2, kind="too_close")], [{**made, "eased": [[0, 1]]}])
    return [head, {"row": 0, "a": 1, "b": 2, "along": [1, 0], "apart": 2}, *rest]


case("row-at-a-price-without-a-least-gap", "nothing of a row is lacked", STREET, along_the_row, STUMBLES, "--no-blocks --gap 3 --rows row --max-shift 0.125 --ease 30")
