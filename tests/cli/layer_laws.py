"""How the results for related inputs are related: python3 layer_laws.py SUNDER NAME|SOURCE|LAYER[|OPTION] ...

  limits  with a looser limit no more conflicts remain (overlaps are compared first, then all pairs: one overlap less
          may leave two more pairs that are too near); if neither run leaves any, the cost is no greater
  gaps    with a smaller gap the cost is no greater, if neither run leaves a conflict
  place   shifted by a vector that all coordinates represent exactly: the same conflicts, and costs within 1 %

Violations are counted by groups of features that could meet in either run, over all layers together: fewer than one
group in a hundred may violate a law (at most two if there are few groups). These hold to the byte:

  a limit longer than the longest move of the run without a limit changes nothing
  features in another order have the same moves (identical features may exchange theirs)
  a layer scaled by a power of two, with all lengths, has its moves scaled

With the option GAP=N a layer is tested with that gap alone."""
import json
import math
import os
import random
import subprocess
import sys
from collections import Counter

from osgeo import gdal, ogr

gdal.UseExceptions()
ogr.UseExceptions()
gdal.SetConfigOption("OGR_SQLITE_SYNCHRONOUS", "OFF")
TOLERANCE = 0.1
LIMITS = (None, 60, 20, 10, 5, 3)
SCALE = 8.0
trouble = []
tally = {}


def walk(geometry, change):
    for i in range(geometry.GetGeometryCount()):
        walk(geometry.GetGeometryRef(i), change)
    if geometry.GetGeometryCount() == 0:
        for i in range(geometry.GetPointCount()):
            x, y = change(geometry.GetX(i), geometry.GetY(i))
            geometry.SetPoint_2D(i, x, y)


def write(path, shapes, order, change=lambda x, y: (x, y)):
    """The shapes in that order; field n is the number of the shape."""
    if os.path.exists(path):
        os.remove(path)
    source = ogr.GetDriverByName("GPKG").CreateDataSource(path)
    layer = source.CreateLayer("l", None, ogr.wkbUnknown)
    layer.CreateField(ogr.FieldDefn("n", ogr.OFTInteger))
    layer.StartTransaction()
    for n in order:
        geometry = ogr.CreateGeometryFromWkb(shapes[n])
        walk(geometry, change)
        feature = ogr.Feature(layer.GetLayerDefn())
        feature.SetField("n", n)
        feature.SetGeometryDirectly(geometry)
        layer.CreateFeature(feature)
    layer.CommitTransaction()


class Run:
    """Moves by number, pairs in conflict, the longest move."""

    def __init__(self, sunder, path, gap, limit, tolerance=TOLERANCE, more=()):
        words = [sunder, "separate", path, "o.gpkg", "--overwrite", "-q", "--rows", "no", "--ease", "no", "--gap", repr(gap),
                 "--touch-tolerance", repr(tolerance), "--stats", "s.json"]
        words += ["--max-shift", repr(limit)] if limit else []
        done = subprocess.run(words + list(more), capture_output=True, text=True)
        if done.returncode not in (0, 3):
            raise SystemExit(f"{' '.join(words)}: {done.stderr}")
        with open("s.json", encoding="utf-8") as f:
            stats = json.load(f)
        self.longest = stats["displacement"]["max"]
        self.proved = stats["clusters_optimal"] == stats["clusters"]  # each group is proved optimal
        result = gdal.OpenEx("o.gpkg", gdal.OF_VECTOR)
        self.move, number = {}, {}
        for f in result.GetLayerByName("l"):
            number[f.GetFID()] = f.GetField("n")
            self.move[f.GetField("n")] = (f.GetField("sunder_dx") or 0.0, f.GetField("sunder_dy") or 0.0)
        listed = {}
        for f in result.GetLayerByName("l_conflicts"):
            a, b = number[f.GetField("fid_a")], number.get(f.GetField("fid_b"))
            if f.GetField("reason") not in ("same_block", "kept"):
                pair = (a, (f.GetField("barrier"), f.GetField("barr_fid"))) if b is None else (min(a, b), max(a, b))
                listed[pair] = f.GetField("kind")
        self.conflicts = set(listed)
        self.overlaps = {pair for pair, kind in listed.items() if kind not in ("too_close", "barrier_drawn", "barrier_near")}


def find(root, k):
    while root[k] != k:
        root[k] = root[root[k]]
        k = root[k]
    return k


def groups(boxes, gap, p, q):
    """Groups of features: two are in one group if their boxes, swept along the moves of either run, are within the
    gap."""
    swept = []
    for k, (x0, x1, y0, y1) in enumerate(boxes):
        dx = (0, p.move[k][0], q.move[k][0])
        dy = (0, p.move[k][1], q.move[k][1])
        swept.append((x0 + min(dx), x1 + max(dx) + gap, y0 + min(dy), y1 + max(dy) + gap, k))
    swept.sort()
    root = list(range(len(boxes)))
    active = []
    for box in swept:
        active = [b for b in active if b[1] >= box[0]]
        for b in active:
            if b[2] <= box[3] and box[2] <= b[3]:
                root[find(root, box[4])] = find(root, b[4])
        active.append(box)
    return [find(root, k) for k in range(len(boxes))]


def accounts(root, run):
    cost, conflicts, length = Counter(), Counter(), Counter()
    for k, (x, y) in run.move.items():
        cost[root[k]] += x * x + y * y
        length[root[k]] += math.hypot(x, y)
    for pair in run.conflicts:
        conflicts[root[pair[0]]] += 1
    overlaps = Counter(root[a] for a, _ in run.overlaps)
    return cost, conflicts, overlaps, length


def compare(law, boxes, gap, easy, hard, same=False):
    """Compares the runs `easy` and `hard`, whose demands are greater; same: demands are equal, the layer is
    shifted."""
    root = groups(boxes, gap, easy, hard)
    (p, pc, po, length), (q, qc, qo, _) = accounts(root, easy), accounts(root, hard)
    # the largest change of a move by rounding and by the margin for it
    unit = 2.0**-46 * max(abs(c) for box in boxes for c in box)
    count = tally.setdefault(law, [0, 0, 0])
    unlike = {root[a] for a, _ in easy.conflicts ^ hard.conflicts} if same else set()
    for g in set(root):
        if p[g] == 0 and q[g] == 0 and pc[g] + qc[g] == 0:
            continue
        slack = 2 * unit * length[g]
        off = abs(p[g] - q[g]) > 0.01 * min(p[g], q[g]) + slack if same else p[g] > q[g] * (1 + 1e-9) + slack
        more = g in unlike if same else (po[g], pc[g]) > (qo[g], qc[g])
        dearer = off and not more and (same or pc[g] + qc[g] == 0)
        count[0] += 1
        count[1] += more
        count[2] += dearer
        if (more or dearer) and "SUNDER_LAWS_SHOW" in os.environ:
            print(f"  {law}: group of {g}: {pc[g]} conflicts, cost {p[g]:.9g}; beside {qc[g]}, {q[g]:.9g}")


def exact_shift(boxes, corners):
    """A vector that can be added to and subtracted from every coordinate without rounding."""
    def holds(values, s):
        return all((v + s) - s == v and (v + s) - v == s for v in values)
    found = []
    for c in range(2):
        values = {p[c] for p in corners}
        found.append(next((s for k in range(17, -1, -1) for s in (2.0**k, -(2.0**k)) if holds(values, s)), None))
    return None if None in found else found


def corners_of(geometry):
    if geometry.GetGeometryCount():
        return [p for i in range(geometry.GetGeometryCount()) for p in corners_of(geometry.GetGeometryRef(i))]
    return [(geometry.GetX(i), geometry.GetY(i)) for i in range(geometry.GetPointCount())]


def examine(sunder, name, shapes, gap):
    n = len(shapes)
    geometries = [ogr.CreateGeometryFromWkb(s) for s in shapes]
    boxes = [g.GetEnvelope() for g in geometries]
    corners = {p for g in geometries for p in corners_of(g)}
    write("a.gpkg", shapes, range(n))
    runs = {limit: Run(sunder, "a.gpkg", gap, limit) for limit in LIMITS}
    for loose, tight in zip(LIMITS, LIMITS[1:]):
        compare("limits", boxes, gap, runs[loose], runs[tight])
    free = runs[None]
    if free.longest > 0 and Run(sunder, "a.gpkg", gap, free.longest * 1.0001).move != free.move:
        trouble.append(f"{name}, gap {gap}: a limit that nothing oversteps makes a difference")
    compare("gaps", boxes, gap, Run(sunder, "a.gpkg", gap / 2, None), free)
    order = list(range(n))
    random.Random(1).shuffle(order)
    twins = {s for s, k in Counter(shapes).items() if k > 1}
    for turned in (order, range(n - 1, -1, -1)):
        write("b.gpkg", shapes, turned)
        for limit in (None, 5):
            other = Run(sunder, "b.gpkg", gap, limit)
            apart = [k for k in range(n) if other.move[k] != runs[limit].move[k] and shapes[k] not in twins]
            if apart or (not twins and other.conflicts != runs[limit].conflicts):
                trouble.append(f"{name}, gap {gap}, limit {limit}: with another order {len(apart)} features have other moves")
    shift = exact_shift(boxes, corners)
    if shift:
        write("b.gpkg", shapes, range(n), lambda x, y: (x + shift[0], y + shift[1]))
        for limit in (None, 5):
            compare("place", boxes, gap, Run(sunder, "b.gpkg", gap, limit), runs[limit], True)
    else:
        print(f"{name}: no shift is exact for all coordinates; not tested")
    write("b.gpkg", shapes, range(n), lambda x, y: (SCALE * x, SCALE * y))
    for limit in (None, 5):
        large = Run(sunder, "b.gpkg", SCALE * gap, limit and SCALE * limit, SCALE * TOLERANCE)
        if any(large.move[k] != (SCALE * x, SCALE * y) for k, (x, y) in runs[limit].move.items()):
            trouble.append(f"{name}, gap {gap}, limit {limit}: scaled by {SCALE}, the result is not the scaled one")


def main():
    for what in sys.argv[2:]:
        name, path, layer, *options = what.split("|")
        source = gdal.OpenEx(path, gdal.OF_VECTOR)
        features = source.GetLayerByName(layer)
        shapes = [bytes(f.GetGeometryRef().ExportToWkb()) for f in features if f.GetGeometryRef() is not None]
        gaps = [float(o[4:]) for o in options if o.startswith("GAP=")] or [3.0, 1.5]
        for gap in gaps:
            before = {law: tuple(count) for law, count in tally.items()}
            examine(sys.argv[1], name, shapes, gap)
            print(f"{name}, {len(shapes)} features, gap {gap}:", "; ".join(
                f"{law} {count[0] - was[0]} groups, {count[1] - was[1]} with other or more conflicts, {count[2] - was[2]} dearer"
                for law, count in tally.items() for was in [before.get(law, (0, 0, 0))]), flush=True)
    for law, (all_, more, dearer) in tally.items():
        print(f"{law}: {all_} groups, {more} with other or more conflicts, {dearer} dearer")
        if more + dearer > 2 and 100 * (more + dearer) >= all_:
            trouble.append(f"{law}: {more + dearer} of {all_} groups break the law")
    for line in trouble:
        print("BROKEN:", line)
    sys.exit(1 if trouble else 0)


if __name__ == "__main__":
    main()
