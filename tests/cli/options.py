"""Reads the output of --options-json on stdin. Compares it with --help (`help`: files help.COMMAND), or prints calls
that the parser has to refuse with a message that shows that it knows the option (`calls`: a pattern of the message,
the command, the option)."""
import json
import re
import sys

KEYS = ["name", "aliases", "kind", "values", "metavar", "repeatable", "needed", "needs", "default", "default_text", "group", "help"]
KINDS = {"flag", "text", "layer", "field", "sql", "statement", "shape", "point", "dataset", "output", "file", "format", "crs",
         "enum", "enums", "length", "integer", "number", "scale", "box", "flag_or_enum", "barrier", "setting"}
GROUPS = {"command", "identity", "places", "room", "features", "output", "trouble", "running", "hidden"}
LISTED_WITH_WORDS = {"command", "identity"}
trouble = []


def as_in_help(option):
    """--gap LENGTH (other spellings) [default]; options with a fixed set of values show no other spellings."""
    text = option["name"]
    if option["metavar"]:
        text += "[=%s]" % option["metavar"] if option["kind"] == "flag_or_enum" else " " + option["metavar"]
    if option["aliases"]:
        text += " (%s)" % ", ".join(option["aliases"])
    if option["default_text"]:
        text += " [%s]" % option["default_text"]
    return text


def compare(command):
    lines = open("help." + command["name"]).read().splitlines()
    if lines[0] != "Usage: sunder %s [options] %s" % (command["name"], " ".join(
            o["name"] if o["needed"] else "[%s]" % o["name"] for o in command["operands"])):
        trouble.append("usage of %s: %s" % (command["name"], lines[0]))
    if lines[1] != command["summary"] + ".":
        trouble.append("summary of %s: %s" % (command["name"], lines[1]))
    flat = " ".join(line.strip() for line in lines)
    for option in command["options"]:
        where = "%s %s: " % (command["name"], option["name"])
        if list(option) != KEYS or option["kind"] not in KINDS or option["group"] not in GROUPS:
            trouble.append(where + "keys, kind or group")
        if option["group"] == "hidden":
            continue
        if option["group"] in LISTED_WITH_WORDS:
            words = option["name"] + (" " + option["metavar"] if option["metavar"] else "")
            said = option["help"] + (" [%s]" % option["default_text"] if option["default_text"] else "")
            found = any(line.startswith("  " + words + " ") and line.endswith(" " + said) for line in lines)
        else:
            found = re.search(r"(^| )%s(,|$| )" % re.escape(as_in_help(option)), flat)
        if not found:
            trouble.append(where + "not so in --help")
    listed = set(re.findall(r"(?:(?<=  )|(?<=, ))--[a-z-]+", "\n".join(l for l in lines if l.startswith("  "))))
    known = {name for option in command["options"] for name in [option["name"]] + option["aliases"]}
    if listed - known:
        trouble.append("%s: --help alone has %s" % (command["name"], " ".join(sorted(listed - known))))


A_VALUE = {"length": "1", "integer": "1", "number": "1", "scale": "1", "box": "0,0,1,1", "setting": "A=B"}


def calls(command):
    for option in command["options"]:
        for name in [option["name"]] + option["aliases"]:
            if name in ("--help", "-h"):
                continue
            kind = option["kind"]
            if kind == "flag":
                yield "takes no value", name + "=1"
                continue
            if kind == "flag_or_enum":
                yield "expected", name + "=nonsense"
                continue
            yield "needs a value", name
            value = option["values"][0] if option["values"] else A_VALUE.get(kind, "a")
            twice = "%s %s %s %s" % (name, value, name, value)
            # If an option may be repeated, the message is about the missing operand.
            yield ("sunder %s needs" % command["name"] if option["repeatable"] else "is given twice"), twice
            if kind == "enum":
                yield "must be one of", name + "=nonsense"
            if kind in ("length", "integer", "number", "scale", "box"):
                yield re.escape(option["name"]) + ".*(number|expected|scale)", name + "=nonsense"


document = json.load(sys.stdin)
for command in document["commands"]:
    if sys.argv[1] == "help":
        compare(command)
    else:
        for words, option in calls(command):
            print(words, command["name"], option, sep="\t")
if trouble:
    sys.exit(print("\n".join(trouble)) or 1)
