"""Is every change of a file of --proof refused with a message, or harmless, that is, are all claims still true?

    python3 forgeries.py RUNS [--draw N] [--seed S] [--need-all] [--own-alone]

RUNS: a JSON list of runs, each with `proof` and the `words` of check_proof.py (including --result), perhaps `only`:
words of the lines that are forged. If a run has `small`, a line of it is forged only if it is the shortest one that
makes a kind of statement which the other runs do not make. In each file every number is changed: up and down, by a
little and by much, to zero, negative, subnormal, huge, infinite, not a number. Every line, member and element is
removed, doubled, swapped with the next, emptied, or replaced by one of another type. Indices become -1 and the count.
N of all of these are drawn by the seed, or all are tried. The file is checked against another layer, and with other
options; lines of another run on the same layer are put into it. N such cases are drawn, or all are tried. What is accepted is judged: this script judges the
claimed conflicts, the blocks and the sum of the bounds, judge.py judges each line. With --need-all the forged lines
together have to use every member of the format and to make every kind of statement that statements.py lists.
"""
import argparse
import json
import math
import random
import sys
from fractions import Fraction

import check_proof
import form
from judge import Judge
from judge_hiding import HidingJudge
from statements import NEEDED, statements_of

MARK = "\1"  # marks places at which text is written that JSON does not allow, or would not write that way
WORDS = {"NaN": "NaN", "Infinity": "Infinity", "-Infinity": "-Infinity", "1e999": "1e999", "-1e400": "-1e400",
         "many digits": "9" * 5000}


class Run:
    def __init__(self, told):
        self.words, self.path = told["words"], told["proof"]
        self.checker = check_proof.Checker(check_proof.read_options([self.path, *self.words]))
        self.lines = form.read(self.path)
        self.text = [json.dumps(line) for line in self.lines]
        self.checker.keep(self.lines)
        self.is_small = bool(told.get("small"))
        self.forged = [k for k, text in enumerate(self.text) if told.get("only", "") in text and not self.is_small]
        status, self.said = check_proof.answer(self.checker, lambda: self.lines)
        assert status == 0, f"{self.path}: what is true is {self.said}"
        self.claims = claims_of(self.lines)
        self.judge = Judge(self.checker.problem, self.checker.result, self.lines, self.checker.hiding)
        result, problem = self.checker.result, self.checker.problem
        self.cost = sum((Fraction(problem.weight(f)) * result.square(f) for f in result.moved()), Fraction(0))
        self.cost += (problem.rows.cost(result.moves.get) if problem.rows else 0) + problem.eased.cost(result.moves.get)

    def forgeries(self):
        """Yields (number of the line, path in it, name of the change)."""
        yield from self.of_lines()
        for k in self.forged:
            line = self.lines[k]
            sizes = sorted({len(v) for _, v in nodes_of(line) if isinstance(v, list)} | {len(self.lines)})
            for path, value in nodes_of(line):
                for name in changes_of(value, sizes) if path else ():
                    yield k, path, name
                for name in ("drop", "double", "swap") if path else ():
                    yield k, path, name
                if path in (("bound",), ("lower_bound",)):
                    yield k, path, "more than the result"

    def of_lines(self):
        for k in range(len(self.lines)):
            for name in ("drop", "double", "swap", "empty", "drop and count", "double and count", "double and claim", "another group and claim"):
                yield k, (), name

    def make(self, k, path, name):
        """The lines as JSON or, if they are changed, as text."""
        lines = list(self.lines)
        if name == "more than the result":
            lines[k] = with_place(lines[k], path, math.nextafter(float(self.cost_of(lines[k])), math.inf))
        elif path:
            lines[k] = changed(self.lines[k], path, name)
        elif name == "empty":
            lines[k] = "{}"
        elif name == "swap":
            other = (k + 1) % len(lines)
            lines[k], lines[other] = lines[other], lines[k]
        elif name.startswith("drop"):
            del lines[k]
        elif name.startswith("another") and "group" in lines[k]:
            lines.insert(k + 1, {**lines[k], "group": lines[k]["group"] + 0.5})
        else:
            lines.insert(k, lines[k])
        return counted(lines, name.endswith("claim")) if "and" in name else lines

    def cost_of(self, line):
        """The cost in the result of the bodies of a line, or of all bodies."""
        return self.judge.cost_of(line) if "bodies" in line else self.cost

    def wrong_with(self, lines):
        """Returns (None if the lines are refused or all claims are true, otherwise what is wrong; whether they are
        accepted)."""
        status, said = check_proof.answer(self.checker, lambda: read_lines(lines))
        if status:
            in_words = said.startswith("refused: ") and "not in the form of a proof" not in said
            return None if status == 1 and in_words else f"refused with {status}, and not in a sentence: {said}", False
        lines = read_lines(lines)
        return self.more_than_true(claims_of(lines)) or self.judge.wrong_with(lines), True

    def more_than_true(self, found):
        if found["bound"] > self.cost:
            return f"a bound of {float(found['bound'])} where the result costs {float(self.cost)}"
        if HidingJudge.is_less(self.claims["hide"], found["hide"]):
            return f"a bound of hidden features {found['hide']}, and not {self.claims['hide']}"
        for key in ("blocks", "conflicts", "hidden"):
            if found[key] != self.claims[key]:
                return f"other {key}"
        for pair, numbers in found["rows"].items():
            if not all(abs(v - w) <= 1e-9 * (1 + abs(w)) for v, w in zip(numbers, self.claims["rows"].get(pair, [math.inf]))):
                return f"other neighbours in a row: {pair}"
        more = found["crowded"] - self.claims["crowded"]
        return f"crowded: {more}" if more else None


def read_lines(lines):
    return [form.read_line(line) if isinstance(line, str) else line for line in lines]


def claims_of(lines):
    conflicts = [line for line in lines if "conflict" in line]
    pairs = sorted((key(c), c["kind"], c["reason"], sorted(map(str, c["blocked_by"])), "inside_block" in c) for c in conflicts)
    return {"bound": Fraction(lines[0]["lower_bound"]), "conflicts": pairs,
            "rows": {(line["a"], line["b"]): [*line["along"], line["apart"]] for line in lines if "row" in line},
            "crowded": {key(c) for c in conflicts if c.get("crowded")},
            "hide": HidingJudge.vector(lines[0].get("hide", {}).get("bound", ())), "hidden": sorted(t["fid"] for t in lines if "hidden" in t),
            "blocks": sorted(tuple(line["block"]) for line in lines if "block" in line)}


def key(conflict):
    return tuple(sorted((str(conflict["a"]), str(conflict["b"]))))


def counted(lines, claim):
    """The head after its numbers of conflicts and trees were adapted to the lines; claim: also the sum of their
    bounds."""
    told = json.loads(json.dumps(lines))
    if told and "sunder_proof" in told[0]:
        told[0]["conflicts"] = sum("conflict" in t for t in told[1:])
        told[0]["trees"] = sum("group" in t for t in told[1:])
        told[0]["lower_bound"] = sum(t["bound"] for t in told[1:] if "group" in t) if claim else told[0]["lower_bound"]
    for k, t in enumerate(t for t in told if "conflict" in t):
        t["conflict"] = k
    for name in ("larger", "hidden", "shape", "clause", "choice") if told and "hide" in told[0] else ():
        own = [t for t in told[1:] if name in t]
        if own or name != "larger":
            told[0]["hide"][name if name in ("larger", "hidden") else name + "s"] = len(own)
        for k, t in enumerate(own):
            t[name] = k
    groups = sorted({t["group"] for t in told if "group" in t})
    for t in told:
        if "group" in t:
            t["group"] = groups.index(t["group"])
    return told


# ---- Values and their changes

def nodes_of(value, path=()):
    yield path, value
    if isinstance(value, dict):
        for k, v in value.items():
            yield from nodes_of(v, (*path, k))
    elif isinstance(value, list):
        for k, v in enumerate(value):
            yield from nodes_of(v, (*path, k))


def changes_of(value, sizes):
    """Names of changes. A change that leaves the value the same is skipped when it is made."""
    if type(value) in (int, float):
        found = ["up", "down", "more", "less", "twice", "half", "minus", "zero", "least", "least below", "most", "most below",
                 "true", "text", "null", "list", *WORDS]
        return found + (["next", "before", "minus one", *(f"size {n}" for n in sizes)] if type(value) is int else [])
    return ["empty", "null", "number", "true", "list of it"] + (["other word"] if isinstance(value, str) else [])


CHANGES = {
    "up": lambda v: math.nextafter(v, math.inf), "down": lambda v: math.nextafter(v, -math.inf),
    "more": lambda v: v + abs(v) * 2 ** -20 + 2 ** -30, "less": lambda v: v - abs(v) * 2 ** -20 - 2 ** -30,
    "twice": lambda v: 2 * v, "half": lambda v: v / 2, "minus": lambda v: -v, "zero": lambda v: 0, "least": lambda v: 5e-324,
    "least below": lambda v: -5e-324, "most": lambda v: 1.7e308, "most below": lambda v: -1.7e308, "true": lambda v: True,
    "text": str, "null": lambda v: None, "list": lambda v: [v], "next": lambda v: v + 1, "before": lambda v: v - 1,
    "minus one": lambda v: -1, "number": lambda v: 1, "list of it": lambda v: [v], "empty": lambda v: type(v)(),
    "other word": lambda v: {"overlap": "too_close", "too_close": "overlap", "barrier": "barrier_near", "hull": "disc", "disc": "hull",
                             "cone": "disc", "limit": "disc", "max_shift": "no_room", "no_room": "unresolved",
                             "unresolved": "no_room"}.get(v, "max_shift")}


def changed(line, path, name):
    """The line with one value changed, as text if JSON would not write it so. Objects that are not on the path are
    shared with the original."""
    at = line
    for step in path[:-1]:
        at = at[step]
    last = path[-1]
    if name in WORDS or (name == "double" and isinstance(at, dict)):
        text = json.dumps(with_place(line, path, MARK))
        if name in WORDS:
            return text.replace(json.dumps(MARK), WORDS[name])
        value, key = json.dumps(at[last]), json.dumps(last)
        return text.replace(f"{key}: {json.dumps(MARK)}", f"{key}: {value}, {key}: {value}")
    if name in ("drop", "double", "swap"):
        around = at.copy()
        if name == "drop":
            del around[last]
        elif name == "double":
            around.insert(last, at[last])
        else:
            keys = list(at) if isinstance(at, dict) else range(len(at))
            other = keys[(list(keys).index(last) + 1) % len(keys)]
            around[last], around[other] = at[other], at[last]
        return with_place(line, path[:-1], around)
    return with_place(line, path, int(name[5:]) if name.startswith("size ") else CHANGES[name](at[last]))


def with_place(line, path, value):
    """A copy of the objects along the path."""
    if not path:
        return value
    found = line.copy()
    found[path[0]] = with_place(line[path[0]], path[1:], value)
    return found


# ---- Other layers, other options

def other_options(words):
    """Options for another run."""
    words = list(words)
    for extra in (["--gap", "0.75"], ["--gap", "2.5"], ["--max-shift", "0.25"], ["--max-shift", "1000"], ["--fixed-where", "fid = 1"],
                  ["--ignore-where", "fid = 1"], ["--no-blocks"], ["--allow-jumps"], ["--contained", "ignore"], ["--weight", "area"],
                  ["--touch-tolerance", "0.01"], ["--layer", "nowhere"], ["--rows", "auto"], ["--rows", "no"],
                  ["--row-stiffness", "2,0.2"], ["--ease", "no"], ["--ease", "7"], ["--hide"], ["--hide-weight", "1"]):
        yield words + extra  # if an option is given twice, the last one counts
    for k, word in enumerate(words):
        if word == "--barrier":
            yield words[:k] + words[k + 2:]
            for more in ("gap=7", "width=9", "side=no", "as=boundary"):
                yield words[:k + 1] + [words[k + 1] + "," + more] + words[k + 2:]


def swapped(run, other):
    """Yields (what, lines): parts of another run on the same layer, with other options or other barriers, in place of
    this run's."""
    def of(lines, *kinds):
        return [line for line in lines if any(kind in line for kind in kinds)]
    proofs = {key(line): line["proof"] for line in of(other.lines, "proof")}
    verdicts = [{**line, "proof": proofs[key(line)]} if "proof" in line and key(line) in proofs else line for line in run.lines]
    yield "verdicts", verdicts
    top, own, others = run.lines[:1] + of(run.lines, "block", "conflict"), of(run.lines, "group"), of(other.lines, "group")
    yield "trees", counted(top + others, True)
    yield "trees besides", counted(top + own + [{**t, "group": t["group"] + len(own)} for t in others], True)
    yield "trees in its groups", counted(top + sorted(own + others, key=lambda t: t["group"]), True)
    yield "all but the first line", counted(run.lines[:1] + other.lines[1:], True)


def strangers(runs):
    """(the options, a kind, the function that finds what is wrong)"""
    for run in runs:
        for other in runs:
            if other is not run:
                yield f"{run.path} for {other.path}", "for", lambda r=run, o=other: o.wrong_with(r.lines)[0]
            if other is not run and other.words[0] == run.words[0]:
                for what, lines in swapped(run, other):
                    yield f"{run.path} with the {what} of {other.path}", what, lambda r=run, own=lines: r.wrong_with(own)[0]
        for words in other_options(run.words):
            kind = " ".join(words[len(run.words):]) or "a barrier"
            yield f"{run.path} with {' '.join(words)}", kind, lambda r=run, w=words: wrong_with_options(r, w)


def wrong_with_options(run, words):
    """Checks without the result, which belongs to the true options. If the problem with the changed options is the same
    in all that matters, the accepted claims have to be true for it."""
    at = words.index("--result")
    words = words[:at] + words[at + 2:]
    try:
        checker = check_proof.Checker(check_proof.read_options([run.path, *words]))
    except (form.Refused, form.NotRead, SystemExit):
        return None
    status, said = check_proof.answer(checker, lambda: form.read(run.path))
    if status:
        return None if said.startswith("refused: ") and "not in the form" not in said else f"not in a sentence: {said}"
    return None if asks_no_less(run, run.checker.problem, checker.problem) else f"accepted: {said}"


def asks_no_less(run, own, other):
    """Do the other options allow no more moves than the original ones, at no lower cost? Then a statement that is
    true for the original options is true for these."""
    def most(limit):
        return math.inf if limit is None else limit
    text = "".join(run.text)
    return (other.blocks.of == own.blocks.of and other.options.gap >= own.options.gap and
            all(most(other.limit(f)) <= most(own.limit(f)) for f in own.place) and
            (run.claims["bound"] == 0 or all(other.weight(f) >= own.weight(f) for f in own.place)) and
            all(k in other.half and other.least_owed(k) >= own.least_owed(k) for k in own.half if k in text) and
            sides_in(run.lines) & own.sides <= other.sides)


def sides_in(lines):
    """The barriers that a shadow is about."""
    shadows = [v for line in lines for _, v in nodes_of(line) if isinstance(v, dict) and "shadow" in v]
    return {v.get(key) for v in shadows for key in "abc" if isinstance(v.get(key), str)}


def members_of(runs):
    """Every member of every kind of object, without positions in lists."""
    return {".".join(str(s) for s in path if not isinstance(s, int)) for run in runs for k in run.forged
            for path, _ in nodes_of(run.lines[k]) if path}


def read_runs(path):
    with open(path, encoding="utf-8") as file:
        runs = [Run(told) for told in json.load(file)]
    choose_lines(runs)
    return runs


def choose_lines(runs):
    """Chooses the lines of small runs that are forged."""
    made = made_by(runs)
    lines = sorted(((len(run.text[k]), n, k) for n, run in enumerate(runs) if run.is_small for k in range(len(run.lines))))
    for _, n, k in lines:
        own = set(statements_of(runs[n].lines[k])) & set(NEEDED)
        if not own <= made:
            runs[n].forged.append(k)
            made |= own


def made_by(runs):
    """All statements of the lines that are forged."""
    return {what for run in runs for k in run.forged for what in statements_of(run.lines[k])}


MEMBERS = """sunder_proof layer gap least_gap max_shift contained allow_jumps lower_bound conflicts trees block conflict a b kind reason blocked_by
inside_block within proof proof.a proof.b proof.A proof.B proof.ways proof.ways.n proof.ways.d proof.ways.next proof.forces
proof.forces.node proof.forces.way proof.forces.behind proof.forces.force proof.slack proof.held proof.shadow proof.clearance proof.c
proof.side_b proof.side_c proof.still proof.row group bound bodies bodies.features bodies.features.fid bodies.features.weight
bodies.features.max_shift bodies.features.anchor bodies.barrier bodies.weight bodies.shift pieces pieces.i pieces.j pieces.a pieces.b
pieces.A pieces.B pieces.shadow pieces.clearance nodes nodes.parent nodes.cuts nodes.cuts.kind nodes.cuts.i nodes.cuts.j nodes.cuts.n
nodes.cuts.d nodes.cuts.pieces nodes.cuts.share pieces.priced pieces.joined pieces.pieces eased ease row_stiffness row along apart pieces.row springs springs.i springs.j springs.n springs.stiff nodes.forces nodes.by nodes.empty nodes.empty.i nodes.empty.j nodes.empty.pieces prices prices.side
prices.unit prices.x prices.y prices.columns prices.rows crowded hide hide.hidden hide.shapes hide.clauses hide.choices hide.bound hidden fid clause
members choice nodes.split nodes.level nodes.shares hide.larger larger shape level rung polygons taken""".split()


def draw(options, cases, kind_of):
    """Draws --draw of the cases by the seed, with the first of each kind among them."""
    cases = random.Random(options.seed).sample(cases, len(cases))
    first = {kind_of(case): k for k, case in reversed(list(enumerate(cases)))}
    chosen = sorted(first.values()) + [k for k in range(len(cases)) if first[kind_of(cases[k])] != k]
    return [cases[k] for k in chosen[:options.draw]]


def main(words):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("runs")
    parser.add_argument("--draw", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--need-all", action="store_true")
    parser.add_argument("--own-alone", action="store_true", help="not for other layers, nor with other options")
    options = parser.parse_args(words)
    runs, wrong = read_runs(options.runs), []
    if options.need_all:
        made = made_by(runs)
        wrong += [f"no run has {name}" for name in MEMBERS if name not in members_of(runs)]
        wrong += [f"no line that is forged makes the statement: {what}" for what in NEEDED if what not in made]
    drawn = [(k, what) for k, run in enumerate(runs) for what in run.forgeries()]
    every = len(drawn)
    if options.draw:
        drawn = draw(options, drawn, lambda case: case[1][2])
    accepted = 0
    for k, what in drawn:
        said, is_accepted = runs[k].wrong_with(runs[k].make(*what))
        accepted += is_accepted
        if said:
            wrong.append(f"{runs[k].path}, line {what[0] + 1}, {'.'.join(map(str, what[1]))}, {what[2]}: {said}")
    others = [] if options.own_alone else list(strangers(runs))
    if options.draw:
        others = draw(options, others, lambda case: case[1])
    for what, _, ask in others:
        said = ask()
        if said:
            wrong.append(f"{what}: {said}")
    for line in wrong[:40]:
        print(line)
    print(f"{len(drawn)} of {every} forgeries by seed {options.seed}, {len(others)} of other layers and options: {len(wrong)} wrong; "
          f"{accepted} claim no more than is true")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
