"""Routes through passages that the robot fits exactly. If the robot is one unit in the last place wider, there is no
route; if it is narrower by that, there is one. Paths are verified here in rationals and without a decomposition: the
interior of the hull of the (convex) robot at both ends of a leg meets an obstacle exactly if an edge of the obstacle
passes through the hull, or the hull lies inside the obstacle.

    route_tight.py PROGRAM FAMILIES
"""
import json
import math
import random
import subprocess
import sys
from fractions import Fraction as F

from route_exact import collides, exact, rings_of

trouble = 0


def fail(words):
    global trouble
    trouble += 1
    print("FAILED: " + words)


def wkt_of(rings):
    return "POLYGON (%s)" % ", ".join("(%s)" % ", ".join("%r %r" % p for p in r + r[:1]) for r in rings)


def route(obstacles, robot, start, goal, name):
    """(found, path); obstacles and robot are in doubles."""
    call = [sys.argv[1], "route", "@-", "--robot", wkt_of([robot]), "--exact",
            "--from=%r,%r" % start, "--to=%r,%r" % goal]
    text = "MULTIPOLYGON (%s)" % ", ".join(wkt_of(o)[8:] for o in obstacles)
    done = subprocess.run(call, input=text, capture_output=True, text=True)
    if done.returncode not in (0, 3):
        fail("%s: status %d: %s" % (name, done.returncode, done.stderr.strip()))
        return False, []
    said = json.loads(done.stdout)
    if said["found"] != (done.returncode == 0):
        fail("%s: status %d and found %s" % (name, done.returncode, said["found"]))
    if not said["found"]:
        at = goal if "at the goal" in said["reason"] else start if "at the start" in said["reason"] else None
        if at and any(collides([exact(r) for r in o], exact(robot), exact([at])[0], exact([at])[0]) for o in obstacles):
            return False, []
        if "different components of free space" not in said["reason"]:
            fail("%s: reason %s" % (name, said["reason"]))
        return False, []
    path = [tuple(map(F, p)) for p in said["path"]]
    if path[0] != tuple(map(F, start)) or path[-1] != tuple(map(F, goal)):
        fail("%s: the path leads elsewhere" % name)
    body, walls = exact(robot), [[exact(r) for r in o] for o in obstacles]
    for p, q in zip(path, path[1:]):
        for o in walls:
            if collides(o, body, p, q):
                fail("%s: the leg %s to %s collides" % (name, p, q))
    return True, path


def three_widths(obstacles, robot, start, goal, name):
    """Tests the robot as it is, and with its highest corners raised and lowered by one unit in the last place."""
    top = max(y for _, y in robot)
    for towards, wanted in ((None, True), (math.inf, False), (-math.inf, True)):
        changed = [(x, y if towards is None or y != top else math.nextafter(y, towards)) for x, y in robot]
        found, path = route(obstacles, changed, start, goal, "%s, robot towards %s" % (name, towards))
        if found != wanted:
            fail("%s, robot towards %s: %s" % (name, towards, "found" if found else "not found"))
        if towards is None:
            plain = path
    return plain


def family(size, seed, coordinates):
    """From outside into the last room of the family `tight`: P is the obstacle, -Q the robot."""
    name = "tight --size %d --seed %d --coordinates %s" % (size, seed, coordinates)
    lines = subprocess.run([sys.argv[2]] + name.split(), capture_output=True, text=True, check=True).stdout.splitlines()
    p, q = rings_of(lines[0]), rings_of(lines[1])
    robot = [(-x, -y) for x, y in q[0]]
    # The goal: on the floor of a room and against its right wall, at the rightmost corner within the outer walls.
    xs = sorted({x for x, _ in p[0]})
    high = max(y for _, y in p[0])
    low = min(y for _, y in p[0])
    right = next(x for x in reversed(xs) if sum(v[0] == x and low < v[1] < high for v in p[0]) >= 3)
    floor = min(y for x, y in p[0] if x == right and y > low)
    goal = (right - max(x for x, _ in robot), floor - min(y for _, y in robot))
    start = (xs[0] - 4 * (max(x for x, _ in robot) - min(x for x, _ in robot)), goal[1])
    if F(goal[0]) + F(max(x for x, _ in robot)) != F(right) or F(goal[1]) + F(min(y for _, y in robot)) != F(floor):
        return False  # the exact corner is not a double, so this case is left out
    path = three_widths([p], robot, start, goal, name)
    return len(path) > 2


def box(x0, y0, x1, y1):
    return [[(x0, y0), (x1, y0), (x1, y1), (x0, y1)]]


def maze(teeth):
    """A maze like a comb: corridors up and down between walls of width 2. Corridors and robot have width 1, so the
    whole route is one chain of degenerate segments."""
    height = 10.0
    walls = [box(-5.0, -5.0, 0.0, height + 5), box(3.0 * teeth - 2, -5.0, 3.0 * teeth + 5, height + 5),
             box(-1.0, -5.0, 3.0 * teeth, 0.0), box(-1.0, height, 3.0 * teeth, height + 5)]
    for i in range(teeth - 1):
        y = (0.0, height - 1) if i % 2 == 0 else (1.0, height)
        walls.append(box(3.0 * i + 1, y[0], 3.0 * i + 3, y[1]))
    robot = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    goal = (3.0 * (teeth - 1), height - 1 if teeth % 2 else 0.0)
    path = three_widths(walls, robot, (0.0, 0.0), goal, "maze of %d teeth" % teeth)
    total = sum(abs(a[0] - b[0]) + abs(a[1] - b[1]) for a, b in zip(path, path[1:]))
    if total != teeth * (height - 1) + 3 * (teeth - 1) or len(path) != 2 * teeth:
        fail("maze of %d teeth: %d vertices, length %s" % (teeth, len(path), total))


def keyhole():
    """A key with a bit is pushed along a slot that it fits exactly, to its only possible place at the end; and a hole
    without an entrance, in which the key's place is an isolated free point."""
    key = [(0.0, 0.0), (6.0, 0.0), (6.0, 1.0), (0.0, 2.0)]
    lock = [[(0.0, -3.0), (20.0, -3.0), (20.0, 5.0), (0.0, 5.0), (0.0, 2.0), (8.0, 2.0), (14.0, 1.0), (14.0, 0.0), (0.0, 0.0)]]
    path = three_widths([lock], key, (-9.0, 0.0), (8.0, 0.0), "key in a keyhole")
    if path != [(-9, 0), (8, 0)]:
        fail("key in a keyhole: %s" % path)
    lock = [[(-9.0, -9.0), (20.0, -9.0), (20.0, 9.0), (-9.0, 9.0)], key[::-1]]
    if route([lock], key, (-30.0, 0.0), (0.0, 0.0), "key in a hole")[0]:
        fail("key in a hole: there is no route into it")
    found, path = route([lock], key, (0.0, 0.0), (0.0, 0.0), "key at rest")
    if not found or path != [(0, 0)]:
        fail("key at rest: %s" % path)


def touching_holes():
    """Two free regions that meet in a single vertex: the route leads through it."""
    lock = [[(-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0)], [(-6.0, -1.0), (-6.0, 1.0), (1.0, 1.0), (1.0, -1.0)],
            [(1.0, 1.0), (1.0, 6.0), (6.0, 6.0), (6.0, 1.0)]]
    robot = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    if route([lock], robot, (-5.0, -1.0), (5.0, 5.0), "rooms that touch in a corner")[0]:
        fail("rooms that touch in a corner: the robot does not fit through it")
    # The rooms (-6, 1) x (-1, 1) and (0, 6) x (0, 6) share a unit square, the size of the robot: a single free vertex.
    rooms = [[(-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0)],
             [(-6.0, -1.0), (-6.0, 1.0), (0.0, 1.0), (0.0, 6.0), (6.0, 6.0), (6.0, 0.0), (1.0, 0.0), (1.0, -1.0)]]
    path = three_widths([rooms], robot, (-5.0, -1.0), (5.0, 5.0), "rooms that overlap in a robot")
    if path and path != [(-5, -1), (0, 0), (5, 5)]:
        fail("rooms that overlap in a robot: %s" % path)


def slanted(rng, far):
    """Two rooms and a slanted corridor exactly as wide as a parallelogram whose corners are doubles that use all
    their bits; then one wall is moved by one unit in the last place, in either direction."""
    unit = 2.0 ** -28 if far else 2.0 ** -40
    at = [rng.randrange(2 ** 23, 2 ** 24) + rng.randrange(2 ** 28) * 2.0 ** -28 if far else rng.random() for _ in "xy"]
    px, py = (round(c / unit) * unit for c in at)
    ux, uy = rng.randrange(2 ** 28, 2 ** 30) * unit, rng.randrange(2 ** 27, 2 ** 28) * unit
    vx, vy = -rng.randrange(2 ** 25, 2 ** 26) * unit, rng.randrange(2 ** 26, 2 ** 28) * unit
    qx, qy, side = px + 8 * ux, py + 8 * uy, 64 * ux
    robot = [(0.0, 0.0), (ux, uy), (ux + vx, uy + vy), (vx, vy)]
    start, goal = (px - 4 * ux, py - 4 * uy), (qx + 4 * ux, qy + 4 * uy)

    def rooms(ulp):
        low = math.nextafter(py, math.inf * ulp) if ulp else py
        hole = [(px, low), (px, py - side), (px - side, py - side), (px - side, py + side), (px + vx, py + side),
                (px + vx, py + vy), (qx + vx, qy + vy), (qx + vx, qy + side), (qx + side, qy + side),
                (qx + side, qy - side), (qx, qy - side), (qx, qy)]
        a, b = px - 2 * side, qx + 2 * side
        c, d = py - 2 * side, qy + 2 * side
        return [[(a, c), (b, c), (b, d), (a, d)], hole]

    name = "slanted corridor at %r %r" % (px, py)
    sums = ((px, vx), (py, vy), (qx, vx), (qy, vy), (px, 8 * ux), (py, 8 * uy), (ux, vx), (uy, vy))
    if any(F(a + b) != F(a) + F(b) for a, b in sums):
        fail("%s: its corners are not doubles" % name)
    found, path = route([rooms(0)], robot, start, goal, name)
    if not found or path != [tuple(map(F, start)), tuple(map(F, goal))]:
        fail("%s: found %s, path %s" % (name, found, path))
    if route([rooms(1)], robot, start, goal, name + ", narrower")[0]:
        fail("%s, narrower: there is no route" % name)
    if not route([rooms(-1)], robot, start, goal, name + ", wider")[0]:
        fail("%s, wider: there is a way" % name)


for seed in range(6):
    slanted(random.Random(seed), seed % 2 == 0)
asked = sum(family(size, seed, coordinates) for size in (12, 30) for seed in (1, 2, 3)
            for coordinates in ("integer", "map"))
if asked < 6:
    fail("only %d mazes of the family were tested" % asked)
for teeth in (2, 3, 8, 20):
    maze(teeth)
keyhole()
touching_holes()
print("%d of the family tight" % asked)
sys.exit(trouble > 0)
