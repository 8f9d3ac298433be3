#!/usr/bin/env python3
"""Layers that are hard to cut into shards: shard_layouts.py FOLDER writes NAME.geojson for each of the names below.

Coordinates are multiples of an eighth, so walls and overlaps are exact.
"""
import json
import random
import sys


def box(x, y, width, height):
    return [[x, y], [x + width, y], [x + width, y + height], [x, y + height], [x, y]]


def scattered(count, seed, size):
    """Pairs of houses that overlap by a metre or two, spread over a square of that size."""
    dice = random.Random(seed)
    rings = []
    for _ in range(count):
        x, y = dice.randrange(size * 8) / 8, dice.randrange(size * 8) / 8
        rings += [box(x, y, 10, 8), box(x + 9 - dice.randrange(8) / 8, y + dice.randrange(16) / 8, 9, 9)]
    return rings


def chain():
    """A chain in which each house overlaps the next, from one end of the layer to the other and back, bent at each
    end."""
    east = [box(100 + 9 * i, 100 + i / 8, 10, 10) for i in range(90)]
    north = [box(901 + i / 8, 121 + 9 * i, 10, 10) for i in range(90)]
    return east + north


def block():
    """A wall of touching houses around and across everything, and pairs in it that the wall obstructs."""
    wall = [box(20 * i, 0, 20, 10) for i in range(50)] + [box(20 * i, 990, 20, 10) for i in range(50)]
    wall += [box(0, 10 + 20 * i, 10, 20) for i in range(49)] + [box(990, 10 + 20 * i, 10, 20) for i in range(49)]
    wall += [box(10 + 20 * i, 500, 20, 10) for i in range(49)]
    return wall + scattered(60, 3, 960)


def one_place():
    """All features at the same position of the space-filling curve, except one far away."""
    return [box(i % 5, i % 7, 10, 10) for i in range(24)] + [box(100000, 100000, 10, 10)]


def few():
    """Fewer features than shards."""
    return [box(0, 0, 10, 10), box(9, 0, 10, 10), box(5000, 5000, 10, 10)]


def duplicates():
    """Identical features in twos and threes on a grid whose step is a power of two, like the borders of the curve's
    cells."""
    rings = []
    for i in range(8):
        for j in range(8):
            rings += [box(128 * i - 8, 128 * j - 8, 16, 16)] * (2 + (i + j) % 2)
    return rings


def great():
    """Pairs everywhere, one feature that contains them all, and one that crosses them all."""
    return [box(-100, -100, 1300, 1300)] + scattered(80, 5, 1000) + [box(-500, 512, 2000, 1)]


def clusters():
    """Groups of seven to nine, which take several rounds, at all places where a border may be."""
    dice = random.Random(11)
    rings = []
    for i in range(6):
        for j in range(6):
            for _ in range(7 + (i + j) % 3):
                rings.append(box(64 * i + dice.randrange(120) / 8, 64 * j + dice.randrange(120) / 8, 10, 9))
    return rings


def streets():
    """Rows of houses from one end of the layer to the other in both directions, with pairs in them that are too near,
    houses that touch, and one long building between two of the streets."""
    dice = random.Random(13)
    rings = []
    for street in range(8):
        at = 0
        for _ in range(45):
            width, gap = 8 + dice.randrange(16) / 8, dice.choice((0, 1, 2.5, 3, 4, 5, 6, 7))
            side, shift = 60 * street, dice.randrange(12) / 8
            rings.append(box(at, side + shift, width, 9) if street < 5 else box(side - 300 + shift, 260 + at, 9, width))
            at += width + gap
    return rings + [box(100, 192, 300, 8)]


def main():
    for make in (chain, block, one_place, few, duplicates, great, clusters, streets):
        features = []
        for number, ring in enumerate(make()):
            # Block 1: its members are far from each other. Streets have 45 houses; each 17th house has none. Two
            # houses at the ends of each street are a block by the field `ends`.
            properties = {"id": f"f{number}", "blk": 1 if number % 29 == 0 else None, "class": number % 4,
                          "height": 3 + number % 5,
                          "street": f"street {number // 45}" if number % 17 else None,
                          "ends": number // 45 if number % 45 in (3, 40) else None}
            features.append({"type": "Feature", "properties": properties,
                             "geometry": {"type": "Polygon", "coordinates": [ring]}})
        with open(f"{sys.argv[1]}/{make.__name__}.geojson", "w", encoding="utf-8") as file:
            json.dump({"type": "FeatureCollection", "features": features,
                       "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}}}, file)
    with open(f"{sys.argv[1]}/line.geojson", "w", encoding="utf-8") as file:
        # Writes a road and a river through all layouts.
        json.dump({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}},
                   "features": [{"type": "Feature", "properties": {"width": width},
                                 "geometry": {"type": "LineString", "coordinates": points}}
                                for width, points in ((6, [[-600, -600], [480, 505], [1600, 1600]]),
                                                      (3, [[-600, 506], [1600, 507]]), (4, [[512, -600], [515, 1600]]))]}, file)


main()
