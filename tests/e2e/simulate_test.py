#!/usr/bin/env python3
"""World files, good and bad, through `cairn simulate`.

usage: tests/e2e/simulate_test.py CAIRN [unittest arguments]
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

OK, USAGE, BAD_INPUT = 0, 2, 3
WORLD = """walls:
  outline:
    points: 0,0 8,0 8,6 0,6
    closed: true
robot:
  start: 1,1,0
  points: 7,5 1,1
lasers:
  front:
    rate_hz: 10
"""


class Simulate(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory(prefix="cairn_simulate_")
        self.folder = Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def simulate(self, *arguments):
        command = [PROGRAM, "simulate", *map(str, arguments)]
        return subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=120)

    def world(self, text, *more):
        (self.folder / "w.yaml").write_text(text)
        return self.simulate("w.yaml", "--out", "w.log", *more)

    def refused(self, old, new, *words):
        """The world with `old` replaced must be refused, and nothing be written."""
        self.assertIn(old, WORLD)
        result = self.world(WORLD.replace(old, new))
        self.assertEqual(result.returncode, USAGE, result.stdout)
        for word in words:
            self.assertIn(word, result.stderr)
        self.assertFalse((self.folder / "w.log").exists())

    def test_a_world_file(self):
        result = self.world(WORLD)
        self.assertEqual(result.returncode, OK, result.stderr)
        localized = subprocess.run([PROGRAM, "localize", "--map", "w.map.yaml", "--log", "w.log", "--reference", "w.truth.tum",
                                    "--init", "1,1,0", "--out", "run"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(localized.returncode, OK, localized.stderr)

    def test_what_is_printed_is_the_same_world(self):
        printed = self.simulate("warehouse", "--print")
        self.assertEqual(printed.returncode, OK, printed.stderr)
        (self.folder / "all.yaml").write_text(printed.stdout)
        for world, log in [("warehouse", "a.log"), ("all.yaml", "b.log")]:
            self.assertEqual(self.simulate(world, "--duration", 5, "--threads", 2, "--out", log).returncode, OK)
        self.assertEqual((self.folder / "a.log").read_bytes(), (self.folder / "b.log").read_bytes())
        self.assertEqual((self.folder / "a.map.png").read_bytes(), (self.folder / "b.map.png").read_bytes())

    def test_an_mcap_log_keeps_the_names(self):
        (self.folder / "w.yaml").write_text(WORLD)
        result = self.simulate("w.yaml", "--out", "w.mcap")
        self.assertEqual(result.returncode, OK, result.stderr)
        info = subprocess.run([PROGRAM, "log", "info", "w.mcap"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(info.returncode, OK, info.stderr)
        self.assertIn("front", info.stdout)

    def test_a_floor_from_a_file(self):
        (self.folder / "floor.txt").write_text("0,0,8,0\n8,0,8,6\n8,6,0,6\n0,6,0,0\n")
        text = "file: floor.txt\n" + WORLD[WORLD.index("robot:"):]
        self.assertEqual(self.world(text).returncode, OK)
        # The map that was written is a floor as well.
        self.assertEqual(self.world(text.replace("floor.txt", "w.map.yaml")).returncode, OK)
        self.assertEqual(self.world(text.replace("floor.txt", "none.txt")).returncode, BAD_INPUT)

    def test_bad_worlds_are_refused_with_file_line_and_key(self):
        self.refused("closed: true", "closed: false", "w.yaml:1:1: walls", "way out")
        self.refused("0,0 8,0 8,6 0,6", "0,0 8,0", "w.yaml:3:5: walls.outline.points", "open polygon")
        self.refused("0,0 8,0 8,6 0,6", "0,0 8,0 8,6 here", "w.yaml:3:5: walls.outline.points", "here")
        self.refused("closed: true", "material: gold", "w.yaml:4:15", "material", "gold")
        self.refused("robot:", "furniture:\n  box: {width_m: -1}\nrobot:", "w.yaml:6:18", "width_m", "range")
        self.refused("start: 1,1,0", "start: 0.1,1,0", "w.yaml:6:3: robot.start", "wall")
        self.refused("start: 1,1,0", "start: 50,1,0", "w.yaml:6:3: robot.start", "outside")
        self.refused("points: 7,5 1,1", "points: 7,9", "w.yaml:7:3: robot.points", "(7.00, 9.00)")
        self.refused("points: 7,5 1,1", "points: 7,5\n  mission: polyline\nfurniture:\n  box: {center: '4,3'}", "w.yaml:7:3: robot.points", "wall")
        self.refused("rate_hz: 10", "mount: 3,0,0", "w.yaml:10:5: lasers.front.mount", "sticks out")
        for rate in ["0", "1e9", "-1", "fast"]:
            self.refused("rate_hz: 10", f"rate_hz: {rate}", "w.yaml:10:14", "rate_hz")
        self.refused("rate_hz: 10", "rate_hz: 1000\n    beams: 100000", "lasers.front.rate_hz", "memory")
        self.refused("lasers:\n  front:\n    rate_hz: 10\n", "", "lasers", "blind")
        self.refused("robot:", "robt:", "w.yaml:5:1", "'robot'")
        self.assertEqual(self.simulate("nowhere.yaml", "--out", "w.log").returncode, USAGE)
        self.assertEqual(self.simulate("office").returncode, USAGE)


if __name__ == "__main__":
    PROGRAM = str(Path(sys.argv.pop(1)).resolve())
    unittest.main()
