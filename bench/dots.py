# SPDX-License-Identifier: MIT
"""One SVG for each mesh: all measures of all improvers, a row for each measure, the best of it to
the right."""

import math
import re
from collections import Counter
from dataclasses import dataclass

from charts import GRID, INK, OURS, line, text_at
from measures import MEASURES, Measure

FONT = 13
WIDTH = 760
LEFT, RIGHT = 276, 652  # of the rows: the worst value and the best
TOP, ROW, LEGEND_ROW = 48, 38, 22
LEGEND_COLUMNS = 4
APART = 12.0  # of two dots that do not cover each other
GREY = "#666666"
SHADES = [OURS, "#7f1d1d", "#f59e0b", "#db2777"]  # of ours, in their order
FAMILIES = {  # of rivals, by the first word of their names: shape and colour
    "Gmsh": ("square", "#1f5fa8"),
    "TetGen": ("triangle", "#0f766e"),
    "Netgen": ("diamond", "#6d28d9"),
    "MMG": ("wedge", "#4d7c0f"),
    "HXT": ("hexagon", "#0e7fb8"),
    "Stellar": ("pentagon", "#475569"),
}
OTHER = ("hexagon", "#475569")
CORNERS = {  # number, and the turn of the first in degrees
    "square": (4, 45), "triangle": (3, -90), "diamond": (4, 0), "wedge": (3, 90),
    "hexagon": (6, 0), "pentagon": (5, -90)}


@dataclass(frozen=True)
class Symbol:
    label: str
    shape: str
    stroke: str
    fill: str
    ours: bool


@dataclass(frozen=True)
class Series:
    """An improver and what became of the mesh."""

    symbol: Symbol
    after: dict


# --- what is shown


def family(row: dict) -> str:
    return row["short"].split()[0]


def series_of(mesh: dict) -> list[Series]:
    """All that gave a result; ours on one thread only, for more change no figure."""
    found: list[Series] = []
    rows = [row for row in mesh["rows"] if "after" in row]
    members = Counter(family(row) for row in rows)
    labels: set[str] = set()
    for row in rows:
        label = re.sub(r" \(\d+\)$", "", row["short"]) if row["ours"] else row["short"]
        if label in labels:
            continue
        labels.add(label)
        if row["ours"]:
            shade = SHADES[(len(labels) - 1) % len(SHADES)]
            symbol = Symbol(label, "circle", "white", shade, True)
        else:
            shape, colour = FAMILIES.get(family(row), OTHER)
            several = members.pop(family(row), 1) > 1  # only the first of a family is open
            symbol = Symbol(label, shape, colour, "white" if several else colour, False)
        found.append(Series(symbol, row["after"]))
    return found


def places(measure: Measure, values: list[float]) -> list[float]:
    """From 0, the worst, to 1, the best. A zero on a logarithmic scale lies where half the least of
    the others would."""
    if measure.logarithmic:
        least = min((value for value in values if value > 0), default=1.0)
        values = [math.log10(max(value, least / 2)) for value in values]
    worst, best = min(values), max(values)
    if not measure.more_is_better:
        worst, best = best, worst
    return [1.0 if worst == best else (value - worst) / (best - worst) for value in values]


def moved_apart(across: list[float]) -> list[tuple[float, float]]:
    """The places of dots in a row, seen from its middle, so that none covers one before it: above
    and below, and beyond the nearer end of the row when there is no room."""
    placed: list[tuple[float, float]] = []
    for x in across:
        away = APART if x > (LEFT + RIGHT) / 2 else -APART
        places = [(x + step * away, lane) for step in range(len(across))
                  for lane in (0.0, -APART, APART)]
        placed.append(next(place for place in places if all(
            math.dist(place, other) >= APART - 0.01 for other in placed)))
    return placed


# --- drawing


def draw_symbol(symbol: Symbol, x: float, y: float) -> str:
    if symbol.shape == "circle":
        return (f'<circle cx="{x:.1f}" cy="{y:.1f}" r="7" fill="{symbol.fill}" '
                f'stroke="{symbol.stroke}" stroke-width="1.2"/>')
    count, first = CORNERS[symbol.shape]
    radius = 6.2 if count == 3 else 5.6
    corners = []
    for i in range(count):
        turn = math.radians(first + 360 * i / count)
        corners.append(f"{x + radius * math.cos(turn):.1f},{y + radius * math.sin(turn):.1f}")
    return (f'<polygon points="{" ".join(corners)}" fill="{symbol.fill}" '
            f'stroke="{symbol.stroke}" stroke-width="1.6"/>')


def draw_input(x: float, y: float, half: float = 12) -> str:
    """White around it, for it may lie over dots."""
    return (line(x, y - half - 1, x, y + half + 1, 'stroke="white" stroke-width="5"')
            + line(x, y - half, x, y + half, f'stroke="{INK}" stroke-width="3"'))


def draw_row(measure: Measure, y: float, before: dict, found: list[Series]) -> list[str]:
    values = [measure.of(before), *(measure.of(series.after) for series in found)]
    source, *across = [LEFT + place * (RIGHT - LEFT) for place in places(measure, values)]
    best, worst = max(values), min(values)
    if not measure.more_is_better:
        best, worst = worst, best
    # Ours take the middle of the row, and lie over the others.
    order = sorted(range(len(found)), key=lambda i: not found[i].symbol.ours)
    dots = dict(zip(order, moved_apart([across[i] for i in order]), strict=True))
    left = min(LEFT, *(x for x, _ in dots.values()))
    right = max(RIGHT, *(x for x, _ in dots.values()))
    grey = f'fill="{GREY}" font-size="12"'
    parts = [
        line(LEFT, y, RIGHT, y, f'stroke="{GRID}" stroke-width="2"'),
        text_at(16, y + 4.5, measure.title, "start"),
        text_at(left - 14, y + 4.5, measure.shown(worst), "end", grey),
        text_at(right + 14, y + 4.5, measure.shown(best), "start", grey),
    ]
    for i in reversed(order):
        x, lane = dots[i]
        parts.append(draw_symbol(found[i].symbol, x, y + lane))
    return [*parts, draw_input(source, y)]


def draw_legend(found: list[Series]) -> list[str]:
    width = (WIDTH - 32) / LEGEND_COLUMNS
    parts = []
    for i in range(len(found) + 1):
        x = 24 + width * (i % LEGEND_COLUMNS)
        y = TOP + LEGEND_ROW * (i // LEGEND_COLUMNS)
        if i == 0:
            parts += [draw_input(x, y, 8), text_at(x + 14, y + 4.5, "input", "start")]
            continue
        symbol = found[i - 1].symbol
        style = f'fill="{symbol.fill}" font-weight="bold"' if symbol.ours else ""
        parts += [draw_symbol(symbol, x, y), text_at(x + 14, y + 4.5, symbol.label, "start", style)]
    return parts


def chart(mesh: dict) -> str | None:
    """Nothing when no improver gave a result."""
    found = series_of(mesh)
    if not found:
        return None
    top = TOP + LEGEND_ROW * (len(found) // LEGEND_COLUMNS + 1) + 6
    height = top + 22 + ROW * len(MEASURES) + 58
    grey = f'fill="{GREY}" font-size="12"'
    parts = [text_at(16, 24, heading(mesh), "start", 'font-size="15" font-weight="bold"')]
    parts += draw_legend(found)
    parts += [text_at(LEFT - 14, top + 6, "worst", "end", grey),
              text_at(RIGHT + 14, top + 6, "best", "start", grey),
              text_at(RIGHT, top + 6, "better →", "end", 'font-style="italic"')]
    for i, measure in enumerate(MEASURES):
        parts += draw_row(measure, top + 22 + ROW * (i + 0.5), mesh["before"], found)
    notes = ["Each row reaches from the worst to the best of its values, the input with them.",
             "Logarithmic: angles outside 30 to 150, bad tets, edge ratio, faces. "
             "Dots in one place lie beside each other."]
    parts += [text_at(16, height - 32 + 18 * i, note, "start", grey)
              for i, note in enumerate(notes)]
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" '
        f'viewBox="0 0 {WIDTH} {height}" font-family="Helvetica, Arial, sans-serif" '
        f'font-size="{FONT}" fill="{INK}">\n<rect width="100%" height="100%" fill="white"/>\n'
    )
    return head + "\n".join(parts) + "\n</svg>\n"


def heading(mesh: dict) -> str:
    return f"{mesh['mesh']}, {mesh['before']['tets']:,} tets: all measures"


def file_name(mesh: dict) -> str:
    return f"measures-{mesh['mesh']}.svg"


def all_charts(results: dict) -> dict[str, str]:
    """By the names of their files."""
    drawings = {file_name(mesh): chart(mesh) for mesh in results["meshes"]}
    return {name: drawing for name, drawing in drawings.items() if drawing}
