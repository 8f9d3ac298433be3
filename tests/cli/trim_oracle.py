"""--hide with --trim compared with an independent program: python3 trim_oracle.py SUNDER SEED LAYERS.

Makes layers of corridors as hide_oracle.py does, with further roads across them. A house may be cut back: it is an
interval, less what lies within the required distance of a road, of which the longest piece remains if it is long enough.
A choice gives each house its whole interval, the piece, or nothing. It has a layout if a system of differences has a
solution, since no house can pass another, nor a road. What the program adds to that distance against rounding is less
than HAIR, so each piece is known up to that: a choice has a layout for certain with the pieces as they are, and it may
have one with pieces that are shorter by HAIR at each end.

Asked of each corridor: what is hidden costs no less than the best choice, and the bound of the proof is not above it;
visible houses keep their distances; no proved clause has a layout with the levels that it names; and with what is hidden,
no choice of pieces loses less weighted area than the bound says. Asked of each layer: the checker accepts the proof.
Uses only Python's standard library, and no code of the program."""
import itertools
import json
import random
import sqlite3
import sys

from hide_oracle import CORRIDORS, GAP, HIGH, SCALE, Corridor, Manner, Run, count, main, write_layers
from hide_clauses import Clauses

KEEP, HAIR, TIE = 0.6, 1e-6, 1e-9


class Town(Corridor):
    def __init__(self, rng, number, how):
        super().__init__(rng, number, how)
        self.limit = [rng.choice((0, 0.5, 1, 2)) for _ in self.house]
        self.slack = rng.choice((0.25, 1.0))
        self.post, self.road = [], []
        for low, high in self.house:
            if rng.random() < 0.5:
                at = rng.choice((low, high)) + rng.randrange(-40, 41) / SCALE
                if all(abs(2 * at - a - b) > 1 for a, b in self.house):  # it is clear on which side the larger part is
                    self.post.append((at, rng.choice((0.0, 2.0, 4.0))))
        self.road = [None] * len(self.post)
        self.piece = [self.cut(*house) for house in self.house]

    def cut(self, low, high):
        """The longest piece, or None. Two of equal length: None, and the corridor is in doubt."""
        if self.how.crossed == "hide" and any(low < at < high for at, _ in self.post):
            return None
        parts = [(low, high)]
        for at, width in self.post:
            r = width / 2 + GAP
            parts = [q for a, b in parts for q in ((a, min(b, at - r)), (max(a, at + r), b)) if q[1] > q[0]]
        parts.sort(key=lambda q: q[0] - q[1])
        if not parts or parts == [(low, high)]:
            return None
        if len(parts) > 1 and parts[0][1] - parts[0][0] < parts[1][1] - parts[1][0] + 1:
            self.doubt = True
        length = parts[0][1] - parts[0][0]
        if abs(length - KEEP * (high - low)) < HAIR:
            self.doubt = True
        return parts[0] if length >= KEEP * (high - low) else None

    doubt = False

    def interval(self, k, level, hair):
        """The interval of a house with its level, and shorter by `hair` where it is cut."""
        low, high = self.house[k]
        if not level or not self.piece[k]:
            return low, high
        a, b = self.piece[k]
        return a + hair * (a > low), b - hair * (b < high)

    def range(self, k, low, high, roads):
        """Within which the house may move."""
        least, most = -self.most(k), self.most(k)
        for (at, width), name in zip(self.post, self.road):
            r = width / 2 + GAP
            if roads is not None and name not in roads:
                continue
            if sum(self.house[k]) < 2 * at:
                most = min(most, at - r - high)
            else:
                least = max(least, at + r - low)
        return least, most

    def has_layout_at(self, level, hair=0.0, roads=None):
        """level: {house: level}; roads: the only ones that there are, or None."""
        nodes = sorted({self.block[k] for k in level})
        place, arcs = {b: 1 + n for n, b in enumerate(nodes)}, []
        at = {k: self.interval(k, level[k], hair) for k in level}
        for k in level:
            least, most = self.range(k, *at[k], roads)
            arcs += [(0, place[self.block[k]], least), (place[self.block[k]], 0, -most)]
        for i, j in itertools.combinations(sorted(level), 2):
            if self.block[i] != self.block[j]:
                arcs.append((place[self.block[i]], place[self.block[j]], at[i][1] + GAP - at[j][0]))
        t = [0.0] * (1 + len(nodes))
        for _ in range(len(t) + 1):
            change = False
            for i, j, d in arcs:
                if t[j] < t[i] + d - TIE:
                    t[j], change = t[i] + d, True
            if not change:
                return True
        return False

    def best_at(self, hair):
        """The least hidden cost, with all pieces; None: those that are never hidden have no layout."""
        every = range(len(self.house))
        free = [k for k in every if self.rank(k)]
        for cost, hidden in sorted((self.cost(h), h) for r in range(len(free) + 1) for h in itertools.combinations(free, r)):
            if self.has_layout_at({k: 1 for k in every if k not in hidden}, hair):
                return cost
        return None

    def least_lost(self, hidden):
        """The least weighted share of area that has to be lost by those that are not hidden; None if they have no layout."""
        kept = [k for k in range(len(self.house)) if k not in hidden]
        pieces = [k for k in kept if self.piece[k]]
        lost = {k: self.weight(k) / 1000 * (1 - (self.piece[k][1] - self.piece[k][0]) / (self.house[k][1] - self.house[k][0])) for k in pieces}
        found = [sum(lost[k] for k in cut) for r in range(len(pieces) + 1) for cut in itertools.combinations(pieces, r)
                 if self.has_layout_at({k: int(k in cut) for k in kept})]
        return min(found, default=None)


class TownManner(Manner):
    def __init__(self, rng):
        super().__init__(rng)
        while not self.ordered:
            super().__init__(rng)
        self.crossed = rng.choice(("trim", "hide"))
        at = self.words.index("--crossed")
        del self.words[at:at + 2]
        while "--rows" in self.words:
            del self.words[self.words.index("--rows"):self.words.index("--rows") + 2]
        self.words += ["--rows", "no", "--trim", "--trim-keep", str(KEEP), "--crossed", self.crossed]


def check_places(c, fids, run, listed):
    """Sentences about visible houses that are too near each other or a road."""
    trouble, place, axis = [], {}, 1 if c.turned else 0
    for k, fid in enumerate(fids):
        if run.state[fid] != "hidden":
            along = [p[axis] - c.at for p in run.shape[fid]]
            place[k] = min(along), max(along)
    for k, (low, high) in place.items():
        for at, width in c.post:
            if max(low - at, at - high) < width / 2 + GAP - TIE and (fids[k], None) not in listed:
                trouble.append("house %d is too near a road" % fids[k])
    for i, j in itertools.combinations(place, 2):
        if c.block[i] != c.block[j] and (fids[i], fids[j]) not in listed:
            if max(place[j][0] - place[i][1], place[i][0] - place[j][1]) < GAP:
                trouble.append("houses %d and %d are too near" % (fids[i], fids[j]))
    return trouble


def check_clauses(c, fids, lines):
    """Sentences about proved clauses that have a layout with their levels, by themselves."""
    trouble = []
    for line in lines:
        level = {fids.index(fid): n for fid, n in line["members"] if fid in fids}
        if not level:
            continue
        named = Clauses.things(line)
        level.update({k: 1 for k, fid in enumerate(fids) if fid in named and k not in level})
        if c.has_layout_at(level, 0.0, named):
            trouble.append("there is a layout of the clause %s" % line["members"])
    return trouble


def check_corridor(c, fids, run, lines, counts):
    hidden = [k for k, fid in enumerate(fids) if run.state[fid] == "hidden"]
    mine = [row for row in run.conflicts if row[0] in fids]
    listed = {(min(a, b), max(a, b)) if not barrier else (a, None) for a, b, barrier, _, _ in mine}
    trouble = check_places(c, fids, run, listed)
    trouble += ["house %d of class 0 is hidden" % fids[k] for k in hidden if c.rank(k) == 0]
    if c.doubt:
        return trouble
    trouble += check_clauses(c, fids, lines)
    most, least, cost, bound = c.best_at(0.0), c.best_at(HAIR), c.cost(hidden), run.clauses.bound_of(fids)
    if most is None or mine:
        return trouble + ["needless conflict %s" % (row,) for row in mine if most is not None]
    counts["worlds"] += 1
    counts["exact"] += bound == {k: v for k, v in c.by_class(cost).items() if v}
    if cost < least:
        trouble.append("the oracle is wrong: hidden %s, best %s" % (cost, least))
    if Clauses.is_above(bound, c.by_class(most)):
        trouble.append("the bound is %s, and the best choice costs %s" % (bound, most))
    return trouble


def lost(c, fids, share):
    """The weighted shares of area that the result loses."""
    return sum(c.weight(k) / 1000 * share[fid] for k, fid in enumerate(fids))


def check_lost(corridors, fids_of, run, bound, counts):
    """Sentences about what is cut back. In a corridor that is in doubt what is lost stands for the least that has to be."""
    trouble, total = [], 0.0
    data = sqlite3.connect("out.gpkg")
    share = {f: cut or 0.0 for f, cut in data.execute("SELECT fid, sunder_cut FROM houses")}
    data.close()
    for t, c in enumerate(corridors):
        fids, now = fids_of[t], lost(c, fids_of[t], share)
        hidden = [k for k, fid in enumerate(fids) if run.state[fid] == "hidden"]
        least = None if c.doubt else c.least_lost(hidden)
        if least is not None and now < least - HAIR * len(fids) * HIGH:
            trouble.append("corridor %d: the oracle is wrong: lost %g, least %g" % (t, now, least))
        counts["least"] += least is not None and now > 0 and abs(now - least) < 1e-3 * now
        counts["cut"] += least is not None and now > 0
        total += now if least is None else least
    if bound > total * (1 + 1e-6) + 1e-3:
        trouble.append("%g must be lost, and %g is enough" % (bound, total))
    return trouble


def check_layer(program, seed, counts):
    rng = random.Random(seed)
    how = TownManner(rng)
    corridors = [Town(rng, t, how) for t in range(CORRIDORS)]
    where = write_layers(corridors)
    run = Run(program, how.words, proof="proof.jsonl")
    lines = [line for line in map(json.loads, open("proof.jsonl")) if "clause" in line]
    trouble = list(run.refused)
    fids_of = [[f for f, (at, _) in where.items() if at == t] for t in range(CORRIDORS)]
    for name in ("cut", "least"):
        counts.setdefault(name, 0)
    for t, c in enumerate(corridors):
        trouble += ["corridor %d: %s" % (t, line) for line in check_corridor(c, fids_of[t], run, lines, counts)]
    trouble += check_lost(corridors, fids_of, run, json.load(open("stats.json"))["shrunk"]["lower_bound"], counts)
    if not run.verified:
        trouble.append("not verified")
    count(counts, run.hidden_stats)
    return trouble, how.words


if __name__ == "__main__":
    sys.exit(main(check_layer))
