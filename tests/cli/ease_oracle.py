"""--ease compared with an independent program: python3 ease_oracle.py SUNDER SEED LAYERS.

Makes layers of fronts that are far from each other: up to four houses in a line, between roads across this line, with
limits and weights of their own. All houses reach equally far across the line, and no house can pass another or a road
within its limit, so only the moves along the line matter, and which side a house is on is known: the least cost is that
of a convex quadratic program, which is solved here in rationals. Which pairs are listed, and which of them overlap, is
taken from a run without --ease.

Asked of each front: its cost is the least; no pair is listed that was not, and none stands worse than at the start. Of
each layer: the printed sums are those of the listed pairs, and the printed bound is not above the least cost. A larger
price never leaves a larger sum of squares. Uses only Python's standard library, and no code of the program."""
import json
import os
import random
import sqlite3
import subprocess
import sys
from fractions import Fraction

APART, FRONTS = 4096, 24


class Front:
    """Houses [from, to], limits and weights along a line, and roads (position, width)."""

    def __init__(self, rng, number):
        self.turned, self.at = rng.random() < 0.5, APART * number
        self.gap, self.house, self.road = 4.0, [], []
        x = 0.0
        if rng.random() < 0.7:
            self.road.append((-rng.uniform(-2, 9), rng.choice((0.0, 4.0, 8.0))))
        for _ in range(rng.randrange(1, 5)):
            long = rng.uniform(36, 44)
            self.house.append((x, x + long, rng.choice((0.0, rng.uniform(1, 8), rng.uniform(1, 8), 8.0)),
                               rng.choice((1.0, 1.0, rng.uniform(0.2, 5)))))
            x += long + rng.choice((rng.uniform(-6, 4), rng.uniform(0, 9)))
        if rng.random() < 0.7:
            self.road.append((self.house[-1][1] + rng.uniform(-2, 9), rng.choice((0.0, 4.0, 8.0))))

    def point(self, x, y):
        return (y, self.at + x) if self.turned else (self.at + x, y)

    def pairs(self):
        """All pairs that may meet: (i, j, distance that j - i has to grow by, what they are). i or j: None is a road."""
        n = len(self.house)
        found = [(i, i + 1, self.gap - (self.house[i + 1][0] - self.house[i][1]), (i, i + 1)) for i in range(n - 1)]
        for k, (x, width) in enumerate(self.road):
            left = x < self.house[0][0] + 10
            house = 0 if left else n - 1
            apart = self.house[0][0] - x if left else x - self.house[-1][1]
            found.append((None if left else house, house if left else None, self.gap + width / 2 - apart, (house, -1 - k)))
        return found


# ---- The least cost ------------------------------------------------------------------------------------------------------


def price_of(front, pair, kappa):
    """Weight, linear and squared price of what the pair lacks; None if neither of the two may move."""
    i, j = pair[:2]
    ends = [front.house[k] for k in (i, j) if k is not None and front.house[k][2] > 0]
    if not ends:
        return None
    weight = min(h[3] for h in ends)
    return weight, 4 * weight * min(h[2] for h in ends), weight * kappa


def solved(matrix, right):
    """x of matrix x = right, by elimination."""
    n, rows = len(right), [list(row) + [b] for row, b in zip(matrix, right)]
    for k in range(n):
        pivot = next(r for r in range(k, n) if rows[r][k])
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [v / rows[k][k] for v in rows[k]]
        for r in range(n):
            if r != k and rows[r][k]:
                rows[r] = [v - rows[r][k] * w for v, w in zip(rows[r], rows[k])]
    return [row[n] for row in rows]


def dot(p, q):
    return sum(a * b for a, b in zip(p, q))


def least_value(weight, linear, rows):
    """The least of sum weight z^2 + linear z where n.z >= d for all rows (n, d): a dual active set method, exact."""
    z, active, force = [-c / (2 * w) for w, c in zip(weight, linear)], [], []
    while True:
        left, worst = min((dot(n, z) - d, r) for r, (n, d) in enumerate(rows))
        if left >= 0:
            return sum(w * v * v + c * v for w, c, v in zip(weight, linear, z))
        normal, own = rows[worst][0], Fraction(0)
        while left < 0:
            scaled = [v / (2 * w) for v, w in zip(normal, weight)]
            normals = [rows[k][0] for k in active]
            bars = [[v / (2 * w) for v, w in zip(n, weight)] for n in normals]
            share = solved([[dot(n, b) for b in bars] for n in normals], [dot(n, scaled) for n in normals]) if active else []
            step = [v - sum(r * b[k] for r, b in zip(share, bars)) for k, v in enumerate(scaled)]
            drop = [(f / r, k) for k, (f, r) in enumerate(zip(force, share)) if r > 0]
            full = -left / dot(step, normal) if any(step) else None
            assert drop or full is not None, "no solution"
            size = min([full] if full is not None else [], default=None) if not drop else \
                min(drop)[0] if full is None else min(full, min(drop)[0])
            z = [v + size * q for v, q in zip(z, step)]
            force, own = [f - size * r for f, r in zip(force, share)], own + size
            left = dot(normal, z) - rows[worst][1]
            if drop and size == min(drop)[0] and left < 0:
                del active[min(drop)[1]], force[min(drop)[1]]
        active.append(worst)
        force.append(own)


def least_cost(front, plain, kappa):
    """The least cost: moves, and what each listed pair lacks, as unknowns. A listed pair is no worse than at the start,
    and does not overlap if it did not in the run without --ease. plain: what pairs lack in that run."""
    houses, pairs = len(front.house), [p for p in front.pairs() if price_of(front, p, kappa)]
    eased = [p for p in pairs if p[3] in plain]
    price = [price_of(front, p, kappa) for p in eased]
    weight = [Fraction(h[3]) for h in front.house] + [Fraction(p[2]) for p in price]
    linear = [Fraction(0)] * houses + [Fraction(p[1]) for p in price]
    rows = []

    def demand(i, j, d, slack=None):
        n = [Fraction((k == j) - (k == i) + (k == slack)) for k in range(len(weight))]
        rows.append((n, Fraction(d)))

    for k, h in enumerate(front.house):
        demand(None, k, -h[2]), demand(k, None, -h[2])
    for k, (i, j, d, name) in enumerate(eased):
        owed = front.gap if None not in (i, j) else front.gap + front.road[-1 - name[1]][1] / 2
        demand(None, None, 0, houses + k), demand(i, j, d, houses + k)
        demand(i, j, max(0, d - owed) if plain[name] <= owed + 1e-6 else 0)
    for i, j, d, name in pairs:
        if name not in plain:
            demand(i, j, d)
    return float(least_value(weight, linear, rows))


# ---- What the program does -----------------------------------------------------------------------------------------------


class Run:
    """A run of the program: moves, listed pairs with what they lack, and the statistics."""

    def __init__(self, program, fronts, words):
        done = subprocess.run([program, "separate", "in.gpkg", "out.gpkg", "--overwrite", "--rows", "no", "--gap", "4", "--input-layer", "houses",
                               "--no-blocks", "--contained", "separate", "--max-shift-field", "most", "--weight-field", "w",
                               "--barrier", "in.gpkg,layer=roads,width-field=width", "--stats", "stats.json"] + words,
                              capture_output=True, text=True)
        assert done.returncode in (0, 3), done.stderr
        self.stats, data = json.load(open("stats.json")), sqlite3.connect("out.gpkg")
        self.move = {f: (x, y) for f, x, y in data.execute("SELECT fid, sunder_dx, sunder_dy FROM houses")}
        self.lacks = [{} for _ in fronts]
        for a, b, barrier, road, missing in data.execute(
                "SELECT fid_a, fid_b, barrier, barr_fid, missing FROM houses_conflicts"):
            t, i = house_at[a]
            name = (i, -1 - road_at[road][1]) if barrier else tuple(sorted((i, house_at[b][1])))
            self.lacks[t][name] = missing
        data.close()

    def cost(self, fronts, kappa):
        """The cost of each front."""
        costs = [0.0] * len(fronts)
        for fid, (x, y) in self.move.items():
            t, k = house_at[fid]
            costs[t] += fronts[t].house[k][3] * (x * x + y * y)
        for t, front in enumerate(fronts):
            for pair in front.pairs():
                price, s = price_of(front, pair, kappa), self.lacks[t].get(pair[3])
                if price and s is not None:
                    costs[t] += price[1] * s + price[2] * s * s
        return costs


def write_layers(fronts):
    house_at.clear(), road_at.clear()
    if os.path.exists("in.gpkg"):
        os.remove("in.gpkg")
    with open("houses.csv", "w") as houses, open("roads.csv", "w") as roads:
        houses.write("WKT,most,w\n")
        roads.write("WKT,width\n")
        for t, front in enumerate(fronts):
            for k, (low, high, most, weight) in enumerate(front.house):
                ring = ",".join("%r %r" % front.point(*p) for p in ((low, 0), (high, 0), (high, 60), (low, 60), (low, 0)))
                houses.write('"POLYGON((%s))",%r,%r\n' % (ring, most, weight))
                house_at[len(house_at) + 1] = t, k
            for k, (x, width) in enumerate(front.road):
                roads.write('"LINESTRING(%s)",%r\n' % (",".join("%r %r" % front.point(x, y) for y in (-99, 160)), width))
                road_at[len(road_at) + 1] = t, k
    for more, name, kind in (([], "houses", "POLYGON"), (["-update"], "roads", "LINESTRING")):
        subprocess.run(["ogr2ogr", "-q", *more, "in.gpkg", name + ".csv", "-nln", name, "-nlt", kind, "-oo",
                        "AUTODETECT_TYPE=YES", "-oo", "KEEP_GEOM_COLUMNS=NO", "-a_srs", "EPSG:32633"], check=True)


house_at, road_at = {}, {}  # FID: front, number


def check_layer(program, seed):
    rng = random.Random(seed)
    fronts = [Front(rng, t) for t in range(FRONTS)]
    write_layers(fronts)
    plain, trouble, squares = Run(program, fronts, ["--ease", "no"]), [], None
    for kappa in (3.0, 30.0, 300.0):
        run = Run(program, fronts, ["--ease", repr(kappa)])
        costs, least = run.cost(fronts, kappa), [least_cost(f, plain.lacks[t], kappa) for t, f in enumerate(fronts)]
        for t, front in enumerate(fronts):
            what = "front %d, price %g" % (t, kappa)
            if not least[t] - 1e-6 <= costs[t] * (1 + 1e-9):
                trouble.append("%s: the oracle is wrong: %g, at least %g" % (what, costs[t], least[t]))
            if not costs[t] <= least[t] * (1 + 1e-5) + 1e-4:
                trouble.append("%s: costs %.9g, least is %.9g" % (what, costs[t], least[t]))
            for name, s in run.lacks[t].items():
                before = next(d for _, _, d, pair in front.pairs() if pair == name)
                if name not in plain.lacks[t]:
                    trouble.append("%s: %s was solved" % (what, name))
                if s > before + 1e-9:
                    trouble.append("%s: %s lacks %.9g, %.9g before" % (what, name, s, before))
        priced = [(price_of(f, p, kappa), run.lacks[t][p[3]]) for t, f in enumerate(fronts) for p in f.pairs()
                  if p[3] in run.lacks[t]]
        priced = [(price, s) for price, s in priced if price]
        d, short = run.stats["displacement"], run.stats["shortfall"]
        sums = (len(priced), sum(s for _, s in priced), sum(p[1] * s + p[2] * s * s for p, s in priced), sum(costs))
        printed = (short["pairs"], short["sum"], d["cost_shortfall"], d["cost"])
        if any(abs(a - b) > 1e-9 * abs(b) for a, b in zip(printed, sums)):
            trouble.append("price %g: printed %s, summed %s" % (kappa, printed, sums))
        if abs(d["cost"] - d["cost_moves"] - d["cost_shortfall"]) > 1e-9 * d["cost"]:
            trouble.append("price %g: the cost is not the sum of its parts" % kappa)
        if not d["cost_alone"] <= d["lower_bound"] <= sum(least) * (1 + 1e-9) + 1e-6:
            trouble.append("price %g: bound %.9g, least %.9g" % (kappa, d["lower_bound"], sum(least)))
        now = [sum(price_of(f, p, kappa)[0] * run.lacks[t].get(p[3], 0)**2 for p in f.pairs() if price_of(f, p, kappa))
               for t, f in enumerate(fronts)]
        for t in range(FRONTS if squares else 0):
            if now[t] > squares[t] * (1 + 1e-6) + 1e-6:
                trouble.append("front %d: sum of squares %.9g at price %g, less at a lower price" % (t, now[t], kappa))
        squares = now
    eased = sum(costs) < 0.99 * sum(plain.cost(fronts, kappa))
    return trouble if eased else trouble + ["nothing is eased"]


def main(check):
    """Checks layers with check(program, seed), which returns sentences about what is wrong."""
    program, seed, layers = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    failed = 0
    for layer in range(layers):
        for line in check(program, "%d %d" % (seed, layer)):
            print("layer %d: %s" % (layer, line))
            failed += 1
    return min(failed, 1)


if __name__ == "__main__":
    sys.exit(main(check_layer))
