"""Violates each rule of a separated layer ten times (by one unit in the last place if the rule is about a length; by
2^-20 if it is about the direction of a row), and checks that `sunder check --before` reports every violation:

    python3 before_breaches.py SUNDER SOURCE LAYER ROADS GAP LIMIT

ROADS is the argument of --barrier. For the layer as `separate` wrote it no violation may be reported. Violations are
constructed with fractions and exact_plane.py, which share no code with the program."""
import json
import math
import os
import random
import subprocess
import sys
from fractions import Fraction

from osgeo import gdal, ogr

import exact_plane as plane
import row_breaches
import rules_layers

gdal.UseExceptions()
ogr.UseExceptions()
gdal.SetConfigOption("OGR_SQLITE_SYNCHRONOUS", "OFF")
MOVES = ("worse", "limit", "side", "jump", "not_a_translate", "row", "lost")
WANTED = 10
NEAR = 30.0  # neighbours and roads up to this distance from a feature are considered, in units of the layer


def exact(chain):
    return [(Fraction(x), Fraction(y)) for x, y in chain]


def outline(geometry):
    rings, lines = rules_layers.chains(geometry)
    return plane.Outline([exact(r) for r in rings], [exact(c) for c in lines])


def walk(geometry, change):
    """Calls change(x, y) for each vertex; returns False if change() returns None."""
    if geometry.GetGeometryCount():
        return all(walk(geometry.GetGeometryRef(i), change) for i in range(geometry.GetGeometryCount()))
    for i in range(geometry.GetPointCount()):
        at = change(geometry.GetX(i), geometry.GetY(i))
        if at is None:
            return False
        geometry.SetPoint_2D(i, *at)
    return True


def moved(geometry, t):
    """The exact translate, or None if its coordinates are not doubles."""
    def add(x, y):
        at = x + float(t[0]), y + float(t[1])
        return at if (Fraction(at[0]), Fraction(at[1])) == (x + t[0], y + t[1]) else None
    copy = geometry.Clone()
    return copy if walk(copy, add) else None


def unit_of(geometry):
    """A step: for nearly all vertices, multiples of it can be added without rounding. It is one unit in the last
    place of the largest coordinate."""
    x0, x1, y0, y1 = geometry.GetEnvelope()
    return Fraction(math.ulp(max(map(abs, (x0, x1, y0, y1))) + NEAR))


def to_unit(value, unit):
    return round(value / unit) * unit


class Town:
    """The original and the written layer, with the anchors of the features."""

    def __init__(self, source, layer, roads, result):
        self.source, self.layer = rules_layers.open_layer(source, layer)
        self.result, self.written = rules_layers.open_layer(result, layer)
        words = rules_layers.split_spec(roads)
        self.road_source, self.roads = rules_layers.open_layer(words["path"], words["layer"])
        self.row_source, self.rows = rules_layers.open_layer(result, layer + "_rows")
        lines_source, lines = rules_layers.open_layer(result, layer + "_displacement")
        self.anchor = {f.GetField("fid"): f.GetGeometryRef().GetPoints()[0] for f in lines}
        del lines_source
        self.block, self.members, self.move = {}, {}, {}
        for f in self.written:
            self.block[f.GetFID()] = block = f.GetField("sunder_blk")
            self.members[block] = self.members.get(block, ()) + (f.GetFID(),)
            self.move[f.GetFID()] = Fraction(f.GetField("sunder_dx") or 0.0), Fraction(f.GetField("sunder_dy") or 0.0)

    def geometry(self, fid):
        feature = self.layer.GetFeature(fid)  # keep it alive while the result of GetGeometryRef() is in use
        return feature.GetGeometryRef().Clone()

    def valid(self, fid):
        """Is the feature valid? Repaired and skipped features obey the same rules, but are harder to use here."""
        geometry = self.geometry(fid)
        return geometry.GetArea() > 0 and geometry.IsValid()

    def alone(self, fid):
        return self.block[fid] is None

    def body(self, fid):
        return (fid,) if self.alone(fid) else self.members[self.block[fid]]

    def near(self, layer, fid, reach=NEAR):
        x0, x1, y0, y1 = self.geometry(fid).GetEnvelope()
        layer.SetSpatialFilterRect(x0 - reach, y0 - reach, x1 + reach, y1 + reach)
        found = {f.GetFID(): f.GetGeometryRef().Clone() for f in layer if f.GetGeometryRef()}
        layer.SetSpatialFilter(None)
        return found

    def road_edges(self, fid, reach=NEAR):
        return [e for g in self.near(self.roads, fid, reach).values() for e in outline(g).edges if e[0] != e[1]]

    def are_too_near(self, fid, other):
        return plane.nearer(*(outline(self.geometry(f)) for f in (fid, other)), self.gap)


# ---- Violations: each gives the FIDs that must be reported, and the new geometries by FID (None: removed)

def lost(town, fid):
    yield (fid,), {fid: None}


def not_a_translate(town, fid):
    """Moves one vertex, not the first one of its ring, by one unit in the last place. This is no breach if a move by half a
    unit rounds all vertices to their new places, as a tie: to even."""
    geometry, seen, now = town.geometry(fid), [], []

    def nudge(x, y):
        seen.append(x)
        now.append(math.nextafter(x, math.inf) if len(seen) == 2 else x)
        return now[-1], y
    walk(geometry, nudge)
    half = (Fraction(now[1]) - Fraction(seen[1])) / 2
    if any(float(Fraction(x) + half) != at for x, at in zip(seen, now)):
        yield (fid,), {fid: geometry}


def limit(town, fid):
    """The shortest move along an axis that is longer than the limit."""
    unit = unit_of(town.geometry(fid))
    far = (town.limit // unit + 1) * unit
    yield (fid,), {fid: moved(town.geometry(fid), (far, Fraction(0)))}


def crossing_move(unit, anchor, edges, aim):
    """A move that takes the anchor just beyond `aim`: its path meets one of the edges, and a path one unit shorter
    does not."""
    way = aim[0] - anchor[0], aim[1] - anchor[1]
    axis = 0 if abs(way[0]) >= abs(way[1]) else 1

    def at(steps):  # whole units along the longer axis, the other coordinate rounded
        t = [Fraction(0), Fraction(0)]
        t[axis] = steps * unit
        t[1 - axis] = to_unit(way[1 - axis] * t[axis] / way[axis], unit)
        return tuple(t)

    def meets(t):
        leg = anchor, (anchor[0] + t[0], anchor[1] + t[1])
        return any(plane.edges_meet(leg, e) for e in edges)
    if way[axis] == 0:
        return None
    middle = way[axis] // unit
    for steps in sorted(range(int(middle) - 3, int(middle) + 5), key=abs):
        if meets(at(steps)):
            nearer = at(steps - 1 if steps > 0 else steps + 1)
            return at(steps) if not meets(nearer) else None
    return None


def side(town, fid):
    """Moves the anchor onto the nearest road, or just beyond it. The feature met no road at the start."""
    if fid not in town.anchor:
        return
    edges, shape = town.road_edges(fid), outline(town.geometry(fid))
    anchor = exact([town.anchor[fid]])[0]
    if any(plane.interiors_meet(shape, plane.Outline(lines=[list(e)])) for e in edges):
        return
    found = nearest_place(anchor, edges)
    if found:
        t = crossing_move(unit_of(town.geometry(fid)), anchor, edges, found)
        if t:
            yield (fid,), {fid: moved(town.geometry(fid), t)}


def nearest_place(p, edges):
    best = None
    for e in edges:
        u, v = (e[1][0] - e[0][0], e[1][1] - e[0][1]), (p[0] - e[0][0], p[1] - e[0][1])
        s = min(Fraction(1), max(Fraction(0), (u[0] * v[0] + u[1] * v[1]) / (u[0] ** 2 + u[1] ** 2)))
        at = e[0][0] + s * u[0], e[0][1] + s * u[1]
        square = (at[0] - p[0]) ** 2 + (at[1] - p[1]) ** 2
        if best is None or square < best[0]:
            best = square, at
    return best and best[1]


def jump(town, fid):
    """Moves the anchor, relative to a neighbour, onto the neighbour's old outline."""
    if fid not in town.anchor or not town.alone(fid):
        return
    anchor = exact([town.anchor[fid]])[0]
    for other, geometry in town.near(town.layer, fid).items():
        shape = outline(geometry)
        if other == fid or not town.alone(other) or not town.valid(other) or plane.locate(shape, anchor) >= 0:
            continue
        seen = crossing_move(unit_of(town.geometry(fid)), anchor, shape.edges, nearest_place(anchor, shape.edges))
        if seen:
            s = town.move[other]
            yield (fid, other), {fid: moved(town.geometry(fid), (seen[0] + s[0], seen[1] + s[1]))}
            return


def worse(town, fid):
    """Puts two features that are too near back at their original places, one of them one unit nearer to the other."""
    geometry = town.geometry(fid)
    unit, shape = unit_of(geometry), outline(geometry)
    for other, neighbour in town.near(town.layer, fid).items():
        if other == fid or not town.valid(other) or not (town.alone(fid) or town.block[fid] != town.block[other]):
            continue
        theirs = outline(neighbour)
        if not plane.nearer(shape, theirs, town.gap) or plane.interiors_meet(shape, theirs):
            continue
        stood = plane.distance_square(shape, theirs)
        for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1)):
            t = x * unit, y * unit
            if stood > 0 and plane.distance_square(shape.moved(*t), theirs) < stood:
                yield (fid, other), {fid: moved(geometry, t), other: neighbour}
                return


def row(town, fid):
    """Puts a body beyond its place in its row, whose next body is back at its original place. A body is named by its first member.
    Features away from LAYER_rows are left out to save time."""
    if not town.near(town.rows, fid, 0.0):
        return
    unit = unit_of(town.geometry(fid))
    for other, t in row_breaches.moves_beyond(town, fid):
        t = tuple(to_unit(v, unit) for v in t)
        places = {f: moved(town.geometry(f), t) for f in town.body(fid)}
        yield (town.body(fid)[0], other[0]), {**places, **{f: town.geometry(f) for f in other}}


class Layer:
    """Violations that are written into one layer: the FIDs that must be reported, and all new geometries by FID."""

    def __init__(self):
        self.named, self.changed = [], {}

    def take(self, names, change):
        """Adds a violation, unless it concerns a feature that this layer already changes. Returns whether it was added."""
        if self.changed.keys() & (set(names) | change.keys()):
            return False
        self.named.append(names)
        self.changed.update(change)
        return True


def plant(town, rule, draw):
    """Up to WANTED violations, with different features in each layer. Further layers are made only if the first takes too
    few: a town with five rows of three houses has ten pairs of neighbours, and each house in the middle is in two."""
    first, left = Layer(), []
    fids = sorted(f for f in town.block if town.valid(f))
    draw.shuffle(fids)
    for fid in fids[:4000]:
        for names, change in rule(town, fid):
            if None not in change.values() or rule is lost:
                if not first.take(names, change):
                    left.append((names, change))
        if len(first.named) == WANTED:
            return [first]
    layers, planted = [first], set(first.named)
    for names, change in left:
        if len(planted) == WANTED or names in planted:
            continue
        if not any(layer.take(names, change) for layer in layers[1:]):
            layers.append(Layer())
            layers[-1].take(names, change)
        planted.add(names)
    return layers


def write(town, changed, path):
    """The written layer with these features changed."""
    if os.path.exists(path):
        os.remove(path)
    gdal.VectorTranslate(path, town.result, options=f"-f GPKG -preserve_fid {town.written.GetName()}")
    source = ogr.Open(path, 1)
    layer = source.GetLayerByName(town.written.GetName())
    layer.StartTransaction()
    for fid, geometry in changed.items():
        if geometry is None:
            layer.DeleteFeature(fid)
            continue
        feature = layer.GetFeature(fid)
        feature.SetGeometry(geometry)
        layer.SetFeature(feature)
    layer.CommitTransaction()


def breaches(words):
    """(kind, FIDs) of all violations by moves that `check --before` finds; and its counts."""
    done = subprocess.run([*words, "--stats", "b.json"], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 3):
        raise SystemExit(f"check: status {done.returncode}: {done.stderr.strip()}")
    rows = [line.split("\t") for line in done.stdout.splitlines() if line.count("\t") > 5]
    with open("b.json", encoding="utf-8") as f:
        counts = json.load(f)["moves"]
    return {(r[6], frozenset(int(v) for v in (r[0], r[2]) if v)) for r in rows if r[6] in MOVES}, counts


def main():
    sunder, source, layer, roads, gap, bound = sys.argv[1:]
    rules = ["--gap", gap, "--max-shift", bound, "--barrier", roads]
    done = subprocess.run([sunder, "separate", source, "o.gpkg", "-q", "--overwrite", "--input-layer", layer, "--output-layer", layer,
                           *rules], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 3):
        raise SystemExit(f"separate: status {done.returncode}: {done.stderr.strip()}")
    town = Town(source, layer, roads, "o.gpkg")
    town.gap, town.limit = Fraction(float(gap)), Fraction(float(bound))
    check = [sunder, "check", "--before", source, *rules, "--no-blocks", "--block-field", "sunder_blk"]
    trouble, said = 0, []

    def ask(path):
        return breaches([*check, path, "--input-layer", layer])
    found, counts = ask("o.gpkg")
    if found:
        trouble += 1
        print(f"the layer as written: {len(found)} breaches: {sorted((k, sorted(v)) for k, v in found)[:5]}")
    for rule in (lost, not_a_translate, limit, side, jump, row, worse):
        layers = plant(town, rule, random.Random(7))
        for each in layers:
            write(town, each.changed, "p.gpkg")
            found, _ = ask("p.gpkg")
            for names in each.named:
                if not any(kind == rule.__name__ and set(names) <= fids for kind, fids in found):
                    trouble += 1
                    print(f"{rule.__name__} of {names}: not named")
        said.append(f"{rule.__name__} {sum(len(each.named) for each in layers)}")
    print(f"{counts['matched']} matched; planted: {', '.join(said)}")
    return trouble > 0


if __name__ == "__main__":
    sys.exit(main())
