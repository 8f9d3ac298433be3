"""The output of `separate`, compared with the proof: the same conflicts, moves that begin at the anchors and keep
limits and blocks, and their cost."""
from fractions import Fraction

from form import demand, shown
from sources import Source


class Result:
    def __init__(self, problem, path):
        self.problem = problem
        layer = Source(path, problem.name).layer()
        self.main, self.arcs = layer.features, layer.arcs
        self.lines = Source(path, problem.name + "_displacement").layer().features.values()
        self.listed = Source(path, problem.name + "_conflicts").layer().features.values()
        self.moves = {fid: tuple(row[c] or 0.0 for c in ("sunder_dx", "sunder_dy")) for fid, (row, _, _) in self.main.items()}

    def check(self, conflicts, total):
        """The cost of the result, in words."""
        there = {fid for fid in self.problem.place if not self.problem.is_hidden(fid)}
        demand(there <= set(self.moves), "the result has other features")
        left_out = {fid for fid, (row, _, _) in self.main.items() if row.get("sunder_inv")}
        demand(not left_out & there and all(fid in left_out or fid in there or fid not in self.main for fid in self.problem.place),
               "the result hides other features")
        compared = 0 if self.problem.options.points else self.check_anchors()
        self.check_moves()
        self.check_conflicts(conflicts)
        cost = sum(Fraction(self.problem.weight(fid)) * self.square(fid) for fid in self.moved())
        cost += self.problem.rows.cost(self.moves.get) if self.problem.rows else 0
        cost += self.problem.eased.cost(self.moves.get)
        demand(total <= cost, "a bound of", shown(total), "is more than what the result costs:", shown(cost))
        return f"the result costs {float(cost):.9g}; {compared} anchors are those of the result"

    def moved(self):
        return [fid for fid, move in self.moves.items() if move != (0.0, 0.0) and fid in self.problem.place]

    def square(self, fid):
        return sum(Fraction(v) ** 2 for v in self.moves[fid])

    def check_anchors(self):
        """The anchors of moved features are the first points of their lines, and the lines are as long as the
        moves."""
        compared, lines_of = 0, {}
        for row, _, lines in self.lines:
            lines_of[row["fid"]] = lines
            demand((row["dx"], row["dy"]) == self.moves.get(row["fid"]), "two moves of", row["fid"])
        for fid in self.moved():
            demand(lines_of.get(fid), "no line shows the move of", fid)
            compared += fid in self.problem.anchors
            demand(self.problem.anchors.get(fid) in (None, lines_of[fid][0][0]), "the anchor of", fid, "is another in the result")
        return compared

    def check_moves(self):
        problem = self.problem
        for fid in {*problem.smaller, *problem.larger}:
            if not problem.is_hidden(fid):
                self.check_place(fid)
        for fid in self.moved():
            limit = problem.limit(fid)
            demand(limit is None or self.square(fid) <= Fraction(limit) ** 2, "the result moves", fid, "beyond its limit")
            self.check_place(fid)
        for fid, members in problem.blocks.of.items():
            members = self.problem.block(fid)
            demand(fid not in members or self.moves[fid] == self.moves[members[0]], "the result moves", fid, "and not the block of", *members[:1])

    def check_place(self, fid):
        """Demands that every corner is the double nearest to the sum of the original corner and the move. Repaired
        features are not checked; of features with curves the points of arcs are."""
        (dx, dy) = self.moves[fid]
        if self.problem.options.points:
            now = sorted(line[0] for line in self.main[fid][2])
            demand(now == sorted((x + dx, y + dy) for x, y in self.problem.points[fid]), "the result has", fid, "elsewhere")
            return
        if fid in self.problem.arcs and fid not in self.problem.larger and fid not in self.problem.level:
            arcs = [[(x + dx, y + dy) for x, y in arc] for arc in self.problem.arcs[fid]]
            demand(arcs == self.arcs.get(fid), "the result has an arc of", fid, "elsewhere")
            return
        given, now = self.problem.given[fid], self.main[fid][1]
        if fid in self.problem.level or fid in self.problem.larger:
            given = self.problem.taken[fid] if fid in self.problem.level else self.problem.larger[fid]
            moved = [[[(x + dx, y + dy) for x, y in ring] for ring in polygon] for polygon in given]
            demand(in_order(moved) == in_order(now), "the result has", fid, "elsewhere, or with another shape")
            return
        if self.problem.is_repaired(fid):
            return
        moved = [[[(x + dx, y + dy) for x, y in ring] for ring in polygon] for polygon in given]
        demand(moved == now, "the result has", fid, "elsewhere, or with another shape")

    def check_conflicts(self, conflicts):
        """The result lists the same pairs, of the same kinds, for the same reasons."""
        def key(a, b, *more):
            return (*sorted((str(a), str(b))), *more)
        listed = []
        for row, _, _ in self.listed:
            other = row["fid_b"] if row["barrier"] is None else f"{row['barrier']}:{row['barr_fid']}"
            listed.append(key(row["fid_a"], other, row["kind"], row["reason"] or "", row["blocked_by"] or ""))
        told = [key(c["a"], c["b"], c["kind"], c["reason"], ",".join(map(str, c["blocked_by"]))) for c in conflicts]
        demand(sorted(listed) == sorted(told), "the result lists other conflicts")


def in_order(polygons):
    """The polygons with each ring from its least corner on, in the direction of the lesser neighbour."""
    def turned(ring):
        k = ring.index(min(ring))
        return min(ring[k:] + ring[:k], [ring[k]] + ring[:k][::-1] + ring[k + 1:][::-1])
    return sorted(sorted(turned(list(map(tuple, ring))) for ring in polygon) for polygon in polygons)
