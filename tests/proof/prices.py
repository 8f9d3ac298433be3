"""The lower bound by prices of area: docs/PROOF.md, section 5, in integers."""
from array import array
from fractions import Fraction
from functools import lru_cache
from math import isqrt

from bodies import Bodies
from occupied import MASS, Lattice, in_squares, masses
from form import demand, shown

PARTS = 8      # each square of moves is divided into PARTS x PARTS parts
MOST_NODES = 1 << 26
BORDER = 2     # width of the border of the grid, in nodes, where prices are 0, as they are beyond
FIRST_LOOK = 8  # range of moves that is examined first, in squares; a greater one if that does not suffice


def is_power_of_two(value):
    return value > 0 and value.numerator & (value.numerator - 1) == value.denominator & (value.denominator - 1) == 0


class Prices(Bodies):
    """Has the interface of a tree."""
    nodes, cuts = (), ()

    def __init__(self, problem, told):
        super().__init__(problem, told)
        self.grid = Grid(told["prices"])

    def check(self):
        """The sum of the least costs of the bodies, minus the price of all area."""
        self.demand_strangers()
        parts = PARTS ** 2
        paid = sum(self.least(body, weight) for body, weight in zip(self.bodies, self.weights))
        worth = sum(map(sum, self.grid.price)) << MASS
        proved = (paid - parts * worth) * self.grid.unit * self.grid.side ** 2 / (parts << MASS)
        demand(proved >= self.bound, "the prices prove", shown(proved), "and not", shown(self.bound))
        return self.bound

    def least(self, body, weight):
        found = self.masses_of(body)
        if not found:
            return 0
        limit = self.problem.body_limit(body)
        weight = (weight * (1 << MASS) / self.grid.unit).__floor__()
        demand(weight > 0, "a body weighs too little for the unit of prices")
        return Payer(self.grid, *found, weight, limit).least()

    def masses_of(self, body):
        """The area that a body occupies, by squares with the side of the grid's; cached for further lines. None: it
        occupies no square."""
        problem, side = self.problem, self.grid.side
        if (body, side) not in problem.occupied:
            lattice = Lattice(problem, side, problem.least_gap_of(body))
            squares = in_squares([p for fid in body for p in problem.things[fid].polygons], lattice)
            problem.occupied[body, side] = masses(squares, lattice) if squares else None
        return problem.occupied[body, side]

    # ---- Pairs of bodies that have to keep the gap

    def demand_strangers(self):
        """Every feature has to keep the gap to the features of all other bodies; between two fixed bodies there is no
        requirement."""
        problem, of = self.problem, {}
        demand(sum(problem.body_limit(body) == 0 for body in self.bodies) < 2, "two who pay prices stand still")
        demand(problem.options.contained != "ignore", "features may lie in each other, and owe nothing then")
        for k, body in enumerate(self.bodies):
            demand(self.weights[k] is not None, "who pays prices moves:", *body)
            demand(self.shifts[k] == (0, 0), "who pays prices has no shift:", *body)
            for fid in body:
                of[fid] = k
        by_name = {str(fid): k for fid, k in of.items()}
        for a, b in problem.listed:
            demand(not (a in by_name and b in by_name) or by_name[a] == by_name[b], a, "and", b, "are listed")


class Grid:
    """Prices at nodes, and their convexity in squares."""

    def __init__(self, told):
        self.side, self.unit = Fraction(told["side"]), Fraction(told["unit"])
        demand(is_power_of_two(self.side), "side is a power of two")
        self.x, self.y = told["x"] - BORDER, told["y"] - BORDER
        self.columns = max([told["columns"], *(row[0] + len(row) - 1 for row in told["rows"] if row)])
        demand(self.columns * len(told["rows"]) <= MOST_NODES, "a grid of too many nodes")
        nothing = [[0] * (self.columns + 2 * BORDER)] * BORDER
        self.price = [*nothing, *map(self.read_row, told["rows"]), *nothing]
        self.kink = find_kinks(self.price)
        self.price_rows, self.kink_rows = ([array("Q", row) for row in what] for what in (self.price, self.kink))

    def read_row(self, told):
        demand(all(0 <= n < 1 << 32 for n in told), "prices are whole numbers from 0 to 2^32 - 1")
        before = told[0] if told else 0
        after = self.columns - before - len(told[1:])
        return [0] * (BORDER + before) + told[1:] + [0] * (after + BORDER)


def find_kinks(price):
    """For each square, by its lower left node: the greatest convex second difference of the prices along x and along
    y, over three neighbouring nodes. It is 0 at the border and beyond."""
    along = [[max(0, a - 2 * b + c) for a, b, c in zip(r, r[1:], r[2:])] for r in price]
    up = [[max(0, a - 2 * b + c) for a, b, c in zip(p, q, r)] for p, q, r in zip(price, price[1:], price[2:])]
    return [[max(x) + max(y) for x, y in zip(zip(p, q, r), zip(u, u[1:], u[2:]))]
            for p, q, r, u in zip(along, along[1:], along[2:], up)]


class Payer:
    """A body and its costs: `weight` times the square of its move (in squares), and the price of the area that it
    occupies. Let h be the price at one of its points during moves from (x, y) to (x + 1, y + 1). Along one axis h is
    linear except for one bend, by d, at a node; if the bend is convex, h is at most d / 4 below its chord. So h is
    at least the bilinear mean of its values at the four corners minus (d + d') / 4, where d and d' are the greatest
    bends that the point's square meets there. The same holds for the sum over all points, and |t|^2 is below its own
    bilinear mean by at most half the square of the side of a part."""

    def __init__(self, grid, corner, hats, areas, weight, limit):
        self.grid, self.hats, self.areas = grid, hats, areas
        self.at = corner[0] - grid.x, corner[1] - grid.y
        self.weight = weight
        # greatest length of a move, in squares, squared
        self.limit = None if limit is None else (Fraction(limit) / grid.side) ** 2

    def sums(self, rows, own, reach):
        """[dy][dx]: the sum of own[j][i] times the entry of `rows` at (i, j) moved by (dx, dy), from -reach to reach.
        The product of two rows is computed as a product of two integers, whose digits are the entries of the rows."""
        width, (x, y) = len(own[0]), self.at
        top = max(map(max, own)) * max((max(r, default=0) for r in rows), default=0)
        size = 1 if top * width * len(own) < 1 << 63 else 2  # of a digit, in units of 64 bits
        digits = [number(array("Q", row[::-1]), size) for row in own]
        window = {}
        for j in range(max(0, y - reach), min(len(rows), y + len(own) + reach)):
            window[j] = number(cut_out(rows[j], x - reach, width + 2 * reach), size)
        found = []
        for dy in range(-reach, reach + 1):
            total = sum(d * window.get(y + dy + j, 0) for j, d in enumerate(digits) if d)
            slots = array("Q", total.to_bytes(8 * size * (2 * width + 2 * reach), "little"))
            if size == 2:
                slots = [low + (high << 64) for low, high in zip(slots[::2], slots[1::2])]
            found.append(slots[width - 1:width + 2 * reach])
        return found

    def may_go(self, square):
        return self.limit is None or square <= self.limit

    def least(self):
        """A lower bound of the body's cost over all its moves, in units of a mass times a price unit."""
        weight, reach = self.weight, FIRST_LOOK
        while True:
            price = self.sums(self.grid.price_rows, self.hats, reach)
            spent = min(weight * (x * x + y * y) + price[y + reach][x + reach] for y in range(-reach, reach + 1)
                        for x in range(-reach, reach + 1) if self.may_go(x * x + y * y))
            need = isqrt(spent // weight) + 2
            if self.limit is not None:
                need = min(need, isqrt(self.limit.__floor__()) + 2)
            if need <= reach:
                break
            reach = min(need, 2 * reach)
        return self.least_of_squares(price, reach, PARTS ** 2 * spent)

    def least_of_squares(self, price, reach, least):
        """`least`: a lower bound of the cost of an allowed move."""
        weight, parts = self.weight, PARTS ** 2
        kinks = self.sums(self.grid.kink_rows, self.areas, reach)
        asked = []
        for y in range(-reach, reach):
            lower, upper = price[y + reach], price[y + reach + 1]
            for x in range(-reach, reach):
                square = max(x, -x - 1) ** 2 + max(y, -y - 1) ** 2  # of its nearest place
                if parts * weight * square >= least or not self.may_go(square):
                    continue
                k = x + reach
                less = parts // 4 * kinks[y + reach][k]
                corners = lower[k], lower[k + 1], upper[k], upper[k + 1]
                roughly = parts * (weight * square + min(corners)) - less
                if roughly < least:
                    asked.append((roughly, x, y, corners, less, parts * weight * square))
        asked.sort()
        for roughly, x, y, corners, less, way in asked:
            if roughly >= least:
                break
            paid = least_of_parts(x, y, corners, weight) - (weight + 1) // 2 - less
            least = min(least, max(roughly, way, paid))
        return least


@lru_cache(1 << 16)
def least_of_parts(x, y, corners, weight):
    """The minimum over the corners of the parts of a square."""
    a, b, c, d = corners
    found = []
    for v in range(PARTS + 1):
        left, right, up = (PARTS - v) * a + v * c, (PARTS - v) * b + v * d, weight * (PARTS * y + v) ** 2
        found += [(PARTS - u) * left + u * right + weight * (PARTS * x + u) ** 2 + up for u in range(PARTS + 1)]
    return min(found)


def cut_out(row, start, n):
    """n entries from there on, 0 where the row has none."""
    before = min(max(0, -start), n)
    own = row[max(start, 0):max(start + n, 0)]
    return array("Q", bytes(8 * before)) + own + array("Q", bytes(8 * (n - before - len(own))))


def number(digits, size):
    """The integer with these digits, each of `size` times 64 bits."""
    if size == 2:
        wide = array("Q", bytes(16 * len(digits)))
        wide[::2] = digits
        digits = wide
    return int.from_bytes(digits.tobytes(), "little")
