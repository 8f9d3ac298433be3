"""Symbols of points: a SHAPE as text becomes polygons of doubles, and the symbol is placed at each point of its
feature, rounded to the nearest doubles."""
import ast
import re
from fractions import Fraction

import discs
from form import NotRead
from geopackage import number_of, value_of
from lengths import NUMBER
from repair import repaired, side


def read(text, units):
    """Polygons, as lists of open rings, from square:SIDE, rectangle:WIDTHxHEIGHT, disc:RADIUS[:SEGMENTS],
    inside-disc:, @FILE with a WKT, or a WKT itself."""
    kind, _, size = text.partition(":")
    what = f"the symbol {text}:"
    if kind in ("disc", "inside-disc"):
        radius, _, segments = size.partition(":")
        return [[(discs.outside if kind == "disc" else discs.inside)(units(radius, what), int(segments or 32))]]
    if kind in ("square", "rectangle"):
        width, height = (units(s, what) for s in (size.split("x") if kind == "rectangle" else (size, size)))
        return [[[(x * width / 2, y * height / 2) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]]]
    if text.startswith("@"):
        with open(text[1:], encoding="utf-8") as file:
            return read(file.read().strip(), units)
    return read_wkt(text)


def read_wkt(text):
    found = re.fullmatch(r"\s*(MULTI)?POLYGON\s*(?:ZM|Z|M)?\s*(\([-+0-9.eE \t\n,()]*\))\s*", text, re.IGNORECASE)
    if not found:
        raise NotRead(f"the symbol {text} is not read")
    lists = re.sub(rf"({NUMBER})\s+({NUMBER})(?:\s+{NUMBER})*", r"(\1, \2)", found[2].replace("(", "[").replace(")", "]"))
    polygons = ast.literal_eval(lists)
    return [[open_ring(ring) for ring in rings] for rings in (polygons if found[1] else [polygons])]


def open_ring(ring):
    ring = [tuple(map(float, p)) for p in ring]
    return ring[:-1] if ring[0] == ring[-1] else ring


def enlarged(polygons, factor):
    """The polygons scaled by the factor. Straight corners are removed before that."""
    return [[[(x * factor, y * factor) for x, y in corners_of(ring)] for ring in repaired(rings)] for rings in polygons]


def corners_of(ring):
    ring = [p for k, p in enumerate(ring) if p != ring[k - 1]]
    exact = [tuple(map(Fraction, p)) for p in ring]
    return [p for k, p in enumerate(ring) if side(exact[k - 1], exact[k], exact[(k + 1) % len(ring)])]


class Symbols:
    """The symbols of one run: --symbol, --symbol-field, --symbol-size-field. A feature that is not a point has none."""

    def __init__(self, options, units):
        self.options, self.units, self.known = options, units, {}

    def of(self, fid, attributes):
        """Polygons of doubles, relative to the point."""
        text = value_of(attributes, self.options.symbol_field) or self.options.symbol
        factor = number_of(attributes, self.options.symbol_size_field)
        if text is None:
            raise NotRead(f"{fid} has no symbol")
        if (text, factor) not in self.known:
            polygons = read(text, self.units)
            self.known[text, factor] = polygons if factor is None else enlarged(polygons, factor)
        return self.known[text, factor]

    def place(self, layer):
        """The symbol at each point of a feature, rounded to the nearest doubles; the points of each feature,
        sorted."""
        points = {}
        for fid, (attributes, polygons, lines) in layer.features.items():
            placed = []
            if not polygons and all(len(line) == 1 for line in lines):
                points[fid] = sorted(line[0] for line in lines)
                symbol = self.of(fid, attributes) if lines else []
                placed = [[[(px + x, py + y) for x, y in ring] for ring in rings] for px, py in points[fid] for rings in symbol]
            layer.features[fid] = attributes, placed, []
        return points
