"""Compares the dialogs' table of options with the program's, which `sunder --options-json` prints."""
import json
import os
import subprocess
import unittest

from sunder import options

KINDS = {"length": options.LENGTH, "flag": options.FLAG, "enum": options.CHOICE, "scale": options.SCALE}


def of_program():
    printed = subprocess.run([os.environ["SUNDER"], "--options-json"], stdout=subprocess.PIPE, check=True).stdout
    return {each["name"]: each for each in json.loads(printed)["commands"] if each["name"] not in options.LEFT_OUT_COMMANDS}


class Table(unittest.TestCase):
    def setUp(self):
        self.commands = of_program()

    def test_commands(self):
        self.assertEqual(sorted(self.commands), sorted(options.EVERY))

    def test_every_option_is_asked_or_left_out_for_a_reason(self):
        for name, command in self.commands.items():
            there = {each["name"] for each in command["options"]}
            asked = {each.flag for each in options.of_command(name)}
            self.assertEqual(asked - there, set(), "%s: the program does not have" % name)
            self.assertEqual(there - asked - set(options.LEFT_OUT), set(), "%s: neither asked nor left out" % name)
            self.assertEqual(asked & set(options.LEFT_OUT), set(), "%s: asked and left out" % name)

    def test_kinds_choices_defaults(self):
        for name, command in self.commands.items():
            ours = {each.flag: each for each in options.of_command(name)}
            for theirs in command["options"]:
                option = ours.get(theirs["name"])
                if not option:
                    continue
                with self.subTest(command=name, option=option.flag):
                    if theirs["kind"] in KINDS:
                        self.assertEqual(option.kind, KINDS[theirs["kind"]])
                    if option.kind == options.CHOICE:
                        self.assertEqual(list(option.choices), theirs["values"])
                        self.assertEqual(len(option.labels), len(option.choices))
                        self.assertEqual(option.choices[option.default], theirs["default"])
                    elif option.kind in (options.LENGTH, options.NUMBER, options.COUNT) and option.default is not None \
                            and option.flag != "--threads":
                        self.assertEqual(float(option.default), float(theirs["default"]))
                    elif option.default is None:
                        self.assertIn(theirs["default"], (None,))

    def test_words_for_people(self):
        for option in options.OPTIONS:
            self.assertTrue(option.label and option.help, option.flag)
            self.assertNotIn("--", option.label + option.help, option.flag)
        self.assertEqual(len(options.UNITS), len(options.UNIT_LABELS))


if __name__ == "__main__":
    unittest.main()
