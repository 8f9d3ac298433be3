"""The area that a body occupies on a grid, in integers: the integrals of the nodes' hat functions (1 at the node, 0
at all others, bilinear between) over the union of its members, dilated by a polygon of 32 corners in the disc of half
the gap.

The squares are swept column by column. In an interval of x without ends and crossings of edges, and without crossings
of edges with rows, the union consists of trapezoids. The borders of these intervals and the corners of trapezoids are
rounded to the lattice of integers, so that the trapezoids lie within the union; the loss is counted, and has to be
less than one mass.
"""
import math
from collections import defaultdict
from fractions import Fraction

from exact import plane
from cover import hull
from form import demand

MASS = 20         # masses are integers in units of 2^-20 squares
FINE = 40         # the side of a square has at least 2^40 units
MOST_SPAN = 4096  # a body that spans more squares is not computed, and pays nothing


class Lattice:
    """A unit for a problem and a grid: the coordinates of the problem, half of the gap, and the side are multiples of
    it."""

    def __init__(self, problem, side, gap):
        own = problem.lattice
        exponent = side.numerator.bit_length() - side.denominator.bit_length()
        self.shift = max(1, FINE - exponent - own.k)
        self.side = 1 << (exponent + own.k + self.shift)
        self.disc = polygon_in_disc(own(gap) << (self.shift - 1))

    def ring(self, corners):
        return [(x << self.shift, y << self.shift) for x, y in corners]


def polygon_in_disc(radius):
    """32 corners, none farther from the centre than the radius; no corners if it is 0."""
    found = []
    for k in range(32 if radius else 0):
        turn = math.pi * k / 16
        x, y = (int(Fraction(f(turn)) * radius * (1 - Fraction(1, 1 << 50))) for f in (math.cos, math.sin))
        demand(x * x + y * y <= radius * radius, "a corner outside of the disc")
        found.append((x, y))
    return found


def added(points, disc):
    return hull([(x + dx, y + dy) for x, y in points for dx, dy in disc])


def sides_of(ring):
    return list(zip(ring, ring[1:] + ring[:1]))


def parts_of(polygons, lattice):
    """Lists of edges. The area that any list encloses by the even-odd rule is occupied."""
    for polygon in polygons:
        rings = [lattice.ring(r) for r in polygon]
        edges = [e for r in rings for e in sides_of(r)]
        if not lattice.disc:
            yield edges
        elif len(rings) == 1 and sorted(hull(rings[0])) == sorted(rings[0]):
            yield sides_of(added(rings[0], lattice.disc))
        else:
            yield edges
            for edge in edges:
                yield sides_of(added(edge, lattice.disc))


def in_squares(polygons, lattice):
    """Returns {(column, row): 24 times the integrals of 1, x, y, x y over the occupied part of the square, with (x, y)
    relative to it}, or None if the squares span too much."""
    edges = []  # edges from left to right, with the number of their part
    for k, part in enumerate(parts_of(polygons, lattice)):
        edges += [(*min(p, q), *max(p, q), k) for p, q in part if p[0] != q[0]]
    found, side = defaultdict(lambda: [0, 0, 0, 0]), lattice.side
    if not edges:
        return found
    left, right = min(e[0] for e in edges), max(e[2] for e in edges)
    low, high = (f(f(e[1], e[3]) for e in edges) for f in (min, max))
    if max(right - left, high - low) > MOST_SPAN * side:
        return None
    for column in range(left // side, -(-right // side)):
        at = column * side
        mine = [e for e in edges if e[0] < at + side and e[2] > at]
        lost, cuts = 0, places_between(mine, at, side)
        for a, b in zip(cuts, cuts[1:]):
            lost += 1 if b - a == 1 else take_slab(mine, a, b, column, side, found)
        demand(lost << MASS < side, "a body of too many edges for its grid")
    return found


def height(edge, x):
    """y of the edge at x, as (numerator, denominator)."""
    x0, y0, x1, y1 = edge[:4]
    return y0 * (x1 - x0) + (x - x0) * (y1 - y0), x1 - x0


def places_between(edges, left, side):
    """The values of x between which, and from left to left + side, no edge ends, meets a row, or crosses another. A
    value that is not an integer is replaced by the integers below and above."""
    right, spans = left + side, []
    cuts = {left, right} | {x for e in edges for x in (e[0], e[2]) if left < x < right}

    def cut(n, d, a, b):
        x = n // d
        if a <= x and x * d + d * (x * d != n) <= b * d:
            cuts.update((x, x + (x * d != n)))

    for e in edges:
        a, b = max(e[0], left), min(e[2], right)
        ends = [n // d for n, d in (height(e, a), height(e, b))]
        low, high = min(ends), max(ends) + 1
        for row in range(low // side, high // side + 1):
            if e[1] != e[3]:
                n, d = e[0] * (e[3] - e[1]) + (row * side - e[1]) * (e[2] - e[0]), e[3] - e[1]
                cut(*((n, d) if d > 0 else (-n, -d)), a, b)
        spans.append((low, high, a, b, e))
    spans.sort(key=lambda s: s[:2])
    for k, (_, high, a, b, e) in enumerate(spans):
        ex, ey = e[2] - e[0], e[3] - e[1]
        for low, _, c, d, f in spans[k + 1:]:
            if low > high:
                break
            fx, fy = f[2] - f[0], f[3] - f[1]
            across = ex * fy - ey * fx
            if across and a < d and c < b:
                n = e[0] * across + ex * ((f[0] - e[0]) * fy - (f[1] - e[1]) * fx)
                cut(*((n, across) if across > 0 else (-n, -across)), max(a, c), min(b, d))
    return sorted(cuts)


def take_slab(edges, a, b, column, side, found):
    """Adds the part of the union between a and b, where edges do not cross. Rounding may lose strips a unit wide."""
    active = [e for e in edges if e[0] <= a and e[2] >= b]
    active.sort(key=lambda e: Fraction(*height((2 * e[0], 2 * e[1], 2 * e[2], 2 * e[3]), a + b)))
    inside, below, lost = set(), None, 0
    for e in active:
        before = bool(inside)
        inside ^= {e[4]}
        if inside and not before:
            below = [-(-n // d) for n, d in (height(e, a), height(e, b))]
        elif before and not inside:
            above = [n // d for n, d in (height(e, a), height(e, b))]
            lost += 2
            if sum(above) > sum(below):
                take(column, side, a - column * side, b - column * side, below, above, found)
    demand(not inside, "a ring that is not closed")
    return lost


def take(column, side, a, b, below, above, found):
    """A trapezoid whose lower and upper sides each lie in one row."""
    first, last = sum(below) // (2 * side), sum(above) // (2 * side)
    squares = (b * b - a * a) * side
    whole = 24 * (b - a) * side, 12 * squares, 12 * (b - a) * side * side, 6 * squares * side
    for row in range(first, last):
        add(found[column, row], whole, 1)
    if sum(above) > 2 * last * side:
        add(found[column, last], under(a, b, *(y - last * side for y in above)), 1)
    add(found[column, first], under(a, b, *(y - first * side for y in below)), -1)


def add(to, what, sign):
    for k in range(4):
        to[k] += sign * what[k]


def under(a, b, p, q):
    """24 times the integrals of 1, x, y, x y from 0 up to the segment from (a, p) to (b, q)."""
    width = b - a
    return (12 * width * (p + q), 4 * width * (a * (2 * p + q) + b * (p + 2 * q)), 4 * width * (p * p + p * q + q * q),
            width * (a * (3 * p * p + 2 * p * q + q * q) + b * (p * p + 2 * p * q + 3 * q * q)))


def masses(squares, lattice):
    """Two tables, as lists of rows with (column, row) of the first: for nodes the integrals of their hat functions,
    for squares the occupied area; both in masses. The first are rounded down, the second up."""
    side = lattice.side
    columns, rows = ([key[c] for key in squares] for c in (0, 1))
    corner = min(columns), min(rows)
    width, height_ = max(columns) - corner[0] + 1, max(rows) - corner[1] + 1
    hats = [[0] * (width + 1) for _ in range(height_ + 1)]
    areas = [[0] * width for _ in range(height_)]
    for (column, row), (one, x, y, xy) in squares.items():
        i, j = column - corner[0], row - corner[1]
        areas[j][i] = (one << MASS) // (24 * side ** 2) + 2
        one, x, y = one * side * side, x * side, y * side
        hats[j][i] += one - x - y + xy
        hats[j][i + 1] += x - xy
        hats[j + 1][i] += y - xy
        hats[j + 1][i + 1] += xy
    return corner, [[max(0, (v << MASS) // (24 * side ** 4)) for v in row] for row in hats], areas
