"""Proofs about layers with rows: python3 rows_proofs.py SUNDER SEED PROOFS.

Draws layers until the proofs of that number of them name rows, after those of AGAIN. Draws streets, terraces and greens with roads and
houses that never move, weights, limits and stiffnesses, and lets check_proof.py check the proofs of each with --rows auto or, for one in
three, --rows FIELD. Then it changes what a file says of rows, one thing at a time, and demands that this is refused.
"""
import copy
import json
import math
import os
import random
import subprocess
import sys

import check_proof
import form
from exact import rows_oracle as towns

AGAIN = [893]  # seeds of which an earlier version wrote a proof that was not valid
MOST_NODES = 300  # a file with more is checked, and not changed
HOW = [[], ["--row-stiffness", "10,1"], ["--row-stiffness", "1"], ["--no-blocks", "--contained", "separate"],
       ["--block-field", "block"]]


def even_street(rng, gap, n):
    """Houses of about one size, nearly in line; most of them are too near to the next."""
    houses, x, angle = [], 0.0, rng.choice((0, rng.uniform(-3, 3)))
    for _ in range(n):
        w, d, back = rng.uniform(7, 11), rng.uniform(8, 11), rng.uniform(-0.4, 0.4) * gap
        at = x * math.cos(angle) - back * math.sin(angle), x * math.sin(angle) + back * math.cos(angle)
        houses.append(towns.House([[towns.turned(towns.box(w, d), angle + rng.uniform(-0.05, 0.05), at)]]))
        x += w + gap * rng.uniform(0.1, 1.2) + 0.5
    return houses


def drawn(rng):
    """(the gap, houses, lines of roads, options)"""
    gap, lines, kind = rng.choice((1.0, 3.0, 5.0, 12.0)), [], rng.randrange(12)
    houses = (towns.terrace(rng, gap, rng.randrange(4, 8)) if kind == 0 else towns.ring(rng, gap, 22)[:rng.randrange(4, 9)] if kind == 1
              else towns.grid(rng, gap, 3, 2) if kind == 2 else towns.street(rng, gap, rng.randrange(4, 9), lines) if kind < 5
              else even_street(rng, gap, rng.randrange(3, 7)))
    for h in houses:
        h.block = rng.choice((None,) * 5 + (1, 2))
    if rng.random() < 0.4:  # one that pushes a neighbour out of the row
        x, y = rng.choice(houses).box[:2]
        houses.append(towns.House([[[(x + 3 + u, y - 4.5 + v) for u, v in towns.box(3, 5)]]], fixed=1))
    place = rng.choice(((0, 0), (600000, 5400000)))
    limit = rng.choice(([], [], ["--max-shift", "1.5"], ["--max-shift", "4"], ["--max-shift", "12"]))
    words = ["--gap", repr(gap), "--fixed-where", "fixed = 1", "--ignore-where", "ignored = 1", *limit, *rng.choice(HOW)]
    return [towns.moved(h, *place) for h in houses], [[towns.snap([p[c] + place[c] for c in (0, 1)]) for p in e] for e in lines], \
        words + rng.choice(([], ["--weight", "area"], ["--allow-jumps"]))


def written(name, features):
    towns.write_geojson(name + ".geojson", features)
    if os.path.exists(name + ".gpkg"):
        os.remove(name + ".gpkg")  # it may have another layer
    subprocess.run(["ogr2ogr", "-q", name + ".gpkg", name + ".geojson", "-nln", name], check=True)
    return name + ".gpkg"


def written_layer(rng, given=False):
    """Writes a layer that is drawn to l.gpkg; returns the options. given: rows are those of a field."""
    houses, lines, words = drawn(rng)
    streets = random.Random(len(houses))
    values = ("A", "A", "A", "B", None) if "--no-blocks" in words else ("A", "A", "A", None)  # members of a block have equal ones
    written("l", [{"type": "Feature", "id": k, "properties": {"fixed": h.fixed, "ignored": h.ignored, "block": h.block,
                                                              "street": streets.choice(values)},
                   "geometry": towns.as_written(h, (0, 0), towns.same, towns.AS_IS)} for k, h in enumerate(houses, 1)])
    words += ["--rows", "street" if given else "auto"]
    if lines:
        path = written("b", [{"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": e}} for e in lines])
        words += ["--barrier", f"{path},width={rng.choice((0, 3))},gap={rng.choice((0, 1))}"]
    return words


def proved(sunder, rng, given):
    """(the checker, the lines of the file, the options)"""
    words = written_layer(rng, given)
    command = [sunder, "separate", "l.gpkg", "o.gpkg", "--overwrite", "-q", "--allow-conflicts", "--proof", "p.jsonl", *words]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(command)}: status {done.returncode}: {done.stderr}")
    return check_proof.Checker(check_proof.read_options(["p.jsonl", "l.gpkg", "--result", "o.gpkg", *words])), form.read("p.jsonl"), words


# ---- Untruths about rows

def rows_in(lines):
    return [line for line in lines if "row" in line]


def trees_in(lines):
    return [line for line in lines if "nodes" in line]


def drop_row(lines, rng):
    rows = rows_in(lines)
    for line in rows and [rng.choice(rows)]:
        lines.remove(line)
        for k, other in enumerate(rows_in(lines)):
            other["row"] = k
        return True
    return False


def change_row(key, change):
    def mutate(lines, rng):
        for line in rows_in(lines) and [rng.choice(rows_in(lines))]:
            line[key] = change(line[key], rng)
            return True
        return False
    return mutate


def other_row(lines, rng):
    """Neighbours of a neighbour as neighbours."""
    rows = rows_in(lines)
    for one in rows:
        for two in rows:
            if one["b"] == two["a"] and one is not two and not any((r["a"], r["b"]) == (one["a"], two["b"]) for r in rows):
                one["b"], one["apart"] = two["b"], one["apart"] + two["apart"]
                return True
    return False


def change_spring(change):
    def mutate(lines, rng):
        springs = [s for tree in trees_in(lines) for s in tree.get("springs", [])]
        for spring in springs and [rng.choice(springs)]:
            change(spring)
            return True
        return False
    return mutate


def stiffer(spring):
    spring["stiff"] *= 1 + 1e-9


def flip(spring):
    """The other sign of a spring, in place of this one: then it is there twice."""
    spring["i"], spring["j"] = spring["j"], spring["i"]


def turn(spring):
    spring["n"] = [spring["n"][0] * 0.8 - spring["n"][1] * 0.6, spring["n"][0] * 0.6 + spring["n"][1] * 0.8]


def double_spring(lines, _):
    """A spring that is there twice, and whose forces are shared between the two: each then costs less."""
    for tree in trees_in(lines):
        acting = {c for node in tree["nodes"] for c, f in node["forces"] if f > 1e-9 and c < len(tree.get("springs", []))}
        for c in sorted(acting):
            n = len(tree["springs"])
            tree["springs"].append(copy.deepcopy(tree["springs"][c]))
            for node in tree["nodes"]:
                for key in ("forces", "by"):
                    if key in node:
                        node[key] = [[k + (k >= n), f / 2 if k == c else f] for k, f in node[key]]
                        node[key] += [[n, f] for k, f in node[key] if k == c]
            return True
    return False


def raise_tree(lines, _):
    """The bound of a tree in which a spring or a rule of rows acts."""
    for tree in trees_in(lines):
        if tree.get("springs") and tree["bound"] > 0:
            tree["bound"] *= 1.001
            lines[0]["lower_bound"] *= 1.0001
            return True
    return False


def loosen_row(lines, _):
    """A rule for a pair that is given up, as if it were still to be resolved."""
    for tree in trees_in(lines):
        named = {k for node in tree["nodes"] for cut in node["cuts"] for k in cut.get("pieces", ())}
        for k, piece in enumerate(tree["pieces"]):
            if piece.get("row") and k in named:
                at = max(i for i, line in enumerate(lines) if "sunder_proof" in line or "block" in line or "row" in line or "conflict" in line)
                lines.insert(at + 1, {"conflict": lines[0]["conflicts"], "a": piece["a"], "b": piece["b"], "kind": "too_close",
                                      "reason": "unresolved", "blocked_by": []})
                lines[0]["conflicts"] += 1
                return True
    return False


UNTRUE = {"dropped": drop_row, "elsewhere": other_row,
          "turned": change_row("along", lambda v, _: [v[0] - v[1] * 1e-9, v[1] + v[0] * 1e-9]),
          "longer": change_row("along", lambda v, _: [v[0] * 1.0000001, v[1] * 1.0000001]),
          "backwards": change_row("along", lambda v, _: [-v[0], -v[1]]), "across": change_row("along", lambda v, _: [-v[1], v[0]]),
          "nearer": change_row("apart", lambda v, _: v - 1e-6), "farther": change_row("apart", lambda v, _: v + 1e-6),
          "stiffer": change_spring(stiffer), "turned spring": change_spring(turn), "flipped spring": change_spring(flip), "spring twice": double_spring,
          "spring of one": change_spring(lambda s: s.update(j=s["i"])), "raised": raise_tree, "loosened": loosen_row}


def answer(checker, lines):
    return check_proof.answer(checker, lambda: json.loads(json.dumps(lines)))


def drops_certain(checker, lines, dropped):
    """Are neighbours in a row missing whose decisions are all clear? Others need not be named. Those of a field are all clear."""
    if checker.problem.options.rows_field:
        return True
    pairs = [{(line["a"], line["b"]) for line in rows_in(told)} for told in (lines, dropped)]
    return any((c.near.f, c.near.g) in pairs[0] - pairs[1] for c in checker.problem.rows.certain)


def main(sunder, seed, proofs):
    wrong, asked, layers, with_rows, trees, refused = [], {}, 0, 0, 0, 0
    while with_rows < proofs + len(AGAIN):
        at = AGAIN[layers] if layers < len(AGAIN) else seed + layers - len(AGAIN)
        rng = random.Random(at)
        checker, lines, words = proved(sunder, rng, at % 3 == 1)
        status, said = answer(checker, lines)
        at, layers, with_rows = f"seed {at}, {' '.join(words)}", layers + 1, with_rows + bool(rows_in(lines))
        if status:
            wrong.append(f"{at}: {said}")
            continue
        trees += sum(1 for t in trees_in(lines) if "springs" in t or any(p.get("row") for p in t["pieces"]))
        for name, mutate in UNTRUE.items() if sum(len(t["nodes"]) for t in trees_in(lines)) <= MOST_NODES else ():
            mutated = copy.deepcopy(lines)
            if not mutate(mutated, rng) or (len(mutated) < len(lines) and not drops_certain(checker, lines, mutated)):
                continue
            asked[name] = asked.get(name, 0) + 1
            status, said = answer(checker, mutated)
            refused += status == 1
            if status != 1 or "not in the form" in said:
                wrong.append(f"{at}: {name}: {said}")
    for line in wrong[:20]:
        print(line)
    print(f"{layers} layers, {with_rows} with rows, {trees} trees about rows; {refused} of {sum(asked.values())} untruths refused: "
          + ", ".join(f"{n} {name}" for name, n in asked.items()))
    missing = set(UNTRUE) - set(asked)
    if missing:
        print("nothing to ask about:", *sorted(missing))
    return 1 if wrong or missing or not trees else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3])))
