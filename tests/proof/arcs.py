"""Arcs as the program takes them: polylines, as ogr2ogr makes them, and a feature of the layer is enlarged until it contains its arcs.

How far the polyline of an arc may be from it is computed in doubles, with the operations of gis/geometry/geometry.c. The feature is
enlarged by a polygon of 16 corners that contains the disc of that radius (gis/layer/shapes.c). Barriers are not enlarged.
"""
import csv
import math
import os
import tempfile
from fractions import Fraction

import discs
from exact import plane
from nearly_in import grown_polygons
from repair import repaired

SEGMENTS, PART, ULPS, EPSILON = 16, 1e-9, 8, 2.0 ** -52


def straighten(layer, linear, converted):
    """Takes the rings and lines of features with curves from `linear`. layer.deviation: {FID: how far an arc may be from its polyline}."""
    told = {fid: own for fid, own in layer.arcs.items() if own}
    lines = iter(polylines([arc for own in told.values() for arc in own], converted))
    for fid in layer.arcs:
        layer.features[fid] = layer.features[fid][0], *linear.features[fid][1:]
    layer.deviation = {fid: max(deviation(arc, next(lines)) for arc in own) for fid, own in told.items()}


def polylines(arcs, converted):
    """Of each arc by itself."""
    with tempfile.TemporaryDirectory() as directory:
        path = os.path.join(directory, "arcs.csv")
        with open(path, "w", encoding="utf-8", newline="") as file:
            rows = csv.writer(file)
            rows.writerow(["WKT", "k"])
            rows.writerows(("CIRCULARSTRING(" + ",".join(f"{x!r} {y!r}" for x, y in arc) + ")", k) for k, arc in enumerate(arcs))
        found = converted(["-nlt", "CONVERT_TO_LINEAR", path], "arcs").features
    return [found[fid][2][0] for fid in sorted(found)]


def distance(p, q):
    return abs(complex(q[0] - p[0], q[1] - p[1]))  # hypot() of the C library; that of Python is another


def deviation(arc, line):
    """An upper bound of the distance between an arc and the chords of its polyline."""
    p, q, r = arc
    twice = abs((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))
    sides = distance(p, q) * distance(q, r) * distance(p, r)
    radius = distance(p, q) / 2 if p == r else sides / (2 * twice) if twice else math.inf
    longest = max(map(distance, line, line[1:]))
    sagitta = 0.0
    if math.isfinite(radius):
        half = longest / 2
        sagitta = half * half / (radius + math.sqrt(max(0.0, radius * radius - half * half)))
        if len(line) == 2 and twice:
            sagitta = max(sagitta, twice / distance(p, r))
    return sagitta + PART * min(radius, longest) + 16 * EPSILON * max(abs(v) for at in arc for v in at)


def enlarge(layer):
    """Enlarges the features that have arcs, after what is invalid is repaired."""
    for fid, radius in layer.deviation.items():
        attributes, polygons, lines = layer.features[fid]
        polygons = [rings for rings in map(repaired, polygons) if rings]
        if polygons:
            layer.features[fid] = attributes, enlarged(polygons, radius), lines


def enlarged(polygons, radius):
    rings = [ring for rings in polygons for ring in rings]
    most = max(abs(v) for ring in rings for p in ring for v in p)
    radius = radius * (1 + PART) + ULPS * (math.nextafter(most, math.inf) - most)
    exact = plane.Outline([[tuple(map(Fraction, p)) for p in ring] for ring in rings])
    return grown_polygons(exact, discs.outside(radius, SEGMENTS), 1)
