"""Charts of the unit square as SVG, for scripts/kidnapping and scripts/calibrate_monitor."""
import pathlib

COLOURS = ["#1668c7", "#c7511f", "#2a8f4e", "#8a3fb0", "#b08a00", "#1f9fb0", "#b0305f", "#555555"]
SIZE, PAD = 320, 46


def at(point):
    return f"{PAD + point[0] * SIZE:.1f},{PAD + (1 - point[1]) * SIZE:.1f}"


def axes(right):
    lines = [f'<rect x="{PAD}" y="{PAD}" width="{SIZE}" height="{SIZE}" fill="none" stroke="#888"/>']
    for k in range(0, 11, 2):
        x, y = PAD + k / 10 * SIZE, PAD + (1 - k / 10) * SIZE
        lines.append(f'<text x="{x}" y="{PAD + SIZE + 16}" text-anchor="middle">{k / 10 * right:g}</text>')
        lines.append(f'<text x="{PAD - 6}" y="{y + 4}" text-anchor="end">{k / 10:g}</text>')
    return lines


def curve(index, count, name, points, dots):
    colour = COLOURS[index % len(COLOURS)]
    lines = [f'<polyline points="{" ".join(at(p) for p in points)}" stroke="{colour}" stroke-width="2" fill="none"/>']
    if dots:
        lines += [f'<circle cx="{at(p).split(",")[0]}" cy="{at(p).split(",")[1]}" r="4" fill="{colour}"/>' for p in points]
    if count > 1:
        y = PAD + SIZE - 14 * (count - index) + 4
        lines.append(f'<text x="{PAD + SIZE - 8}" y="{y}" text-anchor="end" fill="{colour}">{name}</text>')
    return lines


def svg(path, title, xlabel, ylabel, curves, diagonal, right=1.0):
    """Curves (name, points in the unit square, with dots?); the x axis is labelled from 0 to `right`."""
    side = SIZE + 2 * PAD
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{side}" height="{side}" font-family="sans-serif" font-size="12">',
             '<rect width="100%" height="100%" fill="white"/>', *axes(right)]
    if diagonal:
        lines.append(f'<polyline points="{at((0, 0))} {at((1, 1))}" stroke="#bbb" stroke-dasharray="4" fill="none"/>')
    for i, (name, points, dots) in enumerate(curves):
        lines += curve(i, len(curves), name, points, dots)
    lines += [f'<text x="{side / 2}" y="{PAD - 14}" text-anchor="middle" font-size="14">{title}</text>',
              f'<text x="{side / 2}" y="{side - 8}" text-anchor="middle">{xlabel}</text>',
              f'<text transform="translate(14,{side / 2}) rotate(-90)" text-anchor="middle">{ylabel}</text>', '</svg>']
    pathlib.Path(path).write_text("\n".join(lines) + "\n")
