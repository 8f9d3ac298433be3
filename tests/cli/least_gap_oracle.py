"""--least-gap compared with an independent program: python3 least_gap_oracle.py SUNDER SEED LAYERS.

The layers are those of ease_oracle.py: fronts of houses in a line between roads, where only the moves along the line
matter. Here every pair may stand between the least gap and the gap, at its price, so the least cost is that of another
convex quadratic program: no unlisted pair is nearer than the least gap, and what it lacks of the gap is an unknown.
Roads have a least gap of their own in some layers. Which pairs are listed as conflicts is taken from the run.

Asked of each front: its cost is the least; the conflicts are among those of a run with the least gap as the gap; a pair
is tight if and only if it stands between the two gaps, and lacks what its moves say. Of each layer: the printed sums,
that the bound holds and is within a tenth of the cost, and that `check` lists the same. A larger price never leaves a larger sum of squares."""
import json
import random
import sqlite3
import subprocess
import sys
from fractions import Fraction

import ease_oracle as base

GAP = 4.0


class Run:
    """A run of the program: moves, what conflicts and tight pairs lack, and the statistics."""

    def __init__(self, program, fronts, gap, words):
        self.call = ["--gap", repr(gap), "--input-layer", "houses", "--no-blocks", "--contained", "separate"]
        done = subprocess.run([program, "separate", "in.gpkg", "out.gpkg", "--overwrite", "--rows", "no", "--max-shift-field", "most",
                               "--weight-field", "w", "--stats", "stats.json"] + self.call + words,
                              capture_output=True, text=True)
        assert done.returncode in (0, 3), done.stderr
        self.stats, data = json.load(open("stats.json")), sqlite3.connect("out.gpkg")
        self.status, self.code = dict(data.execute("SELECT fid, sunder_st FROM houses")), done.returncode
        self.move = {f: (x, y) for f, x, y in data.execute("SELECT fid, sunder_dx, sunder_dy FROM houses")}
        self.lacks, self.tight, self.reasons = [{} for _ in fronts], [{} for _ in fronts], set()
        for a, b, barrier, road, missing, kind, reason in data.execute(
                "SELECT fid_a, fid_b, barrier, barr_fid, missing, kind, reason FROM houses_conflicts"):
            t, i = base.house_at[a]
            name = (i, -1 - base.road_at[road][1]) if barrier else tuple(sorted((i, base.house_at[b][1])))
            (self.tight if kind == "tight" else self.lacks)[t][name] = missing
            self.reasons.add((kind == "tight", reason is None))
        data.close()


def least_cost(front, run, number, plain, kappa, slack):
    """The least cost of a front. slack: by how much the least gap of a house, and of a road, is less than the gap."""
    houses, listed = len(front.house), run.lacks[number]
    pairs = [p for p in front.pairs() if base.price_of(front, p, kappa)]
    price = [base.price_of(front, p, kappa) for p in pairs]
    weight = [Fraction(h[3]) for h in front.house] + [Fraction(p[2]) for p in price]
    linear = [Fraction(0)] * houses + [Fraction(p[1]) for p in price]
    rows = []

    def demand(i, j, d, slack=None):
        n = [Fraction((k == j) - (k == i) + (k == slack)) for k in range(len(weight))]
        rows.append((n, Fraction(d)))

    for k, h in enumerate(front.house):
        demand(None, k, -h[2]), demand(k, None, -h[2])
    for k, (i, j, d, name) in enumerate(pairs):
        road = None in (i, j)
        owed = GAP + front.road[-1 - name[1]][1] / 2 if road else GAP
        demand(None, None, 0, houses + k), demand(i, j, d, houses + k)
        if name not in listed:
            demand(i, j, d - slack[road])
        else:
            demand(i, j, max(0, d - owed) if plain[name] <= owed - slack[road] + 1e-6 else 0)
    return float(base.least_value(weight, linear, rows))


def cost_of(fronts, run, t, kappa):
    """What a front costs: its moves, and what its pairs lack along the line after them."""
    cost, lacks, front = 0.0, {}, fronts[t]
    along = {}
    for fid, (x, y) in run.move.items():
        if base.house_at[fid][0] == t:
            along[base.house_at[fid][1]] = y if front.turned else x
            cost += front.house[base.house_at[fid][1]][3] * (x * x + y * y)
    for pair in front.pairs():
        i, j, d, name = pair
        s, price = d - along.get(j, 0.0) + along.get(i, 0.0), base.price_of(front, pair, kappa)
        if s > 1e-9:
            lacks[name] = s
        if s > 0 and price:
            cost += price[1] * s + price[2] * s * s
    return cost, lacks


def check_layer(program, seed):
    rng, trouble, squares = random.Random(seed), [], None
    fronts = [base.Front(rng, t) for t in range(base.FRONTS)]
    base.write_layers(fronts)
    least, own = rng.choice((0.0, 1.0, 2.5)), rng.choice((None, None, 0.5, 3.0))
    slack = [GAP - least, GAP - (least if own is None else own)]
    roads = "in.gpkg,layer=roads,width-field=width"
    words = ["--least-gap", repr(least), "--barrier", roads + ("" if own is None else ",least=%r" % own)]
    plain = Run(program, fronts, least, ["--barrier", roads + ",gap=%r" % (least if own is None else own)])
    for kappa in (3.0, 30.0, 300.0):
        run = Run(program, fronts, GAP, words + ["--ease", repr(kappa)])
        least_costs, costs, pairs = [], [], []
        for t, front in enumerate(fronts):
            what = "front %d, price %g" % (t, kappa)
            cost, lacks = cost_of(fronts, run, t, kappa)
            new = set(run.lacks[t]) - set(plain.lacks[t])
            if new:
                trouble.append("%s: in conflict, and not with the least gap alone: %s" % (what, new))
                continue
            best = least_cost(front, run, t, plain.lacks[t], kappa, slack)
            least_costs.append(best), costs.append(cost)
            if not best - 1e-6 <= cost * (1 + 1e-9):
                trouble.append("%s: the oracle is wrong: %g, at least %g" % (what, cost, best))
            if not cost <= best * (1 + 1e-5) + 1e-4:
                trouble.append("%s: costs %.9g, least is %.9g" % (what, cost, best))
            listed = {**run.lacks[t], **run.tight[t]}
            if set(listed) != set(lacks) or any(abs(listed[k] - lacks[k]) > 1e-6 for k in listed):
                trouble.append("%s: lists %s, its moves say %s" % (what, listed, lacks))
            for i, j, d, name in front.pairs():
                far = slack[None in (i, j)]
                if name in run.tight[t] and not run.tight[t][name] <= far + 1e-9:
                    trouble.append("%s: %s is tight, and lacks %.9g" % (what, name, run.tight[t][name]))
                if name in run.lacks[t] and not run.lacks[t][name] >= far - 1e-9:
                    trouble.append("%s: %s is in conflict, and lacks %.9g" % (what, name, run.lacks[t][name]))
                price = base.price_of(front, (i, j, d, name), kappa)
                if price and name in listed:
                    pairs.append((t, price, listed[name]))
        d, short = run.stats["displacement"], run.stats["shortfall"]
        sums = (len(pairs), sum(s for _, _, s in pairs), sum(p[1] * s + p[2] * s * s for _, p, s in pairs),
                sum(len(t) for t in run.tight), sum(costs))
        printed = (short["pairs"], short["sum"], d["cost_shortfall"], short["tight"], d["cost"])
        if any(abs(a - b) > 1e-7 * abs(b) + 1e-9 for a, b in zip(printed, sums)):
            trouble.append("price %g: printed %s, summed %s" % (kappa, printed, sums))
        if d["cost"] - d["lower_bound"] > 0.1 * (d["cost"] - d["cost_alone"]):
            trouble.append("price %g: cost %.9g, bound %.9g" % (kappa, d["cost"], d["lower_bound"]))
        if not d["cost_alone"] <= d["lower_bound"] <= sum(least_costs) * (1 + 1e-9) + 1e-6:
            trouble.append("price %g: bound %.9g, least %.9g" % (kappa, d["lower_bound"], sum(least_costs)))
        if run.reasons - {(True, True), (False, False)}:
            trouble.append("price %g: tight pairs have no reason, conflicts have one: %s" % (kappa, run.reasons))
        if (run.code == 3) != any(run.lacks):
            trouble.append("price %g: exit status %d" % (kappa, run.code))
        conflicts = {base.house_at[f] for f, status in run.status.items() if status == "blocked"}
        if conflicts - {(t, i) for t, lacks in enumerate(run.lacks) for name in lacks for i in name}:
            trouble.append("price %g: a house without a conflict is blocked" % kappa)
        checked = subprocess.run([program, "check", "out.gpkg"] + run.call + words, capture_output=True, text=True)
        kinds = [line.split("\t")[6] for line in checked.stdout.splitlines() if "\t" in line]
        if kinds.count("tight") != sums[3] or len(kinds) - sums[3] != sum(len(t) for t in run.lacks):
            trouble.append("price %g: check lists %d tight pairs and %d others, separate %d and %d" %
                           (kappa, kinds.count("tight"), len(kinds) - kinds.count("tight"), sums[3],
                            sum(len(t) for t in run.lacks)))
        now = [sum(p[0] * s * s for of, p, s in pairs if of == t) for t in range(base.FRONTS)]
        for t in range(base.FRONTS if squares else 0):
            if now[t] > squares[t] * (1 + 1e-6) + 1e-6:
                trouble.append("front %d: sum of squares %.9g at price %g, less at a lower price" % (t, now[t], kappa))
        squares = now
    return trouble if sums[3] else trouble + ["nothing is tight"]


if __name__ == "__main__":
    sys.exit(base.main(check_layer))
