"""Does one set lie in another up to a tolerance? That is, in the other grown by a polygon of 16 corners within the disc of that
radius: between a disc of cos(pi / 16) of it and the whole one. What lies between the two is not told."""
import math
import os
import sys
from fractions import Fraction

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
import exact_plane as plane  # noqa: E402

SURE = math.cos(math.pi / 16) * (1 - 1e-9)  # and what doubles may be off by here
HALVINGS = 12


def nearly_in(a, b, d):
    """True, False, or None where it is not told. Integers; only how near what is near is reckoned in doubles, with a margin."""
    if plane.lies_in(a, b):
        return True
    if not plane.corners_lie_in(a, b, d):
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
    square = 0
    if plane.locate(b, middle) < 0:
        square = min((Fraction(n, 1) / m for n, m in (plane.square_to_edge(middle, e)
                                                      for e in plane.near_edges(b, (*middle, *middle), d))), default=None)
        if square is None or square > d * d:
            return False
    if math.sqrt(square) + math.dist(p, q) / 2 <= SURE * d:
        return True
    if not halvings:
        return None
    halves = [edge_is_near(*ends, b, d, halvings - 1) for ends in ((p, middle), (middle, q))]
    return False if False in halves else None if None in halves else True
