#!/usr/bin/env python3
"""Runs `cairn evaluate` as a user, a batch engine, and a power cut would.

usage: tests/e2e/evaluate_test.py CAIRN [unittest arguments]
"""

import csv
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

OK, FAILED, USAGE = 0, 1, 2
CAMPAIGN = """
title: Which recipe?
seeds: 1..2
recipes: mcl kld_mcl
inputs:
  office: {world: office, duration_s: 6}
"""
CELLS = 4
# What a run measures of itself differs from run to run; everything else must not.
TIMES = {"cpu_s", "wall_s", "run_s", "peak_memory_bytes"}


class Evaluate(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory(prefix="cairn_evaluate_")
        self.folder = Path(self.temporary.name)
        self.write("c.yaml", CAMPAIGN)

    def tearDown(self):
        self.temporary.cleanup()

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def cairn(self, *arguments):
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, timeout=120)

    def evaluate(self, *more, campaign="c.yaml", out="out"):
        return self.cairn("evaluate", campaign, "--out", out, *more)

    def rows(self, out="out"):
        """The results without the times."""
        with open(self.folder / out / "results.csv", newline="") as file:
            return [{key: value for key, value in row.items() if key not in TIMES} for row in csv.DictReader(file)]

    def cells(self, out="out"):
        return {path.name: path.read_bytes() for path in (self.folder / out / "cells").iterdir()}

    def refused(self, text, *words):
        self.write("bad.yaml", text)
        result = self.evaluate(campaign="bad.yaml", out="none")
        self.assertEqual(result.returncode, USAGE, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        self.assertFalse((self.folder / "none").exists(), "nothing is made for a campaign that cannot be run")

    def test_a_whole_campaign(self):
        result = self.evaluate()
        self.assertEqual(result.returncode, OK, result.stderr)
        self.assertIn(f"{CELLS} of {CELLS} runs", result.stdout)
        rows = self.rows()
        self.assertEqual([(row["variant"], row["seed"]) for row in rows],
                         [("mcl", "1"), ("mcl", "2"), ("kld_mcl", "1"), ("kld_mcl", "2")])
        for row in rows:
            self.assertLess(float(row["ate_mean_m"]), 0.2)
            self.assertEqual(float(row["lost"]), 0.0)
        report = json.loads((self.folder / "out/results.json").read_text())
        self.assertEqual([group["cells"] for group in report["groups"]], [2, 2])
        error = [c for c in report["comparisons"] if c["metric"] == "ate_mean_m"]
        self.assertEqual(error[0]["difference"]["count"], 2)
        page = (self.folder / "out/index.html").read_text()
        self.assertIn('<script id="run"', page)
        self.assertIsNone(re.search(r"""<(script|link|img|iframe)[^>]*\s(src|href)\s*=\s*['"]?https?:|url\(\s*['"]?https?:""", page),
                          "the page needs nothing from elsewhere")
        self.assertEqual(list((self.folder / "out/working").iterdir()), [])

    def test_a_cell_is_a_plain_command(self):
        self.assertEqual(self.evaluate().returncode, OK)
        cell = json.loads((self.folder / "out/results.json").read_text())["results"][0]
        again = subprocess.run(cell["command"].replace("cairn", PROGRAM, 1), shell=True, cwd=self.folder, capture_output=True)
        self.assertEqual(again.returncode, OK, again.stderr)
        metrics = json.loads((self.folder / "RUN/metrics.json").read_text())
        self.assertAlmostEqual(metrics["accuracy"]["ate_mean_m"], cell["metrics"]["ate_mean_m"], 9)

    def test_finished_cells_are_not_run_again(self):
        self.assertEqual(self.evaluate().returncode, OK)
        before = self.cells()
        self.assertIn("0 cells run, 4 were finished before", self.evaluate().stderr)
        self.assertEqual(self.cells(), before)
        # More seeds: only the new ones.
        self.write("c.yaml", CAMPAIGN.replace("1..2", "1..3"))
        self.assertIn("2 cells run, 4 were finished before", self.evaluate().stderr)
        # Other settings make other cells.
        self.write("c.yaml", CAMPAIGN + "    # more\nparameters:\n  few: {set: filter.max_particles=600 filter.particles=600}\n")
        self.assertIn("4 cells run, 0 were finished before", self.evaluate().stderr)

    def test_killed_at_any_moment_it_goes_on(self):
        self.assertEqual(self.evaluate(out="whole").returncode, OK)
        for attempt in range(8):
            process = subprocess.Popen([PROGRAM, "evaluate", "c.yaml", "--out", "out", "--jobs", "2"], cwd=self.folder,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(0.05 + 0.07 * attempt)
            process.send_signal(signal.SIGKILL)
            process.wait()
            for path in (self.folder / "out/cells").glob("*") if (self.folder / "out/cells").exists() else []:
                json.loads(path.read_text())
        result = self.evaluate()
        self.assertEqual(result.returncode, OK, result.stderr)
        self.assertEqual(self.rows(), self.rows("whole"))
        self.assertEqual(list((self.folder / "out/working").iterdir()), [], "what the killed ones left is removed")

    def test_ctrl_c_ends_it_and_says_how_to_go_on(self):
        process = subprocess.Popen([PROGRAM, "evaluate", "c.yaml", "--out", "out", "--jobs", "1"], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        while not list(self.folder.glob("out/working/*/*")):  # the first job is at work
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        self.assertIn("goes on", process.communicate(timeout=60)[1])
        self.assertEqual(process.returncode, FAILED)
        self.assertEqual(self.evaluate().returncode, OK)

    def test_shares_and_merging(self):
        self.assertEqual(self.evaluate(out="whole").returncode, OK)
        for share, out in [("0..1", "a"), ("2", "b"), ("3..3", "b")]:
            result = self.evaluate("--cells", share, out=out)
            self.assertEqual(result.returncode, OK, result.stderr)
            self.assertFalse((self.folder / out / "results.csv").exists(), "a share makes no tables")
        partial = self.evaluate("--merge", out="a")
        self.assertEqual(partial.returncode, FAILED)
        self.assertIn("2 of 4 cells are not finished", partial.stderr)
        merged = self.evaluate("--merge", "a", "b", out="all")
        self.assertEqual(merged.returncode, OK, merged.stderr)
        self.assertEqual(self.rows("all"), self.rows("whole"))
        self.assertEqual(self.evaluate("--merge", "c.yaml", out="all").returncode, 3)
        for bad in ["4", "0..4", "2..1", "x", "1..", "-1"]:
            self.assertEqual(self.evaluate(f"--cells={bad}", out="none").returncode, USAGE, bad)

    def test_the_number_of_jobs_changes_nothing(self):
        self.assertEqual(self.evaluate("--jobs", 1, out="one").returncode, OK)
        self.assertEqual(self.evaluate("--jobs", 5, out="five").returncode, OK)
        self.assertEqual(self.rows("one"), self.rows("five"))

    def test_a_cell_that_fails_is_told_and_the_others_go_on(self):
        self.assertEqual(self.cairn("simulate", "office", "--duration", "6", "--out", "a.log").returncode, OK)
        self.write("broken.log", "no log of any robot\n")
        self.write("c.yaml", """
seeds: 1..2
inputs:
  good: {log: a.log, map: a.map.yaml, reference: a.truth.tum}
  broken: {log: broken.log, map: a.map.yaml, reference: a.truth.tum}
""")
        result = self.evaluate()
        self.assertEqual(result.returncode, FAILED)
        self.assertIn("2 commands failed", result.stderr)
        self.assertIn("broken.log", result.stderr)
        self.assertEqual(len(self.rows()), 2)
        self.assertEqual(len(list((self.folder / "out/failed").iterdir())), 2)

    def test_a_damaged_cell_is_named(self):
        self.assertEqual(self.evaluate().returncode, OK)
        victim = sorted((self.folder / "out/cells").iterdir())[0]
        victim.write_bytes(victim.read_bytes()[:50])
        result = self.evaluate()
        self.assertEqual(result.returncode, 3)
        self.assertIn(victim.name, result.stderr)
        victim.unlink()
        self.assertEqual(self.evaluate().returncode, OK)

    def test_bad_campaigns_are_refused_with_file_line_and_key(self):
        office = "inputs:\n  office: {world: office}\n"
        self.refused("title: nothing\n", "bad.yaml", "inputs")
        self.refused("seeds: 3..1\n" + office, "bad.yaml:1:1: seeds", "downwards")
        self.refused(office + "sedes: 1\n", "bad.yaml:3:1", "'seeds'")
        self.refused(office + "recipes: mcl kld_mlc\n", "bad.yaml:3:1: recipes", "kld_mcl")
        self.refused(office + "parameters:\n  few:\n    set: filter.particels=3\n", "bad.yaml:5:5: parameters.few.set", "particles")
        self.refused(office + "parameters:\n  few:\n    set: filter.particles=-3\n", "bad.yaml:5:5: parameters.few.set", "range")
        self.refused("inputs:\n  a:\n    log: none.log\n    map: none.yaml\n    start: global\n", "bad.yaml:3:5: inputs.a.log", "none.log")
        self.refused("inputs:\n  a:\n    world: ofice\n", "bad.yaml:3:5: inputs.a.world", "ofice")
        self.refused("inputs:\n  a:\n    world: office\n    start: 1,2\n", "bad.yaml:4:5: inputs.a.start")
        self.refused("inputs: [\n", "bad.yaml:")
        self.assertEqual(self.evaluate(campaign="missing.yaml").returncode, 3)

    def test_sensors_of_a_log_and_of_its_world_are_compared(self):
        """The log is itself simulated, in the same world: both sides must agree."""
        world = ("walls: {outline: {points: '0,0 8,0 8,6 0,6', closed: true}}\nrobot: {start: '1,1,0', points: '7,5 1,1', duration_s: 40}\n"
                 "lasers: {laser: {rate_hz: 5, beams: 91}}\n")
        self.write("w.yaml", world)
        self.assertEqual(self.cairn("simulate", "w.yaml", "--out", "real.mcap", "--seed", 9).returncode, OK)
        self.write("again.yaml", world.replace("points: '7,5 1,1', duration_s: 40", "mission: recorded, path: real.truth.tum"))
        text = "task: sensors\nseeds: 1..2\ninputs:\n  room: {log: real.mcap, map: real.map.yaml, reference: real.truth.tum, world: again.yaml}\n"
        self.write("c.yaml", text)
        result = self.evaluate()
        self.assertEqual(result.returncode, OK, result.stderr)
        self.assertIn("3 of 3 runs", result.stdout)
        self.assertIn("| measured - expected |", result.stdout)
        rows = self.rows()
        self.assertEqual([(row["variant"], row["seed"]) for row in rows], [("real", "1"), ("simulated", "1"), ("simulated", "2")])
        for row in rows:
            self.assertAlmostEqual(float(row["no_return_share"]), 0.005, delta=0.004)
        self.assertTrue((self.folder / "out/figures/room.svg").read_text().startswith("<svg"))
        self.assertIn("0 cells run, 3 were finished before", self.evaluate().stderr)
        self.write("again.yaml", (self.folder / "again.yaml").read_text() + "\n# changed")
        self.assertIn("3 cells run", self.evaluate().stderr)
        self.refused(text.replace("world: again.yaml", "start: global"), "bad.yaml:4:3: inputs.room", "sensors")
        self.refused(text + "recipes: mcl\n", "bad.yaml:5:1: recipes")

    def test_the_campaigns_that_are_shipped_can_be_read(self):
        source = Path(__file__).resolve().parents[2]
        data = Path(os.environ.get("CAIRN_DATA", source.parent / "shared/data"))
        names = [path for path in sorted((source / "campaigns").glob("*.yaml")) if "\ninputs:" in path.read_text()]
        self.assertGreaterEqual(len(names), 6)
        for path in names:
            text = path.read_text()
            if "$CAIRN_DATA" in text and not data.exists() or "../build/" in text:
                continue  # needs recordings, or a map that scripts/experiments makes
            result = subprocess.run([PROGRAM, "evaluate", path, "--merge", "--out", self.folder / path.stem], capture_output=True,
                                    text=True, env={**os.environ, "CAIRN_DATA": str(data)})
            self.assertEqual(result.returncode, FAILED, f"{path.name}: {result.stderr}")
            self.assertIn("cells are not finished", result.stderr)

    def test_a_folder_of_something_else_is_left_alone(self):
        (self.folder / "mine").mkdir()
        (self.folder / "mine/letter.txt").write_text("dear")
        self.assertEqual(self.evaluate(out="mine").returncode, USAGE)
        self.assertEqual(os.listdir(self.folder / "mine"), ["letter.txt"])


if __name__ == "__main__":
    PROGRAM = str(Path(sys.argv.pop(1)).resolve())
    unittest.main()
