#!/usr/bin/env python3
"""World files, good and bad, through `cairn simulate`.

usage: tests/e2e/simulate_test.py CAIRN [unittest arguments]
"""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

OK, USAGE, BAD_INPUT = 0, 2, 3
SOURCE = Path(__file__).resolve().parents[2]
DATA = Path(os.environ.get("CAIRN_DATA", SOURCE.parent / "shared/data"))
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

    def test_real_buildings_are_worlds(self):
        for name, start in [("GHC7", "0,0,0"), ("NSH4", "20,30,0")]:
            floor = DATA / "vector_maps" / f"{name}_vector.txt"
            if not floor.exists():
                self.skipTest(f"no {floor}")
            text = f"file: {floor}\nmap_resolution_m: 0.1\nrobot: {{start: '{start}', mission: random, duration_s: 5}}\n"
            self.assertEqual(self.world(text + "lasers: {front: {rate_hz: 5, beams: 90}}\n").returncode, OK)

    def test_every_sensor_is_simulated_listed_and_replayed(self):
        world = SOURCE / "configs/worlds/every_sensor.yaml"
        small = ["--set", "depth_cameras.depth.width=64", "--set", "depth_cameras.depth.height=48"]
        for threads in [1, 2, 7]:
            result = self.simulate(world, "--duration", 8, "--threads", threads, "--out", f"s{threads}.mcap", *small)
            self.assertEqual(result.returncode, OK, result.stderr)
            self.assertEqual((self.folder / f"s{threads}.mcap").read_bytes(), (self.folder / "s1.mcap").read_bytes())
        info = subprocess.run([PROGRAM, "log", "info", "s1.mcap", "--json"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(info.returncode, OK, info.stderr)
        summary = json.loads(info.stdout)
        kinds = {stream["name"]: stream["kind"] for stream in summary["streams"]}
        self.assertEqual(kinds, {"odom": "odometry", "front": "laser_scan", "rear": "laser_scan", "ring": "sonar_scan",
                                 "depth": "depth_image", "wifi": "wifi_scan", "uwb": "beacon_ranges",
                                 "marks": "landmark_detections", "up": "ceiling_patch", "gyro": "imu_yaw_rate"})
        self.assertTrue(all(stream["messages"] > 0 for stream in summary["streams"]))
        self.assertEqual(summary["warnings"], [])
        localized = subprocess.run([PROGRAM, "localize", "--map", "s1.map.yaml", "--log", "s1.mcap", "--init", "2,3,0",
                                    "--out", "run"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(localized.returncode, OK, localized.stderr)
        metrics = json.loads((self.folder / "run/metrics.json").read_text())
        outcomes = metrics["outcomes"]
        counts = {stream["name"]: stream["messages"] for stream in summary["streams"]}
        for name in ["ring", "depth", "wifi", "uwb", "marks", "up", "gyro"]:
            self.assertEqual(sum(outcomes[name].values()), counts[name])
            self.assertEqual(len(outcomes[name]), 1, "all of them are unbound")
        replayed = subprocess.run([PROGRAM, "replay", "run"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(replayed.returncode, OK, replayed.stdout + replayed.stderr)

    def test_carmen_text_cannot_hold_every_sensor(self):
        result = self.simulate(SOURCE / "configs/worlds/every_sensor.yaml", "--duration", 2, "--out", "s.log")
        self.assertEqual(result.returncode, USAGE)
        self.assertIn(".mcap", result.stderr)
        self.assertFalse((self.folder / "s.log").exists())

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
        self.refused("lasers:", "lidars:", "w.yaml:8:1", "'lasers'")
        self.refused("lasers:", "sonars:\n  ring: {cone_rad: 9}\nlasers:", "w.yaml:9:20", "cone_rad")
        self.refused("lasers:", "sonars:\n  ring: {rate_hz: 1e9}\nlasers:", "w.yaml:9:19", "rate_hz")
        self.refused("lasers:", "sonars:\n  ring: {mount: '2,0,0'}\nlasers:", "w.yaml:9:10: sonars.ring.mount", "sticks out")
        self.refused("lasers:", "sonars:\n  ring: {colour: red}\nlasers:", "w.yaml:9:10", "colour")
        self.refused("lasers:", "wifi_radios:\n  wifi: {rate_hz: 1}\nlasers:", "w.yaml:9:3: wifi_radios.wifi", "access_points")
        self.refused("lasers:", "gyroscopes:\n  front: {rate_hz: 1}\nlasers:", "gyroscopes.front", "lasers.front")
        self.refused("lasers:", "access_points:\n  a: {at: here}\nlasers:", "access_points.a.at", "here")
        self.refused("lasers:", "depth_cameras:\n  d: {height_m: 5}\nlasers:", "depth_cameras.d.height_m", "ceiling")
        self.refused("closed: true", "closed: true\n    height_m: -2", "w.yaml:5:15", "height_m", "range")
        self.assertEqual(self.simulate("nowhere.yaml", "--out", "w.log").returncode, USAGE)
        self.assertEqual(self.simulate("office").returncode, USAGE)

    def test_what_lies_in_walls_or_is_no_size_is_refused(self):
        self.refused("robot:", "furniture:\n  box: {depth_m: 0}\nrobot:", "w.yaml:6:18", "depth_m", "range")
        self.refused("robot:", "furniture:\n  box: {center: '4,3', material: wood}\nrobot:", "w.yaml:6:34", "material", "wood")
        self.refused("robot:", "furniture:\n  box: {bottom_m: 2, height_m: 1}\nrobot:", "w.yaml:6:9: furniture.box.bottom_m", "upper side")
        self.refused("robot:", "people: {walking: -1}\nrobot:", "w.yaml:5:19", "walking", "range")
        self.refused("robot:", "doors:\n  d: {from: '1,1', to: '1,1'}\nrobot:", "w.yaml:6:20: doors.d.to", "begins")
        # A sensor in a wall: its robot would be in the wall, or it would stick out of the robot.
        self.refused("start: 1,1,0", "start: 7.9,1,0", "w.yaml:6:3: robot.start", "wall")
        self.refused("points: 7,5 1,1", "points: 7,5 1,1\n  kidnap_at_s: 3\n  kidnap_to: 0.1,3,0", "w.yaml:9:3: robot.kidnap_to", "wall")
        self.refused("points: 7,5 1,1", "points: 7,5 1,1\n  radius_m: -1", "w.yaml:8:13", "radius_m", "range")
        self.refused("start: 1,1,0", "start: 1,1,0\n  odometry: {rate_hz: 0}", "w.yaml:7:23", "rate_hz", "range")
        for table in ["sonars", "depth_cameras", "wifi_radios", "beacon_radios", "landmark_detectors", "ceiling_cameras", "gyroscopes"]:
            for rate in ["0", "1e9"]:
                self.refused("lasers:", f"{table}:\n  s: {{rate_hz: {rate}}}\nlasers:", "w.yaml:9:16", "rate_hz", "range")
        self.refused("robot:", "presets: none.yaml\nrobot:", "none.yaml")
        self.refused("points: 7,5 1,1", "mission: recorded", "w.yaml:5:1: robot.path", "fewer than two")

    def test_presets_come_before_the_world(self):
        (self.folder / "preset.yaml").write_text("lasers: {front: {beams: 45, rate_hz: 5}}\nrobot: {speed_mps: 0.5}\n")
        (self.folder / "w.yaml").write_text("presets: preset.yaml\n" + WORLD)
        printed = self.simulate("w.yaml", "--print")
        self.assertEqual(printed.returncode, OK, printed.stderr)
        self.assertIn("beams: 45", printed.stdout)
        self.assertIn("speed_mps: 0.5", printed.stdout)
        self.assertRegex(printed.stdout, "front:(\n.*)*?\n *rate_hz: 10", "the world's own keys come last")

    def test_the_noise_of_sensors_is_learnt_back(self):
        """A drive with known noise, and again along its truth: `log noise` and `tune` find what the simulator was told.
        Bounds are five standard errors or more (30 to 200 thousand readings)."""
        beacons = "beacons:\n  a: {at: '0.1,0.1', obstructed_share: 0.4, obstructed_mean_m: 2}\n  b: {at: '7.9,5.9'}\n" \
                  "beacon_radios:\n  uwb: {rate_hz: 10, bias_m: 0.2, sigma_range_m: 0.1, missed_share: 0}\n"
        text = WORLD.replace("    rate_hz: 10\n", "    rate_hz: 10\n    sigma_range_m: 0.02\n    no_return_share: 0.03\n    random_share: 0.05\n") + beacons
        (self.folder / "w.yaml").write_text(text)
        self.assertEqual(self.simulate("w.yaml", "--out", "w.mcap", "--duration", 120).returncode, OK)
        (self.folder / "again.yaml").write_text(text.replace("  points: 7,5 1,1\n", "  mission: recorded\n  path: w.truth.tum\n"))
        self.assertEqual(self.simulate("again.yaml", "--out", "again.mcap").returncode, OK)
        inputs = ["--map", "w.map.yaml", "--reference", "w.truth.tum", "--world", "w.yaml"]
        for log in ["w.mcap", "again.mcap"]:
            run = subprocess.run([PROGRAM, "log", "noise", "--log", log, *inputs, "--out", "n"], cwd=self.folder,
                                 capture_output=True, text=True, timeout=120)
            self.assertEqual(run.returncode, OK, run.stderr)
            noise = json.loads((self.folder / "n/noise.json").read_text())
            found = noise["metrics"]
            for key, truth, bound in [("no_return_share", 0.03, 0.005), ("scan_to_scan_far_share", 0.05, 0.02), ("uwb_bias_m", 0.2, 0.03),
                                      ("uwb_sigma_m", 0.1, 0.02), ("uwb_late_share", 0.2, 0.06)]:
                self.assertAlmostEqual(found[key], truth, delta=bound, msg=key)
            self.assertLess(found["sigma_hit_m"], 0.06, "2 cm, and cells of 5 cm")
            self.assertEqual(len(noise["distributions"]["beam"]), 201)
        for sensor, name in [("laser", "front"), ("uwb", "uwb")]:
            tuned = subprocess.run([PROGRAM, "tune", sensor, "--log", "w.mcap", *inputs, "--name", name, "--out", f"{sensor}.yaml"],
                                   cwd=self.folder, capture_output=True, text=True, timeout=120)
            self.assertEqual(tuned.returncode, OK, tuned.stderr)
        # What was learnt is a preset for a world.
        (self.folder / "w.yaml").write_text("presets: laser.yaml uwb.yaml\n" + WORLD + "beacons: {a: {at: '0.1,0.1'}, b: {at: '7.9,5.9'}}\n")
        self.assertEqual(self.simulate("w.yaml", "--out", "w.mcap", "--duration", 5).returncode, OK)
        nothing = subprocess.run([PROGRAM, "tune", "uwb", "--log", "w.mcap", *inputs[:4]], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(nothing.returncode, USAGE)
        refused = subprocess.run([PROGRAM, "log", "noise", "--log", "w.mcap", *inputs, "--out", "w.yaml"], cwd=self.folder,
                                 capture_output=True, text=True)
        self.assertEqual((refused.returncode, refused.stdout), (USAGE, ""), "refused before anything is measured")
        self.assertIn("w.yaml: is no folder", refused.stderr)
        self.assertIn("beacon", nothing.stderr)

    def test_the_noise_of_the_wheels_is_learnt_back(self):
        """What the simulator was told is found by `cairn tune odometry` within six of its standard errors (false alarm
        below 1e-6 each)."""
        settings = {"sigma_wheel_radius": 0, "sigma_wheel_base": 0, "sigma_per_sqrt_metre_m": 0.01,
                    "sigma_per_sqrt_metre_rad": 0.008}
        options = [word for key, value in settings.items() for word in ("--set", f"robot.odometry.{key}={value}")]
        self.assertEqual(self.world(WORLD, "--duration", "200", *options).returncode, OK)
        result = subprocess.run([PROGRAM, "tune", "odometry", "--log", "w.log", "--reference", "w.truth.tum", "--out",
                                 "motion.yaml", "--world", "wheels.yaml"], cwd=self.folder, capture_output=True, text=True,
                                timeout=120)
        self.assertEqual(result.returncode, OK, result.stderr)
        found = {line.split()[0]: (float(line.split()[1]), float(line.split()[3])) for line in result.stdout.splitlines()
                 if "+-" in line}
        for key, truth in {"distance_factor": 1, "turn_factor": 1, "drift_rad_per_m": 0, "sigma_per_sqrt_metre_m": 0.01,
                           "sigma_per_sqrt_metre_rad": 0.008}.items():
            value, error = found[key]
            self.assertLess(abs(value - truth), 6 * error, key)
        self.assertLess(found["sigma_per_sqrt_metre_m"][1], 0.002)
        # Both files are read by the commands that they are for.
        world = (self.folder / "wheels.yaml").read_text()
        self.assertEqual(self.world(WORLD.replace("robot:\n", world[world.index("robot:"):])).returncode, OK)
        localized = subprocess.run([PROGRAM, "localize", "--map", "w.map.yaml", "--log", "w.log", "--init", "1,1,0",
                                    "--config", "motion.yaml", "--out", "run"], cwd=self.folder, capture_output=True)
        self.assertEqual(localized.returncode, OK, localized.stderr)


if __name__ == "__main__":
    PROGRAM = str(Path(sys.argv.pop(1)).resolve())
    unittest.main()
