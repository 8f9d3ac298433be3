"""Does one set lie in another up to a tolerance? This means: in the other one dilated by a polygon of 16 corners
within the disc of that radius (discs.within()), with the corners of the sum rounded to the nearest doubles. First
distances of edges are compared with a disc inside this polygon and with the whole disc. Only if they lie between the
two is the sum computed. All arithmetic is in integers and fractions."""
from fractions import Fraction

import discs
from cover import hull
from exact import plane
from repair import repaired
from unions import union_outline, union_polygons

SURE = Fraction(93, 100)  # share of the radius: a disc of that radius lies in the polygon
HALVINGS = 6


def lies_in_grown(a, b, d, tolerance, unit):
    """d: the tolerance in units of the lattice."""
    if not d:
        return plane.lies_in(a, b)
    told = nearly_in(a, b, d, hair_of(a, b))
    return plane.lies_in(a, grown(b, tolerance, unit)) if told is None else told


def hair_of(a, b):
    """More than rounding moves a corner."""
    return Fraction(max(map(abs, a.box + b.box)), 1 << 50)


def grown(b, tolerance, unit):
    """The sum of b and the polygon, in doubles, and by the even-odd rule if rounding makes it invalid."""
    disc = [tuple(Fraction(v) * unit for v in corner) for corner in discs.within(tolerance)]
    around = [plane.Outline([hull([(p[0] + x, p[1] + y) for p in e for x, y in disc])]) for e in b.edges]
    outlines = []
    for rings in union_polygons([b, *around]):
        rounded = repaired([[tuple(float(v / unit) for v in p) for p in ring] for ring in rings])
        outlines.append(plane.Outline([[tuple(Fraction(v) * unit for v in p) for p in ring] for ring in rounded]))
    return union_outline([o for o in outlines if o.box])


def nearly_in(a, b, d, hair):
    """True, False, or None if it cannot be decided. hair: see hair_of()."""
    if plane.lies_in(a, b):
        return True
    if not plane.corners_lie_in(a, b, d + hair):
        return False
    told = True if no_room_inside(a, b) and hair < d / 1000 else None
    for p, q in a.edges:
        along = edge_is_near(p, q, b, d + hair, d, HALVINGS)
        if along is False:
            return False
        told = told and along
    return told


def no_room_inside(a, b):
    """No hole of b is within a's box: so if a part of a is outside b, it crosses an edge of b."""
    boxes = [plane.box_of(ring) for ring in b.rings]
    return not any(box != b.box and a.box[0] <= box[0] and a.box[1] <= box[1] and box[2] <= a.box[2] and box[3] <= a.box[3]
                   for box in boxes)


def edge_is_near(p, q, b, most, d, halvings):
    """Tests the midpoint of the edge: no other place of it is farther away by more than half its length. most: an
    edge farther than this is out."""
    middle = Fraction(p[0] + q[0], 2), Fraction(p[1] + q[1], 2)
    square = Fraction(0)
    if plane.locate(b, middle) < 0:
        square = min((Fraction(n) / m for n, m in (plane.square_to_edge(middle, e)
                                                   for e in plane.near_edges(b, (*middle, *middle), most))), default=None)
        if square is None or square > most * most:
            return False
    half = Fraction((p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2) / 4
    if roots_add_up_to_less(square, half, SURE * d):
        return True
    if not halvings:
        return None
    halves = [edge_is_near(*ends, b, most, d, halvings - 1) for ends in ((p, middle), (middle, q))]
    return False if False in halves else None if None in halves else True


def roots_add_up_to_less(s, t, most):
    """Is sqrt(s) + sqrt(t) <= most? Exact."""
    rest = most * most - s - t
    return rest >= 0 and 4 * s * t <= rest * rest
