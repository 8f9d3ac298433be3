"""The data of rules.py: two layers, barriers, conflicts and anchors, on one lattice of integers, with grids to find
near items."""
from collections import defaultdict

from osgeo import gdal, ogr

import exact_plane as plane

gdal.UseExceptions()
ogr.UseExceptions()
CELL = 32.0  # cell size of the grid, in units of the layer: about the size of a house


class Options:
    def __init__(self, words, gap):
        self.barriers, self.max_shift, self.max_shift_field, self.fixed_where, self.anchors = [], None, None, None, None
        self.tolerance, self.contained = gap / 10, "block"
        self.allow_jumps = self.no_blocks = self.pairs_only = False
        for word in words:
            name, _, value = word.partition("=")
            name = name.replace("-", "_")
            if name == "barrier":
                self.barriers.append(value)
            elif name in ("allow_jumps", "no_blocks", "pairs_only"):
                setattr(self, name, True)
            elif name in ("max_shift", "tolerance"):
                setattr(self, name, float(value))
            elif name in ("max_shift_field", "fixed_where", "anchors", "contained"):
                setattr(self, name, value)
            else:
                raise SystemExit(f"rules.py: {word}?")


def split_spec(spec):
    """Parses the argument of --barrier: `where=` takes the rest, and a comma within a name is written \\, ."""
    spec, _, where = spec.partition(",where=")
    words = [w.replace("\0", ",") for w in spec.replace("\\,", "\0").split(",")]
    found = dict(w.split("=", 1) for w in words[1:])
    return {"path": words[0], "where": where or None, **found}


def polygons_and_lines(geometry):
    """Lists of rings, and lines: chains of pairs of doubles."""
    if geometry is None:
        return [], []
    kind = ogr.GT_Flatten(geometry.GetGeometryType())
    if kind == ogr.wkbPolygon:
        rings = [[p[:2] for p in geometry.GetGeometryRef(i).GetPoints() or []]
                 for i in range(geometry.GetGeometryCount())]
        return [[r[:-1] if r[0] == r[-1] else r for r in rings if r]], []
    if kind in (ogr.wkbLineString, ogr.wkbPoint):
        return [], [[p[:2] for p in geometry.GetPoints() or []]] if geometry.GetPointCount() else []
    parts = [polygons_and_lines(geometry.GetGeometryRef(i)) for i in range(geometry.GetGeometryCount())]
    return [p for polygons, _ in parts for p in polygons], [c for _, lines in parts for c in lines]


def chains(geometry):
    """(rings, lines) of a geometry."""
    polygons, lines = polygons_and_lines(geometry)
    return [r for p in polygons for r in p], lines


def open_layer(path, name, where=None):
    source = gdal.OpenEx(path, gdal.OF_VECTOR)
    layer = source.GetLayerByName(name) if name else source.GetLayer(0)
    if layer is None:
        raise SystemExit(f"rules.py: {path} has no layer {name}")
    if where:
        layer.SetAttributeFilter(where)
    return source, layer


class Lattice:
    """All numbers as integers in units of 2^-k."""

    def __init__(self):
        self.k = 1

    def hold(self, value):
        self.k = max(self.k, value.as_integer_ratio()[1].bit_length() - 1)

    def hold_all(self, lists):
        for one in lists:
            for x, y in one:
                self.hold(x)
                self.hold(y)

    def __call__(self, value):
        n, d = value.as_integer_ratio()
        return n << (self.k - d.bit_length() + 1)

    def outline(self, rings, lines):
        def whole(chain):
            return [(self(x), self(y)) for x, y in chain]
        return plane.Outline([whole(r) for r in rings], [whole(c) for c in lines])


class Grid:
    """An index of items with boxes, by grid cells. Huge items are in a separate list."""

    def __init__(self, size):
        self.size, self.cells, self.large = size, defaultdict(list), []

    def span(self, box):
        return [int(v // self.size) for v in box]

    def add(self, key, box):
        x0, y0, x1, y1 = self.span(box)
        if (x1 - x0 + 1) * (y1 - y0 + 1) > 4096:
            self.large.append(key)
            return
        for x in range(x0, x1 + 1):
            for y in range(y0, y1 + 1):
                self.cells[x, y].append(key)

    def near(self, box):
        x0, y0, x1, y1 = self.span(box)
        found = set(self.large)
        if (x1 - x0 + 1) * (y1 - y0 + 1) > len(self.cells):
            found.update(key for cell in self.cells.values() for key in cell)
            return found
        for x in range(x0, x1 + 1):
            for y in range(y0, y1 + 1):
                found.update(self.cells.get((x, y), ()))
        return found


def widen(box, d):
    return box[0] - d, box[1] - d, box[2] + d, box[3] + d


class Thing:
    """A feature, or a barrier."""


class Layers:
    """All data of a run."""

    def __init__(self, original, result, gap, options):
        self.options, self.original = options, original
        self.lattice = Lattice()
        self.gap = gap
        self.lattice.hold(gap)
        path, _, name = original.partition("|")
        self.was_raw = {} if options.pairs_only else self.read_features(path, name, options.fixed_where)
        path, _, name = result.partition("|")
        self.path, self.name = path, name
        self.is_raw = self.read_features(path, name, None)
        self.barriers_raw = [b for spec in options.barriers for b in self.read_barriers(spec)]
        self.lattice.hold(options.tolerance)
        lat = self.lattice
        self.now, self.was, self.fixed = {}, {}, set()
        for fid, (attributes, rings, lines, _) in self.is_raw.items():
            if attributes.get("sunder_st") == "skipped" or not (rings or lines):
                continue
            thing = Thing()
            thing.shape = lat.outline(rings, lines)
            if thing.shape.box is None:  # a ring of one point
                continue
            self.now[fid] = thing
            thing.block = attributes.get("sunder_blk")
            thing.dx, thing.dy = attributes.get("sunder_dx") or 0.0, attributes.get("sunder_dy") or 0.0
        for fid, (_, rings, lines, fixed) in self.was_raw.items():
            if fid in self.now:
                self.was[fid] = lat.outline(rings, lines)
                if fixed:
                    self.fixed.add(fid)
        self.unit = 2 ** lat.k
        self.size = int(CELL * self.unit)
        self.grid_now = self.index({fid: t.shape for fid, t in self.now.items()})
        self.read_conflicts()
        self.place_barriers()

    def read_features(self, path, name, fixed_where):
        fixed = set()
        if fixed_where:
            source, layer = open_layer(path, name, fixed_where)
            fixed = {f.GetFID() for f in layer}
        source, layer = open_layer(path, name)
        names = [layer.GetLayerDefn().GetFieldDefn(i).GetName() for i in range(layer.GetLayerDefn().GetFieldCount())]
        found = {}
        for f in layer:
            rings, lines = chains(f.GetGeometryRef())
            self.lattice.hold_all(rings + lines)
            attributes = {n: f.GetField(n) for n in names}
            for key in ("sunder_dx", "sunder_dy"):
                self.lattice.hold(attributes.get(key) or 0.0)
            found[attributes.get("sunder_fid", f.GetFID())] = (attributes, rings, lines, f.GetFID() in fixed)
        del source
        return found

    def read_barriers(self, spec):
        words = split_spec(spec)
        source, layer = open_layer(words["path"], words.get("layer"), words["where"])
        gap = float(words["gap"]) if "gap" in words else self.gap
        self.lattice.hold(gap)
        for f in layer:
            rings, lines = chains(f.GetGeometryRef())
            if words.get("as") == "boundary":
                rings, lines = [], lines + [r + r[:1] for r in rings]
            if not rings and not lines:
                continue
            self.lattice.hold_all(rings + lines)
            width = float(words.get("width", 0))
            if "width-field" in words:
                width = f.GetField(words["width-field"]) or 0.0
            width = max(width, 0.0)
            self.lattice.hold(width / 2)
            yield (layer.GetName(), f.GetFID()), rings, lines, width / 2, gap, words.get("side", "yes") == "yes"
        del source

    def index(self, shapes):
        grid = Grid(self.size)
        for key, shape in shapes.items():
            grid.add(key, shape.box)
        return grid

    def place_barriers(self):
        """Puts the edges of barriers into the index, so that the cost of a query depends on the nearby edges only."""
        self.barriers, self.edge_grid, self.owed_most = [], Grid(self.size), 0
        for key, rings, lines, half, gap, with_side in self.barriers_raw:
            thing = Thing()
            thing.key, thing.side = key, with_side
            thing.half = self.lattice(half)
            thing.owed = thing.half + self.lattice(gap)
            thing.shape = self.lattice.outline(rings, lines)
            self.owed_most = max(self.owed_most, thing.owed)
            k = len(self.barriers)
            self.barriers.append(thing)
            for edge in thing.shape.edges:
                self.edge_grid.add((k, edge), plane.edge_box(edge))
        self.areas = Grid(self.size)
        for k, thing in enumerate(self.barriers):
            if thing.shape.area:
                self.areas.add(k, thing.shape.box)

    def near_barriers(self, box, d):
        """The barriers with edges near the box, each with these edges; and those whose area may contain the box."""
        box = widen(box, d)
        found = {k: [] for k in self.areas.near(box) if plane.boxes_near(self.barriers[k].shape.box, box)}
        for k, edge in self.edge_grid.near(box):
            if plane.boxes_near(plane.edge_box(edge), box):
                found.setdefault(k, []).append(edge)
        return found

    def read_conflicts(self):
        self.listed, self.listed_barriers = {}, {}
        try:
            source, layer = open_layer(self.path, self.name + "_conflicts")
        except SystemExit:
            return
        for f in layer:
            word = (f.GetField("kind"), f.GetField("reason"))
            if f.GetField("barrier"):
                self.listed_barriers[f.GetField("fid_a"), f.GetField("barrier"), f.GetField("barr_fid")] = word
            else:
                self.listed[tuple(sorted((f.GetField("fid_a"), f.GetField("fid_b"))))] = word
        del source

    def displacement_anchors(self):
        try:
            source, layer = open_layer(self.path, self.name + "_displacement")
        except SystemExit:
            return {}
        found = {f.GetField("fid"): f.GetGeometryRef().GetPoint_2D(0) for f in layer if f.GetGeometryRef() is not None}
        del source
        return found
