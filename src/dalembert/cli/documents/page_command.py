"""`dalembert page`: a mechanism as a live HTML page."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from dalembert.cli.options import AS_STATED, Force, ModelFile, Steady
from dalembert.cli.options import output as written
from dalembert.errors import ModelError
from dalembert.saving import check_new, new_file

EXAMPLES = """Examples:
  dalembert page engine.yaml -o engine.html
  dalembert page four_bar.yaml -o four_bar.html --set links.rocker.mass=2kg"""


def page(
    file: ModelFile,
    /,
    *,
    output: Annotated[Path, written("File to write, .html.")],
    of: Steady = AS_STATED,
    force: Force = False,
) -> int:
    """Make a live page of FILE: one HTML file in which to drag joints and change numbers, and see all forces change.

    A mechanism that is not finished is a sketch: drag its links, and add what is missing.
    """
    from dalembert.pages.html_page import html_text
    from dalembert.pages.unfinished.sketch_page import page_or_sketch

    if output.suffix.lower() not in (".html", ".htm"):
        raise ModelError(f"{output.name}: a page is HTML", "name a file that ends in .html")
    check_new(output, force)
    data = page_or_sketch(of.load(file), of.static)
    with new_file(output, force) as written_to:
        written_to.write_text(html_text(data), encoding="utf-8")
    if "missing" in data:
        print(f"{output}: a sketch, for {data['missing']['sentence']}")
    print(f"{output}: open it in a browser")
    return 0


COMMANDS = {page: EXAMPLES}
"""Function of the command -> the examples under its help."""
