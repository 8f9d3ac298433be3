"""The changes that mutations.py makes to what a file says about features that were made larger. Each function returns False if the file has
nothing of its kind, otherwise the words of the expected refusal."""
import copy

ELSEWHERE, BEYOND, TOO_SMALL = "stretched along its box about the middle", "larger than the least size needs", "not made as large as"


def larger(lines):
    return [line for line in lines if "larger" in line]


def changed(line, place):
    line["polygons"] = [[[place(p) for p in ring] for ring in polygon] for polygon in line["polygons"]]


def scaled(line, factor, across=None):
    """About the middle of the first ring."""
    ring, factors = line["polygons"][0][0], (factor, factor if across is None else across)
    middle = [sum(p[c] for p in ring) / len(ring) for c in (0, 1)]
    changed(line, lambda p: [m + f * (v - m) for v, m, f in zip(p, middle, factors)])


def alone(lines):
    """Lines of features in no block."""
    joined = {fid for line in lines for fid in line.get("block", ())}
    return [line for line in larger(lines) if line["fid"] not in joined]


def without(lines, line):
    lines.remove(line)
    lines[0]["hide"]["larger"] -= 1
    for k, other in enumerate(larger(lines)):
        other["larger"] = k


def not_larger(lines):
    for line in alone(lines):
        without(lines, line)
        return ("is not made larger",)
    return False


def member_not_larger(lines):
    """One member of a block is as given."""
    for line in larger(lines):
        if line not in alone(lines):
            without(lines, line)
            return ELSEWHERE, TOO_SMALL
    return False


def too_large(lines):
    for line in alone(lines):
        scaled(line, 1 + 2 ** -6)
        return BEYOND, ELSEWHERE
    return False


def too_small(lines):
    for line in alone(lines):
        scaled(line, 1 - 2 ** -6)
        return TOO_SMALL, ELSEWHERE
    return False


def wider(lines):
    """Stretched in one direction by as much as the checker would not notice in a disc."""
    for line in alone(lines):
        scaled(line, 1, 1 + 2 ** -12)
        return BEYOND, ELSEWHERE
    return False


def moved(lines):
    for line in alone(lines):
        changed(line, lambda p: [p[0] + 2 ** -10, p[1]])
        return (ELSEWHERE,)
    return False


def with_tip(lines):
    """A corner moved in by a thousandth of the way to the next but one."""
    for line in larger(lines):
        ring = line["polygons"][0][0]
        if len(ring) >= 4:
            ring[0] = [p + (q - p) / 1000 for p, q in zip(ring[0], ring[2])]
            return (ELSEWHERE,)
    return False


def other_feature(lines):
    """The shape of one that is too small, for one that is not."""
    own = {line["fid"] for line in larger(lines)}
    others = [fid for fid in range(1, 100) if fid not in own]
    for line in larger(lines):
        line["fid"] = others[0]
        return "there is no feature", "though a disc of the least size fits in it", "is not made larger", "never changes", ELSEWHERE
    return False


def part_not_larger(lines):
    """One polygon of several is as given, by what the file says of the others."""
    for line in larger(lines):
        if len(line["polygons"]) > 1:
            line["polygons"].pop()
            return "another number of polygons", ELSEWHERE
    return False


def larger_twice(lines):
    for line in larger(lines):
        lines.insert(lines.index(larger(lines)[-1]) + 1, {**copy.deepcopy(line), "larger": len(larger(lines))})
        lines[0]["hide"]["larger"] += 1
        return ("has two larger shapes",)
    return False


def larger_nothing(lines):
    for line in larger(lines):
        line["fid"] = -5
        return ("there is no feature",)
    return False


def larger_crossing(lines):
    for line in larger(lines):
        ring = line["polygons"][0][0]
        ring[0], ring[1] = ring[1], ring[0]
        return ("is no polygon",)
    return False


def none_larger(lines):
    """A file that knows nothing of larger features."""
    if not larger(lines):
        return False
    for line in larger(lines):
        lines.remove(line)
    del lines[0]["hide"]["larger"]
    return ("with or without larger features",)


LARGER = {"feature not larger": not_larger, "member not larger": member_not_larger, "feature made too large": too_large,
          "feature made too small": too_small, "feature stretched in one direction": wider, "larger feature moved": moved,
          "larger feature with a tip": with_tip, "another feature larger": other_feature,
          "part not larger": part_not_larger, "larger feature twice": larger_twice, "larger shape of nothing": larger_nothing,
          "larger shape that crosses itself": larger_crossing, "larger features unknown": none_larger}
