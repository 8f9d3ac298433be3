"""Proofs with gaps by classes: python3 class_proofs.py SUNDER SEED LAYERS EFFORT.

Draws small worlds, rows and piles with classes, and sheets with random gaps: none between two classes, wide ones, least gaps in one
class only, classes that no rule names, barriers with classes. check_proof.py reads the sheet by itself and checks each file. Then it
changes what a file says of classes, one thing at a time, and demands that this is refused. It also compares the bytes of the result with
those of a run without --proof.
"""
import copy
import json
import random
import subprocess
import sys

import check_proof
import form
import small_worlds
from eased_proofs import features_of
from rows_proofs import answer

MOST_LAYERS = 400
KINDS = ("house", "shed", "church", "hut", "other", "")  # no rule names the last two
ROADS = ("main", "lane", "")


# ---- Layers

def scattered(rng):
    wide = rng.choice((6, 10, 14))
    return [f"POLYGON(({small_worlds.corners_of(rng, rng.uniform(0, wide), rng.uniform(0, wide), 3, 8)}))" for _ in range(rng.randint(2, 6))]


def box(x, y, w, h):
    return f"POLYGON(({x} {y},{x + w} {y},{x + w} {y + h},{x} {y + h}))"


def row(rng):
    found, x = [], 0.0
    for _ in range(rng.randint(4, 6)):
        w = rng.choice((8, 9, 10))
        found.append(box(x, rng.choice((0, 0.25, 0.5)), w, rng.choice((9, 10))))
        x += w + rng.choice((0.25, 0.5, 1.5))
    return found


def pile(rng):
    return [box(rng.randrange(8) / 8, rng.randrange(8) / 8, 6, 6) for _ in range(6)]


def write(name, rows, fields):
    with open(name + ".csv", "w", encoding="utf-8") as file:
        file.write("WKT," + ",".join(fields) + "\n" + "".join(",".join((f'"{wkt}"', *map(str, values))) + "\n" for wkt, *values in rows))
    subprocess.run(["ogr2ogr", "-q", "-overwrite", name + ".gpkg", name + ".csv", "-nln", name, "-oo", "KEEP_GEOM_COLUMNS=NO", "-oo",
                    "EMPTY_STRING_AS_NULL=YES", "-a_srs", "EPSG:25832"], check=True)


def gaps_of(rng, far, wide):
    """Rules; a later one replaces what it is about. `wide`: gaps to choose from."""
    def name():
        return rng.choice(("*", "house", "shed", "church", "hut", "main", "lane", "post"))
    found = [{"between": ["*", "*"], "gap": rng.choice((far, *wide))}]
    found += [{"between": [name(), name()], "gap": rng.choice((0, 0.3, far, *wide))} for _ in range(rng.randint(1, 5))]
    if rng.random() < 0.5:
        found.append({"between": [rng.choice(("house", "shed")), name()], "gap": 2 * far, "least": rng.choice((0, 0.25, far))})
    return found


def houses_of(rng, make):
    """The layer that moves."""
    found = {"name": "houses", "source": "houses.gpkg", "layer": "houses", "role": "move", "rows": "auto" if make is row else "no",
             "class": rng.choice(({"field": "kind"}, {"field": "kind"}, "house")), "no_blocks": make is pile or rng.random() < 0.7, "weight_field": "w"}
    return {**found, **({"contained": "separate"} if make is pile else {"max_shift": rng.choice((1, 2, 4, 8))}), "hide": make is scattered and rng.random() < 0.2}


def drawn(rng):
    """Writes houses.gpkg, roads.gpkg and sheet.json."""
    make = rng.choice((scattered, scattered, row, row, pile))
    kinds = KINDS[:rng.randint(1, len(KINDS))]
    write("houses", [(wkt, rng.choice(kinds), rng.choice((1, 1, 2))) for wkt in make(rng)], ("kind", "w"))
    write("roads", [(small_worlds.barrier_of(rng, 14) if make is scattered else f"LINESTRING(-30 {-1 - 3 * k},80 {-1 - 3 * k})", rng.choice(ROADS))
                    for k in range(rng.randint(1, 2))], ("class",))
    layers = [houses_of(rng, make)]
    if make is not pile and rng.random() < 0.8:
        width = rng.choice((0, 1, {"by": "class", "of": {"main": 2, "lane": "0.5m"}, "else": 0.25}))
        layers.append({"name": "roads", "source": "roads.gpkg", "role": rng.choice(("barrier", "fixed")), "width": width,
                       "class": rng.choice(({"field": "class"}, "post", "lane"))})
    far = rng.choice((1, 3))
    gaps = gaps_of(rng, far, {scattered: (0.5, 2 * far, 10), row: (0.5, far), pile: (0.5, 1, 2)}[make])
    with open("sheet.json", "w", encoding="utf-8") as file:
        file.write("// Made for a test.\n")
        json.dump({"defaults": {"ease": "no" if make is pile else rng.choice(("no", 30))}, "layers": layers, "gaps": gaps}, file)


def run(sunder, out, words):
    command = [sunder, "separate", "--spec", "sheet.json", out, "--overwrite", "-q", "--no-styles", "--allow-conflicts", *words]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode == 2 and any(words in done.stderr for words in ("the least gap, ", "no layer has the class", "need a price")):
        return False  # the drawn sheet contradicts itself
    if done.returncode:
        raise SystemExit(f"{' '.join(command)}: status {done.returncode}: {done.stderr}")
    return True


# ---- Untruths. Each returns False if there is nothing of its kind

def bodies_in(lines, key):
    return [b for line in lines if "group" in line for b in line["bodies"] if key in b]


def another_class(lines, rng):
    """Of a feature."""
    told = [f for b in bodies_in(lines, "features") for f in b["features"] if len(lines[0]["classes"]) > 0]
    for f in told and [rng.choice(told)]:
        f["class"] = (f["class"] + 1) % (len(lines[0]["classes"]) + 1)
    return bool(told)


def another_class_of_a_barrier(lines, rng):
    told = bodies_in(lines, "barrier")
    for b in told and [rng.choice(told)]:
        b["class"] = (b["class"] + 1) % (len(lines[0]["classes"]) + 1)
    return bool(told)


def unknown_class(lines, rng):
    told = [f for b in bodies_in(lines, "features") for f in b["features"]]
    for f in told and [rng.choice(told)]:
        f["class"] = len(lines[0]["classes"]) + 1
    return bool(told)


def no_class(lines, rng):
    told = [f for b in bodies_in(lines, "features") for f in b["features"]]
    for f in told and [rng.choice(told)]:
        del f["class"]
    return bool(told)


def in_table(key, what):
    def mutate(lines, rng):
        table = lines[0].get(key)
        places = [(i, j) for i, line in enumerate(table or ()) for j in range(len(line)) if what(line[j]) != line[j]]
        for i, j in places and [rng.choice(places)]:
            table[i][j] = what(table[i][j])
        return bool(places)
    return mutate


def asymmetric(lines, rng):
    """A whole table, with another gap in one of the two places of a pair."""
    half = lines[0]["gaps"]
    n = len(half)
    whole = [[half[max(i, j)][min(i, j)] for j in range(n)] for i in range(n)]
    whole[0][n - 1] += 1
    lines[0]["gaps"] = whole
    return n > 1


def without(*keys):
    def mutate(lines, rng):
        return any([lines[0].pop(key, None) is not None for key in keys])
    return mutate


def more_than_owed(lines, rng):
    """A piece with the greatest gap of all, which other classes keep."""
    most = max(map(max, lines[0].get("least_gaps", lines[0]["gaps"])))
    told = [p for line in lines for p in line.get("pieces", ()) if "A" in p and not p.get("shadow") and not p.get("priced") and "clearance" not in p and
            isinstance(p["a"], int) and isinstance(p["b"], int)]
    for p in told and [rng.choice(told)]:
        p["clearance"] = most + 1
    return bool(told)


UNTRUE = {"class": another_class, "class of a barrier": another_class_of_a_barrier, "unknown class": unknown_class, "no class": no_class,
          "lower gap": in_table("gaps", lambda v: v / 2), "higher gap": in_table("gaps", lambda v: v + 1), "no gap": in_table("gaps", lambda _: 0),
          "lower least gap": in_table("least_gaps", lambda v: v / 2), "higher least gap": in_table("least_gaps", lambda v: v + 1),
          "asymmetric": asymmetric, "no tables": without("classes", "gaps", "least_gaps"), "no least gaps": without("least_gaps"),
          "more than owed": more_than_owed, "names": lambda lines, _: lines[0]["classes"].reverse() or len(lines[0]["classes"]) > 1,
          "a row of the table less": lambda lines, _: lines[0]["gaps"].pop() or True}


def main(sunder, seed, layers, effort):
    wrong, asked, made, bounds, of_area, refused, at = [], {}, 0, 0, 0, 0, seed
    while made < layers or ((set(UNTRUE) - set(asked) or not of_area) and at < seed + MOST_LAYERS):
        rng, at = random.Random(at), at + 1
        drawn(rng)
        words = ["--effort", effort]
        if not run(sunder, "o.gpkg", words + ["--proof", "p.jsonl"]):
            continue
        run(sunder, "without.gpkg", words)
        made += 1
        where = f"seed {at - 1}"
        if features_of("o.gpkg") != features_of("without.gpkg"):
            wrong.append(f"{where}: the result depends on whether a proof is written")
        checker = check_proof.Checker(check_proof.read_options(["p.jsonl", "houses.gpkg", "--spec", "sheet.json", "--result", "o.gpkg", *words]))
        lines = form.read("p.jsonl")
        status, said = answer(checker, lines)
        if status:
            wrong.append(f"{where}: {said}")
            continue
        bounds += lines[0]["lower_bound"] > 0
        of_area += any("prices" in tree for tree in lines)
        if "classes" not in lines[0]:
            continue
        for name, mutate in UNTRUE.items():
            mutated = copy.deepcopy(lines)
            if not mutate(mutated, rng):
                continue
            asked[name] = asked.get(name, 0) + 1
            status, said = answer(checker, mutated)
            refused += status == 1
            if status != 1 or "not in the form" in said:
                wrong.append(f"{where}: {name}: {said}")
    for line in wrong[:20]:
        print(line)
    print(f"{made} layers, {bounds} with a bound, {of_area} by prices of area; {refused} of {sum(asked.values())} untruths refused: "
          + ", ".join(f"{n} {name}" for name, n in asked.items()))
    missing = set(UNTRUE) - set(asked)
    if missing:
        print("nothing to ask about:", *sorted(missing))
    return 1 if wrong or missing or not (bounds and of_area) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]))
