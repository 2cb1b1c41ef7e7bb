"""The live page inside a notebook: dragging it changes a mechanism in Python."""

from __future__ import annotations

import sys
from functools import cache
from html import escape
from importlib.util import find_spec
from pathlib import Path
from typing import Any
from uuid import uuid4

from dalembert.errors import DalembertError
from dalembert.model import Mechanism, ModelOrPath, as_mechanism, loads
from dalembert.pages.html_page import page
from dalembert.pages.saved_text import with_changed_numbers
from dalembert.pages.sweep import with_cycle
from dalembert.pages.unfinished.sketch_page import FORMAT as SKETCH
from dalembert.pages.unfinished.sketch_page import page_or_sketch
from dalembert.saving import check_installed

BUNDLE = Path(__file__).with_name("bundle")


def widget(m: ModelOrPath, static: bool = False) -> Any:
    """The live page of a mechanism in Jupyter; needs the extra ``notebook``, and works offline.

    ``w.mechanism`` is the mechanism as it has been dragged, ``w.result`` its answer, ``w.changes`` the numbers that
    were changed, by path, SI; ``w.observe(f, "changes")`` calls f after each change. Set ``w.mechanism`` to show
    another one. A plane mechanism that is not finished is a sketch, whose links can be pulled and whose offers finish
    it; ``w.text`` is its file as it was pulled. static: leave inertia out. Raises ModelError for what only the
    analyses can do.

    >>> import dalembert as da
    >>> w = da.widget(da.four_bar())
    >>> w.changes = {"links.rocker.points.B.0": 0.2}
    >>> w.mechanism.links["rocker"].points["B"][0]
    0.2
    """
    m = as_mechanism(m)
    check_installed("anywidget", "a widget", "notebook")
    return _kind()(m, static)


def _in_notebook() -> bool:
    ipython = sys.modules.get("IPython")
    return ipython is not None and hasattr(ipython.get_ipython(), "kernel")


def show_live(m: Mechanism) -> None:
    """Shows a mechanism's live page in a notebook. Raises NotImplementedError in a terminal, without anywidget, and for
    features of the analyses alone; IPython then shows another representation.
    """
    if not _in_notebook() or find_spec("anywidget") is None:
        raise NotImplementedError
    try:
        shown = widget(m)
    except DalembertError as error:
        raise NotImplementedError from error
    shown._ipython_display_()


def saved_html(m: Mechanism, static: bool, name: str) -> str:
    """A frame with the page of a mechanism, which the widget of that name hides; it is not loaded while hidden."""
    style = "width:100%;height:44em;border:0"
    return (
        f'<iframe data-dalembert="{name}" srcdoc="{escape(page(m, static=static))}" style="{style}" '
        'sandbox="allow-scripts allow-downloads" loading="lazy" title="live page"></iframe>'
    )


@cache
def _kind() -> type:
    """The widget's class, created on first use, since its base class is in an optional package."""
    import anywidget
    import traitlets

    class Live(anywidget.AnyWidget):  # type: ignore[misc, unused-ignore]
        _esm = (BUNDLE / "widget.js").read_text(encoding="utf-8")
        data = traitlets.Dict().tag(sync=True)
        changes = traitlets.Dict().tag(sync=True)
        frame = traitlets.Unicode().tag(sync=True)
        text = traitlets.Unicode().tag(sync=True)

        def __init__(self, m: Mechanism, static: bool) -> None:
            self._first, self._static = m, static
            super().__init__(data=page_or_sketch(m, static), frame=uuid4().hex)

        def _ipython_display_(self) -> None:
            """The widget, and below it the page as a file, hidden while the widget lives: for a saved notebook."""
            from IPython.display import display

            view = {"version_major": 2, "version_minor": 0, "model_id": self.model_id}
            display({"application/vnd.jupyter.widget-view+json": view, "text/plain": repr(self)}, raw=True)
            display({"text/html": saved_html(self._first, self._static, self.frame)}, raw=True)

        @property
        def mechanism(self) -> Mechanism:
            """The mechanism with the numbers that were changed, its drive along the cycle that is shown; a sketch as it
            was pulled, with the offers that were taken."""
            if self.text:
                return loads(self.text)
            if self.data["format"] == SKETCH:
                return self._first
            shown = with_cycle(self._first)
            return with_changed_numbers(shown, dict(self.changes)) if self.changes else shown

        @mechanism.setter
        def mechanism(self, m: Mechanism) -> None:
            self._first = m
            with self.hold_sync():
                self.changes, self.text, self.data = {}, "", page_or_sketch(m, self._static)

        @property
        def result(self) -> Any:
            """The answer of that mechanism."""
            from dalembert.analysis import dynamics, statics

            m = self.mechanism
            return dynamics(m) if m.has_speeds and not self._static else statics(m)

    return Live
