"""The anchor of a feature by the documented rule (src/shape/anchor.c), in fractions and by another algorithm: it
sorts the crossings of each member with the horizontal line, and takes the union of the intervals of all members."""
from fractions import Fraction

from side_anchor import at_height, levels_of


def covered(members, y, up):
    """The intervals covered just above the height (up = 1) or just below it (-1), joined. An end is a pair: x, and
    the change of x per unit of height away from y."""
    found = []
    for edges in members:
        ends = []
        for e in edges:
            (ax, ay), (bx, by) = e
            if ay != by and max(up * ay, up * by) > up * y >= min(up * ay, up * by):
                ends.append((at_height(e, y), up * Fraction(bx - ax) / (by - ay)))
        ends.sort()
        found += [(a, b) for a, b in zip(ends[::2], ends[1::2]) if a != b]
    joined = []
    for a, b in sorted(found):
        if joined and a <= joined[-1][1]:
            joined[-1][1] = max(b, joined[-1][1])
        else:
            joined.append([a, b])
    return joined


def intervals(members, y):
    above, below = covered(members, y, 1), covered(members, y, -1)
    both = [(max(a[0], c[0]), min(b[0], d[0])) for a, b in above for c, d in below]
    return sorted((a, b) for a, b in both if a < b)


def anchor(members, unit):
    """members: the edges of each member, in integers; one unit of the layer is `unit` integers. A member is the set
    that its edges enclose by the even-odd rule."""
    levels = levels_of([e for edges in members for e in edges])
    low = min(y for y in levels if covered(members, y, 1))
    high = max(y for y in levels if covered(members, y, -1))
    while True:
        y = (low + high) / 2
        found = intervals(members, y)
        if found:
            _, left, right = max((b - a, -a, b) for a, b in found)
            return float((-left + right) / 2 / unit), float(y / unit)
        high = max(z for z in levels if z <= y and covered(members, z, -1))
