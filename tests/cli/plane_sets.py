"""Polygonal sets in exact arithmetic, by brute force: lists of polygons, each a list of rings, each a list of (x, y).

Members may overlap; a list stands for their union. Numbers are integers or fractions. Questions about areas are
answered by sample points, one in each trapezoid between neighbouring vertical lines through all corners and
crossings.
"""
from fractions import Fraction as F


def edges(polygons):
    return [(ring[i - 1], ring[i]) for polygon in polygons for ring in polygon for i in range(len(ring))]


def side(a, b, c):
    value = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (value > 0) - (value < 0)


def on_segment(a, b, c):
    return (side(a, b, c) == 0 and min(a[0], b[0]) <= c[0] <= max(a[0], b[0])
            and min(a[1], b[1]) <= c[1] <= max(a[1], b[1]))


def boxes_apart(a, b, c, d):
    return any(max(a[k], b[k]) < min(c[k], d[k]) or max(c[k], d[k]) < min(a[k], b[k]) for k in (0, 1))


def cross(a, b, c, d):
    """Do the segments cross in a point that is inside both?"""
    return side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0


def meet(a, b, c, d):
    return not boxes_apart(a, b, c, d) and (
        cross(a, b, c, d) or on_segment(a, b, c) or on_segment(a, b, d) or on_segment(c, d, a) or on_segment(c, d, b))


def enclosed(polygon, at):
    """Is the point inside, by the even-odd rule? It may not be on the boundary."""
    inside = False
    for ring in polygon:
        for i in range(len(ring)):
            a, b = ring[i - 1], ring[i]
            if (a[1] > at[1]) != (b[1] > at[1]) and (side(a, b, at) > 0) == (b[1] > a[1]):
                inside = not inside
    return inside


def in_open(polygons, at):
    return any(enclosed(polygon, at) for polygon in polygons)


def in_closed(polygons, at):
    return in_open(polygons, at) or any(on_segment(a, b, at) for a, b in edges(polygons))


def moved(polygons, by, sign=1):
    return [[[(sign * x + by[0], sign * y + by[1]) for x, y in ring] for ring in polygon] for polygon in polygons]


def samples(*sets):
    """A point inside each cell of the arrangement of the sides of all sets."""
    sides = [s for polygons in sets for s in edges(polygons)]
    xs = {p[0] for s in sides for p in s}
    for i, (a, b) in enumerate(sides):
        for c, d in sides[:i]:
            if not boxes_apart(a, b, c, d) and cross(a, b, c, d):
                den = (b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0])
                t = F((c[0] - a[0]) * (d[1] - c[1]) - (c[1] - a[1]) * (d[0] - c[0])) / den
                xs.add(a[0] + t * (b[0] - a[0]))
    xs = sorted(xs)
    for x0, x1 in zip(xs, xs[1:]):
        x = F(x0 + x1) / 2
        ys = sorted({a[1] + (x - a[0]) * (b[1] - a[1]) / (b[0] - a[0])
                     for a, b in sides if min(a[0], b[0]) < x < max(a[0], b[0])})
        for y0, y1 in zip(ys, ys[1:]):
            yield x, (y0 + y1) / 2


def within(inner, outer):
    """Is the closed set `inner` a subset of the closed set `outer`?"""
    return all(in_open(outer, at) for at in samples(inner, outer) if in_open(inner, at))


def overlap(p, q):
    """Do the interiors meet?"""
    return any(in_open(p, at) and in_open(q, at) for at in samples(p, q))


def touch(p, q, segments=(), points=()):
    """Does the closed set p meet the closed set q, or one of the segments or points?"""
    others = edges(q) + list(segments)
    return (any(meet(a, b, c, d) for a, b in edges(p) for c, d in others)
            or any(in_closed(p, at) for at in points) or any(in_closed(p, s[0]) for s in segments)
            or any(in_closed(q, polygon[0][0]) for polygon in p if q)
            or any(in_closed(p, polygon[0][0]) for polygon in q))


def square_of_distance(at, a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    t = max(F(0), min(F(1), ((at[0] - a[0]) * dx + (at[1] - a[1]) * dy) / F(dx * dx + dy * dy)))
    x, y = a[0] + t * dx - at[0], a[1] + t * dy - at[1]
    return x * x + y * y


def fault(polygons):
    """Returns why this is not a valid multipolygon of Simple Features, or None."""
    rings = [ring for polygon in polygons for ring in polygon]
    sides = [(r, i, ring[i], ring[(i + 1) % len(ring)]) for r, ring in enumerate(rings) for i in range(len(ring))]
    for k, (r, i, a, b) in enumerate(sides):
        for q, j, c, d in sides[:k]:
            if boxes_apart(a, b, c, d):
                continue
            if cross(a, b, c, d):
                return "sides cross"
            if side(a, b, c) == 0 and side(a, b, d) == 0 and len(
                    {p for p in (a, b, c, d) if on_segment(a, b, p) and on_segment(c, d, p)}) > 1:
                return "sides share a piece"
            if r == q and (i - j) % len(rings[r]) not in (1, len(rings[r]) - 1) and meet(a, b, c, d):
                return "a ring meets itself"
    for at in samples(polygons):
        if sum(enclosed(polygon, at) for polygon in polygons) > 1:
            return "members overlap"
        for outer, *holes in polygons:
            if sum(enclosed([hole], at) for hole in holes) > (1 if enclosed([outer], at) else 0):
                return "a hole lies outside, or in another"
    return None
