"""Is each of the checker's own tests needed? They are switched off, one at a time, and the files that the test
refused are checked again:

    python3 checks_off.py RUNS DIRECTORY [--seed S] [--tries N] [--only WORDS]

A test is a call of demand() in a file of MODULES. RUNS as in forgeries.py; one change of each kind of each member is
drawn. DIRECTORY receives the layers of false_proofs.py. A file that the test refused is then refused by other tests,
or accepted. A false proof that is accepted shows that the test is needed. So does an accepted forgery in which the
judge finds a false statement, and so does an exception. Tests whose forgeries are accepted without such a finding,
and tests that no file reaches, are listed in UNSEEN with the reason. It is a failure if any other test cannot be
shown to be needed.
"""
import argparse
import ast
import os
import random
import sys
from collections import defaultdict

import bodies
import decided
import eased
import enlarging
import false_proofs
import forgeries
import form
import given_rows
import hiding
import prices
import problem
import result
import rows
import rungs
import trees
import verdicts

MODULES = {m.__name__ + ".py": m for m in (trees, bodies, prices, verdicts, decided, problem, rows, rungs, enlarging, given_rows, eased, hiding)}
ENDLESS = {"a node has two parents:", "a row that branches:"}  # without these tests a search would not end
UNSEEN = {
    "a side, where there is no limit": "of two anchors that lines shut in, but for a narrow way far away: no case is made",
    "a rule without a row": "a run without --rows has no words for rows in its file",
    "a length for those without a limit, with the reason": "without sides and jumps the pair gets apart within such a length, so no nodes reach it",
    "a row without a limit:": "no run has neighbours of which one has a limit and a verdict needs their row",
    "these are no neighbours in a row:": "a line that no statement uses makes none false; rows_proofs.py changes lines that are used",
    "neighbours in a row are missing:": "a file that leaves out neighbours proves its claims without their rule and springs, which is harder",
    "there is no rule for those that do not stand apart:": "no run has neighbours that overlap along their row",
    "the class of": "the forged runs have one gap; class_proofs.py changes classes",
    "is no longer shared": "the judge knows no rungs; hide_mutations.py has a shape that this test alone refuses",
}


class Switch:
    """demand() with one test switched off; records which test refused. One test is always off: the comparison of the
    sum with the cost of the result, which the judge makes, too."""
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
    """{place of a demand: [(number of the run, forgery) that it refuses]}"""
    found = defaultdict(list)
    for k, what in drawn:
        Switch.last = None
        if not runs[k].wrong_with(runs[k].make(*what))[1] and Switch.last and Switch.last[0] in MODULES:
            found[Switch.last].append((k, what))
    return found


def cases_refused_by(cases):
    """{place of a demand: [the false proofs that it refuses]}"""
    found = defaultdict(list)
    for case in cases:
        Switch.last = None
        case.answer()
        found[Switch.last].append(case)
    return found


def places_of():
    """Every demand() of the modules: {(file, line): its message}"""
    found = {}
    for name, module in MODULES.items():
        with open(module.__file__, encoding="utf-8") as file:
            calls = [n for n in ast.walk(ast.parse(file.read())) if isinstance(n, ast.Call) and getattr(n.func, "id", "") == "demand"]
        for call in sorted(calls, key=lambda c: c.lineno):
            words = [a.value for a in call.args[1:] if isinstance(a, ast.Constant)]
            found[name, call.lineno] = max(words, key=len, default="")
    return found


EXCEPTIONS = KeyError, TypeError, ValueError, IndexError, ArithmeticError, RecursionError, MemoryError


def ask(runs, place, asked, tries):
    """Returns (what the judge found, how many were accepted, how many were checked)."""
    Switch.off, accepted, n = place, 0, 0
    for k, what in asked[:tries]:
        n += 1
        try:
            said, is_accepted = runs[k].wrong_with(runs[k].make(*what))
        except EXCEPTIONS as why:
            said, is_accepted = f"the judge stumbles: {why!r}", True
        accepted += is_accepted
        if said:
            break
    else:
        said = None
    Switch.off = None
    return (f"{runs[k].path}, line {what[0] + 1}, {'.'.join(map(str, what[1]))}, {what[2]}: {said}" if said else None), accepted, n


def ask_false(place, cases):
    """The name of the first of these that is accepted, or that ends in an exception."""
    Switch.off = place
    for case in cases:
        try:
            status, said = case.answer()
        except EXCEPTIONS:
            status, said = 0, ""
        if status != 1 or "not in the form of a proof" in said:
            break
    else:
        case = None
    Switch.off = None
    return case and case.name


def main(words):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("runs")
    parser.add_argument("directory")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--tries", type=int, default=300)
    parser.add_argument("--only", default="")
    options = parser.parse_args(words)
    for module in (*MODULES.values(), result):
        module.demand = Switch()
    runs = forgeries.read_runs(options.runs)
    found, wrong = refused_by(runs, one_of_each(runs, options.seed)), 0
    false = cases_refused_by(false_proofs.prepared(options.directory))
    for place, words in places_of().items():
        if options.only not in f"{place[0]} {words}" or words in ENDLESS:
            continue
        said, accepted, n = ask_false(place, false.get(place, [])), 0, 0
        if not said:
            said, accepted, n = ask(runs, place, found.get(place, []), options.tries)
        blind = not said and (accepted or not n)
        wrong += blind and words not in UNSEEN
        print("seen  " if said else "others" if not blind else "UNSEEN" if words in UNSEEN else "WRONG ",
              f"{place[0]}:{place[1]}, {words!r}: {accepted} of {n} accepted;", said or UNSEEN.get(words, ""), flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
