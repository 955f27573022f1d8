# SPDX-License-Identifier: MIT
"""How Sphinx makes the site; build.py calls it with the pages that it has gathered."""

import sys
from pathlib import Path

from sphinx.ext.autodoc.mock import mock

sys.path.insert(0, str(Path(__file__).parent))
import python_pages  # noqa: E402

project = "tetmend"
author = "The tetmend authors"
copyright = author  # noqa: A001

extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc"]
myst_heading_anchors = 4
myst_enable_extensions = ["deflist"]
# Texts as they are written: -- is an option, not a dash.
smartquotes = False
highlight_language = "none"
primary_domain = "cpp"
breathe_default_project = "tetmend"
breathe_default_members = ("members",)
breathe_domain_by_extension = {"h": "cpp"}
breathe_domain_by_file_pattern = {"*/tetmend.h": "c"}
cpp_id_attributes = c_id_attributes = ["TETMEND_API"]

# Python: the package as it lies in the sources.
autodoc_mock_imports = ["pyvista", *(["numpy"] if python_pages.is_missing("numpy") else [])]
autodoc_member_order = "bysource"
autodoc_class_signature = "separated"
autodoc_typehints_format = "short"
default_role = "literal"
with mock(autodoc_mock_imports):
    python_pages.load_package()

html_theme = "furo"
html_title = "tetmend"
html_static_path = ["style.css", "search.js"]
html_favicon = "icon.svg"
html_css_files = ["style.css"]
html_js_files = ["search.js"]
html_search_scorer = str(Path(__file__).parent / "scorer.js")
html_copy_source = False
html_show_sourcelink = False
html_show_sphinx = False
html_show_copyright = False
html_use_index = False
# The dark colours are those of the theme; in Debian's its own rule for a dark system is missing.
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#0b5cad", "color-brand-content": "#0b5cad"},
    "dark_css_variables": {
        "color-brand-primary": "#6cb2ff", "color-brand-content": "#6cb2ff",
        "color-problematic": "#ff9a8f", "color-api-keyword": "#9ca0a5",
        "color-foreground-primary": "#e3e5e8", "color-foreground-secondary": "#a4a9af",
        "color-foreground-muted": "#8d939a", "color-foreground-border": "#666666",
        "color-background-primary": "#131416", "color-background-secondary": "#1a1c1e",
        "color-background-hover": "#1e2124ff", "color-background-hover--transparent": "#1e212400",
        "color-background-border": "#303335", "color-background-item": "#444444",
        "color-highlight-on-target": "#333300", "color-highlighted-background": "#083563",
    },
}


def setup(app: object) -> None:
    def rewrite(_app: object, _what: str, _name: str, _object: object, _options: object, lines: list[str]) -> None:
        lines[:] = python_pages.as_rst(lines)

    app.connect("autodoc-process-docstring", rewrite)
