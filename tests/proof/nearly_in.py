"""Does one set lie in another up to a tolerance? That is, in the other grown by a polygon of 16 corners within the disc of that
radius, whose corners are the nearest doubles. First by the distances of edges, between a disc of cos(pi / 16) of it and the
whole one; what lies between the two is asked of that polygon. Integers and fractions alone."""
from fractions import Fraction

import discs
from cover import hull
from exact import plane
from pieces import in_union, trapezoids

SURE = Fraction(98078, 100000)  # less than cos(pi / 16)
HALVINGS = 12
HAIR = Fraction(1, 1 << 20)


def lies_in_grown(a, b, d, tolerance, unit):
    """True, False, or None where rounded corners decide, and b is not convex. d: the tolerance in units of the lattice."""
    told = nearly_in(a, b, d)
    if told is not None or not d:
        return bool(told)
    disc = [tuple(Fraction(v) * unit for v in corner) for corner in discs.inside(tolerance, 16)]
    hair = HAIR + Fraction(max(map(abs, a.box + b.box)), 1 << 50) / d
    parts = trapezoids(a)
    if hair < 1 and all(in_union(t, grown(b, disc, 1 - hair)) for t in parts):
        return True
    if not all(in_union(t, grown(b, disc, 1 + hair)) for t in parts):
        return False
    if len(b.rings) != 1 or sorted(hull(b.rings[0])) != sorted(b.rings[0]):
        return None
    corners = hull([(p[0] + x, p[1] + y) for p in b.rings[0] for x, y in disc])
    rounded = [tuple(Fraction(float(v / unit)) * unit for v in p) for p in corners]
    return all(in_union(t, [outline_of(rounded)]) for t in parts)


def grown(b, disc, share):
    """b, and its edges grown by the disc times that."""
    around = [outline_of(hull([(p[0] + share * x, p[1] + share * y) for p in e for x, y in disc])) for e in b.edges]
    return [b, *around]


def outline_of(corners):
    return plane.Outline([corners])


def nearly_in(a, b, d):
    """True, False, or None where it is not told."""
    if plane.lies_in(a, b):
        return True
    if not d or not plane.corners_lie_in(a, b, d):
        return False
    told = True if no_room_inside(a, b) else None
    for p, q in a.edges:
        along = edge_is_near(p, q, b, d, HALVINGS)
        if along is False:
            return False
        told = told and along
    return told


def no_room_inside(a, b):
    """No hole of b is within a's box: what is beyond b, and in a, comes out at a's edges."""
    boxes = [plane.box_of(ring) for ring in b.rings]
    return not any(box != b.box and a.box[0] <= box[0] and a.box[1] <= box[1] and box[2] <= a.box[2] and box[3] <= a.box[3]
                   for box in boxes)


def edge_is_near(p, q, b, d, halvings):
    """By its middle: no other place of the edge is farther than that by more than half its length."""
    middle = Fraction(p[0] + q[0], 2), Fraction(p[1] + q[1], 2)
    square = Fraction(0)
    if plane.locate(b, middle) < 0:
        square = min((Fraction(n) / m for n, m in (plane.square_to_edge(middle, e)
                                                   for e in plane.near_edges(b, (*middle, *middle), d))), default=None)
        if square is None or square > d * d:
            return False
    half = Fraction((p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2) / 4
    if roots_add_up_to_less(square, half, SURE * d):
        return True
    if not halvings:
        return None
    halves = [edge_is_near(*ends, b, d, halvings - 1) for ends in ((p, middle), (middle, q))]
    return False if False in halves else None if None in halves else True


def roots_add_up_to_less(s, t, most):
    """sqrt(s) + sqrt(t) <= most, exactly."""
    rest = most * most - s - t
    return rest >= 0 and 4 * s * t <= rest * rest
