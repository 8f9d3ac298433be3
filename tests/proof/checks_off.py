"""Can the judge of forgeries see? Each of the checker's own tests is switched off, one at a time, and what it refused is asked again:

    python3 checks_off.py RUNS [--seed S] [--tries N] [--only WORDS]

RUNS as of forgeries.py; of each kind of change of each member one is drawn. A test is a demand() of a file in MODULES. With it off, what
it refused is refused by other tests, or accepted; and of what is accepted the judge has to find something that is not true. What is
accepted and not seen, and tests that no forgery meets, stand in UNSEEN, with the reason; a test that is neither fails.
"""
import argparse
import ast
import json
import os
import random
import sys
from collections import defaultdict

import bodies
import decided
import forgeries
import form
import prices
import problem
import result
import trees
import verdicts

MODULES = {m.__name__ + ".py": m for m in (trees, bodies, prices, verdicts, decided, problem)}
ENDLESS = {"a node has two parents:"}  # without which the search does not end
TRUE = "one change leaves true what the node says, though not for the reasons that it gives"
FORM = "form.py, or the list of the result, refuses such a file before"
LAYER = "asked of the layer and the options, not of the file"
FEW = "no run has what one change would make of it; test_proof.sh and mutations.py ask"
UNSEEN = {
    "a force on a cut that is not on the way to its node": TRUE,
    "may lie in each other": FEW,
    "a piece of another pair": TRUE,
    "that is not the side anchor of": TRUE,
    "has no sides": FEW,
    "a line that does not pass where the two stood": FEW,
    "a shadow of what holds the anchor": "an anchor that is held is refused before, and a side anchor lies on no side",
    "an empty node with children": FEW,
    "a cut of one body": "such a cut says 0 >= d, which is true of most",
    "a cone that is no child's first cut": FEW,
    "forces of discs, and no disc": "these forces are used for nothing",
    "a disc at the root": FEW,
    "there is no barrier": FEW,
    "features may lie in each other, and owe nothing then": LAYER,
    "who pays prices moves:": FEW,
    "a body pays twice:": "bodies are no blocks then, or there twice",
    "are listed": FEW,
    "side and unit are powers of two": "sides that are not are asked about in squares of another size, and prove less",
    "a grid of too many nodes": "only memory is at stake",
    "a price at the border": "what one price at the border gains is less than what the prices lack of the result's cost",
    "prices that are too large": FEW,
    "a node that no way leads to": "what no way leads to is asked about by no leaf",
    "slack, where nothing is held to an overlap": FEW,
    "a line beyond where the parts let go of each other": FEW,
    "no ways are heeded by the reason": FEW,
    "a side, where there is no limit": FEW,
    "the way of a bystander:": FEW,
    "a barrier, where there is no limit": FEW,
    "a bystander, where there is no limit:": FEW,
    "what is contained may stay so": FEW,
    "what is in another may go deeper:": FEW,
    "a listed pair is held to more than it had:": FEW,
    "held to what it had, and not listed:": FEW,
    "held to a depth that is not known:": FEW,
    "held to a distance that is more than they owe:": FEW,
    "a force is on another case": TRUE,
    "a line between two that move": FEW,
    "lines that are not opposite to each other": TRUE,
    "two lines of two bodies": FEW,
    "a lattice without a limit": LAYER,
    "there is another place on the line": FEW,
    "a line that is not told exactly": TRUE,
    "a line that the slack may reach by itself": FEW,
    "a coordinate may come to nothing": LAYER,
    "a coordinate may leave its binade": LAYER,
    "a length for those without a limit, and no proof": "no proof uses the length",
    "the reason": FORM, "may not overlap": FORM, "do not overlap": FORM,
    "no proof, and none is found, that": "the verdicts of the runs are true, and found without a proof, too",
    "no solution, and no proof:": "the verdicts of the runs are true without their proofs",
    "jumps are allowed": LAYER,
    "two barriers are called": LAYER,
    "the limit of": LAYER, "the weight of": LAYER,
    "never move": FEW, "are of one block": FEW, "is ignored, or nothing": FEW,
    "there is no": FORM, "that is no anchor of": FORM, "holds the anchor of": FEW, "the side anchor of": FEW,
    "a side is a segment, and has an anchor": FEW, "faces away from": FEW, "sides that share no corner": FEW,
    "two sides on one side of the way through their corner": FEW, "an end of a chord that no side shadows": TRUE,
    "a chord before the corner": FEW,
}


class Switch:
    """demand(), but for the one that is off; says where it was that refused. Off for good is the comparison of the sum with what the
    result costs, which the judge makes, too."""
    off = last = None

    def __call__(self, condition, *words):
        if condition or "is more than what the result costs:" in words:
            return
        caller = sys._getframe(1)
        Switch.last = os.path.basename(caller.f_code.co_filename), caller.f_lineno
        if Switch.last != Switch.off:
            raise form.Refused(" ".join(map(str, words)))


def one_of_each(runs, seed):
    """(number of the run, forgery): one of each kind of change of each member of each kind of line."""
    found = {}
    for k, run in enumerate(runs):
        for what in run.forgeries():
            kind = next((w for w in form.LINES if w in run.lines[what[0]]), "head")
            members = tuple(s for s in what[1] if not isinstance(s, int))
            found.setdefault((k, kind, members, len(what[1]), what[2]), []).append(what)
    drawn = random.Random(seed)
    return [(key[0], drawn.choice(own)) for key, own in found.items()]


def refused_by(runs, drawn):
    """{place of a demand: [(number of the run, forgery)]}"""
    found = defaultdict(list)
    for k, what in drawn:
        Switch.last = None
        if not runs[k].wrong_with(runs[k].make(*what))[1] and Switch.last and Switch.last[0] in MODULES:
            found[Switch.last].append((k, what))
    return found


def places_of():
    """Every demand() of the modules: {(file, line): what it says}"""
    found = {}
    for name, module in MODULES.items():
        with open(module.__file__, encoding="utf-8") as file:
            calls = [n for n in ast.walk(ast.parse(file.read())) if isinstance(n, ast.Call) and getattr(n.func, "id", "") == "demand"]
        for call in sorted(calls, key=lambda c: c.lineno):
            words = [a.value for a in call.args[1:] if isinstance(a, ast.Constant)]
            found[name, call.lineno] = max(words, key=len)
    return found


def ask(runs, place, asked, tries):
    """(what the judge found, how many were accepted, how many asked)"""
    Switch.off, accepted, n = place, 0, 0
    for k, what in asked[:tries]:
        n += 1
        try:
            said, is_accepted = runs[k].wrong_with(runs[k].make(*what))
        except (KeyError, TypeError, ValueError, IndexError, ArithmeticError, RecursionError) as why:
            said, is_accepted = f"the judge stumbles: {why!r}", True
        accepted += is_accepted
        if is_accepted and said:
            break
    else:
        said = None
    Switch.off = None
    return (f"{runs[k].path}, line {what[0] + 1}, {'.'.join(map(str, what[1]))}, {what[2]}: {said}" if said else None), accepted, n


def main(words):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("runs")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--tries", type=int, default=300)
    parser.add_argument("--only", default="")
    options = parser.parse_args(words)
    for module in (*MODULES.values(), result):
        module.demand = Switch()
    with open(options.runs, encoding="utf-8") as file:
        runs = [forgeries.Run(told) for told in json.load(file)]
    found = refused_by(runs, one_of_each(runs, options.seed))
    wrong = 0
    for place, words in places_of().items():
        if options.only not in f"{place[0]} {words}" or words in ENDLESS:
            continue
        said, accepted, n = ask(runs, place, found.get(place, []), options.tries)
        blind = not said and (accepted or not n)
        wrong += blind and words not in UNSEEN
        print("seen  " if said else "others" if not blind else "UNSEEN" if words in UNSEEN else "WRONG ",
              f"{place[0]}:{place[1]}, {words!r}: {accepted} of {n} accepted;", said or UNSEEN.get(words, ""), flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
