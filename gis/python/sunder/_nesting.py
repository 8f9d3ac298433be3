"""No-fit polygons of many pairs of rotated parts in one call."""
import math
from fractions import Fraction

from sunder import _sunder
from sunder._geometry import shapes
from sunder._sums import Sum


def rotation(degrees, tolerance=1e-6):
    """An exact rational rotation by nearly this angle: integers (cosine, sine, scale).

    cosine ** 2 + sine ** 2 == scale ** 2, and the angle differs by at most `tolerance` radians. Multiples of 90 degrees
    are exact, with scale 1.

    >>> rotation(90), rotation(-180), rotation(30, 0.01)
    ((0, 1, 1), (-1, 0, 1), (56, 33, 65))
    """
    quarters = round(degrees / 90)
    rest = math.radians(degrees - 90 * quarters)
    if not math.isfinite(rest):
        raise ValueError(f"degrees: {degrees} is not finite")
    # The tangent t of half of the angle is rational: (1 - t^2, 2 t, 1 + t^2), and an error e of t turns by 2 e at most.
    tangent, limit = Fraction(math.tan(rest / 2)), 1
    half = tangent.limit_denominator(limit)
    while abs(half - tangent) > tolerance / 2:
        limit += max(1, limit // 8)
        if limit > 5000:
            raise ValueError(f"tolerance: {tolerance} is too small for integers of 26 bits")
        half = tangent.limit_denominator(limit)
    q, p = half.denominator, half.numerator
    c, s, scale = q * q - p * p, 2 * p * q, q * q + p * p
    common = math.gcd(c, s, scale)
    c, s, scale = c // common, s // common, scale // common
    for _ in range(quarters % 4):
        c, s = -s, c
    return c, s, scale


def no_fit_polygons(parts, pairs, rotations=((1, 0, 1),), *, exact=False, threads=1, invalid="repair", progress=None):
    """The no-fit polygons of many pairs of rotated parts: `no_fit_polygon` in one call.

    Args:
        parts: a sequence of polygons.
        pairs: a sequence of (fixed, moving) or (fixed, moving, fixed rotation, moving rotation): numbers of parts and
            of rotations; rotation 0 unless said.
        rotations: each three numbers (cosine, sine, scale): (x, y) becomes ((cosine x - sine y) / scale, (sine x +
            cosine y) / scale). Integers with cosine ** 2 + sine ** 2 == scale ** 2 (`rotation`) are exact. Other
            numbers are taken as they are; the copies are rounded to doubles then, and these are fitted exactly.
        exact: coordinates are `fractions.Fraction`.
        threads: how many threads work; the result is the same for every number.
    Returns: a list with a `Sum` for each pair. Pairs with equal parts and rotations have the same object. `Sum.rounded`
        is True if a copy had to be rounded.
    Raises: ValueError.

    >>> slot = [(0, 0), (6, 0), (6, 3), (4, 3), (4, 1), (2, 1), (2, 3), (0, 3)]
    >>> key = [(0, 0), (2, 0), (2, 2), (0, 2)]
    >>> pairs, turns = [(0, 1), (0, 2), (0, 1, 1, 1)], [(1, 0, 1), (3, 4, 5)]
    >>> found = no_fit_polygons([slot, key, key], pairs, turns, exact=True)
    >>> found[0] is found[1], found[0].degenerate_segments
    (True, [((Fraction(2, 1), Fraction(1, 1)), (Fraction(2, 1), Fraction(3, 1)))])
    >>> found[2].area == found[0].area, found[2].degenerate_segments
    (True, [((Fraction(-6, 5), Fraction(17, 5)), (Fraction(2, 5), Fraction(11, 5)))])
    """
    flat = []
    for k, pair in enumerate(pairs):
        pair = tuple(pair)
        if len(pair) not in (2, 4):
            raise ValueError(f"pairs: pair {k} has {len(pair)} numbers; two or four are needed")
        flat.extend(pair if len(pair) == 4 else (*pair, 0, 0))
    turns = []
    for k, one in enumerate(rotations):
        one = tuple(one)
        if len(one) != 3:
            raise ValueError(f"rotations: rotation {k} has {len(one)} numbers; three are needed")
        turns.extend(map(float, one))
    read = shapes(parts, "part", invalid)
    made, number = _sunder.nofit_batch(read, turns, flat, threads, progress)
    like = () if isinstance(parts, _sunder.Shapes) else list(parts)[:1]
    sums = [Sum(one, like, exact, int(scale), not whole) for one, scale, whole in made]
    return [sums[k] for k in number]
