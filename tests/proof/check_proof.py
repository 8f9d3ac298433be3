"""Checks a file of --proof in integers and fractions, from the input and the options of the run:

    python3 check_proof.py PROOF INPUT [--layer NAME] [options of sunder separate]

It shares no code with the program. docs/PROOF.md says what is checked, and why the bound and the verdicts follow.
Status 0: all claims are valid, and a line says what was checked. Status 1: a claim is not valid, and a line says
which. Status 2: the file cannot be checked.
"""
import argparse
import os
import sqlite3
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import geopackage  # noqa: E402
import form  # noqa: E402
import trees  # noqa: E402
import verdicts  # noqa: E402
from eased import Eased  # noqa: E402
from enlarging import Enlarging  # noqa: E402
from form import NotRead, Refused, demand, shown  # noqa: E402
from given_rows import GivenRows  # noqa: E402
from hiding import Hiding  # noqa: E402
from prices import Prices  # noqa: E402
from problem import Problem  # noqa: E402
from result import Result
from rows import Rows  # noqa: E402
from sheets import Sheet  # noqa: E402


def read_options(words):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("proof")
    parser.add_argument("input", help="a GeoPackage, or whatever ogr2ogr reads")
    parser.add_argument("--layer", "--input-layer", "-l")
    parser.add_argument("--result", help="a GeoPackage with what separate wrote: LAYER, LAYER_displacement, "
                        "LAYER_conflicts; its moves cost what they cost")
    for name in ("sql", "dialect", "bbox", "input-crs", "where", "fixed-where", "ignore-where", "max-shift-field", "weight-field",
                 "rigid-where", "block-field", "symbol", "symbol-field", "symbol-size-field", "scale"):
        parser.add_argument("--" + name)
    parser.add_argument("--spec", help="the sheet of the run; other options replace what it says")
    for name in ("max-shift", "touch-tolerance", "least-gap"):
        parser.add_argument("--" + name)
    parser.add_argument("--gap", default="0")
    parser.add_argument("--barrier", action="append", default=[])
    parser.add_argument("--contained")
    parser.add_argument("--invalid", default="repair")
    parser.add_argument("--weight", default="1")
    parser.add_argument("--rows", help="auto, no or FIELD; auto unless said, no for points")
    parser.add_argument("--row-stiffness", default="3,0.3")
    parser.add_argument("--ease", default="30")
    parser.add_argument("--no-blocks", action="store_true")
    parser.add_argument("--allow-jumps", action="store_true")
    parser.add_argument("--hide", action="store_true")
    parser.add_argument("--hierarchy-field")
    parser.add_argument("--crossed", choices=("keep", "trim", "hide"), default="keep")
    parser.add_argument("--hide-weight", choices=("1", "area", "sqrt-area"), default="sqrt-area")
    parser.add_argument("--trim", action="store_true")
    parser.add_argument("--trim-keep", type=float, default=0.5)
    parser.add_argument("--inset", default="")
    parser.add_argument("--symbol-size")
    parser.add_argument("--enlarge", action="store_true")
    parser.add_argument("--min-size", help="not verified of smaller shapes")
    for name in ("effort", "seed", "id-field", "threads"):
        parser.add_argument("--" + name, help="no part of what is claimed")
    options = parser.parse_args(words)
    options.sheet = Sheet(options.spec) if options.spec else None
    if options.sheet:
        own = {name for name, value in vars(options).items() if value != parser.get_default(name)}
        options.sheet.alone = own <= {"proof", "input", "spec", "sheet", "layer", "result"}
        options = parser.parse_args([*options.sheet.words(), *words], argparse.Namespace(sheet=options.sheet))
    options.points = bool(options.symbol or options.symbol_field)  # symbols may always jump
    options.allow_jumps = options.allow_jumps or options.points
    options.rows = options.rows or ("no" if options.points else "auto")
    stiffness = list(map(float, options.row_stiffness.split(",")))
    options.row_stiffness = (stiffness + [0.3])[:2] if options.rows != "no" else None
    options.rows_field = options.rows if options.rows not in ("auto", "no") else None
    options.ease = None if options.ease == "no" else float(options.ease)
    options.contained = options.contained or ("separate" if options.points else "block")
    return options


def check_header(head, options, layer, gaps):
    told_of_classes = gaps.told() if gaps else {}
    if options.sheet and options.sheet.alone:
        demand(head.get("spec") == options.sheet.told, "the proof is of another sheet")
    for name, told, given in (("layer", head["layer"], layer), ("gap", head["gap"], options.gap),
                              ("least_gap", head.get("least_gap"), options.least_gap),
                              ("max_shift", head["max_shift"], options.max_shift),
                              ("contained", head["contained"], options.contained),
                              ("allow_jumps", head["allow_jumps"], options.allow_jumps),
                              ("row_stiffness", head.get("row_stiffness"), options.row_stiffness),
                              ("ease", head.get("ease"), options.ease),
                              *((name, head.get(name), told_of_classes.get(name)) for name in ("classes", "gaps", "least_gaps"))):
        demand(told == given, f"the proof is of another problem: {name} is {told}, and not {given}")


class Checker:
    """Checks files of --proof with the options of one run."""

    def __init__(self, options):
        self.problem = Problem(options.input, options)
        self.enlarging = Enlarging(self.problem, self.problem.options.min_size) if options.enlarge else None
        if not self.enlarging:
            self.begin()
        self.hiding = Hiding(self.problem, self.problem.options) if self.problem.makes_room() else None
        self.known, self.kept, self.held = {}, set(), {}
        self.result = Result(self.problem, options.result) if options.result else None

    def begin(self):
        """Finds what depends on the shapes at the level 0."""
        problem, options = self.problem, self.problem.options
        if options.row_stiffness:
            problem.rows = (GivenRows if options.rows_field else Rows)(problem, options.row_stiffness)
        problem.eased = Eased(problem, options.ease)

    def check(self, lines):
        """lines: an iterable of JSON objects, read twice. Returns a description of what was verified."""
        proof, problem = form.Proof(lines, self.known), self.problem
        check_header(proof.head, problem.options, problem.name, problem.gaps)
        problem.blocks.demand_all(proof.blocks)
        demand(("hide" in proof.head) == bool(self.hiding), "the proof is of another problem, with or without hidden features")
        demand(("larger" in proof.head.get("hide", {})) == bool(self.enlarging), "the proof is of another problem, with or without larger features")
        if self.enlarging and (problem.set_larger(self.enlarging.read(proof.larger)) or not problem.eased):
            self.begin()
        if self.hiding:
            self.hiding.begin(proof.hidden)
            self.hiding.read_shapes(proof.shapes)
        problem.list_conflicts(proof.conflicts)
        problem.eased.list_conflicts(proof.conflicts)
        demand(problem.rows or not proof.rows, "rows, where none are looked for")
        if problem.rows:
            problem.rows.demand_all(proof.rows)
        if self.hiding:
            problem.set_levels(self.hiding.taken)
        listed = repr((sorted(problem.listed.items()), proof.rows, proof.hidden, proof.larger, proof.shapes, sorted((str(c["a"]), str(c["b"]), c["reason"]) for c in proof.conflicts)))
        found, proved = [], 0
        for key, told in proof.statements():
            if key == "group":
                found.append(self.once(told, listed, self.check_tree))
            elif key == "clause":
                self.hiding.clauses.append(self.once(told, listed, self.hiding.check_clause))
            elif key == "choice":
                self.hiding.add_choice(self.hiding.check_choice(told))
            else:
                proved += self.once(told, listed, self.check_verdict)
        total, bound = trees.add_up(found) + problem.eased.rest({pair for tree in found for pair in tree.prices}), proof.head["lower_bound"]
        demand(total >= bound, "the bound proved is", shown(total), "and not", bound)
        said = (f"bound {bound:.9g}: {len(found)} trees, {sum(t.nodes for t in found)} nodes, {sum(t.cuts for t in found)} cuts; "
                f"{len(proof.blocks)} blocks; {proved} of {sum(c['kind'] != 'tight' for c in proof.conflicts)} conflicts with proofs; ")
        said += self.hiding.end(proof.head["hide"]) if self.hiding else ""
        return said + (self.result.check(proof.conflicts, total) if self.result else "the list of conflicts is the file's own")

    def keep(self, lines):
        """Later calls do not read these lines again, which stay unchanged; and if they were verified beside the same
        list of conflicts, they are not verified again."""
        self.known = dict(zip(map(id, lines), [found for _, found in form.Proof(lines, {}).entries()]))
        self.kept = {id(line) for line in self.known.values()}

    def once(self, line, listed, check):
        key = id(line), listed
        if key in self.held:
            return self.held[key]
        found = check(line)
        if id(line) in self.kept:
            self.held[key] = found
        return found

    def check_tree(self, told):
        tree = (Prices if "prices" in told else trees.Tree)(self.problem, told)
        tree.check()
        return tree.proved()

    def check_verdict(self, told):
        return verdicts.check(self.problem, told)


def answer(checker, lines):
    """Returns (status, message)."""
    try:
        return 0, checker.check(lines())
    except Refused as why:
        return 1, f"refused: {why}"
    except (NotRead, OSError) as why:
        return 2, f"not asked about: {why}"
    # cannot happen if form.py checked all members and types
    except (KeyError, TypeError, ValueError, IndexError, ArithmeticError, RecursionError) as why:
        return 1, f"refused: not in the form of a proof: {type(why).__name__}: {why}"


def printable(said):
    """The text on one line, whatever names the file contains."""
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in said)


def main(words):
    options, began = read_options(words), time.time()
    try:
        checker = Checker(options)
    except (NotRead, Refused, KeyError, ValueError, ArithmeticError, OSError, sqlite3.Error) as why:
        print(printable(f"not asked about: {why}"))
        return 2
    status, said = answer(checker, lambda: form.File(options.proof))
    print(printable(said) + ("" if status else f" ({time.time() - began:.1f} s)"))
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
