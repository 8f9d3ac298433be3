"""The functions that build command lines, without QGIS."""
import unittest

from sunder.command_line import BARRIER_COLUMNS, BadValue, barrier, number, row_of_layer, rows_of, words


class Numbers(unittest.TestCase):
    def test_read_back_as_the_same_double(self):
        for value in (0, 3, 3.0, 0.1, 1 / 3, 1e-300, 1e300, 338040.12345678901, 123456789012345680.0, -2.5):
            self.assertEqual(float(number(value)), value)

    def test_whole_ones_have_no_point(self):
        self.assertEqual(number(3.0), "3")
        self.assertEqual(number(25000), "25000")


class Words(unittest.TestCase):
    def test_what_is_not_said_is_not_written(self):
        self.assertEqual(words("separate", {}), [])
        untouched = {"GAP": 0.0, "UNIT": 0, "MAX_SHIFT": None, "WEIGHT": 0, "NO_BLOCKS": False, "CONTAINED": 0, "EFFORT": 1.0,
                     "SEED": 0, "INVALID": 0, "THREADS": 0, "SYMBOL": "", "BLOCK_FIELD": None, "SCALE": None}
        self.assertEqual(words("separate", untouched), [])

    def test_lengths_carry_the_unit(self):
        self.assertEqual(words("separate", {"GAP": 3.0, "MAX_SHIFT": 10.5}), ["--gap=3", "--max-shift=10.5"])
        self.assertEqual(words("separate", {"GAP": 3.0, "UNIT": 1}), ["--gap=3m"])
        self.assertEqual(words("pair", {"GAP": 0.2, "UNIT": 5, "SCALE": 25000.0}), ["--gap=0.2mm", "--scale=25000"])

    def test_a_limit_of_zero_is_said(self):
        self.assertEqual(words("separate", {"MAX_SHIFT": 0.0}), ["--max-shift=0"])
        self.assertEqual(words("separate", {"TOUCH_TOLERANCE": 0.0}), ["--touch-tolerance=0"])
        self.assertEqual(words("separate", {"EFFORT": 0.0}), ["--effort=0"])

    def test_choices_flags_fields_texts(self):
        self.assertEqual(words("separate", {"WEIGHT": 2, "CONTAINED": 1, "ALLOW_JUMPS": True, "WEIGHT_FIELD": "a b"}),
                         ["--weight=sqrt-area", "--weight-field=a b", "--contained=ignore", "--allow-jumps"])
        self.assertEqual(words("buffer", {"SHAPE": "square:6m", "OPERATION": 3, "DISSOLVE": True, "ALIGN": True}),
                         ["--shape=square:6m", "--operation=close", "--dissolve", "--align"])

    def test_points_are_exact(self):
        self.assertEqual(words("route", {"ROBOT": "disc:1", "FROM": (0.1, -5.0), "TO": (1 / 3, 2)}),
                         ["--robot=disc:1", "--from=0.1,-5", "--to=%r,2" % (1 / 3)])

    def test_options_of_others_are_left_out(self):
        self.assertEqual(words("check", {"GAP": 1.0, "WEIGHT": 1, "SHAPE": "square:1"}), ["--gap=1"])

    def test_a_value_that_looks_like_an_option_stays_a_value(self):
        self.assertEqual(words("separate", {"BLOCK_FIELD": "--quiet"}), ["--block-field=--quiet"])


class Barriers(unittest.TestCase):
    def test_rows(self):
        self.assertEqual(rows_of(None), [])
        self.assertEqual(rows_of([""] * 7), [])
        self.assertEqual(rows_of(["roads", "5"]), [["roads", "5", "", "", "", "", ""]])
        two = ["roads", "5", None, "", "", "", "", " water ", "", "1", "", "", "no", ""]
        self.assertEqual(rows_of(two), [["roads", "5", "", "", "", "", ""], ["water", "", "1", "", "", "no", ""]])
        self.assertEqual(len(BARRIER_COLUMNS), 7)

    def test_a_row_without_a_layer_is_told(self):
        with self.assertRaisesRegex(BadValue, "no layer"):
            rows_of(["", "5", "", "", "", "", ""])

    def text(self, *cells, unit="", fields=("width", "class")):
        return barrier(list(cells) + [""] * (7 - len(cells)), unit, "/a/roads.gpkg", "roads", fields)

    def test_width_or_field(self):
        self.assertEqual(self.text("roads"), "/a/roads.gpkg,layer=roads")
        self.assertEqual(self.text("roads", "5"), "/a/roads.gpkg,layer=roads,width=5")
        self.assertEqual(self.text("roads", "5", unit="m"), "/a/roads.gpkg,layer=roads,width=5m")
        self.assertEqual(self.text("roads", "0.6mm", unit="m"), "/a/roads.gpkg,layer=roads,width=0.6mm")
        self.assertEqual(self.text("roads", "width"), "/a/roads.gpkg,layer=roads,width-field=width")
        # If a field has a name that looks like a length, the name means the field.
        self.assertEqual(self.text("roads", "5", fields=("5",)), "/a/roads.gpkg,layer=roads,width-field=5")

    def test_all_of_it(self):
        self.assertEqual(self.text("roads", "5", "1.5", "0.2mm", "", "No", "Boundary", unit="m"),
                         "/a/roads.gpkg,layer=roads,width=5m,gap=1.5m,least=0.2mm,side=no,as=boundary")

    def test_layers_that_were_chosen(self):
        self.assertEqual(row_of_layer("roads", {}), ["roads"] + [""] * 6)
        self.assertEqual(row_of_layer("roads", {"BARRIER_WIDTH": 6.0, "BARRIER_GAP": 0.5}),
                         ["roads", "6", "0.5", "", "", "", ""])
        self.assertEqual(barrier(row_of_layer("roads", {"BARRIER_WIDTH": 0.0, "BARRIER_GAP": 1.5}), "m", "/r", "roads", ()),
                         "/r,layer=roads,width=0m,gap=1.5m")
        self.assertEqual(words("separate", {"BARRIER_WIDTH": 6.0, "BARRIER_GAP": 0.5}), [])

    def test_commas_in_names(self):
        self.assertEqual(barrier(["x"] + [""] * 6, "", "/a,b/c.gpkg", "d,e", ()), "/a\\,b/c.gpkg,layer=d\\,e")

    def test_what_means_nothing_is_told(self):
        for cells, said in ((("roads", "wide"), "neither a width nor a field; its fields: width, class"),
                            (("roads", "", "x"), "no length"), (("roads", "", "", "x"), "no length"),
                            (("roads", "", "", "", "", "left"), "yes or no"),
                            (("roads", "", "", "", "", "", "line"), "area or boundary")):
            with self.assertRaisesRegex(BadValue, said):
                self.text(*cells)


if __name__ == "__main__":
    unittest.main()
