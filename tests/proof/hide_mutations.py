"""The changes that mutations.py makes to what a file says about hidden features. Each function returns False if the file has nothing of its
kind, otherwise the words of the expected refusal."""
import copy

FALLS_SHORT, TOO_MUCH = "prove less than the bound", "more than what"


def with_key(lines, key):
    return [line for line in lines if key in line]


def shares(lines):
    return [share for line in with_key(lines, "choice") for node in line["nodes"] for share in node.get("shares", ())]


def leave_member_out(lines):
    """A clause without a feature that its proof names."""
    for line in with_key(lines, "clause"):
        if len(line["members"]) > 1:
            line["members"].pop()
            return ("is hidden",)
    return False


def add_never_hidden(lines):
    """A member that is never hidden: of class 0, or none at all."""
    for line in with_key(lines, "clause"):
        line["members"].append([-5, 0])
        return ("never hidden",)
    return False


def other_level(lines):
    for line in with_key(lines, "clause"):
        line["members"][0][1] = 7
        return ("the level",)
    return False


def member_twice(lines):
    for line in with_key(lines, "clause"):
        line["members"].append(line["members"][0])
        return ("a member is there twice",)
    return False


def clause_without_proof(lines):
    for line in with_key(lines, "clause"):
        if line["reason"] == "no_room":
            del line["proof"]
            return ("no proof of a clause",)
    return False


def raise_share(lines):
    for share in shares(lines):
        share[2] += 1
        return (TOO_MUCH,)
    return False


def lower_share(lines):
    for share in shares(lines):
        share[2] -= 1
        return (FALLS_SHORT,)
    return False


def pull_share(lines):
    for share in shares(lines):
        share[2] *= -1
        return ("less than nothing",)
    return False


def clause_twice(lines):
    """A clause doubled, with a share of its own, so that a feature pays twice."""
    clauses, found = with_key(lines, "clause"), shares(lines)
    if not found:
        return False
    double = copy.deepcopy(clauses[found[0][0]])
    double["clause"] = len(clauses)
    lines.insert(lines.index(clauses[-1]) + 1, double)
    lines[0]["hide"]["clauses"] += 1
    node = next(n for line in with_key(lines, "choice") for n in line["nodes"] if n.get("shares"))
    node["shares"].append([double["clause"], *node["shares"][0][1:]])
    return (TOO_MUCH,)


def other_class(lines):
    """A share of another class, which a member does not have."""
    for share in shares(lines):
        if share[1] is None or share[1] > 1:
            share[1] = 1
            return (TOO_MUCH,)
    return False


def higher_class(lines):
    """The bound of what is hidden, of a more important class."""
    for line in lines[:1]:
        for weight in line.get("hide", {}).get("bound", ()):
            if weight[0] is None or weight[0] > 1:
                weight[0] = 0
                return ("prove less than the bound of what is hidden",)
    return False


def raise_claim(lines):
    for line in lines[:1]:
        for weight in line.get("hide", {}).get("bound", ()):
            weight[1] += 1
            return ("prove less than the bound of what is hidden",)
    return False


def raise_tree(lines):
    for line in with_key(lines, "choice"):
        for weight in line["bound"]:
            weight[1] += 1
            return (FALLS_SHORT,)
    return False


def drop_leaf(lines):
    for line in with_key(lines, "choice"):
        if "split" in line["nodes"][0]:
            line["nodes"].pop()
            return ("leaves are missing",)
    return False


def leaf_more(lines):
    for line in with_key(lines, "choice"):
        line["nodes"].append(copy.deepcopy(line["nodes"][-1]))
        return ("after the last leaf",)
    return False


def split_nothing(lines):
    """A division that leaves no choice on one side."""
    for line in with_key(lines, "choice"):
        for node in line["nodes"]:
            if "split" in node:
                node["level"] = 2
                return ("no level",)
    return False


def call_unmet(lines):
    """A leaf that says a clause has no free member, though it has."""
    for line in with_key(lines, "choice"):
        for node in line["nodes"]:
            if node.get("shares"):
                k = node.pop("shares")[0][0]
                node["unmet"] = k
                return ("may be met",)
    return False


def met_clause(lines):
    """A share of a clause that a hidden feature meets already."""
    clauses = with_key(lines, "clause")
    for line in with_key(lines, "choice"):
        split = line["nodes"][0].get("split")
        met = [k for k, c in enumerate(clauses) if split in [fid for fid, _ in c["members"]]]
        if met:
            line["nodes"][1].setdefault("shares", []).append([met[0], 1, 1])
            return "shares" in line["nodes"][1] and ("a clause that is met",)
    return False


def tree_twice(lines):
    trees = with_key(lines, "choice")
    if not trees:
        return False
    lines.append({**copy.deepcopy(trees[0]), "choice": len(trees)})
    lines[0]["hide"]["choices"] += 1
    return ("two trees are about one feature",)


def hide_twice(lines):
    hidden = with_key(lines, "hidden")
    if not hidden:
        return False
    lines.insert(lines.index(hidden[-1]) + 1, {"hidden": len(hidden), "fid": hidden[0]["fid"]})
    lines[0]["hide"]["hidden"] += 1
    return ("hidden twice",)


def hide_important(lines):
    """Hides a feature of class 0: the others would have room."""
    hidden, members = with_key(lines, "hidden"), {fid for line in with_key(lines, "clause") for fid, _ in line["members"]}
    visible = [b["features"][0]["fid"] for line in with_key(lines, "group") for b in line["bodies"] if "features" in b]
    for fid in [fid for fid in visible if fid not in members] if hidden else ():
        lines.insert(lines.index(hidden[-1]) + 1, {"hidden": len(hidden), "fid": fid})
        lines[0]["hide"]["hidden"] += 1
        return ("never hidden",)
    return False


def show_hidden(lines):
    hidden = with_key(lines, "hidden")
    if not hidden:
        return False
    lines.remove(hidden[-1])
    lines[0]["hide"]["hidden"] -= 1
    return ("hides other features", "is no block", "the bound is more than what is hidden")


# ---- Smaller shapes

OFF_THE_RUNG = "is too near the outline", "is too near a corner", "is cut where the outline is far", "is not the one as given, scaled by", "is no square", "is in a block"


def scaled(line, factor):
    ring = line["polygons"][0][0]
    x, y = (sum(p[c] for p in ring) / len(ring) for c in (0, 1))
    line["polygons"][0][0] = [[x + factor * (p[0] - x), y + factor * (p[1] - y)] for p in ring]


def enlarge_shape(lines):
    for line in with_key(lines, "shape"):
        scaled(line, 1.5)
        return "does not lie in the one before", *OFF_THE_RUNG
    return False


def last_shapes(lines):
    """The last smaller shape of each feature."""
    return {line["fid"]: line for line in with_key(lines, "shape")}.values()


def shrink_shape(lines):
    for line in last_shapes(lines):
        scaled(line, 0.125)
        return "keeps too little", *OFF_THE_RUNG
    return False


def other_rung(lines):
    """The only smaller shape of a feature, called one of the next rung."""
    shapes = with_key(lines, "shape")
    for line in shapes:
        if sum(other["fid"] == line["fid"] for other in shapes) == 1:
            line["rung"] += 1
            return "a rung that is not wanted", *OFF_THE_RUNG
    return False


def rung_before(lines):
    """The same, called one of the rung before."""
    shapes = with_key(lines, "shape")
    for line in shapes:
        if line["rung"] and sum(other["fid"] == line["fid"] for other in shapes) == 1:
            line["rung"] -= 1
            return "keeps too little", "is too near", *OFF_THE_RUNG
    return False


def no_rung(lines):
    for line in with_key(lines, "shape"):
        line["rung"] = 99
        return ("a rung that is not wanted",)
    return False


def widen_shape(lines):
    """The last smaller shape of a feature in no block, enlarged so little that it still lies in the one before."""
    joined = {fid for line in with_key(lines, "block") for fid in line["block"]}
    for line in last_shapes(lines):
        if line["rung"] and line["fid"] not in joined:
            scaled(line, 1 + 1e-4)
            return OFF_THE_RUNG
    return False


def tip_shape(lines):
    """The last smaller shape of a feature, with a corner moved in by a tenth of the way to the next but one."""
    for line in last_shapes(lines):
        ring = line["polygons"][0][0]
        if line["rung"] and len(ring) >= 4:
            ring[0] = [p + (q - p) / 10 for p, q in zip(ring[0], ring[2])]
            return "is no longer shared", "is no polygon", *OFF_THE_RUNG
    return False


def slide_on_wall(lines):
    """A corner that two smaller shapes of one rung share, moved along their wall in one of them."""
    shapes = with_key(lines, "shape")
    for line in shapes:
        for other in shapes:
            if other["rung"] != line["rung"] or other["fid"] == line["fid"]:
                continue
            shared = [tuple(p) for p in other["polygons"][0][0]]
            ring = line["polygons"][0][0]
            at = [k for k, p in enumerate(ring) if tuple(p) in shared]
            if len(at) == 2 and (at[1] - at[0]) in (1, len(ring) - 1):
                p, q = ring[at[0]], ring[at[1]]
                ring[at[0]] = [a + (b - a) / 64 for a, b in zip(p, q)]
                return ("is no longer shared",)
    return False


def reach_barrier(lines):
    """A smaller shape with a corner of the shape as given, by what the file says of parts of the feature."""
    for line in with_key(lines, "shape"):
        ring = line["polygons"][0][0]
        corners = [p for told in lines for node in told.get("proof", ()) for key in "AB" if node.get(key.lower()) == line["fid"] for p in node[key]]
        for p in corners:
            if p not in ring and not node_is_near(p, ring):
                ring.append(p)
                return "is too near", "does not lie in", "is no polygon", *OFF_THE_RUNG
    return False


def node_is_near(p, ring):
    return any(abs(p[0] - q[0]) + abs(p[1] - q[1]) < 0.1 for q in ring)


def cross_shape(lines):
    for line in with_key(lines, "shape"):
        ring = line["polygons"][0][0]
        ring[0], ring[1] = ring[1], ring[0]
        return ("is no polygon",)
    return False


def shape_twice(lines):
    shapes = with_key(lines, "shape")
    if not shapes:
        return False
    lines.insert(lines.index(shapes[-1]) + 1, {**copy.deepcopy(shapes[0]), "shape": len(shapes)})
    lines[0]["hide"]["shapes"] += 1
    return ("not in order, or too many",)


def shape_of_nothing(lines):
    for line in with_key(lines, "shape"):
        line["fid"] = -5
        return ("there is no feature",)
    return False


def shape_not_taken(lines):
    for line in with_key(lines, "shape"):
        if line.pop("taken", False):
            return ("with another shape", "elsewhere", "a part does not lie", "a conflict")
    return False


def shape_of_hidden(lines):
    hidden = [told["fid"] for told in with_key(lines, "hidden")]
    for line in with_key(lines, "shape"):
        if line["fid"] in hidden:
            line["taken"] = True
            return ("has two shapes, or is hidden",)
    return False


def shapes_for_tree(lines):
    """A clause of a tree that a smaller shape satisfies."""
    clauses = with_key(lines, "clause")
    for share in shares(lines):
        for member in clauses[share[0]]["members"]:
            if member[1]:
                member[1] -= 1
                return ("a clause that smaller features may meet",)
    return False


HIDES = {"member left out": leave_member_out, "member never hidden": add_never_hidden, "level": other_level, "member twice": member_twice,
         "clause without proof": clause_without_proof, "raised share": raise_share, "lowered share": lower_share, "share below 0": pull_share,
         "clause twice": clause_twice, "share of another class": other_class, "bound of another class": higher_class,
         "raised bound of hidden": raise_claim, "raised tree of hidden": raise_tree, "dropped leaf of hidden": drop_leaf,
         "leaf more": leaf_more, "split at no level": split_nothing, "called unmet": call_unmet, "share of a met clause": met_clause,
         "tree of hidden twice": tree_twice, "hidden twice": hide_twice, "hidden important": hide_important, "hidden shown": show_hidden,
         "larger shape": enlarge_shape, "shape that keeps too little": shrink_shape, "shape at a barrier": reach_barrier,
         "shape that crosses itself": cross_shape, "shape twice": shape_twice, "shape of nothing": shape_of_nothing,
         "shape not taken": shape_not_taken, "shape of a hidden feature": shape_of_hidden, "shape of the next rung": other_rung, "shape of the rung before": rung_before,
         "shape of no rung": no_rung, "shape that is too large for its rung": widen_shape, "shape with a tip cut": tip_shape,
         "wall that is cut at two places": slide_on_wall, "lesser level of a clause": shapes_for_tree}
