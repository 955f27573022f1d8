# SPDX-License-Identifier: MIT
"""One SVG for each mesh: what remains of the bad tets, and the smallest angle, against time."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import escape

FONT = 12
CHARACTER = 0.6 * FONT  # mean width, on the wide side
PANEL_WIDTH, PANEL_HEIGHT = 430, 330
LEFT, TOP, GAP = 70, 60, 90
WIDTH, HEIGHT = LEFT + 2 * PANEL_WIDTH + GAP + 30, TOP + PANEL_HEIGHT + 60
PLACE_OF_ZERO = 0.5  # on the logarithmic axis of counts
INK, GRID, OURS, THEIRS = "#222222", "#e3e3e3", "#c2410c", "#1f5fa8"


@dataclass(frozen=True)
class Mark:
    """An improver in a chart."""

    label: str
    time: float
    value: float
    ours: bool
    whole: bool  # the time is that of the whole run: the program does not tell its own


@dataclass(frozen=True)
class Box:
    left: float
    top: float
    right: float
    bottom: float

    def overlaps(self, other: "Box") -> bool:
        return (
            self.left < other.right
            and other.left < self.right
            and self.top < other.bottom
            and other.top < self.bottom
        )

    def inside(self, other: "Box") -> bool:
        return (
            self.left >= other.left
            and self.right <= other.right
            and self.top >= other.top
            and self.bottom <= other.bottom
        )


# --- scales


def log_ticks(low: float, high: float) -> list[float]:
    """1, 2 and 5 of each decade; only the 1 when there are many decades."""
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    steps = (1, 2, 5) if math.log10(high / low) < 2.2 else (1,)
    ticks = [step * 10.0**decade for decade in decades for step in steps]
    return [tick for tick in ticks if low <= tick <= high]


def log_range(values: list[float]) -> tuple[float, float]:
    return min(values) / 1.6, max(values) * 1.6


@dataclass(frozen=True)
class Axis:
    low: float
    high: float
    start: float  # pixel of low
    end: float  # pixel of high
    ticks: list[tuple[float, str]]
    logarithmic: bool

    def position(self, value: float) -> float:
        scale: Callable[[float], float] = math.log10 if self.logarithmic else float
        part = (scale(value) - scale(self.low)) / (scale(self.high) - scale(self.low))
        return self.start + part * (self.end - self.start)


def log_axis(values: list[float], start: float, end: float, unit: str = "") -> Axis:
    low, high = log_range(values)
    ticks = [(tick, f"{tick:,g}{unit}") for tick in log_ticks(low, high)]
    return Axis(low, high, start, end, ticks, True)


def count_axis(values: list[float], start: float, end: float) -> Axis:
    axis = log_axis(values, start, end)
    ticks = [tick for tick in axis.ticks if tick[0] >= 1]
    if min(values) == PLACE_OF_ZERO:
        ticks.insert(0, (PLACE_OF_ZERO, "0"))
    return Axis(axis.low, axis.high, start, end, ticks, True)


def angle_axis(values: list[float], start: float, end: float) -> Axis:
    step = 5 if max(values) > 12 else 2
    high = step * math.ceil((max(values) + 0.4 * step) / step)
    ticks = [(float(tick), f"{tick}°") for tick in range(0, high + 1, step)]
    return Axis(-0.3 * step, high, start, end, ticks, False)


# --- drawing


def text_at(x: float, y: float, text: str, anchor: str = "middle", extra: str = "") -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" {extra}>{escape(text)}</text>'


def line(x1: float, y1: float, x2: float, y2: float, style: str) -> str:
    return f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" {style}/>'


def label_box(x: float, y: float, dx: float, dy: float, width: float) -> Box:
    """Of a label whose near side or corner is (dx, dy) away from a mark."""
    left = x + dx if dx > 0 else x + dx - width if dx < 0 else x - width / 2
    middle = y + dy
    return Box(left, middle - 0.6 * FONT, left + width, middle + 0.6 * FONT)


def candidates() -> list[tuple[float, float]]:
    """Places of a label around its mark, the best first."""
    near = [(10, 0), (-10, 0), (0, -14), (0, 14), (8, -11), (8, 11), (-8, -11), (-8, 11)]
    far = [
        (sign * radius * math.cos(turn), radius * math.sin(turn))
        for radius in (24, 36, 50, 66, 84)
        for turn in (0.5, -0.5, 1.0, -1.0, 1.5, -1.5, 0.0)
        for sign in (1, -1)
    ]
    return near + far


def place_labels(
    points: list[tuple[float, float]], labels: list[str], frame: Box, obstacles: list[Box]
) -> list[Box]:
    """A box for each label that covers no mark, no obstacle, no other label, and stays in the
    frame."""
    taken = obstacles + [Box(x - 6, y - 6, x + 6, y + 6) for x, y in points]
    placed = []
    for (x, y), label in zip(points, labels, strict=True):
        width = CHARACTER * len(label)
        boxes = [label_box(x, y, dx, dy, width) for dx, dy in candidates()]
        free = [
            box
            for box in boxes
            if box.inside(frame) and not any(box.overlaps(other) for other in taken)
        ]
        placed.append(free[0] if free else boxes[0])
        taken.append(placed[-1])
    return placed


def leader(x: float, y: float, box: Box) -> str:
    """A thin line from a mark to its label when the label is not beside it."""
    near_x = min(max(x, box.left), box.right)
    near_y = min(max(y, box.top), box.bottom)
    if math.hypot(near_x - x, near_y - y) < 14:
        return ""
    return line(x, y, near_x, near_y, 'stroke="#999999" stroke-width="0.8"')


def draw_mark(mark: Mark, x: float, y: float) -> str:
    colour = OURS if mark.ours else THEIRS
    fill = "white" if mark.whole else colour
    style = f'fill="{fill}" stroke="{colour}" stroke-width="1.6"'
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4.5" {style}/>'


def draw_grid(across: Axis, up: Axis, title: str) -> list[str]:
    style = f'stroke="{GRID}"'
    parts = []
    for value, label in across.ticks:
        x = across.position(value)
        parts.append(line(x, up.start, x, up.end, style))
        parts.append(text_at(x, up.start + 18, label))
    for value, label in up.ticks:
        y = up.position(value)
        parts.append(line(across.start, y, across.end, y, style))
        parts.append(text_at(across.start - 8, y + 4, label, "end"))
    width, height = across.end - across.start, up.start - up.end
    parts.append(
        f'<rect x="{across.start}" y="{up.end}" width="{width}" height="{height}" '
        f'fill="none" stroke="{INK}"/>'
    )
    middle = (across.start + across.end) / 2
    parts.append(text_at(middle, up.start + 40, "seconds of improving"))
    parts.append(text_at(across.start, up.end - 10, title, "start", 'font-weight="bold"'))
    return parts


def place_input_label(
    across: Axis, y: float, label: str, points: list[tuple[float, float]], frame: Box
) -> Box:
    """At an end of the line of the input, over or under it, where no mark is."""
    width = CHARACTER * len(label)
    boxes = [
        Box(left, top, left + width, top + 1.2 * FONT)
        for left in (across.end - 5 - width, across.start + 5, (across.start + across.end) / 2)
        for top in (y - 4 - 1.2 * FONT, y + 4)
    ]
    marks = [Box(px - 6, py - 6, px + 6, py + 6) for px, py in points]
    free = [
        box
        for box in boxes
        if box.inside(frame) and not any(box.overlaps(mark) for mark in marks)
    ]
    return free[0] if free else boxes[0]


def draw_input(across: Axis, y: float, label: str, box: Box) -> list[str]:
    dashed = f'stroke="{INK}" stroke-dasharray="5 4" stroke-width="1"'
    middle = (box.left + box.right) / 2
    text = text_at(middle, box.bottom - 3, label, "middle", 'font-style="italic"')
    return [line(across.start, y, across.end, y, dashed), text]


def draw_label(mark: Mark, x: float, box: Box) -> str:
    """White around the letters, so that lines of the grid do not cross them."""
    style = 'stroke="white" stroke-width="3" paint-order="stroke" '
    style += f'fill="{OURS}" font-weight="bold"' if mark.ours else f'fill="{INK}"'
    if box.left > x:
        return text_at(box.left, box.bottom - 3, mark.label, "start", style)
    if box.right < x:
        return text_at(box.right, box.bottom - 3, mark.label, "end", style)
    return text_at((box.left + box.right) / 2, box.bottom - 3, mark.label, "middle", style)


def draw_panel(marks: list[Mark], across: Axis, up: Axis, title: str, source: float) -> list[str]:
    label = f"input: {source:,.0f}" if up.logarithmic else f"input: {source:.2f}°"
    source_y = up.position(source)
    points = [(across.position(mark.time), up.position(mark.value)) for mark in marks]
    frame = Box(across.start + 2, up.end + 2, across.end - 2, up.start - 2)
    source_box = place_input_label(across, source_y, label, points, frame)
    obstacles = [Box(across.start, source_y - 2, across.end, source_y + 2), source_box]
    boxes = place_labels(points, [mark.label for mark in marks], frame, obstacles)

    parts = draw_grid(across, up, title) + draw_input(across, source_y, label, source_box)
    for (x, y), box in zip(points, boxes, strict=True):
        parts.append(leader(x, y, box))
    for mark, (x, y), box in zip(marks, points, boxes, strict=True):
        parts.append(draw_mark(mark, x, y))
        parts.append(draw_label(mark, x, box))
    return parts


# --- charts


def marks_of(mesh: dict, value: Callable[[dict], float]) -> list[Mark]:
    marks = []
    for row in mesh["rows"]:
        if "after" not in row:
            continue
        whole = "improving" not in row["phases"]
        times = row["whole_seconds"] if whole else row["phases"]["improving"]
        time = max(times["min"], 1e-4)
        marks.append(Mark(row["short"], time, value(row["after"]), row["ours"], whole))
    return marks


def count_place(measured: dict) -> float:
    return max(measured["n_bad"], PLACE_OF_ZERO)


def chart(mesh: dict) -> str | None:
    """Nothing when no improver gave a result."""
    bad = marks_of(mesh, count_place)
    angles = marks_of(mesh, lambda after: after["theta_min"])
    if not bad:
        return None
    bottom = TOP + PANEL_HEIGHT
    second = LEFT + PANEL_WIDTH + GAP
    times = [mark.time for mark in bad]
    before = mesh["before"]
    counts = [mark.value for mark in bad] + [count_place(before)]
    degrees = [mark.value for mark in angles] + [before["theta_min"]]

    parts = [text_at(LEFT, 24, heading(mesh), "start", 'font-size="15" font-weight="bold"')]
    parts += draw_panel(
        bad,
        log_axis(times, LEFT, LEFT + PANEL_WIDTH),
        count_axis(counts, bottom, TOP),
        "bad tets that remain (lower is better)",
        count_place(before),
    )
    parts += draw_panel(
        angles,
        log_axis(times, second, second + PANEL_WIDTH),
        angle_axis(degrees, bottom, TOP),
        "smallest dihedral angle, degrees (higher is better)",
        before["theta_min"],
    )
    if any(mark.whole for mark in bad):
        parts.append(text_at(WIDTH - 30, 24, "open circle: time of the whole run", "end"))
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
        f'viewBox="0 0 {WIDTH} {HEIGHT}" font-family="Helvetica, Arial, sans-serif" '
        f'font-size="{FONT}" fill="{INK}">\n<rect width="100%" height="100%" fill="white"/>\n'
    )
    return head + "\n".join(part for part in parts if part) + "\n</svg>\n"


def heading(mesh: dict) -> str:
    return f"{mesh['mesh']}, {mesh['before']['tets']:,} tets: quality against time"


def file_name(mesh: dict) -> str:
    return f"quality-{mesh['mesh']}.svg"


def all_charts(results: dict) -> dict[str, str]:
    """By the names of their files."""
    drawings = {file_name(mesh): chart(mesh) for mesh in results["meshes"]}
    return {name: drawing for name, drawing in drawings.items() if drawing}
