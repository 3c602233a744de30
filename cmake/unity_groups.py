#!/usr/bin/env python3
"""Chooses which source files are compiled as one, for most of a compiler's time goes into the headers that they share.

    cmake/unity_groups.py SIZE FILE ...     prints one line 'GROUP FILE' for each file that is joined, SIZE per group at most

Files are joined only if they lie in one folder and their unnamed namespaces have no name in common. Files that are compiled
once per set of instructions (HWY_TARGET), or that open a namespace at file scope, stay alone and are not printed.
"""
import pathlib
import re
import sys

DEFINED = re.compile(
    r"^(?:template\s*<[^>]*>\s*)?(?:\[\[\w+\]\]\s*)?(?:inline\s+|static\s+)*"
    r"(?:(?:struct|class|union|enum class|enum)\s+(\w+)|(?:using|namespace)\s+(\w+)\s*="
    r"|[A-Za-z][\w:<>&*,\s\[\]]*?[\s&*](\w+)\s*\()", re.M)
CONSTANTS = re.compile(r"^(?:inline |static )*const(?:expr)?\b[^;]*;", re.M)
CONSTANT = re.compile(r"\b(\w+)\s*(?:\[[^\]]*\])?\s*[={]")
ENUMERATORS = re.compile(r"^enum (?!class)[^{;]*\{([^}]*)\}", re.M)
ENUMERATOR = re.compile(r"(\w+)\s*(?:=[^,]*)?(?:,|$)")
USED = re.compile(r"^using ((?:\w+::)*(\w+));", re.M)
OPENED = re.compile(r"^using namespace (?!std::[\w:]*literals;)", re.M)


def local_names(file, source):
    """What each name means that a file has for itself: at the left margin of its unnamed namespaces, and its macros."""
    names = {name: file for name in re.findall(r"^#define (\w+)", source, re.M)}
    for block in re.findall(r"^namespace \{$(.*?)^\}  // namespace$", source, re.M | re.S):
        names |= {name: meaning for meaning, name in USED.findall(block)}
        names |= {name: file for found in DEFINED.finditer(block) for name in found.groups() if name}
        names |= {name: file for some in CONSTANTS.findall(block) for name in CONSTANT.findall(some)}
        names |= {name: file for some in ENUMERATORS.findall(block) for name in ENUMERATOR.findall(some)}
    return names


def agree(names, others):
    return all(others.get(name, meaning) == meaning for name, meaning in names.items())


def must_stay_alone(source):
    return "HWY_TARGET" in source or OPENED.search(source)


def grouped(files, size):
    """Puts each file into the first group of its folder that has room and no name in common with it."""
    groups = []
    for file in files:
        source = file.read_text()
        if must_stay_alone(source):
            continue
        names = local_names(file, source)
        group = next((g for g in groups if g["folder"] == file.parent and len(g["files"]) < size
                      and agree(names, g["names"])), None)
        if group is None:
            group = {"folder": file.parent, "files": [], "names": {}}
            groups.append(group)
        group["files"].append(file)
        group["names"] |= names
    return [g["files"] for g in groups]


if __name__ == "__main__":
    for number, files in enumerate(grouped([pathlib.Path(name) for name in sys.argv[2:]], int(sys.argv[1]))):
        for file in files:
            print(number, file)
