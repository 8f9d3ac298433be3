"""Checks a file of --proof in integers and fractions, from the input and the options of the run:

    python3 check_proof.py PROOF INPUT.gpkg [--layer NAME] [options of sunder separate]

Nothing is shared with the program; docs/PROOF.md says what is asked, and why the bound and the verdicts follow. Status
0: all of it holds, with a line that says what; 1: something does not, with what; 2: it cannot be asked.
"""
import argparse
import json
import os
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import geopackage  # noqa: E402
import trees  # noqa: E402
import verdicts  # noqa: E402
from prices import Prices  # noqa: E402
from problem import Problem, Refused, demand  # noqa: E402


def read_options(words):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("proof")
    parser.add_argument("input")
    parser.add_argument("--layer")
    parser.add_argument("--result", help="a GeoPackage with LAYER_displacement, whose lines begin at the anchors, and "
                        "LAYER_conflicts, which the proof lists")
    for name in ("where", "fixed-where", "ignore-where", "max-shift-field", "weight-field", "block-field", "symbol"):
        parser.add_argument("--" + name)
    for name in ("max-shift", "touch-tolerance"):
        parser.add_argument("--" + name, type=float)
    parser.add_argument("--gap", type=float, default=0.0)
    parser.add_argument("--barrier", action="append", default=[])
    parser.add_argument("--contained", default="block")
    parser.add_argument("--weight", default="1")
    parser.add_argument("--no-blocks", action="store_true")
    parser.add_argument("--allow-jumps", action="store_true")
    options = parser.parse_args(words)
    if options.symbol:  # symbols may always jump, and none is part of another
        options.allow_jumps, options.contained = True, "separate"
    return options


def check_header(head, options):
    demand(head.get("sunder_proof") == 1, "no proof of this version")
    limit = head["max_shift"]
    for name, told, given in (("gap", head["gap"], options.gap), ("max_shift", limit, options.max_shift),
                              ("contained", head["contained"], options.contained),
                              ("allow_jumps", head["allow_jumps"], options.allow_jumps)):
        demand(told == given, f"the proof is of another problem: {name} is {told}, and not {given}")


def anchors_of(told):
    """All parts of one corner."""
    if isinstance(told, dict):
        for key, value in told.items():
            if key in "AB" and len(value) == 1:
                yield value[0]
            elif key not in ("ways", "cuts", "forces", "by"):
                yield from anchors_of(value)
    elif isinstance(told, list):
        for value in told:
            yield from anchors_of(value)


def check_anchors(problem, path):
    """The anchors of what moved are the first points of its lines."""
    compared = 0
    for attributes, _, lines in geopackage.Layer(path, problem.name + "_displacement").features.values():
        told = problem.anchors.get(attributes["fid"])
        if told:
            compared += 1
            demand(lines and lines[0][0] == told, "the anchor of", attributes["fid"], "is another in the result")
    return compared


def check_conflicts(problem, conflicts, path):
    """The result lists the same pairs, of the same kinds, for the same reasons."""
    def key(a, b, *more):
        return (*sorted((str(a), str(b))), *more)
    listed = []
    for row, _, _ in geopackage.Layer(path, problem.name + "_conflicts").features.values():
        other = row["fid_b"] if row["barrier"] is None else f"{row['barrier']}:{row['barr_fid']}"
        listed.append(key(row["fid_a"], other, row["kind"], row["reason"]))
    told = [key(c["a"], c["b"], c["kind"], c["reason"]) for c in conflicts]
    demand(sorted(listed) == sorted(told), "the result lists other conflicts")


def check(options):
    with open(options.proof, encoding="utf-8") as file:
        lines = [json.loads(line) for line in file]
    demand(lines, "an empty proof")
    head = lines[0]
    check_header(head, options)
    problem = Problem(options.input, options, list(anchors_of(lines)))
    conflicts = [t for t in lines[1:] if "conflict" in t]
    told = [t for t in lines[1:] if "group" in t]
    demand(len(conflicts) == head["conflicts"] and len(told) == head["trees"], "lines are missing")
    for line in lines[1:]:
        if "block" in line:
            problem.add_block(line["block"])
    problem.listed = {tuple(sorted((str(c["a"]), str(c["b"])))): c["kind"] for c in conflicts if not c.get("inside_block")}
    found = []
    for tree in told:
        found.append((Prices if "prices" in tree else trees.Tree)(problem, tree))
        found[-1].check()
    total = trees.add_up(problem, found)
    by_pairs = head["lower_bound"] > total and head["lower_bound"] == head["pair_bound"]
    demand(by_pairs or total >= head["lower_bound"], "the bound proved is", float(total), "and not",
           head["lower_bound"])
    proved = sum(verdicts.check(problem, c, conflicts) for c in conflicts)
    compared = check_anchors(problem, options.result) if options.result and not options.symbol else 0
    if options.result:
        check_conflicts(problem, conflicts, options.result)
    told_of_pairs = f" (trees prove {float(total):.9g}; the bound of pairs is not asked about)" if by_pairs else ""
    return (f"bound {head['lower_bound']:.9g} of {head['cost']:.9g}{told_of_pairs}: {len(found)} trees, "
            f"{sum(len(t.nodes) for t in found)} nodes, {sum(len(t.cuts) for t in found)} cuts; "
            f"{proved} of {len(conflicts)} conflicts with proofs; {problem.trusted} joins not asked about" +
            (f"; {compared} anchors are those of the result" if options.result else ""))


def main(words):
    options = read_options(words)
    began = time.time()
    try:
        print(f"{check(options)} ({time.time() - began:.1f} s)")
    except Refused as why:
        print(f"refused: {why}")
        return 1
    except (KeyError, TypeError, ValueError, IndexError) as why:
        print(f"refused: not in the form of a proof: {type(why).__name__}: {why}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
