"""Exact geometry that the tests of routes share, in rationals."""
from fractions import Fraction as F


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
