# SPDX-License-Identifier: MIT
"""An SVG of one or several curves over two axes, with a legend."""

import math

import charts

COLOURS = ["#1f5fa8", "#2b8a3e", "#c2410c", "#7c3aed"]
LEFT, TOP, WIDTH, HEIGHT, LEGEND = 110, 50, 560, 340, 190

Curve = list[tuple[float, float]]


def log_axis(values: list[float], start: float, end: float) -> charts.Axis:
    """Whole decades around the values."""
    low = 10.0 ** math.floor(math.log10(min(values)))
    high = 10.0 ** math.ceil(math.log10(max(values) * 1.001))
    decades = range(round(math.log10(low)), round(math.log10(high)) + 1)
    ticks = [(10.0**d, f"{10.0**d:,.0f}" if d >= 0 else f"{10.0**d:.{-d}f}") for d in decades]
    return charts.Axis(low, high, start, end, ticks, True)


def linear_axis(low: float, high: float, step: float, start: float, end: float) -> charts.Axis:
    count = math.floor((high - low) / step + 1e-9)
    ticks = [(low + i * step, f"{low + i * step:g}") for i in range(count + 1)]
    return charts.Axis(low, high, start, end, ticks, False)


def across() -> tuple[float, float]:
    return LEFT, LEFT + WIDTH


def up() -> tuple[float, float]:
    return TOP + HEIGHT, TOP


def draw(title: str, labels: tuple[str, str], x: charts.Axis, y: charts.Axis,
         curves: dict[str, Curve], marks: bool = True) -> str:
    grid = f'stroke="{charts.GRID}"'
    parts = [charts.text_at(LEFT, 26, title, "start", 'font-size="15" font-weight="bold"')]
    for value, label in x.ticks:
        at = x.position(value)
        parts += [charts.line(at, y.start, at, y.end, grid),
                  charts.text_at(at, y.start + 18, label)]
    for value, label in y.ticks:
        at = y.position(value)
        parts += [charts.line(x.start, at, x.end, at, grid),
                  charts.text_at(x.start - 8, at + 4, label, "end")]
    parts.append(f'<rect x="{LEFT}" y="{TOP}" width="{WIDTH}" height="{HEIGHT}" fill="none" '
                 f'stroke="{charts.INK}"/>')
    parts.append(charts.text_at(LEFT + WIDTH / 2, TOP + HEIGHT + 42, labels[0]))
    middle = TOP + HEIGHT / 2
    parts.append(charts.text_at(18, middle, labels[1], "middle",
                                f'transform="rotate(-90 18 {middle})"'))
    for i, (name, curve) in enumerate(curves.items()):
        colour = COLOURS[i % len(COLOURS)]
        points = [(x.position(a), y.position(b)) for a, b in curve]
        path = " ".join(f"{a:.1f},{b:.1f}" for a, b in points)
        parts.append(f'<polyline class="curve" points="{path}" fill="none" stroke="{colour}" '
                     f'stroke-width="2"/>')
        if marks:
            parts += [f'<circle cx="{a:.1f}" cy="{b:.1f}" r="4" fill="{colour}"/>'
                      for a, b in points]
        row, left = TOP + 14 + 22 * i, LEFT + WIDTH + 16
        parts += [charts.line(left, row, left + 24, row, f'stroke="{colour}" stroke-width="3"'),
                  charts.text_at(left + 32, row + 4, name, "start")]
    width, height = LEFT + WIDTH + LEGEND, TOP + HEIGHT + 60
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
            f'viewBox="0 0 {width} {height}" font-family="Helvetica, Arial, sans-serif" '
            f'font-size="13" fill="{charts.INK}">\n<rect width="100%" height="100%" '
            'fill="white"/>\n' + "\n".join(parts) + "\n</svg>\n")
