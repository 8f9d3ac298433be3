"""The clauses in a file of --proof with --hide, and its checker (tests/proof/check_proof.py) called for a run."""
import json
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "proof"))
import check_proof  # noqa: E402
import form  # noqa: E402


class Clauses:
    """The proved clauses, each as (the features that may be hidden, all things of the conflict and its proof); the bound by class; and the
    trees, each as (one of its features, its bound by class)."""

    def __init__(self, proof):
        lines = [json.loads(line) for line in open(proof)]
        self.proof, self.bound = proof, self.vector(lines[0]["hide"]["bound"])
        self.all = [([fid for fid, _ in line["members"]], self.things(line)) for line in lines if "clause" in line]

        self.trees = [(self.feature_of(line["nodes"][0]), self.vector(line["bound"])) for line in lines if "choice" in line]

    @staticmethod
    def vector(told):
        return {1 << 40 if c is None else c: w for c, w in told}

    def feature_of(self, node):
        """A feature of the tree with this first node."""
        clause = node["unmet"] if "unmet" in node else node["shares"][0][0] if "shares" in node else None
        return node["split"] if clause is None else self.all[clause][0][0]

    def bound_of(self, fids):
        """What has to be hidden of these features, by class."""
        found = {}
        for fid, bound in self.trees:
            for c, weight in bound.items() if fid in fids else ():
                found[c] = found.get(c, 0) + weight
        return found

    @staticmethod
    def things(line):
        named = {line["a"], line["b"], *(fid for fid, _ in line["members"])}
        for node in line.get("proof", ()):
            named |= {node[key] for key in "abc" if key in node}
        return named

    @staticmethod
    def is_above(bound, best):
        """Is the bound more than these weights, by class?"""
        classes = sorted({*bound, *best})
        return [bound.get(c, 0) for c in classes] > [best.get(c, 0) for c in classes]

    def refused(self, source, words):
        """What the checker finds wrong, as a list of at most one sentence; words: the options of separate."""
        options = check_proof.read_options([self.proof, source, *words])
        status, said = check_proof.answer(check_proof.Checker(options), lambda: form.File(self.proof))
        return [] if status == 0 else [said]
