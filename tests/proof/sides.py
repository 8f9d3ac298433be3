"""The sides of blocks: the outlines without the walls between members, in fractions.

A side is a part of an edge of a member that no edge of another member accompanies up to the block tolerance, and that does not lie in
another member. What is nearer than a hair, a share of the largest coordinate, counts as equal.
"""
from fractions import Fraction

from exact import plane

HAIR, POINT = 1 << 40, 1 << 47  # shares of the largest coordinate
ALONG = Fraction(49, 100)       # square of the cosine of edges that accompany each other


class Sides:
    """shape: a function that returns the shape of a member."""

    def __init__(self, problem, shape):
        self.problem, self.shape, self.known = problem, shape, {}

    def hair(self, fid, share=HAIR):
        return Fraction(max(map(abs, self.problem.original[fid].whole().box)), share)

    def of(self, block):
        if block not in self.known:
            own = {fid: directed_edges(self.shape(fid)) for fid in block}
            self.known[block] = [s for fid in block for e in own[fid] for s in self.parts(fid, e, own)] if len(block) > 1 else own[block[0]]
            self.known[block] = in_line(self.known[block], self.hair(block[0], POINT), self.hair(block[0]))
        return self.known[block]

    def parts(self, fid, e, edges):
        """The parts of an edge that are sides: it is divided where edges of other members begin to accompany it, or cross it."""
        hair = self.hair(fid)
        tolerance = max(self.problem.lattice(self.problem.tolerance), hair) + hair
        box = plane.edge_box(e)
        close = [(other, g) for other, own in edges.items() if other != fid for g in own if plane.boxes_near(plane.edge_box(g), box, tolerance)]
        at = sorted({Fraction(0), Fraction(1), *(t for _, g in close for t in divisions(e, g) if 0 < t < 1)})
        found, goes_on = [], False
        for s, t in zip(at, at[1:]):
            goes_on, before = not self.is_inner(fid, e, on_edge(e, (s + t) / 2), close, tolerance, hair), goes_on
            if goes_on and before:
                found[-1] = found[-1][0], on_edge(e, t)
            elif goes_on:
                found.append((on_edge(e, s), on_edge(e, t)))
        return found

    def is_inner(self, fid, e, p, close, tolerance, hair):
        if any(accompanies(e, g) and is_beside(p, g) and is_near(p, [g], tolerance) for _, g in close):
            return True
        for other in self.problem.blocks.block(fid):
            if other != fid and any(o.box and plane.locate(o, p) > 0 for o in self.shape(other).outlines):
                return not is_near(p, [g for m, g in close if m == other], tolerance - 2 * hair)
        return False


# ---- Geometry

def vector(p, q):
    return q[0] - p[0], q[1] - p[1]


def dot(u, v):
    return u[0] * v[0] + u[1] * v[1]


def cross(u, v):
    return u[0] * v[1] - u[1] * v[0]


def middle_of(p, q):
    return Fraction(p[0] + q[0]) / 2, Fraction(p[1] + q[1]) / 2


def on_edge(e, t):
    (ax, ay), (bx, by) = e
    return ax + t * (bx - ax), ay + t * (by - ay)


def near(p, q, most):
    u = vector(p, q)
    return dot(u, u) <= most * most


def is_near(p, edges, most):
    """Is one of the edges no farther than this from p?"""
    for e in edges:
        if plane.boxes_near(plane.edge_box(e), (*p, *p), most):
            n, m = plane.square_to_edge(p, e)
            if n <= most * most * m:
                return True
    return False


def is_on_line(p, e, most):
    u = vector(*e)
    return cross(u, vector(e[0], p)) ** 2 <= most * most * dot(u, u)


def is_beside(p, e):
    """Is the point of the edge's line that is nearest to p on the edge?"""
    u = vector(*e)
    return 0 <= dot(vector(e[0], p), u) <= dot(u, u)


def accompanies(e, g):
    """Does g run along e in the other direction, up to an angle?"""
    u, v = vector(*e), vector(*g)
    along = dot(u, v)
    return along < 0 and along * along >= ALONG * dot(u, u) * dot(v, v)


def divisions(e, g):
    """Where g divides e, as shares of its length."""
    u, v, w = vector(*e), vector(*g), vector(e[0], g[0])
    if accompanies(e, g):
        return [Fraction(dot(vector(e[0], p), u)) / dot(u, u) for p in g]
    turn = cross(u, v)
    if turn == 0 or not 0 <= Fraction(cross(w, u)) / turn <= 1:
        return []
    return [Fraction(cross(w, v)) / turn]


def follow_each_other(these, those, most):
    """Is each corner of the one on the other, and each middle of an edge of the second on the first?"""
    return (all(is_near(p, these, most) for a, b in those for p in (a, middle_of(a, b))) and all(is_near(a, those, most) for a, _ in these))


def corners_of(outline):
    return [p for ring in outline.rings for p in ring]


def directed_edges(thing):
    """The edges of the polygons, with the inside on their left."""
    found = []
    for outline in thing.outlines:
        for ring in outline.rings:
            edges = [(ring[k - 1], p) for k, p in enumerate(ring) if ring[k - 1] != p]
            if edges:
                (a, b), double = edges[0], outline.scaled(2)
                left = plane.on_its_left(double, (a[0] + b[0], a[1] + b[1]), vector(a, b))
                found += edges if left else [(q, p) for p, q in edges]
    return found


def in_line(sides, point, hair):
    """The sides; two that meet and lie in one line are one."""
    sides = list(sides)
    k = 0
    while k < len(sides):
        a, b = sides[k]
        after = [s for s in sides if s is not sides[k] and near(s[0], b, point)]
        if len(after) == 1 and dot(vector(a, b), vector(*after[0])) > 0 and is_on_line(b, (a, after[0][1]), hair):
            sides[k] = a, after[0][1]
            at = next(i for i, s in enumerate(sides) if s is after[0])
            del sides[at]
            k -= at < k
        else:
            k += 1
    return sides
