"""The lower bound of --ease beside layouts that an independent search finds: python3 ease_bounds.py SUNDER SEED LAYERS
[WORLDS [STEPS [EFFORT]]].

Makes layers of WORLDS worlds that are far from each other: one to four houses of one, two or three rectangles, with
limits and weights of their own, and up to two roads of one to three segments that bend at right angles; some layers
are turned by an angle whose sine is 4/5. What a pair lacks is computed from the rectangles of its relative moves: the
distance to them, or the depth in their union. Others have rows (found by rows_rule.py), with springs and the rule
that neighbours keep their order, and some a least gap: then every pair may stand between the two gaps, at its price.

Asked of each layer: the printed cost is that of the moves and prices of the printed layout. Layouts of each world are
looked for at random and by descent in STEPS steps, in which no solved pair comes into conflict and no listed one
stands worse than at the start, unless one house lay in the other then and still overlaps it: the printed bound is not
above the sum of the least of their costs, and what the trees of the file of --proof about each world add up to is not
above the least of its costs. The bounds of all layers together are at least three quarters of these costs. Uses only
Python's standard library, and no code of the program."""
import json
import math
import os
import random
import sqlite3
import subprocess
import sys

import rows_rule

APART, GAP, KAPPAS = 4000, 3.0, (5.0, 30.0, 200.0)
STIFF = ((3.0, 0.3), (10.0, 1.0))  # across a row, and along it


def rounded(v):
    return round(v * 2) / 2


class World:
    """Houses as lists of rectangles (x0, y0, x1, y1), roads as lists of segments written likewise. In a layer that is
    turned, coordinates are rounded, so rectangles of relative moves are larger by a hair."""

    def __init__(self, rng, hair=0.0):
        self.hair = hair
        self.house, self.most, self.weight, self.road = [], [], [], []
        side = rng.choice((14, 20, 30))
        for _ in range(rng.randrange(1, 5)):
            x, y = rounded(rng.uniform(0, side)), rounded(rng.uniform(0, side))
            w, h = rounded(rng.uniform(5, 16)), rounded(rng.uniform(5, 16))
            house, kind = [(x, y, x + w, y + h)], rng.randrange(4)
            if kind == 1:  # like an L
                house = [(x, y, x + w, y + rounded(h / 2)), (x, y, x + rounded(w / 3), y + h)]
            elif kind == 2:  # like a U
                thick = rounded(w / 4)
                house = [(x, y, x + w, y + rounded(h / 3)), (x, y, x + thick, y + h), (x + w - thick, y, x + w, y + h)]
            self.house.append(house)
            self.most.append(rng.choice((0.0, 2.0, 5.0, rounded(rng.uniform(1, 10)), 8.0)))
            self.weight.append(rng.choice((1.0, 1.0, 2.0, rng.uniform(0.3, 5))))
        for _ in range(rng.randrange(3)):
            at, line, across = [rounded(rng.uniform(0, side)), rounded(rng.uniform(-9, side))], [], rng.random() < 0.5
            for _ in range(rng.randrange(1, 4)):
                to, across = list(at), not across
                to[across] += rng.choice((-1, 1)) * rounded(rng.uniform(4, 30))
                line.append((*at, *to))
                at = to
            self.road.append((line, rng.choice((0.0, 3.0))))
        self.edges = []

    def line_up(self, rng):
        """Puts three or four houses of one rectangle side by side, and finds the edges of rows."""
        x, self.house, count = 0.0, [], rng.randrange(3, 5)
        for _ in range(count):
            w, y = rounded(rng.uniform(5, 12)), rng.choice((0.0, 0.0, 0.5, 1.0))
            self.house.append([(x, y, x + w, y + rng.choice((8.0, 9.0)))])
            x += w + rng.choice((0.5, 0.5, 1.0, 2.0, 4.0))
        self.most = [rng.choice((0.0, 2.0, 5.0, 8.0, 8.0)) for _ in range(count)]
        self.weight = [rng.choice((1.0, 1.0, rng.uniform(0.3, 5))) for _ in range(count)]

    def find_rows(self):
        """Returns whether the edges could be decided."""
        houses = [rows_rule.House([[outline(h)]]) for h in self.house]
        lines = [((a, b), (c, d)) for line, _ in self.road for a, b, c, d in line]
        try:
            rows = rows_rule.rows_of([[k] for k in range(len(houses))], houses, lines, GAP)
        except rows_rule.Undecided:
            return False
        for edge in (edge for row, _ in rows for _, edge in row):
            stand = [rows_rule.extent(houses[k], edge.axis) for k in (edge.i, edge.j)]
            self.edges.append((edge.i, edge.j, edge.axis, rows_rule.apart(*stand)))
        return True

    def pairs(self):
        """(name, i, j, rectangles of the relative move t_j - t_i, distance to keep); j is None for a road."""
        n = len(self.house)
        for i in range(n):
            for j in range(i + 1, n):
                yield (i, j), i, j, differences(self.house[i], self.house[j], self.hair), GAP
            for k, (line, width) in enumerate(self.road):
                boxes = [(min(a, c), min(b, d), max(a, c), max(b, d)) for a, b, c, d in line]
                yield (i, -1 - k), i, None, differences(self.house[i], boxes, self.hair), GAP + width / 2

    def has_exact_fit(self):
        """Is there a place without width between two parts of a thing? In a layer that is turned rounding decides."""
        return any(abs(r[2 + c] - s[c]) < 1e-6 for _, _, _, found, _ in self.pairs() for r in found for s in found for c in (0, 1))

    def price(self, i, j, kappa):
        ends = [k for k in (i, j) if k is not None and self.most[k] > 0]
        if not ends:
            return None
        weight = min(self.weight[k] for k in ends)
        return 4 * weight * min(self.most[k] for k in ends), weight * kappa


def differences(a, b, hair):
    return [(p[0] - q[2] - hair, p[1] - q[3] - hair, p[2] - q[0] + hair, p[3] - q[1] + hair) for p in a for q in b]


def lies_in(a, b):
    """Do the rectangles of a lie in the union of those of b?"""
    xs, ys = ({v for r in a + b for v in (r[c], r[c + 2])} for c in (0, 1))
    xs, ys = sorted(xs), sorted(ys)
    return all(any(r[0] <= x <= r[2] and r[1] <= y <= r[3] for r in b)
               for x in [(p + q) / 2 for p, q in zip(xs, xs[1:])] for y in [(p + q) / 2 for p, q in zip(ys, ys[1:])]
               if any(r[0] < x < r[2] and r[1] < y < r[3] for r in a))


def lacks(rectangles, owed, x, y):
    """What a pair with the relative move (x, y) lacks of the distance `owed`."""
    far = min(math.hypot(max(r[0] - x, x - r[2], 0), max(r[1] - y, y - r[3], 0)) for r in rectangles)
    if not any(r[0] < x < r[2] and r[1] < y < r[3] for r in rectangles):
        return max(0.0, owed - far)
    return owed + depth(rectangles, x, y)


def depth(rectangles, x, y):
    """The distance of (x, y) from what the open rectangles leave of their borders."""
    nearest = math.inf
    for k, r in enumerate(rectangles):
        for flip in (False, True):
            u, v = (y, x) if flip else (x, y)
            for level in (r[1], r[3]) if not flip else (r[0], r[2]):
                low, high = (r[0], r[2]) if not flip else (r[1], r[3])
                cover = sorted((s[1], s[3]) if flip else (s[0], s[2]) for m, s in enumerate(rectangles)
                               if m != k and ((s[0] < level < s[2]) if flip else (s[1] < level < s[3])))
                for begin, end in cover + [(high, high)]:
                    if low <= begin:
                        free = min(begin, high)
                        nearest = min(nearest, math.hypot(max(low - u, u - free, 0), level - v))
                    low = max(low, end)
                    if low > high:
                        break
    return nearest


class Judge:
    """The costs of layouts of one world. slack: by how much the least gap is less than the gap."""

    def __init__(self, world, listed, kappa, slack, stiff):
        self.world, self.pair, self.edge = world, [], []
        near = {}
        for name, i, j, rectangles, owed in world.pairs():
            price, home = world.price(i, j, kappa), lacks(rectangles, owed, 0, 0)
            near[name] = home > 0
            if name in listed:
                most = max(home if listed[name] > owed else min(home, owed), slack)
                p, q = world.house[i], world.house[j] if j is not None else []
                if j is not None and listed[name] > owed and (lies_in(p, q) or lies_in(q, p)):
                    most = math.inf
                self.pair.append((i, j, rectangles, owed, price, most + 1e-8))
            elif price:
                self.pair.append((i, j, rectangles, owed, price if slack else None, slack + 1e-8))
        for i, j, axis, apart in world.edges:
            name, axis = (min(i, j), max(i, j)), axis if i < j else (-axis[0], -axis[1])
            full, weight = GAP - apart, min(world.weight[i], world.weight[j])
            least, ruled = min(0, full), apart > 0 and (world.most[i] > 0 or world.most[j] > 0)
            if near[name] and name not in listed:
                least = max(full - slack, least)
            self.edge.append((*name, axis, least - 1e-8 if ruled else -math.inf,
                              full if ruled and slack and near[name] else -math.inf, weight * stiff[0], weight * stiff[1]))

    def cost(self, t):
        world, cost = self.world, 0.0
        for (x, y), most, weight in zip(t, world.most, world.weight):
            square = x * x + y * y
            if square > most * most * (1 + 1e-12):
                return math.inf
            cost += weight * square
        along = {}
        for i, j, (x, y), least, full, across, stretch in self.edge:
            u, v = t[j][0] - t[i][0], t[j][1] - t[i][1]
            ahead = u * x + v * y
            if ahead < least:
                return math.inf
            along[i, j] = full - ahead
            cost += across * (v * x - u * y) ** 2 + stretch * ahead * ahead
        for i, j, rectangles, owed, price, most in self.pair:
            s = lacks(rectangles, owed, (t[j][0] if j is not None else 0) - t[i][0],
                      (t[j][1] if j is not None else 0) - t[i][1])
            if s > most:
                return math.inf
            s = max(s, along.get((i, j), 0))
            if price:
                cost += s * (price[0] + price[1] * s)
        return cost

    def descend(self, rng, t, steps):
        best, size = self.cost(t), 4.0
        movers = [k for k, most in enumerate(self.world.most) if most > 0]
        for _ in range(steps if movers else 0):
            v = list(t)
            both = rng.random() < 0.3
            step = [rng.gauss(0, size), rng.gauss(0, size)]
            for k in rng.sample(movers, min(len(movers), 2 if both else 1)):
                v[k] = v[k][0] + step[0], v[k][1] + step[1]
                most, length = self.world.most[k], math.hypot(*v[k])
                if length > most:
                    v[k] = v[k][0] * most / length, v[k][1] * most / length
            cost = self.cost(v)
            if cost < best:
                best, t = cost, v
                size = min(size * 1.5, 4.0)
            else:
                size = max(size * 0.93, 1e-5)
            if size <= 1e-5:
                size = 4.0 * rng.random()
        return best


# ---- What the program does -------------------------------------------------------------------------------------------


def turned(turn, k, x, y):
    x += APART * k
    return ((3 * x - 4 * y) / 5, (4 * x + 3 * y) / 5) if turn else (x, y)


def outline(house):
    """The corners of a house, in order."""
    if len(house) == 1:
        x0, y0, x1, y1 = house[0]
        return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    (x0, y0, x1, low), (_, _, thick, y1) = house[0], house[1]
    if len(house) == 2:
        return [(x0, y0), (x1, y0), (x1, low), (thick, low), (thick, y1), (x0, y1)]
    inner = house[2][0]
    return [(x0, y0), (x1, y0), (x1, y1), (inner, y1), (inner, low), (thick, low), (thick, y1), (x0, y1)]


def write_layers(worlds, turn):
    if os.path.exists("b.gpkg"):
        os.remove("b.gpkg")
    houses, roads = [], []
    with open("bh.csv", "w") as h, open("br.csv", "w") as r:
        h.write("WKT,most,w\n")
        r.write("WKT,width\n")
        r.write('"LINESTRING(-900 -900,-901 -900)",0\n')
        for k, world in enumerate(worlds):
            for i, house in enumerate(world.house):
                ring = outline(house)
                text = ",".join("%r %r" % turned(turn, k, *p) for p in ring + ring[:1])
                h.write('"POLYGON((%s))",%r,%r\n' % (text, world.most[i], world.weight[i]))
                houses.append((k, i))
            for i, (line, width) in enumerate(world.road):
                places = [line[0][:2]] + [s[2:] for s in line]
                r.write('"LINESTRING(%s)",%r\n' % (",".join("%r %r" % turned(turn, k, *p) for p in places), width))
                roads.append((k, i))
    for more, name, table, kind in (([], "bh", "houses", "POLYGON"), (["-update"], "br", "roads", "LINESTRING")):
        subprocess.run(["ogr2ogr", "-q", *more, "b.gpkg", name + ".csv", "-nln", table, "-nlt", kind, "-oo",
                        "AUTODETECT_TYPE=YES", "-oo", "KEEP_GEOM_COLUMNS=NO", "-a_srs", "EPSG:32633"], check=True)
    return houses, [None] + roads


def run(program, houses, roads, worlds, turn, words):
    """The moves and listed pairs of each world, and the statistics."""
    done = subprocess.run([program, "separate", "b.gpkg", "bo.gpkg", "--overwrite", *words, "--gap", repr(GAP),
                           "--input-layer", "houses", "--no-blocks", "--contained", "separate", "--allow-jumps",
                           "--max-shift-field", "most", "--weight-field", "w", "--barrier",
                           "b.gpkg,layer=roads,width-field=width,side=no", "--stats", "b.json", "--proof", "b.jsonl"],
                          capture_output=True, text=True)
    assert done.returncode in (0, 3), done.stderr
    data = sqlite3.connect("bo.gpkg")
    move, listed = [[None] * len(w.house) for w in worlds], [{} for _ in worlds]
    for fid, x, y in data.execute("SELECT fid, sunder_dx, sunder_dy FROM houses"):
        k, i = houses[fid - 1]
        x, y = x or 0.0, y or 0.0
        move[k][i] = ((3 * x + 4 * y) / 5, (3 * y - 4 * x) / 5) if turn else (x, y)
    for a, b, barrier, road, missing in data.execute(
            "SELECT fid_a, fid_b, barrier, barr_fid, missing FROM houses_conflicts WHERE kind != 'tight'"):
        k, i = houses[a - 1]
        listed[k][(i, -1 - roads[road - 1][1]) if barrier else tuple(sorted((i, houses[b - 1][1])))] = missing
    data.close()
    return move, listed, json.load(open("b.json"))["displacement"]


def bodies_of_line(text):
    """The line without pieces and nodes, which are most of it."""
    begin = text.find(', "pieces":')
    return json.loads(text if begin < 0 else text[:begin] + "}")


def bounds_by_trees(world_of, weight_of, worlds):
    """What the trees of the file prove for each world, without the least prices of pairs that are in none."""
    bound, weight, pull = [0.0] * worlds, {}, {}
    for line in map(bodies_of_line, open("b.jsonl")):
        for body in line.get("bodies", ()):
            if body["weight"] is None or "features" not in body:
                continue
            fid, w, (x, y) = body["features"][0]["fid"], body["weight"], body["shift"]
            bound[world_of[fid]] -= w * (x * x + y * y)
            weight[fid] = weight.get(fid, 0) + w
            p, q = pull.get(fid, (0, 0))
            pull[fid] = p + w * x, q + w * y
        if "bodies" in line:
            bound[next(world_of[b["features"][0]["fid"]] for b in line["bodies"] if "features" in b)] += line["bound"]
    for fid, (x, y) in pull.items():
        if x or y:
            bound[world_of[fid]] -= (x * x + y * y) / (weight_of[fid] - weight[fid])
    return bound


def check_layer(program, seed, count, steps, effort):
    rng = random.Random(seed)
    turn, kappa = rng.random() < 0.3, rng.choice(KAPPAS)
    rows, least_gap, stiff = not turn and rng.random() < 0.6, rng.choice((GAP, GAP, 0.0, 1.0, 2.5)), rng.choice(STIFF)
    worlds = []
    while len(worlds) < count:
        world = World(rng, 1e-9 if turn else 0.0)
        if rows and rng.random() < 0.75:
            world.line_up(rng)
        if turn and world.has_exact_fit():
            continue
        if not rows or world.find_rows():
            worlds.append(world)
    houses, roads = write_layers(worlds, turn)
    words = ["--effort", effort, "--ease", repr(kappa), "--least-gap", repr(least_gap), "--rows", "auto" if rows else "no"]
    words += ["--row-stiffness", "%r,%r" % stiff] if rows else []
    move, listed, d = run(program, houses, roads, worlds, turn, words)
    world_of = {fid: k for fid, (k, _) in enumerate(houses, 1)}
    proved = bounds_by_trees(world_of, {fid: worlds[k].weight[i] for fid, (k, i) in enumerate(houses, 1)}, count)
    trouble, costs, least = [], [], []
    for k, world in enumerate(worlds):
        judge = Judge(world, listed[k], kappa, GAP - least_gap, stiff)
        cost = judge.cost(move[k])
        for name, i, j, rectangles, owed in world.pairs():
            s = listed[k].get(name)
            if s is None or not world.price(i, j, kappa):
                continue
            own = lacks(rectangles, owed, (move[k][j][0] if j is not None else 0) - move[k][i][0],
                        (move[k][j][1] if j is not None else 0) - move[k][i][1])
            if abs(own - s) > 1e-6:
                trouble.append("world %d, pair %s: lacks %.9g, printed %.9g" % (k, name, own, s))
        costs.append(cost)
        starts = [[(0.0, 0.0)] * len(world.house)] + [move[k]] * 2
        found = min([judge.descend(rng, list(t), steps) for t in starts])
        least.append(min(cost, found))
        if not proved[k] <= least[k] * (1 + 1e-9) + 1e-7:
            trouble.append("world %d: its trees prove %.12g, which is above %.12g" % (k, proved[k], least[k]))
    if abs(sum(costs) - d["cost"]) > 1e-7 * (1 + d["cost"]):
        trouble.append("cost %.12g, by the oracle %.12g" % (d["cost"], sum(costs)))
    if not d["lower_bound"] <= sum(least) * (1 + 1e-9) + 1e-7:
        trouble.append("bound %.12g is above %.12g" % (d["lower_bound"], sum(least)))
    return trouble, sum(least), d["lower_bound"]


def main():
    program, seed, layers = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    (count, steps, effort), failed, sums = sys.argv[4:] + ["4", "150", "1"][len(sys.argv) - 4:], 0, [0.0, 0.0]
    for layer in range(layers):
        trouble, least, bound = check_layer(program, "%d %d" % (seed, layer), int(count), int(steps), effort)
        sums[0] += least
        sums[1] += bound
        for line in trouble:
            print("layer %d: %s" % (layer, line))
            failed += 1
    print("least costs found %.6g, bounds %.6g" % tuple(sums))
    if sums[1] < 0.75 * sums[0]:
        print("the bounds are far from the costs")
        failed += 1
    return min(failed, 1)


if __name__ == "__main__":
    sys.exit(main())
