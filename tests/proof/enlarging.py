"""Are the features of a file larger than as given where --enlarge asks for it, and as large as that (docs/PROOF.md, section 6)? In fractions,
up to a hair; whether a disc fits is decided in doubles, up to a share of the width (room.py).

A part of a block, polygons no farther apart than the block tolerance, grows if no disc of the least size fits in it. It is stretched along the
narrowest of the boxes with a side along its convex hull, and across it, about the middle of the box: to the least size where the box is
less, and then in both directions alike until the disc fits. If the parts meet then, the block grows as one, in both directions alike, by the
largest factor of a part.
"""
from fractions import Fraction

from cover import hull
from exact import plane
from form import NotRead, demand
from problem import Thing, root_above
from repair import repaired
from room import Room
from sides import Sides, cross, dot, follow_each_other, vector

SHARE = 2.0 ** -10           # of the width, up to which the program finds the radius of the largest disc
ALIKE = Fraction(1, 1 << 20)
NOT_YET, BEYOND = "is not made as large as the least size", "is made larger than the least size needs"


class Box:
    """The box around some corners with a side along the vector u; a map of the plane stretches it about its middle."""

    def __init__(self, corners, u):
        self.u, self.square, self.norm = u, dot(u, u), root_above(dot(u, u))
        ends = [(min(v), max(v)) for v in zip(*((dot(u, p), cross(u, p)) for p in corners))]
        self.middle = [Fraction(low + high) / 2 for low, high in ends]
        self.length, self.width = (Fraction(high - low) / self.norm for low, high in ends)

    def seen(self, p):
        """Along the box and across it from its middle, in units of the lattice."""
        return (dot(self.u, p) - self.middle[0]) / self.norm, (cross(self.u, p) - self.middle[1]) / self.norm

    def image(self, p, factors):
        x, y = ((factor - 1) * v / self.norm for factor, v in zip(factors, self.seen(p)))
        (ux, uy) = self.u
        return p[0] + x * ux - y * uy, p[1] + x * uy + y * ux

    def extent(self, corners):
        along = [dot(self.u, p) for p in corners]
        return Fraction(max(along) - min(along)) / self.norm


class Part:
    """Polygons that grow as one: items are (FID, number of the polygon, its outline as given)."""

    def __init__(self, items, hair):
        self.items, self.hair, self.rooms = items, hair, {}
        self.corners = [p for _, _, o in items for ring in o.rings for p in ring]
        corners = hull(self.corners)
        boxes = [Box(corners, vector(corners[k - 1], p)) for k, p in enumerate(corners)]
        least = min(box.width for box in boxes)
        self.boxes = []  # the narrowest ones, up to the hair; without those that are parallel to another
        for box in boxes:
            if box.width <= least + hair and all(cross(box.u, other.u) for other in self.boxes):
                self.boxes.append(box)

    def fids(self):
        return list(dict.fromkeys(fid for fid, _, _ in self.items))


class Enlarging:
    def __init__(self, problem, least):
        self.problem, self.least = problem, problem.lattice(least)
        self.sides = Sides(problem, problem.as_read.get)
        self.parts, self.right = {}, set()

    # ---- The lines

    def read(self, lines):
        """Verifies the larger shapes of the file; returns their polygons. A feature without a line is as given."""
        problem, polygons = self.problem, {}
        for told in lines:
            fid = told["fid"]
            demand(fid in problem.place and fid not in problem.skipped, "there is no feature", fid)
            demand(fid not in polygons, fid, "has two larger shapes")
            polygons[fid] = [[[tuple(p) for p in ring] for ring in polygon] for polygon in told["polygons"]]
            demand(all(repaired(p) is p for p in polygons[fid]), "a larger shape of", fid, "is no polygon")
        for block in dict.fromkeys(problem.blocks.block(fid) for fid in problem.place if fid not in problem.skipped):
            key = block, repr([polygons.get(fid) for fid in block])
            if key not in self.right:
                self.demand_block(block, {fid: Thing(problem.lattice, polygons[fid], []) for fid in block if fid in polygons})
                self.right.add(key)
        return polygons

    def demand_block(self, block, larger):
        """larger: the larger shapes of members."""
        kept = [fid for fid in block if fid in self.problem.rigid]
        if kept:
            demand(not larger, "a larger shape of", next(iter(larger), None), ", whose block never changes its shapes")
            return
        if any(self.problem.is_repaired(fid) or self.problem.as_read[fid].is_joined() for fid in block):
            if larger:
                raise NotRead(f"{next(iter(larger))} is larger, and it is invalid, or in a block with an invalid feature")
            return
        now = {fid: larger.get(fid, self.problem.as_read[fid]) for fid in block}
        parts = self.parts_of(block)
        wrong = self.wrong_parts(parts, now, None if len(parts) == 1 else {fid: len(self.problem.as_read[fid].outlines) for fid in block})
        demand(not wrong or (len(parts) > 1 and larger and self.grew_as_one(parts, now)), *wrong or ())

    def wrong_parts(self, parts, now, numbers):
        """What is wrong if each part grows about its own middle; numbers: see pairs_of(). None: nothing."""
        pairs = [pairs_of(part, now, numbers) for part in parts]
        for part, own in zip(parts, pairs):
            wrong = self.wrong_part(part, own)
            if wrong:
                return wrong
        grown = [[after for _, _, after in own] for own in pairs]
        if any(plane.interiors_meet(*met) for k, own in enumerate(grown) for other in grown[:k] for met in zip_all(own, other)):
            return parts[0].fids()[0], "has parts that meet when each of them is larger"
        return None

    # ---- Parts

    def parts_of(self, block):
        if block not in self.parts:
            items = [(fid, k, o) for fid in block for k, o in enumerate(self.problem.as_read[fid].outlines) if o.box]
            hair, found = self.sides.hair(block[0]), []
            for item in items:
                near = [group for group in found if any(self.hang_together(item[2], o, hair) for _, _, o in group)]
                found = [group for group in found if all(group is not other for other in near)]
                found.append([i for group in near for i in group] + [item])
            self.parts[block] = [Part(sorted(group, key=items.index), hair) for group in found]
        return self.parts[block]

    def hang_together(self, p, q, hair):
        return self.problem.blocks.touch(p, q) or plane.interiors_meet(p, q) or plane.nearer(p, q, hair / 16)

    def room(self, part, box, factors):
        """Where a disc may lie in a part, stretched by these factors; in multiples of the least size."""
        if (box.u, factors) not in part.rooms:
            crack = max(self.problem.lattice(self.problem.tolerance), part.hair)

            def seen(e):
                return [tuple(float(f * v / self.least) for f, v in zip(factors, box.seen(p))) for p in e]
            around = plane.box_of(part.corners)
            walls = [s for s in self.sides.of(self.problem.blocks.block(part.items[0][0])) if plane.boxes_near(plane.edge_box(s), around, crack)]
            part.rooms[box.u, factors] = Room([seen(e) for e in walls], [[seen(e) for e in o.edges] for _, _, o in part.items],
                                              float(crack * factors[1] / self.least))
        return part.rooms[box.u, factors]

    def first_factors(self, box):
        """Of a part that grows: those by which its box reaches the least size."""
        return tuple(max(Fraction(1), self.least / side) for side in (box.length, box.width))

    def share(self, box, factors=(1, 1)):
        return SHARE * float(box.width * factors[1] / self.least)

    def may_stay(self, part):
        box = part.boxes[0]
        share = self.share(box)
        return self.room(part, box, (Fraction(1),) * 2).fits(0.5 - 2 * share, share)

    def may_grow(self, part, box):
        """A disc is no wider than the box of one polygon."""
        share = self.share(box)
        return (len(part.items) == 1 and box.width * (1 + ALIKE) < self.least) or \
            not self.room(part, box, (Fraction(1),) * 2).fits(0.5 + share / 16, 3 * share)

    def wrong_size(self, part, box, more):
        """Of a part that was stretched to the least size and then by this factor."""
        factors = self.first_factors(box)
        share, room = self.share(box, factors), self.room(part, box, factors)
        if not self.may_grow(part, box):
            return "is made larger, though a disc of the least size fits in it"
        radius = 0.5 / float(more)
        if more < 1 or not room.fits(radius - 2 * share, share):
            return NOT_YET
        return BEYOND if more > 1 and room.fits(radius + 17 / 16 * share, 3 * share) else None

    def wrong_part(self, part, pairs):
        """pairs: see pairs_of()."""
        fid, *_ = part.fids()
        corners = [p for _, _, after in pairs for ring in after.rings for p in ring]
        if sorted(corners) == sorted(part.corners) or all(follow_each_other(before.edges, after.edges, part.hair) for _, before, after in pairs):
            return None if self.may_stay(part) else (fid, "is not made larger, though no disc of the least size fits in it")
        for box in part.boxes:
            factors = self.first_factors(box)
            more = rounded(box.extent(corners) / (box.length * factors[0]), part.hair / box.length)
            wrong = self.wrong_size(part, box, more)
            wrong = (fid, wrong) if wrong else wrong_image(pairs, box, [more * f for f in factors], part.hair)
            if not wrong:
                return None
        return wrong

    # ---- Parts that grow as one

    def grew_as_one(self, parts, now):
        """Did the block grow like one part, by as much as its parts need, and would they meet otherwise?"""
        whole = Part([item for part in parts for item in part.items], parts[0].hair)
        pairs = pairs_of(whole, now)
        corners = [p for _, _, after in pairs for ring in after.rings for p in ring]
        for box in whole.boxes:
            growth = box.extent(corners) / box.length
            if self.is_needed(parts, growth) and not wrong_image(pairs, box, (growth, growth), whole.hair):
                return self.would_meet(parts)
        return False

    def is_needed(self, parts, growth):
        """Is the growth what one part needs, and enough for the others?"""
        due = []
        for part in parts:
            box = part.boxes[0]
            more = rounded(growth / max(self.first_factors(box)), part.hair / box.width)
            wrong = self.wrong_size(part, box, more)
            if wrong == NOT_YET and not self.may_stay(part):
                return False
            due.append(wrong)
        return None in due

    def would_meet(self, parts):
        """Would the parts meet if each of them grew?"""
        grown = [self.grown(part) for part in parts]
        return any(plane.interiors_meet(p, q) or plane.nearer(p, q, parts[0].hair)
                   for k, own in enumerate(grown) for other in grown[:k] for p, q in zip_all(own, other))

    def grown(self, part):
        """The outlines of a part, larger than it needs by the share that is not decided."""
        box = part.boxes[0]
        if not self.may_grow(part, box):
            return [o for _, _, o in part.items]
        factors = self.first_factors(box)
        share, room = self.share(box, factors), self.room(part, box, factors)
        more = 1 if room.fits(0.5 - share, share) else Fraction(0.5 / (room.largest(share) - share))
        return [plane.Outline([[box.image(p, [more * f for f in factors]) for p in ring] for ring in o.rings]) for _, _, o in part.items]


def rounded(factor, hair):
    """The factor, or 1 if it is that up to the hair."""
    return Fraction(1) if abs(factor - 1) <= 64 * hair else factor


def zip_all(these, those):
    return [(p, q) for p in these for q in those]


def pairs_of(part, now, numbers=None):
    """(FID, outlines as read, outlines now) of each polygon; numbers: how many polygons each feature has. Without them: of each feature."""
    if numbers is None:
        return [(fid, all_of(o for f, _, o in part.items if f == fid), all_of(now[fid].outlines)) for fid in part.fids()]
    for fid, _, _ in part.items:
        demand(len(now[fid].outlines) == numbers[fid], "a larger shape of", fid, "has another number of polygons")
    return [(fid, o, now[fid].outlines[k]) for fid, k, o in part.items]


def all_of(outlines):
    return plane.Outline([ring for o in outlines for ring in o.rings])


def wrong_image(pairs, box, factors, hair):
    hair *= 16 * max(factors)
    for fid, before, after in pairs:
        image = [tuple(box.image(p, factors) for p in e) for e in before.edges]
        if not follow_each_other(image, after.edges, hair):
            return fid, "is not the feature as given, stretched along its box about the middle"
    return None
