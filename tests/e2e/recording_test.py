#!/usr/bin/env python3
"""`cairn replay` and `cairn log` on the recordings that runs leave behind: whole, cut, killed, changed.

usage: tests/e2e/recording_test.py CAIRN [unittest arguments]
"""

import filecmp
import json
import os
import re
import subprocess
import sys
import unittest

import cli_test
from cli_test import BAD_INPUT, FAILED, OK, START, USAGE, CliTest


class Recordings(CliTest):
    def setUp(self):
        self.assertEqual(self.localize("--reference", "a.truth.tum").returncode, OK)
        self.recording = self.folder / self.id() / "run.mcap"

    def test_a_run_is_replayed_bit_for_bit(self):
        for threads in ["1", "3"]:
            result = self.run_cairn("replay", self.id(), "--threads", threads)
            self.assertEqual(result.returncode, OK, result.stderr)
            self.assertRegex(result.stdout, r"\d+ events, 301 estimates: the same to the last bit")
            self.assertEqual(result.stderr, "")

    def test_the_first_difference_is_named(self):
        changed = self.localize("--seed", "2", out="other")
        self.assertEqual(changed.returncode, OK)
        recording = (self.folder / "other" / "run.mcap").read_bytes()
        seed = b"\x04\0\0\0seed\x01\0\0\0"
        self.assertEqual(recording.count(seed + b"2"), 1)
        name = self.write("forged.mcap", recording.replace(seed + b"2", seed + b"3"))
        result = self.run_cairn("replay", name)
        self.assert_refused(result, FAILED, "forged.mcap", "estimate 0 (stamp ", "differs in x: recorded ", "replayed ")

    def test_a_run_cut_anywhere_is_replayed_as_far_as_it_goes(self):
        whole = self.recording.read_bytes()
        for share in [0.2, 0.5, 0.9, 0.999]:
            name = self.write("cut.mcap", whole[: int(share * len(whole))])
            result = self.run_cairn("replay", name)
            self.assertEqual(result.returncode, OK, result.stderr)
            self.assertIn("the same to the last bit", result.stdout)
            self.assertRegex(result.stderr, "truncated|unfinished")

    def test_a_killed_run_is_replayed(self):
        command = [cli_test.PROGRAM, "localize", "--map", "a.map.yaml", "--log", "a.log", "--init", START, "--out", "killed",
                   "--set", "recipe=mcl", "--set", "filter.particles=300000", "--set", "update.min_translation_m=0"]
        with subprocess.Popen(command, cwd=self.folder, stderr=subprocess.PIPE, text=True) as run:
            self.assertRegex(run.stderr.readline(), r"^localizing: ", "it is at work")
            run.kill()
            run.communicate(timeout=60)
        self.assertFalse((self.folder / "killed" / "metrics.json").exists())
        result = self.run_cairn("replay", "killed", "--threads", "2")
        self.assertEqual(result.returncode, OK, result.stderr)
        self.assertIn("did not come to its end", result.stdout)
        self.assertNotIn("replayed  0 events", result.stdout)

    def test_what_if(self):
        result = self.run_cairn("replay", self.id(), "--what-if", "filter.max_particles=600", "laser.max_beams=30")
        self.assertEqual(result.returncode, OK, result.stderr)
        for row in ["recorded", "particles, mean", "quality, mean", "error, cm", "apart, cm"]:
            self.assertIn(row, result.stdout)
        result = self.run_cairn("replay", self.id(), "--what-if", "laser.max_beams=30", "--out", "other_beams")
        self.assertEqual(result.returncode, OK, result.stderr)
        self.assertIn("max_beams: 30", (self.folder / "other_beams" / "config.yaml").read_text())
        self.assertTrue((self.folder / "other_beams" / "reference.tum").is_file())
        refused = self.run_cairn("replay", self.id(), "--what-if", "filter.max_particle=9")
        self.assert_refused(refused, USAGE, "did you mean 'max_particles'?")
        self.assertEqual(self.run_cairn("replay", self.id(), "--out", "alone").returncode, USAGE)

    def test_a_changed_or_moved_map(self):
        files = {name: (self.folder / name).read_bytes() for name in ["a.map.yaml", "a.map.png"]}
        for name, content in files.items():
            self.write(name.replace("a.map", "kept"), content.replace(b"a.map.png", b"kept.png"))
        text = files["a.map.yaml"].decode()
        try:
            self.write("a.map.yaml", re.sub(r"origin: \[[^,]*", "origin: [7.25", text, count=1))
            result = self.run_cairn("replay", self.id())
            self.assert_refused(result, BAD_INPUT, "is not the map of the recorded run", "--map")
            self.assertEqual(self.run_cairn("replay", self.id(), "--map", "kept.yaml").returncode, OK)
        finally:
            self.write("a.map.yaml", files["a.map.yaml"])

    def test_without_a_recording(self):
        self.assertEqual(self.localize("--no-record").returncode, OK)
        self.assertFalse(self.recording.exists())
        self.assert_refused(self.run_cairn("replay", self.id()), BAD_INPUT, "holds no recording")
        self.assert_refused(self.run_cairn("replay", "a.log"), BAD_INPUT, "not an MCAP file")
        self.assert_refused(self.run_cairn("replay", "nowhere"), BAD_INPUT, "no such file")

    def test_a_recording_is_a_log(self):
        self.assertEqual(self.localize(log=self.recording, out="from_recording").returncode, OK)
        for file in ["trajectory.tum", "estimate.csv"]:
            same = filecmp.cmp(self.folder / self.id() / file, self.folder / "from_recording" / file, shallow=False)
            self.assertTrue(same, file)

    def test_convert(self):
        self.assertEqual(self.run_cairn("log", "convert", "a.log", "made/a.mcap").returncode, OK)
        infos = [json.loads(self.run_cairn("log", "info", log, "--json").stdout) for log in ["a.log", "made/a.mcap"]]
        self.assertEqual(infos[0]["streams"], infos[1]["streams"])
        self.assertEqual(infos[1]["format"], "cairn_mcap")
        self.assert_refused(self.run_cairn("log", "convert", "a.log", "a.bag"), USAGE, "does not end in .mcap")
        self.assert_refused(self.run_cairn("log", "convert", "nowhere", "b.mcap"), BAD_INPUT, "no such file")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    cli_test.PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
