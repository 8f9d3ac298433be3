"""The blocks of a layer, computed from the layer and the options alone: all pairs of features that join.

Two features join if they have an equal value of --block-field; if they touch, that is, do not overlap and have a
distance whose nearest double is no more than the tolerance; or if one lies in the other up to the tolerance and
--contained is `block`. They also join by a thin overlap: some translation no longer than the tolerance separates the
two, or no disc of that diameter (inside-disc:, 16 corners) fits into the overlap. Doubles only propose places; every
decision is made in fractions.
"""
import math
from fractions import Fraction

import discs
from exact import plane
from form import demand
from geopackage import value_of
from nearly_in import lies_in_grown

TOO_MANY = 60_000
MANY_PLACES = 1500  # number of places of a disc in an overlap above which impossible ones are removed in advance
HALVINGS = 5        # how often a line of such places is halved to find those that are possible


class Blocks:
    """problem: an object with things, lattice, tolerance (a double), options, attributes, skipped."""

    def __init__(self, problem):
        self.problem, self.of, self.known, options = problem, {}, {}, problem.options
        # Symbols join by touch only if a tolerance is given.
        self.touches_join = not options.no_blocks and (not options.points or options.touch_tolerance is not None)
        self.containment_joins = not options.no_blocks and options.contained == "block"
        disc = discs.inside(problem.tolerance / 2, 16) if problem.tolerance / 2 > 0 else []
        for p in disc:
            for v in p:
                problem.lattice.hold(v)
        self.disc_told = disc

    def block(self, fid):
        return self.of.get(fid, (fid,))

    def find(self):
        """All blocks with several members, sorted by their members in the order of the input."""
        parent = {}

        def root(fid):
            while fid in parent:
                fid = parent[fid]
            return fid
        for a, b in self.candidates():
            p, q = root(a), root(b)
            if p != q and self.joins(a, b):
                parent[q] = p
        found = {}
        for fid in self.problem.place:
            found.setdefault(root(fid), []).append(fid)
        for members in found.values():
            if len(members) > 1:
                self.of.update(dict.fromkeys(members, tuple(members)))

    def demand_all(self, told):
        """Demands that the file has exactly these blocks."""
        own = set(self.of.values())
        for fids in map(tuple, told):
            demand(fids in own, "no block, or not all of one:", *fids)
            own.discard(fids)
        demand(not own, "a block is missing:", *next(iter(own), ()))

    # ---- Pairs that may join

    def candidates(self):
        """Pairs of features whose boxes are within the tolerance of each other, or which have equal values."""
        problem, seen = self.problem, set()
        field, values = problem.options.block_field, {}
        fids = [f for f in problem.place if f not in problem.skipped]
        for fid in fids:
            value = value_of(problem.attributes[fid], field)
            if value is not None:
                values.setdefault(value, []).append(fid)
        for own in values.values():
            for pair in zip(own, own[1:]):
                seen.add(pair)
                yield pair
        if not self.touches_join and not self.containment_joins:
            return
        reach = problem.lattice(problem.tolerance) + 1
        boxes = sorted((*self.problem.whole(fid).box, fid) for fid in fids)
        open_ones = []
        for box in boxes:
            open_ones = [o for o in open_ones if o[2] + reach >= box[0]]
            for other in open_ones:
                pair = other[4], box[4]
                if other[1] <= box[3] + reach and box[1] <= other[3] + reach and pair not in seen and pair[::-1] not in seen:
                    yield pair
            open_ones.append(box)

    # ---- Decisions

    def joins(self, a, b):
        field = self.problem.options.block_field
        if field:
            values = [value_of(self.problem.attributes[f], field) for f in (a, b)]
            if values[0] is not None and values[0] == values[1]:
                return True
        if not self.touches_join and not self.containment_joins:
            return False
        if (a, b) not in self.known:
            self.known[a, b] = self.known[b, a] = self.joins_by_place(a, b)
        return self.known[a, b]

    def joins_by_place(self, a, b):
        p, q, problem = self.problem.whole(a), self.problem.whole(b), self.problem
        if not plane.interiors_meet(p, q):
            return self.touches_join and self.touch(p, q)
        tolerance = Fraction(problem.tolerance) * problem.lattice.unit
        for x, y in ((p, q), (q, p)):
            if lies_in_grown(x, y, tolerance, problem.tolerance, problem.lattice.unit):
                return self.containment_joins
        return self.touches_join and problem.tolerance > 0 and (self.parted_within(p, q, tolerance) or not self.disc_fits(p, q, a, b))

    def touch(self, p, q):
        """Is the nearest double of the distance no more than the tolerance?"""
        tolerance, unit = self.problem.tolerance, self.problem.lattice.unit
        if tolerance == 0:
            return plane.boxes_near(p.box, q.box) and any(plane.edges_meet(e, f) for e, f in near_edges(p, q, 0))
        middle = (Fraction(tolerance) + Fraction(math.nextafter(tolerance, math.inf))) / 2 * unit
        even = math.frexp(tolerance)[0] * 2 ** 53 % 2 == 0  # in a tie the even one of two doubles is the nearest
        square, reach = middle * middle, math.ceil(middle)
        for e, f in near_edges(p, q, reach):
            found = plane.edges_square(e, f)
            if found < square or (even and found == square):
                return True
        return False

    def parted_within(self, p, q, most):
        """Is there a translation of q no longer than that which separates the interiors? The nearest place of the
        closed set of such translations is the foot of the perpendicular from the origin on a contact segment, or a
        crossing of two."""
        square, reach = most * most, math.ceil(most)
        segments = contacts(p, q, reach)
        places = set()
        for s in segments:
            x, y = plane.foot(s)
            if x * x + y * y <= square:
                places.add((x * x + y * y, x, y))
        close = [s for s in segments if sum(v * v for v in plane.foot(s)) <= square]
        demand(len(close) ** 2 < TOO_MANY * 32, "two features meet along too many edges")
        for i, s in enumerate(close):
            box = plane.edge_box(s)
            for r in close[:i]:
                if plane.boxes_near(box, plane.edge_box(r)):
                    at = plane.crossing(s, r)
                    if at is not None and at[0] ** 2 + at[1] ** 2 <= square:
                        places.add((at[0] ** 2 + at[1] ** 2, *at))
        return any(plane.parts_them(p, q, x, y) for _, x, y in sorted(places))

    def disc_fits(self, p, q, a, b):
        """Does the disc fit into the intersection?"""
        lattice = self.problem.lattice
        disc = [tuple(map(lattice, v)) for v in self.disc_told]
        box = [f(x, y) for f, x, y in zip((max, max, min, min), p.box, q.box)]
        sizes = [max(v[c] for v in disc) - min(v[c] for v in disc) for c in (0, 1)]
        if any(box[c + 2] - box[c] < sizes[c] for c in (0, 1)):
            return False
        near = [plane.near_edges(o, box) for o in (p, q)]
        if any(fits(disc, at, p, q) for at in proposed(p, q, near, box)):
            return True
        return self.disc_fits_at_a_corner(disc, p, q, near, a, b)

    def disc_fits_at_a_corner(self, disc, p, q, near, a, b):
        """If the disc fits anywhere, it fits at a crossing or an end of contact segments: the set of its possible
        positions is closed and bounded, and its extreme points are of this kind."""
        sides = list(zip(disc, disc[1:] + disc[:1]))
        segments, ends = set(), set()
        for e in {e for edges in near for e in edges}:
            segments |= {tuple((c[0] - v[0], c[1] - v[1]) for c in e) for v in disc}
            for c in e:
                segments |= {tuple((c[0] - v[0], c[1] - v[1]) for v in side) for side in sides}
        least = min(min(Fraction(*plane.square_to_edge((0, 0), s)) for s in sides), Fraction(disc[0][0] ** 2 + disc[0][1] ** 2))

        def has_room(x, y):
            """A quick test, with a smaller disc inside the disc."""
            return all(near_square((x, y), e) >= least for e in edges)
        edges = sorted({e for own in near for e in own})
        segments = sorted(segments)
        if len(segments) > MANY_PLACES:
            segments = [part for s in segments for part in with_room(s, p, q, edges, least, HALVINGS)]
        demand(len(segments) ** 2 <= TOO_MANY * 40, "whether the overlap of", a, "and", b, "is thin is not decided")
        ends = {end for s in segments for end in s}
        if any(has_room(*at) and fits(disc, at, p, q) for at in ends):
            return True
        boxes = [plane.edge_box(s) for s in segments]
        for i, s in enumerate(segments):
            for k in range(i):
                if plane.boxes_near(boxes[i], boxes[k]):
                    at = plane.crossing(s, segments[k])
                    if at is not None and has_room(*at) and fits(disc, at, p, q):
                        return True
        return False


def with_room(segment, p, q, edges, least, halvings):
    """The parts of a segment of disc positions that a quick test keeps: they lie inside p and q, and no edge is
    nearer than the root of `least` to all of the part. edges: all edges of p and q within the intersection."""
    if any(all(near_square(end, e) < least for end in segment) for e in edges):
        return
    if not halvings or all(plane.edges_square(segment, e) >= least for e in edges):
        if any(all(plane.locate(o, end) > 0 for o in (p, q)) for end in segment) or any(plane.edges_meet(segment, e) for e in edges):
            yield segment
        return
    (ax, ay), (bx, by) = segment
    middle = Fraction(ax + bx) / 2, Fraction(ay + by) / 2
    for part in ((segment[0], middle), (middle, segment[1])):
        yield from with_room(part, p, q, edges, least, halvings - 1)


def near_square(p, e):
    """Square of the distance of a rational point from an edge."""
    k = math.lcm(*(Fraction(v).denominator for v in p))
    n, m = plane.square_to_edge((int(p[0] * k), int(p[1] * k)), tuple((k * x, k * y) for x, y in e))
    return Fraction(n, m * k * k)


def near_edges(p, q, reach):
    """Pairs of edges whose boxes are within `reach` of each other."""
    eq = [(f, plane.edge_box(f)) for f in plane.near_edges(q, p.box, reach)]
    for e in plane.near_edges(p, q.box, reach):
        box = plane.edge_box(e)
        for f, own in eq:
            if plane.boxes_near(box, own, reach):
                yield e, f


def contacts(p, q, reach):
    """plane.contact_segments() without those that are farther from the origin than reach."""
    found = set()
    for a, b, sign in ((p, q, 1), (q, p, -1)):
        corners = {v for e in plane.near_edges(b, a.box, reach) for v in e}
        for e in plane.near_edges(a, b.box, reach):
            box = plane.edge_box(e)
            for v in corners:
                if plane.boxes_near(box, (*v, *v), reach):
                    found.add(tuple((sign * (c[0] - v[0]), sign * (c[1] - v[1])) for c in e))
    return sorted(found)


def fits(disc, at, p, q):
    x, y = map(Fraction, at)
    k = math.lcm(x.denominator, y.denominator)
    own = plane.Outline([[(k * v[0] + int(x * k), k * v[1] + int(y * k)) for v in disc]])
    return all(plane.lies_in(own, o.scaled(k) if k > 1 else o) for o in (p, q))


def proposed(p, q, near, box):
    """Places of the intersection that are far from all edges, in doubles: from the points of a grid, each improved
    step by step."""
    ox, oy = (box[0] + box[2]) // 2, (box[1] + box[3]) // 2
    edges = [[(e[0][0] - ox, e[0][1] - oy, e[1][0] - ox, e[1][1] - oy) for e in own] for own in near]
    edges = [[tuple(map(float, e)) for e in own] for own in edges]
    width, height = float(box[2] - box[0]), float(box[3] - box[1])

    def room(x, y):
        found = math.inf
        for own in edges:
            for ax, ay, bx, by in own:
                ex, ey = bx - ax, by - ay
                whole = ex * ex + ey * ey
                t = min(1.0, max(0.0, ((x - ax) * ex + (y - ay) * ey) / whole)) if whole else 0.0
                found = min(found, math.hypot(x - ax - t * ex, y - ay - t * ey))
        return found

    def is_in(x, y):
        at = round(x) + ox, round(y) + oy
        return plane.locate(p, at) > 0 and plane.locate(q, at) > 0
    n = 12
    grid = [((2 * i + 1 - n) * width / (2 * n), (2 * k + 1 - n) * height / (2 * n)) for i in range(n) for k in range(n)]
    grid = sorted(((room(*at), at) for at in grid), reverse=True)
    for _, (x, y) in [g for g in grid if is_in(*g[1])][:4]:
        step, best = max(width, height) / n, room(x, y)
        while step > 1e-6 * max(width, height):
            moves = [(x + step * dx, y + step * dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1) if dx or dy]
            most, at = max((room(*m), m) for m in moves if is_in(*m)) if any(is_in(*m) for m in moves) else (0, None)
            if at and most > best:
                best, (x, y) = most, at
            else:
                step /= 2
        yield round(x) + ox, round(y) + oy
