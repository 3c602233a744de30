#!/usr/bin/env python3
"""`cairn map ambiguity` on a world that looks alike from four sides, and on an office.

usage: tests/e2e/ambiguity_test.py CAIRN [unittest arguments]
"""

import json
import os
import sys
import unittest

import cli_test
from cli_test import BAD_INPUT, OK, USAGE, CliTest


class Ambiguity(CliTest):
    COARSE = ["--spacing", "1", "--headings", "4"]

    def certificate(self, map_, *more):
        result = self.run_cairn("map", "ambiguity", "--map", map_, *self.COARSE, "--json", *more)
        self.assertEqual(result.returncode, OK, result.stderr)
        return json.loads(result.stdout)

    def test_a_symmetric_cross_is_ambiguous_everywhere_for_ever(self):
        self.assertEqual(self.run_cairn("simulate", "cross", "--duration", "2", "--out", "cross.log").returncode, OK)
        found = self.certificate("cross.map.yaml", "--out", "cross")
        self.assertGreater(found["ambiguous_share"], 0.99)
        self.assertGreater(found["unresolved_share"], 0.99)
        self.assertEqual(found, json.loads((self.folder / "cross" / "ambiguity.json").read_text()))
        self.assertIn("<svg", (self.folder / "cross" / "ambiguity.svg").read_text())
        page = (self.folder / "cross" / "ambiguity.html").read_text()
        self.assertIn("<svg", page)
        self.assertNotRegex(page, r"(src|href)=.https?:", "the page needs nothing from elsewhere")

    def test_an_office_is_ambiguous_in_few_places_and_driving_helps(self):
        found = self.certificate("a.map.yaml", "--sensor", "270,30,60")
        self.assertLess(found["ambiguous_share"], 0.3)
        self.assertLess(found["unresolved_share"], 0.02)
        for place in found["ambiguous"]:
            self.assertTrue(place["alternatives"])
            self.assertGreaterEqual(place["alternatives"][0]["log_ratio"], -found["margin"])

    def test_bad_arguments(self):
        for sensor in ["", "180", "0,30", "400,30", "180,-1", "180,30,2", "180,30,2.5", "180,30,60,1", "nan,30", "wide", "180;30"]:
            self.assert_refused(self.run_cairn("map", "ambiguity", "--map", "a.map.yaml", "--sensor", sensor), USAGE, "--sensor")
        for option in ["--spacing", "--headings", "--apart", "--margin", "--threads"]:
            self.assert_refused(self.run_cairn("map", "ambiguity", "--map", "a.map.yaml", option, "0"), USAGE)
        self.assert_refused(self.run_cairn("map", "ambiguity", "--map", "none.yaml"), BAD_INPUT, "none.yaml")
        self.write("file", "")
        self.assert_refused(self.run_cairn("map", "ambiguity", "--map", "a.map.yaml", "--out", "file"), USAGE, "file", "--out")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    cli_test.PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
