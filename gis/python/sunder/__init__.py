"""Exact Minkowski sums, least separating translations, and provably small displacement of map features.

Functions take geometries as well-known binary, as objects with `wkb` or `__geo_interface__` (Shapely, GeoPandas,
Fiona), as mappings of GeoJSON, or as arrays of coordinates. Every decision about geometry is exact. Work runs without
the interpreter's lock, and Ctrl-C ends it. Errors are `ValueError` for wrong input, or `sunder.Error`.
"""
from sunder import _sunder
from sunder._geometry import Geometry, InvalidGeometryWarning, from_ragged, to_ragged
from sunder._layers import STATUSES, Barrier, Check, Conflict, Result, check, separate
from sunder._nesting import no_fit_polygons, rotation
from sunder._pairs import (CONTACTS, Distance, LeastTranslation, LeastTranslations, apart, distance, least_translation,
                           least_translations, overlap)
from sunder._routes import Route, route
from sunder._sums import Sum, close, dilate, disc, erode, minkowski_sum, no_fit_polygon, open, rectangle, square
from sunder._sunder import Error, Shapes

__version__ = _sunder.version

__all__ = [
    "Barrier", "CONTACTS", "Check", "Conflict", "Distance", "Error", "Geometry", "InvalidGeometryWarning",
    "LeastTranslation", "LeastTranslations", "Result", "Route", "STATUSES", "Shapes", "Sum", "apart", "check", "close",
    "dilate", "disc", "distance", "erode", "from_ragged", "least_translation", "least_translations", "minkowski_sum",
    "no_fit_polygon", "no_fit_polygons", "open", "overlap", "rectangle", "rotation", "route", "separate", "square",
    "to_ragged"]
