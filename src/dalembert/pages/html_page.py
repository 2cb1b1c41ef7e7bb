"""One self-contained HTML file: the front end and the data of one mechanism; it loads nothing else."""

from __future__ import annotations

from html import escape
from pathlib import Path

from dalembert.arrays import Tree
from dalembert.model import ModelOrPath, as_mechanism
from dalembert.pages.unfinished.sketch_page import packed, page_or_sketch
from dalembert.saving import new_file

BUNDLE = Path(__file__).with_name("bundle")

POLICY = (
    "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval'; style-src 'unsafe-inline'; "
    "img-src data: blob:; base-uri 'none'; form-action 'none'"
)
"""Policy that forbids loading from anywhere, whatever the data contains."""


def page(
    m: ModelOrPath, path: str | Path | None = None, static: bool = False, overwrite: bool = False
) -> str:
    """The HTML of a live page of a mechanism; written to ``path`` where that is given.

    Every drawn number is computed by the kernel's WebAssembly in the page: joints, loads and every number of the file
    can be changed, and all forces follow. A plane mechanism that is not finished is a sketch: its links can be
    pulled, what is missing is listed beside it, and each offer adds one thing. static: leave inertia out. overwrite:
    replace an existing file. Raises ModelError for features of the analyses alone (redundant mechanisms, unknown
    positions).

    >>> import dalembert as da
    >>> html = da.page(da.four_bar())
    >>> html[:15], len(html) < 160_000
    ('<!doctype html>', True)
    """
    m = as_mechanism(m)
    text = html_text(page_or_sketch(m, static))
    if path is not None:
        with new_file(path, overwrite) as file:
            file.write_text(text, encoding="utf-8")
    return text


def html_text(data: Tree) -> str:
    """A page with its data, compressed; no text of a model file can end the script or act as markup."""
    script = (BUNDLE / "page.js").read_text(encoding="utf-8").replace("</script", "<\\/script")
    text = packed(data)
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width,initial-scale=1">'
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}"><title>{escape(data["title"])}</title>'
        "<style>body{margin:0}@media(prefers-color-scheme:dark){html{background:#151b22;color-scheme:dark}}</style>"
        f'</head><body><div id="mechanism"></div><script type="text/plain" id="data">{text}</script>'
        f"<script>{script}</script>"
        '<script>dalembert.open(document.getElementById("mechanism"),document.getElementById("data").textContent)'
        ".then(p=>{window.page=p})</script></body></html>\n"
    )
