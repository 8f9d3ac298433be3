"""The clauses in a file of --proof with --hide, and its checker (tests/proof/check_proof.py) called for a run."""
import json
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "proof"))
import check_proof  # noqa: E402
import form  # noqa: E402


class Clauses:
    """The proved clauses, each as (the features that may be hidden, all things of the conflict and its proof), and the bound by class."""

    def __init__(self, proof):
        lines = [json.loads(line) for line in open(proof)]
        self.proof, self.bound = proof, {1 << 40 if c is None else c: w for c, w in lines[0]["hide"]["bound"]}
        self.all = [([fid for fid, _ in line["members"]], self.things(line)) for line in lines if "clause" in line]

    @staticmethod
    def things(line):
        named = {line["a"], line["b"], *(fid for fid, _ in line["members"])}
        for node in line.get("proof", ()):
            named |= {node[key] for key in "abc" if key in node}
        return named

    def is_above(self, best):
        """Is the bound more than these weights, by class?"""
        classes = sorted({*self.bound, *best})
        return [self.bound.get(c, 0) for c in classes] > [best.get(c, 0) for c in classes]

    def refused(self, source, words):
        """What the checker finds wrong, as a list of at most one sentence; words: the options of separate."""
        options = check_proof.read_options([self.proof, source, *words])
        status, said = check_proof.answer(check_proof.Checker(options), lambda: form.File(self.proof))
        return [] if status == 0 else [said]
