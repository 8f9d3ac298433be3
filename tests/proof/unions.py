"""The union of polygonal sets, exactly: its polygons in fractions.

Edges are cut at their intersections; a piece is boundary if the union lies on exactly one side of it. The boundary is
followed with the inside on the left. A polygon is one connected component of the interior, and has one ring for each
component of its outside.
"""
from fractions import Fraction

from exact import plane
from repair import cut, follow, twice_area, without_straight


def union_outline(outlines, lines=()):
    """One outline, with integers for the corners that have them."""
    rings = [ring for rings in union_polygons(outlines) for ring in rings]
    return plane.Outline([[tuple(int(v) if v.denominator == 1 else v for v in p) for p in ring] for ring in rings], lines)


def union_polygons(outlines):
    """Lists of rings, for each polygon the outer one first."""
    rings = list(follow(boundary(outlines)))  # each list is of one component
    outer = [ring for ring in rings if twice_area(ring) > 0]
    of = {id(ring): [ring] for ring in outer}
    for ring in rings:
        if twice_area(ring) < 0:
            middle = (ring[0][0] + ring[1][0]) / 2, (ring[0][1] + ring[1][1]) / 2
            holders = [r for r in outer if plane.locate(plane.Outline([r]), middle) > 0]
            of[id(min(holders, key=twice_area))].append(ring)
    return [along_the_outside(of[id(ring)]) for ring in outer]


def along_the_outside(rings):
    """The boundary of one component, without straight corners."""
    edges = [(ring[k - 1], p) for ring in rings for k, p in enumerate(ring)]
    return sorted(map(without_straight, follow(edges, outside=True)), key=twice_area, reverse=True)


def boundary(outlines):
    """Pieces of edges, each once, with the union on the left and not on the right."""
    edges = [tuple((Fraction(x), Fraction(y)) for x, y in e) for o in outlines for e in o.edges]
    found = []
    for p, q in sorted({(min(e), max(e)) for e in cut(edges)[0]}):
        middle, along = ((p[0] + q[0]) / 2, (p[1] + q[1]) / 2), (q[0] - p[0], q[1] - p[1])
        near = [o for o in outlines if plane.boxes_near(o.box, (*middle, *middle))]
        left, right = (any(plane.on_its_left(o, middle, u) for o in near) for u in (along, (-along[0], -along[1])))
        if left != right:
            found.append((p, q) if left else (q, p))
    return found
