"""Does one set lie in another up to a tolerance? This means: in the other one dilated by a polygon of 16 corners
within the disc of that radius (discs.within()), with the corners of the sum rounded to the nearest doubles. First
distances of edges are compared with a disc inside this polygon and with the whole disc. Only if they lie between the
two is the sum computed. All arithmetic is in integers and fractions."""
from fractions import Fraction

import discs
from cover import hull
from exact import plane
from pieces import in_polygon
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
    """The sum of b and the polygon, one outline on the lattice."""
    outlines = [plane.Outline([[tuple(Fraction(v) * unit for v in p) for p in ring] for ring in rings])
                for rings in grown_polygons(b, discs.within(tolerance), unit)]
    return union_outline([o for o in outlines if o.box])


def grown_polygons(b, corners, unit):
    """The polygons of the sum of b and a convex polygon, in doubles, and by the even-odd rule if rounding makes one invalid."""
    disc = [tuple(Fraction(v) * unit for v in corner) for corner in corners]
    around = [plane.Outline([hull([(p[0] + x, p[1] + y) for p in run for x, y in disc])])
              for ring in b.rings for run in runs_within(ring + ring[:1], b)]
    return [repaired([[tuple(float(v / unit) for v in p) for p in ring] for ring in rings]) for rings in union_polygons([b, *around])]


def runs_within(places, b):
    """Splits a part of a ring of b into edges and longer runs, so that the convex hull of each longer run lies in b. The sum of b and a
    polygon is then the union of b and the sums of these hulls."""
    corners = hull(places)
    if len(places) == 2 or len(corners) > 2 and in_polygon(corners, b):
        return [corners]
    middle = len(places) // 2
    return runs_within(places[:middle + 1], b) + runs_within(places[middle:], b)


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
