"""The corners of the program's discs, as documented in src/shape/standard.c, and compared with the circle.

Corner i of n lies at i / n of a turn, the first on the x axis, rounded to a multiple of 2^-26 of the power of two
above the radius. Corners of an inside disc lie in the disc, and on the axes at exactly the radius; a corner outside
moves inwards by a growing share of the radius until it lies in the disc. For the other kind the lines of edges lie
outside the disc, and all corners move outwards together.
"""
import math
from fractions import Fraction


def unit_corner(i, n):
    octant, rest = divmod(8 * i, n)
    if octant & 1:
        rest = n - rest
    angle = math.pi / 4 * rest / n
    c = math.cos(angle)
    s = c if rest == n else math.sin(angle)
    x, y = (c, s) if octant in (0, 3, 4, 7) else (s, c)
    return -x if 2 <= octant < 6 else x, -y if octant >= 4 else y


def away(value):
    """To the nearest integer, halves away from 0."""
    whole = math.floor(abs(value) + 0.5) if abs(value) < 2 ** 52 else abs(value)
    return math.copysign(whole, value)


def unit_of(radius, n):
    return 2.0 ** (math.frexp(radius)[1] - 26) if n <= 256 and 2.0 ** -900 <= radius <= 2.0 ** 900 else 0


def corner_at(i, n, radius, factor, unit):
    p = tuple(radius * factor * v + 0.0 for v in unit_corner(i, n))
    return tuple(away(v / unit) * unit + 0.0 for v in p) if unit else p


def shares(n):
    """The successive shares by which corners are moved, in units of 2^-52."""
    give = 0.0
    while give < 2.0 ** 40:
        yield give * 2.0 ** -52
        give = 2 * give if give else (2.0 ** 24 if n <= 256 else 1.0)


def inside(radius, n):
    """The corners of an inside disc, as doubles."""
    def corner(i):
        if 0 in unit_corner(i, n):
            return tuple(radius * v + 0.0 for v in unit_corner(i, n))
        tries = (corner_at(i, n, radius, 1 - give, unit_of(radius, n)) for give in shares(n))
        return next(p for p in tries if sum(Fraction(v) ** 2 for v in p) <= Fraction(radius) ** 2)
    return [corner(i) for i in range(n)]


def outside(radius, n):
    """Is no edge's line nearer to the centre than the radius?"""
    ideal = 1 / math.cos(math.pi / n)
    tries = ([corner_at(i, n, radius, ideal * (1 + give), unit_of(radius, n)) for i in range(n)] for give in shares(n))
    return next(corners for corners in tries if is_outside([tuple(map(Fraction, p)) for p in corners], Fraction(radius) ** 2))


def is_outside(corners, square):
    for (px, py), (qx, qy) in zip(corners, corners[1:] + corners[:1]):
        cross = px * qy - py * qx
        if cross <= 0 or cross * cross < square * ((qx - px) ** 2 + (qy - py) ** 2):
            return False
    return True


COSINES = (1.0, 0.9238, 0.7071, 0.3826, 0.0)  # sines of multiples of pi / 8, rounded down


def within(tolerance):
    """The polygon by which a feature is dilated to test whether another lies in it up to the tolerance
    (src/displacement/layer/grown_shape.c): its corners are multiples of a 64th of the power of two above the
    tolerance, rounded towards the centre."""
    unit = math.ldexp(1.0, math.frexp(tolerance)[1] - 6)
    steps = [math.floor(tolerance / unit * c) * unit for c in COSINES]
    quarter = list(zip(steps, steps[::-1]))[:4]
    return quarter + [(-y, x) for x, y in quarter] + [(-x, -y) for x, y in quarter] + [(y, -x) for x, y in quarter]
