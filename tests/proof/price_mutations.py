"""The changes that mutations.py makes to a line with prices. Each function returns False if the line has no value of
its kind, otherwise the words of the expected refusal."""
import copy

FALLS_SHORT = "the prices prove"


def raise_node(line):
    """A price so high that no body would be there, so that the bound is useless."""
    row = max(line["prices"]["rows"], key=lambda r: max(r[1:], default=0))
    at = max(range(1, len(row)), key=row.__getitem__)
    row[at] *= 1000
    return (FALLS_SHORT,)


def sink_node(line):
    row = max(line["prices"]["rows"], key=len)
    row[1] = -1
    return ("whole numbers",)


def raise_claim(line):
    line["bound"] *= 1.05
    return (FALLS_SHORT,)


def raise_unit(line):
    line["prices"]["unit"] *= 8
    return (FALLS_SHORT,)


def odd_side(line):
    line["prices"]["side"] *= 1.5
    return ("power of two",)


def halve_side(line):
    line["prices"]["side"] /= 2
    return (FALLS_SHORT,)


def move_grid(line):
    line["prices"]["x"] += 7
    return (FALLS_SHORT,)


def pay_twice(line):
    line["bodies"].append(copy.deepcopy(line["bodies"][0]))
    return ("there twice",)


def leave_out(line):
    """Removes every third body, while the bound stays."""
    del line["bodies"][::3]
    return (FALLS_SHORT,)


def shift_body(line):
    line["bodies"][0]["shift"] = [1, 0]
    return ("has no shift",)


def part_block(line):
    """Members of a block that pay separately."""
    for body in line["bodies"]:
        if len(body["features"]) > 1:
            other = copy.deepcopy(body)
            other["features"] = [body["features"].pop()]
            body["weight"] = other["weight"] = 1
            line["bodies"].append(other)
            return ("no block",)
    return False


PRICES = {"price": raise_node, "price below 0": sink_node, "raised prices": raise_claim, "raised unit": raise_unit,
          "odd side": odd_side, "halved side": halve_side, "moved grid": move_grid, "payer twice": pay_twice, "left out": leave_out,
          "shifted payer": shift_body, "parted block": part_block}
