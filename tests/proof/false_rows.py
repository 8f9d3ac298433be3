"""False statements about the rows of --rows FIELD, for false_proofs.py: paths that do not follow from the values of the field."""
from drafts import box, proof
from exact import plane
from false_proofs import STUMBLES, Case

CASES = []
OPTIONS = "--no-blocks --gap 3 --rows row"
# Five houses in line. The fourth is not of the row; the second one is nearer to the first than the third one is.
LAYER = {fid: box(x, 0, x + 10, 10, row=value) for fid, x, value in ((1, 0, "A"), (2, 20, "A"), (3, 42, "A"), (4, 60, "B"), (5, 90, "A"))}
ROAD = {"road": ({1: {"lines": [[(31, -30), (31, 30)]]}}, "")}


def neighbours(layer, a, b, along=(1, 0), apart=None):
    """A line about two houses, of which b is farther to the right."""
    right, left = max(p[0] for p in layer[a]["polygons"][0][0]), min(p[0] for p in layer[b]["polygons"][0][0])
    return {"a": a, "b": b, "along": list(along), "apart": left - right if apart is None else apart}


def case(name, refusal, told, moves, layer=None, options=OPTIONS, barriers=None):
    layer = layer or LAYER
    rows = [pair if isinstance(pair, dict) else neighbours(layer, *pair) for pair in told]

    def lines(problem):
        return [*proof(problem), *({"row": k, **row} for k, row in enumerate(rows))]
    CASES.append(Case(name, refusal, layer, lines, moves, options, barriers))


def is_farther(one, other):
    """Are the two of the first pair farther from each other than those of the second?"""
    return lambda problem: plane.distance_square(*map(problem.whole, one)) > plane.distance_square(*map(problem.whole, other))


def differ(a, b):
    """Have the two different values?"""
    return lambda problem: problem.attributes[a]["row"] != problem.attributes[b]["row"]


def is_of_row(fid, other):
    """Is the feature, which no line names, of the row of the other one?"""
    return lambda problem: problem.attributes[fid]["row"] == problem.attributes[other]["row"]


case("path-past-a-neighbour", "does not join the nearest", [(1, 3), (2, 3), (1, 5, (1, 0), 80)], is_farther((1, 3), (1, 2)))
case("path-of-two-values", "no neighbours in a row", [(1, 2), (2, 3), (3, 4), (4, 5)], differ(3, 4))
case("path-without-its-end", "not one path", [(1, 2), (2, 3)], is_of_row(5, 3))
case("path-that-branches", "branches", [(1, 2), (2, 3), (2, 5)], is_farther((2, 5), (3, 5)))
case("path-in-a-ring", "not one path", [(1, 2), (2, 3), (3, 5), (1, 5)], is_farther((1, 5), (3, 5)))
case("neighbours-of-no-feature", "no neighbours in a row", [(1, 2), (2, 3), {"a": 3, "b": 6, "along": [1, 0], "apart": 38}], STUMBLES)
case("rule-across-a-road", "not the separation", [(1, 2), (2, 3), (3, 5)], lambda problem: any(
    plane.edges_meet(e, [problem.lattice.point(p) for p in ((30, 5), (42, 5))]) for e in problem.things["road:1"].edges_near(
        problem.whole(2).box, 1 << 70)), barriers=ROAD)
# A block of two houses is in the row; the nearer one of them is the other one.
BLOCK = {**LAYER, 3: box(42, 0, 52, 10, row="A", k=1), 6: box(53, 0, 63, 10, k=1)}
case("neighbours-by-a-far-member", "nearest to each other", [(1, 2), (2, 3), (3, 5, (1, 0), 27)],
     is_farther((3, 5), (5, 6)), BLOCK, OPTIONS + " --block-field k")
TORN = {**LAYER, 3: box(42, 0, 52, 10, row="A", k=1), 4: box(60, 0, 70, 10, row="B", k=1)}
case("block-in-two-rows", "in two rows", [(1, 2), (2, 3), (4, 5)], differ(3, 4), TORN, OPTIONS + " --block-field k")
