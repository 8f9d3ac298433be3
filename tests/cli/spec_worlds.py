"""Towns with sheets of random gaps, and the distances that their pairs have to keep: an independent reading of the
sheet, with distances by GEOS.

make TOWN.gpkg SHEET.json SEED [together]   writes houses, roads and points, and a sheet with gaps by classes; together:
                                            houses, sheds and points move, the points as squares
make_agency TOWN.gpkg SEED               writes what docs/examples/topographic_100000.json asks for
smaller RESULT.gpkg TOWN.gpkg SHEET.json asks that smaller shapes lie in those of before
judge RESULT.gpkg TOWN.gpkg SHEET.json   prints four numbers: all pairs, the pairs that are too near, how many of them
                                         are listed, and all listed pairs; names each that is too near and not listed.
                                         A distance of two features that is close to their gap is decided in rationals.
"""
import json
import random
import re
import sys
from fractions import Fraction

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


def make_agency(path, seed):
    rnd = random.Random(int(seed))
    data = ogr.GetDriverByName("GPKG").CreateDataSource(path)
    buildings, symbols = table(data, "buildings", ogr.wkbPolygon, []), table(data, "symbols", ogr.wkbPoint, ["symbol"])
    roads = table(data, "roads", ogr.wkbLineString, ["class"])
    for layer in (buildings, symbols):
        layer.CreateField(ogr.FieldDefn("hierarchy", ogr.OFTInteger))

    def at():
        return rnd.uniform(0, 2400)
    for _ in range(60):
        x, y, w, h = at(), at(), rnd.uniform(20, 120), rnd.uniform(20, 120)
        add(buildings, f"POLYGON(({x} {y},{x + w} {y},{x + w} {y + h},{x} {y + h},{x} {y}))", hierarchy=rnd.choice([1, 2, 3]))
    for _ in range(30):
        symbol = rnd.choice([None, "square:75m", "square:145m", "square:175m"])
        add(symbols, f"POINT({at()} {at()})", symbol=symbol, hierarchy=rnd.choice([1, 2, 3]))
    for kind in ("motorway", "main", "regional", "local", "path", None):
        ends = " ,".join(f"{at()} {at()}" for _ in range(3))
        add(roads, f"LINESTRING({ends})", **{"class": kind})
    data = None


def read_sheet(path):
    with open(path, encoding="utf-8") as file:
        return json.loads(re.sub(r"//[^\n]*|/\*.*?\*/", "", file.read(), flags=re.DOTALL))


def metres(length):
    return float(str(length).removesuffix("m"))


def gap_of(sheet, one, other):
    """The last rule that matches counts; a class that no rule names matches only the star."""
    gap = 0
    for rule in sheet["gaps"]:
        a, b = rule["between"]
        if (a in ("*", one) and b in ("*", other)) or (a in ("*", other) and b in ("*", one)):
            gap = metres(rule["gap"])
    return gap


def class_of(layer, values):
    of = layer.get("class", layer["name"])
    return values[of["field"]] if isinstance(of, dict) else of


def width_of(layer, values):
    width = layer.get("width", 0)
    return metres(width["of"].get(values[width["by"]], width["else"]) if isinstance(width, dict) else width)


def rows(path, layer):
    data = ogr.Open(path)
    return [(f.GetFID(), wkb.loads(bytes(f.GetGeometryRef().ExportToWkb())),
             {f.GetFieldDefnRef(k).GetName(): f.GetField(k) for k in range(f.GetFieldCount())})
            for f in data.GetLayerByName(layer)]


def moved_features(result, sheet):
    """Key, shape and class of each feature that moves and is not hidden. The key has the layer if several layers move."""
    moving = [layer for layer in sheet["layers"] if layer["role"] == "move"]
    out = []
    for layer in moving:
        name, kinds = layer["name"], {}
        drawn = rows(result, name + "_symbols" if "symbol" in layer else name)
        for fid, _, values in rows(result, name):
            if not values.get("sunder_inv"):
                kinds[fid] = class_of(layer, values)
        out += [((name, fid) if len(moving) > 1 else fid, shape, kinds[fid]) for fid, shape, _ in drawn if fid in kinds]
    return out


def segments(shape):
    xy = [tuple(map(Fraction, p)) for p in shape.exterior.coords]
    return list(zip(xy, xy[1:]))


def off_segment(p, segment):
    """The squared distance of a point from a segment, in rationals."""
    (ax, ay), (bx, by) = segment
    dx, dy = bx - ax, by - ay
    along = max(Fraction(0), min(Fraction(1), ((p[0] - ax) * dx + (p[1] - ay) * dy) / (dx * dx + dy * dy)))
    return (p[0] - ax - along * dx) ** 2 + (p[1] - ay - along * dy) ** 2


def are_apart(a, b, gap):
    """Do two polygons whose interiors are disjoint keep their gap? Exactly: then no two of their edges cross, so a vertex
    of one of them is nearest."""
    one, other = segments(a), segments(b)
    least = min(off_segment(p[0], s) for x, y in ((one, other), (other, one)) for p in x for s in y)
    return least >= Fraction(gap) ** 2


def other_of(values):
    if values["barrier"]:
        return values["barrier"], values["barr_fid"]
    return (values["layer_b"], values["fid_b"]) if "layer_b" in values else values["fid_b"]


def judge(result, town, path):
    sheet = read_sheet(path)
    houses, still = moved_features(result, sheet), []
    for layer in sheet["layers"]:
        if layer["role"] != "move":
            still += [((layer["name"], fid), shape, class_of(layer, values), width_of(layer, values))
                      for fid, shape, values in rows(town, layer["layer"])]
    together = sum(layer["role"] == "move" for layer in sheet["layers"]) > 1
    stem = path.rsplit(".", 1)[0] if together else "moved"
    listed = set()
    for _, _, values in rows(result, stem + "_conflicts"):
        listed.add(((values["layer_a"], values["fid_a"]) if together else values["fid_a"], other_of(values)))
    pairs = near = found = 0
    for k, (fid, shape, kind) in enumerate(houses):
        all_of = [(other_fid, other, gap_of(sheet, kind, of), True) for other_fid, other, of in houses[:k]]
        all_of += [(key, other, width / 2 + gap_of(sheet, kind, of), False) for key, other, of, width in still]
        for key, other, owed, exactly in all_of:
            pairs += 1
            apart = shape.distance(other)
            meets = shape.intersection(other).area > NEAR if other.area else shape.buffer(-NEAR).intersects(other)
            if exactly and not meets and abs(apart - owed) < 1e-6:
                if are_apart(shape, other, owed):
                    continue
            elif not meets and apart >= owed - NEAR:
                continue
            near += 1
            if (fid, key) in listed or (key, fid) in listed:
                found += 1
            else:
                print(f"not listed: {fid} and {key}: {apart}, has to keep {owed}", file=sys.stderr)
    print(pairs, near, found, len(listed))


def kept(result, town, path):
    """Every feature of each layer that moves is there, with its attributes, moved by what its fields say."""
    sheet = read_sheet(path)
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
            if dx * dx + dy * dy > metres(layer.get("max_shift", sheet["defaults"].get("max_shift", "inf"))) ** 2:
                sys.exit(f"{layer['name']} {fid}: it moved too far")
            if after.wkb != affinity.translate(before, dx, dy).wkb:
                sys.exit(f"{layer['name']} {fid}: it is no translate")


def smaller(result, town, path):
    """Every feature has its shape, moved, or a smaller one of at least the least size of its layer, within that shape."""
    for layer in read_sheet(path)["layers"]:
        if layer["role"] != "move":
            continue
        was = {fid: shape for fid, shape, _ in rows(town, layer["layer"])}
        for fid, after, values in rows(result, layer["name"]):
            home = affinity.translate(was[fid], values["sunder_dx"], values["sunder_dy"])
            if values["sunder_lvl"] == 0 and after.wkb != home.wkb:
                sys.exit(f"{layer['name']} {fid}: it is no translate")
            if values["sunder_lvl"] and (after.difference(home).area > NEAR or not after.area < home.area):
                sys.exit(f"{layer['name']} {fid}: its shape does not lie in that of before")
            if values["sunder_lvl"] and not after.buffer(-layer.get("min_size", 0) / 2 * 0.99).area > 0:
                sys.exit(f"{layer['name']} {fid}: no disc of the least size lies in it")


if __name__ == "__main__":
    globals()[sys.argv[1]](*sys.argv[2:])
