"""Towns with sheets of random gaps, and the distances that their pairs have to keep: an independent reading of the
sheet, with distances by GEOS.

make TOWN.gpkg SHEET.json SEED [together]   writes houses, roads and points, and a sheet with gaps by classes; together:
                                            houses, sheds and points move, the points as squares
judge RESULT.gpkg TOWN.gpkg SHEET.json   prints four numbers: all pairs, the pairs that are too near, how many of them
                                         are listed, and all listed pairs; names each that is too near and not listed
"""
import json
import random
import sys

from osgeo import ogr, osr
from shapely import affinity, wkb

ogr.UseExceptions()
KINDS, ROADS = ["house", "shed", "church", "it's", None], ["main", "lane", None]
WIDTHS = {"main": 6, "lane": "3m"}
SYMBOL = 4
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


def box(rnd, least, most):
    x, y, w, h = rnd.uniform(0, 150), rnd.uniform(0, 150), rnd.uniform(least, most), rnd.uniform(least, most)
    return f"POLYGON(({x} {y},{x + w} {y},{x + w} {y + h},{x} {y + h},{x} {y}))"


def moving_layers(path, together):
    houses = {"name": "moved", "source": path, "layer": "houses", "role": "move", "class": {"field": "kind"}}
    if not together:
        return [houses]
    return [{"name": "marks", "source": path, "layer": "points", "role": "move", "class": "post",
             "symbol": f"square:{SYMBOL}", "max_shift": 15}, houses,
            {"name": "sheds", "source": path, "layer": "sheds", "role": "move", "class": "shed", "allow_jumps": True,
             "weight_field": "weight"}]


def make(path, sheet, seed, together=None):
    rnd = random.Random(int(seed))
    data = ogr.GetDriverByName("GPKG").CreateDataSource(path)
    houses = table(data, "houses", ogr.wkbPolygon, ["kind"])
    roads = table(data, "roads", ogr.wkbLineString, ["class"])
    points = table(data, "points", ogr.wkbPoint, [])
    for _ in range(45):
        add(houses, box(rnd, 6, 14), kind=rnd.choice(KINDS))
    for _ in range(6):
        ends = " ,".join(f"{rnd.uniform(-10, 170)} {rnd.uniform(-10, 170)}" for _ in range(3))
        add(roads, f"LINESTRING({ends})", **{"class": rnd.choice(ROADS)})
    for _ in range(10):
        add(points, f"POINT({rnd.uniform(0, 160)} {rnd.uniform(0, 160)})")
    if together:
        sheds = table(data, "sheds", ogr.wkbPolygon, [])
        sheds.CreateField(ogr.FieldDefn("weight", ogr.OFTReal))
        for _ in range(12):
            add(sheds, box(rnd, 2, 6), weight=rnd.uniform(0.5, 2))
    data = None

    def name():
        return rnd.choice(["*", "house", "shed", "church", "it's", "main", "lane", "post"])
    gaps = [{"between": ["*", "*"], "gap": 1}]
    gaps += [{"between": [name(), name()], "gap": round(rnd.uniform(0, 3), 2)} for _ in range(6)]
    layers = moving_layers(path, together) + [
        {"name": "roads", "source": path, "layer": "roads", "role": "barrier", "class": {"field": "class"},
         "width": {"by": "class", "of": WIDTHS, "else": 1}, "side": False}]
    if not together:
        layers.append({"name": "points", "source": path, "layer": "points", "role": "fixed", "class": "post",
                       "width": 2})
    with open(sheet, "w", encoding="utf-8") as file:
        file.write("/* Made for a test. */\n")
        json.dump({"defaults": {"max_shift": 8, "no_blocks": True, "rows": "no", "effort": 0.1}, "layers": layers,
                   "gaps": gaps}, file)


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


def moved_features(result, sheet):
    """Key, shape and class of each feature that moves. The key has the layer if several layers move."""
    moving = [layer for layer in sheet["layers"] if layer["role"] == "move"]
    out = []
    for layer in moving:
        name, of = layer["name"], layer["class"]
        drawn = rows(result, name + "_symbols" if "symbol" in layer else name)
        kinds = {fid: values[of["field"]] if isinstance(of, dict) else of for fid, _, values in rows(result, name)}
        out += [((name, fid) if len(moving) > 1 else fid, shape, kinds[fid]) for fid, shape, _ in drawn]
    return out


def other_of(values):
    if values["barrier"]:
        return values["barrier"], values["barr_fid"]
    return (values["layer_b"], values["fid_b"]) if "layer_b" in values else values["fid_b"]


def judge(result, town, path):
    with open(path, encoding="utf-8") as file:
        sheet = json.loads(file.read().split("*/", 1)[1])
    houses = moved_features(result, sheet)
    names, still = [layer["name"] for layer in sheet["layers"]], []
    if "roads" in names:
        still += [("roads", fid, shape, values["class"], {"main": 6, "lane": 3}.get(values["class"], 1))
                  for fid, shape, values in rows(town, "roads")]
    if "points" in names:
        still += [("points", fid, shape, "post", 2) for fid, shape, _ in rows(town, "points")]
    together = sum(layer["role"] == "move" for layer in sheet["layers"]) > 1
    stem = path.rsplit(".", 1)[0] if together else "moved"
    listed = set()
    for _, _, values in rows(result, stem + "_conflicts"):
        listed.add(((values["layer_a"], values["fid_a"]) if together else values["fid_a"], other_of(values)))
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


def kept(result, town, path):
    """Every feature of each layer that moves is there, with its attributes, moved by what its fields say."""
    with open(path, encoding="utf-8") as file:
        sheet = json.loads(file.read().split("*/", 1)[1])
    arrows = {}
    for _, _, values in rows(result, path.rsplit(".", 1)[0] + "_displacement"):
        arrows[values["layer_a"], values["fid"]] = values["dx"], values["dy"]
    for layer in sheet["layers"]:
        if layer["role"] != "move":
            continue
        was, now = rows(town, layer["layer"]), rows(result, layer["name"])
        if [fid for fid, _, _ in was] != [fid for fid, _, _ in now]:
            sys.exit(f"{layer['name']}: features are missing")
        for (fid, before, of), (_, after, values) in zip(was, now):
            dx, dy = values["sunder_dx"], values["sunder_dy"]
            if any(values[key] != of[key] for key in of) or arrows.get((layer["name"], fid), (0, 0)) != (dx, dy):
                sys.exit(f"{layer['name']} {fid}: other attributes, or another arrow")
            if dx * dx + dy * dy > layer.get("max_shift", sheet["defaults"].get("max_shift", float("inf"))) ** 2:
                sys.exit(f"{layer['name']} {fid}: it moved too far")
            if after.wkb != affinity.translate(before, dx, dy).wkb:
                sys.exit(f"{layer['name']} {fid}: it is no translate")


if __name__ == "__main__":
    globals()[sys.argv[1]](*sys.argv[2:])
