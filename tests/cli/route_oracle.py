"""Shortest routes by brute force in rationals, compared with `sunder route`. Shares no code with the library.

Obstacles and robots are unions of convex pieces with small integer coordinates, so that touching, exact fits and ties
are frequent. The open configuration-space obstacle of two pieces is the interior of the hull of all differences of
corners. Nodes are the corners of these hulls and the crossings of their sides, unless they lie inside a hull; every
pair of nodes is tested against every hull; Dijkstra's algorithm runs with 60 digits.

    route_oracle.py PROGRAM SCENES SEED
"""
import heapq
import json
import random
import subprocess
import sys
from decimal import Decimal, getcontext
from fractions import Fraction as F

from route_exact import cross, hull, meets

getcontext().prec = 60
CLOSE = Decimal(10) ** -45


def free(parts, p, q):
    low, high = (min(p[0], q[0]), min(p[1], q[1])), (max(p[0], q[0]), max(p[1], q[1]))
    for part in parts:
        (x0, y0), (x1, y1) = reach(part)
        if high[0] <= x0 or low[0] >= x1 or high[1] <= y0 or low[1] >= y1:
            continue  # outside the open part
        if meets(part, p, q):
            return False
    return True


REACH = {}


def reach(part):
    box = REACH.get(id(part))
    if box is None:
        xs, ys = [x for x, _ in part], [y for _, y in part]
        # keeps the part alive, so that its id stays unique
        box = REACH[id(part)] = ((min(xs), min(ys)), (max(xs), max(ys)), part)
    return box[:2]


def crossing(a, b, c, d):
    den = (b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0])
    if den == 0:
        return None
    t = F((c[0] - a[0]) * (d[1] - c[1]) - (c[1] - a[1]) * (d[0] - c[0]), 1) / den
    s = F((c[0] - a[0]) * (b[1] - a[1]) - (c[1] - a[1]) * (b[0] - a[0]), 1) / den
    if 0 <= t <= 1 and 0 <= s <= 1:
        return (a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]))
    return None


def nodes_of(parts, start, goal):
    sides = [(a, b) for part in parts for a, b in zip(part, part[1:] + part[:1])]
    found = {c for part in parts for c in part}
    for i, (a, b) in enumerate(sides):
        for c, d in sides[:i]:
            if any(max(a[k], b[k]) < min(c[k], d[k]) or max(c[k], d[k]) < min(a[k], b[k]) for k in (0, 1)):
                continue
            p = crossing(a, b, c, d)
            if p:
                found.add(p)
    found -= {start, goal}
    return [start, goal] + [p for p in sorted(found) if free(parts, p, p)]


def length(p, q):
    square = F((p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2)
    return (Decimal(square.numerator) / Decimal(square.denominator)).sqrt()


def merged(path):
    out = []
    for p in path:
        while len(out) >= 2 and cross(out[-2], out[-1], p) == 0:
            out.pop()
        out.append(p)
    return out


def shortest(parts, start, goal):
    """(length, the lexicographically smallest path), or None; the path is None if too many have the same length."""
    if start == goal:
        return Decimal(0), [start]
    nodes = nodes_of(parts, start, goal)
    n = len(nodes)
    way = [[None] * n for _ in nodes]
    for i in range(n):
        for j in range(i):
            if free(parts, nodes[i], nodes[j]):
                way[i][j] = way[j][i] = length(nodes[i], nodes[j])
    best, queue = {0: Decimal(0)}, [(Decimal(0), 0)]
    while queue:
        d, i = heapq.heappop(queue)
        if d > best[i]:
            continue
        for j in range(n):
            if way[i][j] is not None and (j not in best or d + way[i][j] < best[j]):
                best[j] = d + way[i][j]
                heapq.heappush(queue, (best[j], j))
    if 1 not in best:
        return None
    paths, stack = [], [[1]]
    while stack:
        tail = stack.pop()
        if len(paths) + len(stack) > 2000:
            return best[1], None
        if tail[-1] == 0:
            paths.append(merged([nodes[i] for i in reversed(tail)]))
            continue
        j = tail[-1]
        for i in range(n):
            if i in best and i not in tail and way[i][j] is not None and abs(best[i] + way[i][j] - best[j]) < CLOSE:
                stack.append(tail + [i])
    return best[1], min(paths)


# ---- Scenes ----

def box(x, y, w, h):
    return [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]


def random_piece(rng, size):
    kind = rng.randrange(8)
    x, y = rng.randrange(-size, size + 1), rng.randrange(-size, size + 1)
    if kind < 4:
        return box(x, y, rng.randrange(1, 6), rng.randrange(1, 6))
    if kind == 4:
        return [(x, y)]
    while True:
        points = [(x + rng.randrange(-4, 5), y + rng.randrange(-4, 5)) for _ in range(2 if kind == 5 else 3)]
        if len(set(points)) == 2 == len(points):
            return sorted(points)
        if len(points) == 3 and cross(*points) != 0:
            return hull(points)


def members(bodies):
    return "MULTIPOLYGON (%s)" % ", ".join("((%s))" % ", ".join("%d %d" % p for p in b + b[:1]) for b in bodies)


def random_robot(rng):
    """Open convex pieces that cover the robot's interior and may overlap, and the robot as WKT for the program."""
    kind = rng.randrange(9)
    ell, frame = [box(0, 0, 3, 1), box(0, 0, 1, 3)], [box(0, 0, 3, 1), box(0, 2, 3, 1), box(0, 0, 1, 3), box(2, 0, 1, 3)]
    if kind == 0:
        return [box(-1, -1, 2, 2)], members([box(-1, -1, 2, 2)])
    if kind == 1:
        return [hull([(0, 0), (3, 1), (1, 2)])], members([hull([(0, 0), (3, 1), (1, 2)])])
    if kind == 2:
        return [box(0, 0, 1, 1), box(2, 2, 1, 2)], members([box(0, 0, 1, 1), box(2, 2, 1, 2)])  # two parts
    if kind == 3:
        return ell, members(ell)  # members that overlap
    if kind == 4:
        return frame, members(frame)
    if kind == 5:
        return ell, "POLYGON ((0 0, 3 0, 3 1, 1 1, 1 3, 0 3, 0 0))"
    if kind == 6:
        return frame, "POLYGON ((0 0, 3 0, 3 3, 0 3, 0 0), (1 1, 1 2, 2 2, 2 1, 1 1))"
    if kind == 7:  # members that share an edge
        return [box(-1, 0, 3, 1)], members([box(-1, 0, 1, 1), box(0, 0, 2, 1)])
    dart = [[(0, 0), (4, 1), (F(8, 5), F(8, 5))], [(F(8, 5), F(2, 5)), (4, 1), (0, 2)]]
    return dart, "POLYGON ((0 0, 4 1, 0 2, 1 1, 0 0))"


def corridor(rng):
    """Two rooms and a corridor between them, exactly as wide as a robot that is a box of this width."""
    w, h = rng.randrange(1, 4), rng.randrange(1, 4)
    pieces = [box(0, h, 6, 5), box(0, -5, 6, 5)]
    if rng.randrange(2):
        pieces.append(box(rng.randrange(6, 12), -5, 2, 10 + h))
    return [box(0, 0, w, h)], pieces


def cage(rng):
    """A room around the origin; its door is as wide as the robot, narrower, or wider, and may lead into a second
    room."""
    w = rng.randrange(1, 4)
    door = w + rng.choice([-1, 0, 0, 1])
    pieces = [box(-5, -5, 1, 10), box(-5, -5, 10, 1), box(-5, 4, 10, 1), box(4, -5, 1, 4), box(4, door - 1, 1, 6 - door)]
    if rng.randrange(3) == 0:
        pieces += [box(5, -5, 6, 1), box(5, 5, 6, 1), box(10, -5, 1, 11)]
    if door < 0 or rng.randrange(4) == 0:
        pieces.append([(-1, -1), (2, 1)])
    return [box(0, 0, rng.randrange(1, 3), w)], pieces


def town(rng):
    """Many pieces, far enough from each other that most pairs of nodes do not see each other."""
    pieces = []
    for x in range(-30, 31, 12):
        for y in range(-30, 31, 12):
            kind = rng.randrange(8)
            if kind < 5:
                pieces.append(box(x + rng.randrange(-2, 3), y + rng.randrange(-2, 3), rng.randrange(3, 11), rng.randrange(3, 11)))
            elif kind < 7:
                at = [(x + rng.randrange(-4, 13), y + rng.randrange(-4, 13)) for _ in "abc"]
                pieces.append(hull(at) if cross(*at) else [min(at)])
    return [box(0, 0, rng.randrange(1, 4), rng.randrange(1, 4))], pieces


def wkt_of(pieces):
    if not pieces:
        return "GEOMETRYCOLLECTION EMPTY"
    texts = []
    for piece in pieces:
        points = ", ".join("%d %d" % p for p in (piece + piece[:1] if len(piece) > 2 else piece))
        texts.append({1: "POINT (%s)", 2: "LINESTRING (%s)"}.get(len(piece), "POLYGON ((%s))") % points)
    return "GEOMETRYCOLLECTION (%s)" % ", ".join(texts)


def rational(text):
    return F(text)


def coordinate(v):
    v = F(v)
    return str(v.numerator) if v.denominator == 1 else "%d/%d" % (v.numerator, v.denominator)


def one_scene(program, rng, number):
    size = rng.choice([4, 6, 8])
    robot_wkt = None
    if number % 40 == 39:
        robot, obstacles = town(rng)
        size = 36
    elif number % 4 == 0:
        robot, obstacles = corridor(rng)
    elif number % 4 == 1:
        robot, obstacles = cage(rng)
    else:
        robot, robot_wkt = random_robot(rng)
        obstacles = [random_piece(rng, size) for _ in range(rng.randrange(0, 5))]
    parts = [hull([(o[0] - r[0], o[1] - r[1]) for o in piece for r in body]) for piece in obstacles for body in robot]
    den = rng.choice([1, 1, 2, 3, 7])
    start, goal = [(F(rng.randrange(-12 * den, 13 * den), den), F(rng.randrange(-12 * den, 13 * den), den)) for _ in "ab"]
    if size == 36:
        start, goal = (F(-38), F(rng.randrange(-30, 31))), (F(44), F(rng.randrange(-30, 31)))
    elif number % 4 == 1:
        start = (F(rng.randrange(-3, 2)), F(rng.randrange(-3, 2)))
    elif rng.randrange(3) == 0:  # on a corner of an obstacle
        corners = [c for part in parts for c in part]
        if corners:
            start = tuple(map(F, rng.choice(corners)))
            goal = tuple(map(F, rng.choice(corners)))
    # a point of the robot (a corner, or the midpoint of two) coincides with a corner of an obstacle
    elif obstacles and rng.randrange(3) == 0:
        body, piece = rng.choice(robot), rng.choice(obstacles)
        r, s, o = rng.choice(body), rng.choice(rng.choice(robot)), rng.choice(piece)
        start = (o[0] - F(r[0] + s[0]) / 2, o[1] - F(r[1] + s[1]) / 2)
    robot_wkt = robot_wkt or members(robot)
    call = [program, "route", wkt_of(obstacles), "--robot", robot_wkt, "--exact", "--quiet",
            "--from=" + ",".join(map(coordinate, start)), "--to=" + ",".join(map(coordinate, goal))]
    done = subprocess.run(call, capture_output=True, text=True)
    said = json.loads(done.stdout) if done.stdout else {}
    trouble = []
    if not free(parts, start, start) or not free(parts, goal, goal):
        where = "start" if not free(parts, start, start) else "goal"
        if done.returncode != 3 or said.get("found") is not False or ("at the " + where) not in (said.get("reason") or ""):
            trouble.append("a collision at the %s was not reported" % where)
        kind = "collision"
    else:
        answer = shortest(parts, start, goal)
        kind = "none" if answer is None else "route"
        if answer is None:
            if done.returncode != 3 or "components" not in (said.get("reason") or ""):
                trouble.append("there is no route")
        elif done.returncode != 0 or not said.get("found"):
            trouble.append("there is a route of length %s" % answer[0])
        else:
            path = [tuple(map(rational, p)) for p in said["path"]]
            total = sum((length(p, q) for p, q in zip(path, path[1:])), Decimal(0))
            if path[0] != start or path[-1] != goal:
                trouble.append("the path leads elsewhere")
            if any(not free(parts, p, q) for p, q in zip(path, path[1:])):
                trouble.append("a leg collides")
            if abs(total - answer[0]) > CLOSE:
                trouble.append("length %s, not %s" % (total, answer[0]))
            if abs(Decimal(said["length"]) - total) > total * Decimal("2e-16"):
                trouble.append("length as said: %s, not %s" % (said["length"], total))
            if answer[1] is not None and path != answer[1]:
                trouble.append("another path of the same length comes first: %s" % [tuple(map(str, p)) for p in answer[1]])
    if trouble:
        print("scene %d: %s" % (number, "; ".join(trouble)))
        print("  " + " ".join("'%s'" % a if " " in a else a for a in call))
        print("  " + done.stdout.strip() + done.stderr.strip())
    return kind, not trouble


def main():
    program, scenes, seed = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    kinds, bad = {}, 0
    for number in range(scenes):
        kind, good = one_scene(program, random.Random(seed * 1000003 + number), number)
        kinds[kind] = kinds.get(kind, 0) + 1
        bad += not good
    print("%d scenes, seed %d: %s" % (scenes, seed, ", ".join("%d %s" % (n, k) for k, n in sorted(kinds.items()))))
    if bad or len(kinds) < 3:
        sys.exit(1)


main()
