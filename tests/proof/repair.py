"""Invalid polygons by the even-odd rule, in fractions; corners are rounded to the nearest doubles at the end.

Edges are cut at their intersections. Of coincident pieces an odd number is boundary, since the inside changes across
it. From these pieces rings are followed with the inside on their left. At a point where several pieces meet, a ring
continues with the next edge of the same inside. Straight corners are left out. A polygon whose edges neither cross
nor overlap keeps its rings.
"""
from fractions import Fraction


def side(a, b, c):
    value = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (value > 0) - (value < 0)


def is_between(p, q, at):
    """Is the point, which is on the line of the segment, on the segment?"""
    return min(p[0], q[0]) <= at[0] <= max(p[0], q[0]) and min(p[1], q[1]) <= at[1] <= max(p[1], q[1])


def meetings(e, f):
    """The common points of two edges, or the ends of their common piece; and whether they cross, or share a length."""
    (a, b), (c, d) = e, f
    sides = side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b)
    if sides[0] * sides[1] < 0 and sides[2] * sides[3] < 0:
        ux, uy, vx, vy = b[0] - a[0], b[1] - a[1], d[0] - c[0], d[1] - c[1]
        s = ((c[0] - a[0]) * vy - (c[1] - a[1]) * vx) / (ux * vy - uy * vx)
        return {(a[0] + s * ux, a[1] + s * uy)}, True
    found = {p for p, s in zip((c, d), sides[:2]) if s == 0 and is_between(a, b, p)}
    found |= {p for p, s in zip((a, b), sides[2:]) if s == 0 and is_between(c, d, p)}
    return found, len(found) > 1


def cut(edges):
    """(the pieces of each edge, whether any edges cross or share a length); a sweep over the edges by their least
    x."""
    cuts, open_now, crossing = [{p, q} for p, q in edges], [], False
    for k in sorted(range(len(edges)), key=lambda k: min(edges[k][0][0], edges[k][1][0])):
        e = edges[k]
        start, low, high = min(e[0][0], e[1][0]), min(e[0][1], e[1][1]), max(e[0][1], e[1][1])
        open_now = [m for m in open_now if max(edges[m][0][0], edges[m][1][0]) >= start]
        for m in open_now:
            f = edges[m]
            if max(f[0][1], f[1][1]) < low or min(f[0][1], f[1][1]) > high:
                continue
            found, bad = meetings(e, f)
            cuts[k] |= found
            cuts[m] |= found
            crossing = crossing or bad
        open_now.append(k)
    pieces = []
    for places in cuts:
        line = sorted(places)
        pieces += zip(line, line[1:])
    return pieces, crossing


def is_inside_on_left(boundary, p, q):
    """Is the inside on the left of the piece? By a ray from its midpoint, perpendicular to it."""
    x, y = (p[0] + q[0]) / 2, (p[1] + q[1]) / 2
    wx, wy = p[1] - q[1], q[0] - p[0]
    inside = False
    for a, b in boundary:
        sa, sb = wx * (a[1] - y) - wy * (a[0] - x), wx * (b[1] - y) - wy * (b[0] - x)
        if (sa > 0) != (sb > 0):
            share = sa / (sa - sb)
            inside ^= wx * (a[0] + share * (b[0] - a[0]) - x) + wy * (a[1] + share * (b[1] - a[1]) - y) > 0
    return inside


def turn_rank(back, out):
    """A key that ascends with the clockwise angle from the direction back."""
    cross, dot = back[0] * out[1] - back[1] * out[0], back[0] * out[0] + back[1] * out[1]
    half = 0 if cross < 0 else 1 if cross == 0 and dot < 0 else 2 if cross > 0 else 3
    return half, dot / cross if cross else 0


def directed(boundary):
    """The pieces with the inside on their left."""
    return [(p, q) if is_inside_on_left(boundary, p, q) else (q, p) for p, q in boundary]


def follow(pieces, outside=False):
    """Rings of directed pieces: where several meet, a ring continues with the next edge of the same inside, or of the
    same outside."""
    leaving = {}
    for p, q in pieces:
        leaving.setdefault(p, []).append(q)
    while leaving:
        p = start = min(leaving)
        q = leaving[start][0]
        ring, began = [], q
        while True:
            leaving[p].remove(q)
            if not leaving[p]:
                del leaving[p]
            ring.append(p)
            back = p[0] - q[0], p[1] - q[1]
            ways = [*leaving.get(q, ()), *([began] if q == start else ())]
            pick = max if outside else min
            p, q = q, pick(ways, key=lambda r: turn_rank(back, (r[0] - q[0], r[1] - q[1])))
            if (p, q) == (start, began):
                break
        yield ring


def without_straight(ring):
    return [p for k, p in enumerate(ring) if side(ring[k - 1], p, ring[(k + 1) % len(ring)]) != 0]


def exact_rings(rings):
    """The rings of a polygon in fractions, by the even-odd rule; None if they are its own rings."""
    exact = [[(Fraction(x), Fraction(y)) for x, y in ring] for ring in rings]
    edges = [(ring[k - 1], p) for ring in exact for k, p in enumerate(ring) if ring[k - 1] != p]
    pieces, crossing = cut(edges)
    if not crossing:
        return None
    odd = set()
    for piece in pieces:
        odd ^= {piece}
    return [without_straight(ring) for ring in follow(directed(sorted(odd)))]


def repaired(rings):
    """The rings of a polygon in doubles, by the even-odd rule."""
    found = exact_rings(rings)
    return rings if found is None else [[(float(x), float(y)) for x, y in ring] for ring in found if ring]


def members_of(rings):
    """The same in fractions."""
    found = exact_rings(rings)
    return [[(Fraction(x), Fraction(y)) for x, y in ring] for ring in (rings if found is None else found)]


def twice_area(ring):
    return sum((ring[k - 1][0] * p[1] - ring[k - 1][1] * p[0] for k, p in enumerate(ring)), Fraction(0))


def area_of(rings):
    """The area of a polygon, as a fraction. If its rings neither cross nor share a length, the holes lie in the first
    ring."""
    found = exact_rings(rings)
    if found is not None:
        return sum(map(twice_area, found), Fraction(0)) / 2  # the inside is on their left
    first, *holes = (abs(twice_area([(Fraction(x), Fraction(y)) for x, y in ring])) for ring in rings)
    return (first - sum(holes, Fraction(0))) / 2
