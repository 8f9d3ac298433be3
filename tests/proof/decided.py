"""Verdicts for which the file needs no proof: decided here, from the layer, the barriers and the options alone.

`fixed`, `same_block` and `kept` are looked up. That a pair alone cannot keep the gap within its limits, or not
without a jump, is shown by covering all relative moves within the limits with forbidden sets: convex pieces, as in
trees (cover.py).
"""
import math
from fractions import Fraction

from cover import FINE, Piece, clip, fine_of, halves, hull, square
from exact import plane
from form import demand
from nearly_in import hair_of, lies_in_grown
from pieces import trapezoids
from problem import root_above

MOST_STEPS = 20_000


def check(problem, told):
    """Checks a conflict without a proof of its own."""
    a, b, reason = told["a"], told["b"], told["reason"]
    demand((reason == "") == (told["kind"] == "tight"), "a reason of what is no conflict, or none of one:", a, b)
    demand(reason == "unresolved" or not told["blocked_by"], "blocked_by is not what decides about", a, "and", b)
    still = not problem.is_barrier(a) and all(limit_of(problem, k) == 0 for k in (a, b))
    if reason == "fixed":
        demand(still, "one of", a, "and", b, "may move")
        demand(is_too_near(problem, a, b), a, "and", b, "stand as far apart as they owe")
    elif reason == "kept":
        demand(problem.is_crossed(a, b) or (problem.options.contained == "ignore" and is_kept(problem, a, b)), a, "and", b, "may not overlap")
    elif reason == "same_block":
        p, q = (problem.whole(k) for k in (a, b))
        demand(told["kind"] not in ("overlap", "contained", "duplicate") or plane.interiors_meet(p, q), a, "and", b, "do not overlap")
    elif reason in ("max_shift", "jump"):
        demand(is_shut(problem, a, b, reason == "jump"), "no proof, and none is found, that", a, "and", b, "have no solution by",
               reason)
    elif reason:
        demand(reason == "unresolved" and not told.get("crowded"), "no solution, and no proof:", a, b)


def is_too_near(problem, a, b, owed=None):
    """Does the pair have the conflict, at the original places? owed: another distance than the one that they have to keep."""
    p, q = (problem.whole(k) for k in ((a, b) if problem.whole(a).area else (b, a)))
    owed = problem.required(a, b) if owed is None else owed
    return plane.interiors_meet(p, q) or (owed > 0 and plane.nearer(p, q, owed))


def limit_of(problem, key):
    return 0.0 if problem.is_barrier(key) else problem.body_limit(problem.block(key))


def is_kept(problem, a, b):
    if problem.is_barrier(a) or problem.is_barrier(b):
        return False
    p, q, d = problem.whole(a), problem.whole(b), Fraction(problem.tolerance) * problem.lattice.unit
    return plane.interiors_meet(p, q) and any(lies_in_grown(x, y, d, problem.tolerance, problem.lattice.unit)
                                              for x, y in ((p, q), (q, p)))


def is_shut(problem, a, b, jumps):
    """Is every relative move within the limits forbidden to the two? With `jumps` also by the rule against jumps, for
    any of their members."""
    limits = [limit_of(problem, k) for k in (a, b)]
    reach = None if None in limits else sum(map(Fraction, limits)) * problem.lattice.unit
    if reach is None and not jumps:
        return False
    near = farthest_near(problem, a, b)
    demand_not_inside(problem, a, b, reach)
    pieces = pieces_between(problem, a, b)
    if jumps:
        demand(not problem.options.allow_jumps, "jumps are allowed")
        pieces += shadows_between(problem, a, b)
    size = near if reach is None else min(-(-reach.numerator // reach.denominator), near if jumps else 1 << 4096)
    return covers(square(-size, -size, size, size), reach, pieces)


def demand_not_inside(problem, a, b, reach):
    """With --contained ignore: fails unless no relative move up to `reach` (None: of any length) takes one of the two features
    into the other."""
    if problem.options.contained == "ignore" and not problem.is_barrier(a) and not problem.is_barrier(b):
        for inner, outer in ((a, b), (b, a)):
            demand(is_never_inside(problem, inner, outer, reach), a, "and", b, "may come to lie in each other")


def is_never_inside(problem, inner, outer, reach):
    """Is there no move up to `reach` after which each side of the outer thing's convex hull, moved outwards by the tolerance,
    has all of the inner thing on its left?"""
    p, q = problem.whole(inner), problem.whole(outer)
    fixed, moved = (hull([corner for edge in outline.edges for corner in edge]) for outline in (q, p))
    beyond = problem.lattice(problem.tolerance) + hair_of(p, q)
    size = farthest_near(problem, inner, outer)
    size = int(size if reach is None else min(size, reach)) + 1
    region = square(-size, -size, size, size)
    for v, w in zip(fixed, fixed[1:] + fixed[:1]):
        x, y = v[1] - w[1], w[0] - v[0]  # to the left
        least = x * v[0] + y * v[1] - root_above(x * x + y * y) * beyond - min(x * c[0] + y * c[1] for c in moved)
        region = clip(region, whole_numbers(x, y, least))
    return not region or (reach is not None and is_beyond(region, reach * reach))


def whole_numbers(*line):
    common = math.lcm(*(Fraction(v).denominator for v in line))
    return tuple(int(v * common) for v in line)


def farthest_near(problem, a, b):
    """A length such that no relative move that is longer along x or y leaves the two too near. A longer move is in a
    shadow if the move of this length in the same direction is."""
    p, q, owed = problem.whole(a).box, problem.whole(b).box, problem.required(a, b)
    return max(max(abs(p[x + 2] - q[x]), abs(p[x] - q[x + 2])) for x in (0, 1)) + owed + 1


def parts_of(problem, key):
    thing = problem.things[key]
    lines = [list(e) for line in thing.lines for e in zip(line, line[1:] or line)]
    return [t for o in thing.outlines if o.box for t in trapezoids(o)] + lines


def pieces_between(problem, a, b):
    owed = problem.required(a, b)
    return [Piece(p, q, owed, False) for p in parts_of(problem, a) for q in parts_of(problem, b)]


def shadows_between(problem, a, b):
    found = []
    if problem.is_barrier(a) or problem.is_barrier(b):
        return found
    for k in problem.block(a):
        for l in problem.block(b):
            for holder, other, swapped in ((k, l, False), (l, k, True)):
                at = problem.lattice.point(problem.anchor(holder))
                if problem.original.get(other, problem.things[other]).holds_place(at):
                    continue
                for part in parts_of(problem, other):
                    found.append(Piece(part, [at], 0, True) if swapped else Piece([at], part, 0, True))
    return found


def covers(region, reach, pieces):
    """Is the part of the region within `reach` of the origin (None: all of it) in the union of the pieces?"""
    todo, steps, last = [region], 0, None
    far = None if reach is None else reach * reach
    while todo:
        part = todo.pop()
        if not part or (far is not None and is_beyond(part, far)):
            continue
        steps += 1
        corners = [corner for corner, _ in part]
        places = [fine_of(corner) for corner in corners]

        def all_in(piece):
            return all(piece.holds(p, c) for p, c in zip(places, corners))
        if last and all_in(last):
            continue
        found = next((p for p in pieces if p is not last and all_in(p)), None)
        if found:
            last = found
            continue
        middle, (a, b, c) = halves(places)
        if steps > MOST_STEPS or (a, b) == (0, 0) or is_free(middle, far, pieces):
            return False
        todo.append(clip(part, (a, b, c)))
        todo.append(clip(part, (-a, -b, -c)))
    return True


def is_free(middle, far, pieces):
    """Is that place, in FINE parts of the lattice, within the limits, and in no piece?"""
    if far is not None and middle[0] ** 2 + middle[1] ** 2 > far * FINE * FINE:
        return False
    return not any(p.holds(middle, (*middle, FINE)) for p in pieces)


def is_beyond(part, far):
    """Is the convex polygon farther from the origin than the root of `far`?"""
    corners = [(Fraction(x, w), Fraction(y, w)) for (x, y, w), _ in part]
    edges = list(zip(corners, corners[1:] + corners[:1]))
    if len(corners) > 2 and all(p[0] * q[1] - p[1] * q[0] >= 0 for p, q in edges):
        return False
    return all(square_from_origin(p, q) > far for p, q in edges)


def square_from_origin(p, q):
    ux, uy = q[0] - p[0], q[1] - p[1]
    whole = ux * ux + uy * uy
    t = 0 if whole == 0 else min(max(-(p[0] * ux + p[1] * uy) / whole, 0), 1)
    return (p[0] + t * ux) ** 2 + (p[1] + t * uy) ** 2
