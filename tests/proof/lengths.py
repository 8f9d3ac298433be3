"""Lengths as the command accepts them, in units of a layer: 3, 3m, 10us-ft, 0.2mm (on paper, with --scale), computed
by one or two operations of doubles (by the rule of gis/base/length.c); and the unit of a CRS from its definition in a
GeoPackage."""
import math
import re

from form import NotRead

NUMBER = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
# in metres
UNITS = {"m": (1.0, 1.0), "km": (1000.0, 1.0), "ft": (3048.0, 10000.0), "us-ft": (1200.0, 3937.0), "mm": (1.0, 1000.0)}
SAME_UNIT = 1e-9


class Units:
    """Converts lengths. crs: geopackage.Crs; scale: that of the map, text or None."""

    def __init__(self, crs, scale):
        self.crs = crs
        self.scale = None if scale is None else float(scale.removeprefix("1:"))

    def __call__(self, text, what):
        found = re.fullmatch(f"({NUMBER})(m|km|ft|us-ft|mm|)", str(text))
        if not found:
            raise NotRead(f"{what}: {text} is no length")
        value, unit = float(found[1]), found[2]
        if not 0 <= value < math.inf:
            raise NotRead(f"{what}: {text} is negative or too long")
        if value == 0:
            return 0.0
        if self.crs.is_geographic():
            raise NotRead(f"{what}: the layer's coordinates are degrees, in which there are no lengths")
        return self.converted(value, unit, f"{what} {text}") if unit else value

    def converted(self, value, unit, what):
        if unit == "mm" and self.scale is None:
            raise NotRead(f"{what}: there is no --scale")
        metres = self.crs.metres()
        if metres is None:
            raise NotRead(f"{what}: the layer has no CRS, so the length cannot be converted to its unit")
        if unit == "mm":
            value *= self.scale
        n, d = UNITS[unit]
        own = next((u for name, u in UNITS.items() if name != "mm" and abs(u[0] / u[1] - metres) <= SAME_UNIT * (u[0] / u[1])), None)
        if own is None:
            return value * n / d / metres
        return value if own[0] * d == n * own[1] else value * (n * own[1]) / (d * own[0])
