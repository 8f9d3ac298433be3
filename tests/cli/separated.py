"""Checks a separated layer without any code of ours: python3 separated.py INPUT LAYER OUTPUT GAP

Every feature is there with its attributes; every vertex is the input's plus one vector per feature, exactly; and by
GEOS no two features of different blocks overlap or are nearer than the gap, up to the rounding of GEOS."""
import sys
from collections import defaultdict
from fractions import Fraction

from osgeo import gdal, ogr

gdal.UseExceptions()
ogr.UseExceptions()
GEOS_SLACK = 1e-6  # metres; GEOS computes distances and overlaps in doubles, for coordinates of millions
trouble = []


def vertices(geometry):
    if geometry is None:
        return []
    if geometry.GetGeometryCount():
        return [v for i in range(geometry.GetGeometryCount()) for v in vertices(geometry.GetGeometryRef(i))]
    return [(geometry.GetX(i), geometry.GetY(i)) for i in range(geometry.GetPointCount())]


def read(path, name):
    source = gdal.OpenEx(path, gdal.OF_VECTOR)
    return {f.GetFID(): f for f in source.GetLayerByName(name)}


def compare(fid, before, after):
    for i in range(before.GetFieldCount()):
        name = before.GetFieldDefnRef(i).GetName()
        if before.GetField(i) != after.GetField(name):
            trouble.append(f"FID {fid}: field {name} changed")
    a, b = vertices(before.GetGeometryRef()), vertices(after.GetGeometryRef())
    if len(a) != len(b):
        trouble.append(f"FID {fid}: {len(a)} vertices became {len(b)}")
        return
    shifts = {(Fraction(q[0]) - Fraction(p[0]), Fraction(q[1]) - Fraction(p[1])) for p, q in zip(a, b)}
    stated = (Fraction(after.GetField("sunder_dx") or 0), Fraction(after.GetField("sunder_dy") or 0))
    if a and shifts != {stated}:
        trouble.append(f"FID {fid}: not one translation, or not the one stated")


def near_pairs(boxes, gap):
    size = max(10.0, gap)
    grid = defaultdict(list)
    for fid, (x0, x1, y0, y1) in boxes.items():
        for i in range(int((x0 - gap) // size), int((x1 + gap) // size) + 1):
            for j in range(int((y0 - gap) // size), int((y1 + gap) // size) + 1):
                grid[i, j].append(fid)
    pairs = {(a, b) for cell in grid.values() for i, b in enumerate(cell) for a in cell[:i]}
    for a, b in pairs:
        p, q = boxes[a], boxes[b]
        if p[0] - gap <= q[1] and q[0] - gap <= p[1] and p[2] - gap <= q[3] and q[2] - gap <= p[3]:
            yield a, b


def check_pairs(features, gap):
    shapes = {fid: f.GetGeometryRef() for fid, f in features.items() if f.GetField("sunder_st") != "skipped"}
    for fid in [fid for fid, g in shapes.items() if not g.IsValid()]:
        del shapes[fid]  # GEOS gives no result for these
    for a, b in near_pairs({fid: g.GetEnvelope() for fid, g in shapes.items()}, gap):
        block = features[a].GetField("sunder_blk")
        if block is not None and block == features[b].GetField("sunder_blk"):
            continue
        distance = shapes[a].Distance(shapes[b])
        if distance < gap - GEOS_SLACK:
            trouble.append(f"FIDs {a} and {b}: {distance} apart")
        elif distance == 0 and shapes[a].Intersection(shapes[b]).Area() > GEOS_SLACK:
            trouble.append(f"FIDs {a} and {b} overlap")


before, after, gap = read(sys.argv[1], sys.argv[2]), read(sys.argv[3], sys.argv[2]), float(sys.argv[4])
if before.keys() != after.keys():
    trouble.append("the features are not the same")
else:
    for fid in before:
        compare(fid, before[fid], after[fid])
    check_pairs(after, gap)
for line in trouble[:10]:
    print(line)
sys.exit(1 if trouble else 0)
