"""Streets of houses with bays (SUNDER_SEED), with rows and easing and without: a house that moved by less than HARDLY has a reason to. If it
stood at home, and all others where they are, a pair would be in conflict that is not, or a rule would be broken."""
import json
import os
import random
import subprocess
import sys

HARDLY = 1e-9
STREETS = 120
CSV = ["--oo", "GEOM_POSSIBLE_NAMES=WKT"]


def house(r, x, y, w, h):
    """A rectangle, perhaps with a bay on its right, or on its left, or both."""
    left, right = r.random() < 0.5, r.random() < 0.5
    points = [(0, 2), (-2, 2), (-2, 0)] if left else [(0, 0)]
    points += [(w, 0)] + ([(w, h - 2), (w + 2, h - 2), (w + 2, h)] if right else [(w, h)]) + [(0, h)]
    return [(x + a, y + b) for a, b in points]


def streets(r):
    """{FID: ring}, and the street of each."""
    layer, street = {}, {}
    for k in range(STREETS):
        x, y = r.choice([0, 0.1, 1000.3]), 100.0 * k
        for _ in range(r.randint(2, 5)):
            w, h = r.choice([8, 10, 12, r.uniform(6, 12)]), r.choice([10, 10, 10, r.uniform(9, 12)])
            x += r.choice([3, 4, 5, 6, 7, r.uniform(2, 8)])
            street[len(layer) + 1] = k
            layer[len(layer) + 1] = house(r, x, y + r.choice([0, 0, r.uniform(-1, 1)]), w, h)
            x += w
    return layer, street


def run(*words):
    done = subprocess.run([os.environ["SUNDER"], *words], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 3):
        sys.exit(f"{words}: status {done.returncode}: {done.stderr}")
    return done.stdout


def write(path, layer, moves=None):
    """Writes the layer, moved, as CSV, where its FIDs count the lines."""
    with open(path, "w", encoding="ascii") as f:
        print("id,WKT", file=f)
        for fid, ring in layer.items():
            dx, dy = moves[fid] if moves else (0.0, 0.0)
            print(f'{fid},"POLYGON(({",".join(f"{x + dx!r} {y + dy!r}" for x, y in ring + ring[:1])}))"', file=f)


def listed(layer, moves, rules):
    """All that `check --before` lists."""
    write("moved.csv", layer, moves)
    rows = [line.split("\t") for line in run("check", "moved.csv", "--before", "in.csv", *CSV, *rules).splitlines()]
    return {(row[0], row[2], row[6]) for row in rows if len(row) > 6}


def ask(layer, rules, ease):
    """The moves by FID, and the FIDs of houses that hardly moved."""
    write("in.csv", layer)
    run("separate", "in.csv", "out.geojson", "--overwrite", "--quiet", "--layers", "main", *CSV, *rules, "--ease", ease)
    with open("out.geojson", encoding="utf-8") as f:
        told = [feature["properties"] for feature in json.load(f)["features"]]
    moves = {int(p["id"]): (p["sunder_dx"] or 0.0, p["sunder_dy"] or 0.0) for p in told}
    return moves, [f for f, (dx, dy) in sorted(moves.items()) if 0 < max(abs(dx), abs(dy)) < HARDLY]


def main():
    seed, wrong, total = int(os.environ.get("SUNDER_SEED", "1")), [], 0
    layer, street = streets(random.Random(seed))
    for limit, rows, ease in (("1", "auto", "30"), ("2", "no", "no")):
        rules = ["--gap", "5", "--max-shift", limit, "--no-blocks", "--rows", rows]
        moves, asked = ask(layer, rules, ease)
        before = listed(layer, moves, rules)
        total += len(asked)
        while asked: # one house of each street at once
            some = list({street[f]: f for f in asked}.values())
            asked = [f for f in asked if f not in some]
            found = listed(layer, {**moves, **{f: (0.0, 0.0) for f in some}}, rules) - before
            named = {street[int(f)] for row in found for f in row[:2] if f}
            wrong += [f"--rows {rows} --ease {ease}: {f} moved by {moves[f]}" for f in some if street[f] not in named]
    print(*wrong, f"{total} that hardly moved, {len(wrong)} for nothing", sep="\n")
    return len(wrong) > 0


if __name__ == "__main__":
    sys.exit(main())
