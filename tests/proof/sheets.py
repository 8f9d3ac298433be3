"""A sheet (--spec) as the premises of a proof: options, layers that do not move, and gaps by classes. This is a reading of its own, as
docs/ describe a sheet."""
import json
import os
import re

import geopackage
from form import NotRead

COMMENT = re.compile(r'"(?:[^"\\]|\\.)*"|/\*.*?\*/|//[^\n]*', re.DOTALL)
OTHERS = 0  # the class of what no rule names


def without_comments(text):
    return COMMENT.sub(lambda found: found[0] if found[0][0] == '"' else " ", text)


def words_of(rules):
    """Rules as options."""
    for key, value in rules.items():
        option = "--" + key.replace("_", "-")
        if value is True:
            yield option
        elif value is not False and value is not None:
            yield f"{option}={','.join(map(str, value)) if isinstance(value, list) else value}"


class Sheet:
    OWN = ("name", "source", "layer", "role", "class", "crs", "comment")

    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            self.told = json.loads(without_comments(file.read()))
        self.directory, self.rules = os.path.dirname(path), self.told.get("gaps", [])
        self.names = list(dict.fromkeys(name for rule in self.rules for name in rule["between"] if name != "*"))
        moving = [layer for layer in self.told["layers"] if layer["role"] == "move"]
        if len(moving) != 1:
            raise NotRead(f"{path} has {len(moving)} layers that move")
        self.moving = moving[0]
        leading = 0
        while leading < len(self.rules) and self.rules[leading]["between"] == ["*", "*"]:
            leading += 1
        self.common, self.rules = self.rules[:leading], self.rules[leading:]

    def words(self):
        """The options that it stands for, the weaker ones first."""
        yield from words_of(self.told.get("defaults", {}))
        yield from words_of({key: value for key, value in self.moving.items() if key not in self.OWN})
        for rule in self.common:
            yield from words_of({"gap": rule.get("gap"), "least_gap": rule.get("least")})
        if "scale" in self.told:
            yield f"--scale={self.told['scale']}"
        if "layer" in self.moving:
            yield f"--layer={self.moving['layer']}"

    def barriers(self):
        """As problem.split_spec() has them, with `widths`: (field, lengths by value), and `class`."""
        for layer in self.told["layers"]:
            if layer["role"] not in ("barrier", "fixed"):
                continue
            found = {"path": os.path.join(self.directory, layer["source"]), "where": layer.get("where"), "of": layer}
            side = layer.get("side", layer["role"] == "barrier")
            found.update({key: layer[key] for key in ("layer", "as") if key in layer}, side="yes" if side in (True, "yes") else "no")
            width = layer.get("width", 0)
            if isinstance(width, dict) and "field" in width:
                found["width-field"] = width["field"]
            elif isinstance(width, dict):
                found["widths"], found["width"] = (width["by"], width["of"]), width.get("else", 0)
            else:
                found["width"] = width
            yield found

    def class_of(self, layer, attributes):
        """The number of a feature's class, by the layer of the sheet that it is in."""
        name = layer.get("class", layer.get("name"))
        if isinstance(name, dict):
            name = geopackage.value_of(attributes, name["field"])
        return 1 + self.names.index(str(name)) if str(name) in self.names else OTHERS


class Gaps:
    """The tables of full and least gaps, in doubles, from the lengths of a sheet. units: converts lengths; gap, least: those of pairs
    that no rule is about, `least` perhaps None."""

    def __init__(self, sheet, units, gap, least):
        self.names = sheet.names
        n = 1 + len(sheet.names)
        self.full, self.least = ([[v] * n for _ in range(n)] for v in (gap, least))
        for rule in sheet.rules:
            for table, key in ((self.full, "gap"), (self.least, "least")):
                if key in rule:
                    self.put(table, rule["between"], units(rule[key], "--spec: gaps"))
        self.least = [[f if v is None else v for f, v in zip(*rows)] for rows in zip(self.full, self.least)]
        if any(v > f for rows in zip(self.least, self.full) for v, f in zip(*rows)):
            raise NotRead("a least gap that is greater than the gap")
        self.has_slack = self.least != self.full

    def put(self, table, between, value):
        n = len(table)
        one, other = (range(n) if name == "*" else [1 + self.names.index(name)] for name in between)
        for i in one:
            for j in other:
                table[i][j] = table[j][i] = value

    def told(self):
        """What the first line of a proof has to say."""
        def half(table):
            return [row[:k + 1] for k, row in enumerate(table)]
        return {"classes": self.names, "gaps": half(self.full), "least_gaps": half(self.least) if self.has_slack else None}
