# SPDX-License-Identifier: MIT
"""What a notebook shows of a result, of a mesh, of its figures and of a check. All text is escaped."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from tetmend import _core

if TYPE_CHECKING:
    from tetmend._check import Check
    from tetmend._improve import Result
    from tetmend._mesh import Mesh
    from tetmend._quality import Quality

_ROWS = [("tets", "tets"), ("points", "vertices"), ("theta_min, degrees", "theta_min"), ("theta_max, degrees", "theta_max"),
         ("lambda %", "lambda"), ("bad tets", "n_bad"), ("inverted tets", "inverted"), ("flat tets", "flat"),
         ("worst minimum sine", "q_worst")]


def _shown(value: Any) -> str:
    """A number that is not zero never shows as zero.

    >>> _shown(35553), _shown(0.00012345), _shown(0.0)
    ('35,553', '0.0001234', '0')
    """
    return f"{value:,}" if isinstance(value, int) else f"{value:.4g}"


def table_of(result: Result) -> str:
    """Before and after, what the run worked towards, its notes, and charts. All text is escaped."""
    low, high = result.goal
    rows = "".join(f"<tr><th style='text-align:left'>{escape(title)}</th><td>{_shown(result.before[name])}</td>"
                   f"<td>{_shown(result.after[name])}</td></tr>" for title, name in _ROWS)
    ended = {"finished": "", "time_limit": "; stopped by the time limit", "cancelled": "; cancelled"}[result.ending]
    worse = "".join(f"<li>worse than before: {escape(text)}</li>" for text in result.worse_than_before)
    notes = "".join(f"<li>{escape(note)}</li>" for note in result.notes)
    listed = f"<ul>{worse}{notes}</ul>" if worse or notes else ""
    return (f"<table><caption>tetmend: goal {low:g} to {high:g} degrees, {result.seconds['improving']:.2f} s{ended}</caption>"
            f"<thead><tr><th style='text-align:left'>measure</th><th>before</th><th>after</th></tr></thead>"
            f"<tbody>{rows}</tbody></table>{listed}{_core.charts(json.dumps(result.report))}")


_MOST_ROWS = 10  # of the worst tets


def _table(caption: str, head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """The first cell of a row is its heading. Cells are HTML."""
    titles = "".join(f"<th style='text-align:left'>{escape(title)}</th>" for title in head)
    body = "".join("<tr>" + f"<th style='text-align:left'>{first}</th>" + "".join(f"<td>{cell}</td>" for cell in others) + "</tr>"
                   for first, *others in rows)
    return f"<table><caption>{escape(caption)}</caption><thead><tr>{titles}</tr></thead><tbody>{body}</tbody></table>"


def _list(lines: Iterable[str]) -> str:
    items = "".join(f"<li>{escape(line)}</li>" for line in lines)
    return f"<ul>{items}</ul>" if items else ""


def mesh_as_html(mesh: Mesh) -> str:
    """How many there are of each, the names of groups and data, and what of its file is not here."""
    counts = {"points": len(mesh.points), "tets": len(mesh.tets), "regions": len(np.unique(mesh.labels)), "triangles": len(mesh.triangles),
              "edges": len(mesh.edges), "required points": len(mesh.required)}
    rows = [(name, f"{count:,}") for name, count in counts.items() if count or name in ("points", "tets")]
    names = {"groups": [group.name or str(group.number) for group in mesh.groups]}
    names |= {name.replace("_", " "): list(getattr(mesh, name)) for name in ("point_data", "cell_data", "triangle_data", "edge_data")}
    rows += [(name, escape(", ".join(found))) for name, found in names.items() if found]
    order = " of second order" if mesh.tets.ndim == 2 and mesh.tets.shape[1] == 10 else ""
    return _table(f"tetmend: a mesh{order}", ("", ""), rows) + _list(mesh.notes)


def quality_as_html(quality: Quality) -> str:
    """The figures, and the worst of the bad tets with their reasons."""
    figures = quality.statistics
    rows = [(escape(title), _shown(figures[name])) for title, name in _ROWS if name in figures]
    rows += [(escape(name), f"{_shown(values['worst'])}, mean {_shown(values['mean'])}") for name, values in quality.measures.items()]
    shown = _table("tetmend: figures of a mesh", ("measure", ""), rows)
    if quality.bad_tets:
        worst = [(f"{bad.tet:,}", f"{bad.label}", f"{bad.theta_min:.4g} to {bad.theta_max:.4g}", ", ".join(f"{x:.6g}" for x in bad.centre),
                  escape(bad.reason)) for bad in quality.bad_tets[:_MOST_ROWS]]
        shown += _table(f"the worst {len(worst)} of {len(quality.bad_tets):,} bad tets", ("tet", "label", "angles", "centre", "why"), worst)
    return shown + _list(quality.notes)


def check_as_html(check: Check) -> str:
    """A row for each fact. What does not hold says so in words, not by its colour alone."""
    marks = {True: "<span style='color:#2a7d2a'>ok</span>", False: "<strong style='color:#c0262d'>FAIL</strong>"}
    failed = sum(not fact.holds for fact in check.facts)
    caption = f"tetmend: {len(check.facts)} facts, {failed} of them do not hold" if failed else f"tetmend: all of {len(check.facts)} facts hold"
    return _table(caption, ("", "fact"), [(marks[fact.holds], escape(fact.text)) for fact in check.facts])
