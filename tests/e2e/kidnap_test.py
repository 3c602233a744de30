#!/usr/bin/env python3
"""`cairn kidnap` on a simulated office: what it writes, that it repeats itself, and what it refuses.

usage: tests/e2e/kidnap_test.py CAIRN [unittest arguments]
"""

import csv
import os
import sys
import unittest

import cli_test
from cli_test import BAD_INPUT, OK, USAGE, CliTest


class Kidnap(CliTest):
    def kidnap(self, *more, out="k", log="a.log", reference="a.truth.tum"):
        return self.run_cairn("kidnap", "--map", "a.map.yaml", "--log", log, "--reference", reference, "--out", out, *more)

    def rows(self, out, name):
        with open(self.folder / out / name, newline="") as file:
            return list(csv.DictReader(file))

    def test_a_carried_robot_is_found_again(self):
        events = ["--events", "3", "--before", "5", "--after", "12", "--distance", "2", "--seed", "2"]
        result = self.kidnap(*events, out="on")
        self.assertEqual(result.returncode, OK, result.stderr)
        self.assertIn("kidnapped 3 times", result.stdout)
        self.assertGreaterEqual(sum(float(row["found_after_s"]) >= 0 for row in self.rows("on", "events.csv")), 2)
        updates = self.rows("on", "updates.csv")
        self.assertEqual({row["event"] for row in updates}, {"event000", "event001", "event002"})
        for row in updates:
            self.assertTrue(0.0 <= float(row["probability"]) <= 1.0)
            self.assertIn(row["state"], {"tracking", "crowded", "ambiguous", "lost", "sensor_fault"})
            self.assertGreaterEqual(int(row["among"]), int(row["right"]))

    def test_the_same_bytes_for_any_number_of_jobs(self):
        events = ["--events", "2", "--before", "4", "--after", "4"]
        for out, jobs in (("one", "1"), ("two", "2")):
            self.assertEqual(self.kidnap(*events, "--jobs", jobs, out=out).returncode, OK)
        for name in ("events.csv", "updates.csv"):
            self.assertEqual((self.folder / "one" / name).read_bytes(), (self.folder / "two" / name).read_bytes())

    def test_without_events_the_whole_recording_is_judged(self):
        self.assertEqual(self.kidnap("--events", "0", out="whole").returncode, OK)
        rows = self.rows("whole", "events.csv")
        self.assertEqual([row["event"] for row in rows], ["whole"])
        self.assertEqual(rows[0]["false_alarms"], "0")

    def test_bad_input(self):
        self.assert_refused(self.kidnap(log="none.log"), BAD_INPUT, "none.log")
        self.assert_refused(self.kidnap(reference="none.tum"), BAD_INPUT, "none.tum")
        self.write("empty.tum", "")
        self.assert_refused(self.kidnap(reference="empty.tum"), BAD_INPUT, "empty.tum")
        self.assert_refused(self.kidnap("--other-log", "a.log"), USAGE, "--other-reference")
        self.assert_refused(self.kidnap("--set", "recovery.activ=true"), USAGE, "did you mean 'active'")
        for option, value in (("--events", "-1"), ("--before", "0"), ("--after", "-3"), ("--distance", "x"), ("--jobs", "0"), ("--seed", "x")):
            self.assert_refused(self.kidnap(option, value), USAGE, option)
        self.assert_refused(self.kidnap("--events", "1", "--before", "4000"), USAGE, "no two places for a kidnapping")
        self.write("file", "")
        self.assert_refused(self.kidnap("--events", "1", "--before", "4", "--after", "4", out="file"), USAGE, "file")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    cli_test.PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
