"""The premises of a proof, from the input: features and barriers on one lattice of integers, the distances required
of them, which of them move, how far, and with what weight. Only anchors, and blocks by touches and overlaps that are
not computed here, are taken from the proof; see docs/PROOF.md."""
import argparse
import math
from fractions import Fraction

import arcs
from exact import anchor, plane, side_anchor
import geopackage
from cover import hull
from blocks import Blocks
from form import NotRead, demand
from lengths import Units
from nearly_in import hair_of
from pieces import in_polygon, in_union
from repair import area_of, members_of, repaired
from reprojected import in_crs_of
from sheets import Gaps
from sources import Source
from symbols import Symbols
from validity import leave_out_broken
from unions import union_outline


def split_spec(spec):
    """Parses the argument of --barrier; `where=` takes the rest, and a comma within a name is written \\, ."""
    spec, _, where = spec.partition(",where=")
    words = [w.replace("\0", ",") for w in spec.replace("\\,", "\0").split(",")]
    return {"path": words[0], "where": where or None, **dict(w.split("=", 1) for w in words[1:])}


class Thing:
    """A feature, or a barrier: polygons (lists of rings) and lines, in integers."""

    def __init__(self, lattice, polygons, lines):
        self.polygons = [[[lattice.point(p) for p in ring] for ring in polygon] for polygon in polygons]
        self.lines = [[lattice.point(p) for p in line] for line in lines]
        self.outlines = [plane.Outline(p) for p in self.polygons]
        self.parts = {}

    def whole(self):
        """The union of its members; common walls and areas that several cover are inside."""
        if self.is_joined():
            return union_outline([o for o in self.outlines if o.box], self.lines)
        return plane.Outline([r for p in self.polygons for r in p], self.lines)

    def is_joined(self):
        """Do members overlap, or share walls?"""
        members = [o for o in self.outlines if o.box]
        return any(have_common_walls(one, other) for k, one in enumerate(members) for other in members[:k])

    def edges_near(self, box, reach):
        """The edges of its members and lines."""
        return [e for o in (*self.outlines, plane.Outline(lines=self.lines)) for e in plane.near_edges(o, box, reach)]

    def holds_place(self, p):
        return any(o.box and plane.locate(o, p) >= 0 for o in self.outlines)

    def has_part(self, part):
        """Does the convex hull of these corners lie in the feature or barrier?"""
        if part not in self.parts:
            corners = hull(part)
            self.parts[part] = (any(in_polygon(corners, o) for o in self.outlines if o.box) if len(corners) > 2 else
                                self.has_segment(corners))
        return self.parts[part]

    def has_segment(self, ends):
        segments = [(p, q) for line in self.lines for p, q in zip(line, line[1:] or line)]
        return any(all(plane.on_edge(s, p) for p in ends) for s in segments)


class Lattice:
    """All numbers of the input as integers in units of 2^-k; k is so large that anchors are integers, too, unless
    they are very close to 0."""

    def __init__(self):
        self.k = 60

    def hold(self, value):
        self.k = max(self.k, float(value).as_integer_ratio()[1].bit_length() - 1)

    def __call__(self, value):
        n, d = float(value).as_integer_ratio()
        less = self.k - d.bit_length() + 1
        return n << less if less >= 0 else Fraction(n, 1 << -less)

    def point(self, p):
        return self(p[0]), self(p[1])

    @property
    def unit(self):
        return 1 << self.k


def have_common_walls(one, other):
    """Do the two have more in common than corners that touch?"""
    return plane.boxes_near(one.box, other.box) and (plane.interiors_meet(one, other) or any(
        plane.side(*e, f[0]) == plane.side(*e, f[1]) == 0 and plane.edges_meet(e, f)
        for e in plane.near_edges(one, other.box) for f in plane.near_edges(other, one.box)))


class Problem:
    def __init__(self, path, options):
        source = Source(path, options.layer, options.sql, options.dialect, options.bbox, options.input_crs)
        layer = source.layer(options.where)
        self.crs, self.units = layer.crs, Units(layer.crs, options.scale)
        self.gaps = None  # gaps by classes
        self.name, self.options = layer.name, self.in_units(options)
        options = self.options
        for name in (options.max_shift_field, options.weight_field, options.block_field, options.rows_field):
            layer.demand_field(name)
        if not options.points:
            leave_out_broken(layer, options.invalid)
            arcs.enlarge(layer)
        self.points = Symbols(options, self.units).place(layer) if options.points else {}
        self.tolerance = options.touch_tolerance if options.touch_tolerance is not None else min(self.plain_gap, options.gap) / 10
        self.arcs = layer.arcs
        self.given, self.areas, self.median = {fid: f[1] for fid, f in layer.features.items()}, {}, None
        for fid, (attributes, polygons, _) in layer.features.items():  # lines of a collection are not part of a feature
            layer.features[fid] = attributes, [repaired(p) for p in polygons], []
        self.standing = {fid: f[1] for fid, f in layer.features.items()}
        fixed = source.fids(options.fixed_where)
        self.ignored = source.fids(options.ignore_where)
        told = list(map(split_spec, options.barrier)) or list(options.sheet.barriers() if options.sheet else ())
        barriers = [b for words in told for b in self.read_barriers(words)]
        self.classes = {fid: options.sheet.class_of(options.sheet.moving, f[0]) for fid, f in layer.features.items()} if self.gaps else {}
        self.classes_there = set(self.classes.values())
        self.lattice = Lattice()
        self.least_gap = options.gap if options.least_gap is None else options.least_gap
        tables = self.gaps.full + self.gaps.least if self.gaps else []
        for number in (options.gap, self.least_gap, self.tolerance, *(v for row in tables for v in row)):
            self.lattice.hold(number)
        for polygons, lines in [f[1:] for f in layer.features.values()] + [b[1:3] for b in barriers]:
            for chain in lines + [r for p in polygons for r in p]:
                for p in chain:
                    self.lattice.hold(p[0])
                    self.lattice.hold(p[1])
        for barrier in barriers:
            for number in (barrier[3] / 2, *(barrier[4] or ())):
                self.lattice.hold(number)
        self.rigid = source.fids(options.rigid_where)
        self.things = {fid: Thing(self.lattice, f[1], f[2]) for fid, f in layer.features.items()}
        self.as_read, self.larger = dict(self.things), {}  # the polygons, in doubles, of features that are larger than as read
        self.original = dict(self.things)  # as read, or larger; in self.things features have the shapes of their present levels
        self.smaller, self.level = {}, {}  # of features: their smaller shapes, the largest first; their present levels above 0
        self.taken = {}  # the polygons, in doubles, of features that are smaller in the result
        self.attributes = {fid: f[0] for fid, f in layer.features.items()}
        self.place = {fid: k for k, fid in enumerate(layer.features)}
        self.skipped = self.ignored | {fid for fid, thing in self.things.items() if not any(o.area for o in thing.outlines)}
        self.half, self.own_gaps, self.fixed, self.limits = {}, {}, fixed, {}
        self.pairs, self.wholes = set(), {}
        self.known_distances = {}
        self.listed = {}  # pairs: the kinds of their conflicts
        self.stood = {}   # pairs: see how_it_stood()
        self.given_wholes = {}
        self.crossed = {}  # pairs of a feature and a barrier: see is_crossed()
        self.occupied = {}  # bodies and sides of squares: see prices.py
        self.sides = set()
        for key, polygons, lines, width, own, side, of_class in barriers:
            if key in self.things:
                raise NotRead(f"two barriers are called {key}")
            self.things[key] = Thing(self.lattice, polygons, lines)
            self.half[key], self.own_gaps[key], self.classes[key] = self.lattice(width / 2), own, of_class
            if side:
                self.sides.add(key)
        # May pairs fall short of the full distance that they owe, at a price?
        self.has_slack = (self.gaps.has_slack if self.gaps else self.least_gap < options.gap) or any(own and own[0] < own[1] for own in self.own_gaps.values())
        self.anchors, self.side_anchors = {}, {}
        self.rows = self.eased = None  # see rows.py, eased.py
        self.look_at(None)
        self.blocks = Blocks(self)
        self.blocks.find()

    def in_units(self, options):
        """The options with lengths as doubles in units of the layer."""
        own = argparse.Namespace(**vars(options))
        own.gap = self.plain_gap = self.units(own.gap, "--gap")
        for name in ("max_shift", "touch_tolerance", "least_gap", "symbol_size", "min_size"):
            if getattr(own, name) is not None:
                setattr(own, name, self.units(getattr(own, name), "--" + name.replace("_", "-")))
        if own.sheet and own.sheet.rules:
            self.gaps = Gaps(own.sheet, self.units, own.gap, own.least_gap)
            own.gap, most = (max(map(max, table)) for table in (self.gaps.full, self.gaps.least))
            own.least_gap = most if self.gaps.has_slack else None
        own.inset = [self.units(length, "--inset") for length in own.inset.split(",") if length]
        return own

    def read_barriers(self, words):
        spec = words["path"]
        source = Source(words["path"], words.get("layer"))
        layer = source.layer(words["where"])
        features = layer.features.items() if layer.crs.is_same(self.crs) else in_crs_of(self.crs, layer, source)
        width_of_all = self.units(words.get("width", 0), "--barrier " + spec)
        gap = self.units(words["gap"], "--barrier " + spec) if "gap" in words else self.options.gap
        least = self.units(words["least"], "--barrier " + spec) if "least" in words else self.options.least_gap
        own = (gap if least is None else min(least, gap), gap) if "gap" in words or "least" in words else None
        by, widths = words.get("widths", (None, {}))
        for fid, (attributes, polygons, lines) in features:
            if words.get("as") == "boundary":
                polygons, lines = [], lines + [r + r[:1] for p in polygons for r in p]
            width = geopackage.number_of(attributes, words["width-field"]) or 0.0 if "width-field" in words else width_of_all
            if by and str(geopackage.value_of(attributes, by)) in widths:
                width = self.units(widths[str(geopackage.value_of(attributes, by))], "--barrier " + spec)
            of_class = self.options.sheet.class_of(words["of"], attributes) if "of" in words else 0
            if polygons or lines:
                polygons = [repaired(p) for p in polygons]
                yield f"{layer.name}:{fid}", polygons, lines, max(width, 0.0), own, words.get("side", "yes") == "yes", of_class

    # ---- Features

    def whole(self, key):
        if key not in self.wholes:
            self.wholes[key] = self.things[key].whole()
        return self.wholes[key]

    def whole_as_given(self, key):
        if not self.level.get(key) and key not in self.larger:
            return self.whole(key)
        if key not in self.given_wholes:
            self.given_wholes[key] = self.as_read[key].whole()
        return self.given_wholes[key]

    def is_barrier(self, key):
        return key in self.half

    def gaps_of(self, a, b):
        """The least gap of two, and the full one, in units of the layer: those of their classes, unless one is a barrier with its own."""
        own = self.own_gaps.get(a) or self.own_gaps.get(b)
        if own or not self.gaps:
            return own or (self.least_gap, self.options.gap)
        i, j = self.classes[a], self.classes[b]
        return self.gaps.least[i][j], self.gaps.full[i][j]

    def distances(self, a, b):
        """Half the width of a barrier and the gaps, in units of the lattice."""
        if (a, b) not in self.known_distances:
            half = self.half.get(a, 0) + self.half.get(b, 0)
            self.known_distances[a, b] = [half + self.lattice(v) for v in self.gaps_of(a, b)]
        return self.known_distances[a, b]

    def greatest_gap(self):
        """The greatest full gap of two classes that features have."""
        there = self.classes_there
        return max((self.gaps.full[i][j] for i in there for j in there), default=0.0) if self.gaps else self.options.gap

    def least_gap_of(self, body):
        """The least gap that some member keeps from features of any class that is there."""
        there = self.classes_there
        return min(self.gaps.least[self.classes[fid]][j] for fid in body for j in there) if self.gaps else self.least_gap

    def least_owed(self, barrier):
        """The least distance that any feature has to keep from the barrier, in units of the lattice."""
        return min((self.required(fid, barrier) for fid in self.place), default=0)

    def required(self, a, b):
        """The distance that two have to keep, in units of the lattice: with a least gap, the least one."""
        return self.distances(a, b)[0]

    def is_crossed(self, a, b):
        """Does a line or point of one, a barrier, meet the interior of the other one where it stands, and may that stay so?"""
        if not self.makes_room() or self.options.crossed != "keep" or self.is_barrier(a) == self.is_barrier(b):
            return False
        return self.crosses(*((b, a) if self.is_barrier(a) else (a, b)))

    def makes_room(self):
        """May features be hidden, or become smaller or larger?"""
        options = self.options
        return bool(options.hide or options.trim or options.inset or options.symbol_size is not None or options.enlarge)

    def crosses(self, feature, barrier):
        if (feature, barrier) not in self.crossed:
            p, q = self.whole_as_given(feature), plane.Outline(lines=self.things[barrier].lines)
            self.crossed[feature, barrier] = bool(q.edges) and plane.interiors_meet(p, q)
        return self.crossed[feature, barrier]

    def full(self, a, b):
        """The distance of which two pay what they lack."""
        return self.distances(a, b)[1]

    def own_limit(self, fid):
        """The limit as a double, or None for no limit. Fixed features have one, too."""
        options, found = self.options, self.options.max_shift
        field = geopackage.number_of(self.attributes[fid], options.max_shift_field)
        if field is not None:
            found = field
            if not 0 <= found < math.inf:
                raise NotRead(f"the limit of {fid} is {found}")
        return found

    def limit(self, key):
        return 0.0 if self.is_barrier(key) or key in self.fixed or key in self.skipped else self.own_limit(key)

    def body_limit(self, fids):
        """The members of a block, or a barrier."""
        if fids not in self.limits:
            self.limits[fids] = self.least_limit(self.blocks.block(fids[0]))
        return self.limits[fids]

    def least_limit(self, fids):
        limits = [v for v in map(self.limit, fids) if v is not None]
        return min(limits) if limits else None

    def weight(self, fid):
        """The weight, as a double: the quotient of the area and the median of all areas, or its root, times the field's
        value. Each of these is one operation of doubles, on areas that are the nearest doubles to the true ones."""
        options, found = self.options, 1.0
        if options.weight != "1":
            found = self.area(fid) / self.median_area()
            found = math.sqrt(found) if options.weight == "sqrt-area" else found
        field = geopackage.number_of(self.attributes[fid], options.weight_field)
        found *= 1.0 if field is None else field
        if not 0 < found < math.inf:
            raise NotRead(f"the weight of {fid} is {found}")
        return found

    def area(self, fid):
        if fid not in self.areas:
            self.areas[fid] = float(sum(map(area_of, self.given[fid]), Fraction(0)))
        return self.areas[fid]

    def area_at_home(self, fid):
        """The area before the feature becomes smaller."""
        return float(sum(map(area_of, self.larger[fid]), Fraction(0))) if fid in self.larger else self.area(fid)

    def median_area(self):
        if self.median is None:
            areas = sorted(self.area(fid) for fid in self.place if fid not in self.skipped)
            n = len(areas)
            self.median = areas[n // 2] if n % 2 else areas[n // 2 - 1] / 2 + areas[n // 2] / 2
        return self.median

    # ---- What is visible

    def look_at(self, visible):
        """visible: whether a feature is there at all; None: all are. Blocks and their limits, what lies in what, and rows stay those of
        all features."""
        self.visible, self.partial = visible, {}

    def set_larger(self, larger):
        """Gives features these polygons, in doubles, as the shapes that they have at the level 0. Blocks, areas, side anchors, and which
        features a barrier crosses stay those of the shapes as read. Returns whether anything changes."""
        self.set_levels({})
        changed = {fid for fid in {*self.larger, *larger} if self.larger.get(fid) != larger.get(fid)}
        self.larger = larger
        for fid in changed:
            self.original[fid] = self.things[fid] = Thing(self.lattice, larger[fid], []) if fid in larger else self.as_read[fid]
            self.wholes.pop(fid, None)
            self.anchors.pop(fid, None)
        if changed:
            self.stood, self.occupied = {}, {}
        return bool(changed)

    def polygons_at_home(self, fid):
        return self.larger.get(fid, self.standing[fid])

    def is_repaired(self, fid):
        return any(a is not b for a, b in zip(self.given[fid], self.standing[fid]))

    def set_levels(self, level):
        """Gives features the shapes of their levels, which are 0 unless `level` says otherwise. Blocks, anchors, rows, weights, and the answer
        to what holds an anchor, stay."""
        changed = {fid for fid in self.smaller if level.get(fid, 0) != self.level.get(fid, 0)}
        self.level = {fid: level[fid] for fid in self.smaller if level.get(fid)}
        for fid in changed:
            self.things[fid] = self.smaller[fid][self.level[fid] - 1] if fid in self.level else self.original[fid]
            self.wholes.pop(fid, None)
        if changed:
            self.stood, self.occupied = {}, {}

    def is_hidden(self, key):
        return self.visible is not None and not self.is_barrier(key) and not self.visible(key)

    def block(self, fid):
        """The visible members of the feature's block."""
        if self.visible is None:
            return self.blocks.block(fid)
        if fid not in self.partial:
            self.partial[fid] = tuple(k for k in self.blocks.block(fid) if not self.is_hidden(k))
        return self.partial[fid]

    # ---- Pairs

    def demand_owed(self, a, b):
        """Are the two required to keep the gap, in every placement that the bound is about?"""
        demand(a in self.things and b in self.things, "there is no", a, "or", b)
        demand(not self.is_hidden(a) and not self.is_hidden(b), a, "or", b, "is hidden, and owes nothing")
        demand(self.may_move(a) or self.may_move(b), "neither", a, "nor", b, "moves")
        demand(b not in self.block(a), a, "and", b, "are of one block")
        demand(a not in self.skipped and b not in self.skipped, a, "or", b, "is ignored, or nothing")
        demand(not self.is_hidden(a) and not self.is_hidden(b), a, "or", b, "is hidden")

    def may_move(self, key):
        return not self.is_barrier(key) and self.body_limit(self.block(key)) != 0

    def clearance(self, a, b, told):
        """The clearance of the two, in units of the lattice. For a listed pair it is at most the distance at the
        start. If its interiors met, the clearance is 0 if the list says that they no longer do, otherwise minus at
        least their depth."""
        required, pair = self.required(a, b), tuple(sorted((str(a), str(b))))
        if told is None:
            demand(pair not in self.listed, a, "and", b, "are listed")
            return required
        clearance = Fraction(told) * self.lattice.unit
        demand(clearance <= required, "more is asked of", a, b, "than they owe")
        if pair not in self.listed:
            return clearance
        square, depth, inside = self.how_it_stood(a, b)
        depth = None if inside else depth
        if clearance >= 0:
            parted = square < 0 and self.listed[pair] in ("too_close", "barrier_drawn", "barrier_near")
            demand(clearance * clearance <= (0 if parted else square), "a listed pair is held to more than it had:", a, b)
        else:
            demand(square < 0 and depth is not None and depth <= clearance * clearance,
                   "a listed pair is held to more than it had:", a, b)
        return clearance

    def how_it_stood(self, a, b):
        """The square of the distance, or -1; then that of the least translation, None if it is not known; and whether
        one of the two was inside the other, and may go deeper."""
        pair = tuple(sorted((str(a), str(b))))
        if pair not in self.stood:
            p, q = (self.whole(k) for k in (a, b))
            inside = any(plane.lies_in(x, y) for x, y, key in ((p, q, a), (q, p, b)) if y.area and not self.is_barrier(key))
            p, q = (p, q) if p.area else (q, p)
            meet = plane.interiors_meet(p, q)
            self.stood[pair] = (-1, plane.least_square(p, q), inside) if meet else (plane.distance_square(p, q), None, inside)
        return self.stood[pair]

    def demand_part(self, key, corners):
        """Fails unless the corners, on the lattice, are those of a part of the feature or barrier."""
        part = tuple(self.lattice.point(p) for p in corners)
        demand(self.things[key].has_part(part), "a part does not lie in", key)
        return part

    def demand_passed(self, key, corners, other, anchor):
        """A part of what the anchor of another feature may not pass: of a feature, or of the members of its block
        (which move together) that do not contain the anchor, either."""
        part = tuple(self.lattice.point(p) for p in corners)
        if len(hull(part)) < 3 or self.things[key].has_part(part):
            return self.demand_part(key, corners)
        box = plane.box_of(part)
        members = [k for k in self.block(key) if plane.boxes_near(self.whole(k).box, box)]
        members = [k for k in members if not self.original.get(k, self.things[k]).holds_place(anchor)]
        for k in members:
            self.demand_owed(k, other)
        outlines = [o for k in members for o in self.things[k].outlines if o.box]
        demand(in_union(hull(part), outlines), "a part does not lie in the block of", key)
        return part

    def demand_anchor(self, key, corners, other):
        corner, = corners
        self.demand_anchor_of(key, corner)
        place = self.lattice.point(corner)
        demand(not self.original.get(other, self.things[other]).holds_place(place), other, "holds the anchor of", key)
        return (place,)

    def list_conflicts(self, conflicts):
        self.pairs, self.listed = set(), {}
        for told in conflicts:
            self.demand_listed(told)
            pair = tuple(sorted((str(told["a"]), str(told["b"]))))
            demand(pair not in self.pairs, told["a"], "and", told["b"], "are listed twice")
            self.pairs.add(pair)
            if not told.get("inside_block") and told["kind"] != "tight":
                self.listed[pair] = told["kind"]

    def is_listed(self, a, b):
        return tuple(sorted((str(a), str(b)))) in self.listed

    def demand_listed(self, told):
        a, b = told["a"], told["b"]
        self.demand_pair(a, b)
        demand(bool(told.get("inside_block")) == (b in self.block(a)), a, "and", b, "are of one block, or are not")

    def demand_pair(self, a, b):
        """Fails unless the two may be in a conflict."""
        demand(a in self.things and b in self.things and a != b, "a conflict of", a, "and", b)
        demand(not {a, b} & self.skipped, a, "or", b, "is ignored, or nothing, and has no conflict")
        demand(not self.is_hidden(a) and not self.is_hidden(b), a, "or", b, "is hidden, and has no conflict")
        demand(not (self.is_barrier(a) and self.is_barrier(b)), a, "and", b, "are barriers, and have no conflict")

    def demand_shadow(self, a, told_a, b, told_b):
        """Checks the two parts of a shadow: an anchor, and a part of a feature or barrier that may not be passed."""
        if self.is_barrier(a) or self.is_barrier(b):
            if self.is_barrier(a):
                return self.demand_side(a, told_a, b, told_b), self.demand_side_anchor(b, told_b)
            side = self.demand_side(b, told_b, a, told_a)
            return self.demand_side_anchor(a, told_a), side
        demand(not self.options.allow_jumps, "jumps are allowed")
        demand(1 in (len(told_a), len(told_b)), "a shadow without the anchor of", a, "or", b)
        if len(told_a) == 1:
            place = self.demand_anchor(a, told_a, b)
            return place, self.demand_passed(b, told_b, a, place[0])
        place = self.demand_anchor(b, told_b, a)
        return self.demand_passed(a, told_a, b, place[0]), place

    def demand_side_anchor(self, key, corners):
        corner, = corners
        demand(tuple(corner) == self.side_anchor(key), "that is not the side anchor of", key)
        return (self.lattice.point(corner),)

    def side_anchor(self, fid):
        """The side anchor: a point feature's point; otherwise the point that the rule for cut features gives, or the
        anchor if no barrier cuts the feature."""
        if self.options.points:
            return self.points[fid][0]
        if fid not in self.side_anchors:
            box, plain = self.whole_as_given(fid).box, anchor_of(self.given[fid])
            members = [o for o in self.as_read[fid].outlines if o.box]
            lines = [e for key in self.sides for e in self.things[key].edges_near(box, 4 * (box[2] - box[0] + box[3] - box[1]))]
            self.side_anchors[fid] = side_anchor(members, lines, plain, self.lattice.unit, self.tolerance) or plain
        return self.side_anchors[fid]

    def demand_side(self, key, corners, feature, anchor):
        """A segment of a line of the barrier, if the side anchor lies on no line; or an edge of an area, with the area
        on its left and the side anchor on its right."""
        demand(key in self.sides, key, "has no sides")
        demand(len(corners) == 2 and len(anchor) == 1, "a side is a segment, and has an anchor")
        p, q = (self.lattice.point(c) for c in corners)
        at, thing = self.lattice.point(anchor[0]), self.things[key]
        lines = [e for line in thing.lines for e in zip(line, line[1:] or line)]
        if any(plane.on_edge(e, p) and plane.on_edge(e, q) for e in lines):
            demand(not any(plane.on_edge(e, at) for e in lines), "the side anchor of", feature, "lies on", key)
            return p, q
        areas = [o for o in thing.outlines if are_joined(o.edges, p, q)]
        middle, along = (p[0] + q[0], p[1] + q[1]), (q[0] - p[0], q[1] - p[1])
        demand(any(plane.on_its_left(o.scaled(2), middle, along) for o in areas) and plane.side(p, q, at) < 0,
               "a side that is none of", key, "or faces away from", feature)
        return p, q

    def demand_chord(self, node):
        """A chord of two sides (of two barriers, or one) with ends on one ray from the anchor: a segment from the shadow of
        one to that of the other. The ray meets the chord's line no nearer than the two ends."""
        a, b, c, anchor = node["a"], node["b"], node["c"], node["A"]
        self.demand_owed(a, c)
        sides = self.demand_side(b, node["side_b"], a, anchor), self.demand_side(c, node["side_c"], a, anchor)
        place, = self.demand_side_anchor(a, anchor)
        along = [(p, q) for p in sides[0] for q in sides[1]
                 if turn(place, p, q) == 0 and sum((x - o) * (y - o) for x, y, o in zip(p, q, place)) > 0]
        demand(along and len(node["B"]) == 2, "sides that share no corner, nor a ray from the anchor")
        chord = tuple(tuple(Fraction(x) * self.lattice.unit for x in p) for p in node["B"])
        wrong = [self.chord_fault(place, sides, corners, chord) for corners in along]
        demand(None in wrong, wrong[0])
        return (place,), chord

    @staticmethod
    def chord_fault(place, sides, corners, chord):
        """What is wrong with a chord past these two ends of its sides, which lie on one ray; None: nothing."""
        for side, corner, end in zip(sides, corners, chord):
            p = side[1] if side[0] == corner else side[0]
            t, far = turn(place, corner, p), turn(corner, p, place)
            if not (t * turn(place, corner, end) > 0 and t * turn(place, p, end) <= 0 and
                    far != 0 and far * turn(corner, p, end) <= 0):
                return "an end of a chord that no side shadows"
        of_anchor = turn(*chord, place)
        if of_anchor == 0 or not all(0 <= Fraction(turn(*chord, corner)) / of_anchor < 1 for corner in corners):
            return "a chord before the corner"
        return None

    def demand_feature(self, told):
        """Checks a member of a body: what the file says about it has to be what the layer and the options give."""
        fid, limit = told["fid"], told["max_shift"]
        demand(fid in self.things and not self.is_barrier(fid) and fid not in self.skipped and not self.is_hidden(fid), "there is no feature", fid)
        demand(limit == self.own_limit(fid), "the limit of", fid, "is", self.own_limit(fid), "and not", limit)
        self.demand_class(fid, told)
        demand(told["weight"] == self.weight(fid), "the weight of", fid, "is", self.weight(fid), "and not", told["weight"])
        if "anchor" in told:
            self.demand_anchor_of(fid, told["anchor"])

    def demand_class(self, key, told):
        own = self.classes[key] if self.gaps else None
        demand(told.get("class") == own, "the class of", key, "is", own, "and not", told.get("class"))

    def demand_anchor_of(self, fid, told):
        demand(tuple(told) == self.anchor(fid), "that is not the anchor of", fid)

    def anchor(self, fid):
        """The anchor, in doubles, of the set that the rings enclose before its corners are rounded."""
        if fid not in self.anchors:
            self.anchors[fid] = anchor_of(self.larger.get(fid, self.given[fid]))
        return self.anchors[fid]

    def ways_inside(self, a, b):
        """Lower bounds, by the boxes, of the move along x and along y that brings one into the other up to the
        tolerance."""
        p, q = self.whole(a), self.whole(b)
        t = self.lattice(self.tolerance) + hair_of(p, q)
        for x, y in ((p.box, q.box), (q.box, p.box)):
            low, high = [y[c] - t - x[c] for c in (0, 1)], [y[c + 2] + t - x[c + 2] for c in (0, 1)]
            if low[0] <= high[0] and low[1] <= high[1]:
                yield [max(low[c], -high[c], 0) for c in (0, 1)]

    def demand_outside(self, a, b, reach, square=None):
        """With --contained ignore: fails unless no relative move within the limits takes one of the two features into
        the other. reach: the longest move along x and y, or with `square` the square of the longest; None: there is
        no limit."""
        if self.options.contained != "ignore" or self.is_barrier(a) or self.is_barrier(b):
            return
        for x, y in self.ways_inside(a, b):
            out = x * x + y * y > square if square is not None else reach is not None and max(x, y) > reach
            demand(out, a, "and", b, "may come to lie in each other")


def anchor_of(polygons):
    return anchor([[(ring[k - 1], p) for ring in members_of(rings) for k, p in enumerate(ring)] for rings in polygons], 1)


def are_joined(edges, p, q):
    """Do edges on the line through p and q cover the segment between the two?"""
    def along(x):
        return (x[0] - p[0]) * (q[0] - p[0]) + (x[1] - p[1]) * (q[1] - p[1])
    spans = sorted(sorted(map(along, e)) for e in edges if plane.side(p, q, e[0]) == 0 and plane.side(p, q, e[1]) == 0)
    reached = 0
    for low, high in spans:
        if low <= reached:
            reached = max(reached, high)
    return reached >= along(q) and p != q


def turn(p, q, u):
    """Positive if the path turns left at q."""
    return (q[0] - p[0]) * (u[1] - p[1]) - (q[1] - p[1]) * (u[0] - p[0])


def root_above(value):
    """An upper bound of the root, as a fraction, exact to a share of 2^-100."""
    value = Fraction(value)
    shift = max(0, 102 - (value.numerator.bit_length() - value.denominator.bit_length()) // 2)
    return Fraction(math.isqrt(-(-(value.numerator << 2 * shift) // value.denominator)) + 1, 1 << shift)
