"""Features of a GeoPackage, by its SQLite tables and well-known binary; nothing but Python's own library is needed."""
import sqlite3
import struct


def read_geometry(blob, at=0):
    """(polygons, lines, end): polygons as lists of open rings; lines, and points as lines of one place."""
    order = "<" if blob[at] else ">"
    kind, = struct.unpack_from(order + "I", blob, at + 1)
    at += 5
    if kind & 0x20000000:  # an SRID of its own
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
    if kind in (4, 5, 6, 7):
        polygons, lines = [], []
        for _ in range(n):
            more, others, at = read_geometry(blob, at)
            polygons += more
            lines += others
        return polygons, lines, at
    raise SystemExit(f"geopackage.py: geometries of type {kind} are not read")


def read_blob(blob):
    if blob is None or blob[3] & 16:
        return [], []
    envelope = (0, 32, 48, 48, 64)[blob[3] >> 1 & 7]
    return read_geometry(blob, 8 + envelope)[:2]


def quoted(name):
    return '"' + name.replace('"', '""') + '"'


class Layer:
    """A table of features: its name, and {FID: (attributes, polygons, lines)}."""

    def __init__(self, path, name=None, where=None):
        base = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
        tables = base.execute("SELECT table_name, column_name, srs_id FROM gpkg_geometry_columns").fetchall()
        found = [t for t in tables if name is None or t[0] == name]
        if not found:
            raise SystemExit(f"geopackage.py: {path} has no layer {name}")
        self.name, column, srs = found[0]
        self.crs = base.execute("SELECT organization, organization_coordsys_id FROM gpkg_spatial_ref_sys WHERE srs_id = ?",
                                (srs,)).fetchone()
        keys = [row[1] for row in base.execute(f"PRAGMA table_info({quoted(self.name)})") if row[5]]
        key = keys[0] if keys else "rowid"
        self.select = f"SELECT * FROM {quoted(self.name)}"
        self.features = {}
        rows = base.execute(self.select + (f" WHERE {where}" if where else ""))
        names = [d[0] for d in rows.description]
        for row in rows:
            attributes = dict(zip(names, row))
            polygons, lines = read_blob(attributes.pop(column))
            self.features[attributes[key]] = (attributes, polygons, lines)
        base.close()

    def fids(self, path, where):
        return set(Layer(path, self.name, where).features) if where else set()
