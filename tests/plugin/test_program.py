"""Finding, running and ending the program; its messages in plain words. A script takes its place where the program
would have to hang."""
import os
import re
import stat
import tempfile
import unittest
from unittest import mock

from sunder import options, program

SUNDER = os.environ["SUNDER"]


def ignored(_):
    pass


class Find(unittest.TestCase):
    def test_on_the_path(self):
        with mock.patch.dict(os.environ, PATH=os.path.dirname(SUNDER)):
            self.assertEqual(program.find(""), os.path.join(os.path.dirname(SUNDER), "sunder"))

    def test_by_the_setting(self):
        with mock.patch.dict(os.environ, PATH=""):
            self.assertEqual(program.find(SUNDER), SUNDER)

    def test_missing(self):
        with mock.patch.dict(os.environ, PATH="/nowhere"):
            with self.assertRaisesRegex(program.ProgramMissing, "not found.*Settings"):
                program.find("")
            with self.assertRaisesRegex(program.ProgramMissing, "/nowhere/sunder"):
                program.find("/nowhere/sunder")


class Run(unittest.TestCase):
    def stand_in(self, script):
        file = tempfile.NamedTemporaryFile("w", suffix=".sh", delete=False)
        file.write("#!/bin/sh\n" + script)
        file.close()
        os.chmod(file.name, stat.S_IRWXU)
        self.addCleanup(os.unlink, file.name)
        return file.name

    def test_lines_go_where_they_belong(self):
        said, percents = [], []
        words = [self.stand_in('echo figures; echo 0 >&2; echo "sunder: warning: w" >&2; echo 100 >&2; exit 3')]
        status, told = program.run(words, percents.append, said.append, lambda: False)
        self.assertEqual((status, told, said, percents), (3, ["sunder: warning: w"], ["figures"], [0, 100]))

    def test_floods_do_not_block(self):
        said = []
        words = [self.stand_in('i=0; while [ $i -lt 3000 ]; do echo "0123456789012345678901234567890123456789"; '
                               'echo "a warning of some length to fill the pipe" >&2; i=$((i+1)); done')]
        status, told = program.run(words, ignored, said.append, lambda: False)
        self.assertEqual((status, len(said), len(told)), (0, 3000, 3000))

    def test_cancel_ends_it(self):
        mark = tempfile.mktemp()
        self.addCleanup(lambda: os.path.exists(mark) and os.unlink(mark))
        words = [self.stand_in('trap "echo ended >%s; exit 1" TERM; echo 1 >&2; while :; do sleep 0.05; done' % mark)]
        begun = []
        status, _ = program.run(words, begun.append, ignored, lambda: bool(begun))
        self.assertIsNone(status)
        self.assertTrue(os.path.exists(mark), "it was not asked to end")

    def test_one_that_does_not_listen_is_killed(self):
        with mock.patch.object(program, "PATIENCE", 0.2):
            words = [self.stand_in('trap "" TERM; echo 1 >&2; exec 2>&1; while :; do sleep 0.05; done')]
            begun = []
            status, _ = program.run(words, begun.append, ignored, lambda: bool(begun))
        self.assertIsNone(status)

    def test_the_real_one(self):
        percents = []
        town = os.path.join(os.environ["SUNDER_SOURCE"], "datasets-synthetic", "town.gpkg")
        words = [SUNDER, "check", town, "--input-layer=buildings", "--allow-conflicts", "--progress=plain"]
        status, told = program.run(words, percents.append, ignored, lambda: False)
        self.assertEqual((status, told), (0, []))
        self.assertEqual(percents, list(range(101)))
        status, told = program.run([SUNDER, "pair", "square:4", "square:x"], ignored, ignored, lambda: False)
        self.assertEqual(status, 2)
        self.assertTrue(program.is_error(told[0]))


class Plain(unittest.TestCase):
    def test_options_by_their_labels_and_files_by_their_layers(self):
        line = "sunder: error: --gap 3x of /tmp/read/input.gpkg: unknown unit; see --max-shift-field, --nothing"
        self.assertEqual(program.plain(line, {"/tmp/read/input.gpkg": "Houses", "/tmp/read": "no"}),
                         '"Gap" 3x of Houses: unknown unit; see the field of the longest moves '
                         '("Field: longest move of each feature"), --nothing')

    def test_sentences_stay_sentences(self):
        for line, plain in (
                ("for points give their --symbol, as in --symbol disc:4",
                 'for points give their symbol ("Points: the symbol at each point"), as in disc:4'),
                ("there is no symbol; give --symbol or --symbol-field; give an --id-field",
                 'there is no symbol; give the symbol ("Points: the symbol at each point") or the field of the symbols '
                 '("Points: field with the symbol of each point"); give a key field ("Key field, for lists and messages")'),
                ("not finite; --invalid skip leaves such features out",
                 'not finite; "Skip" at "Invalid geometries" leaves such features out'),
                ("--touch-tolerance 0.3 would join them", '"Features at most this far apart are one block" 0.3 would join them'),
                ("`sunder sum --exact` gives it", "`sunder sum --exact` gives it"),
                ("or give --allow-inexact-output", "or give --allow-inexact-output (in a terminal)")):
            self.assertEqual(program.plain("sunder: error: " + line, {}), plain)

    def test_messages_of_the_sources(self):
        """All messages in the program's sources that name an option: after the translation none names an option of a
        dialog, and no word is doubled."""
        texts = []
        for folder, _, files in os.walk(os.path.join(os.environ["SUNDER_SOURCE"], "gis")):
            for file in (each for each in files if each.endswith(".c") and os.path.basename(folder) not in ("options", "page")):
                with open(os.path.join(folder, file), encoding="utf-8") as opened:
                    joined = re.sub(r'"\s*\n\s*"', "", opened.read())
                texts += re.findall(r'"((?:[^"\\\n]|\\.)*--[a-z](?:[^"\\\n]|\\.)*)"', joined)
        self.assertGreater(len(texts), 80)
        asked = {option.flag for option in options.OPTIONS}
        for text in texts:
            with self.subTest(text=text):
                said = program.plain(text, {})
                outside = "".join(said.split("`")[0::2])
                self.assertFalse(asked & set(re.findall(r"(?<![\w-])--[a-z]+(?:-[a-z]+)*", outside)), said)
                self.assertNotRegex(outside, r"\b(their|its|an?|no|another|the|each) (the|an?|\")")
                for noun in options.NOUNS.values():
                    self.assertNotRegex(outside, r"\b%s %s" % ("a" if noun[0] in "aeiou" else "an", noun))

    def test_every_option_has_a_noun(self):
        self.assertEqual({option.flag for option in options.OPTIONS} - set(options.NOUNS), set())

    def test_columns(self):
        lines = ["kind\tfid\tgap", "too_close\t7\t0.5", "in all: 1"]
        self.assertEqual(program.columns(lines), ["kind       fid  gap", "too_close  7    0.5", "in all: 1"])
        self.assertEqual(program.columns([]), [])
        self.assertEqual(program.unbroken("  moved   12"), "\u00a0\u00a0moved\u00a0\u00a0\u00a012")
        self.assertEqual(program.unbroken("a b"), "a b")

    def test_conflicts(self):
        after = {"overlap": 1, "too_close": 2, "inside_blocks": 40}
        self.assertEqual(program.conflicts_left({"conflicts": {"before": {}, "after": after}}), 3)
        self.assertEqual(program.conflicts_left({"conflicts": after}), 3)
        self.assertEqual(program.conflicts_left({}), 0)
        self.assertEqual(program.statistics("/nowhere"), {})


if __name__ == "__main__":
    unittest.main()
