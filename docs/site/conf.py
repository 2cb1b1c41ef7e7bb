"""Settings of the site. Nothing is loaded from another server, and formulas are MathML: no script, no font."""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "src"))

import dalembert  # noqa: E402

project = "dalembert"
author = "The dalembert authors"
copyright = author  # noqa: A001
version = release = dalembert.__version__
extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx_design", "sphinx_copybutton"]
root_doc = "index"
exclude_patterns = ["examples/**"]
language = "en"

myst_heading_anchors = 4
myst_enable_extensions = ["colon_fence", "dollarmath", "attrs_inline", "deflist"]
nb_execution_mode = os.environ.get("SITE_NOTEBOOKS", "force")
nb_execution_timeout = 300
nb_execution_raise_on_error = True
nb_ipywidgets_js: dict[str, Any] = {}  # else every notebook page loads two scripts from other servers
nb_mime_priority_overrides = [("html", "application/vnd.jupyter.widget-view+json", None)]
copybutton_prompt_text = r">>> |\.\.\. |\$ "
copybutton_prompt_is_regexp = True

autodoc_typehints = "signature"
autodoc_typehints_format = "short"
autodoc_member_order = "bysource"
nitpick_ignore_regex = [(r"py:.*", r".*")]  # types of other packages have no page here
default_role = "code"
highlight_language = "none"
smartquotes_action = "qe"  # two hyphens are an option of a command, not a dash

html_theme = "pydata_sphinx_theme"
html_title = "dalembert"
html_static_path = [str(ROOT / "build" / "site-source" / "_static")]
html_css_files = ["site.css"]
html_js_files = ["filter.js"]
html_show_sourcelink = html_copy_source = False
html_sidebars = {name: [] for name in ("index", "gallery/**", "validation", "search", "genindex")}
html_math_renderer = "mathml"
html_theme_options = {
    "icon_links": [],
    "header_links_before_dropdown": 6,
    "navbar_align": "left",
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": [],
    "show_prev_next": False,
}


def plain_docstring(app: Any, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Docstrings are plain text: markup of reStructuredText is escaped, indented lines are shown as they are."""
    out: list[str] = []
    example = False
    for line in lines:
        example = line.lstrip().startswith(">>>") or (example and bool(line.strip()))
        if example:
            out.append(line)
        elif line.startswith((" ", "\t")):
            if not out or not out[-1].startswith("    "):
                out += [""] if [line for line in out if line][-1:] == ["::"] else ["", "::", ""]
            out.append("    " + line)
        else:
            if out and out[-1].startswith("    ") and line.strip():
                out.append("")
            parts = re.split(r"(``[^`]*``|`[^`]*`)", line)
            out.append("".join(p if k % 2 else re.sub(r"([*|_\\])", r"\\\1", p) for k, p in enumerate(parts)))
    lines[:] = out


def setup(app: Any) -> None:
    from latex2mathml.converter import convert

    def visit(self: Any, node: Any) -> None:
        from docutils.nodes import SkipNode

        block = node.tagname == "math_block"
        self.body.append(convert(node.astext(), display="block" if block else "inline"))
        raise SkipNode

    app.add_html_math_renderer("mathml", (visit, None), (visit, None))
    app.connect("autodoc-process-docstring", plain_docstring)
