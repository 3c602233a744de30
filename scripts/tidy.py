#!/usr/bin/env python3
"""Runs clang-tidy on C++ files. Most of its time goes into the standard library's headers, so files that the build of
build/release compiles as one (CAIRN_UNITY) are also read as one.

    scripts/tidy.py [--checks CHECKS] [--jobs N] FILE ...

Joined files with a finding are read again one by one, so that what is told never comes from the joining. Ends with 1 if
there are findings.
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


def members(unit):
    """The sources that a translation unit of the build consists of."""
    if unit.parent.name != "Unity":
        return [unit]
    return [pathlib.Path(name) for name in re.findall(r'^#include "(.*\.cpp)"$', unit.read_text(), re.M)]


def compile_commands():
    """Of each source and each joined unit, as entries of a compilation database; and the members of the units."""
    entries, units = {}, {}
    for entry in json.loads((ROOT / "build/release/compile_commands.json").read_text()):
        unit = pathlib.Path(entry["file"])
        command = entry["command"].replace("-Werror", "")
        units[unit] = members(unit)
        for file in [unit, *units[unit]]:
            entries[file] = {**entry, "file": str(file), "command": command.replace(str(unit), str(file))}
    return entries, units


def reading_jobs(files, units):
    """Units with two files to be read or more, and the other files: each with the files that it stands for."""
    wanted, jobs = set(files), []
    for unit, parts in units.items():
        asked = [part for part in parts if part in wanted]
        jobs += [(unit, asked)] if len(asked) > 1 else [(part, [part]) for part in asked]
        wanted -= set(asked)
    if wanted:
        sys.exit(f"tidy.py: {min(wanted)} is not compiled by the preset release")
    return jobs


def findings(path, checks):
    """What clang-tidy says about one file, or nothing if it is satisfied."""
    run = subprocess.run(
        ["clang-tidy-14", "--quiet", f"--config-file={ROOT}/.clang-tidy", f"--checks={checks}",
         r"--header-filter=/(cairn|apps)/.*\.[ch]pp$", "-p", str(WORK), str(path)], capture_output=True, text=True)
    return "" if run.returncode == 0 else run.stdout or run.stderr


def read(job, checks):
    unit, files = job
    if len(files) > 1 and not findings(unit, f"{checks},-bugprone-suspicious-include"):
        return ""
    return "".join(findings(file, checks) for file in files)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--checks", default="", help="added to those of .clang-tidy")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("files", nargs="*", metavar="FILE")
    arguments = parser.parse_args()
    entries, units = compile_commands()
    jobs = reading_jobs([pathlib.Path(file).resolve() for file in arguments.files], units)
    WORK.mkdir(parents=True, exist_ok=True)
    (WORK / "compile_commands.json").write_text(json.dumps(list(entries.values())))
    told = ""
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for said in pool.map(read, jobs, [arguments.checks] * len(jobs)):
            sys.stdout.write(said)
            told += said
    print(f"{len(arguments.files)} files, {len(jobs)} readings")
    sys.exit(1 if told else 0)


if __name__ == "__main__":
    main()
