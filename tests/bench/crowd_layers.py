"""Layers in which nearly all features are in conflict: crowds for DISPLACEMENT.md.

    /usr/bin/python3 crowd_layers.py terraces OUT.gpkg N    N houses back to back in blocks of 2 x 16, which share walls
    /usr/bin/python3 crowd_layers.py grid OUT.gpkg N        N squares of 10 m at distances of 12 m, and up to 0.3 m more or less
    /usr/bin/python3 crowd_layers.py row OUT.gpkg N         one row of these

The layer has the kind's name, in EPSG:25832; the same number gives the same features.
"""
import random
import sys

from osgeo import ogr, osr

ogr.UseExceptions()
HOUSES, STREET, BLOCK_WIDE, ROW_DEEP = 16, 12, 6.5, 10
WEST, SOUTH = 400000, 5500000


def terraces(draw, n):
    """x, y, width, depth of houses: blocks separated by streets, in several rows."""
    across = int((n / (2 * HOUSES)) ** 0.5 * 0.45) + 1
    block = 0
    while True:
        left, low = WEST + block % across * (HOUSES * BLOCK_WIDE + STREET), SOUTH + block // across * (2 * ROW_DEEP + STREET)
        for row in range(2):
            x = left + draw.randrange(0, 4) / 2
            for _ in range(HOUSES):
                width, depth = draw.choice([5.5, 6, 6.5]), draw.choice([9, 10, 11]) if row else ROW_DEEP
                yield x, low + ROW_DEEP * row, width, depth
                x += width
        block += 1


def squares(draw, wide):
    k = 0
    while True:
        beside, above = draw.randrange(-3, 4) / 10, draw.randrange(-3, 4) / 10
        yield WEST + 12 * (k % wide) + beside, SOUTH + 12 * (k // wide) + above, 10, 10
        k += 1


def main(kind, path, number):
    n, draw = int(number), random.Random(1)
    boxes = terraces(draw, n) if kind == "terraces" else squares(draw, n if kind == "row" else round(n ** 0.5))
    here = osr.SpatialReference()
    here.ImportFromEPSG(25832)
    source = ogr.GetDriverByName("GPKG").CreateDataSource(path)
    layer = source.CreateLayer(kind, here, ogr.wkbPolygon)
    layer.StartTransaction()
    for _ in range(n):
        x, y, width, depth = next(boxes)
        feature = ogr.Feature(layer.GetLayerDefn())
        feature.SetGeometry(ogr.CreateGeometryFromWkt(
            f"POLYGON(({x} {y},{x + width} {y},{x + width} {y + depth},{x} {y + depth},{x} {y}))"))
        layer.CreateFeature(feature)
    layer.CommitTransaction()


if __name__ == "__main__":
    if len(sys.argv) != 4 or sys.argv[1] not in ("terraces", "grid", "row"):
        sys.exit(__doc__)
    main(*sys.argv[1:])
