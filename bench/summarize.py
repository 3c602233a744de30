#!/usr/bin/env python3
"""Turns a run of cairn_bench into rows: how long each kernel takes, and how much faster it is than its peer.

usage: bench/summarize.py RESULT.json ROWS.json

RESULT.json is Google Benchmark's. Repetition k of `cairn/KERNEL/PATH/N` is paired with repetition k of `mrpt/KERNEL/N`;
the ratios' median, 10th and 90th percentile go into ROWS.json: a list of {kernel, n, peer, path, ratio_p10, ratio_median,
ratio_p90, ns, ns_per_item} under "rows", beside the processor. Judge by the 10th percentile: single times of a shared
machine can be off by a factor of two. CPU time is measured, not time on the wall.
"""

import json
import sys
from collections import defaultdict
from pathlib import Path

PATHS = ["scalar", "sse4", "avx2", "avx512"]
BEST = "best"  # what does not choose its instructions runs with the best there are


def percentile(values, share):
    """By linear interpolation between the sorted values."""
    ordered = sorted(values)
    place = share * (len(ordered) - 1)
    below = int(place)
    above = min(below + 1, len(ordered) - 1)
    return ordered[below] + (place - below) * (ordered[above] - ordered[below])


def cpu():
    """Model name and the vector extensions that the processor offers."""
    info = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    fields = dict(line.split(":", 1) for line in info.split("\n\n")[0].splitlines() if ":" in line)
    fields = {key.strip(): value.strip() for key, value in fields.items()}
    flags = [flag for flag in fields.get("flags", "").split() if flag.startswith(("sse4", "avx", "fma", "bmi"))]
    return fields.get("model name", "unknown processor"), flags


def repetitions(results):
    """name -> {repetition: (nanoseconds, nanoseconds per item or None)}"""
    to_ns = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}
    runs = defaultdict(dict)
    for run in results["benchmarks"]:
        if run["run_type"] != "iteration":
            continue
        if run.get("error_occurred"):
            print(f"{run['name']}: skipped, {run['error_message']}")
            continue
        per_item = 1e9 / run["items_per_second"] if run.get("items_per_second") else None
        runs[run["name"]][run["repetition_index"]] = (run["cpu_time"] * to_ns[run["time_unit"]], per_item)
    return runs


def row_of(name, runs):
    """The row of one of our benchmarks; without ratios where the peer has no counterpart."""
    parts = name.split("/")
    if parts[0] != "cairn" or len(parts) < 3:
        return None
    n = int(parts.pop()) if parts[-1].isdigit() else 1
    path = parts.pop(2) if len(parts) > 2 and parts[2] in PATHS else BEST
    kernel = "_".join(parts[1:])
    ours, theirs = runs[name], runs.get(f"mrpt/{kernel}/{n}", {})
    ratios = [theirs[k][0] / ours[k][0] for k in ours if k in theirs]
    items = [per_item for _, per_item in ours.values() if per_item]
    row = {"kernel": kernel, "n": int(n), "peer": "mrpt" if ratios else None, "path": path}
    for key, share in (("ratio_p10", 0.1), ("ratio_median", 0.5), ("ratio_p90", 0.9)):
        row[key] = round(percentile(ratios, share), 2) if ratios else None
    row["ns"] = round(percentile([ns for ns, _ in ours.values()], 0.5), 1)
    row["ns_per_item"] = round(percentile(items, 0.5), 3) if items else None
    return row


def print_rows(rows):
    print(f"{'kernel':<28} {'n':>6} {'path':>7} {'ns/item':>9} | {'p10':>7} {'median':>7} {'p90':>7}  times MRPT's speed")
    for row in rows:
        ratios = [row[key] for key in ("ratio_p10", "ratio_median", "ratio_p90")]
        shown = " ".join(f"{r:>7.1f}" if r else f"{'-':>7}" for r in ratios)
        print(f"{row['kernel']:<28} {row['n']:>6} {row['path']:>7} {row['ns_per_item'] or 0:>9.2f} | {shown}")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    results = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    name, flags = cpu()
    paths = results["context"].get("cairn_simd_paths", "")
    print(f"{name}; {' '.join(flags)}\npaths: {paths}\n")
    runs = repetitions(results)
    rows = [row for row in (row_of(name, runs) for name in runs) if row]
    rows.sort(key=lambda row: (row["kernel"], row["n"], [*PATHS, BEST].index(row["path"])))
    print_rows(rows)
    count = max((len(found) for found in runs.values()), default=0)
    document = {"cpu": name, "flags": flags, "paths": paths, "repetitions": count, "rows": rows}
    Path(sys.argv[2]).write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
