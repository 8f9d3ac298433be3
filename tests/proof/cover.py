"""Convex regions of relative moves, and what is forbidden in them, in integers.

A region is a polygon whose corners are crossings of its lines: homogeneous integers (X, Y, W), W > 0, so nothing is
ever rounded. A line (a, b, c) keeps a X + b Y >= c. To decide whether a corner is in a piece, it is first rounded to
a lattice 2^16 times as fine as the layer's, and the test is stricter by that rounding; so the answer yes is always
true.
"""
import math
from fractions import Fraction
from itertools import combinations

FINE = 1 << 16
MOST_STEPS = 200_000


def line_of(n, d, unit):
    """n.u >= d for doubles, as integers for u in units of the lattice."""
    ratios = [v.as_integer_ratio() for v in (*n, d)]
    common = max(q for _, q in ratios)
    a, b, c = (p * (common // q) for p, q in ratios)
    return a, b, c * unit


def crossing(p, q):
    w = p[0] * q[1] - q[0] * p[1]
    x = p[2] * q[1] - q[2] * p[1]
    y = p[0] * q[2] - q[0] * p[2]
    return (-x, -y, -w) if w < 0 else (x, y, w)


def square(x0, y0, x1, y1):
    lines = [(0, 1, y0), (-1, 0, -x1), (0, -1, -y1), (1, 0, x0)]
    corners = [(x0, y0, 1), (x1, y0, 1), (x1, y1, 1), (x0, y1, 1)]
    return list(zip(corners, lines))


def clip(region, line):
    """The part of a region behind the line: its corners, each with the line of the side that begins there."""
    a, b, c = line
    side = [a * x + b * y - c * w for (x, y, w), _ in region]
    if not side or min(side) >= 0:
        return region
    out = []
    for k, (corner, own) in enumerate(region):
        s, after = side[k], side[k + 1 - len(side)]
        if s >= 0:
            out.append((corner, line if s == 0 and after < 0 else own))
            if s > 0 > after:
                out.append((crossing(own, line), line))
        elif after > 0:
            out.append((crossing(own, line), own))
    return out


def region_of(corners):
    """The region of a convex polygon with these corners, which are integers or fractions."""
    scale = math.lcm(*(Fraction(v).denominator for p in corners for v in p))
    points = [tuple(int(scale * v) for v in p) for p in hull(corners)]
    return [((*p, scale), (p[1] - q[1], q[0] - p[0], Fraction(q[0] * p[1] - p[0] * q[1], scale)))
            for p, q in zip(points, points[1:] + points[:1])]


def hull(points):
    """The convex hull, counter-clockwise, without corners on sides."""
    points = sorted(set(points))
    if len(points) < 3:
        return points
    out = []
    for chain in (points, points[::-1]):
        bottom = len(out)
        for p in chain:
            while len(out) >= bottom + 2:
                (ax, ay), (bx, by) = out[-2:]
                if (bx - ax) * (p[1] - ay) - (by - ay) * (p[0] - ax) > 0:
                    break
                out.pop()
            out.append(p)
        out.pop()
    return out


class Piece:
    """The convex polygon A - B dilated by an open disc of radius `owed`; with 0 its interior; with a negative value
    the points farther than that from its outside. A shadow: the points behind it, as seen from the origin. One that is
    priced forbids nothing (eased.py)."""

    def __init__(self, a, b, owed, shadow, priced=False):
        self.corners = hull([(p[0] - q[0], p[1] - q[1]) for p in a for q in b])
        self.owed, self.shadow, self.priced = owed, shadow, priced
        fine = [(FINE * x, FINE * y) for x, y in self.corners]
        self.edges = []
        if len(fine) > 2:
            for k, p in enumerate(fine):
                q = fine[k + 1 - len(fine)]
                ex, ey = q[0] - p[0], q[1] - p[1]
                self.edges.append((p[0], p[1], ex, ey, ex * ex + ey * ey))

    def holds(self, fine, corner):
        """Is the corner in it, whatever the rounding?"""
        if self.priced:
            return False
        return self.is_shaded(corner) if self.shadow else self.is_within(fine, self.owed)

    def is_within(self, fine, owed):
        """Is the corner in the polygon dilated by that radius, whatever the rounding?"""
        x, y = fine
        near = max(int(FINE * owed) - 1, 0) ** 2
        inside = 2 if owed == 0 else (math.ceil(-FINE * owed) + 2) ** 2
        outside = []
        for px, py, ex, ey, whole in self.edges:
            wx, wy = x - px, y - py
            cross = ex * wy - ey * wx
            if owed <= 0:
                if cross <= 0 or cross * cross <= inside * whole:
                    return False
            elif cross < 0:
                outside.append((cross, wx, wy, ex, ey, whole))
        if not outside:
            return len(self.edges) > 2
        for cross, wx, wy, ex, ey, whole in outside:
            along = wx * ex + wy * ey
            if along <= 0:
                far = wx * wx + wy * wy < near
            elif along >= whole:
                far = (wx - ex) ** 2 + (wy - ey) ** 2 < near
            else:
                far = cross * cross < near * whole
            if far:
                return True
        return False

    def is_shaded(self, corner):
        """Does the segment from the origin meet the polygon? Exact: s V is on the left of each side, 0 <= s <= 1."""
        x, y, w = corner
        if len(self.corners) < 3:
            return meets_segment(self.corners, x, y, w)
        low, high = (0, 1), (1, w)  # the interval of s / w
        for px, py, ex, ey, _ in self.edges:
            slope = FINE * (ex * y - ey * x)
            level = ex * py - ey * px
            if slope == 0:
                if level > 0:
                    return False
            elif slope > 0:
                if level * low[1] > low[0] * slope:
                    low = level, slope
            elif level * high[1] > high[0] * slope:
                high = -level, -slope
        return bool(self.edges) and low[0] * high[1] <= high[0] * low[1]


class Beyond:
    """All places with n.u < d, which the rule of rows forbids; the line as line_of() makes it."""

    def __init__(self, line):
        self.line, self.corners, self.shadow, self.priced = line, (), False, False

    def holds(self, fine, corner):
        (a, b, c), (x, y, w) = self.line, corner
        return a * x + b * y < c * w


def meets_segment(ends, x, y, w):
    """Is s (x, y) on the segment for some 0 <= s <= 1 / w? w None: for any s. For a segment on a line through the
    origin the answer is no."""
    if len(ends) < 2:
        return False
    (px, py), (qx, qy) = ends
    ex, ey = qx - px, qy - py
    slope, level = ex * y - ey * x, ex * py - ey * px
    if slope < 0:
        slope, level = -slope, -level
    if slope == 0 or level <= 0 or (w is not None and level * w > slope):
        return False
    # The place is level / slope times (x, y); its position between p and q.
    along = (level * x - px * slope) * ex + (level * y - py * slope) * ey
    return 0 <= along <= slope * (ex * ex + ey * ey)


def fine_of(corner):
    x, y, w = corner
    return (2 * FINE * x + w) // (2 * w), (2 * FINE * y + w) // (2 * w)


def halves(places):
    """A line that halves the longest extent of these places."""
    n = len(places)
    best, along = -1, (1, 0)
    for i in range(n):
        for k in range(i):
            dx, dy = places[i][0] - places[k][0], places[i][1] - places[k][1]
            if dx * dx + dy * dy > best:
                best, along = dx * dx + dy * dy, (dx, dy)
    shift = max(0, max(map(abs, along)).bit_length() - 20)
    a, b = along[0] >> shift, along[1] >> shift
    mx, my = sum(p[0] for p in places) // n, sum(p[1] for p in places) // n
    return (mx, my), (a * FINE, b * FINE, a * mx + b * my)


def common_rays(pieces):
    """The lines through the origin along which two shadows of segments have a common border. Halving would not find them."""
    ends, found = [p for piece in pieces if len(piece.corners) == 2 and piece.shadow for p in piece.corners], []
    for p, q in combinations(ends, 2):
        if p[0] * q[1] == p[1] * q[0] and p[0] * q[0] + p[1] * q[1] > 0 and not any(a * p[0] + b * p[1] == 0 for a, b, _ in found):
            found.append((p[1], -p[0], 0))
    return found


def rays_of(pieces):
    """The lines through the origin and the ends of shadows of segments. Shadows and priced pieces may overlap by so little along
    them that halving would not find them."""
    return [(p[1], -p[0], 0) for piece in pieces if len(piece.corners) == 2 and piece.shadow for p in piece.corners]


def is_covered(region, pieces, leaving=None):
    """Is all of the region in the union of the pieces? leaving: a function of a piece, the corners of a part, and its middle, which
    proposes a line that cuts the part; otherwise it is halved."""
    todo, steps, last = [region], 0, None
    for a, b, c in rays_of(pieces) if leaving else common_rays(pieces):
        todo = [clip(part, line) for part in todo for line in ((a, b, c), (-a, -b, -c))]
    while todo:
        part = todo.pop()
        if not part:
            continue
        steps += 1
        places = [fine_of(corner) for corner, _ in part]
        corners = [corner for corner, _ in part]

        def all_in(piece):
            return all(piece.holds(p, c) for p, c in zip(places, corners))
        if last and all_in(last):
            continue
        found = next((p for p in pieces if p is not last and all_in(p)), None)
        if found:
            last = found
            continue
        middle, (a, b, c) = halves(places)
        around = [p for p in pieces if p.holds(middle, (*middle, FINE))]
        if steps > MOST_STEPS or (a, b) == (0, 0) or not around:
            return False
        if leaving:
            a, b, c = leaving(max(around, key=lambda p: sum(map(p.holds, places, corners))), places, middle) or (a, b, c)
        todo.append(clip(part, (a, b, c)))
        todo.append(clip(part, (-a, -b, -c)))
    return True


def root_above(n, d):
    """An integer no less than sqrt(n / d)."""
    return math.isqrt(-(-n // d)) + 1


def is_nowhere(lines):
    """Is there no place with a X + b Y < c for all of these (at most three) lines? Exact, by the lemma of Farkas."""
    for p, q in combinations(lines, 2):
        if p[0] * q[1] == p[1] * q[0] and p[0] * q[0] + p[1] * q[1] < 0:
            s, t = abs(q[0]) + abs(q[1]), abs(p[0]) + abs(p[1])
            if s * p[2] + t * q[2] <= 0:
                return True
    for p, q, r in combinations(lines, 3):
        forces = [q[0] * r[1] - q[1] * r[0], r[0] * p[1] - r[1] * p[0], p[0] * q[1] - p[1] * q[0]]
        if max(forces) <= 0:
            forces = [-f for f in forces]
        if min(forces) >= 0 and max(forces) > 0 and sum(f * m[2] for f, m in zip(forces, (p, q, r))) <= 0:
            return True
    return any(m[0] == m[1] == 0 and m[2] <= 0 for m in lines)
