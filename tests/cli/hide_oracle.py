"""--hide compared with an independent program: python3 hide_oracle.py SUNDER SEED LAYERS.

Makes layers of corridors that are far from each other: up to seven rectangles in a line between two walls that are so
near that nothing can move across, with limits and classes of their own, blocks, and posts at the ends. Only the moves
along the line matter. In ordered layers no house can pass another within the limits, so a choice of features has a
layout if a system of differences has a solution; in the others, with --allow-jumps, the houses may take any order. All
coordinates are multiples of 1/8, and all tests are of whole numbers. The best choice is found by trying all of them.

Asked of each corridor: no feature of class 0 is hidden; hidden features stay where they were; the others keep their gap
and their limits, save conflicts between features of class 0 and posts, where these have no layout by themselves; no
choice is better than the best one; no bound is above it, so that it is the best one where the program calls it proved;
and no proved clause has a layout. Asked of each layer: the checker accepts the file of --proof, the sums that are printed are
those of the hidden features, the bound is not above the best sums by class, and nearly all components are proved. Uses
only Python's standard library, and no code of the program."""
import itertools
import json
import math
import os
import random
import sqlite3
import struct
import subprocess
import sys

from hide_clauses import Clauses

APART, CORRIDORS, GAP, SCALE, LAST = 4096.0, 40, 4.0, 8, 1 << 40
HIGH = 60.0


class Corridor:
    """Houses [low, high] along a line, with limits, classes and blocks; posts (position, width), before and behind."""

    def __init__(self, rng, number, how):
        self.turned, self.at, self.how, self.known = rng.random() < 0.5, APART * number, how, None
        self.house, self.limit, self.fixed, self.level, self.block = [], [], [], [], []
        x, n = 0.0, rng.randrange(1, 8)
        for k in range(n):
            long = rng.randrange(160, 480) / SCALE if how.ordered else rng.randrange(40, 200) / SCALE
            self.house.append((x, x + long))
            self.limit.append(rng.choice((0, 0.5, 1, 2, 3, 8)) if how.ordered else rng.choice((0, 4, 8, 20, 30)))
            self.fixed.append(rng.random() < 0.1)
            self.level.append(rng.choice(how.levels))
            same = k > 0 and how.blocks and rng.random() < 0.4
            self.block.append(self.block[-1] if same else number * 10 + k)
            x += long + (rng.randrange(-40, 41) if rng.random() < 0.6 else rng.randrange(-16, 64)) / SCALE
            if not how.ordered and rng.random() < 0.3:
                x = self.house[0][0] + rng.randrange(0, 300) / SCALE
        self.post = [self.place_post(rng, min(self.house), -1), self.place_post(rng, max(self.house, key=lambda h: h[1]), 1)]
        if not how.ordered:  # a house that a post cuts in two stays on the side of its larger part
            for k, p in enumerate(self.post):
                if p and any((2 * p[0] - a - b) * (2 * k - 1) < 2 for a, b in self.house):
                    self.post[k] = None
        self.slack, self.road = rng.choice((0.0, 0.25, 1.0)), [None, None]

    def place_post(self, rng, house, way):
        if rng.random() < 0.4:
            return None
        edge = house[0] if way < 0 else house[1]
        return edge + way * rng.randrange(-24, 72) / SCALE, rng.choice((0.0, 2.0, 6.0))

    def point(self, x, y):
        return (y, self.at + x) if self.turned else (self.at + x, y)

    def ring(self, x0, y0, x1, y1):
        return "((%s))" % ",".join("%r %r" % self.point(*p) for p in ((x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)))

    def line(self, *points):
        return "LINESTRING(%s)" % ",".join("%r %r" % self.point(*p) for p in points)

    def has_layout_beside(self, kept, roads):
        """Is there a layout of these houses, with only these roads?"""
        self.known = roads
        found = self.has_layout(kept)
        self.known = None
        return found

    def most(self, k):
        """How far a house may move: no farther than the strictest member of its block, hidden or not."""
        return min(0 if f else m for m, f, b in zip(self.limit, self.fixed, self.block) if b == self.block[k])

    def walls(self):
        """Positions from which and up to which houses may stand."""
        left, right = self.post if self.known is None else (p if r in self.known else None for p, r in zip(self.post, self.road))
        return (None if not left else left[0] + left[1] / 2 + GAP), (None if not right else right[0] - right[1] / 2 - GAP)

    # ---- Which features have a layout ------------------------------------------------------------------------------------

    def has_layout(self, kept):
        return self.has_order(kept) if self.how.ordered else self.has_any_order(kept)

    def has_order(self, kept):
        """Is there a solution of the differences t_j - t_i >= d? Node 0 does not move."""
        nodes = sorted({self.block[k] for k in kept})
        at = {b: 1 + n for n, b in enumerate(nodes)}
        left, right = self.walls()
        arcs = []
        for k in kept:
            b, (low, high) = at[self.block[k]], self.house[k]
            arcs += [(0, b, -self.most(k)), (b, 0, -self.most(k))]
            if left is not None:
                arcs.append((0, b, left - low))
            if right is not None:
                arcs.append((b, 0, high - right))
        for i, j in itertools.combinations(kept, 2):
            if self.block[i] != self.block[j]:
                arcs.append((at[self.block[i]], at[self.block[j]], self.house[i][1] + GAP - self.house[j][0]))
        arcs = [(i, j, int(d * 2 * SCALE)) for i, j, d in arcs]
        t = [0] * (1 + len(nodes))
        for _ in range(len(t) + 1):
            change = False
            for i, j, d in arcs:
                if t[j] < t[i] + d:
                    t[j], change = t[i] + d, True
            if not change:
                return True
        return False

    def has_any_order(self, kept):
        """The least end of each set of houses, whatever their order."""
        left, right = self.walls()
        end = {0: left if left is not None else -1e6}
        for bits in range(1, 1 << len(kept)):
            best = None
            for n, k in enumerate(kept):
                before = end.get(bits & ~(1 << n))
                if not bits >> n & 1 or before is None:
                    continue
                low, high = self.house[k]
                start = max(low - self.most(k), before)
                if start <= low + self.most(k) and (right is None or start + high - low <= right):
                    best = min(start + high - low + GAP, LAST if best is None else best)
            if best is not None:
                end[bits] = best
        return (1 << len(kept)) - 1 in end

    # ---- The best choice -------------------------------------------------------------------------------------------------

    def weight(self, k):
        low, high = self.house[k]
        area = (high - low) * HIGH
        return max(1, round(1000 * {"1": 1.0, "area": area, "sqrt-area": math.sqrt(area)}[self.how.weighting]))

    def cost(self, hidden):
        """The weight hidden of each class, the most important first."""
        classes = sorted({c for c in self.how.classes() if c})
        return tuple(sum(self.weight(k) for k in hidden if self.rank(k) == c) for c in classes)

    def by_class(self, cost):
        return dict(zip(sorted({c for c in self.how.classes() if c}), cost))

    def rank(self, k):
        return self.how.rank(self.level[k])

    def best(self):
        """The cost of the best choice; None if the features that may not be hidden have no layout."""
        free = [k for k in range(len(self.house)) if self.rank(k)]
        choices = sorted((self.cost(h), h) for r in range(len(free) + 1) for h in itertools.combinations(free, r))
        for cost, hidden in choices:
            if self.has_layout([k for k in range(len(self.house)) if k not in hidden]):
                return cost
        return None


class Manner:
    """What the corridors of a layer have in common."""

    def __init__(self, rng):
        self.ordered, self.blocks = rng.random() < 0.7, False
        if self.ordered:
            self.blocks = rng.random() < 0.4
        self.levels = rng.choice(([1], [1], [1, 2], [1, 2, 3, None], [0, 1, 2, None], [0, 1]))
        self.weighting = rng.choice(("1", "area", "sqrt-area"))
        self.areas = rng.random() < 0.4
        self.words = ["--gap", "4", "--max-shift-field", "most", "--fixed-where", "fixed = 1", "--hide-weight", self.weighting,
                      "--barrier", "in.gpkg,layer=roads,width-field=width", "--barrier", "in.gpkg,layer=parks",
                      "--crossed", "hide"]
        if self.blocks:
            self.words += ["--block-field", "block"]
        if not self.ordered:
            self.words.append("--allow-jumps")
        if self.levels != [1] or rng.random() < 0.5:
            self.words += ["--hierarchy-field", "class"]
        self.words += rng.choice((["--rows", "no"], [])) if self.ordered else ["--rows", "no"]
        self.words += rng.choice((["--ease", "no"], [])) + rng.choice((["--effort", "0"], [], []))

    def rank(self, level):
        return LAST if level is None else level

    def classes(self):
        return [self.rank(c) for c in self.levels]


# ---- The program ---------------------------------------------------------------------------------------------------------


def make_layers(layers):
    """Makes in.gpkg of layers (name, kind of geometry, names of fields, rows of WKT and values)."""
    for name in ("in.gpkg", "out.gpkg", "again.gpkg"):
        if os.path.exists(name):
            os.remove(name)
    for name, kind, fields, rows in layers:
        with open(name + ".csv", "w") as file:
            file.write("WKT,%s\n" % fields)
            for row in rows:
                file.write('"%s",%s\n' % (row[0], ",".join("" if v is None else repr(v) for v in row[1:])))
        subprocess.run(["ogr2ogr", "-q", *(["-update"] if os.path.exists("in.gpkg") else []), "in.gpkg", name + ".csv", "-nln",
                        name, "-nlt", kind, "-oo", "AUTODETECT_TYPE=YES", "-oo", "KEEP_GEOM_COLUMNS=NO", "-oo",
                        "GEOM_POSSIBLE_NAMES=WKT", "-a_srs", "EPSG:32633"], check=True)


def write_layers(corridors):
    """Returns {FID: (corridor, house)}."""
    where, houses = {}, []
    roads, parks = [("LINESTRING(-9000 -9000,-9000 -9001)", 0.0)], [("POLYGON((-9000 -9100,-8999 -9100,-8999 -9101,-9000 -9100))", 1)]
    for t, c in enumerate(corridors):
        for k, (low, high) in enumerate(c.house):
            houses.append(("POLYGON" + c.ring(low, 0.0, high, HIGH), float(c.limit[k]), int(c.fixed[k]), c.level[k], c.block[k]))
            where[len(houses)] = t, k
        for y, way in ((-GAP - c.slack, -1), (HIGH + GAP + c.slack, 1)):
            if c.how.areas:
                parks.append(("POLYGON" + c.ring(-300.0, y, 1000.0, y + way * 5), 1))
            else:
                roads.append((c.line((-300.0, y), (1000.0, y)), 0.0))
        for k, post in enumerate(c.post):
            if post:
                roads.append((c.line((post[0], -80.0), (post[0], 150.0)), post[1]))
                c.road[k] = "roads:%d" % len(roads)
    make_layers((("houses", "POLYGON", "most,fixed,class,block", houses), ("roads", "LINESTRING", "width", roads),
                 ("parks", "POLYGON", "x", parks)))
    return where


def corners(blob):
    """The points of a polygon of one ring, as pairs."""
    start = 8 + {0: 0, 1: 32, 2: 48, 3: 48, 4: 64}[blob[3] >> 1 & 7]
    n, = struct.unpack_from("<I", blob, start + 9)
    return list(struct.iter_unpack("<2d", blob[start + 13:start + 13 + 16 * n]))


class Run:
    """A run of the program: states, shapes before and after, conflicts and statistics; with `proof` also the clauses, and
    what the checker of the proof refuses."""

    def __init__(self, program, words, result="out.gpkg", source="in.gpkg", proof=None):
        words = ["--input-layer", "houses", "--no-blocks", "--contained", "separate", "--hide", *words]
        done = subprocess.run([program, "separate", source, result, "--overwrite", "--stats", "stats.json", *words,
                               *(["--proof", proof] if proof else [])], capture_output=True, text=True)
        assert done.returncode in (0, 3), (done.stderr, words)
        self.status, self.hidden_stats = done.returncode, json.load(open("stats.json"))["hidden"]
        self.verified = json.load(open("stats.json"))["verified"]
        data, given = sqlite3.connect(result), sqlite3.connect(source)
        self.state = dict(data.execute("SELECT fid, sunder_st FROM houses"))
        column = [c[1] for c in data.execute("PRAGMA table_info(houses)") if c[2] == "POLYGON"][0]
        self.shape = {f: corners(g) for f, g in data.execute("SELECT fid, %s FROM houses" % column)}
        self.before = {f: corners(g) for f, g in given.execute("SELECT fid, %s FROM houses" % column)}
        self.conflicts = list(data.execute("SELECT fid_a, fid_b, barrier, kind, reason FROM houses_conflicts "
                                           "WHERE reason <> 'same_block'"))
        self.hidden = {f: row for f, *row in data.execute("SELECT fid, class, weight, forced, because FROM houses_hidden")}
        self.marks = {f for f, in data.execute("SELECT fid FROM houses WHERE sunder_inv = 1")}
        data.close(), given.close()
        self.clauses = Clauses(proof) if proof else None
        self.refused = self.clauses.refused(source, words + ["--result", result]) if proof else []


# ---- What is asked -------------------------------------------------------------------------------------------------------


def check_places(c, fids, run, listed):
    """Sentences about visible houses that break a gap or a limit, and hidden ones that moved."""
    trouble, place = [], {}
    for k, fid in enumerate(fids):
        axis = 1 if c.turned else 0
        if run.state[fid] == "hidden":
            if run.shape[fid] != run.before[fid]:
                trouble.append("hidden house %d moved" % fid)
            continue
        ring = [(p[axis], p[1 - axis]) for p in run.shape[fid]]
        place[k] = min(ring)[0] - c.at, max(ring)[0] - c.at
        t = place[k][0] - c.house[k][0]
        if t * t > c.most(k)**2 + 1e-9:
            trouble.append("house %d moved by %g, its limit is %g" % (fid, t, c.most(k)))
    left, right = c.walls()
    for k, (low, high) in place.items():
        if (left is not None and low < left or right is not None and high > right) and (fids[k], None) not in listed:
            trouble.append("house %d is too near a post" % fids[k])
    for i, j in itertools.combinations(place, 2):
        if c.block[i] != c.block[j] or not c.how.blocks:
            apart = max(place[j][0] - place[i][1], place[i][0] - place[j][1])
            if apart < GAP and (fids[i], fids[j]) not in listed:
                trouble.append("houses %d and %d are %g apart" % (fids[i], fids[j], apart))
    return trouble


def check_reasons(c, fids, run, hidden):
    """Sentences about hidden houses whose row is wrong."""
    trouble = []
    for k in hidden:
        level, weight, forced, because = run.hidden[fids[k]]
        names = because.split(": ")[-1].split(",")
        own = [fids.index(int(name)) for name in names if ":" not in name]
        if level != (c.level[k] if "--hierarchy-field" in c.how.words else 1) or round(1000 * weight) != c.weight(k) or k not in own:
            trouble.append("hidden house %d: %s" % (fids[k], run.hidden[fids[k]]))
        if forced and any(c.rank(j) for j in own if j != k):
            trouble.append("hidden house %d is not forced by %s" % (fids[k], because))
    return trouble


def check_corridor(c, fids, run, counts):
    """Sentences about what is wrong."""
    hidden = [k for k, fid in enumerate(fids) if run.state[fid] == "hidden"]
    mine = [row for row in run.conflicts if row[0] in fids]
    listed = {(min(a, b), max(a, b)) if not barrier else (a, None) for a, b, barrier, _, _ in mine}
    trouble = check_places(c, fids, run, listed)
    trouble += ["house %d of class 0 is hidden" % fids[k] for k in hidden if c.rank(k) == 0]
    trouble += check_reasons(c, fids, run, hidden)
    for members, named in run.clauses.all:
        if members[0] in fids and c.has_layout_beside([k for k, fid in enumerate(fids) if fid in named], named):
            trouble.append("there is a layout of the clause of %s, with %s" % (members, named))
    best, cost, bound = c.best(), c.cost(hidden), run.clauses.bound_of(fids)
    if best is None:
        trouble += ["a conflict of class 0 alone is expected: %s" % (row,) for row in mine
                    if any(c.rank(fids.index(f)) for f in row[:2] if f in fids)]
        return trouble
    trouble += ["needless conflict %s" % (row,) for row in mine]
    if cost < best:
        trouble.append("the oracle is wrong: hidden %s, best %s" % (cost, best))
    counts["worlds"] += 1
    counts["exact"] += bound == {k: v for k, v in c.by_class(cost).items() if v}
    if Clauses.is_above(bound, c.by_class(best)):
        trouble.append("the bound is %s, and the best choice costs %s" % (bound, best))
    return trouble


def check_again(program, words, run):
    """Sentences about a run with more threads, and one on the result without what is hidden."""
    trouble, more = [], Run(program, words + ["--threads", "4"], "again.gpkg")
    if (more.state, more.shape, more.hidden_stats) != (run.state, run.shape, run.hidden_stats):
        trouble.append("another result with four threads")
    if run.conflicts:
        return trouble  # limits count from the new places, so more of the features of class 0 may have a layout
    last = Run(program, words + ["--where", "sunder_st <> 'hidden'"], "again.gpkg", "out.gpkg")
    if last.hidden_stats["count"]:
        trouble.append("hidden in a second run: %s" % [f for f, state in last.state.items() if state == "hidden"])
    return trouble


def count(counts, stats):
    counts["hidden"] += stats["count"]
    counts["components"] += stats["components"]
    counts["proved"] += stats["components_proved"]


def check_layer(program, seed, counts):
    rng = random.Random(seed)
    how = Manner(rng)
    corridors = [Corridor(rng, t, how) for t in range(CORRIDORS)]
    where = write_layers(corridors)
    run = Run(program, how.words, proof="proof.jsonl")
    stats, trouble = run.hidden_stats, run.refused
    exact = stats["components"] == stats["components_proved"]
    for t, c in enumerate(corridors):
        fids = [f for f, (at, _) in where.items() if at == t]
        trouble += ["corridor %d: %s" % (t, line) for line in check_corridor(c, fids, run, counts)]
    hidden = [f for f in where if run.state[f] == "hidden"]
    weight = sum(corridors[where[f][0]].weight(where[f][1]) for f in hidden)
    if (stats["count"], round(1000 * stats["weight"])) != (len(hidden), weight):
        trouble.append("printed %s, hidden are %d, of weight %d" % (stats, len(hidden), weight))
    if exact and round(1000 * stats["lower_bound"]) != weight:
        trouble.append("all is proved, but the bound is %s, the weight %d" % (stats["lower_bound"], weight))
    if (run.status == 3) != bool(run.conflicts):
        trouble.append("exit status %d, %d conflicts" % (run.status, len(run.conflicts)))
    if not set(hidden) == run.marks == set(run.hidden):
        trouble.append("hidden are %s, marked %s, listed %s" % (hidden, run.marks, list(run.hidden)))
    if not run.verified:
        trouble.append("not verified")
    trouble += check_again(program, how.words, run) if rng.random() < 0.5 else []
    count(counts, stats)
    return trouble, how.words


def main(check):
    """Checks layers with check(program, seed, counts), which returns sentences about what is wrong and the options."""
    program, seed, layers = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    counts = dict.fromkeys(("worlds", "exact", "hidden", "components", "proved"), 0)
    failed = 0
    for layer in range(layers):
        trouble, words = check(program, "%d %d" % (seed, layer), counts)
        for line in trouble:
            print("layer %d (%s): %s" % (layer, " ".join(words), line))
            failed += 1
    print(counts)
    if counts["hidden"] < layers or counts["proved"] < 0.9 * counts["components"]:
        print("too few houses are hidden, or components proved")
        failed += 1
    return min(failed, 1)


if __name__ == "__main__":
    sys.exit(main(check_layer))
