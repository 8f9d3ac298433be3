"""The corners of the program's discs, from how they are documented (src/shape/standard.c), and asked of the circle.

Corner i of n lies at i / n of a turn, the first on the x axis, to a multiple of 2^-26 of the power of two above the radius;
those of an inside disc all lie in the disc, and for that go inwards by a growing share of the radius until they do.
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
    """To the nearest whole number, halves away from 0."""
    whole = math.floor(abs(value) + 0.5) if abs(value) < 2 ** 52 else abs(value)
    return math.copysign(whole, value)


def inside(radius, n):
    """Doubles."""
    unit = 2.0 ** (math.frexp(radius)[1] - 26)
    give = 0.0
    while True:
        factor = 1 * (1 - give * 2.0 ** -52)
        corners = [tuple(away(radius * factor * v / unit) * unit + 0.0 for v in unit_corner(i, n)) for i in range(n)]
        if all(Fraction(x) ** 2 + Fraction(y) ** 2 <= Fraction(radius) ** 2 for x, y in corners):
            return corners
        give = 2 * give if give else 2.0 ** 24
