"""Pairs of polygonal sets and lines in integers: whether their interiors meet, their distance, and the least
translation that separates them. Brute force over edges; nothing is rounded; doubles only order candidates.

A set is an Outline: closed rings or open lines, each a list of integer points. The inside of rings is by the even-odd
rule; lines and points have none. The caller scales all numbers to one lattice, so that every coordinate is an
integer.
"""
import math
from fractions import Fraction


class Outline:
    """The edges, and their bounding box; in lines a single point is an edge of length zero."""

    def __init__(self, rings=(), lines=()):
        self.rings, self.lines = rings, lines
        self.edges = [(r[i - 1], r[i]) for r in rings for i in range(len(r)) if r[i - 1] != r[i]]
        self.area = bool(self.edges)
        for line in lines:
            steps = [(p, q) for p, q in zip(line, line[1:]) if p != q]
            self.edges += steps or [(line[0], line[0])]
        points = [p for e in self.edges for p in e]
        self.box = box_of(points) if points else None

    def moved(self, x, y):
        def shift(chain):
            return [(p[0] + x, p[1] + y) for p in chain]
        return Outline([shift(r) for r in self.rings], [shift(c) for c in self.lines])

    def scaled(self, k):
        def grow(chain):
            return [(k * p[0], k * p[1]) for p in chain]
        return Outline([grow(r) for r in self.rings], [grow(c) for c in self.lines])


def box_of(points):
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    return min(xs), min(ys), max(xs), max(ys)


def boxes_near(a, b, d=0):
    return a[0] <= b[2] + d and b[0] <= a[2] + d and a[1] <= b[3] + d and b[1] <= a[3] + d


def edge_box(e):
    (x0, y0), (x1, y1) = e
    return (x0 if x0 < x1 else x1, y0 if y0 < y1 else y1, x1 if x0 < x1 else x0, y1 if y0 < y1 else y0)


def side(a, b, c):
    value = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (value > 0) - (value < 0)


def on_edge(e, p):
    a, b = e
    return side(a, b, p) == 0 and min(a[0], b[0]) <= p[0] <= max(a[0], b[0]) and min(a[1], b[1]) <= p[1] <= max(a[1], b[1])


def cross_properly(e, f):
    return side(*e, f[0]) * side(*e, f[1]) < 0 and side(*f, e[0]) * side(*f, e[1]) < 0


def edges_meet(e, f):
    """As closed segments; a segment may be a point."""
    return boxes_near(edge_box(e), edge_box(f)) and (cross_properly(e, f) or any(on_edge(e, p) for p in f) or
                                                     any(on_edge(f, p) for p in e))


def locate(outline, p):
    """Returns 1 inside, 0 on the boundary, -1 outside."""
    inside = False
    x, y = p
    for (ax, ay), (bx, by) in outline.edges:
        if (ay > y) == (by > y):
            if ay == y and by == y and min(ax, bx) <= x <= max(ax, bx):
                return 0
            if (ax, ay) == p or (bx, by) == p:
                return 0
            continue
        d = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
        if d == 0:
            return 0
        if (d > 0) == (by > ay):
            inside = not inside
    return 1 if inside and outline.area else -1


def on_its_left(outline, p, u):
    """Is the inside on the left of direction u at p, which lies on an edge along u and is not an end of one?"""
    w = (-u[1], u[0])
    inside = False
    for a, b in outline.edges:
        sa = w[0] * (a[1] - p[1]) - w[1] * (a[0] - p[0])
        sb = w[0] * (b[1] - p[1]) - w[1] * (b[0] - p[0])
        if (sa > 0) == (sb > 0):
            continue
        # if the edge crosses the line p + s w: is s > 0 there?
        d = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
        if d != 0 and (d > 0) == (sb > sa):
            inside = not inside
    return inside


def pieces(e, other):
    """Splits the edge at the corners of the other edges that lie on it, and yields the midpoints of the parts,
    doubled. No edges cross properly."""
    a, b = e
    cuts = {a, b}
    box = edge_box(e)
    for f in other:
        if boxes_near(box, edge_box(f)):
            cuts.update(p for p in f if on_edge(e, p))
    u = (b[0] - a[0], b[1] - a[1])
    cuts = sorted(cuts, key=lambda p: p[0] * u[0] + p[1] * u[1])
    return [(p[0] + q[0], p[1] + q[1]) for p, q in zip(cuts, cuts[1:])] or [(2 * a[0], 2 * a[1])]


def near_edges(outline, box, d=0):
    return [e for e in outline.edges if boxes_near(edge_box(e), box, d)]


def interiors_meet(a, b):
    """Do the interior of a, which has area, and that of b meet? If b has no area: b's lines and points."""
    if not boxes_near(a.box, b.box):
        return False
    ea, eb = near_edges(a, b.box), near_edges(b, a.box)
    boxes = [edge_box(f) for f in eb]
    touching = False
    for e in ea:
        box = edge_box(e)
        for f, g in zip(eb, boxes):
            if boxes_near(box, g):
                if cross_properly(e, f):
                    return True
                touching = True
    if not touching:
        return (locate(a, b.edges[0][0]) > 0 or any(locate(a, f[0]) > 0 for f in eb) or
                (b.area and locate(b, a.edges[0][0]) > 0))
    a2, b2 = a.scaled(2), b.scaled(2)
    for f in eb:
        if any(locate(a2, m) > 0 for m in pieces(f, ea)):
            return True
    if not b.area:
        return False
    for e in ea:
        u = (e[1][0] - e[0][0], e[1][1] - e[0][1])
        for m in pieces(e, eb):
            place = locate(b2, m)
            if place > 0:
                return True
            if place == 0 and on_its_left(a2, m, u) == on_its_left(b2, m, u):
                return True
    return False


def lies_in(a, b):
    """Is the closed set (or line) a within the closed set b? Exact."""
    if not b.area or not boxes_near(a.box, b.box):
        return False
    if any(cross_properly(e, f) for e in a.edges for f in near_edges(b, edge_box(e))):
        return False
    b2 = b.scaled(2)
    for e in a.edges:
        if any(locate(b2, m) < 0 for m in pieces(e, b.edges)):
            return False
    if not a.area:
        return True
    a2 = a.scaled(2)
    for f in near_edges(b, a.box):
        u = (f[1][0] - f[0][0], f[1][1] - f[0][1])
        for m in pieces(f, a.edges):
            place = locate(a2, m)
            if place > 0 or (place == 0 and on_its_left(a2, m, u) != on_its_left(b2, m, u)):
                return False
    return True


def corners_lie_in(a, b, d):
    """Is every corner of a in b, or at most d from it? A necessary condition for "a lies in b up to d"."""
    if not b.area or not boxes_near(a.box, b.box, d):
        return False
    for p in {p for e in a.edges for p in e}:
        if locate(b, p) < 0:
            near = near_edges(b, (*p, *p), d)
            if not any(n <= d * d * m for n, m in (square_to_edge(p, e) for e in near)):
                return False
    return True


def square_to_edge(p, e):
    """(numerator, denominator) of the squared distance of a point."""
    a, b = e
    ux, uy, px, py = b[0] - a[0], b[1] - a[1], p[0] - a[0], p[1] - a[1]
    along, whole = ux * px + uy * py, ux * ux + uy * uy
    if along <= 0:
        return px * px + py * py, 1
    if along >= whole:
        return (px - ux) ** 2 + (py - uy) ** 2, 1
    return (ux * py - uy * px) ** 2, whole


def edges_nearer(e, f, d):
    """Are the closed segments nearer than d, an integer?"""
    d2 = d * d
    for p, g in ((e[0], f), (e[1], f), (f[0], e), (f[1], e)):
        n, m = square_to_edge(p, g)
        if n < d2 * m:
            return True
    return d > 0 and edges_meet(e, f)


def nearer(a, b, d):
    """Are the closed sets nearer than d > 0, an integer?"""
    if not boxes_near(a.box, b.box, d):
        return False
    eb = [(f, edge_box(f)) for f in near_edges(b, a.box, d)]
    for e in near_edges(a, b.box, d):
        box = edge_box(e)
        if any(boxes_near(box, g, d) and edges_nearer(e, f, d) for f, g in eb):
            return True
    return (a.area and locate(a, b.edges[0][0]) >= 0) or (b.area and locate(b, a.edges[0][0]) >= 0)


def edges_square(e, f):
    if edges_meet(e, f):
        return Fraction(0)
    return min(Fraction(*square_to_edge(p, g)) for p, g in ((e[0], f), (e[1], f), (f[0], e), (f[1], e)))


def distance_square(a, b):
    """Squared distance of the closed sets, as a fraction. Pairs of edges whose boxes are farther apart than the least
    distance found are skipped."""
    if interiors_meet(a, b) if a.area else b.area and interiors_meet(b, a):
        return Fraction(0)
    best = None
    order = sorted(((box_square(edge_box(e), edge_box(f)), e, f) for e in a.edges for f in b.edges), key=lambda v: v[0])
    for bound, e, f in order:
        if best is not None and bound >= best:
            break
        square = edges_square(e, f)
        best = square if best is None or square < best else best
    return best


def box_square(a, b):
    x = max(0, a[0] - b[2], b[0] - a[2])
    y = max(0, a[1] - b[3], b[1] - a[3])
    return x * x + y * y


# ---- The least translation ----

def contact_segments(a, b):
    """Moves u of b for which a corner of one lies on an edge of the other. They bound the set of separating moves."""
    corners_a = {p for e in a.edges for p in e}
    corners_b = {p for e in b.edges for p in e}
    found = [((p[0] - v[0], p[1] - v[1]), (q[0] - v[0], q[1] - v[1])) for p, q in a.edges for v in corners_b]
    found += [((v[0] - p[0], v[1] - p[1]), (v[0] - q[0], v[1] - q[1])) for p, q in b.edges for v in corners_a]
    return list(dict.fromkeys(found))


def parts_them(a, b, x, y):
    """Are the interiors disjoint when b is moved by the fractions (x, y)?"""
    k = math.lcm(x.denominator, y.denominator)
    return not interiors_meet(a.scaled(k), b.scaled(k).moved(int(x * k), int(y * k)))


def foot(segment):
    (px, py), (qx, qy) = segment
    ux, uy = qx - px, qy - py
    whole = ux * ux + uy * uy
    t = Fraction(0) if whole == 0 else min(max(Fraction(-(px * ux + py * uy), whole), Fraction(0)), Fraction(1))
    return px + t * ux, py + t * uy


def crossing(s, r):
    (px, py), (qx, qy) = s
    (vx, vy), (wx, wy) = r
    d = (qx - px) * (wy - vy) - (qy - py) * (wx - vx)
    if d == 0:
        return None
    t = Fraction((vx - px) * (wy - vy) - (vy - py) * (wx - vx), d)
    u = Fraction((vx - px) * (qy - py) - (vy - py) * (qx - px), d)
    return (px + t * (qx - px), py + t * (qy - py)) if 0 <= t <= 1 and 0 <= u <= 1 else None


TOO_MANY = 400_000


def least_square(a, b):
    """The squared length of the least move of b that separates the interiors; None if there are too many candidates.

    The nearest point of the closed set of free moves is the foot of the perpendicular from the origin on a contact
    segment, or a crossing of two. First the nearest free foot or end is found, then crossings within that distance
    are tested exactly, nearest first.
    """
    segments = contact_segments(a, b)
    if len(segments) > 20_000:
        return None
    feet = sorted({(x * x + y * y, x, y) for x, y in map(foot, segments)})
    bound = None
    for square, x, y in feet:
        if parts_them(a, b, x, y):
            bound = square
            break
    if bound is None:
        bound = max(x * x + y * y for s in segments for x, y in s)
    close = [s for s, (x, y) in ((s, foot(s)) for s in segments) if x * x + y * y <= bound]
    if len(close) * len(close) > TOO_MANY:
        return None
    places = set()
    for i, s in enumerate(close):
        box = edge_box(s)
        for r in close[:i]:
            if boxes_near(box, edge_box(r)):
                at = crossing(s, r)
                if at is not None and at[0] ** 2 + at[1] ** 2 < bound:
                    places.add((at[0] ** 2 + at[1] ** 2, *at))
    for square, x, y in sorted(places):
        if parts_them(a, b, x, y):
            return square
    return bound
