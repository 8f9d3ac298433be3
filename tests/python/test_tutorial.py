"""The tutorial, docs/python.md: its examples print what it says."""
import doctest
import os
import unittest

from support import SOURCE, main, module


class Tutorial(unittest.TestCase):
    """Each example, in order, from the top of the sources."""

    def test_tutorial(self):
        if not module("geopandas"):
            self.skipTest("GeoPandas is not installed")
        os.chdir(SOURCE)
        with open("docs/python.md", encoding="utf-8") as file:
            text = "\n".join("" if line.startswith("```") else line for line in file.read().split("\n"))
        examples = doctest.DocTestParser().get_doctest(text, {}, "docs/python.md", "docs/python.md", 0)
        result = doctest.DocTestRunner().run(examples)
        self.assertEqual(result.failed, 0)
        self.assertGreater(result.attempted, 40)


if __name__ == "__main__":
    main()
