"""Finding, running, ending the program; what it says, in plain words. A stand-in plays it where it must hang."""
import os
import stat
import tempfile
import unittest
from unittest import mock

from sunder import program

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
                         '"Gap" 3x of Houses: unknown unit; see "Field: longest move of each feature", --nothing')

    def test_conflicts(self):
        after = {"overlap": 1, "too_close": 2, "inside_blocks": 40}
        self.assertEqual(program.conflicts_left({"conflicts": {"before": {}, "after": after}}), 3)
        self.assertEqual(program.conflicts_left({"conflicts": after}), 3)
        self.assertEqual(program.conflicts_left({}), 0)
        self.assertEqual(program.statistics("/nowhere"), {})


if __name__ == "__main__":
    unittest.main()
