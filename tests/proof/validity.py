"""The features that --invalid skip leaves out: those with a polygon whose rings cross, share a length, or have holes
outside the first ring, and those with a coordinate that is not finite."""
import math
from fractions import Fraction

from exact import plane
from form import NotRead
from repair import exact_rings, twice_area


def leave_out_broken(layer, policy):
    """A feature without polygons counts as skipped."""
    for fid, (attributes, polygons, lines) in layer.features.items():
        finite = all(math.isfinite(v) for rings in polygons for ring in rings for p in ring for v in p)
        if not finite and policy != "skip":
            raise NotRead(f"{fid} has a coordinate that is no finite number")
        if policy == "skip" and not (finite and all(is_valid(fid, rings) for rings in polygons)):
            layer.features[fid] = attributes, [], lines


def is_valid(fid, rings):
    if exact_rings(rings) is not None:
        return False
    exact = [[tuple(map(Fraction, p)) for p in ring] for ring in rings]
    if not all(map(twice_area, exact)):
        raise NotRead(f"whether {fid}, with a ring around nothing, is valid is not decided here")
    outer, *holes = (plane.Outline([ring]) for ring in exact)
    return (all(plane.lies_in(hole, outer) for hole in holes) and
            not any(plane.interiors_meet(p, q) for k, p in enumerate(holes) for q in holes[:k]))
