#!/usr/bin/env python3
"""Checks the dependency rule of docs/architecture.md on the #include lines of the sources.

usage: tests/architecture/check_includes.py [ROOT]      default: the repository

Prints one line per violation and ends with 1 if there is any.
"""

import re
import sys
from pathlib import Path

# Folder of cairn/ -> the other folders of cairn/ that it may include.
RULES = {
    "core": set(),
    "sensing": {"core"},
    "maps": {"core"},
    "bayes": {"core"},
    "models": {"core", "sensing", "maps", "bayes"},
    "localization": {"core", "sensing", "maps", "bayes", "models"},
    "io": {"core", "sensing", "maps"},
    "sim": {"core", "sensing", "maps"},
    "eval": {"core", "sensing", "maps"},
}
# Single headers that a folder may include besides: the result types of a localizer, to evaluate and record them.
EXCEPTIONS = {("eval", "cairn/localization/estimate.hpp"), ("io", "cairn/localization/estimate.hpp")}
# Headers that only the application may include: the library never prints.
APPLICATION_ONLY = re.compile(r"^(iostream|spdlog/.*|CLI/.*)$")

INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')
SOURCES = ("*.cpp", "*.hpp")


def includes(path):
    """(line number, header) of every include of a file."""
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    for number, line in enumerate(lines, 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1) or match.group(2)


def complaint(folder, header):
    """Why a file of cairn/<folder>/ may not include the header, or None."""
    if folder not in RULES:
        return f"cairn/{folder} is no folder of the dependency rule"
    parts = header.split("/")
    if APPLICATION_ONLY.match(header):
        return f"the library must not include <{header}>: it never prints and knows no command line"
    if parts[0] in ("apps", "bridges", "python"):
        return f"the library must not include {header}: adapters include the library, not the other way"
    if parts[0] != "cairn" or len(parts) < 3:
        return None
    allowed = parts[1] == folder or parts[1] in RULES[folder] or (folder, header) in EXCEPTIONS
    return None if allowed else f"{folder} must not include {parts[1]} ({header})"


def violations(root):
    library = root / "cairn"
    for path in sorted(path for pattern in SOURCES for path in library.rglob(pattern)):
        folder = path.relative_to(library).parts[0]
        for line, header in includes(path):
            reason = complaint(folder, header)
            if reason:
                yield f"{path.relative_to(root)}:{line}: {reason}"


def main(arguments):
    root = Path(arguments[0]) if arguments else Path(__file__).resolve().parents[2]
    if not (root / "cairn").is_dir():
        print(f"{root}: has no folder cairn/", file=sys.stderr)
        return 2
    found = list(violations(root))
    print("\n".join(found) if found else "the dependency rule holds")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
