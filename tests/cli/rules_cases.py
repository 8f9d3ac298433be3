"""Does rules.py report breaches? Small layers with results made by hand, each with the expected breaches: python3
rules_cases.py"""
import os
import sys

from osgeo import gdal, ogr

import rules

gdal.UseExceptions()
ogr.UseExceptions()
gdal.SetConfigOption("OGR_SQLITE_SYNCHRONOUS", "OFF")


def box(x, y, w=4, h=4):
    return f"POLYGON (({x} {y},{x + w} {y},{x + w} {y + h},{x} {y + h},{x} {y}))"


def write(path, layers):
    """layers: name -> (fields, [(wkt, values)])."""
    if os.path.exists(path):
        os.remove(path)
    source = ogr.GetDriverByName("GPKG").CreateDataSource(path)
    for name, (fields, rows) in layers.items():
        layer = source.CreateLayer(name, None, ogr.wkbUnknown)
        for field, kind in fields:
            layer.CreateField(ogr.FieldDefn(field, kind))
        for wkt, values in rows:
            feature = ogr.Feature(layer.GetLayerDefn())
            feature.SetGeometry(ogr.CreateGeometryFromWkt(wkt) if isinstance(wkt, str) else wkt)
            for (field, _), value in zip(fields, values):
                if value is not None:
                    feature.SetField(field, value)
            layer.CreateFeature(feature)


def moved(wkt, dx, dy):
    def walk(g):
        for i in range(g.GetGeometryCount()):
            walk(g.GetGeometryRef(i))
        if g.GetGeometryCount() == 0:
            for i in range(g.GetPointCount()):
                g.SetPoint_2D(i, g.GetX(i) + dx, g.GetY(i) + dy)
    geometry = ogr.CreateGeometryFromWkt(wkt)
    walk(geometry)
    return geometry


REAL, WORD, WHOLE = ogr.OFTReal, ogr.OFTString, ogr.OFTInteger64
RESULT = [("sunder_dx", REAL), ("sunder_dy", REAL), ("sunder_st", WORD), ("sunder_blk", WHOLE)]
CONFLICT = [("fid_a", WHOLE), ("fid_b", WHOLE), ("barrier", WORD), ("barr_fid", WHOLE), ("kind", WORD),
            ("reason", WORD)]
failed = 0


def case(name, wanted, houses, gap=1, listed=(), roads=(), words=(), bent=None, left_out=()):
    """houses: (wkt, dx, dy[, block]); bent: FID -> the geometry to write instead of the translate."""
    write("was.gpkg", {"h": ([], [(h[0], ()) for h in houses]), "roads": ([], [(r, ()) for r in roads])})
    rows = []
    for k, (wkt, dx, dy, *block) in enumerate(houses, 1):
        rows.append(((bent or {}).get(k, moved(wkt, dx, dy)), (dx, dy, "moved", block[0] if block else None)))
    rows = [row for k, row in enumerate(rows, 1) if k not in left_out]
    write("is.gpkg", {"h": (RESULT, rows), "h_conflicts": (CONFLICT, [("POINT (0 0)", row) for row in listed])})
    words = ["tolerance=0", *(w.replace("ROADS", "was.gpkg,layer=roads") for w in words)]
    breaches = rules.check("was.gpkg|h", "is.gpkg|h", float(gap), words).breaches
    got = sorted({line.split("\t")[0] for line in breaches})
    if got != sorted(wanted):
        global failed
        failed += 1
        print(f"{name}: {got}, not {sorted(wanted)}", *breaches, sep="\n")


def pair(*, kind="too_close", reason="unresolved", a=1, b=2):
    return (a, b, None, None, kind, reason)


def at_road(*, kind="barrier", a=1):
    return (a, None, "roads", 1, kind, "unresolved")


two = [(box(0, 0), 0, 0), (box(4.5, 0), 0.5, 0)]
case("apart", [], two)
case("an ulp too near", ["unlisted"], [two[0], (box(4.5, 0), 0.5 - 2**-50, 0)])
case("overlap", ["unlisted"], [two[0], (box(3, 0), 0, 0)], gap=0)
case("touch at gap 0", [], [two[0], (box(4, 0), 0, 0)], gap=0, words=["no-blocks"])
case("one in the other", ["unlisted"], [(box(0, 0), 0, 0), (box(1, 1, 2, 2), 0, 0)], gap=0, words=["contained=separate"])
case("one in the other, ignored", [], [(box(0, 0), 0, 0), (box(1, 1, 2, 2), 0, 0)], gap=0, words=["contained=ignore"])
case("listed", [], [two[0], (box(4.5, 0), 0, 0)], listed=[pair()])
case("listed for nothing", ["phantom"], two, listed=[pair()])
case("listed and nearer", ["worse"], [two[0], (box(4.5, 0), -0.25, 0)], listed=[pair()])
case("listed and farther", [], [two[0], (box(4.5, 0), 0.25, 0)], listed=[pair()])
case("listed, along each other", [], [two[0], (box(4.5, 0), 0, 1)], listed=[pair()])
case("listed and deeper", ["worse"], [two[0], (box(3, 0), -0.5, 0)], listed=[pair(kind="overlap")])
case("listed, less deep", [], [two[0], (box(3, 0), 0.5, 0)], listed=[pair(kind="overlap")])
case("listed, from beside to upon", ["worse"], [two[0], (box(4.5, 0), -1, 0)], listed=[pair(kind="overlap")])
case("a corner bent by an ulp", ["not_a_translate"], two,
     bent={1: box(0, 0).replace("0 4", "-0.000000000000001 4")})
case("other moves than said", ["not_a_translate"], two, bent={2: moved(box(4.5, 0), 0.75, 0)})
case("one lost", ["lost"], two, left_out=[2])
case("too far", ["limit"], two, words=["max-shift=0.25"])
case("as far as it may", [], two, words=["max-shift=0.5"])
case("fixed", ["limit"], two, words=["fixed-where=fid=2"])
case("a torn block", ["torn"], [(box(0, 0), 0, 0, 1), (box(4, 0), 0, 0.5, 1)])
case("touching, not joined", ["unjoined"], [(box(0, 0), 0, 0), (box(4, 0), 0, 0)], gap=0)
case("in each other, not joined", ["unjoined", "unlisted"], [(box(0, 0), 0, 0), (box(1, 1, 2, 2), 0, 0)], gap=0)
case("within the tolerance, not joined", ["unjoined"], [(box(0, 0), 0, 0), (box(4.125, 0), 1, 0)],
     words=["tolerance=0.125"])
case("over a neighbour", ["jump"], [(box(0, 0), 12, 0), (box(6, 0), 0, 0)])
case("over a neighbour, allowed", [], [(box(0, 0), 12, 0), (box(6, 0), 0, 0)], words=["allow-jumps"])
case("over a neighbour that moves", ["jump"], [(box(0, 0), 12, 0), (box(6, 0), 0, 1)])
case("where a neighbour stood", [], [(box(0, 0), 6, 0), (box(6, 0), 0, 6)])
case("a neighbour goes ahead", [], [(box(0, 0), 6, 0), (box(6, 0), 6, 0)])
case("a neighbour comes over", ["jump"], [(box(0, 0), 0, 0), (box(6, 0), -12, 0)])
yard = "POLYGON ((-10 -10,20 -10,20 20,-10 20,-10 -10),(-6 -6,16 -6,16 16,-6 16,-6 -6))"
case("within a yard", [], [(box(0, 0), 5, 0), (yard, 0, 0)], words=["contained=ignore"])
case("out of a yard", ["jump"], [(box(0, 0), 40, 0), (yard, 0, 0)], words=["contained=ignore"])
road = ["LINESTRING (2 -50,2 50)"]
barrier = ["barrier=ROADS,width=2,gap=0.5,side=no"]
case("on a road", ["unlisted"], [(box(0, 0), 0, 0)], roads=road, words=barrier)
case("on a road, listed", [], [(box(0, 0), 0, 0)], roads=road, words=barrier, listed=[at_road()])
case("off the road", [], [(box(0, 0), 3.5, 0)], roads=road, words=barrier + ["allow-jumps"])
case("nearly off the road", ["unlisted"], [(box(0, 0), 3.25, 0)], roads=road, words=barrier)
case("beside it, listed as upon", ["phantom"], [(box(0, 0), 3.25, 0)], roads=road, words=barrier, listed=[at_road()])
case("deeper on a road", ["worse"], [(box(1, 0), -0.75, 0)], roads=road, words=barrier, listed=[at_road()])
case("less deep on a road", [], [(box(1, 0), 0.75, 0)], roads=road, words=barrier, listed=[at_road()])
case("nearer to a road", ["worse"], [(box(3, 0), -0.5, 0)], roads=road, words=barrier,
     listed=[at_road(kind="barrier_drawn")])
case("at the edge of what is drawn", [], [(box(3, 0), 0, 0)], roads=road, words=barrier,
     listed=[at_road(kind="barrier_near")])
case("an ulp within what is drawn", [], [(box(3 - 2**-50, 0), 0, 0)], roads=road, words=barrier,
     listed=[at_road(kind="barrier_drawn")])
case("on what is drawn, listed as near", ["phantom"], [(box(2.5, 0), 0, 0)], roads=road, words=barrier,
     listed=[at_road(kind="barrier_near")])
case("along a road at no distance", [], [(box(2, 0), 0, 0)], roads=road, words=["barrier=ROADS,gap=0,side=no"])
case("a road that ends inside", ["unlisted"], [(box(0, 0), 0, 0)], roads=["LINESTRING (2 2,2 50)"],
     words=["barrier=ROADS,gap=0,side=no"])
case("a post inside", ["unlisted"], [(box(0, 0), 0, 0)], roads=["POINT (1 3)"], words=["barrier=ROADS,gap=0,side=no"])
case("a post at the wall", [], [(box(0, 0), 0, 0)], roads=["POINT (0 3)"], words=["barrier=ROADS,gap=0,side=no"])
case("in a lake", ["unlisted"], [(box(0, 0), 0, 0)], roads=[box(-9, -9, 30, 30)], words=["barrier=ROADS,gap=0,side=no"])
case("round a pond", ["unlisted"], [(box(0, 0), 0, 0)], roads=[box(1, 1, 1, 1)], words=["barrier=ROADS,gap=0,side=no"])
case("in a parcel", [], [(box(0, 0), 0, 0)], roads=[box(-9, -9, 30, 30)], words=["barrier=ROADS,gap=0,side=no,as=boundary"])
case("over a parcel's boundary", ["unlisted"], [(box(0, 0), 0, 0)], roads=[box(1, -9, 30, 30)],
     words=["barrier=ROADS,gap=0,side=no,as=boundary"])
sides = ["barrier=ROADS,gap=0"]
case("along a road", [], [(box(-5, 0), 0, 9)], roads=road, words=sides)
case("across a road", ["side"], [(box(-5, 0), 9, 0)], roads=road, words=sides)
case("across a road, allowed", [], [(box(-5, 0), 9, 0)], roads=road, words=["barrier=ROADS,gap=0,side=no"])
case("round the end of a road", ["side"], [(box(-5, 0), 9, 0)], roads=["LINESTRING (2 0,2 2)"], words=sides)
case("past the end of a road", [], [(box(-5, 0), 9, 0)], roads=["LINESTRING (2 0,2 1)"], words=sides)
case("into a lake", ["side", "unlisted"], [(box(-5, 0), 9, 0)], roads=[box(2, -9, 30, 30)], words=sides)
case("over a pond", ["side"], [(box(-5, 0), 15, 0)], roads=[box(2, 1, 2, 2)], words=sides)
case("out of a lake", [], [(box(-5, 0), 9, 0)], roads=[box(-29, -9, 31, 30)], words=sides)
horseshoe = "POLYGON ((-10 -10,10 -10,10 10,8 10,8 -2,2 -2,2 10,-10 10,-10 -10))"
case("out of a lake and into its arm", ["side"], [(box(-5, 0), 16, 0)], roads=[horseshoe], words=sides)
case("out of a lake's arm", ["unlisted"], [(box(-5, 0), 6, 0)], roads=[horseshoe], words=sides)
free = ["barrier=ROADS,gap=0", "allow-jumps"]
cut = [(box(0, 0), 3, 0)]
case("cut, to where most of it is", [], cut, roads=["LINESTRING (1 -9,1 9)"], words=free)
case("cut, to where little of it is", ["side"], [(box(0, 0), -3, 0)], roads=["LINESTRING (1 -9,1 9)"], words=free)
case("cut in halves, to the right", ["side"], [(box(0, 0), 2, 0)], roads=road, words=free)
case("cut in halves, to the left", [], [(box(0, 0), -2, 0)], roads=road, words=free)
case("cut by two, out of the middle", ["side"], [(box(0, 0), 0, 9)], roads=["LINESTRING (1 -9,1 5,9 5)", "LINESTRING (3 -9,3 9)"],
     words=free)
case("in a ring", ["side"], [(box(0, 0), 9, 0)], roads=["LINESTRING (-9 2,0.5 0.5,3.5 0.5,3.5 3.5,0.5 3.5,0.5 0.5)"], words=free)
case("an end that points at the anchor", [], [(box(0, 0), 3, 0)], roads=["LINESTRING (-9 2,1 2)"], words=free)
case("an end beyond the anchor", ["side"], [(box(0, 0), 0, 5)], roads=["LINESTRING (-9 2.5,3 2.5)"], words=free)
case("along an edge", [], [(box(0, 0), 3, 0)], roads=["LINESTRING (0 -9,0 9)"], words=free)
case("along an edge, across", ["side"], [(box(0, 0), -4, 0)], roads=["LINESTRING (0 -9,0 9)"], words=free)
sys.exit(1 if failed else 0)
