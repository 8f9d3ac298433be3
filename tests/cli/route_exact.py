"""Exact geometry for the tests of routes, in rationals."""
from fractions import Fraction as F
from functools import lru_cache


def cross(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def hull(points):
    points = sorted(set(points))
    if len(points) < 3:
        return points
    chain = []
    for sweep in (points, points[::-1]):
        start = len(chain)
        for p in sweep:
            while len(chain) >= start + 2 and cross(chain[-2], chain[-1], p) <= 0:
                chain.pop()
            chain.append(p)
        chain.pop()
    return chain


def meets(part, p, q):
    """Does the closed segment pq meet the open convex polygon?"""
    low, high, low_open, high_open = F(0), F(1), False, False
    for a, b in zip(part, part[1:] + part[:1]):
        fp, fq = cross(a, b, p), cross(a, b, q)
        if fp <= 0 and fq <= 0:
            return False
        if fp > 0 and fq > 0:
            continue
        t = F(fp) / (fp - fq)
        if fp > 0:
            if t <= high:
                high, high_open = t, True
        elif t >= low:
            low, low_open = t, True
    return low < high or (low == high and not low_open and not high_open)


def rings_of(wkt):
    """The rings of the only polygon, without closing vertices."""
    rings = []
    for ring in wkt[wkt.index("("):].replace("), (", "),(").split("),("):
        ring = ring.strip("() \n")
        points = [tuple(map(float, p.split())) for p in ring.split(",")]
        rings.append(points[:-1] if points[0] == points[-1] else points)
    return rings


def exact(points):
    return [(F(x), F(y)) for x, y in points]


def inside(rings, p):
    """Is a point that is not on an edge inside, by the even-odd rule?"""
    odd = False
    for ring in rings:
        for a, b in zip(ring, ring[1:] + ring[:1]):
            if (a[1] > p[1]) != (b[1] > p[1]) and (cross(a, b, p) > 0) == (b[1] > a[1]):
                odd = not odd
    return odd


@lru_cache(maxsize=4)
def sweep(robot, p, q):
    return hull([(x + s[0], y + s[1]) for x, y in robot for s in (p, q)])


def collides(obstacle, robot, p, q):
    swept = sweep(tuple(robot), p, q)
    xs, ys = [x for x, _ in swept], [y for _, y in swept]
    low, high = (min(xs), min(ys)), (max(xs), max(ys))
    for ring in obstacle:
        for a, b in zip(ring, ring[1:] + ring[:1]):
            if any(max(a[k], b[k]) <= low[k] or min(a[k], b[k]) >= high[k] for k in (0, 1)):
                continue  # outside the box of the open swept set
            if meets(swept, a, b):
                return True
    for k in (0, 1):
        if max(v[k] for v in obstacle[0]) <= low[k] or min(v[k] for v in obstacle[0]) >= high[k]:
            return False  # the outer ring is outside the box
    n = len(swept)
    return inside(obstacle, (sum(x for x, _ in swept) / n, sum(y for _, y in swept) / n))
