"""What --hide proves beside layouts that an independent search finds: python3 hide_worlds.py SUNDER SEED LAYERS.

Makes layers of worlds that are far from each other: two to five rectangles with short limits, and up to two barriers, which
are segments or rectangles. Houses may jump and cross barriers. Coordinates are multiples of 1/64, so that doubles hold what
is computed here without error.

Asked of each world: visible houses keep the gap and their limits, and hidden ones stay; no layout is found of a proved clause;
none of a better choice, where the bound is what is hidden; and the bound is not more than that. Asked of each layer: the
checker accepts the file of --proof. For a layout houses are placed one after the other, at places where they touch
the gap of barriers and of houses placed before, at places of a grid and at random ones. Uses only Python's standard
library, and no code of the program."""
import itertools
import math
import random
import sys
from fractions import Fraction

from hide_clauses import Clauses
from hide_oracle import Run, count, main, make_layers

APART, WORLDS, TRIALS = 1000.0, 40, 4000


def steps(v, n=64):
    return math.floor(v * n) / n


class World:
    def __init__(self, rng, number, gap, levels, weighting):
        self.at, self.gap, self.levels, self.weighting = APART * number, gap, levels, weighting
        side = rng.choice((14, 20, 26))
        self.house = [self.rectangle(rng, side, 6, 14) for _ in range(rng.randrange(2, 6))]
        self.limit = [rng.choice((0, 1, 2, 3, 4, 5)) * 1.0 for _ in self.house]
        self.level = [rng.choice(levels) for _ in self.house]
        self.barrier = [self.rectangle(rng, side, 0, 12) for _ in range(rng.randrange(0, 3))]
        for k, (x0, y0, x1, y1) in enumerate(self.barrier):
            if rng.random() < 0.6 or x0 == x1 or y0 == y1:
                self.barrier[k] = (x0, y0, x0, y1 + 4) if rng.random() < 0.5 else (x0, y0, x1 + 4, y0)

    def rectangle(self, rng, side, least, most):
        x, y = rng.randrange(0, 4 * side) / 4, rng.randrange(0, 4 * side) / 4
        return x, y, x + rng.randrange(4 * least, 4 * most) / 4, y + rng.randrange(4 * least, 4 * most) / 4

    def text(self, r):
        x0, y0, x1, y1 = r[0] + self.at, r[1], r[2] + self.at, r[3]
        if x0 == x1 or y0 == y1:
            return "LINESTRING(%r %r,%r %r)" % (x0, y0, x1, y1)
        return "POLYGON((%r %r,%r %r,%r %r,%r %r,%r %r))" % (x0, y0, x1, y0, x1, y1, x0, y1, x0, y0)

    def clear(self, p, q):
        x, y = max(p[0] - q[2], q[0] - p[2], 0), max(p[1] - q[3], q[1] - p[3], 0)
        return x * x + y * y >= self.gap * self.gap

    # ---- Choices ---------------------------------------------------------------------------------------------------------

    def rank(self, k):
        return 1 << 40 if self.level[k] is None else self.level[k]

    def weight(self, k):
        x0, y0, x1, y1 = self.house[k]
        area = (x1 - x0) * (y1 - y0)
        return max(1, round(1000 * {"1": 1.0, "area": area, "sqrt-area": math.sqrt(area)}[self.weighting]))

    def by_class(self, hidden):
        return dict(zip(sorted({1 << 40 if c is None else c for c in self.levels if c != 0}), self.cost(hidden)))

    def cost(self, hidden):
        classes = sorted({1 << 40 if c is None else c for c in self.levels if c != 0})
        return tuple(sum(self.weight(k) for k in hidden if self.rank(k) == c) for c in classes)

    def better(self, hidden):
        """All choices that are better than this one, and not part of another that is."""
        free, cost = [k for k in range(len(self.house)) if self.rank(k)], self.cost(hidden)
        found = [set(h) for r in range(len(free) + 1) for h in itertools.combinations(free, r) if self.cost(h) < cost]
        return [h for h in found if not any(h < other for other in found)]

    # ---- Layouts ---------------------------------------------------------------------------------------------------------

    def places(self, rng, k, placed):
        """Moves that may be tried, those that touch something first."""
        x0, y0, x1, y1 = self.house[k]
        r, xs, ys = self.limit[k], [0.0], [0.0]
        for q in self.barrier + list(placed.values()):
            xs += [q[0] - self.gap - x1, q[2] + self.gap - x0]
            ys += [q[1] - self.gap - y1, q[3] + self.gap - y0]
        xs, ys = sorted({x for x in xs if abs(x) <= r}, key=abs), sorted({y for y in ys if abs(y) <= r}, key=abs)
        yield from itertools.product(xs, ys)
        for x in xs:
            yield from ((x, way * steps(math.sqrt(r * r - x * x))) for way in (-1, 1))
        for y in ys:
            yield from ((way * steps(math.sqrt(r * r - y * y)), y) for way in (-1, 1))
        for x, y in itertools.product((-0.75, -0.5, -0.25, 0, 0.25, 0.5, 0.75), repeat=2):
            yield r * x, r * y
        for _ in range(6):
            yield steps(rng.uniform(-r, r)), steps(rng.uniform(-r, r))

    def layout(self, rng, kept, placed, left, barriers=None):
        """Places of the houses to place, besides those that are; None if none was found. left: [trials] to go."""
        barriers = self.barrier if barriers is None else barriers
        if not kept:
            return placed
        k, r = kept[0], self.limit[kept[0]]
        x0, y0, x1, y1 = self.house[k]
        for x, y in self.places(rng, k, placed):
            left[0] -= 1
            if left[0] < 0:
                return None
            p = x0 + x, y0 + y, x1 + x, y1 + y
            if x * x + y * y > r * r or not all(self.clear(p, q) for q in barriers + list(placed.values())):
                continue
            found = self.layout(rng, kept[1:], {**placed, k: p}, left, barriers)
            if found:
                return found
        return None

    def find_better(self, rng, hidden):
        """A choice that is better than this one, with a layout."""
        for choice in self.better(hidden):
            kept = [k for k in range(len(self.house)) if k not in choice]
            for _ in range(3):
                rng.shuffle(kept)
                found = self.layout(rng, kept, {}, [TRIALS])
                if found is not None:
                    return choice, found
        return None


def check_world(w, fids, names, run, rng, counts):
    """Sentences about what is wrong."""
    trouble, place = [], {}
    hidden = {k for k, fid in enumerate(fids) if run.state[fid] == "hidden"}
    blocked = {f for row in run.conflicts for f in row[:2]}
    for k, fid in enumerate(fids):
        now, before = ([(Fraction(x), Fraction(y)) for x, y in shape[fid]] for shape in (run.shape, run.before))
        place[k] = min(now)[0] - Fraction(w.at), min(p[1] for p in now), max(now)[0] - Fraction(w.at), max(p[1] for p in now)
        t = place[k][0] - Fraction(w.house[k][0]), place[k][1] - Fraction(w.house[k][1])
        if k in hidden and now != before:
            trouble.append("hidden house %d moved" % fid)
        if t[0]**2 + t[1]**2 > (Fraction(w.limit[k]) + Fraction(1, 1 << 30))**2:
            trouble.append("house %d moved beyond its limit" % fid)
    for k in set(place) - hidden:
        others = [place[j] for j in place if j not in hidden and j > k and fids[j] not in blocked]
        if fids[k] not in blocked and not all(w.clear(place[k], q) for q in others + w.barrier):
            trouble.append("house %d is too near another or a barrier" % fids[k])
    trouble += ["house %d of class 0 is hidden" % fids[k] for k in hidden if w.rank(k) == 0]
    trouble += ["house of a class in a conflict: %s" % (row,) for row in run.conflicts
                if any(f in fids and w.rank(fids.index(f)) for f in row[:2])]
    for members, named in run.clauses.all:
        if members[0] in fids:
            kept, barriers = [k for k, fid in enumerate(fids) if fid in named], [b for b, name in zip(w.barrier, names) if name in named]
            found = w.layout(rng, kept, {}, [TRIALS], barriers)
            trouble += ["there is a layout of the clause of %s, with %s: %s" % (members, named, found)] * (found is not None)
    bound, cost = run.clauses.bound_of(fids), w.by_class(hidden)
    if Clauses.is_above(bound, cost):
        trouble.append("the bound is %s, and what is hidden costs %s" % (bound, cost))
    exact = not Clauses.is_above(cost, bound)
    counts["worlds"] += 1
    counts["exact"] += exact
    better = w.find_better(rng, hidden) if exact and hidden else None
    if better:
        trouble.append("hidden %s, better: %s" % ([fids[k] for k in hidden], better))
    return trouble


def check_layer(program, seed, counts):
    rng = random.Random(seed)
    gap, weighting = rng.choice((0.5, 1.0, 2.0, 3.0)), rng.choice(("1", "area", "sqrt-area"))
    levels = rng.choice(([1], [1, 2, None], [0, 1, 2]))
    worlds = [World(rng, t, gap, levels, weighting) for t in range(WORLDS)]
    houses, lines, areas, at, names = [], [("LINESTRING(-9000 -9000,-9000 -9001)", 1)], \
        [("POLYGON((-9000 -9100,-8999 -9100,-8999 -9101,-9000 -9100))", 1)], [], []
    for w in worlds:
        at.append([len(houses) + 1 + k for k in range(len(w.house))])
        houses += [(w.text(h), m, c) for h, m, c in zip(w.house, w.limit, w.level)]
        names.append([])
        for b in w.barrier:
            kind, of = ("lines", lines) if w.text(b)[0] == "L" else ("areas", areas)
            of.append((w.text(b), 1))
            names[-1].append("%s:%d" % (kind, len(of)))
    make_layers((("houses", "POLYGON", "most,class", houses), ("lines", "LINESTRING", "x", lines),
                 ("areas", "POLYGON", "x", areas)))
    words = ["--gap", repr(gap), "--max-shift-field", "most", "--hide-weight", weighting, "--hierarchy-field", "class",
             "--allow-jumps", "--rows", "no", "--ease", "no", "--barrier", "in.gpkg,layer=lines,side=no", "--barrier",
             "in.gpkg,layer=areas,side=no", "--crossed", "hide"]
    run, trouble = Run(program, words, proof="proof.jsonl"), []
    trouble += run.refused
    for t, w in enumerate(worlds):
        trouble += ["world %d: %s" % (t, line) for line in check_world(w, at[t], names[t], run, rng, counts)]
    count(counts, run.hidden_stats)
    return trouble, words


if __name__ == "__main__":
    sys.exit(main(check_layer))
