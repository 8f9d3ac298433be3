"""Minkowski sums, no-fit polygons, and mathematical morphology, exactly."""
import math

from sunder import _sunder
from sunder._geometry import Geometry, fraction, make, shape


class Sum:
    """An exact polygonal set: the result of a sum or of an operation of morphology.

    Its parts are computed when they are asked for. `exact` was given when it was made: coordinates are then
    `fractions.Fraction`, else floats, the nearest doubles.
    """

    __slots__ = ("_sum", "_like", "_exact", "_scale", "_rounded", "rounded")

    def __init__(self, made, like, exact, scale=1, rounded=False):
        self._sum, self._like, self._exact, self._scale, self._rounded = made, like, exact, scale, None
        #: Whether a rotated operand had to be rounded (`no_fit_polygons`); the sum is then that of rounded ones.
        self.rounded = rounded

    def _round(self):
        if self._rounded is None:
            wkb, deviation, mended = self._sum.rounded(False)
            if self._scale != 1:
                wkb, deviation = _divided(wkb, deviation, self._scale)
            self._rounded = wkb, deviation, mended
        return self._rounded

    @property
    def geometry(self):
        """The polygons in doubles: a valid Polygon or MultiPolygon, as the program writes it.

        It is a geometry of Shapely if an operand was one, else a `sunder.Geometry`.
        Raises: sunder.Error if a vertex is beyond the range of doubles.
        """
        return make(self._round()[0], self._like)

    @property
    def wkb(self):
        """The same polygons as well-known binary."""
        return self._round()[0]

    @property
    def deviation(self):
        """A bound on the distance of the boundary of `geometry` from the exact one, in units of the input."""
        return self._round()[1]

    @property
    def area(self):
        """The exact area, a Fraction, in square units of the input."""
        return fraction(self._sum.area()) / self._scale ** 2

    @property
    def polygons(self):
        """The polygons in canonical form: a list of polygons, each a list of rings, each a list of (x, y).

        Ring 0 of a polygon is its outer one, counter-clockwise; holes are clockwise. A ring starts at its smallest
        vertex, which is not repeated.
        """
        return [[self._pairs(ring) for ring in polygon] for polygon in self._sum.polygons(self._exact)]

    @property
    def degenerate_segments(self):
        """Segments of which no neighbourhood belongs to the set's interior: a list of ((x, y), (x, y))."""
        return [tuple(self._pairs(ends)) for ends in self._sum.segments(self._exact)]

    @property
    def degenerate_points(self):
        """Isolated points, such as exact fits: a list of (x, y)."""
        return self._pairs(self._sum.points(self._exact))

    def _pairs(self, pairs):
        if self._exact:
            return [(fraction(x) / self._scale, fraction(y) / self._scale) for x, y in pairs]
        return list(pairs) if self._scale == 1 else [(x / self._scale, y / self._scale) for x, y in pairs]

    @property
    def __geo_interface__(self):
        return make(self._round()[0], ()).__geo_interface__

    def __repr__(self):
        polygons, holes, vertices, segments, points = self._sum.size()
        return (f"<sunder.Sum: {polygons} polygons, {holes} holes, {vertices} vertices, "
                f"{segments} degenerate segments, {points} degenerate points>")


def _divided(wkb, deviation, scale):
    """Polygons in another scale. Rounding the quotients could make them invalid, which would be an error."""
    mapping = Geometry(wkb).__geo_interface__

    def divide(value):
        return value / scale if isinstance(value, float) else tuple(map(divide, value))
    coordinates = divide(mapping["coordinates"])
    try:
        made = _sunder.read({"type": mapping["type"], "coordinates": coordinates}, "geometry", "fail").wkb(0)
    except ValueError as error:
        raise _sunder.Error(f"rounded to doubles the polygons are not valid: {error}") from error
    largest = max((abs(v) for v in _flat(coordinates)), default=0.0)
    return made, deviation / scale * (1 + 1e-9) + math.ulp(largest)


def _flat(value):
    return [value] if isinstance(value, float) else [v for one in value for v in _flat(one)]


def minkowski_sum(a, b, *, exact=False, invalid="repair", progress=None):
    """The Minkowski sum { p + q : p in a, q in b } of two polygonal sets, exactly.

    Args:
        a, b: polygons or multipolygons, in any of the forms that the package takes. Rings may have any orientation.
        exact: coordinates of the result are `fractions.Fraction`.
        invalid: what becomes of rings that cross: "repair" takes them by the even-odd rule, "fail" is an error.
        progress: None, or a callable that gets a float from 0 to 1 and may raise to stop the work.

    Returns: a `Sum`. Units are those of the input; nothing is rounded but `Sum.geometry`.
    Raises: ValueError for input that is no polygon, or invalid if `invalid` is "fail".

    >>> total = minkowski_sum([(0, 0), (4, 0), (4, 3), (0, 3)], [(0, 0), (1, 0), (0, 1)])
    >>> total.area
    Fraction(39, 2)
    >>> total.polygons
    [[[(0.0, 0.0), (5.0, 0.0), (5.0, 3.0), (4.0, 4.0), (0.0, 4.0)]]]
    """
    made = _sunder.minkowski_sum(shape(a, "a", invalid), shape(b, "b", invalid), False, progress)
    return Sum(made, (a, b), exact)


def no_fit_polygon(a, b, *, exact=False, invalid="repair", progress=None):
    """The no-fit polygon of a and b: the translations of b with which its interior meets that of a.

    It is the sum of a and -b. Degenerate segments and points are slides and fits without any play.
    Arguments, result and errors are those of `minkowski_sum`.

    >>> slot = [(0, 0), (6, 0), (6, 3), (4, 3), (4, 1), (2, 1), (2, 3), (0, 3)]
    >>> key = [(0, 0), (2, 0), (2, 2), (0, 2)]
    >>> no_fit_polygon(slot, key).degenerate_segments
    [((2.0, 1.0), (2.0, 3.0))]
    """
    made = _sunder.minkowski_sum(shape(a, "a", invalid), shape(b, "b", invalid), True, progress)
    return Sum(made, (a, b), exact)


def _morphology(a, b, operation, exact, invalid, threads, progress):
    made = _sunder.morphology(shape(a, "a", invalid), shape(b, "b", invalid), operation, threads, progress)
    return Sum(made, (a, b), exact)


def dilate(a, b, *, exact=False, invalid="repair", threads=1, progress=None):
    """The dilation of a by b, which is their Minkowski sum.

    threads: how many threads work (1 to 64); the result is the same for every number.
    Other arguments, result and errors are those of `minkowski_sum`.

    >>> dilate([(0, 0), (4, 0), (4, 3), (0, 3)], square(2)).area
    Fraction(30, 1)
    """
    return _morphology(a, b, "dilate", exact, invalid, threads, progress)


def erode(a, b, *, exact=False, invalid="repair", threads=1, progress=None):
    """The erosion of a by b: the translations with which b lies in a. Arguments as for `dilate`.

    Segments and points of the result are its parts without area.

    >>> erode([(0, 0), (4, 0), (4, 3), (0, 3)], square(2)).area
    Fraction(2, 1)
    """
    return _morphology(a, b, "erode", exact, invalid, threads, progress)


def open(a, b, *, exact=False, invalid="repair", threads=1, progress=None):  # pylint: disable=redefined-builtin
    """The opening of a by b: the union of all translates of b that lie in a. Arguments as for `dilate`.

    >>> open([(0, 0), (9, 0), (9, 1), (4, 1), (4, 4), (0, 4)], square(2)).area
    Fraction(16, 1)
    """
    return _morphology(a, b, "open", exact, invalid, threads, progress)


def close(a, b, *, exact=False, invalid="repair", threads=1, progress=None):
    """The closing of a by b: the erosion of the dilation. Arguments as for `dilate`.

    >>> close([(0, 0), (6, 0), (6, 3), (4, 3), (4, 1), (3, 1), (3, 3), (0, 3)], square(2)).area
    Fraction(18, 1)
    """
    return _morphology(a, b, "close", exact, invalid, threads, progress)


def disc(radius, segments=32, *, inside=False):
    """A nearly regular polygon about the origin, which contains the disc of this radius (or lies in it, `inside`).

    Returns: `Shapes` of one item, which every function takes as a geometry. Raises: ValueError.
    """
    return _sunder.disc(radius, segments, inside)


def square(side):
    """The square with this side, centred on the origin; see `disc`."""
    return _sunder.rectangle(side, side)


def rectangle(width, height):
    """The rectangle centred on the origin; see `disc`."""
    return _sunder.rectangle(width, height)
