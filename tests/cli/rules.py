"""Checks every rule of a separated layer, by code that shares nothing with the program:

    python3 rules.py ORIGINAL|LAYER RESULT|LAYER GAP [barrier=SPEC ...] [max-shift=L] [max-shift-field=F] [tolerance=T]
                     [allow-jumps] [fixed-where=SQL] [no-blocks] [contained=MODE] [anchors=PROGRAM] [pairs-only]

SPEC is the argument of --barrier. Coordinates are scaled to one lattice of integers, so nothing is rounded and every
answer is exact (exact_plane.py). RESULT holds the result's layers. Prints a line for each breach, then counts; status
1 if there is a breach.

  unlisted          a pair that is too near or overlaps, and is neither within a block nor among the conflicts
  phantom           a listed pair that is not in conflict
  worse             a listed pair is worse than at the start: by squared distance, or by the squared least translation
  not_a_translate   coordinates that are not x + dx, rounded to the nearest double
  lost, unknown     a feature that is in only one of the two layers
  limit             a move longer than allowed, or any move of a fixed feature
  side              the path of a side anchor meets a barrier line
  jump              the path of an anchor, relative to another feature, meets the old outline of that feature
  anchor            an anchor that is not inside its feature
  torn, unjoined    a block whose members move differently; a pair within the tolerance in different blocks

An invalid ring is read by the even-odd rule; a feature that the program repaired is counted, and compared as it is
written."""
import math
import subprocess
import sys
from collections import Counter, defaultdict
from fractions import Fraction

import exact_plane as plane
from side_anchor import side_anchor
from rules_layers import CELL, Grid, Lattice, Layers, Options, open_layer, polygons_and_lines, widen


class Checker:
    def __init__(self, layers):
        self.layers = layers
        self.lat = layers.lattice
        self.breaches = []
        self.count = Counter()

    def breach(self, kind, *words):
        self.count["breaches"] += 1
        self.breaches.append("\t".join([kind, *map(str, words)]))

    def metres(self, value):
        return float(Fraction(value, self.layers.unit))

    # ---- Pairs

    def in_conflict(self, a, b, owed):
        """Are the two nearer than required, or do their interiors meet?"""
        if owed > 0:
            return plane.nearer(a, b, owed)
        return plane.interiors_meet(a, b) if a.area else plane.interiors_meet(b, a)

    def same_block(self, a, b):
        block = self.layers.now[a].block
        return block is not None and block == self.layers.now[b].block

    def within(self, a, b):
        """Is one in the other, up to the tolerance? Tests only the corners, a weaker condition than the program's."""
        tolerance = self.lat(self.layers.options.tolerance)
        return plane.corners_lie_in(a, b, tolerance) or plane.corners_lie_in(b, a, tolerance)

    def check_pairs(self):
        lay = self.layers
        gap = self.lat(lay.gap)
        for a, thing in lay.now.items():
            for b in lay.grid_now.near(widen(thing.shape.box, gap)):
                other = lay.now[b].shape
                if b <= a or not plane.boxes_near(thing.shape.box, other.box, gap) or self.same_block(a, b):
                    continue
                self.count["pairs"] += 1
                if ((a, b) not in lay.listed and self.in_conflict(thing.shape, other, gap) and
                        not (lay.options.contained == "ignore" and self.within(thing.shape, other))):
                    self.breach("unlisted", a, b)
        for (a, b), (kind, reason) in lay.listed.items():
            if a not in lay.now or b not in lay.now:
                self.breach("unknown", "conflict", a, b)
            elif reason != "same_block" and not self.same_block(a, b):
                self.count[f"listed {reason}"] += 1
                if not self.in_conflict(lay.now[a].shape, lay.now[b].shape, gap):
                    self.breach("phantom", a, b, kind)
                elif lay.was:
                    self.check_standing((a, b), kind, lay.was[a], lay.was[b], lay.now[a].shape, lay.now[b].shape)

    def check_barriers(self):
        lay = self.layers
        by_key = {thing.key: thing for thing in lay.barriers}
        for a, thing in lay.now.items():
            for k, edges in lay.near_barriers(thing.shape.box, lay.owed_most).items():
                barrier = lay.barriers[k]
                part = plane.Outline()
                part.edges, part.area, part.box = edges, False, edges and plane.box_of([p for e in edges for p in e])
                self.count["barrier pairs"] += 1
                broken = edges and self.in_conflict(thing.shape, part, barrier.owed)
                # A feature inside an area, or around it, may be far from all its edges: their interiors meet.
                if not broken and barrier.shape.area:
                    broken = plane.interiors_meet(thing.shape, barrier.shape)
                if broken and (a, *barrier.key) not in lay.listed_barriers:
                    self.breach("unlisted", a, *barrier.key)
        for (a, *key), (kind, reason) in lay.listed_barriers.items():
            barrier = by_key.get(tuple(key))
            if barrier is None or a not in lay.now:
                self.breach("unknown", "conflict", a, *key)
                continue
            self.count[f"listed {reason}"] += 1
            now = lay.now[a].shape
            if not self.in_conflict(now, barrier.shape, barrier.owed):
                self.breach("phantom", a, *key, kind)
                continue
            meets = plane.interiors_meet(now, barrier.shape)
            drawn = self.in_conflict(now, barrier.shape, barrier.half)
            if kind != ("barrier" if meets else "barrier_drawn" if drawn else "barrier_near"):
                self.breach("phantom", a, *key, kind, "wrong kind")
            if a in lay.was and not plane.lies_in(now, barrier.shape):
                part = self.part_in_reach(barrier.shape, lay.was[a], now)
                self.check_standing((a, *key), kind, lay.was[a], part, now, part)

    @staticmethod
    def part_in_reach(barrier, was, now):
        """Of a line only the edges that can decide the state before or after: those near either position, up to the
        greater of the two distances."""
        if barrier.area:
            return barrier
        nearest = [min(plane.box_square(plane.edge_box(e), s.box) for e in barrier.edges) for s in (was, now)]
        size = max(s.box[2] - s.box[0] + s.box[3] - s.box[1] for s in (was, now))
        d = 2 * size + math.isqrt(max(nearest)) + 1
        return plane.Outline(lines=[list(e) for e in barrier.edges
                                    if any(plane.boxes_near(plane.edge_box(e), s.box, d) for s in (was, now))])

    def check_standing(self, names, kind, a_was, b_was, a, b):
        """Checks that the pair is no worse than at the start, unless both moved by the same vector, which changes
        nothing."""
        u = [tuple(q[i] - p[i] for i in (0, 1)) for p, q in zip(self.corners(a_was), self.corners(a))]
        v = [tuple(q[i] - p[i] for i in (0, 1)) for p, q in zip(self.corners(b_was), self.corners(b))]
        if set(u) == set(v) and len(set(u)) == 1:
            return
        self.count["listed that moved"] += 1
        if kind in ("contained", "duplicate") and self.within(a, b):
            return
        met, meet = plane.interiors_meet(a_was, b_was), plane.interiors_meet(a, b)
        if met != meet:
            if meet:
                self.breach("worse", *names, "now they meet")
            return
        measure = plane.least_square if met else plane.distance_square
        was, now = measure(a_was, b_was), measure(a, b)
        if was is None or now is None:
            self.count["standing not asked (large)"] += 1
        elif now > was if met else now < was:
            self.breach("worse", *names, math.sqrt(was) / self.layers.unit, math.sqrt(now) / self.layers.unit)

    @staticmethod
    def corners(shape):
        return [p for chain in (*shape.rings, *shape.lines) for p in chain]

    # ---- Moves

    def check_moves(self):
        lay = self.layers
        for fid in sorted(lay.was_raw.keys() ^ lay.is_raw.keys()):
            self.breach("lost" if fid in lay.was_raw else "unknown", fid)
        for fid in lay.was_raw.keys() & lay.is_raw.keys():
            _, rings, lines, _ = lay.was_raw[fid]
            attributes, rings_now, lines_now, _ = lay.is_raw[fid]
            dx, dy = attributes.get("sunder_dx") or 0.0, attributes.get("sunder_dy") or 0.0
            moved = [[[(x + dx, y + dy) for x, y in c] for c in group] for group in (rings, lines)]
            if moved != [rings_now, lines_now]:
                geometry_was = sorted(map(len, rings)), sorted(map(len, rings_now))
                if geometry_was[0] != geometry_was[1]:
                    self.count["repaired"] += 1
                else:
                    self.breach("not_a_translate", fid)
            if fid in lay.now:
                self.check_limit(fid, lay.was_raw[fid][0], dx, dy)
            elif dx or dy:
                self.breach("limit", fid, "skipped, and moved")

    def limit_of(self, fid, attributes):
        if fid in self.layers.fixed:
            return 0.0
        options = self.layers.options
        if options.max_shift_field and attributes.get(options.max_shift_field) is not None:
            return float(attributes[options.max_shift_field])
        return options.max_shift

    def check_limit(self, fid, attributes, dx, dy):
        limit = self.limit_of(fid, attributes)
        if limit is not None and Fraction(dx) ** 2 + Fraction(dy) ** 2 > Fraction(limit) ** 2:
            self.breach("limit", fid, math.hypot(dx, dy), limit)

    def check_blocks(self):
        lay = self.layers
        blocks = defaultdict(list)
        for fid, thing in lay.now.items():
            if thing.block is not None:
                blocks[thing.block].append(fid)
        for block, members in blocks.items():
            if len({(lay.now[f].dx, lay.now[f].dy) for f in members}) > 1:
                self.breach("torn", block, *members[:4])
        if lay.options.no_blocks or not lay.was:
            return
        tolerance = self.lat(lay.options.tolerance)
        grid = lay.index(lay.was)
        for a, shape in lay.was.items():
            for b in grid.near(widen(shape.box, tolerance)):
                if b > a and not self.same_block(a, b) and plane.boxes_near(shape.box, lay.was[b].box, tolerance):
                    self.check_joined(a, b, shape, lay.was[b], tolerance)

    def check_joined(self, a, b, p, q, tolerance):
        """Checks a pair in different blocks: it may not be within the tolerance, and where containment joins blocks
        neither may be in the other."""
        self.count["pairs of blocks"] += 1
        if plane.interiors_meet(p, q):
            within = plane.lies_in(p, q) or plane.lies_in(q, p)
            if within and self.layers.options.contained != "block":
                return
            if within:
                self.breach("unjoined", a, b, "one in the other")
                return
            least = plane.least_square(p, q)
            if least is not None and least <= tolerance * tolerance:
                self.breach("unjoined", a, b, "overlap", math.sqrt(least) / self.layers.unit)
        elif plane.nearer(p, q, 2 * tolerance + 1) and plane.distance_square(p, q) <= tolerance * tolerance:
            self.breach("unjoined", a, b, "touch")

    # ---- Paths

    def anchors(self):
        """Anchors before the moves: the start of the line in the displacement layer; the centroid of a convex ring;
        otherwise asks the library."""
        lay = self.layers
        given = lay.displacement_anchors()
        found, open_ones = {}, []
        for fid, shape in lay.was.items():
            if fid in given:
                found[fid] = given[fid]
            elif len(shape.rings) == 1 and is_convex(shape.rings[0]):
                found[fid] = tuple(float(v / lay.unit) for v in centroid(shape.rings[0]))
            else:
                open_ones.append(fid)
        if lay.options.anchors and open_ones:
            found.update(self.ask_anchors(open_ones))
        self.count["anchors not known"] = len(lay.was) - len(found)
        return found

    def ask_anchors(self, fids):
        """Asks the program that prints the library's anchors. check_jumps() checks that they lie in their features."""
        path, _, name = self.layers.original.partition("|")
        source, layer = open_layer(path, name)
        text = []
        for fid in fids:
            feature = layer.GetFeature(fid)  # keep it alive while its geometry is in use
            polygons, _ = polygons_and_lines(feature.GetGeometryRef())
            words = [fid, len(polygons)]
            for rings in polygons:
                words.append(len(rings))
                for ring in rings:
                    words.append(len(ring))
                    words += [v.hex() for p in ring for v in p]
            text.append(" ".join(map(str, words)) + "\n")
        del source
        done = subprocess.run([self.layers.options.anchors], input="".join(text), capture_output=True, text=True,
                              check=True)
        return {int(w[0]): (float.fromhex(w[1]), float.fromhex(w[2])) for w in map(str.split, done.stdout.splitlines())}

    def side_lines(self, box):
        """The lines of barriers with sides that come near a box."""
        near = self.layers.near_barriers(box, 0)
        return [e for k, edges in near.items() if self.layers.barriers[k].side for e in edges]

    def side_anchors(self, known):
        """The side anchors of all moved features; the plain anchor if no line cuts the feature."""
        lay, found = self.layers, {}
        for f in self.moved & known.keys():
            lines = self.side_lines(lay.was[f].box)
            found[f] = side_anchor([lay.was[f]], lines, known[f], lay.unit) if lines else None
            self.count["cut by sides"] += found[f] is not None
            found[f] = found[f] or known[f]
        return found

    def place_anchors(self):
        """Puts anchors and moves on the lattice, which is refined if they need it."""
        lay = self.layers
        known = self.anchors()
        self.moved = {f for f, t in lay.now.items() if t.dx or t.dy}
        side = self.side_anchors(known)
        lat = Lattice()
        lat.k = self.lat.k
        lat.hold_all([known.values(), side.values()])
        factor = 1 << (lat.k - self.lat.k)
        self.at = {f: (lat(x), lat(y)) for f, (x, y) in known.items()}
        self.side_at = {f: (lat(x), lat(y)) for f, (x, y) in side.items()}
        self.shape_was = {f: s.scaled(factor) if factor > 1 else s for f, s in lay.was.items()}
        self.step = {f: (lat(t.dx), lat(t.dy)) for f, t in lay.now.items()}
        self.factor, self.cell = factor, int(CELL * 2 ** lat.k)
        for a in self.moved & self.at.keys():
            if plane.locate(self.shape_was[a], self.at[a]) < 0:
                # Next to a sliver, the anchor rounded to doubles may lie outside the feature, but not outside its box.
                self.count["anchors beside a sliver"] += 1
                if not plane.boxes_near(self.at[a] * 2, self.shape_was[a].box):
                    self.breach("anchor", a, "outside")

    def check_jumps(self):
        moved, at, shapes, step = self.moved, self.at, self.shape_was, self.step
        grid, points = Grid(self.cell), Grid(self.cell)
        for f, s in shapes.items():
            grid.add(f, s.box)
        for f, p in at.items():
            points.add(f, p * 2)
        # The longer of two moves is at least half of the relative one.
        reach = {f: 2 * (abs(step[f][0]) + abs(step[f][1])) for f in moved}
        pairs = {(a, b) for a in moved & at.keys() for b in grid.near(widen(at[a] * 2, reach[a]))}
        pairs |= {(a, b) for b in moved & shapes.keys() for a in points.near(widen(shapes[b].box, reach[b]))}
        for a, b in pairs:
            if a != b and not self.same_block(a, b) and step[a] != step[b]:
                self.check_way("jump", a, b, shapes[b], at[a], (step[a][0] - step[b][0], step[a][1] - step[b][1]))

    def check_sides(self):
        lay = self.layers
        for a in self.moved & self.at.keys():
            start, u = self.side_at[a], self.step[a]
            way = (start, (start[0] + u[0], start[1] + u[1]))
            box = tuple(v // self.factor for v in plane.box_of(way))
            for k, edges in lay.near_barriers(box, 1).items():
                barrier = lay.barriers[k]
                if barrier.side:
                    self.check_side(a, barrier, edges, way)

    def check_side(self, a, barrier, edges, way):
        """Checks the path of an anchor. Points, and lines on which the path begins, cannot be crossed."""
        edges = [tuple((self.factor * x, self.factor * y) for x, y in e) for e in edges if e[0] != e[1]]
        self.count["ways (side)"] += 1
        if not any(plane.edges_meet(way, e) and not plane.on_edge(e, way[0]) for e in edges):
            return
        whole = barrier.shape.scaled(self.factor)
        if not barrier.shape.area or plane.locate(whole, way[0]) <= 0 or not leaves_once(whole, way):
            self.breach("side", a, *barrier.key)

    def check_way(self, kind, a, b, shape, start, u):
        end = (start[0] + u[0], start[1] + u[1])
        way = (start, end)
        box = plane.edge_box(way)
        if not plane.boxes_near(box, shape.box):
            return
        self.count[f"ways ({kind})"] += 1
        edges = plane.near_edges(shape, box)
        if any(plane.edges_meet(way, e) for e in edges) and not (shape.area and plane.locate(shape, start) >= 0):
            self.breach(kind, a, b)

    def run(self):
        if not self.layers.options.pairs_only:
            self.check_moves()
            self.check_blocks()
        self.check_pairs()
        self.check_barriers()
        if not self.layers.options.pairs_only:
            self.place_anchors()
            self.check_sides()
            if not self.layers.options.allow_jumps:
                self.check_jumps()


def leaves_once(shape, way):
    """Is the part of the path within the closed set connected, including the start?"""
    (x, y), (x1, y1) = way
    u = (x1 - x, y1 - y)
    whole = u[0] * u[0] + u[1] * u[1]
    at = {Fraction(0), Fraction(1)}
    for e in plane.near_edges(shape, plane.edge_box(way)):
        crossing = plane.crossing(way, e)
        for p in [crossing] if crossing else [p for p in e if plane.on_edge(way, p)]:
            at.add(Fraction((p[0] - x) * u[0] + (p[1] - y) * u[1]) / whole)
    at = sorted(at)
    k = 2 * math.lcm(*(t.denominator for t in at))
    fine = shape.scaled(k)
    stops = sorted(at + [(s + t) / 2 for s, t in zip(at, at[1:])])
    inside = [plane.locate(fine, (x * k + int(t * k) * u[0], y * k + int(t * k) * u[1])) >= 0 for t in stops]
    return inside == sorted(inside, reverse=True)


def is_convex(ring):
    n = len(ring)
    turns = {plane.side(ring[i - 2], ring[i - 1], ring[i]) for i in range(n)}
    steps = [(ring[i][0] - ring[i - 1][0], ring[i][1] - ring[i - 1][1]) for i in range(n)]
    # A convex ring turns in one direction: it changes exactly twice between up and down.
    ups = [y > 0 or (y == 0 and x > 0) for x, y in steps if x or y]
    return not {1, -1} <= turns and sum(ups[i] != ups[i - 1] for i in range(len(ups))) == 2


def centroid(ring):
    ox, oy = ring[0]
    weight = mx = my = 0
    for (ax, ay), (bx, by) in zip(ring[1:], ring[2:]):
        ux, uy, vx, vy = ax - ox, ay - oy, bx - ox, by - oy
        c = ux * vy - uy * vx
        weight, mx, my = weight + c, mx + c * (ux + vx), my + c * (uy + vy)
    return Fraction(ox) + Fraction(mx, 3 * weight), Fraction(oy) + Fraction(my, 3 * weight)


def check(original, result, gap, words):
    checker = Checker(Layers(original, result, gap, Options(words, gap)))
    checker.run()
    return checker


def main():
    original, result, gap, *words = sys.argv[1:]
    checker = check(original, result, float(gap), words)
    for line in checker.breaches:
        print(line)
    print("; ".join(f"{what}: {n}" for what, n in sorted(checker.count.items()) if n), file=sys.stderr)
    sys.exit(1 if checker.breaches else 0)


if __name__ == "__main__":
    main()
