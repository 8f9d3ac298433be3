"""The nearest free place of a symbol that keeps a gap, for alone_in_rooms.py.

For each edge E of a barrier, the places that are too near are bounded by the sides of E + (-S), moved outwards by the
gap, and by circles about its corners whose radius is the gap. So the candidates are the feet of the perpendiculars
from the start on these curves and on the boundaries of the shadows of lines, and all crossings of these curves.
Candidates are computed in doubles. A place next to a candidate is accepted after an exact test in rationals (squared
distances to all edges of barriers), so every place that is found is free. A free place can be missed between two
curves that cross at a very small angle."""
import math
from fractions import Fraction as F

BESIDE = 1e-7     # distance of the places tried from a candidate
DIRECTIONS = 32   # the number of these places
DEEP = 1e-6       # a place nearer than the gap by at least this much has only forbidden places around it


def point_to_segment(p, a, b):
    """The squared distance, computed in the number type of the arguments."""
    d = (b[0] - a[0], b[1] - a[1])
    s = (p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]
    size = d[0] * d[0] + d[1] * d[1]
    if s <= 0:
        e = (p[0] - a[0], p[1] - a[1])
    elif s >= size:
        e = (p[0] - b[0], p[1] - b[1])
    else:
        across = d[0] * (p[1] - a[1]) - d[1] * (p[0] - a[0])
        return across * across / size
    return e[0] * e[0] + e[1] * e[1]


def is_too_near(ring, p, q, gap):
    """Is an edge of the ring nearer to the segment pq than the gap? Exact, in rationals. The two do not cross, so the
    distances of corners decide."""
    sides = list(zip(ring, ring[1:] + ring[:1]))
    return any(point_to_segment(c, a, b) < gap * gap for a, b in sides for c in (p, q)) or \
        any(point_to_segment(c, p, q) < gap * gap for c in ring)


def depth(t, ring):
    """The depth of t in a convex, counter-clockwise ring; outside minus its distance. In doubles."""
    deepest = -math.inf
    for (ax, ay), (bx, by) in ring:
        across = ((bx - ax) * (t[1] - ay) - (by - ay) * (t[0] - ax)) / math.hypot(bx - ax, by - ay)
        deepest = max(deepest, -across)
    if deepest <= 0:
        return -deepest
    return -math.sqrt(min(point_to_segment(t, a, b) for a, b in ring))


def segment_crossing(a, b, c, d):
    u, v = (b[0] - a[0], b[1] - a[1]), (d[0] - c[0], d[1] - c[1])
    turn = u[0] * v[1] - u[1] * v[0]
    if turn == 0:
        return
    s = ((c[0] - a[0]) * v[1] - (c[1] - a[1]) * v[0]) / turn
    r = ((c[0] - a[0]) * u[1] - (c[1] - a[1]) * u[0]) / turn
    if 0 <= s <= 1 and 0 <= r <= 1:
        yield (a[0] + s * u[0], a[1] + s * u[1])


def circle_crossings(a, b, centre, radius):
    u, w = (b[0] - a[0], b[1] - a[1]), (a[0] - centre[0], a[1] - centre[1])
    size, along = u[0] * u[0] + u[1] * u[1], u[0] * w[0] + u[1] * w[1]
    root = along * along - size * (w[0] * w[0] + w[1] * w[1] - radius * radius)
    if root < 0 or size == 0:
        return
    for s in ((-along - math.sqrt(root)) / size, (-along + math.sqrt(root)) / size):
        if 0 <= s <= 1:
            yield (a[0] + s * u[0], a[1] + s * u[1])


def circles_crossings(p, q, radius):
    u = (q[0] - p[0], q[1] - p[1])
    far = math.hypot(*u)
    if far == 0 or far > 2 * radius:
        return
    high = math.sqrt(max(radius * radius - far * far / 4, 0)) / far
    for sign in (1, -1):
        yield (p[0] + u[0] / 2 - sign * high * u[1], p[1] + u[1] / 2 + sign * high * u[0])


def candidates(rings, walls, gap, far):
    segments, circles = [], set()
    for ring in rings:
        for a, b in ring:
            size = math.hypot(b[0] - a[0], b[1] - a[1])
            n = (gap * (b[1] - a[1]) / size, -gap * (b[0] - a[0]) / size)
            segments.append(((a[0] + n[0], a[1] + n[1]), (b[0] + n[0], b[1] + n[1])))
            circles.add(a)
    for p, q in walls:
        segments.append((p, q))
        segments += [(x, (x[0] * far / math.hypot(*x), x[1] * far / math.hypot(*x))) for x in (p, q)]
    circles = sorted(circles)
    for k, (a, b) in enumerate(segments):
        u = (b[0] - a[0], b[1] - a[1])
        size = u[0] * u[0] + u[1] * u[1]
        s = min(max(-(a[0] * u[0] + a[1] * u[1]) / size, 0), 1) if size else 0
        yield (a[0] + s * u[0], a[1] + s * u[1])
        yield a
        for c, d in segments[:k]:
            yield from segment_crossing(a, b, c, d)
        for centre in circles:
            yield from circle_crossings(a, b, centre, gap)
    for k, c in enumerate(circles):
        away = math.hypot(*c)
        for sign in (1, -1):
            if away:
                yield (c[0] + sign * gap * c[0] / away, c[1] + sign * gap * c[1] / away)
        for other in circles[:k]:
            yield from circles_crossings(c, other, gap)


def is_behind(t, p, q):
    """Is t deep in the shadow of the segment pq, seen from the origin?"""
    turn = 1 if p[0] * q[1] - p[1] * q[0] > 0 else -1
    beyond = turn * ((q[0] - p[0]) * (t[1] - p[1]) - (q[1] - p[1]) * (t[0] - p[0]))
    return beyond < -DEEP * math.hypot(q[0] - p[0], q[1] - p[1]) and \
        turn * (p[0] * t[1] - p[1] * t[0]) > DEEP * math.hypot(*p) and \
        turn * (q[0] * t[1] - q[1] * t[0]) < -DEEP * math.hypot(*q)


def nearest(rings, walls, gap, is_free):
    """The distance of a free place that is at most BESIDE farther than the nearest one; None: none was found. rings:
    the sides of E + (-S) for each edge E; walls: the lines with sides, relative to the anchor; is_free: the exact
    test."""
    rings = [[((float(a[0]), float(a[1])), (float(b[0]), float(b[1]))) for a, b in ring] for ring in rings]
    walls = [((float(p[0]), float(p[1])), (float(q[0]), float(q[1]))) for p, q in walls]
    far = 4 * (gap + sum(max(abs(x) for side in ring for p in side for x in p) for ring in rings))
    last = None
    for off, t in sorted((math.hypot(*t), t) for t in candidates(rings, walls, gap, far)):
        if t == last or any(is_behind(t, p, q) for p, q in walls) or any(depth(t, ring) > DEEP - gap for ring in rings):
            continue
        last = t
        for k in range(DIRECTIONS):
            turn = 2 * math.pi * k / DIRECTIONS
            place = (t[0] + BESIDE * math.cos(turn), t[1] + BESIDE * math.sin(turn))
            if all(depth(place, ring) <= -gap for ring in rings) and is_free((F(place[0]), F(place[1]))):
                return off
    return None
