#!/usr/bin/env python3
"""Writes the table of docs/performance.md and its plot from the rows of bench/summarize.py.

usage: bench/report.py ROWS.json
"""

import json
import math
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parent.parent / "docs"
BEGIN, END = "<!-- table: made by scripts/bench --report -->", "<!-- end of table -->"

# What is asked of the 10th percentile of the ratios: kernel, n, path -> at least.
TARGETS = {
    ("likelihood_field_tracking", 500, "avx2"): 50,
    ("likelihood_field_tracking", 2000, "avx2"): 60,
    ("likelihood_field_tracking", 10000, "avx2"): 60,
    ("likelihood_field_tracking", 2000, "scalar"): 15,
    ("beam_model_tracking", 500, "avx2"): 25,
    ("motion_sampling", 2000, "avx2"): 100,
    ("resample_kld", 2000, "avx2"): 12,
    ("whole_step", 500, "avx2"): 60,
    ("whole_step", 2000, "avx2"): 60,
    ("whole_step", 10000, "avx2"): 60,
    ("distance_field_30cm", 1000, "avx2"): 100,
    ("distance_field_30cm", 4000, "avx2"): 100,
}


def table(document):
    lines = [f"Measured on: {document['cpu']} ({document['paths']}), {document['repetitions']} repetitions.", "",
             "| kernel | n | path | ns per item | times MRPT, p10 | median | p90 | asked |", "|---|---|---|---|---|---|---|---|"]
    for row in document["rows"]:
        asked = TARGETS.get((row["kernel"], row["n"], row["path"]))
        ratios = [f"{row[key]:.1f}" if row[key] else "" for key in ("ratio_p10", "ratio_median", "ratio_p90")]
        verdict = "" if asked is None or not row["ratio_p10"] else f"{asked} {'✓' if row['ratio_p10'] >= asked else '✗'}"
        per_item = f"{row['ns_per_item']:.2f}" if row["ns_per_item"] else ""
        lines.append(f"| {row['kernel']} | {row['n']} | {row['path']} | {per_item} | {' | '.join(ratios)} | {verdict} |")
    return "\n".join(lines)


def plot(document):
    """Bars from p10 to p90 with the median, on a logarithmic axis; a tick where something is asked."""
    rows = [row for row in document["rows"] if row["ratio_p10"]]
    left, width, step = 330, 520, 17
    height = step * len(rows) + 40
    largest = math.log10(max(row["ratio_p90"] for row in rows) * 1.2)
    place = lambda ratio: left + width * max(0.0, math.log10(max(ratio, 1.0))) / largest
    colours = {"scalar": "#9aa5b1", "sse4": "#6fa8dc", "avx2": "#2f6fb0", "avx512": "#173f6b"}
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{left + width + 30}" height="{height}" font-family="sans-serif" font-size="11">',
             f'<rect width="100%" height="100%" fill="white"/><text x="{left}" y="12">times as fast as MRPT: 10th percentile, median, 90th</text>']
    for tick in (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000):
        if math.log10(tick) <= largest:
            parts.append(f'<line x1="{place(tick):.1f}" x2="{place(tick):.1f}" y1="18" y2="{height - 18}" stroke="#ddd"/>'
                         f'<text x="{place(tick):.1f}" y="{height - 6}" text-anchor="middle">{tick}</text>')
    for i, row in enumerate(rows):
        y = 22 + i * step
        low, middle, high = (place(row[key]) for key in ("ratio_p10", "ratio_median", "ratio_p90"))
        parts.append(f'<text x="{left - 6}" y="{y + 9}" text-anchor="end">{row["kernel"]} {row["n"]} {row["path"]}</text>'
                     f'<rect x="{left}" y="{y + 2}" width="{low - left:.1f}" height="8" fill="{colours.get(row["path"], "#888")}"/>'
                     f'<line x1="{low:.1f}" x2="{high:.1f}" y1="{y + 6}" y2="{y + 6}" stroke="#333"/>'
                     f'<circle cx="{middle:.1f}" cy="{y + 6}" r="2.5" fill="#333"/>')
        asked = TARGETS.get((row["kernel"], row["n"], row["path"]))
        if asked:
            parts.append(f'<line x1="{place(asked):.1f}" x2="{place(asked):.1f}" y1="{y}" y2="{y + 12}" stroke="#c0392b" stroke-width="2"/>')
    return "\n".join(parts + ["</svg>"]) + "\n"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    document = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    page = DOCS / "performance.md"
    text = page.read_text(encoding="utf-8")
    before, rest = text.split(BEGIN)
    after = rest.split(END)[1]
    page.write_text(f"{before}{BEGIN}\n{table(document)}\n{END}{after}", encoding="utf-8")
    (DOCS / "images" / "performance.svg").write_text(plot(document), encoding="utf-8")


if __name__ == "__main__":
    main()
