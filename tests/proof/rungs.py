"""Is a smaller shape of the file one that its rung allows (docs/PROOF.md, section 6)? In integers and fractions; what is rounded in the
program may be off by a hair.

    trim     the shape keeps its distance from barriers: hiding.py
    inset    no strip along a side of the block's outline meets it, and no triangle between strips where the outline turns outwards; its
             corners are on walls of the shape before, or as near to a side as the length says, or nearer than twice that to a place where the
             outline turns outwards; a wall that two members share is cut at one place, except by the cut that ends an arm
    scaled   the shape as given, scaled about some point; of a feature in no block with others
    square   a square along the longest edge of the shape as given
"""
from fractions import Fraction

from exact import plane
from form import demand
from problem import root_above
from sides import HAIR, POINT, Sides, corners_of, cross, dot, follow_each_other, is_near, is_on_line, middle_of, near, vector

FACTORS = 0.8, 0.6


class Rungs:
    def __init__(self, problem, options):
        """options: with lengths in units of the layer."""
        self.problem = problem
        self.rungs = [("trim", None)] if options.trim else []
        self.rungs += [("inset", length) for length in options.inset]
        if options.symbol_size is not None:
            self.rungs += [("scaled", factor) for factor in FACTORS] + [("square", options.symbol_size)]
        self.of = {}  # features: the rungs of their smaller shapes

    def begin(self):
        self.of = {}
        self.sides = Sides(self.problem, self.base)

    def is_trimmed(self, rung):
        return self.rungs[rung][0] == "trim"

    def demand_all(self):
        """Fails unless each shape of problem.smaller is one that its rung, self.of, allows."""
        for fid, own in self.of.items():
            for level, rung in enumerate(own):
                kind, number = self.rungs[rung]
                shape = self.problem.smaller[fid][level]
                if kind == "inset":
                    self.demand_inset(fid, rung, level, shape, self.problem.lattice(number))
                elif kind == "scaled":
                    self.demand_scaled(fid, shape, Fraction(number))
                elif kind == "square":
                    self.demand_square(fid, shape, self.problem.lattice(number))

    def hair(self, fid, share=HAIR):
        return self.sides.hair(fid, share)

    # ---- Insets

    def base(self, fid):
        """The shape whose outline is moved in: trimmed, or as given."""
        own = self.of.get(fid, [])
        return self.problem.smaller[fid][0] if own and self.is_trimmed(own[0]) else self.problem.original[fid]

    def before(self, fid, level):
        return self.problem.smaller[fid][level - 1] if level else self.problem.original[fid]

    def demand_inset(self, fid, rung, level, shape, depth):
        hair, outline = self.hair(fid), shape.whole()
        sides = [s for s in self.sides.of(self.problem.blocks.block(fid)) if plane.boxes_near(plane.edge_box(s), outline.box, 2 * depth + hair)]
        reach = max(self.problem.lattice(self.problem.tolerance), hair) + hair
        for side in sides if depth > 2 * hair else ():
            if any(plane.edges_nearer(e, side, depth) for e in plane.near_edges(outline, plane.edge_box(side), depth)):
                strip = strip_along(side, depth - hair, hair, *(steepest(side, sides, end, reach) for end in (0, 1)))
                demand(not strip or not plane.interiors_meet(outline, strip), "a smaller shape of", fid, "is too near the outline")
                corner = corner_beyond(side, sides, depth - hair, hair, self.hair(fid, POINT))
                demand(not corner or not plane.interiors_meet(outline, corner), "a smaller shape of", fid, "is too near a corner of the outline")
        walls = self.before(fid, level).whole().edges
        ends = [s[1] for s in sides if any(cross(vector(*s), vector(*g)) < 0 for g in sides if near(g[0], s[1], reach))]
        for p in corners_of(outline):
            demand(is_near(p, walls, hair) or is_near(p, sides, depth + hair) or any(near(p, q, 2 * depth + reach) for q in ends), "a smaller shape of", fid, "is cut where the outline is far")
        for other in self.problem.blocks.block(fid):
            if other != fid and rung in self.of.get(other, ()):
                self.demand_wall_kept(fid, shape, other, self.problem.smaller[other][self.of[other].index(rung)], hair)

    def demand_wall_kept(self, fid, shape, other, others, hair):
        """Two shapes share a wall. Fails if this shape leaves the wall at a corner that the other shape does not have."""
        outline, its = shape.whole(), others.whole()
        if not plane.boxes_near(outline.box, its.box, hair):
            return
        own, its_own = self.base(fid).whole(), self.base(other).whole()
        walls = [g for g in its.edges if plane.boxes_near(plane.edge_box(g), outline.box, hair) and is_on_wall(g, its_own, hair)]
        corners = [*corners_of(its), *corners_of(own)]
        for ring in outline.rings:
            for k, p in enumerate(ring):
                along = [g for g in walls if is_near(p, [g], hair) for q in (ring[k - 1], ring[k + 1 - len(ring)])
                         if not near(p, q, 8 * hair) and is_on_line(q, g, 4 * hair) and is_on_wall((p, q), own, hair)]
                demand(not along or any(near(p, q, 4 * hair) for q in corners) or self.ends_arm(ring, k, own, hair),
                       "the wall of", fid, "and", other, "is no longer shared")

    def ends_arm(self, ring, k, own, hair):
        """Is corner k an end of a cut through the shape `own` that is no longer than the least size?"""
        most = self.problem.lattice(self.problem.options.min_size or 0) * (1 + Fraction(1, 64))
        cuts = [(ring[k], q) for q in (ring[k - 1], ring[k + 1 - len(ring)]) if dot(vector(ring[k], q), vector(ring[k], q)) <= most * most]
        return any(not is_on_wall(e, own, hair) for e in cuts)

    # ---- Scaled shapes, and squares

    def demand_scaled(self, fid, shape, factor):
        demand(len(self.problem.blocks.block(fid)) == 1, "a scaled shape of", fid, ", which is in a block")
        hair, p, q = 16 * self.hair(fid), self.problem.original[fid].whole(), shape.whole()
        about = [(q.box[c] - factor * p.box[c]) / (1 - factor) for c in (0, 1)]

        def place(at):
            return tuple(about[c] + factor * (at[c] - about[c]) for c in (0, 1))
        image = [(place(a), place(b)) for a, b in p.edges]
        demand(len(p.rings) == len(q.rings) and follow_each_other(image, q.edges, hair), "a smaller shape of", fid, "is not the one as given, scaled by", float(factor))

    def demand_square(self, fid, shape, side):
        """All four sides have the length, and adjacent ones are at right angles; two run along the longest edge."""
        hair, rings = 16 * self.hair(fid), [ring for polygon in shape.polygons for ring in polygon]
        demand(len(rings) == 1 and len(rings[0]) == 4, "a symbol of", fid, "is no square")
        steps = [vector(rings[0][k - 1], rings[0][k]) for k in range(4)]
        off = 4 * hair * (side + hair)
        demand(all(abs(dot(u, u) - side * side) <= off for u in steps) and all(abs(dot(steps[k - 1], steps[k])) <= off for k in range(4)),
               "a symbol of", fid, "is no square with the side of its rung")
        edges = [vector(a, b) for a, b in self.problem.original[fid].whole().edges]
        most = max(dot(u, u) for u in edges)
        longest = [u for u in edges if dot(u, u) * (1 + Fraction(1, 1 << 30)) >= most]
        demand(any(min(abs(dot(u, v)), abs(cross(u, v))) ** 2 <= 16 * hair * hair * most for u in longest for v in steps[:1]),
               "a symbol of", fid, "does not stand along its longest edge")


# ---- Strips

def is_on_wall(e, outline, most):
    return all(is_near(p, outline.edges, most) for p in (*e, middle_of(*e)))


def half_turn(u, v):
    """A rational about the tangent of half of the angle from u to v; None if they are opposite."""
    lengths = root_above(dot(u, u)) * root_above(dot(v, v))
    return None if lengths + dot(u, v) <= 0 else Fraction(cross(u, v)) / (lengths + dot(u, v))


def steepest(side, sides, end, reach):
    """The greatest tangent of half of a turn inwards at an end of the side, to any side that may go on there. The strips of the two may
    end at the line between them."""
    found = Fraction(0)
    for other in sides:
        if other is not side and near(other[1 - end], side[end], reach):
            tangent = half_turn(vector(*other), vector(*side)) if end == 0 else half_turn(vector(*side), vector(*other))
            found = max(found, 4 if tangent is None else tangent)
    return found


def strip_along(side, depth, hair, at_start, at_end):
    """The strip on the left of a side, shorter at both ends: by a hair, and within by the tangent at that end times the depth, but by no more
    than a quarter of the side. None if nothing is left."""
    a, b = side
    u = vector(a, b)
    length = root_above(dot(u, u))
    if length <= 4 * hair:
        return None

    def beside(p, along, off):
        return p[0] + (along * u[0] - off * u[1]) / length, p[1] + (along * u[1] + off * u[0]) / length
    cut = [min(depth * tangent, length / 4) + hair for tangent in (at_start, at_end)]
    return plane.Outline([[beside(a, hair, 0), beside(b, -hair, 0), beside(b, -cut[1], depth), beside(a, cut[0], depth)]])


def corner_beyond(side, sides, depth, hair, point):
    """Where the outline turns to the right at the end of the side, the triangle between its strip and that of the next one. None where it
    turns otherwise, or where more sides than one may go on."""
    after = [s for s in sides if s is not side and near(s[0], side[1], point)]
    if len(after) != 1 or sum(near(s[1], side[1], point) for s in sides) != 1:
        return None
    u, v, at = vector(*side), vector(*after[0]), side[1]
    if cross(u, v) >= 0:
        return None
    tips = [(-depth * w[1] / root_above(dot(w, w)), depth * w[0] / root_above(dot(w, w))) for w in (v, u)]
    middle = tips[0][0] + tips[1][0], tips[0][1] + tips[1][1]
    size = root_above(dot(middle, middle))
    if size <= 8 * hair or abs(cross(*tips)) <= 8 * hair * depth:
        return None
    off = 2 * hair * middle[0] / size, 2 * hair * middle[1] / size
    return plane.Outline([[(at[0] + off[0] + s * x, at[1] + off[1] + s * y) for x, y, s in ((0, 0, 1), *((x, y, 1 - 4 * hair / depth) for x, y in tips))]])
