"""False statements about smaller shapes for false_proofs.py: shapes that their rung does not allow. The true ones are known by hand: each
case shows that the checker accepts these, and that the file has others."""
import check_proof
from drafts import box, proof, ring
from false_proofs import Case

CASES = []
OPTIONS = "--gap 1 --max-shift 3 --contained separate --inset 2 --symbol-size 4"
INSET, SCALED, SQUARE = 0, 1, 3  # numbers of rungs, with OPTIONS


def lines_of(shapes):
    """shapes: {FID: (rung, feature as of a layer)}"""
    def lines(problem):
        head, *rest = proof(problem)
        head["hide"] = {"hidden": 0, "shapes": len(shapes), "clauses": 0, "choices": 0, "bound": []}
        told = [{"shape": k, "fid": fid, "level": 1, "rung": rung, "polygons": [[list(map(list, r)) for r in p] for p in feature["polygons"]]}
                for k, (fid, (rung, feature)) in enumerate(shapes.items())]
        return [head, *rest, *told]
    return lines


def case(name, refusal, layer, true, false):
    def is_false(_):
        checker = check_proof.Checker(check_proof.read_options(made.words))
        return check_proof.answer(checker, lambda: lines_of(true)(checker.problem))[0] == 0 and false != true
    made = Case(name, refusal, layer, lines_of(false), is_false, OPTIONS)
    CASES.append(made)


HOUSE, TERRACE = {1: box(0, 0, 20, 10)}, {1: box(0, 0, 20, 10), 2: box(20, 0, 40, 10)}
TRUE = {1: (SQUARE, box(8, 3, 12, 7))}
case("square-with-a-hole", "is no square", HOUSE, TRUE, {1: (SQUARE, {"polygons": [[[(8, 3), (12, 3), (12, 7), (8, 7)], [(9, 4), (9, 6), (11, 6), (11, 4)]]]})})
case("square-that-is-turned", "does not stand along its longest edge", HOUSE, TRUE,
     {1: (SQUARE, ring((8.4, 2.8), (11.6, 5.2), (9.2, 8.4), (6, 6)))})
case("square-of-another-side", "is no square with the side of its rung", HOUSE, TRUE, {1: (SQUARE, box(7, 2, 13, 8))})
case("scaled-in-a-block", ", which is in a block", TERRACE, {1: (SQUARE, box(8, 3, 12, 7))}, {1: (SCALED, box(2, 1, 18, 9))})
case("scaled-by-another-factor", "is not the one as given, scaled by", HOUSE, {1: (SCALED, box(2, 1, 18, 9))}, {1: (SCALED, box(3, 1.5, 17, 8.5))})

# The outline turns outwards, seen from the inside, at (10, 10) of a house with two wings.
WINGS = {1: ring((0, 0), (20, 0), (20, 20), (10, 20), (10, 10), (0, 10))}
case("inset-too-near", "is too near the outline", HOUSE, {1: (INSET, box(2, 2, 18, 8))}, {1: (INSET, box(1, 1, 19, 9))})
case("inset-too-far", "is cut where the outline is far", HOUSE, {1: (INSET, box(2, 2, 18, 8))}, {1: (INSET, box(5, 5, 15, 8))})
case("inset-into-a-corner", "is too near a corner of the outline", WINGS, {1: (INSET, ring((2, 2), (18, 2), (18, 18), (12, 18), (12, 8), (2, 8)))},
     {1: (INSET, ring((2, 2), (18, 2), (18, 18), (12, 18), (12, 10), (10.5, 9.5), (10, 8), (2, 8)))})
