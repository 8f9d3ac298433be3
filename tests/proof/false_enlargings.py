"""False statements for false_proofs.py about features that were made larger. The true shapes are known by hand: each case shows that the
checker accepts these, and that the file has others."""
import check_proof
from drafts import box, proof
from false_proofs import Case

CASES = []
OPTIONS = "--gap 1 --max-shift 3 --contained separate --enlarge --min-size 10"


def lines_of(larger, more=()):
    """larger: features as of a layer, by FID."""
    def lines(problem):
        head, *rest = proof(problem)
        head["hide"] = {"hidden": 0, "larger": len(larger) + len(more), "shapes": 0, "clauses": 0, "choices": 0, "bound": []}
        blocks = [line for line in rest if "block" in line]
        told = [*larger.items(), *more]
        return [head, *blocks, *({"larger": k, "fid": fid, "polygons": [[list(map(list, r)) for r in p] for p in feature["polygons"]]}
                                 for k, (fid, feature) in enumerate(told))]
    return lines


def case(name, refusal, layer, true, false, options=OPTIONS, more=()):
    def is_false(problem):
        checker = check_proof.Checker(check_proof.read_options(made.words))
        status, _ = check_proof.answer(checker, lambda: lines_of(true)(checker.problem))
        return status == 0 and (false != true or bool(more))
    made = Case(name, refusal, layer, lines_of(false, more), is_false, options)
    CASES.append(made)


def two(*boxes):
    return {"polygons": [p for b in boxes for p in b["polygons"]]}


SHED, LARGE = box(0, 0, 4, 2), box(-3, -4, 7, 6)
case("not-made-larger", "is not made larger", {1: SHED}, {1: LARGE}, {})
case("made-too-large", "is not the feature as given, stretched", {1: SHED}, {1: LARGE}, {1: box(-3, -5, 7, 7)})
case("made-much-too-large", "is made larger than the least size needs", {1: SHED}, {1: LARGE}, {1: box(-6, -7, 10, 9)})
case("made-too-small", "is not made as large as the least size", {1: SHED}, {1: LARGE}, {1: box(-2, -3, 6, 5)})
case("made-larger-elsewhere", "is not the feature as given, stretched", {1: SHED}, {1: LARGE}, {1: box(-2, -4, 8, 6)})
case("made-larger-without-need", "though a disc of the least size fits in it", {1: box(0, 0, 20, 12)}, {}, {1: box(-10, -6, 30, 18)})
case("made-larger-twice", "has two larger shapes", {1: SHED}, {1: LARGE}, {1: LARGE}, more=[(1, LARGE)])
case("made-larger-of-nothing", "there is no feature", {1: SHED}, {1: LARGE}, {1: LARGE}, more=[(2, LARGE)])
case("made-larger-though-rigid", "whose block never changes its shapes", {1: SHED}, {}, {1: LARGE}, OPTIONS + " --rigid-where fid=1")
case("larger-shape-that-crosses-itself", "is no polygon", {1: SHED}, {1: LARGE},
     {1: {"polygons": [[[(-3, -4), (7, 6), (7, -4), (-3, 6)]]]}})

# Two parts, which may grow each by itself where they are far apart, and as one where they are not.
NEAR, FAR = two(box(0, 0, 5, 5), box(7, 0, 12, 5)), two(box(0, 0, 5, 5), box(27, 0, 32, 5))
AS_ONE, EACH = two(box(-6, -2.5, 4, 7.5), box(8, -2.5, 18, 7.5)), two(box(-2.5, -2.5, 7.5, 7.5), box(24.5, -2.5, 34.5, 7.5))
case("parts-that-meet", "has parts that meet when each of them is larger", {1: NEAR}, {1: AS_ONE}, {1: two(box(-2.5, -2.5, 7.5, 7.5), box(4.5, -2.5, 14.5, 7.5))})
case("parts-as-one-though-apart", "stretched along its box about the middle", {1: FAR}, {1: EACH}, {1: two(box(-16, -2.5, -6, 7.5), box(38, -2.5, 48, 7.5))})
case("a-part-less", "has another number of polygons", {1: FAR}, {1: EACH}, {1: box(-2.5, -2.5, 7.5, 7.5)})
case("a-part-more", "has another number of polygons", {1: FAR}, {1: EACH}, {1: two(EACH, box(50, 0, 60, 10))})
case("a-part-more-of-one", "is not the feature as given, stretched", {1: SHED}, {1: LARGE}, {1: two(LARGE, box(-2, -3, 6, 5))})
case("parts-as-one-and-too-large", "is made larger than the least size needs", {1: NEAR}, {1: AS_ONE}, {1: two(box(-9, -3.75, 6, 11.25), box(9, -3.75, 24, 11.25))})
