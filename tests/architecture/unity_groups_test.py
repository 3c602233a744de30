"""Tests of cmake/unity_groups.py: which names of a file keep it from being compiled as one with others."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "cmake"))
import unity_groups  # noqa: E402


def unnamed(text):
    return f"namespace cairn {{\nnamespace {{\n\n{text}\n\n}}  // namespace\n}}  // namespace cairn\n"


class Names(unittest.TestCase):
    def check(self, text, expected):
        self.assertEqual(set(unity_groups.local_names("file", unnamed(text))), set(expected))

    def test_functions(self):
        self.check("double f(int x) {\n  const int kInside = 1;\n  return kInside;\n}", ["f"])
        self.check("[[noreturn]] void refuse(const std::string& what) {}", ["refuse"])
        self.check("template <class T>\nstd::vector<T> listed(T one) {}", ["listed"])

    def test_types(self):
        self.check("struct A {\n  int x;\n};\nclass B;\nusing C = std::vector<int>;", ["A", "B", "C"])
        self.check("enum Draw : int { kNoise = 0, kFate, kLast = 7 };", ["Draw", "kNoise", "kFate", "kLast"])

    def test_constants_in_a_row(self):
        self.check("constexpr int kA = 0, kB = 1;\nconst double kC[] = {1.0};\nconstexpr Range kD{0.0, 1.0};",
                   ["kA", "kB", "kC", "kD"])

    def test_macros(self):
        self.assertIn("SKIP", unity_groups.local_names("file", "#define SKIP(x) x\n"))


class Groups(unittest.TestCase):
    def grouped(self, sources, size=8):
        with tempfile.TemporaryDirectory() as folder:
            files = []
            for name, text in sources.items():
                files.append(Path(folder) / name)
                files[-1].parent.mkdir(exist_ok=True)
                files[-1].write_text(text)
            return [[file.name for file in group] for group in unity_groups.grouped(files, size)]

    def test_equal_names_keep_files_apart(self):
        a, b, c = unnamed("int f() {}"), unnamed("double f(int x) {}"), unnamed("int g() {}")
        self.assertEqual(self.grouped({"a.cpp": a, "b.cpp": b, "c.cpp": c}), [["a.cpp", "c.cpp"], ["b.cpp"]])

    def test_one_using_declaration_may_stand_in_many_files(self):
        same, other = unnamed("using test::at;"), unnamed("using std::at;")
        self.assertEqual(self.grouped({"a.cpp": same, "b.cpp": same, "c.cpp": other}), [["a.cpp", "b.cpp"], ["c.cpp"]])

    def test_folders_and_full_groups(self):
        self.assertEqual(self.grouped({"a.cpp": "", "b.cpp": "", "c.cpp": "", "d/e.cpp": ""}, 2),
                         [["a.cpp", "b.cpp"], ["c.cpp"], ["e.cpp"]])

    def test_what_must_stay_alone_is_in_no_group(self):
        opened, literals = "using namespace cairn;\n", "using namespace std::chrono_literals;\n"
        self.assertEqual(self.grouped({"a.cpp": opened, "b.cpp": "#define HWY_TARGET_INCLUDE\n", "c.cpp": literals}),
                         [["c.cpp"]])


if __name__ == "__main__":
    unittest.main()
