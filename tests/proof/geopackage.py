"""Features of a GeoPackage, from its SQLite tables and well-known binary, with Python's standard library only."""
import re
import sqlite3
import struct

from form import NotRead

CIRCULAR, CURVES = 8, range(9, 13)  # circular string; compound curve, curve polygon, multicurve, multisurface


def read_geometry(blob, at, curves):
    """(polygons, lines, end): polygons as lists of open rings; lines, and points as lines of one vertex. Each curve
    appends the list of its arcs, each of three points, to `curves`. Its rings and lines are not complete here: arcs.py reads them."""
    order = "<" if blob[at] else ">"
    kind, = struct.unpack_from(order + "I", blob, at + 1)
    at += 5
    if kind & 0x20000000:  # the geometry has its own SRID
        at += 4
    size = 2 + bool(kind & 0x80000000) + bool(kind & 0x40000000)
    kind &= 0x0FFFFFFF
    size += {0: 0, 1: 1, 2: 1, 3: 2}[kind // 1000]
    kind %= 1000

    def chain(at, n):
        numbers = struct.unpack_from(f"{order}{n * size}d", blob, at)
        return [(numbers[k], numbers[k + 1]) for k in range(0, n * size, size)], at + 8 * n * size

    if kind == 1:
        points, at = chain(at, 1)
        return [], [points] if points[0][0] == points[0][0] else [], at
    n, = struct.unpack_from(order + "I", blob, at)
    at += 4
    if kind == 2:
        points, at = chain(at, n)
        return [], [points] if points else [], at
    if kind == 3:
        rings = []
        for _ in range(n):
            m, = struct.unpack_from(order + "I", blob, at)
            points, at = chain(at + 4, m)
            if points and points[0] == points[-1]:
                points.pop()
            if points:
                rings.append(points)
        return [rings] if rings else [], [], at
    if kind == CIRCULAR:
        points, at = chain(at, n)
        curves.append([points[k:k + 3] for k in range(0, n - 2, 2)])
        return [], [], at
    if kind in (4, 5, 6, 7, *CURVES):
        polygons, lines = [], []
        curves += [[]] if kind in CURVES else []
        for _ in range(n):
            more, others, at = read_geometry(blob, at, curves)
            polygons += more
            lines += others
        return polygons, lines, at
    raise NotRead(f"geometries of type {kind} are not read")


def read_blob(blob):
    """(polygons, lines, curves)"""
    if blob is None or blob[3] & 16:
        return [], [], []
    envelope, curves = (0, 32, 48, 48, 64)[blob[3] >> 1 & 7], []
    return *read_geometry(blob, 8 + envelope, curves)[:2], curves


def quoted(name):
    return '"' + name.replace('"', '""') + '"'


def value_of(attributes, name):
    """The value of a field, whose name is compared without case. None: the field is missing, null, or blank."""
    if name is None:
        return None
    own = [k for k in attributes if k == name] or [k for k in attributes if k.lower() == name.lower()]
    if not own:
        raise NotRead(f"there is no field {name}")
    value = attributes[own[0]]
    return None if isinstance(value, str) and not value.strip(" ") else value


def number_of(attributes, name):
    value = value_of(attributes, name)
    return None if value is None else float(value)


class Crs:
    """The CRS of a layer, by its row in gpkg_spatial_ref_sys."""

    def __init__(self, base, srs):
        self.known = srs not in (0, -1)
        row = base.execute("SELECT organization, organization_coordsys_id, definition FROM gpkg_spatial_ref_sys WHERE srs_id = ?", (srs,))
        organization, code, self.definition = row.fetchone()
        self.name = f"{organization.upper()}:{code}"

    def is_same(self, other):
        """Are the two the same? Also true if one of them is unknown."""
        return not (self.known and other.known) or self.name == other.name or self.definition == other.definition

    def is_geographic(self):
        return self.known and self.definition.startswith("GEOGCS")

    def metres(self):
        """Metres in the CRS's unit of length; None: there is no CRS."""
        if not self.known:
            return None
        inside = re.search(r"(?:PROJCS|LOCAL_CS)\[.*", self.definition, re.DOTALL)
        depth, found = 0, None
        for word in re.finditer(r'"[^"]*"|([A-Z_]+)\[|\]', inside[0]) if inside else ():
            if word[1] == "UNIT" and depth == 1 and found is None:
                found = re.match(r'UNIT\["[^"]*",([^],]+)', inside[0][word.start():])
            depth += bool(word[1]) - (word[0] == "]")
            if depth == 0:
                break
        if not found:
            raise NotRead(f"the unit of {self.name} is not read")
        return float(found[1])


class Layer:
    """A table of features: its name and {FID: (attributes, polygons, lines)}; for features with curves also {FID: arcs} and, set by
    arcs.py, {FID: deviation}."""

    def __init__(self, path, name=None, where=None):
        base = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
        tables = base.execute("SELECT table_name, column_name, srs_id FROM gpkg_geometry_columns").fetchall()
        found = [t for t in tables if name is None or t[0] == name]
        if name is None and len(found) > 1:
            raise NotRead(f"{path} has several layers, and none is named")
        if not found:
            raise NotRead(f"{path} has no layer {name}")
        self.name, column, srs = found[0]
        self.crs = Crs(base, srs)
        keys = [row[1] for row in base.execute(f"PRAGMA table_info({quoted(self.name)})") if row[5]]
        key = keys[0] if keys else "rowid"
        self.select = f"SELECT * FROM {quoted(self.name)}"
        self.features, self.arcs, self.deviation = {}, {}, {}
        rows = base.execute(self.select + (f" WHERE {where}" if where else ""))
        names = [d[0] for d in rows.description]
        for row in rows:
            attributes = dict(zip(names, row))
            polygons, lines, curves = read_blob(attributes.pop(column))
            self.features[attributes[key]] = (attributes, polygons, lines)
            if curves:
                self.arcs[attributes[key]] = sum(curves, [])
        base.close()

    def demand_field(self, name):
        for attributes, _, _ in self.features.values():
            value_of(attributes, name)
