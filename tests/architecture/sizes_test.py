"""Tests of scripts/sizes.py: that functions are found, and measured to the line."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
import sizes  # noqa: E402


class Functions(unittest.TestCase):
    def check(self, text, expected):
        self.assertEqual(sizes.functions(text), expected)

    def test_free_function(self):
        self.check("int f(int x) {\n  return x;\n}\n", [("f", 1, 3)])

    def test_namespace_and_class_are_no_functions(self):
        text = "namespace a {\nclass B : public C {\n  int f() const { return 1; }\n};\n}\n"
        self.check(text, [("f", 3, 1)])

    def test_blocks_and_lambdas_belong_to_their_function(self):
        text = "void f() {\n  if (x) {\n    g([](int y) { return y; });\n  }\n  for (;;) {\n  }\n}\nvoid h() {}\n"
        self.check(text, [("f", 1, 7), ("h", 8, 1)])

    def test_constructor_with_braces_in_its_initialisers(self):
        self.check("A::A(int x)\n    : a_{x}, b_(2), c_{3} {\n  g();\n}\n", [("A::A", 1, 4)])

    def test_initialisers_of_variables_are_no_functions(self):
        self.check("const int kA[] = {1, 2};\nstruct S {\n  int x{0};\n};\nint f() { return S{1}.x; }\n", [("f", 5, 1)])

    def test_braces_in_strings_comments_and_raw_strings(self):
        text = 'void f() {\n  g("}{", \'{\', R"x(}}})x");  // }\n  /* } */\n}\nint n = 1\'000;\nvoid h() {\n}\n'
        self.check(text, [("f", 1, 4), ("h", 6, 2)])

    def test_trailing_return_type_operator_and_test_macro(self):
        text = "auto f(int x) -> double {\n}\nPose2 operator*(A a, B b) {\n}\nTEST(Suite, Name) {\n}\n"
        self.check(text, [("f", 1, 2), ("operator*", 3, 2), ("TEST", 5, 2)])

    def test_template_head_is_not_counted(self):
        self.check("template <typename T>\nT f(T x) {\n  return x;\n}\n", [("f", 2, 3)])

    def test_aligned_struct_is_no_function(self):
        self.check("struct alignas(32) A {\n  int f() { return 1; }\n};\n", [("f", 2, 1)])

    def test_function_returning_a_struct(self):
        self.check("struct Result f(int x) {\n  return {};\n}\n", [("f", 1, 3)])


class Limits(unittest.TestCase):
    def exit_code(self, text):
        import contextlib
        import io
        import tempfile

        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
            path = Path(folder) / "x.cpp"
            path.write_text(text)
            return sizes.main([str(path)])

    def test_sixty_lines_pass_and_sixty_one_fail(self):
        self.assertEqual(self.exit_code("void f() {\n" + "  g();\n" * 58 + "}\n"), 0)
        self.assertEqual(self.exit_code("void f() {\n" + "  g();\n" * 59 + "}\n"), 1)

    def test_five_hundred_lines_pass_and_one_more_fails(self):
        self.assertEqual(self.exit_code("int a;\n" * 500), 0)
        self.assertEqual(self.exit_code("int a;\n" * 501), 1)


if __name__ == "__main__":
    unittest.main()
