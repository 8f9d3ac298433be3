"""Towns with sheets of random gaps, and the distances that their pairs have to keep: an independent reading of the
sheet, with distances by GEOS.

make TOWN.gpkg SHEET.json SEED   writes houses, roads and points, and a sheet with gaps by classes
judge RESULT.gpkg TOWN.gpkg SHEET.json   prints four numbers: all pairs, the pairs that are too near, how many of them
                                         are listed, and all listed pairs; names each that is too near and not listed
"""
import json
import random
import sys

from osgeo import ogr, osr
from shapely import wkb

ogr.UseExceptions()
KINDS, ROADS = ["house", "shed", "church", "it's", None], ["main", "lane", None]
WIDTHS = {"main": 6, "lane": "3m"}
NEAR = 1e-9  # distances by GEOS are rounded


def table(data, name, kind, fields):
    crs = osr.SpatialReference()
    crs.ImportFromEPSG(25832)
    layer = data.CreateLayer(name, crs, kind)
    for field in fields:
        layer.CreateField(ogr.FieldDefn(field, ogr.OFTString))
    return layer


def add(layer, text, **values):
    feature = ogr.Feature(layer.GetLayerDefn())
    for key, value in values.items():
        if value is not None:
            feature[key] = value
    feature.SetGeometry(ogr.CreateGeometryFromWkt(text))
    layer.CreateFeature(feature)


def make(path, sheet, seed):
    rnd = random.Random(int(seed))
    data = ogr.GetDriverByName("GPKG").CreateDataSource(path)
    houses = table(data, "houses", ogr.wkbPolygon, ["kind"])
    roads = table(data, "roads", ogr.wkbLineString, ["class"])
    points = table(data, "points", ogr.wkbPoint, [])
    for _ in range(45):
        x, y, w, h = rnd.uniform(0, 150), rnd.uniform(0, 150), rnd.uniform(6, 14), rnd.uniform(6, 14)
        add(houses, f"POLYGON(({x} {y},{x + w} {y},{x + w} {y + h},{x} {y + h},{x} {y}))", kind=rnd.choice(KINDS))
    for _ in range(6):
        ends = " ,".join(f"{rnd.uniform(-10, 170)} {rnd.uniform(-10, 170)}" for _ in range(3))
        add(roads, f"LINESTRING({ends})", **{"class": rnd.choice(ROADS)})
    for _ in range(10):
        add(points, f"POINT({rnd.uniform(0, 160)} {rnd.uniform(0, 160)})")
    data = None

    def name():
        return rnd.choice(["*", "house", "shed", "church", "it's", "main", "lane", "post"])
    gaps = [{"between": ["*", "*"], "gap": 1}]
    gaps += [{"between": [name(), name()], "gap": round(rnd.uniform(0, 3), 2)} for _ in range(6)]
    with open(sheet, "w", encoding="utf-8") as file:
        file.write("/* Made for a test. */\n")
        json.dump({"defaults": {"max_shift": 8, "no_blocks": True, "rows": "no", "effort": 0.1}, "layers": [
            {"name": "moved", "source": path, "layer": "houses", "role": "move", "class": {"field": "kind"}},
            {"name": "roads", "source": path, "layer": "roads", "role": "barrier", "class": {"field": "class"},
             "width": {"by": "class", "of": WIDTHS, "else": 1}, "side": False},
            {"name": "points", "source": path, "layer": "points", "role": "fixed", "class": "post", "width": 2},
        ], "gaps": gaps}, file)


def gap_of(sheet, one, other):
    """The last rule that matches counts; a class that no rule names matches only the star."""
    gap = 0
    for rule in sheet["gaps"]:
        a, b = rule["between"]
        if (a in ("*", one) and b in ("*", other)) or (a in ("*", other) and b in ("*", one)):
            gap = rule["gap"]
    return gap


def rows(path, layer):
    data = ogr.Open(path)
    return [(f.GetFID(), wkb.loads(bytes(f.GetGeometryRef().ExportToWkb())),
             {f.GetFieldDefnRef(k).GetName(): f.GetField(k) for k in range(f.GetFieldCount())})
            for f in data.GetLayerByName(layer)]


def judge(result, town, path):
    with open(path, encoding="utf-8") as file:
        sheet = json.loads(file.read().split("*/", 1)[1])
    houses = [(fid, shape, values["kind"]) for fid, shape, values in rows(result, "moved")]
    still = [("roads", fid, shape, values["class"], {"main": 6, "lane": 3}.get(values["class"], 1))
             for fid, shape, values in rows(town, "roads")]
    still += [("points", fid, shape, "post", 2) for fid, shape, _ in rows(town, "points")]
    listed = set()
    for _, _, values in rows(result, "moved_conflicts"):
        other = (values["barrier"], values["barr_fid"]) if values["barrier"] else values["fid_b"]
        listed.add((values["fid_a"], other))
    pairs = near = found = 0
    for k, (fid, shape, kind) in enumerate(houses):
        all_of = [(other_fid, other, gap_of(sheet, kind, of)) for other_fid, other, of in houses[:k]]
        all_of += [((layer, i), other, width / 2 + gap_of(sheet, kind, of)) for layer, i, other, of, width in still]
        for key, other, owed in all_of:
            pairs += 1
            apart = shape.distance(other)
            meets = shape.intersection(other).area > NEAR if other.area else shape.buffer(-NEAR).intersects(other)
            if not meets and apart >= owed - NEAR:
                continue
            near += 1
            if (fid, key) in listed or (key, fid) in listed:
                found += 1
            else:
                print(f"not listed: {fid} and {key}: {apart}, has to keep {owed}", file=sys.stderr)
    print(pairs, near, found, len(listed))


if __name__ == "__main__":
    globals()[sys.argv[1]](*sys.argv[2:])
