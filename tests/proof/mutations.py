"""Does check_proof.py detect false claims? In a valid file of --proof each kind of claim is made slightly false, one
at a time:

    python3 mutations.py PROOF INPUT.gpkg [options as of check_proof.py] [--need KIND ...]

Each changed file has to be refused, with a message about the change. For each kind the smallest tree, or conflict,
with such a claim is checked by itself. Kinds that do not occur in the file are skipped, unless --need names them.
"""
import copy
import json
import math
import sys
from collections import Counter

import check_proof
import form
from hide_mutations import HIDES
from larger_mutations import LARGER
from price_mutations import PRICES

CUTS = {"hull": "not forbidden", "disc": "may be cheap", "cone": "do not cover", "limit": "what the limit leaves"}


def with_kind(tree, kind):
    return [c for n in tree["nodes"] for c in n["cuts"] if c["kind"] == kind]


def drop_node(tree, k):
    """Removes a leaf: later nodes and cuts are renumbered."""
    before = sum(len(n["cuts"]) for n in tree["nodes"][:k])
    gone = len(tree["nodes"][k]["cuts"])
    del tree["nodes"][k]
    for node in tree["nodes"]:
        if node["parent"] is not None and node["parent"] > k:
            node["parent"] -= 1
        for forces in (node["forces"], node.get("by", [])):
            for f in forces:
                f[0] -= gone if f[0] >= before + gone else 0


def children_of(tree):
    found = [[] for _ in tree["nodes"]]
    for k, node in enumerate(tree["nodes"]):
        if node["parent"] is not None:
            found[node["parent"]].append(k)
    return found


# ---- Changes of a tree. Each function returns False if the tree has nothing of its kind, otherwise the words of the
# refusal

def change_forces(tree):
    for node in tree["nodes"]:
        for f in node["forces"] + node.get("by", []):
            f[1] *= 1.01
    return any(n["forces"] for n in tree["nodes"]) and ("the tree proves", "may be cheap")


def pull(tree):
    for node in tree["nodes"]:
        if node["forces"]:
            node["forces"][0][1] *= -1
            return ("a force that pulls",)
    return False


def force_from_elsewhere(tree):
    """Uses a force on a cut of a sibling node."""
    first = [0]
    for node in tree["nodes"]:
        first.append(first[-1] + len(node["cuts"]))
    for sisters in children_of(tree):
        for k in sisters[-1:]:
            if len(sisters) == 3 and tree["nodes"][k]["forces"]:
                tree["nodes"][k]["forces"][0][0] = first[sisters[0]]
                return ("not on the way",)
    return False


def drop_child(tree):
    children = children_of(tree)
    for sisters in children:
        for k in sisters:
            if len(sisters) == 3 and not children[k]:
                drop_node(tree, k)
                return ("no child's first cut",)
    return False


def drop_forces_of_a_leaf(tree):
    children = children_of(tree)
    leaves = [n for k, n in enumerate(tree["nodes"]) if not children[k] and n["forces"] and "empty" not in n]
    for node in tree["nodes"]:
        node["forces"] = []
        node.pop("by", None)
    return bool(leaves) and ("the tree proves", "may be cheap")


def push_cut(kind):
    def mutate(tree):
        for cut in with_kind(tree, kind):
            cut["d"] += 0.3 if kind != "limit" else 0.01
        return bool(with_kind(tree, kind)) and (CUTS[kind],)
    return mutate


def unname(tree):
    for cut in with_kind(tree, "hull"):
        cut["pieces"] = []
        return ("not forbidden",)
    return False


def move_part(tree):
    for piece in tree["pieces"]:
        if not piece.get("shadow") and len(piece["A"]) > 2:
            for corner in piece["A"]:
                corner[0] += 0.25
            return ("does not lie in",)
    return False


def move_anchor(tree):
    for piece in tree["pieces"]:
        if piece.get("shadow") and not is_side(piece):
            part = piece["A"] if len(piece["A"]) == 1 else piece["B"]
            part[0][0] += 0.25
            return ("not the anchor",)
    return False


def move_shade(tree):
    """Moves the part that casts a shadow off its feature, or off its block."""
    for piece in tree["pieces"]:
        part = piece["A"] if len(piece["A"]) > 2 else piece["B"]
        if piece.get("shadow") and not is_side(piece) and len(part) > 2:
            for corner in part:
                corner[1] += 0.25
            return ("does not lie in",)
    return False


def is_side(piece):
    return any(isinstance(piece[k], str) and ":" in piece[k] for k in "ab")


def move_side(tree):
    for piece in tree["pieces"]:
        if piece.get("shadow") and is_side(piece):
            part = piece["A"] if len(piece["A"]) == 2 else piece["B"]
            part[0][0] += 0.25
            part[1][0] += 0.25
            return ("faces away",)
    return False


def leave_feature(tree):
    """Moves a side anchor out of its feature."""
    for piece in tree["pieces"]:
        if piece.get("shadow") and is_side(piece):
            part = piece["A"] if len(piece["A"]) == 1 else piece["B"]
            part[0][0] += 1000
            return ("a side anchor outside of", "two side anchors", "not the side anchor")
    return False


def fill_shadow(tree):
    """Presents a place that only the rule against jumps forbids as if the gap forbade it: an anchor is not part of a
    feature."""
    for piece in tree["pieces"]:
        if piece.get("shadow") and not is_side(piece):
            del piece["shadow"]
            return ("does not lie in", "not forbidden", "listed")
    return False


def hold_farther(tree):
    """A pair that is left in conflict, for which a greater distance is required than it had."""
    for piece in tree["pieces"]:
        if "clearance" in piece:
            piece["clearance"] += 0.001
            return ("than they owe", "more than it had")
    return False


def hold_higher(tree):
    """A feature inside another, for which a slightly smaller depth is required than it had."""
    for piece in tree["pieces"]:
        if piece.get("clearance", 0) < 0:
            piece["clearance"] *= 0.99
            return ("more than it had",)
    return False


def part(tree):
    """A feature that is still inside another, required to be outside."""
    for piece in tree["pieces"]:
        if piece.get("clearance", 0) < 0:
            piece["clearance"] = 0
            return ("more than it had",)
    return False


def heavier(tree):
    for body in tree["bodies"]:
        if body["weight"] is not None:
            body["weight"] *= 1.5
            return ("more than its weight",)
    return False


def nail_down(tree):
    for body in tree["bodies"]:
        if body["weight"] is not None:
            body["weight"] = None
            return ("may move",)
    return False


def join_bodies(tree):
    movable = [b for b in tree["bodies"] if "features" in b]
    if len(movable) < 2:
        return False
    movable[0]["features"] += copy.deepcopy(movable[1]["features"])
    return ("no block",)


def raise_tree(tree):
    tree["bound"] *= 1.01
    return ("the tree proves", "may be cheap", "not forbidden")


BODIES = {"heavier": heavier, "nailed": nail_down, "joined": join_bodies}  # of trees and of prices

TREES = {"forces": change_forces, "pull": pull, "elsewhere": force_from_elsewhere, "child": drop_child,
         "no forces": drop_forces_of_a_leaf, "unnamed": unname, "part": move_part, "anchor": move_anchor,
         "shade": move_shade,
         "side": move_side, "side anchor": leave_feature,
         "shadow": fill_shadow, "held": hold_farther, "depth": hold_higher, "in it": part, "raised": raise_tree,
         **{kind: push_cut(kind) for kind in CUTS}}


# ---- Changes of a conflict's proof

def drop_way(told):
    for node in told["proof"]:
        if len(node.get("ways", [])) > 1:
            last = node["ways"].pop()
            return bool(last) and ("a direction out", "has no way", "two parents", "another case", "no contradiction")
    return False


def weaken_leaves(told):
    for node in told["proof"]:
        if len(node["forces"]) < 2:
            node["forces"] = []
        for f in node["forces"][:1]:
            f["force"] *= 3
    return ("no contradiction", "a list of too few")


def ask_more(told):
    for node in told["proof"]:
        if "clearance" in node:
            node["clearance"] += 100
            return ("than they owe", "more than it had")
    return False


def chords(told):
    return [n for n in told["proof"] if "c" in n]


def pull_chord(told):
    """A chord that passes the ray through the corner before the corner."""
    for node in chords(told):
        at = node["A"][0]
        node["B"] = [[a + 0.9 * (x - a) for x, a in zip(p, at)] for p in node["B"]]
        return ("no side shadows", "before the corner")
    return False


def halve_chord(told):
    """A chord with both ends in the shadow of one side."""
    for node in chords(told):
        node["B"] = [node["B"][0], node["B"][0]]
        return ("no side shadows",)
    return False


def part_sides(told):
    """A side that ends at another place."""
    for node in chords(told):
        shared = next((p for p in node["side_b"] if p in node["side_c"]), None)
        if not shared:
            continue
        other = next(p for p in node["side_c"] if p != shared)
        node["side_c"][node["side_c"].index(shared)] = [(x + y) / 2 for x, y in zip(shared, other)]
        return ("share no corner", "faces away")
    return False


def same_side_twice(told):
    for node in chords(told):
        node["side_c"], node["c"] = node["side_b"], node["b"]
        return ("no side shadows",)
    return False


def drop_sides(told):
    """Presents a chord as a side."""
    for node in chords(told):
        for key in ("c", "side_b", "side_c"):
            del node[key]
        return ("faces away",)
    return False


def drop_slack(told):
    for node in told["proof"]:
        if node.pop("slack", False):
            return ("a move that is no worse has no way",)
    return False


def claim_slack(told):
    for node in told["proof"]:
        if "clearance" in node and not node.get("slack"):
            node["slack"] = True
            return ("slack, where nothing", "has no way")
    return False


def shorten_slack(told):
    for node in told["proof"]:
        if node.get("slack"):
            node["clearance"] *= 0.9
            return ("more than it had",)
    return False


def leaves_still(told):
    return [n for n in told["proof"] if "still" in n]


def let_go(told):
    """A block between two lines that is no longer said to be unable to move."""
    found = leaves_still(told)
    for leaf in found:
        del leaf["still"]
    return bool(found) and ("no contradiction",)


def one_line(told):
    """The same line for both."""
    for leaf in leaves_still(told):
        leaf["still"][1] = leaf["still"][0]
        return ("not opposite",)
    return False


def push_line(told):
    """Moves a line slightly beyond the places of the two."""
    for leaf in leaves_still(told):
        node, way = leaf["still"][0]
        told["proof"][node]["ways"][way]["d"] += 1e-6
        return ("has no way", "does not pass where", "beyond where")
    return False


def turn_lines(told):
    """Turns both lines by the smallest angle that doubles can express: then they are no longer edges of the shapes
    that touch there."""
    for leaf in leaves_still(told):
        for node, way in leaf["still"]:
            n = told["proof"][node]["ways"][way]["n"]
            n[0] = math.nextafter(n[0], 2)
        return ("has no way", "not opposite", "beyond where", "may reach by itself")
    return False


def hold_roughly(told):
    """Claims for the next smaller double what holds for the distance."""
    for node in told["proof"]:
        if node.pop("held", False):
            return ("has no way", "more than it had", "not told exactly")
    return False


def reach_line(told):
    """A line that a slack can reach, in place of one that it cannot."""
    for leaf in leaves_still(told):
        node, way = leaf["still"][0]
        ways = told["proof"][node]["ways"]
        if told["proof"][node].get("slack") and len(ways) > 1:
            ways[0]["n"], ways[1]["n"] = ways[1]["n"], ways[0]["n"]
            ways[0]["d"], ways[1]["d"] = ways[1]["d"], ways[0]["d"]
            return ("not opposite", "may reach by itself", "has no way", "beyond where")
    return False


def hold_own(told):
    """The pair of the conflict itself, required to keep its former distance."""
    for node in told["proof"]:
        if "clearance" in node and {node["a"], node["b"]} == {told["a"], told["b"]}:
            node["held"] = True
            return ("not listed",)
    return False


def blame(told):
    told["blocked_by"] = told["blocked_by"][1:] if told["blocked_by"] else [told["a"]]
    return ("blocked_by",)


def shorten_within(told):
    if "within" in told:
        told["within"] *= 0.1
        return ("could still be too near",)
    return False


def other_reason(told):
    """Attributes to the limits what the ways forbid, and to the pair what neighbours forbid."""
    own = {told["a"], told["b"]}
    shadow = any(n.get("shadow") for n in told["proof"])
    stranger = any(not n.get("shadow") and {n["a"], n["b"]} != own for n in told["proof"] if "ways" in n)
    told["reason"] = "max_shift"
    told.pop("within", None)
    told.pop("crowded", None)
    return (shadow or stranger) and ("no ways are heeded", "has no neighbours")


def crowd_without_room(told):
    """A claim that a few pairs have no joint solution, presented as if the others only had to keep their former
    distance."""
    if not told.get("crowded") or len(told["blocked_by"]) < 3:
        return False
    told["reason"] = "no_room"
    del told["crowded"]
    return ("held to more than it had",)


VERDICTS = {"way": drop_way, "leaf": weaken_leaves, "clearance": ask_more, "slack": drop_slack,
            "claimed slack": claim_slack, "short slack": shorten_slack, "blamed": blame,
            "let go": let_go, "one line": one_line, "pushed line": push_line, "turned lines": turn_lines, "reached line": reach_line,
            "held roughly": hold_roughly, "held itself": hold_own,
            "pulled chord": pull_chord, "half a chord": halve_chord, "parted sides": part_sides,
            "side twice": same_side_twice, "chord as side": drop_sides, "within": shorten_within, "reason": other_reason,
            "crowd": crowd_without_room}


# ---- Mutations of a whole file

def twice(lines):
    other = copy.deepcopy(lines[-1])
    other["group"] += 1
    lines.append(other)
    lines[0]["trees"] += 1
    return ("two groups have",)


def twice_in_one(lines):
    lines.append(copy.deepcopy(lines[-1]))
    lines[0]["trees"] += 1
    return ("more than its weight",)


def raise_bound(lines):
    lines[0]["lower_bound"] *= 1.0001
    return ("the bound proved is",)


def list_pair(lines):
    """A pair that is falsely said to require the gap: of a piece, or of two bodies that pay for their area."""
    if "prices" in lines[-1]:
        a, b = (body["features"][-1]["fid"] for body in lines[-1]["bodies"][:2])
    else:
        piece = next((p for p in lines[-1]["pieces"] if not p.get("shadow") and "clearance" not in p), None)
        if piece is None:
            return False
        a, b = piece["a"], piece["b"]
    at = next(k for k, line in enumerate(lines) if k and "block" not in line)
    lines.insert(at, {"conflict": 0, "a": a, "b": b, "kind": "too_close", "reason": "unresolved", "blocked_by": []})
    for k, line in enumerate(t for t in lines if "conflict" in t):
        line["conflict"] = k
    lines[0]["conflicts"] += 1
    return ("are listed",)


def other_gap(lines):
    lines[0]["gap"] += 1
    return ("another problem",)


def list_overlap(lines):
    """Pairs that the list says to be separate, and which have to stay so, listed as overlapping."""
    of = {}
    for piece in lines[-1].get("pieces", []):
        if piece.get("clearance") == 0:
            of[frozenset((str(piece["a"]), str(piece["b"])))] = True
    for line in lines:
        if "conflict" in line and frozenset((str(line["a"]), str(line["b"]))) in of:
            line["kind"] = "overlap"
    return bool(of) and ("more than it had",)


WHOLE = {"twice": twice, "twice in one": twice_in_one, "bound": raise_bound, "listed": list_pair, "kind": list_overlap, "gap": other_gap}


class Asker:
    def __init__(self, words):
        self.checker = check_proof.Checker(check_proof.read_options(words))
        self.lines = form.read(words[0])
        self.wrong, self.asked = [], {}

    def alone(self, conflict=None, tree=None):
        head = dict(self.lines[0], trees=0, lower_bound=max(0, tree["bound"]) if tree else 0)
        lines = [head] + [t for t in self.lines[1:] if "block" in t]
        listed = [dict(t) for t in self.lines[1:] if "conflict" in t]
        for t in listed:  # verdicts of other conflicts are not verified again
            if conflict is None or t["conflict"] != conflict["conflict"]:
                if t.pop("proof", None):
                    t.pop("crowded", None)
                    t.pop("within", None)
                    t["reason"] = "unresolved"
        lines += listed
        if tree:
            head["trees"] = 1
            lines.append(dict(tree, group=0))
        return copy.deepcopy(lines)

    def answer(self, lines):
        return check_proof.answer(self.checker, lambda: json.loads(json.dumps(lines)))

    def ask(self, name, candidates, mutate):
        """candidates: lists of lines, smallest first. The first one that contains such a claim is checked, in its true
        and its false form."""
        for lines, target in candidates:
            mutated = copy.deepcopy(lines)
            words = mutate(mutated, target)
            if not words:
                continue
            status, said = self.answer(lines)
            if status:
                self.wrong.append(f"{name}: what holds is refused: {said}")
            status, said = self.answer(mutated)
            if status != 1 or not any(w in said for w in words):
                self.wrong.append(f"{name}: not refused for what is wrong: {said}")
            self.asked[name] = said
            return

    def run(self):
        # If several trees of a group share the weights of its bodies, no tree needs the others for its own proof.
        of = Counter(t["group"] for t in self.lines if "group" in t)
        trees = sorted((t for t in self.lines if "group" in t and of[t["group"]] == 1), key=lambda t: len(json.dumps(t)))
        alone = [] if self.checker.hiding else [(self.alone(tree=t), -1) for t in trees]
        for kind, mutations in (("bodies", BODIES), ("nodes", TREES), ("prices", PRICES)):
            own = [(lines, at) for lines, at in alone if kind in lines[at]]
            for name, mutate in mutations.items():
                self.ask(name, own, lambda lines, at, m=mutate: m(lines[at]))
        for name, mutate in {**HIDES, **LARGER}.items() if self.checker.hiding else ():
            self.ask(name, [(self.lines, -1)], lambda lines, at, m=mutate: m(lines))
        for name, mutate in () if self.checker.hiding else WHOLE.items():
            self.ask(name, alone, lambda lines, at, m=mutate: m(lines))
        proofs = sorted((t for t in self.lines if "proof" in t), key=lambda t: len(json.dumps(t)))
        for name, mutate in () if self.checker.hiding else VERDICTS.items():
            candidates = [(self.alone(conflict=t), t["conflict"]) for t in proofs]
            self.ask(name, candidates, lambda lines, k, m=mutate:
                     m(next(t for t in lines if t.get("conflict") == k)))


def main(words):
    needed = []
    while "--need" in words:
        at = words.index("--need")
        needed.append(words[at + 1])
        del words[at:at + 2]
    asker = Asker(words)
    asker.run()
    for name in needed:
        if name not in asker.asked:
            asker.wrong.append(f"{name}: there is nothing of the kind")
    for line in asker.wrong:
        print(line)
    print(f"{len(asker.asked)} kinds of untruth: {', '.join(sorted(asker.asked))}", file=sys.stderr)
    return 1 if asker.wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
