#!/usr/bin/env python3
"""Runs clang-tidy on C++ files, several files of one folder at a time: most of its time goes into the standard library's
headers, which it then reads once per group and not once per file.

    scripts/tidy.py [--checks CHECKS] [--jobs N] FILE ...        the compile commands are those of build/release

Files are joined only if their unnamed namespaces have no name in common. A group with a finding is read again file by
file, so that what is told never comes from the joining. Ends with 1 if there are findings.
"""
import argparse
import concurrent.futures
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
WORK = ROOT / "build" / "tidy"
GROUP_SIZE = 10
DEFINED = re.compile(
    r"^(?:template\s*<[^>]*>\s*)?(?:inline\s+|static\s+)*"
    r"(?:(?:struct|class|union|enum class|enum|using|namespace)\s+(\w+)"
    r"|(?:constexpr|const)\b[^=({]*?\b(\w+)\s*(?:\[[^\]]*\])?\s*[={]"
    r"|[A-Za-z][\w:<>&*,\s\[\]]*?[\s&*](\w+)\s*\()", re.M)


def local_names(source):
    """Names that a file defines for itself: at the left margin of its unnamed namespaces, and its macros."""
    names = set(re.findall(r"^#define (\w+)", source, re.M))
    for block in re.findall(r"^namespace \{$(.*?)^\}  // namespace$", source, re.M | re.S):
        names |= {name for found in DEFINED.finditer(block) for name in found.groups() if name}
    return names


def must_stay_alone(source):
    return "HWY_TARGET" in source or re.search(r"^using namespace", source, re.M)


def grouped(files):
    """Puts each file into the first group of its folder that has room and no name in common with it."""
    groups = []
    for file in files:
        source = file.read_text()
        names = local_names(source)
        group = None if must_stay_alone(source) else next(
            (g for g in groups if g["folder"] == file.parent and len(g["files"]) < GROUP_SIZE and g["open"]
             and not g["names"] & names), None)
        if group is None:
            group = {"folder": file.parent, "files": [], "names": set(), "open": not must_stay_alone(source)}
            groups.append(group)
        group["files"].append(file)
        group["names"] |= names
    return [g["files"] for g in groups]


def compile_commands():
    entries = json.loads((ROOT / "build/release/compile_commands.json").read_text())
    return {pathlib.Path(entry["file"]): {**entry, "command": entry["command"].replace("-Werror", "")}
            for entry in entries}


def write_database(groups, commands):
    """One source per group in build/tidy; returns its path for each group."""
    WORK.mkdir(parents=True, exist_ok=True)
    entries, joined = list(commands.values()), []
    for number, group in enumerate(groups):
        if group[0] not in commands:
            sys.exit(f"tidy.py: {group[0]} is not compiled by the preset release")
        path = WORK / f"group_{number}.cpp"
        path.write_text("".join(f'#include "{file}"\n' for file in group))
        first = commands[group[0]]
        entries.append({**first, "file": str(path), "command": first["command"].replace(str(group[0]), str(path))})
        joined.append(path)
    (WORK / "compile_commands.json").write_text(json.dumps(entries))
    return joined


def findings(path, checks):
    """What clang-tidy says about one file, or nothing if it is satisfied."""
    run = subprocess.run(
        ["clang-tidy-14", "--quiet", f"--config-file={ROOT}/.clang-tidy", f"--checks={checks}",
         r"--header-filter=/(cairn|apps)/.*\.[ch]pp$", "-p", str(WORK), str(path)], capture_output=True, text=True)
    return "" if run.returncode == 0 else run.stdout or run.stderr


def read_group(group, joined, checks):
    if len(group) > 1 and not findings(joined, f"{checks},-bugprone-suspicious-include"):
        return ""
    return "".join(findings(file, checks) for file in group)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--checks", default="", help="added to those of .clang-tidy")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("files", nargs="*", metavar="FILE")
    arguments = parser.parse_args()
    groups = grouped([pathlib.Path(file).resolve() for file in arguments.files])
    joined = write_database(groups, compile_commands())
    told = ""
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for said in pool.map(read_group, groups, joined, [arguments.checks] * len(groups)):
            sys.stdout.write(said)
            told += said
    print(f"{sum(map(len, groups))} files in {len(groups)} groups")
    sys.exit(1 if told else 0)


if __name__ == "__main__":
    main()
