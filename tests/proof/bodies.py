"""The premises of a line of the lower bound: its bodies, their weights in this line, and their shifts."""
from collections import namedtuple
from fractions import Fraction

from form import demand


# The data that are kept of a tree, or of prices, after it was verified.
Proved = namedtuple("Proved", "group bound bodies weights shifts own_weight nodes cuts springs prices")


class Bodies:
    def __init__(self, problem, told):
        self.problem, self.unit = problem, problem.lattice.unit
        self.group, self.bound = told["group"], Fraction(told["bound"])
        self.own_weight = {}
        self.bodies = [self.read_body(b) for b in told["bodies"]]
        # a barrier may occur once for each of its parts
        features = [b for b, t in zip(self.bodies, told["bodies"]) if "features" in t]
        demand(len(set(features)) == len(features), "a body is there twice")
        self.weights = [self.read_weight(b, k) for k, b in enumerate(told["bodies"])]
        self.shifts = [tuple(map(Fraction, b["shift"])) for b in told["bodies"]]
        for weight, shift in zip(self.weights, self.shifts):
            demand(weight is not None or shift == (0, 0), "what does not move has a shift")

    def read_body(self, told):
        if "barrier" in told:
            demand(self.problem.is_barrier(told["barrier"]), "there is no barrier", told["barrier"])
            self.problem.demand_class(told["barrier"], told)
            return (told["barrier"],)
        fids = tuple(f["fid"] for f in told["features"])
        for f in told["features"]:
            self.problem.demand_feature(f)
        demand(fids == self.problem.block(fids[0]), "a body is no block:", *fids)
        return fids

    def read_weight(self, told, k):
        """The weight; None: the body does not move."""
        if "barrier" in told:
            demand(told["weight"] is None, "a barrier has a weight")
            return None
        if told["weight"] is None:
            demand(self.problem.body_limit(self.bodies[k]) == 0, "a body that may move is taken for a fixed one")
            return None
        own = sum(Fraction(self.problem.weight(f["fid"])) for f in told["features"])
        self.own_weight[self.bodies[k]] = own
        return Fraction(told["weight"])

    def proved(self):
        return Proved(self.group, self.bound, self.bodies, self.weights, self.shifts, self.own_weight, len(self.nodes), len(self.cuts), (), ())
