"""Prints the pairs that remain in conflict, as they were and as they are, to compare them by standing_rule:

    python3 upheld.py INPUT.gpkg LAYER OUTPUT.gpkg WRITTEN GAP CHECKED | standing_rule

Reads both GeoPackages as SQLite files, and prints the geometries before and after of every pair in the output's
conflicts that is not inside a block. LAYER may be empty if there is only one; WRITTEN may be empty if it is the same
name. CHECKED holds the lines of `sunder check` on the input: a pair that was contained or a duplicate, and still is,
is no worse and is left out. Each feature has to be an exact translate of its original."""
import sqlite3
import struct
import sys
from fractions import Fraction

source, layer, output, written, gap, checked = sys.argv[1:7]


def rings(blob, at):
    order = "<" if blob[at] else ">"
    kind, count = struct.unpack_from(order + "II", blob, at + 1)
    kind, step, at = kind % 1000, 2 + (kind // 1000 % 2) + (kind // 2000 % 2), at + 9
    polygons = []
    for _ in range(count):
        if kind == 6:
            inner, at = rings(blob, at)
            polygons += inner
            continue
        (n,) = struct.unpack_from(order + "I", blob, at)
        values = struct.unpack_from(order + "%dd" % (n * step), blob, at + 4)
        polygons.append([values[i:i + 2] for i in range(0, n * step, step)])
        at += 4 + 8 * n * step
    return (polygons if kind == 6 else [polygons]), at


def only_layer(path):
    return sqlite3.connect(path).execute("SELECT table_name FROM gpkg_geometry_columns").fetchone()[0]


def shapes(path, layer):
    base = sqlite3.connect(path)
    column = base.execute("SELECT column_name FROM gpkg_geometry_columns WHERE table_name = ?", (layer,)).fetchone()[0]
    found = {}
    for fid, blob in base.execute(f'SELECT fid, "{column}" FROM "{layer}"'):
        if blob:
            found[fid] = rings(blob, 8 + (0, 32, 48, 48, 64)[blob[3] >> 1 & 7])[0]
    return found


def shift(fid):
    pairs = [(p, q) for a, b in zip(was[fid], now[fid]) for r, s in zip(a, b) for p, q in zip(r, s)]
    found = {tuple(Fraction(q[c]) - Fraction(p[c]) for c in (0, 1)) for p, q in pairs}
    if len(found) != 1:
        sys.exit(f"upheld.py: FID {fid} is not a translate of its original")
    return found.pop()


def wkt(polygons):
    def ring(points):
        return "(" + ", ".join(f"{x!r} {y!r}" for x, y in points) + ")"
    return "MULTIPOLYGON (" + ", ".join("(" + ", ".join(map(ring, p)) + ")" for p in polygons) + ")"


layer = layer or only_layer(source)
written = written or layer
was, now = shapes(source, layer), shapes(output, written)
within = {"contained", "duplicate"}
lines = [line.rstrip("\n").split("\t") for line in open(checked)]  # columns fid_a, id_a, fid_b, id_b, barrier, barr_fid, kind, ...
contained = {(int(v[0]), int(v[2])) for v in lines if len(v) > 6 and v[6] in within}
query = f'SELECT fid_a, fid_b, kind, reason FROM "{written}_conflicts"'
for a, b, kind, reason in sqlite3.connect(output).execute(query):
    if reason == "same_block" or (kind in within and (a, b) in contained):
        continue
    if shift(a) != shift(b):
        print(f"{a} and {b}", gap, wkt(was[a]), wkt(was[b]), wkt(now[a]), wkt(now[b]), sep="\t")
