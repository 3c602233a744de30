#!/usr/bin/env python3
"""Runs the cairn program as a user, and as somebody who means no good, would.

usage: tests/e2e/cli_test.py CAIRN [unittest arguments]
"""

import filecmp
import gzip
import json
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

OK, FAILED, USAGE, BAD_INPUT, LOST = 0, 1, 2, 3, 4
START = "1,1.2,0"
SUBCOMMANDS = [[], ["config"], ["evaluate"], ["localize"], ["log"], ["log", "convert"], ["log", "info"], ["map"], ["map", "ambiguity"],
               ["map", "build"], ["map", "info"], ["replay"], ["report"], ["score"], ["simulate"], ["kidnap"], ["locate"], ["log", "noise"],
               ["tune"], ["tune", "beam"], ["tune", "laser"], ["tune", "odometry"], ["tune", "uwb"]]
ROOT = Path(__file__).resolve().parents[2]
DATA = Path(os.environ.get("CAIRN_DATA", ROOT.parent / "shared" / "data"))
CONFIGS = ROOT / "configs" / "datasets"
# Which recordings a shipped configuration is for.
SHIPPED = {
    "aces": ["radish_raw/aces.clf.bz2"],
    "intel": ["radish_raw/intel.clf.bz2"],
    "jarvis": ["jarvis_nav350/jarvis_complex_path_fast.bag"],
    "mrpt_uwb": ["mrpt_uwb_laser/log.txt"],
    "radish_derived": [f"radish_derived/{place}.log.gz" for place in ["aces", "edmonton", "freiburg-101", "intel", "seattle"]],
    "wean": [f"wean/robotdata{run}.log" for run in [1, 2, 3]],
}
# "error: where: what; what to do", or a sentence about the run.
SENTENCE = re.compile(r"^error: \S.*\S$", re.MULTILINE)


def cairn(*arguments, where):
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=where, capture_output=True, text=True, timeout=120)


class CliTest(unittest.TestCase):
    """All tests share one simulated office; each writes into folders of its own."""

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="cairn_cli_")
        cls.folder = Path(cls.temporary.name)
        assert cairn("simulate", "office", "--duration", "30", "--out", "a.log", where=cls.folder).returncode == OK

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def run_cairn(self, *arguments):
        return cairn(*arguments, where=self.folder)

    def localize(self, *more, log="a.log", map_="a.map.yaml", init=START, out=None):
        start = ["--init", init] if init else []
        return self.run_cairn("localize", "--map", map_, "--log", log, *start, "--out", out or self.id(), *more)

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return name

    def assert_refused(self, result, code, *words):
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertRegex(result.stderr, SENTENCE)
        self.assertEqual(result.stdout, "", "a refusal is no result")
        for word in words:
            self.assertIn(word, result.stderr)

    def metrics(self, out=None):
        return json.loads((self.folder / (out or self.id()) / "metrics.json").read_text())


class Usage(CliTest):
    def test_help_of_every_subcommand(self):
        for words in SUBCOMMANDS:
            result = self.run_cairn(*words, "--help")
            self.assertEqual(result.returncode, OK, words)
            self.assertIn("Usage:", result.stdout)
            self.assertEqual(result.stderr, "")

    def test_version(self):
        result = self.run_cairn("--version")
        self.assertEqual(result.returncode, OK)
        self.assertRegex(result.stdout, r"^\d+\.\d+\.\d+\n$")

    def test_a_missing_subcommand(self):
        for words in [[], ["log"], ["map"]]:
            self.assert_refused(self.run_cairn(*words), USAGE, "a subcommand is missing")

    def test_unknown_words_are_named(self):
        for words in [["nonsense"], ["log", "nonsense"], ["map", "nonsense"]]:
            result = self.run_cairn(*words)
            self.assertEqual(result.returncode, USAGE)
            self.assertIn("nonsense", result.stderr)
        result = self.localize("--bogus")
        self.assertEqual(result.returncode, USAGE)
        self.assertIn("--bogus", result.stderr)

    def test_arguments_that_exclude_or_need_others(self):
        self.assertEqual(self.localize("--global").returncode, USAGE)
        self.assertEqual(self.localize("--init-error", "1,0,0", init=None).returncode, USAGE)
        self.assertEqual(self.run_cairn("localize", "--log", "a.log").returncode, USAGE)

    def test_threads(self):
        for threads in ["0", "-1", "257", "100000"]:
            self.assert_refused(self.localize("--threads", threads), USAGE, "threads")
        for threads in ["two", "1.5", "99999999999"]:
            self.assertEqual(self.localize("--threads", threads).returncode, USAGE)

    def test_seed(self):
        for seed in ["18446744073709551616", "-1", "1.5", "0x1", "many"]:
            self.assert_refused(self.localize("--seed", seed), USAGE, "--seed")
            self.assert_refused(self.run_cairn("simulate", "office", "--seed", seed, "--out", "s.log"), USAGE, "--seed")
        self.assertEqual(self.localize("--seed", "18446744073709551615").returncode, OK)
        self.assertEqual(self.metrics()["seed"], 18446744073709551615)

    def test_start_pose(self):
        self.assert_refused(self.localize(init="1000,1,0"), USAGE, "off the map", "cairn map info")
        for init in ["here", "1,1.2", "1,1.2,0,0", "nan,1,0", "1e400,1,0", "1;1;0"]:
            self.assert_refused(self.localize(init=init), USAGE, "--init", "is not a pose")
        self.assert_refused(self.localize(init="reference"), USAGE, "give one with --reference")
        self.assert_refused(self.localize("--init-error", "far"), USAGE, "--init-error")


class Configuration(CliTest):
    def test_unknown_keys_name_the_nearest(self):
        self.assert_refused(self.localize("--set", "filter.max_particle=9"), USAGE, "did you mean 'max_particles'?")
        self.assert_refused(self.localize("--set", "max_particles=9"), USAGE, "did you mean 'filter.max_particles'?")
        name = self.write("bad.yaml", "filter:\n  max_particle: 9\n")
        self.assert_refused(self.localize("--config", name), USAGE, "bad.yaml:2:3", "'max_particles'")

    def test_bad_values(self):
        for setting in ["filter.max_particles=0", "filter.max_particles=1e12", "filter.max_particles=many",
                        "laser.z_hit=.nan", "update.min_translation_m=.inf", "filter=3", "filter", "=", "a.b.c=[",
                        "filter.min_particles=5000000", "recipe=magic", "odometry_stream=wheels", "streams.lazer.use=true"]:
            with self.subTest(setting):
                self.assert_refused(self.localize("--set", setting), USAGE)

    def test_configuration_files_that_are_none(self):
        self.assert_refused(self.localize("--config", "nowhere.yaml"), BAD_INPUT, "no such file")
        self.assert_refused(self.localize("--config", "."), BAD_INPUT, "is a directory")
        self.assert_refused(self.localize("--config", "a.log"), USAGE, "a.log:")
        self.assert_refused(self.localize("--config", "a.map.png"), USAGE, "a.map.png")
        self.assert_refused(self.localize("--config", self.write("deep.yaml", "[" * 100000)), USAGE, "deep.yaml")
        self.assert_refused(self.localize("--config", self.write("big.yaml", "#" * (2 << 20))), USAGE, "big.yaml")

    def test_what_config_prints_is_accepted_and_printed_again(self):
        settings = ["--set", "filter.max_particles=777", "--set", "streams.laser.use=true", "--set", "laser.z_hit=0.7"]
        first = self.run_cairn("config", "mcl", *settings)
        self.assertEqual(first.returncode, OK)
        self.assertEqual(first.stderr, "")
        name = self.write("printed.yaml", first.stdout)
        self.assertEqual(self.run_cairn("config", "--config", name).stdout, first.stdout)
        self.assert_refused(self.run_cairn("config", "nonsense"), USAGE, "recipe", "mcl, kld_mcl")

    def test_the_run_keeps_its_configuration(self):
        self.assertEqual(self.localize("--set", "filter.max_particles=777").returncode, OK)
        again = self.run_cairn("config", "--config", f"{self.id()}/config.yaml")
        self.assertEqual(again.stdout, (self.folder / self.id() / "config.yaml").read_text())
        self.assertIn("max_particles: 777", again.stdout)

    def test_every_shipped_configuration_is_accepted(self):
        self.assertEqual({file.stem for file in CONFIGS.glob("*")}, SHIPPED.keys())
        for name in SHIPPED:
            with self.subTest(name):
                result = self.run_cairn("config", "--config", CONFIGS / f"{name}.yaml")
                self.assertEqual((result.returncode, result.stderr), (OK, ""))

    def test_shipped_configurations_differ_from_the_defaults_only_in_streams(self):
        defaults = self.run_cairn("config").stdout.split("streams:")[0]
        for name in SHIPPED:
            with self.subTest(name):
                printed = self.run_cairn("config", "--config", CONFIGS / f"{name}.yaml").stdout.split("streams:")[0]
                different = [a for a, b in zip(printed.splitlines(), defaults.splitlines(), strict=True) if a != b]
                self.assertEqual([line.split(":")[0] for line in different], ["odometry_stream"])

    def test_shipped_configurations_name_the_streams_of_their_recordings(self):
        for name, logs in SHIPPED.items():
            text = (CONFIGS / f"{name}.yaml").read_text()
            named = re.findall(r'^odometry_stream: "?([^"\n]+)"?$|^  (\S+):', text, re.MULTILINE)
            for log in logs:
                with self.subTest(log):
                    if not (DATA / log).is_file():
                        self.skipTest(f"no recording {log} under {DATA}")
                    info = self.run_cairn("log", "info", DATA / log, "--json")
                    self.assertEqual(info.returncode, OK, info.stderr)
                    streams = {stream["name"] for stream in json.loads(info.stdout)["streams"]}
                    self.assertGreaterEqual(len(named), 2)
                    self.assertLessEqual({odometry or laser for odometry, laser in named}, streams)

    def test_nav2_parameters(self):
        name = self.write("nav2.yaml", NAV2)
        result = self.run_cairn("config", "--config", name)
        self.assertEqual(result.returncode, OK, result.stderr)
        for line in ["alpha1: 0.15", "max_particles: 2500", "min_particles: 400", "max_beams: 90", "sigma_hit_m: 0.21",
                     "max_distance_m: 1.75", "min_translation_m: 0.26", "min_rotation_rad: 0.22", "z_hit: 0.51",
                     "z_rand: 0.49", "epsilon: 0.055", "alpha_slow: 0.002", "alpha_fast: 0.09", "threshold: 0.3",
                     "error_threshold: 0.9"]:
            self.assertIn(line, result.stdout)
        self.assertIn("AMCL parameter without counterpart", result.stderr)
        self.assertEqual(self.localize("--config", name).returncode, OK)
        self.assertEqual(self.metrics()["warnings"]["AMCL parameter without counterpart"], 14)


class Files(CliTest):
    def test_maps_that_are_none(self):
        self.assert_refused(self.localize(map_="nowhere.yaml"), BAD_INPUT, "nowhere.yaml: no such file")
        self.assert_refused(self.localize(map_="."), BAD_INPUT, "is a directory")
        self.assert_refused(self.localize(map_="a.map.png"), BAD_INPUT, "bare picture", ".yaml")
        pgm = self.write("bare.pgm", b"P5\n2 2\n255\n\0\0\0\0")
        self.assert_refused(self.localize(map_=pgm), BAD_INPUT, "bare picture", ".yaml")
        self.assert_refused(self.localize(map_="a.log"), BAD_INPUT, "a.log")
        lost = self.write("lost.yaml", "image: nowhere.png\nresolution: 0.05\norigin: [0, 0, 0]\n")
        self.assert_refused(self.localize(map_=lost), BAD_INPUT, "nowhere.png: no such file")
        self.write("cut.png", (self.folder / "a.map.png").read_bytes()[:500])
        cut = self.write("cut.yaml", "image: cut.png\nresolution: 0.05\norigin: [0, 0, 0]\n")
        self.assert_refused(self.localize(map_=cut), BAD_INPUT, "cut.png")

    def test_logs_that_are_none(self):
        whole = gzip.compress((self.folder / "a.log").read_bytes())
        self.assert_refused(self.localize(log=self.write("cut.log.gz", whole[: len(whole) // 2])), BAD_INPUT, "cut short")
        self.assert_refused(self.localize(log=self.write("empty.log", "")), BAD_INPUT, "empty.log: is empty")
        self.assert_refused(self.localize(log=self.write("words.log", "hello\n")), BAD_INPUT, "no log of a known format")
        self.assert_refused(self.localize(log=self.write("noise.log", random.Random(1).randbytes(50000))), BAD_INPUT, "known format")
        self.assert_refused(self.localize(log="nowhere.log"), BAD_INPUT, "no such file")
        self.assert_refused(self.localize(log="."), BAD_INPUT, "is a directory")

    def test_a_packed_log(self):
        self.write("whole.log.gz", gzip.compress((self.folder / "a.log").read_bytes()))
        self.assertEqual(self.localize(log="whole.log.gz").returncode, OK)

    def test_a_log_without_scans(self):
        lines = (self.folder / "a.log").read_text().splitlines()
        kept = "\n".join(line for line in lines if "LASER" not in line)
        self.assert_refused(self.localize(log=self.write("blind.log", kept)), USAGE, "no laser stream")

    def test_out(self):
        self.assert_refused(self.localize(out="a.log"), USAGE, "a.log", "is a file")
        self.assert_refused(self.localize(out="a.log/below"), USAGE, "is a file")
        self.assert_refused(self.run_cairn("localize", "--map", "a.map.yaml", "--log", "a.log", "--out", ""), USAGE, "--out")
        foreign = self.folder / "foreign"
        foreign.mkdir()
        (foreign / "letter.txt").write_text("mine")
        self.assert_refused(self.localize(out="foreign"), USAGE, "foreign", "choose an empty or new folder")
        self.assertEqual((foreign / "letter.txt").read_text(), "mine")
        self.assertEqual(self.localize(out="new/and/deep").returncode, OK)

    def test_references(self):
        rows = [line.split() for line in (self.folder / "a.truth.tum").read_text().splitlines() if line[0] != "#"]
        late = "".join(f"{float(row[0]) + 1e6:.6f} {' '.join(row[1:])}\n" for row in rows)
        self.write("late.tum", late)
        self.assert_refused(self.localize("--reference", "late.tum"), BAD_INPUT, "late.tum", "same clock")
        self.assertFalse((self.folder / self.id()).exists())
        self.assert_refused(self.localize("--reference", "nowhere.tum"), BAD_INPUT, "no such file")
        result = self.run_cairn("score", "--reference", "late.tum", "--estimate", "a.truth.tum")
        self.assert_refused(result, BAD_INPUT, "no reference stamp")

    def test_reports_of_no_run(self):
        for name in ["nowhere", "a.log", "."]:
            self.assert_refused(self.run_cairn("report", name), BAD_INPUT)


class Runs(CliTest):
    def test_tracking_and_its_files(self):
        result = self.localize("--reference", "a.truth.tum", init="reference")
        self.assertEqual(result.returncode, OK, result.stderr)
        self.assertIn("belief    tracking", result.stdout)
        self.assertNotRegex(result.stderr, "warning|error")
        for name in ["trajectory.tum", "estimate.csv", "metrics.json", "config.yaml", "map.yaml", "map.png"]:
            self.assertTrue((self.folder / self.id() / name).is_file(), name)
        metrics = self.metrics()
        self.assertLess(metrics["accuracy"]["ate_mean_m"], 0.06)
        self.assertLess(metrics["accuracy"]["ate_max_m"], 0.25)
        self.assertFalse(metrics["interrupted"])
        for stream in metrics["log"]["streams"]:
            self.assertEqual(sum(metrics["outcomes"][stream["name"]].values()), stream["messages"])
        scan = next(s for s in metrics["log"]["streams"] if s["kind"] == "laser_scan")
        self.assertEqual(scan["messages"], 301)

    def test_a_tour_of_the_whole_office(self):
        self.run_cairn("simulate", "office", "--out", "tour.log")
        reference = ["--reference", "tour.truth.tum"]
        known = self.localize(*reference, log="tour.log", map_="tour.map.yaml")
        self.assertEqual(known.returncode, OK, known.stderr)
        self.assertLess(self.metrics()["accuracy"]["ate_mean_m"], 0.03)
        self.assertLess(self.metrics()["accuracy"]["ate_max_m"], 0.2)
        for seed in ["1", "2", "3"]:
            anywhere = self.localize("--global", "--seed", seed, *reference, log="tour.log", map_="tour.map.yaml", init=None)
            self.assertEqual(anywhere.returncode, OK, anywhere.stderr)
            self.assertLess(self.metrics()["accuracy"]["ate_median_m"], 0.03)
            self.assertLess(self.metrics()["accuracy"]["ate_p95_m"], 0.1)

    def test_the_same_bytes_again_and_for_any_number_of_threads(self):
        names = ["first", "again", "two", "seven"]
        for name, threads in zip(names, [1, 1, 2, 7]):
            self.assertEqual(self.localize("--threads", str(threads), out=name).returncode, OK)
        for name in names[1:]:
            for file in ["trajectory.tum", "estimate.csv", "particles.csv"]:
                same = filecmp.cmp(self.folder / "first" / file, self.folder / name / file, shallow=False)
                self.assertTrue(same, f"{name}/{file}")

    def test_a_map_of_another_world_ends_lost(self):
        rows = [bytes(400) if row in (0, 399) else b"\0" + b"\xff" * 398 + b"\0" for row in range(400)]
        self.write("hall.pgm", b"P5\n400 400\n255\n" + b"".join(rows))
        hall = self.write("hall.yaml", "image: hall.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n")
        result = self.localize(map_=hall, init="10,10,0")
        self.assertEqual(result.returncode, LOST, result.stdout)
        self.assertIn("the run ended lost: ", result.stderr)
        self.assertTrue((self.folder / self.id() / "trajectory.tum").is_file())
        self.assertEqual(self.metrics()["verdict"], "lost")

    def test_an_interrupted_run_keeps_what_it_has_and_says_so(self):
        command = [PROGRAM, "localize", "--map", "a.map.yaml", "--log", "a.log", "--init", START, "--out", self.id(),
                   "--reference", "a.truth.tum", "--set", "recipe=mcl", "--set", "filter.particles=300000",
                   "--set", "update.min_translation_m=0", "--set", "laser.max_beams=180"]
        with subprocess.Popen(command, cwd=self.folder, stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as run:
            self.assertRegex(run.stderr.readline(), r"^localizing: \d0 %, \d+ (s|min) left$", "progress of long work")
            run.send_signal(signal.SIGINT)
            output, talk = run.communicate(timeout=60)
        self.assertEqual(run.returncode, FAILED, talk)
        self.assertIn("interrupted", talk)
        self.assertIn("written to", output)
        self.assertTrue(self.metrics()["interrupted"])
        poses = (self.folder / self.id() / "trajectory.tum").read_text().splitlines()
        self.assertGreater(len(poses), 20)
        self.assertLess(len(poses), 301)

    def test_json_is_json(self):
        self.assertEqual(self.localize().returncode, OK)
        estimate = f"{self.id()}/trajectory.tum"
        score = self.run_cairn("score", "--reference", "a.truth.tum", "--estimate", estimate, "--json")
        self.assertEqual(score.returncode, OK)
        self.assertLess(json.loads(score.stdout)["bad_share"], 0.01)
        self.assertEqual(json.loads(self.run_cairn("map", "info", "a.map.yaml", "--json").stdout)["resolution_m"], 0.05)
        json.loads(self.run_cairn("log", "info", "a.log", "--json").stdout)


class Places(CliTest):
    """The index from which recipes that reset draw: kept beside the map, made again when it is of no use."""

    def run_srl(self, out):
        result = self.localize("--set", "recipe=kld_srl", "--no-record", out=f"{self.id()}-{out}", init=None)
        self.assertIn(result.returncode, (OK, LOST), result.stderr)
        return result, (self.folder / f"{self.id()}-{out}" / "trajectory.tum").read_bytes()

    def test_the_index_is_kept_and_a_damaged_one_replaced(self):
        _, first = self.run_srl("first")
        (kept,) = self.folder.glob("a.map.yaml.places-*")
        good = kept.read_bytes()
        for damage in [b"", b"cairn places 1\n", good[:-5], good[:-1] + bytes([good[-1] ^ 1]), good.replace(b" ", b"x", 3), b"?" * 99]:
            kept.write_bytes(damage)
            result, again = self.run_srl("again")
            self.assertIn("made again", result.stderr)
            self.assertEqual(again, first)
            self.assertEqual(kept.read_bytes(), good)
        result, again = self.run_srl("kept")
        self.assertNotIn("made again", result.stderr)
        self.assertEqual(again, first)
        kept.unlink()
        kept.mkdir()  # nothing can be written there
        _, again = self.run_srl("nowhere")
        self.assertEqual(again, first)
        kept.rmdir()


class Spans(CliTest):
    def test_a_part_of_a_log(self):
        self.assertEqual(self.localize("--spans", "0-10").returncode, OK)
        stamps = [float(line.split()[0]) for line in (self.folder / self.id() / "trajectory.tum").read_text().splitlines()]
        self.assertLess(stamps[-1] - stamps[0], 10.0)
        self.assertGreater(stamps[-1] - stamps[0], 8.0)

    def test_parts_that_are_none(self):
        for spans in ["x", "5", "5-5", "9-3", "-3-4"]:
            self.assert_refused(self.localize(f"--spans={spans}", out="refused"), USAGE, "--spans")
        self.assert_refused(self.localize("--spans", "5000-6000", out="refused"), USAGE, "--spans")


NAV2 = """amcl:
  ros__parameters:
    use_sim_time: True
    alpha1: 0.15
    alpha2: 0.25
    alpha3: 0.2
    alpha4: 0.2
    alpha5: 0.2
    base_frame_id: "base_footprint"
    beam_skip_distance: 0.5
    beam_skip_error_threshold: 0.9
    beam_skip_threshold: 0.3
    do_beamskip: false
    global_frame_id: "map"
    lambda_short: 0.1
    laser_likelihood_max_dist: 1.75
    laser_max_range: 100.0
    laser_min_range: -1.0
    laser_model_type: "likelihood_field"
    max_beams: 90
    max_particles: 2500
    min_particles: 400
    odom_frame_id: "odom"
    pf_err: 0.055
    pf_z: 0.99
    recovery_alpha_fast: 0.09
    recovery_alpha_slow: 0.002
    resample_interval: 1
    robot_model_type: "nav2_amcl::DifferentialMotionModel"
    save_pose_rate: 0.5
    sigma_hit: 0.21
    tf_broadcast: true
    transform_tolerance: 1.0
    update_min_a: 0.22
    update_min_d: 0.26
    z_hit: 0.51
    z_max: 0.05
    z_rand: 0.49
    z_short: 0.05
    scan_topic: scan

bt_navigator:
  ros__parameters:
    global_frame: map
"""

if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
