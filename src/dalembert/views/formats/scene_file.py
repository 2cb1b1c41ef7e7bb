"""A scene written to a file; the extension names the format."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from dalembert.errors import ModelError
from dalembert.saving import check_installed, new_file

if TYPE_CHECKING:
    from dalembert.views.paper.scene import Scene


def save(
    scene: Scene, path: str | Path, overwrite: bool = False, theme: str = "light", paper: str | None = None
) -> None:
    """Writes .svg, .pdf, .png or .dxf; with ``paper`` a PDF in pages."""
    from dalembert.views.formats.themes import THEMES
    from dalembert.views.paper.pages import PAPERS

    target = Path(path)
    if theme not in THEMES:
        raise ModelError(f"unknown theme {theme!r}", f"choose {' or '.join(THEMES)}")
    kind = target.suffix.lower()
    if kind not in (".svg", ".pdf", ".png", ".dxf"):
        what = f"{target.name}: drawings are not written as {kind or 'that'}"
        raise ModelError(what, "use .svg, .pdf, .png or .dxf")
    if paper is not None and (paper not in PAPERS or kind != ".pdf"):
        raise ModelError(f"{target.name} has no pages of {paper}", f"a .pdf has: {' or '.join(PAPERS)}")
    with new_file(target, overwrite) as temporary:
        if kind == ".svg":
            temporary.write_text(scene.to_svg(theme), encoding="utf-8")
        elif kind == ".dxf":
            check_installed("ezdxf", "writing DXF", "cad")
            from dalembert.views.formats.dxf import write_dxf

            write_dxf(scene, temporary)
        else:
            check_installed("matplotlib", f"writing {kind[1:].upper()}", "plot")
            from dalembert.views.formats.matplotlib_figure import write_figure

            write_figure(scene, temporary, theme, paper=paper)
