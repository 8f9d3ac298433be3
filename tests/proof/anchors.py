"""The anchor of a polygonal set, by the rule as it is documented (sunder_shape_anchor() in src/sunder.h): a function of the set,
however its rings are written.

U is the interior of the union of the members. On the line half way between the lowest and the highest place of U the
middle of its widest interval, the first of equal ones; where the line meets none of U, the same of what lies below it.
"""
import math
from fractions import Fraction


def anchor(members):
    """members: lists of rings, of any exact numbers. Doubles; None of what has no area."""
    found = exact_anchor(members)
    return found and tuple(map(float, found))


def exact_anchor(members):
    edges = [(k, *((p, q) if p[1] < q[1] else (q, p))) for k, rings in enumerate(members) for ring in rings
             for p, q in zip(ring, ring[1:] + ring[:1]) if p[1] != q[1]]
    if not edges:
        return None
    low, high = min(e[1][1] for e in edges), max(e[2][1] for e in edges)
    while True:
        height = Fraction(low + high) / 2
        found = intervals(edges, height)
        if found:
            width, left, right = max((b - a, -a, b) for a, b in found)
            return (right - left) / 2, height
        high = max(e[2][1] for e in edges if e[2][1] <= height)  # U ends below the line, or at it


def intervals(edges, height):
    """Of U on the line."""
    gaps = sorted(gaps_beside(edges, height, True) + gaps_beside(edges, height, False))
    found, reached = [], gaps[0][1]
    for a, b in gaps[1:]:
        if a > reached:
            found.append((reached, a))
        reached = max(reached, b)
    return found


def gaps_beside(edges, height, above):
    """Closed pieces of the line next to which, above it or below, nothing is covered; the first begins at -inf, the last ends at
    inf. Edges that coincide on that side bound none: walls that members share are inside."""
    rays = {}
    for k, p, q in edges:
        if (p[1] <= height < q[1]) if above else (p[1] < height <= q[1]):
            slope = Fraction(q[0] - p[0]) / Fraction(q[1] - p[1])
            at = p[0] + slope * (height - p[1])
            rays.setdefault((at, slope if above else -slope), []).append(k)
    inside, found, before = set(), [], -math.inf
    for (at, _), crossed in sorted(rays.items()):
        if not inside:
            found.append((before, at))
        for k in crossed:
            inside ^= {k}
        before = at
    found.append((before, math.inf))
    return found
