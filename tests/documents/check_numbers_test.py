"""The check of numbers finds what it is for: made-up documents, each wrong in one way."""
import subprocess
import tempfile
import unittest
from pathlib import Path

import check_numbers

TEXT = """# A page
Tiles of 8x8 px, at most {most} layers; 4 % of all (`measure them`) and `17` in code, two to 2^-3 px, Rec.709.

1. **first** and [a link](of_5.png)

    edgewise render --size 640x480
"""
TABLE = """A.md
  Tiles of {8}x{8} px
    source a.h kTile = (?=(\\d+))(\\d+);
  at most {255} layers
    run limits => layers: (\\d+)
  {4} % of
    marked measure them
  {two} to {2^-3} px, Rec.{709}
    means nothing
"""


class CheckNumbers(unittest.TestCase):
    def problems(self, text, table=TABLE, source="const int kTile = 8;\n"):
        def run(arguments, **_):
            return subprocess.CompletedProcess(arguments, 0, "layers: 255\n")
        with tempfile.TemporaryDirectory() as root:
            (Path(root) / "a.h").write_text(source)
            return check_numbers.Check(root, "edgewise", run).problems({"A.md": text}, table)

    good = TEXT.replace("{most}", "255")

    def test_good_ones_pass(self):
        self.assertEqual(self.problems(self.good), [])

    def expect(self, words, *arguments, **named):
        found = self.problems(*arguments, **named)
        self.assertTrue(any(words in line for line in found), found)

    def test_a_document_that_says_otherwise(self):
        self.expect("0 places", TEXT.replace("{most}", "256"))
        self.expect("256 is not in numbers.txt", TEXT.replace("{most}", "256"))

    def test_a_program_that_says_otherwise(self):
        self.expect("gives [255.0]", TEXT.replace("{most}", "256"), TABLE.replace("{255}", "{256}"))

    def test_a_source_that_says_otherwise(self):
        self.expect("gives [16.0, 16.0]", self.good, source="const int kTile = 16;\n")
        self.expect("0 matches", self.good, source="const int kSide = 8;\n")
        self.expect("2 matches", self.good, source="kTile = 8;\nkTile = 9;\n")

    def test_numbers_that_nobody_accounts_for(self):
        for number in ("31", "0.5", "1,000", "seven", "3x", "2^60", "(9)", "+-2", "5:"):
            self.expect("is not in numbers.txt", self.good.replace("A page", f"A page of {number} words"))

    def test_measurements_without_their_command(self):
        self.expect("does not name", self.good.replace("(`measure them`)", ""))

    def test_rules_that_are_none(self):
        for rule in ("", "guess 8", "means "):
            self.expect("no rule", self.good, TABLE.replace("means nothing", rule or "nothing"))


if __name__ == "__main__":
    unittest.main()
