"""Convex pieces of polygonal sets, and whether one lies in a union. Integers or fractions; nothing is rounded."""
from fractions import Fraction

from exact import plane


def in_polygon(corners, outline):
    """Does a convex polygon with area lie in a polygon? It does if no edge crosses it, and one of its points is
    inside."""
    box = plane.box_of(corners)
    sides = list(zip(corners, corners[1:] + corners[:1]))
    for edge in plane.near_edges(outline, box):
        if goes_through(edge, sides):
            return False
    n = len(corners)
    middle = sum(p[0] for p in corners), sum(p[1] for p in corners)
    return plane.locate(outline.scaled(n), middle) > 0


def in_union(corners, outlines):
    """Does a convex polygon with area lie in the union of polygons? It is cut along edges that cross it, until none
    does."""
    box, sides = plane.box_of(corners), list(zip(corners, corners[1:] + corners[:1]))
    outlines = [o for o in outlines if o.box and plane.boxes_near(o.box, box)]
    if any(in_polygon(corners, o) for o in outlines):
        return True
    for edge in (e for o in outlines for e in plane.near_edges(o, box)):
        if goes_through(edge, sides):
            return in_union(left_of(edge, sides), outlines) and in_union(left_of(edge[::-1], sides), outlines)
    return False


def left_of(edge, sides):
    """The part of a convex polygon on the left of the edge's line, which passes through it."""
    (ax, ay), (bx, by) = edge
    found = []
    for p, q in sides:
        s, t = ((bx - ax) * (v[1] - ay) - (by - ay) * (v[0] - ax) for v in (p, q))
        if s >= 0:
            found.append(p)
        if s * t < 0:
            share = Fraction(s) / Fraction(s - t)
            found.append((p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1])))
    return found


def goes_through(edge, sides):
    """Does the segment meet the open convex polygon with these sides?"""
    (ax, ay), (bx, by) = edge
    low, high = Fraction(0), Fraction(1)
    for (px, py), (qx, qy) in sides:
        ex, ey = qx - px, qy - py
        at = ex * (ay - py) - ey * (ax - px)
        slope = ex * (by - ay) - ey * (bx - ax)
        if slope == 0:
            if at <= 0:
                return False
        elif slope > 0:
            low = max(low, Fraction(-at) / Fraction(slope))
        else:
            high = min(high, Fraction(-at) / Fraction(slope))
    return low < high


def trapezoids(outline):
    """Convex polygons, counter-clockwise, whose union is the set that the outline's rings enclose: by slabs between
    corners."""
    levels = sorted({p[1] for e in outline.edges for p in e} | {at[1] for at in crossings(outline.edges)})
    for low, high in zip(levels, levels[1:]):
        across = [e if e[0][1] < e[1][1] else e[::-1] for e in outline.edges
                  if min(e[0][1], e[1][1]) <= low and max(e[0][1], e[1][1]) >= high]
        across = sorted((at_height(e, low) + at_height(e, high), at_height(e, low), at_height(e, high)) for e in across)
        for (_, a, d), (_, b, c) in zip(across[::2], across[1::2]):
            corners = [(a, low), (b, low), (c, high), (d, high)]
            corners = [p for k, p in enumerate(corners) if p != corners[k - 1]]
            if len(corners) > 2:
                yield corners


def at_height(e, y):
    (ax, ay), (bx, by) = e
    return ax + Fraction((bx - ax) * (y - ay)) / Fraction(by - ay)


def crossings(edges):
    for i, e in enumerate(edges):
        box = plane.edge_box(e)
        for f in edges[:i]:
            if plane.boxes_near(box, plane.edge_box(f)) and plane.cross_properly(e, f):
                yield plane.crossing(e, f)
