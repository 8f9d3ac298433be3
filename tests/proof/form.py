"""The format of a file of --proof (docs/PROOF.md, section 2): its lines, the members of each, and the type of each
value.

The result has numbers as doubles, indices and FIDs as integers, and no unknown members. So the checks of claims need
not test again whether a member exists, or whether `true` was written for a number. Indices are not negative; whether
they are in range is checked where they are used (index()).
"""
import json
import math

VERSION = 2
KINDS = ("overlap", "too_close", "barrier", "barrier_drawn", "barrier_near", "contained", "duplicate", "tight")
REASONS = ("same_block", "kept", "fixed", "max_shift", "side", "jump", "no_room", "unresolved", "row")
LEAST_FID, MOST_FID = -1 << 63, (1 << 63) - 1


class Refused(Exception):
    """A claim of the proof is not valid."""


class NotRead(Exception):
    """This checker cannot handle the layer, the barriers or the options."""


def demand(condition, *words):
    if not condition:
        raise Refused(" ".join(map(str, words)))


def shown(value):
    """A fraction as text for messages."""
    try:
        return float(value)
    except OverflowError:
        return "a number beyond doubles"


def index(value, n, what):
    demand(0 <= value < n, "there is no", what, value)
    return value


# ---- Types of values. Each function takes a JSON value and its place in the file, and returns the value.

def number(value, where):
    demand(type(value) in (int, float), "no number:", where)
    try:
        found = float(value)
    except OverflowError:
        found = math.inf
    demand(math.isfinite(found), "a number beyond the range of doubles:", where)
    return found


def positive(value, where):
    found = number(value, where)
    demand(found > 0, "a number that is not greater than 0:", where)
    return found


def not_negative(value, where):
    found = number(value, where)
    demand(found >= 0, "a force that pulls, or another number less than 0:", where)
    return found


def sheet(value, where):
    demand(type(value) is dict, "no sheet:", where)
    return value


def or_null(kind):
    return lambda value, where: None if value is None else kind(value, where)


def whole(value, where):
    demand(type(value) is int and 0 <= value <= MOST_FID, "no index:", where)
    return value


def integer(value, where):
    demand(type(value) is int and LEAST_FID <= value <= MOST_FID, "no whole numbers:", where)
    return value


def name(value, where):
    demand(type(value) is str, "no text:", where)
    return value


def true(value, where):
    demand(value is True, "a member that is true or not there:", where)
    return value


def boolean(value, where):
    demand(type(value) is bool, "neither true nor false:", where)
    return value


def one_of(words):
    def kind(value, where):
        demand(type(value) is str and value in words, "none of", *words, "at", where)
        return value
    return kind


def barrier(value, where):
    demand(type(value) is str and ":" in value, "no barrier is called so:", where)
    return value


def thing(value, where):
    return barrier(value, where) if type(value) is str else integer(value, where)


def all_of(kind, least=0, most=None):
    """A list."""
    def listed(value, where):
        demand(type(value) is list, "no list:", where)
        demand(len(value) >= least, "a list of too few:", where)
        demand(most is None or len(value) <= most, "a list of too many:", where)
        return [kind(v, where) for v in value]
    return listed


def listed_as(*kinds):
    """A list that has these kinds of values, in order."""
    def kind(value, where):
        demand(type(value) is list and len(value) == len(kinds), "no pair, or a list of another length:", where)
        return [k(v, where) for k, v in zip(kinds, value)]
    return kind


def pair_of(first, second):
    return listed_as(first, second)


def members(needed, optional=()):
    """An object that has all members of the first set, perhaps some of the second, and no others."""
    optional = dict(optional)

    def kind(value, where):
        demand(type(value) is dict, "no object:", where)
        for key in needed:
            demand(key in value, "a member is missing:", where + "." + key)
        for key in value:
            demand(key in needed or key in optional, "a member that the form has not:", f"{where}.{key}")
        return {key: (needed.get(key) or optional[key])(v, f"{where}.{key}") for key, v in value.items()}
    return kind


def either(key, this, that):
    """The first form if the object has that key, otherwise the second."""
    return lambda value, where: (this if type(value) is dict and key in value else that)(value, where)


# ---- The lines

place = pair_of(number, number)
corners = all_of(place, 1)

way = members({"n": place, "d": number, "next": whole})
way_force = members({"node": whole, "way": whole, "behind": boolean, "force": positive})
question = members({"a": thing, "b": thing, "A": corners, "B": corners, "ways": all_of(way, 1),
                    "forces": all_of(way_force, 0, 0)},
                   {"slack": true, "held": true, "shadow": true, "clearance": number, "c": thing,
                    "side_b": all_of(place, 2, 2), "side_c": all_of(place, 2, 2)})
question = either("row", members({"a": thing, "b": thing, "row": true, "ways": all_of(way, 1, 1), "forces": all_of(way_force, 0, 0)}),
                  question)
leaf = members({"forces": all_of(way_force, 1)}, {"still": all_of(pair_of(whole, whole), 2, 2)})
nodes_of_proof = all_of(either("ways", question, leaf), 1)
nodes_of_clause = all_of(either("ways", question, members({"forces": all_of(way_force, 1)})), 1)
conflict = members({"conflict": whole, "a": thing, "b": thing, "kind": one_of(KINDS), "reason": one_of(("", *REASONS)),
                    "blocked_by": all_of(thing)},
                   {"crowded": true, "inside_block": true, "within": positive,
                    "proof": nodes_of_proof})

feature = members({"fid": integer, "weight": positive, "max_shift": or_null(not_negative)}, {"anchor": place, "class": whole})
shared = {"weight": or_null(positive), "shift": place}
body = either("barrier", members({"barrier": barrier, **shared}, {"class": whole}), members({"features": all_of(feature, 1), **shared}))
piece = either("row", members({"i": whole, "j": whole, "a": thing, "b": thing, "row": true}, {"priced": true}),
               members({"i": whole, "j": whole, "a": thing, "b": thing, "A": corners, "B": corners},
                       {"shadow": true, "clearance": number}))
piece = either("priced", either("row", piece, members({"i": whole, "j": whole, "a": thing, "b": thing, "priced": true, "A": corners, "B": corners})), piece)
piece = either("joined", members({"i": whole, "j": whole, "a": thing, "b": thing, "joined": all_of(place, 3), "pieces": all_of(whole, 1)}), piece)
spring = members({"i": whole, "j": whole, "n": place, "stiff": positive})
named = all_of(whole)
side = {"i": whole, "n": place, "d": number}
CUTS = {"limit": members({"kind": name, **side}), "cone": members({"kind": name, "j": whole, **side}),
        "disc": members({"kind": name, "j": whole, **side}),
        "hull": members({"kind": name, "j": whole, "pieces": named, **side}),
        "price": members({"kind": name, "j": whole, "share": positive, "pieces": named, **side})}


def cut(value, where):
    demand(type(value) is dict and type(value.get("kind")) is str and value["kind"] in CUTS, "a cut of no kind:", where)
    return CUTS[value["kind"]](value, where)


forces = all_of(pair_of(whole, not_negative))
node = members({"parent": or_null(whole), "cuts": all_of(cut), "forces": forces},
               {"by": forces, "empty": members({"i": whole, "j": whole, "pieces": named})})
prices = members({"side": positive, "unit": positive, "x": integer, "y": integer, "columns": whole,
                  "rows": all_of(all_of(integer), 1)})
tree = {"group": whole, "bound": number, "bodies": all_of(body, 1)}
group = either("prices", members({**tree, "prices": prices}),
               members({**tree, "pieces": all_of(piece), "nodes": all_of(node, 1)},
                       {"springs": all_of(spring, 1), "eased": all_of(pair_of(whole, whole), 1)}))
row = members({"row": whole, "a": integer, "b": integer, "along": place, "apart": number})
weights = all_of(pair_of(or_null(whole), integer))
hide = members({"hidden": whole, "shapes": whole, "clauses": whole, "choices": whole, "bound": weights}, {"larger": whole})
table = all_of(all_of(not_negative, 1), 1)
head = members({"sunder_proof": whole, "layer": name, "gap": not_negative, "max_shift": or_null(not_negative),
                "contained": one_of(("block", "ignore", "separate")), "allow_jumps": boolean,
                "lower_bound": not_negative, "conflicts": whole, "trees": whole},
               {"row_stiffness": all_of(not_negative, 2, 2), "ease": positive, "least_gap": not_negative, "hide": hide,
                "classes": all_of(name), "gaps": table, "least_gaps": table, "spec": sheet})
block = members({"block": all_of(integer, 2)})
hidden = members({"hidden": whole, "fid": integer})
polygons = all_of(all_of(all_of(place, 3), 1), 1)
larger = members({"larger": whole, "fid": integer, "polygons": polygons})
shape = members({"shape": whole, "fid": integer, "level": whole, "rung": whole, "polygons": polygons}, {"taken": true})
clause = members({"clause": whole, "members": all_of(pair_of(integer, whole), 1), "a": thing, "b": thing, "reason": one_of(REASONS)},
                 {"crowded": true, "within": positive, "proof": nodes_of_clause})
choice_node = either("split", members({"split": integer, "level": whole}),
                     either("unmet", members({"unmet": whole}), members({"shares": all_of(listed_as(whole, or_null(whole), integer))})))
choice = members({"choice": whole, "bound": weights, "nodes": all_of(choice_node, 1)})
LINES = {"block": block, "larger": larger, "hidden": hidden, "shape": shape, "row": row, "conflict": conflict, "group": group, "clause": clause, "choice": choice}


def once(pairs):
    found = dict(pairs)
    demand(len(found) == len(pairs), "a member is there twice")
    return found


def no_constant(word):
    raise Refused(f"{word} is no number")


def read_line(text):
    try:
        return json.loads(text, object_pairs_hook=once, parse_constant=no_constant)
    except (ValueError, RecursionError) as why:
        raise Refused(f"a line that is no JSON: {why}") from None


class Proof:
    """The content of a file: head; blocks (lists of FIDs); rows (lines about neighbours); conflicts as in the lines,
    without their proofs. Verdicts and trees are read one at a time, since files may be larger than memory. lines: an
    iterable of JSON objects, read twice. known: the content of lines that were read before, by id()."""

    def __init__(self, lines, known):
        self.lines, self.known, self.head = lines, known, None
        self.blocks, self.larger, self.hidden, self.shapes, self.rows, self.conflicts = [], [], [], [], [], []
        for key, found in self.entries():
            if key == "head":
                self.head = found
            elif key == "block":
                self.blocks.append(found["block"])
            elif key == "larger":
                demand(found["larger"] == len(self.larger), "larger shapes are not in order")
                self.larger.append(found)
            elif key == "hidden":
                demand(found["hidden"] == len(self.hidden), "hidden features are not in order")
                self.hidden.append(found["fid"])
            elif key == "shape":
                demand(found["shape"] == len(self.shapes), "smaller shapes are not in order")
                self.shapes.append(found)
            elif key == "row":
                self.rows.append(found)
            elif key == "conflict":
                self.conflicts.append(without_proof(found))
            else:
                break
        demand(self.head, "an empty proof")
        demand(len(self.conflicts) == self.head["conflicts"], "lines are missing")
        wanted = self.head.get("hide", {})
        demand(len(self.larger) == wanted.get("larger", 0), "lines are missing, or larger shapes are not wanted")
        demand(len(self.hidden) == wanted.get("hidden", 0), "lines are missing, or hidden features are not wanted")
        demand(len(self.shapes) == wanted.get("shapes", 0), "lines are missing, or smaller shapes are not wanted")
        demand([c["conflict"] for c in self.conflicts] == list(range(len(self.conflicts))), "conflicts are not in order")

    def entries(self):
        """Yields (kind of line, its content)."""
        order, at = ["head", *LINES], 0
        for k, line in enumerate(self.lines, 1):
            demand(type(line) is dict and (k > 1 or line.get("sunder_proof") == VERSION), "no proof of this version")
            key = "head" if k == 1 else next((w for w in LINES if w in line), None)
            demand(key, "line", k, "is of no kind")
            demand(order.index(key) >= at, "line", k, "comes too late: blocks, larger, hidden, shapes, rows, conflicts, groups, clauses, choices")
            at = order.index(key)
            yield key, self.known.get(id(line)) or {"head": head, **LINES}[key](line, f"line {k}")

    def statements(self):
        trees = last = 0
        counts = {"clause": 0, "choice": 0}
        again = iter(self.conflicts)
        for key, found in self.entries():
            demand(key != "conflict" or without_proof(found) == next(again, None), "the file is another than it was a moment ago")
            if key == "group":
                demand(found["group"] - last in (0, 1) and (trees or not found["group"]), "groups are not in order")
                trees, last = trees + 1, found["group"]
            if key in counts:
                demand("hide" in self.head and found[key] == counts[key], "clauses or choices are not in order, or not wanted")
                counts[key] += 1
            if key in ("conflict", "group", *counts):
                yield key, found
        demand("hide" not in self.head or all(counts[k] == self.head["hide"][k + "s"] for k in counts), "lines are missing")
        demand(trees == self.head["trees"] and next(again, None) is None, "lines are missing")


def without_proof(conflict):
    return {name: value for name, value in conflict.items() if name != "proof"}


class File:
    """The lines of a file, as JSON objects; the file is read again in each iteration."""

    def __init__(self, path):
        self.path = path

    def __iter__(self):
        with open(self.path, encoding="utf-8") as file:
            try:
                yield from map(read_line, file)
            except UnicodeDecodeError as why:
                raise Refused(f"a line that is no JSON: {why}") from None


def read(path):
    return list(File(path))
