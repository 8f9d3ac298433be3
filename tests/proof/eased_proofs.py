"""Proofs with the prices of eased pairs: python3 eased_proofs.py SUNDER SEED PROOFS EFFORT.

Draws layers until the proofs of that number of them have cuts by prices, and lets check_proof.py check all of them: houses between roads
with weights and limits (tests/cli/ease_bounds.py), rows of houses beside roads (rows_proofs.py), both with a least gap, too, and small
worlds (small_worlds.py). Then it changes what a file says of prices, one thing at a time, and demands that this is refused. It compares
the bytes of the result with those of a run without --proof. EFFORT is the --effort of most runs; the files grow with it.
"""
import copy
import os
import random
import subprocess
import sys

import check_proof
import form
import rows_proofs
import small_worlds
from exact import ease_bounds
from rows_proofs import answer, trees_in

MOST_LAYERS = 3000
AGAIN = []  # seeds of which an earlier version wrote a proof that was not valid


# ---- Layers

def houses_and_roads(rng):
    worlds = [ease_bounds.World(rng) for _ in range(3)]
    ease_bounds.write_layers(worlds, rng.random() < 0.3)
    return "b.gpkg", ["--layer", "houses", "--rows", "no", "--gap", repr(ease_bounds.GAP), "--contained", "separate", "--max-shift-field", "most",
                      "--weight-field", "w", "--barrier", "b.gpkg,layer=roads,width-field=width" + rng.choice((",side=no", "")),
                      *rng.choice((["--allow-jumps"], [])), *rng.choice((["--no-blocks"], []))]


def rows_and_roads(rng):
    words = rows_proofs.written_layer(rng)
    return "l.gpkg", words


def small_world(rng):
    words = small_worlds.make(rng.randrange(10 ** 6), "small")
    for name in ("small", "small.road"):
        if os.path.exists(name + ".csv"):
            subprocess.run(["ogr2ogr", "-q", "-overwrite", name + ".gpkg", name + ".csv", "-nln", name.replace(".", "_"), "-oo",
                            "KEEP_GEOM_COLUMNS=NO", "-a_srs", "EPSG:25832"], check=True)
    return "small.gpkg", [w.replace("small.road.csv", "small.road.gpkg") for w in words] + ["--rows", "no"]


def with_a_least_gap(rng):
    """Houses and roads, or rows, whose pairs may stand between two gaps."""
    source, words = rng.choice((houses_and_roads, rows_and_roads, rows_and_roads))(rng)
    gap = float(words[words.index("--gap") + 1])
    return source, words + ["--least-gap", repr(gap * rng.choice((0, 0.25, 0.5, 0.9)))]


def drawn(rng, effort):
    source, words = rng.choice((houses_and_roads, with_a_least_gap, rows_and_roads, small_world))(rng)
    words += ["--ease", rng.choice(("30", "5", "200"))]
    return source, words if "--effort" in words else words + ["--effort", rng.choice((effort, effort, effort, "0.01", "0"))]


def run(sunder, source, out, words):
    command = [sunder, "separate", source, out, "--overwrite", "-q", "--no-styles", "--allow-conflicts", *words]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(command)}: status {done.returncode}: {done.stderr}")


def features_of(path):
    return subprocess.run(["ogr2ogr", "-q", "-f", "CSV", "/vsistdout/", path, "-lco", "GEOMETRY=AS_WKT"], capture_output=True, check=True).stdout


# ---- Untruths

def change(found, what):
    """Applies `what` to one of the things that `found` yields of each tree."""
    def mutate(lines, rng):
        every = [(tree, thing) for tree in trees_in(lines) if "eased" in tree for thing in found(tree)]
        for tree, thing in every and [rng.choice(every)]:
            what(tree, thing)
            return True
        return False
    return mutate


def itself(tree):
    yield tree


def cuts(tree):
    return [cut for node in tree["nodes"] for cut in node["cuts"] if cut["kind"] == "price"]


def priced(tree):
    return [piece for piece in tree["pieces"] if "priced" in piece and "A" in piece]


def joined(tree):
    return [piece for piece in tree["pieces"] if "joined" in piece]


def plain(tree):
    """Pairs of bodies that have no price in the tree, if cuts use that of the first pair that has one."""
    n, used = len(tree["bodies"]), any([cut["i"], cut["j"]] == tree["eased"][0] for cut in cuts(tree))
    return [[i, j] for i in range(n) for j in range(i + 1, n) if used and [i, j] not in tree["eased"]]


def at_no_price(tree, _):
    del tree["eased"]


def at_the_price_of_others(tree, pair):
    tree["eased"][0] = pair


def grow(tree, piece):
    x, y = piece["A"][0]
    piece["A"][0] = [x + 2 * (x - piece["A"][1][0]), y + 2 * (y - piece["A"][1][1])]


def spread(tree, piece):
    x, y = piece["joined"][0]
    piece["joined"] = [[x + 99 * (p[0] - x), y + 99 * (p[1] - y)] for p in piece["joined"]]


def raise_tree(tree, _):
    tree["bound"] = tree["bound"] * 1.001 + 1e-6


def unlisted(lines, rng):
    """Without the conflicts, nothing has a price."""
    kept = [line for line in lines if "conflict" not in line]
    if len(kept) == len(lines) or not any(line.get("eased") for line in lines):
        return False
    lines[:] = kept
    lines[0]["conflicts"] = 0
    return True


def in_head(key, what):
    def mutate(lines, rng):
        before = lines[0][key]
        lines[0][key] = what(before)
        return lines[0][key] != before
    return mutate


def listed(lines, rng):
    """A tight pair as a conflict, which may stand as near as at the start."""
    tight = [line for line in lines if line.get("kind") == "tight"]
    for line in tight and [rng.choice(tight)]:
        line.update(kind="too_close", reason="unresolved")
        return True
    return False


UNTRUE = {"no price": change(itself, at_no_price), "another price": change(plain, at_the_price_of_others),
          "price twice": change(itself, lambda tree, _: tree["eased"].append(tree["eased"][0])),
          "body's price": change(itself, lambda tree, _: tree["eased"].append([0, 0])),
          "lacks more": change(cuts, lambda _, cut: cut.update(d=cut["d"] + 1000)),
          "lower share": change(cuts, lambda _, cut: cut.update(share=cut["share"] * 2.0 ** -30)),
          "without pieces": change(cuts, lambda _, cut: cut.update(pieces=[])),
          "as a hull": change(cuts, lambda _, cut: (cut.update(kind="hull", d=cut["d"] + 1000), cut.pop("share"))),
          "greater piece": change(priced, grow), "joined farther": change(joined, spread),
          "joined of itself": change(joined, lambda tree, piece: piece.update(pieces=[tree["pieces"].index(piece)])),
          "forbidden": change(priced, lambda _, piece: (piece.pop("priced"), piece.update(clearance=1e6))),
          "raised": change(itself, raise_tree), "unlisted": unlisted, "listed": listed, "another rate": in_head("ease", lambda v: v * 2),
          "more in sum": in_head("lower_bound", lambda v: v * (1 + 1e-5))}


def main(sunder, seed, proofs, effort):
    wrong, asked, layers, files, of_cuts, refused = [], {}, 0, 0, 0, 0
    while layers < MOST_LAYERS and (files < proofs + len(AGAIN) or set(UNTRUE) - set(asked)):
        at = AGAIN[layers] if layers < len(AGAIN) else seed + layers - len(AGAIN)
        rng, layers = random.Random(at), layers + 1
        source, words = drawn(rng, effort)
        run(sunder, source, "o.gpkg", words + ["--proof", "p.jsonl"])
        run(sunder, source, "without.gpkg", words)
        checker = check_proof.Checker(check_proof.read_options(["p.jsonl", source, "--result", "o.gpkg", *words]))
        lines, at = form.read("p.jsonl"), f"seed {at}, {source} {' '.join(words)}"
        if features_of("o.gpkg") != features_of("without.gpkg"):
            wrong.append(f"{at}: the result depends on whether a proof is written")
        status, said = answer(checker, lines)
        own = sum(len(cuts(tree)) for tree in trees_in(lines))
        of_cuts, files = of_cuts + own, files + (own > 0)
        if status:
            wrong.append(f"{at}: {said}")
            continue
        few = sum(len(tree["nodes"]) for tree in trees_in(lines)) <= rows_proofs.MOST_NODES
        for name, mutate in UNTRUE.items() if own and few else ():
            mutated = copy.deepcopy(lines)
            if not mutate(mutated, rng):
                continue
            asked[name] = asked.get(name, 0) + 1
            status, said = answer(checker, mutated)
            refused += status == 1
            if status != 1 or "not in the form" in said:
                wrong.append(f"{at}: {name}: {said}")
    for line in wrong[:20]:
        print(line)
    print(f"{layers} layers, {files} with {of_cuts} cuts by prices; {refused} of {sum(asked.values())} untruths refused: "
          + ", ".join(f"{n} {name}" for name, n in asked.items()))
    missing = set(UNTRUE) - set(asked)
    if missing:
        print("nothing to ask about:", *sorted(missing))
    return 1 if wrong or missing else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]))
