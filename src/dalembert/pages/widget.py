"""The live page inside a notebook: dragging it changes a mechanism in Python."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from dalembert.model import Mechanism
from dalembert.pages.page_data import page_data
from dalembert.pages.sweep import with_cycle
from dalembert.saving import check_installed

BUNDLE = Path(__file__).with_name("bundle")


def widget(m: Mechanism, static: bool = False) -> Any:
    """The live page of a mechanism in Jupyter; needs the extra ``notebook``, and works offline.

    ``w.mechanism`` is the mechanism as it has been dragged, ``w.result`` its answer, ``w.changes`` the numbers that
    were changed, by path, SI; ``w.observe(f, "changes")`` calls f after each change. Set ``w.mechanism`` to show
    another one. static: leave inertia out. Raises ModelError for what only the analyses can do.

    >>> import dalembert as da
    >>> w = da.widget(da.four_bar())
    >>> w.changes = {"links.rocker.points.B.0": 0.2}
    >>> w.mechanism.links["rocker"].points["B"][0]
    0.2
    """
    check_installed("anywidget", "a widget", "notebook")
    return _kind()(m, static)


@cache
def _kind() -> type:
    """The class, made when it is first needed: what it is built on is an extra."""
    import anywidget
    import traitlets

    class Live(anywidget.AnyWidget):  # type: ignore[misc, unused-ignore]
        _esm = (BUNDLE / "widget.js").read_text(encoding="utf-8")
        data = traitlets.Dict().tag(sync=True)
        changes = traitlets.Dict().tag(sync=True)

        def __init__(self, m: Mechanism, static: bool) -> None:
            self._first, self._static = m, static
            super().__init__(data=page_data(m, static))

        @property
        def mechanism(self) -> Mechanism:
            """The mechanism with the numbers that were changed, its drive along the cycle that is shown."""
            shown = with_cycle(self._first)
            return shown.with_values(dict(self.changes)) if self.changes else shown

        @mechanism.setter
        def mechanism(self, m: Mechanism) -> None:
            self._first = m
            with self.hold_sync():
                self.changes, self.data = {}, page_data(m, self._static)

        @property
        def result(self) -> Any:
            """The answer of that mechanism."""
            from dalembert.analysis import dynamics, statics

            m = self.mechanism
            return dynamics(m) if m.has_speeds and not self._static else statics(m)

    return Live
