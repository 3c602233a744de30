#!/usr/bin/env python3
"""Prints what a run of cairn_bench measured: times, and how much faster Cairn is than its peer.

usage: bench/summarize.py RESULT.json

Repetition k of `cairn/NAME` is paired with repetition k of `mrpt/NAME`; the ratios' median, 10th and 90th percentile
are printed. Judge by the 10th percentile: single times of a shared machine can be off by a factor of two.
"""

import json
import sys
from collections import defaultdict
from pathlib import Path


def percentile(values, share):
    """By linear interpolation between the sorted values."""
    ordered = sorted(values)
    place = share * (len(ordered) - 1)
    below = int(place)
    above = min(below + 1, len(ordered) - 1)
    return ordered[below] + (place - below) * (ordered[above] - ordered[below])


def spread(values):
    return percentile(values, 0.5), percentile(values, 0.1), percentile(values, 0.9)


def cpu():
    """Model name and the vector extensions that the processor offers."""
    info = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    fields = dict(line.split(":", 1) for line in info.split("\n\n")[0].splitlines() if ":" in line)
    fields = {key.strip(): value.strip() for key, value in fields.items()}
    flags = [flag for flag in fields.get("flags", "").split() if flag.startswith(("sse4", "avx", "fma", "bmi"))]
    return fields.get("model name", "unknown processor"), flags


def repetitions(results):
    """name -> list of (repetition, nanoseconds, nanoseconds per item or None)."""
    to_ns = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}
    runs = defaultdict(list)
    for run in results["benchmarks"]:
        if run["run_type"] != "iteration":
            continue
        if run.get("error_occurred"):
            print(f"{run['name']}: skipped, {run['error_message']}")
            continue
        per_item = 1e9 / run["items_per_second"] if run.get("items_per_second") else None
        runs[run["name"]].append((run["repetition_index"], run["cpu_time"] * to_ns[run["time_unit"]], per_item))
    return runs


def print_times(runs):
    print(f"{'benchmark':<45} {'median':>12} {'p10':>12} {'p90':>12} {'per item':>12}")
    for name, measured in sorted(runs.items()):
        median, low, high = spread([ns for _, ns, _ in measured])
        items = [per_item for _, _, per_item in measured if per_item]
        per_item = f"{percentile(items, 0.5):.2f} ns" if items else ""
        print(f"{name:<45} {median / 1e3:>9.1f} us {low / 1e3:>9.1f} us {high / 1e3:>9.1f} us {per_item:>12}")


def print_ratios(runs, peer="mrpt"):
    pairs = [(name.removeprefix("cairn/"), f"{peer}/" + name.removeprefix("cairn/")) for name in sorted(runs)]
    pairs = [(what, other) for what, other in pairs if other in runs and f"cairn/{what}" in runs]
    if not pairs:
        print(f"no ratios: nothing of {peer} was measured")
        return
    print(f"\n{f'time of {peer} / time of cairn':<45} {'median':>8} {'p10':>8} {'p90':>8}")
    for what, other in pairs:
        ours = {k: ns for k, ns, _ in runs[f"cairn/{what}"]}
        ratios = [ns / ours[k] for k, ns, _ in runs[other] if k in ours]
        median, low, high = spread(ratios)
        print(f"{what:<45} {median:>8.2f} {low:>8.2f} {high:>8.2f}   ({len(ratios)} pairs)")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    results = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    name, flags = cpu()
    print(f"{name}; {' '.join(flags)}\n")
    runs = repetitions(results)
    print_times(runs)
    print_ratios(runs)


if __name__ == "__main__":
    main()
