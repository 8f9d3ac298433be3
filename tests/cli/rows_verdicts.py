"""Verdicts about neighbours in rows beside brute force: python3 rows_verdicts.py SUNDER SEED WORLDS.

Draws rows of houses with bays, some of which never move, and short limits, and runs `separate --rows auto`. For a pair with the reason
`row` all relative moves within the limits are tried on a fine grid, with the points of the rule's line: none may keep the gap and the
rule, and one has to keep the gap. For `no_room` with `by_row` moves of all houses of the proof are drawn: none may keep what is claimed
to be impossible. For need_shift, need_gap and need_gone the run is repeated with that limit or gap or without that house: the rule is
then found to be kept by `check --before`. The rule is computed here from the houses themselves."""
import json
import math
import random
import sqlite3
import subprocess
import sys

from rows_oracle import snap, write_geojson

HAIR = 1e-7


def outline(w, d, left, right):
    """The corners of a house with a bay of depth `left` at the lower end of its left side, and one at the upper end of its right side."""
    corners = [(-left, 0), (w, 0)] + ([(w, 0.75 * d), (w + right, 0.75 * d), (w + right, d)] if right else [(w, d)]) + [(0, d)]
    return corners + ([(0, d / 4), (-left, d / 4)] if left else [])


def world(rng):
    """(the gap, the houses as lists of corners, whether each is fixed, the limit). Bays that do not face each other make two houses
    stand nearer along the row than they are."""
    gap, angle, n = rng.choice((3.0, 5.0)), rng.choice((0, 0, rng.uniform(-3, 3))), rng.randrange(3, 5)
    bays = [0] + [rng.choice((0, rng.uniform(0.2, 0.6))) * gap for _ in range(n - 1)] + [0]
    houses, x, lacks = [], 0.0, []
    for k in range(n):
        w, d, y = rng.uniform(8, 11), rng.choice((10, rng.uniform(9, 11))), rng.choice((0, rng.uniform(-0.3, 0.3) * gap))
        corners = [(px + x, py + y) for px, py in outline(w, d, bays[k], bays[k + 1])]
        houses.append([snap((math.cos(angle) * px - math.sin(angle) * py, math.sin(angle) * px + math.cos(angle) * py))
                       for px, py in corners])
        apart = gap * rng.uniform(0.1, 1.1)
        if bays[k + 1] and gap - apart > 0.1:  # between these the pair has a solution, but none in its row
            lacks.append((max(0.05, gap - apart - bays[k + 1]), gap - apart))
        x += w + apart + 2 * bays[k + 1]
    fixed = [rng.random() < 0.3 for _ in houses]
    limit = rng.uniform(*rng.choice(lacks)) / rng.choice((1, 2)) if lacks and rng.random() < 0.6 else rng.choice((0.5, 6.0, 12.0))
    return gap, houses, fixed, limit


def run(sunder, gap, houses, fixed, limit, rows="auto"):
    """(conflicts, moves, edges of rows) of a run; the edges are those of the proof."""
    write_geojson("v.geojson", [{"type": "Feature", "id": k + 1, "properties": {"fixed": int(f)},
                                 "geometry": {"type": "Polygon", "coordinates": [[list(p) for p in h + h[:1]]]}}
                                for k, (h, f) in enumerate(zip(houses, fixed)) if h])
    words = [sunder, "separate", "v.geojson", "v.gpkg", "--overwrite", "-q", "--ease", "no", "--allow-conflicts", "--output-layer", "v", "--gap", repr(gap),
             "--max-shift", repr(limit), "--fixed-where", "fixed = 1", "--rows", rows, "--no-blocks", "--proof", "v.jsonl"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(words)}: status {done.returncode}: {done.stderr}")
    base = sqlite3.connect("v.gpkg")
    base.row_factory = sqlite3.Row
    conflicts = [dict(r) for r in base.execute("SELECT * FROM v_conflicts")]
    moves = {r["fid"]: (r["sunder_dx"] or 0.0, r["sunder_dy"] or 0.0) for r in base.execute("SELECT fid, sunder_dx, sunder_dy FROM v")}
    base.close()
    with open("v.jsonl", encoding="utf-8") as f:
        edges = {(t["a"], t["b"]): t for t in map(json.loads, f) if "row" in t}
    return conflicts, moves, edges


# ---- Distances

def off_segment(p, a, b):
    ux, uy = b[0] - a[0], b[1] - a[1]
    t = max(0.0, min(1.0, ((p[0] - a[0]) * ux + (p[1] - a[1]) * uy) / (ux * ux + uy * uy)))
    return math.hypot(a[0] + t * ux - p[0], a[1] + t * uy - p[1])


def inside(p, h):
    odd = False
    for k in range(len(h)):
        (ax, ay), (bx, by) = h[k - 1], h[k]
        if (ay > p[1]) != (by > p[1]) and p[0] < ax + (p[1] - ay) / (by - ay) * (bx - ax):
            odd = not odd
    return odd


def crosses(a, b, c, d):
    def turn(p, q, r):
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    return turn(a, b, c) * turn(a, b, d) < 0 and turn(c, d, a) * turn(c, d, b) < 0


def distance(g, h):
    """Of two houses; 0 if they overlap."""
    if any(inside(p, h) for p in g) or any(inside(p, g) for p in h):
        return 0.0
    if any(crosses(g[k - 1], g[k], h[m - 1], h[m]) for k in range(len(g)) for m in range(len(h))):
        return 0.0
    return min(min(off_segment(p, h[m - 1], h[m]) for p in g for m in range(len(h))),
               min(off_segment(p, g[m - 1], g[m]) for p in h for m in range(len(g))))


def moved(h, t):
    return [(x + t[0], y + t[1]) for x, y in h]


def least_along(edge, gap, houses, listed):
    """What the rule demands along the row; None: nothing. Computed from the corners."""
    ax, ay = edge["along"]
    f, g = houses[edge["a"] - 1], houses[edge["b"] - 1]
    apart = min(ax * x + ay * y for x, y in g) - max(ax * x + ay * y for x, y in f)
    if apart <= 0:
        return None
    return gap - apart if distance(f, g) < gap and not listed else min(0.0, gap - apart)


# ---- Verdicts

def relative_moves(rng, reach, along, least):
    n = 60
    for k in range(-n, n + 1):
        for m in range(-n, n + 1):
            if k * k + m * m <= n * n:
                yield reach * k / n, reach * m / n
    for _ in range(400):  # along the line of the rule
        side = rng.uniform(-reach, reach)
        yield least * along[0] - side * along[1], least * along[1] + side * along[0]
    for _ in range(400):
        turn = rng.uniform(0, 2 * math.pi)
        yield reach * math.cos(turn), reach * math.sin(turn)


def wrong_row(rng, gap, houses, fixed, limit, edge):
    """The pair of an edge has the reason `row`."""
    reach = limit * (2 - fixed[edge["a"] - 1] - fixed[edge["b"] - 1]) * (1 - 1e-12)
    least, along = least_along(edge, gap, houses, False), edge["along"]
    if least is None:
        return "a pair without a rule has the reason row"
    f, g, free = houses[edge["a"] - 1], houses[edge["b"] - 1], False
    for u in relative_moves(rng, reach, along, least):
        if math.hypot(*u) <= reach and distance(f, moved(g, u)) >= gap:
            free = True
            if along[0] * u[0] + along[1] * u[1] >= least + HAIR:
                return f"the pair of {edge['a']} and {edge['b']} is solved in its row by {u}"
    return None if free else f"the pair of {edge['a']} and {edge['b']} is beyond its limits, and has the reason row"


def keep_claim(gap, houses, edges, listed, asked, at):
    """Do these places of some houses keep all that no_room is about? asked: the pair that is to be solved."""
    for a in at:
        for b in at:
            if a < b and not (at[a] == at[b] == (0.0, 0.0)):
                now, before = distance(moved(houses[a - 1], at[a]), moved(houses[b - 1], at[b])), distance(houses[a - 1], houses[b - 1])
                spared = (a, b) in listed and (a, b) != asked
                if now < (min(before, gap) if spared else gap) - HAIR:
                    return False
                if (a, b) in edges:
                    least = least_along(edges[a, b], gap, houses, spared)
                    u = at[b][0] - at[a][0], at[b][1] - at[a][1]
                    if least is not None and edges[a, b]["along"][0] * u[0] + edges[a, b]["along"][1] * u[1] < least - HAIR:
                        return False
            elif a < b and (a, b) == asked and distance(houses[a - 1], houses[b - 1]) < gap:
                return False
    return True


def wrong_no_room(rng, gap, houses, fixed, limit, edges, conflicts, c):
    listed = {(d["fid_a"], d["fid_b"]) for d in conflicts}
    asked = (c["fid_a"], c["fid_b"])
    about = sorted({*asked, *(int(w) for w in (c["blocked_by"] or "").split(",") if w)})
    for _ in range(4000):
        at = {}
        for fid in about:
            turn, r = rng.uniform(0, 2 * math.pi), limit * math.sqrt(rng.random()) * (not fixed[fid - 1])
            at[fid] = (r * math.cos(turn), r * math.sin(turn))
        if keep_claim(gap + 2 * HAIR, houses, edges, listed, asked, at) and at[asked[0]] != at[asked[1]]:
            return f"no_room of {asked}, which {at} solve"
    return None


def wrong_needs(sunder, gap, houses, fixed, limit, c):
    """What is said to help has to help: the whole layer is run again."""
    pair = (c["fid_a"], c["fid_b"])
    changes = []
    if c["need_shift"] is not None:
        changes.append(("need_shift", gap, houses, c["need_shift"]))
    if c["need_gap"] is not None:
        changes.append(("need_gap", c["need_gap"], houses, limit))
    if c["need_gone"] is not None:
        gone = int(c["need_gone"])
        changes.append(("need_gone", gap, [h if k + 1 != gone else None for k, h in enumerate(houses)], limit))
    for name, new_gap, new_houses, new_limit in changes:
        conflicts, _, _ = run(sunder, new_gap, new_houses, fixed, new_limit)
        if pair in {(d["fid_a"], d["fid_b"]) for d in conflicts} and len(conflicts) >= 1:
            reason = next(d["reason"] for d in conflicts if (d["fid_a"], d["fid_b"]) == pair)
            if reason in ("row", "max_shift", "side", "jump"):  # by itself the pair has no solution with it, which is proved
                yield f"{name} {c[name]} of {pair} does not help: {reason}"


def main():
    sunder, seed, worlds = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    trouble, tally = [], {"row": 0, "by_row": 0, "others": 0, "needs": 0}
    for k in range(worlds):
        rng = random.Random(seed + k)
        gap, houses, fixed, limit = world(rng)
        conflicts, _, edges = run(sunder, gap, houses, fixed, limit)
        found = []
        for c in conflicts:
            pair = (c["fid_a"], c["fid_b"])
            if c["reason"] == "row":
                tally["row"] += 1
                found.append(wrong_row(rng, gap, houses, fixed, limit, edges[pair]) if pair in edges else f"{pair} is in no row")
            elif c["reason"] == "no_room" and c["by_row"]:
                tally["by_row"] += 1
                found.append(wrong_no_room(rng, gap, houses, fixed, limit, edges, conflicts, c))
            else:
                tally["others"] += 1
                if c["by_row"]:
                    found.append(f"by_row with the reason {c['reason']}")
            tally["needs"] += sum(c[n] is not None for n in ("need_shift", "need_gap", "need_gone"))
            found += list(wrong_needs(sunder, gap, houses, fixed, limit, c))
        trouble += [f"seed {seed + k}: {t}" for t in found if t]
    print(f"{worlds} worlds: " + ", ".join(f"{n} {what}" for what, n in tally.items()))
    for t in trouble[:20]:
        print(t)
    if not (tally["row"] and tally["by_row"]) and worlds >= 100:
        trouble.append("too little to ask about")
        print(trouble[-1])
    sys.exit(1 if trouble else 0)


if __name__ == "__main__":
    main()
