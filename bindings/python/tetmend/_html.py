# SPDX-License-Identifier: MIT
"""What a notebook shows of a result."""

from __future__ import annotations

import json
from html import escape
from typing import TYPE_CHECKING, Any

from tetmend import _core

if TYPE_CHECKING:
    from tetmend._improve import Result

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
