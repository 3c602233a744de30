"""Tests of check_includes.py: every kind of violation is found, and what is allowed passes."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import check_includes  # noqa: E402


class CheckIncludes(unittest.TestCase):
    def violations(self, name, *lines):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / name
            path.parent.mkdir(parents=True)
            path.write_text("\n".join(lines) + "\n")
            return list(check_includes.violations(Path(folder)))

    def refused(self, name, line):
        found = self.violations(name, "#pragma once", line)
        self.assertEqual(len(found), 1, found)
        self.assertTrue(found[0].startswith(f"{name}:2: "), found)

    def allowed(self, name, line):
        self.assertEqual(self.violations(name, line), [])

    def test_core_includes_nothing_of_cairn(self):
        self.refused("cairn/core/x.hpp", '#include "cairn/sensing/event.hpp"')
        self.allowed("cairn/core/x.hpp", '#include "cairn/core/angle.hpp"')

    def test_sensing_maps_and_bayes_do_not_know_each_other(self):
        folders = ("sensing", "maps", "bayes")
        for a in folders:
            for b in folders:
                check = self.allowed if a == b else self.refused
                check(f"cairn/{a}/x.cpp", f'#include "cairn/{b}/y.hpp"')

    def test_angle_brackets_and_spaces_do_not_hide_it(self):
        self.refused("cairn/maps/x.cpp", "#  include <cairn/io/log.hpp>")

    def test_sub_folders_follow_the_rule_of_their_folder(self):
        self.refused("cairn/models/sensor/x.cpp", '#include "cairn/localization/localizer.hpp"')
        self.allowed("cairn/models/sensor/x.cpp", '#include "cairn/maps/occupancy_grid.hpp"')

    def test_eval_knows_the_result_types_only(self):
        self.allowed("cairn/eval/x.hpp", '#include "cairn/localization/estimate.hpp"')
        self.refused("cairn/eval/x.hpp", '#include "cairn/localization/localizer.hpp"')

    def test_the_library_knows_no_application(self):
        self.refused("cairn/io/x.cpp", '#include "apps/cairn/commands.hpp"')
        self.refused("cairn/io/x.cpp", "#include <iostream>")
        self.refused("cairn/io/x.cpp", "#include <spdlog/spdlog.h>")

    def test_a_new_folder_needs_a_rule(self):
        self.refused("cairn/misc/x.cpp", '#include "cairn/core/angle.hpp"')


if __name__ == "__main__":
    unittest.main()
