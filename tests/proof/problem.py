"""What a proof is about, from the input: things on one lattice of integers, what they owe each other, which of them move,
how far, and at what price. Nothing of this is taken from the proof but for anchors, and those blocks that touch and overlap
in ways that are not asked about here; see docs/PROOF.md."""
import math
import os
import re
import sys
from fractions import Fraction

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
import exact_plane as plane  # noqa: E402
import geopackage  # noqa: E402
from cover import hull  # noqa: E402
from nearly_in import nearly_in  # noqa: E402
from repair import repaired  # noqa: E402


class Refused(Exception):
    """Something in the proof does not hold."""


def demand(condition, *words):
    if not condition:
        raise Refused(" ".join(map(str, words)))


def split_spec(spec):
    """--barrier's argument; `where=` takes the rest, a comma that belongs to a name is written \\, ."""
    spec, _, where = spec.partition(",where=")
    words = [w.replace("\0", ",") for w in spec.replace("\\,", "\0").split(",")]
    return {"path": words[0], "where": where or None, **dict(w.split("=", 1) for w in words[1:])}


class Thing:
    """A feature, or a barrier: polygons (lists of rings) and lines, in integers."""

    def __init__(self, lattice, polygons, lines):
        self.polygons = [[[lattice.point(p) for p in ring] for ring in polygon] for polygon in polygons]
        self.lines = [[lattice.point(p) for p in line] for line in lines]
        self.edges = [plane.Outline(p).edges for p in self.polygons]
        self.outlines = [plane.Outline(p) for p in self.polygons]
        self.parts = {}

    def whole(self):
        return plane.Outline([r for p in self.polygons for r in p], self.lines)

    def holds_place(self, p):
        return any(o.box and plane.locate(o, p) >= 0 for o in self.outlines)

    def has_part(self, part):
        """Does the convex hull of these corners lie in it?"""
        if part not in self.parts:
            corners = hull(part)
            self.parts[part] = (any(in_polygon(corners, o) for o in self.outlines if o.box) if len(corners) > 2 else
                                self.has_segment(corners))
        return self.parts[part]

    def has_segment(self, ends):
        segments = [(p, q) for line in self.lines for p, q in zip(line, line[1:] or line)]
        return any(all(plane.on_edge(s, p) for p in ends) for s in segments)


def in_polygon(corners, outline):
    """A convex polygon with area within a polygon: no edge goes through it, and a place of it is inside."""
    box = plane.box_of(corners)
    sides = list(zip(corners, corners[1:] + corners[:1]))
    for edge in plane.near_edges(outline, box):
        if goes_through(edge, sides):
            return False
    n = len(corners)
    middle = sum(p[0] for p in corners), sum(p[1] for p in corners)
    return plane.locate(outline.scaled(n), middle) > 0


def in_union(corners, outlines):
    """A convex polygon with area within the union of polygons: cut along an edge that goes through it, until none does."""
    if any(in_polygon(corners, o) for o in outlines):
        return True
    box, sides = plane.box_of(corners), list(zip(corners, corners[1:] + corners[:1]))
    for edge in (e for o in outlines for e in plane.near_edges(o, box)):
        if goes_through(edge, sides):
            return in_union(left_of(edge, sides), outlines) and in_union(left_of(edge[::-1], sides), outlines)
    return False


def left_of(edge, sides):
    """What of a convex polygon is on the left of the edge's line, which goes through it."""
    (ax, ay), (bx, by) = edge
    found = []
    for p, q in sides:
        s, t = ((bx - ax) * (v[1] - ay) - (by - ay) * (v[0] - ax) for v in (p, q))
        if s >= 0:
            found.append(p)
        if s * t < 0:
            share = Fraction(s, s - t)
            found.append((p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1])))
    return found


def goes_through(edge, sides):
    """Does the segment meet the open convex polygon with these sides?"""
    (ax, ay), (bx, by) = edge
    low, high = Fraction(0), Fraction(1)
    for (px, py), (qx, qy) in sides:
        ex, ey = qx - px, qy - py
        at = ex * (ay - py) - ey * (ax - px)
        slope = ex * (by - ay) - ey * (bx - ax)
        if slope == 0:
            if at <= 0:
                return False
        elif slope > 0:
            low = max(low, Fraction(-at, slope))
        else:
            high = min(high, Fraction(-at, slope))
    return low < high


class Lattice:
    """All numbers of the input as integers in units of 2^-k; of round numbers no coarser than proofs are cut."""

    def __init__(self):
        self.k = 44

    def hold(self, value):
        self.k = max(self.k, float(value).as_integer_ratio()[1].bit_length() - 1)

    def __call__(self, value):
        n, d = float(value).as_integer_ratio()
        demand(d.bit_length() - 1 <= self.k, "a coordinate", value, "is none of the input's")
        return n << (self.k - d.bit_length() + 1)

    def point(self, p):
        return self(p[0]), self(p[1])

    @property
    def unit(self):
        return 1 << self.k


def symbol_corners(text):
    """Of square:SIDE, rectangle:WIDTHxHEIGHT, or a WKT polygon without holes, in the layer's units. (The corners of a disc are the
    program's choice.)"""
    kind, _, size = text.partition(":")
    if kind in ("square", "rectangle"):
        width, height = map(float, size.split("x") if kind == "rectangle" else (size, size))
        return [(x * width / 2, y * height / 2) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    found = re.fullmatch(r"POLYGON ?\(\(([^()]*)\)\)", text)
    demand(found, "the symbol", text, "is not read; its corners may be given, as WKT")
    corners = [tuple(map(float, p.split())) for p in found[1].split(",")]
    return corners[:-1] if corners[0] == corners[-1] else corners


def place_symbols(layer, corners):
    """The symbol at each point, to the nearest doubles."""
    for fid, (attributes, polygons, lines) in layer.features.items():
        demand(not polygons and len(lines) == 1 and len(lines[0]) == 1, "feature", fid, "is not one point")
        (px, py), = lines[0]
        layer.features[fid] = attributes, [[[(px + x, py + y) for x, y in corners]]], []


class Problem:
    def __init__(self, path, options, anchors):
        layer = geopackage.Layer(path, options.layer, options.where)
        if options.symbol:
            place_symbols(layer, symbol_corners(options.symbol))
        self.name, self.options = layer.name, options
        self.tolerance = options.touch_tolerance if options.touch_tolerance is not None else options.gap / 10
        for fid, (attributes, polygons, lines) in layer.features.items():
            layer.features[fid] = attributes, [repaired(p) for p in polygons], lines
        fixed = layer.fids(path, options.fixed_where)
        self.ignored = layer.fids(path, options.ignore_where)
        barriers = [b for spec in options.barrier for b in self.read_barriers(spec)]
        self.lattice = Lattice()
        for number in (options.gap, self.tolerance):
            self.lattice.hold(number)
        for polygons, lines in [f[1:] for f in layer.features.values()] + [b[1:3] for b in barriers]:
            for chain in lines + [r for p in polygons for r in p]:
                for p in chain:
                    self.lattice.hold(p[0])
                    self.lattice.hold(p[1])
        for x, y in anchors:  # the proof's; where they may be is asked when they are used
            self.lattice.hold(x)
            self.lattice.hold(y)
        for barrier in barriers:
            self.lattice.hold(barrier[3] / 2)
            self.lattice.hold(barrier[4])
        self.things = {fid: Thing(self.lattice, f[1], f[2]) for fid, f in layer.features.items()}
        self.attributes = {fid: f[0] for fid, f in layer.features.items()}
        self.owed, self.fixed, self.blocks, self.joined = {}, fixed, {}, {}
        self.listed = {}  # pairs: the kinds of their conflicts
        self.stood = {}   # pairs: see how_it_stood()
        self.sides = set()
        for key, polygons, lines, width, gap, side in barriers:
            demand(key not in self.things, "two barriers are called", key)
            self.things[key] = Thing(self.lattice, polygons, lines)
            self.owed[key] = self.lattice(width / 2) + self.lattice(gap)
            if side:
                self.sides.add(key)
        self.anchors, self.side_anchors, self.trusted = {}, {}, 0

    def read_barriers(self, spec):
        words = split_spec(spec)
        layer = geopackage.Layer(words["path"], words.get("layer"), words["where"])
        for fid, (attributes, polygons, lines) in layer.features.items():
            if words.get("as") == "boundary":
                polygons, lines = [], lines + [r + r[:1] for p in polygons for r in p]
            width = float(attributes[words["width-field"]] or 0 if "width-field" in words else words.get("width", 0))
            gap = float(words["gap"]) if "gap" in words else self.options.gap
            if polygons or lines:
                polygons = [repaired(p) for p in polygons]
                yield f"{layer.name}:{fid}", polygons, lines, max(width, 0.0), gap, words.get("side", "yes") == "yes"

    # ---- Features

    def is_barrier(self, key):
        return key in self.owed

    def required(self, a, b):
        """In units of the lattice."""
        for key in (a, b):
            if self.is_barrier(key):
                return self.owed[key]
        return self.lattice(self.options.gap)

    def limit(self, fid):
        """A double, or None: no limit."""
        if fid in self.fixed or fid in self.ignored:
            return 0.0
        options, found = self.options, self.options.max_shift
        if options.max_shift_field and self.attributes[fid][options.max_shift_field] is not None:
            found = float(self.attributes[fid][options.max_shift_field])
        return found

    def body_limit(self, fids):
        limits = [v for v in map(self.limit, fids) if v is not None]
        return min(limits) if limits else None

    def weight(self, fid, claimed):
        """The claimed weight, once it is known to be the feature's. Areas are asked about as ratios (check_areas)."""
        options = self.options
        field = self.attributes[fid][options.weight_field] if options.weight_field else None
        if options.weight == "1":
            demand(claimed == (1.0 if field is None else float(field)), "the weight of", fid, "is not", claimed)
        return Fraction(claimed)

    # ---- Blocks

    def add_block(self, fids):
        demand(len(set(fids)) == len(fids) and not any(f in self.blocks for f in fids), "a feature is of two blocks")
        for fid in fids:
            demand(fid in self.things and not self.is_barrier(fid), "a block of", fid)
            self.blocks[fid] = tuple(fids)
        self.demand_joined(fids)

    def block(self, fid):
        return self.blocks.get(fid, (fid,))

    def joins(self, a, b):
        """Do the two join one block by themselves? None: they overlap by more than their least way out tells, and do not lie in
        each other for sure."""
        options = self.options
        if options.block_field:
            values = [self.attributes[f][options.block_field] for f in (a, b)]
            if values[0] is not None and values[0] == values[1]:
                return True
        if options.symbol and options.touch_tolerance is None:  # symbols join only where that is asked for
            return False
        if options.no_blocks or a in self.ignored or b in self.ignored:
            return False
        if (a, b) not in self.joined:
            self.joined[a, b] = self.joined[b, a] = self.joins_by_place(a, b)
        return self.joined[a, b]

    def joins_by_place(self, a, b):
        p, q, tolerance = self.things[a].whole(), self.things[b].whole(), self.lattice(self.tolerance)
        if not (p.area and q.area) or not plane.boxes_near(p.box, q.box, tolerance):
            return False
        if not plane.interiors_meet(p, q):
            square = plane.distance_square(p, q)
            return square <= tolerance * tolerance
        inside = [nearly_in(p, q, tolerance), nearly_in(q, p, tolerance)] if self.options.contained == "block" else []
        if True in inside:
            return True
        square = plane.least_square(p, q)
        if square is not None and square <= tolerance * tolerance:
            return True
        return None

    def demand_joined(self, fids):
        """Every member hangs together with the first. What only overlaps is trusted where nothing else joins it."""
        left, reached = set(fids[1:]), [fids[0]]
        while left:
            for fid in reached:
                more = {g for g in left if self.joins(fid, g)}
                left -= more
                reached += sorted(more)
            doubtful = sorted(g for g in left if any(self.joins(f, g) is None for f in reached))
            demand(doubtful or not left, "nothing joins", *sorted(left), "to the block of", fids[0])
            for g in doubtful[:1]:
                self.trusted += 1
                left.discard(g)
                reached.append(g)

    # ---- Pairs

    def demand_owed(self, a, b):
        """Do the two owe each other the gap, in every placement that the bound is about?"""
        demand(a in self.things and b in self.things, "there is no", a, "or", b)
        demand(not (self.is_barrier(a) and self.is_barrier(b)), a, "and", b, "never move")
        demand(b not in self.block(a), a, "and", b, "are of one block")
        demand(a not in self.ignored and b not in self.ignored, a, "or", b, "is ignored")
        if not self.is_barrier(a) and not self.is_barrier(b):
            demand(not self.joins(a, b), a, "and", b, "join one block")

    def clearance(self, a, b, told):
        """How far apart the two are held, in units of the lattice: listed ones to no more than the distance that they had; where
        their interiors met, to 0 if the list says that they do no more, else to no less than their depth, negative."""
        required, pair = self.required(a, b), tuple(sorted((str(a), str(b))))
        if told is None:
            demand(pair not in self.listed, a, "and", b, "are listed")
            return required
        clearance = Fraction(told) * self.lattice.unit
        demand(clearance <= required, "more is asked of", a, b, "than they owe")
        if pair not in self.listed:
            demand(clearance >= 0, "less is asked of", a, b, "than they owe")
            return clearance
        if pair not in self.stood:
            self.stood[pair] = self.how_it_stood(a, b)
        square, depth = self.stood[pair]
        if clearance >= 0:
            parted = square < 0 and self.listed[pair] in ("too_close", "barrier_drawn", "barrier_near")
            demand(clearance * clearance <= (0 if parted else square), "a listed pair is held to more than it had:", a, b)
        else:
            demand(square < 0 and depth is not None and depth <= clearance * clearance,
                   "a listed pair is held to more than it had:", a, b)
        return clearance

    def how_it_stood(self, a, b):
        """The square of the distance, or -1 and that of the least translation; None: one lay in the other, and may go deeper."""
        p, q = (self.things[k].whole() for k in (a, b))
        inside = any(plane.lies_in(x, y) for x, y, key in ((p, q, a), (q, p, b)) if y.area and not self.is_barrier(key))
        p, q = (p, q) if p.area else (q, p)
        if not plane.interiors_meet(p, q):
            return plane.distance_square(p, q), None
        return -1, None if inside else plane.least_square(p, q)

    def demand_part(self, key, corners):
        """Corners of a part of it, on the lattice."""
        demand(key in self.things, "there is no", key)
        part = tuple(self.lattice.point(p) for p in corners)
        demand(self.things[key].has_part(part), "a part does not lie in", key)
        return part

    def demand_passed(self, key, corners, other, anchor):
        """A part of what the anchor of another feature may not pass: of a feature, or of members of its block, which moves as
        one, that do not hold the anchor either."""
        part = tuple(self.lattice.point(p) for p in corners)
        if len(hull(part)) < 3 or self.things[key].has_part(part):
            return self.demand_part(key, corners)
        box = plane.box_of(part)
        members = [k for k in self.block(key) if plane.boxes_near(self.things[k].whole().box, box)]
        members = [k for k in members if not self.things[k].holds_place(anchor)]
        for k in members:
            self.demand_owed(k, other)
        outlines = [o for k in members for o in self.things[k].outlines if o.box]
        demand(in_union(hull(part), outlines), "a part does not lie in the block of", key)
        return part

    def demand_anchor(self, key, corners, other):
        at = tuple(corners[0])
        demand(len(corners) == 1 and self.anchors.setdefault(key, at) == at, "that is not the anchor of", key)
        place = self.lattice.point(corners[0])
        demand(not self.things[other].holds_place(place), other, "holds the anchor of", key)
        return (place,)

    def demand_listed(self, told):
        a, b = told["a"], told["b"]
        demand(a in self.things and b in self.things and a != b, "a conflict of", a, "and", b)
        demand(bool(told.get("inside_block")) == (b in self.block(a)), a, "and", b, "are of one block, or are not")

    def demand_shadow(self, a, told_a, b, told_b):
        """The parts of a shadow: an anchor, and a part of what may not be passed."""
        if self.is_barrier(a) or self.is_barrier(b):
            if self.is_barrier(a):
                return self.demand_side(a, told_a, b, told_b), self.demand_side_anchor(b, told_b)
            return self.demand_side_anchor(a, told_a), self.demand_side(b, told_b, a, told_a)
        demand(not self.options.allow_jumps, "jumps are allowed")
        if len(told_a) == 1:
            place = self.demand_anchor(a, told_a, b)
            return place, self.demand_passed(b, told_b, a, place[0])
        place = self.demand_anchor(b, told_b, a)
        return self.demand_passed(a, told_a, b, place[0]), place

    def demand_side_anchor(self, key, corners):
        """A feature has one; where no side meets its interior it is the anchor."""
        demand(len(corners) == 1 and key in self.things, "that is no side anchor of", key)
        at, box = tuple(corners[0]), self.things[key].whole().box
        demand(self.side_anchors.setdefault(key, at) == at, "two side anchors of", key)
        place = Fraction(at[0]) * self.lattice.unit, Fraction(at[1]) * self.lattice.unit
        demand(box[0] <= place[0] <= box[2] and box[1] <= place[1] <= box[3], "a side anchor outside of", key)
        return (self.lattice.point(at),)

    def demand_side(self, key, corners, feature, anchor):
        """A segment of a line of the barrier, none of which the side anchor lies on; or an edge of an area, with the area on
        its left and the side anchor on its right."""
        demand(key in self.sides, key, "has no sides")
        demand(len(corners) == 2 and len(anchor) == 1, "a side is a segment, and has an anchor")
        p, q = (self.lattice.point(c) for c in corners)
        at, thing = self.lattice.point(anchor[0]), self.things[key]
        lines = [e for line in thing.lines for e in zip(line, line[1:] or line)]
        if any(plane.on_edge(e, p) and plane.on_edge(e, q) for e in lines):
            demand(not any(plane.on_edge(e, at) for e in lines), "the side anchor of", feature, "lies on", key)
            return p, q
        areas = [o for o in thing.outlines if any(plane.on_edge(e, p) and plane.on_edge(e, q) for e in o.edges)]
        demand(p != q and len(areas) == 1, "a side is not of", key)
        middle, along = (p[0] + q[0], p[1] + q[1]), (q[0] - p[0], q[1] - p[1])
        demand(plane.on_its_left(areas[0].scaled(2), middle, along) and plane.side(p, q, at) < 0,
               "a side of", key, "faces away from", feature)
        return p, q

    def demand_chord(self, node):
        """Of sides of two barriers (or one) that share a corner, on either side of the anchor's way through it: a segment from the
        shadow of the one to that of the other, which that way passes no nearer than the corner."""
        a, b, c, anchor = node["a"], node["b"], node["c"], node["A"]
        demand(all(self.is_barrier(k) for k in (b, c)) and not self.is_barrier(a), "a chord of what are no barriers")
        self.demand_owed(a, c)
        place, = self.demand_side_anchor(a, anchor)
        sides = self.demand_side(b, node["side_b"], a, anchor), self.demand_side(c, node["side_c"], a, anchor)
        shared = set(sides[0]) & set(sides[1])
        demand(len(shared) == 1 and len(node["B"]) == 2, "sides that share no corner")
        corner, = shared
        chord = tuple(tuple(Fraction(x) * self.lattice.unit for x in p) for p in node["B"])
        others = [next(p for p in side if p != corner) for side in sides]
        turns = [turn(place, corner, p) for p in others]
        demand(turns[0] * turns[1] < 0, "two sides on one side of the way through their corner")
        for t, p, end in zip(turns, others, chord):
            far = turn(corner, p, place)
            demand(t * turn(place, corner, end) > 0 and t * turn(place, p, end) <= 0 and
                   far != 0 and far * turn(corner, p, end) <= 0, "an end of a chord that no side shadows")
        of_anchor, of_corner = turn(*chord, place), turn(*chord, corner)
        demand(of_anchor != 0 and 0 <= Fraction(of_corner) / of_anchor < 1, "a chord before the corner")
        return (place,), chord

    def note_anchor(self, key, anchor):
        known = self.anchors.setdefault(key, tuple(anchor))
        demand(known == tuple(anchor), "two anchors of", key)

    def may_be_inside(self, a, b, reach):
        """Could a move no longer than this (each way) bring one into the other? By their boxes."""
        p, q, t = self.things[a].whole().box, self.things[b].whole().box, self.lattice(self.tolerance)
        for x, y in ((p, q), (q, p)):
            if all(x[c + 2] - x[c] <= y[c + 2] - y[c] + 2 * t and x[c] >= y[c] - t - reach and
                   x[c + 2] <= y[c + 2] + t + reach for c in (0, 1)):
                return True
        return False


def turn(p, q, u):
    """Greater than 0 where it turns left at q."""
    return (q[0] - p[0]) * (u[1] - p[1]) - (q[1] - p[1]) * (u[0] - p[0])


def root_above(value):
    """A fraction no less than the root, by 2^-40 of it at most."""
    value = Fraction(value)
    shift = 1 << 200
    return Fraction(math.isqrt(-(-value.numerator * shift * shift // value.denominator)) + 1, shift)
