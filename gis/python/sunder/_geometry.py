"""Geometries as they come in and go out.

In: well-known binary, objects with `wkb` or `__geo_interface__`, mappings as in GeoJSON, arrays. Out: geometries of
Shapely if an operand was one, else `Geometry`, which Shapely, GeoPandas, Fiona and others take by its
`__geo_interface__`.
"""
import struct
import sys
import warnings
from fractions import Fraction

from sunder import _sunder


class InvalidGeometryWarning(UserWarning):
    """A polygon was invalid, and was taken by the even-odd rule or skipped."""


class Geometry:
    """A polygon or multipolygon, as well-known binary in `wkb`.

    >>> square = Geometry.from_coordinates([[(0, 0), (2, 0), (2, 2), (0, 2)]])
    >>> square.geom_type
    'Polygon'
    >>> square.__geo_interface__
    {'type': 'Polygon', 'coordinates': (((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (0.0, 0.0)),)}
    """

    __slots__ = ("wkb",)

    def __init__(self, wkb):
        self.wkb = bytes(wkb)

    @classmethod
    def from_coordinates(cls, rings):
        """Makes a polygon of an outer ring and holes, each a sequence of (x, y)."""
        return cls(_sunder.read(list(rings), "geometry", "fail").wkb(0))

    @property
    def __geo_interface__(self):
        """The geometry as a mapping of GeoJSON; rings are closed."""
        kind, coordinates, _ = _parse(self.wkb, 0)
        return {"type": kind, "coordinates": coordinates}

    @property
    def geom_type(self):
        """'Polygon' or 'MultiPolygon'."""
        return self.__geo_interface__["type"]

    @property
    def is_empty(self):
        """Whether there are no polygons."""
        return not self.__geo_interface__["coordinates"]

    def __eq__(self, other):
        return isinstance(other, Geometry) and self.wkb == other.wkb

    def __hash__(self):
        return hash(self.wkb)

    def __reduce__(self):
        return Geometry, (self.wkb,)

    def __repr__(self):
        value = self.__geo_interface__
        polygons = [value["coordinates"]] if value["type"] == "Polygon" else value["coordinates"]
        vertices = sum(len(ring) - 1 for polygon in polygons for ring in polygon)
        return f"<sunder.Geometry {value['type']}, {vertices} vertices>"


def _parse(wkb, at):
    """(type, coordinates, end) of a Polygon or MultiPolygon in two dimensions, as the extension writes it."""
    order = "<" if wkb[at] == 1 else ">"
    kind, count = struct.unpack_from(order + "II", wkb, at + 1)
    at += 9
    parts = []
    for _ in range(count):
        if kind == 6:
            _, part, at = _parse(wkb, at)
        else:
            (n,) = struct.unpack_from(order + "I", wkb, at)
            flat = struct.unpack_from(f"{order}{2 * n}d", wkb, at + 4)
            part = tuple(zip(flat[::2], flat[1::2]))
            at += 4 + 16 * n
        parts.append(part)
    return ("MultiPolygon" if kind == 6 else "Polygon"), tuple(parts), at


def is_shapely(geometry):
    """Whether an object is a geometry of Shapely, of any version, without importing it."""
    return any(base.__module__.partition(".")[0] == "shapely" for base in type(geometry).__mro__)


def make(wkb, like):
    """A geometry of well-known binary: of Shapely if one of `like` is, else a Geometry."""
    if any(is_shapely(one) for one in like):
        import shapely.wkb  # an operand came from it, so it is there
        return shapely.wkb.loads(wkb)
    return Geometry(wkb)


def warn(message, category=UserWarning):
    """Warns at the line that called the package."""
    level, frame = 1, sys._getframe()  # pylint: disable=protected-access
    while frame is not None and frame.f_globals.get("__name__", "").partition(".")[0] == "sunder":
        level, frame = level + 1, frame.f_back
    warnings.warn(message, category, stacklevel=level)


def _warn(made, who, numbered):
    for number, reason, skipped in made.invalid():
        name = f"{who} {number}" if numbered else who
        what = "skipped" if skipped else "read as the region that its rings enclose by the even-odd rule"
        warn(f"{name}: {reason}; {what}", InvalidGeometryWarning)
    return made


def shape(geometry, who, invalid="repair"):
    """The Shapes of one geometry."""
    if isinstance(geometry, _sunder.Shapes):
        return geometry
    return _warn(_sunder.read(geometry, who, invalid), who, False)


def shapes(geometries, who="geometry", invalid="repair"):
    """The Shapes of several geometries: a sequence, a GeoSeries or GeoDataFrame, or Shapes."""
    if isinstance(geometries, _sunder.Shapes):
        return geometries
    return _warn(_sunder.read_all(column_of(geometries), who, invalid), who, True)


def from_ragged(coordinates, offsets, *, invalid="repair"):
    """Polygons as arrays, in the form of GeoArrow and of `shapely.to_ragged_array()`.

    Args:
        coordinates: (n, 2) float64, x and y of all vertices; more columns are ignored.
        offsets: (ring offsets, polygon offsets) for polygons, with (..., geometry offsets) for multipolygons; integers,
            each array beginning with 0 and having one value more than there are items.
        invalid: as in `minkowski_sum`.
    Returns: `Shapes`, which every function takes in place of a sequence of geometries, or of one if it has one item.
    Raises: ValueError that names the array and the place in it, or the geometry.

    >>> import array
    >>> xy = memoryview(array.array("d", [0, 0, 2, 0, 0, 2, 5, 5, 6, 5, 6, 6])).cast("B").cast("d", [6, 2])
    >>> two = from_ragged(xy, ([0, 3, 6], [0, 1, 2]))
    >>> len(two), list(two.areas())
    (2, [2.0, 0.5])
    """
    offsets = tuple(offsets)
    if len(offsets) not in (2, 3):
        raise ValueError(f"offsets: {len(offsets)} arrays; two are needed for polygons, three for multipolygons")
    made = _sunder.read_ragged(coordinates, *offsets, *([None] * (3 - len(offsets))), "geometry", invalid)
    return _warn(made, "geometry", True)


def to_ragged(geometries, *, invalid="repair"):
    """The polygons of geometries as arrays: (coordinates, (ring offsets, polygon offsets, geometry offsets)).

    Rings are those that were given, closed. Arrays are of NumPy if it is installed, else memoryviews.

    >>> xy, offsets = to_ragged([[(0, 0), (2, 0), (0, 2)], None])
    >>> xy.tolist(), [one.tolist() for one in offsets]
    ([[0.0, 0.0], [2.0, 0.0], [0.0, 2.0], [0.0, 0.0]], [[0, 4], [0, 1], [0, 1, 1]])
    """
    coordinates, *offsets = shapes(geometries, invalid=invalid).ragged()
    return array(coordinates), tuple(map(array, offsets))


def column_of(geometries):
    """The geometries of a GeoDataFrame, a GeoSeries or an array of these as well-known binary; others unchanged."""
    column = getattr(geometries, "geometry", None) if hasattr(geometries, "crs") else None
    if column is None:
        return geometries
    return [None if one is None else one.wkb for one in column.values]


def fraction(text):
    """The Fraction of a text "num" or "num/den"."""
    return Fraction(text)


def rational(number):
    """The text "num" or "num/den" of an int, a float or a Fraction; a float is the dyadic rational that it is."""
    value = Fraction(number)
    return f"{value.numerator}/{value.denominator}" if value.denominator != 1 else str(value.numerator)


def array(view):
    """A memoryview as an array of NumPy, without a copy, if NumPy is installed; else the memoryview."""
    try:
        import numpy
    except ImportError:
        return view
    return numpy.asarray(view)
