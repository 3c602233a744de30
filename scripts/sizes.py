#!/usr/bin/env python3
"""Tells how long functions and files are; fails for a function over 60 lines or a file over 500.

usage: scripts/sizes.py [FILE ...]     default: all C++, Python and JavaScript files that git tracks

A function's length is the number of lines from its name to its closing brace. The scanner knows just enough C++:
comments and strings are blanked, then every brace that opens a function body outside another one is counted.
"""

import re
import statistics
import subprocess
import sys
from pathlib import Path

MAX_FUNCTION_LINES = 60
MAX_FILE_LINES = 500
CPP = {".cpp", ".hpp", ".cc", ".h"}
OTHER = {".py", ".js", ".mjs", ".ts", ".css"}

NOISE = re.compile(
    r'R"(?P<delimiter>[^(\s]*)\(.*?\)(?P=delimiter)"'  # raw string
    r'|"(?:\\.|[^"\\\n])*"'  # string
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'"  # character, not the separator in 1'000
    r"|//[^\n]*|/\*.*?\*/"  # comments
    r"|^[ \t]*\#(?:\\\n|[^\n])*",  # preprocessor lines
    re.DOTALL | re.MULTILINE,
)
TYPE_SCOPE = re.compile(r"\b(namespace|class|struct|enum|union|concept|extern)\b[^()]*$")
MEMBER_INITIALISER = re.compile(r"\)\s*(noexcept\s*)?:(?!:).*[\w>]$", re.DOTALL)
ALIGNAS = re.compile(r"\balignas\([^()]*\)")
NAME = re.compile(r"(operator\s*[^\s(]+|operator\s*\(\s*\)|[~\w:]+)\s*\(")


def blank_noise(text):
    """The same text with comments, strings and preprocessor lines blanked; line breaks stay."""
    return NOISE.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


def opens_function(header):
    header = ALIGNAS.sub("", header)
    if "(" not in header or TYPE_SCOPE.search(header):
        return False
    return not header.endswith(("=", ",", "(", "return"))


def functions(text):
    """(name, first line, number of lines) of every function of a C++ text."""
    text = blank_noise(text)
    found, scopes, start = [], [], 0  # scopes: where each open brace belongs: a function's header start, or None
    depth_in_function = 0
    for position in (match.start() for match in re.finditer(r"[{};]", text)):
        symbol = text[position]
        if symbol == "}":
            if not scopes:
                continue
            scope = scopes.pop()
            if scope == "initialiser":
                continue  # the header goes on behind it
            if scope is not None:
                depth_in_function -= 1
                if depth_in_function == 0:
                    found.append(describe(text, scope, position))
        elif symbol == "{":
            header = text[start:position].strip()
            if depth_in_function == 0 and MEMBER_INITIALISER.search(header):
                scopes.append("initialiser")
                continue
            body = depth_in_function > 0 or opens_function(header)
            scopes.append(start if body else None)
            depth_in_function += 1 if body else 0
        start = position + 1
    return found


def describe(text, start, end):
    begin = start + len(text[start:end]) - len(text[start:end].lstrip())
    name = NAME.search(text, begin)
    first = text.count("\n", 0, name.start() if name else begin) + 1
    last = text.count("\n", 0, end) + 1
    return (name.group(1) if name else "?", first, last - first + 1)


def tracked_files():
    listing = subprocess.run(["git", "ls-files"], check=True, capture_output=True, text=True).stdout
    return [Path(line) for line in listing.splitlines() if Path(line).suffix in CPP | OTHER and Path(line).exists()]


def percentile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))]


def main(arguments):
    if arguments and arguments[0] in ("-h", "--help"):
        print(__doc__)
        return 0
    files = [Path(argument) for argument in arguments] or tracked_files()
    lengths, file_lengths, problems = [], [], []
    for path in files:
        text = path.read_text(encoding="utf-8", errors="replace")
        file_lengths.append(text.count("\n"))
        if file_lengths[-1] > MAX_FILE_LINES:
            problems.append(f"{path}: {file_lengths[-1]} lines; split it (limit {MAX_FILE_LINES})")
        if path.suffix not in CPP:
            continue
        for name, line, length in functions(text):
            lengths.append((length, path, line, name))
            if length > MAX_FUNCTION_LINES:
                problems.append(f"{path}:{line}: {name} has {length} lines; split it (limit {MAX_FUNCTION_LINES})")
    if lengths:
        only = [length for length, *_ in lengths]
        print(
            f"{len(files)} files, longest {max(file_lengths)} lines; {len(only)} functions: median "
            f"{statistics.median(only):g}, 90 % up to {percentile(only, 0.9)}, longest {max(only)} lines"
        )
        for length, path, line, name in sorted(lengths, key=lambda item: -item[0])[:5]:
            print(f"  {length:4d}  {path}:{line}  {name}")
    for problem in problems:
        print(f"error: {problem}")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
