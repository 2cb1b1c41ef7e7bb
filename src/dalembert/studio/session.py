"""Effect of a tab's message on the document, and the reply to every tab."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.studio.document import EMPTY, Document
from dalembert.studio.editing.gestures import gesture
from dalembert.studio.editing.sketch_pose import SketchPose
from dalembert.studio.part_keys import part_keys
from dalembert.studio.problems import problem_text, problems
from dalembert.studio.solver import Question
from dalembert.studio.stored_file import StoredFile


@dataclass
class Session:
    """One document, its file and how it is analysed; all tabs see the same."""

    file: StoredFile
    document: Document = field(init=False)
    saved: str = ""
    static: bool = False
    friction: bool = True
    kept: str | None = None
    """Text of the side file that an earlier run left, with which the document began."""
    outside: str | None = None
    """Text on disk that another program wrote while there is something here that is not saved."""
    _kept_hash: str = ""
    _pulled: tuple[object, SketchPose] | None = None
    """The link and text of the last pull, and the pose after it."""

    def __post_init__(self) -> None:
        text = self.file.read()
        self.saved = EMPTY if text is None else text
        self.document = Document(self.saved, self.file.form, str(self.file.path))
        self.kept = self.file.kept()
        if self.kept is not None:
            self.document.replace(self.kept)  # a step: undone, it is the file on disk

    @property
    def dirty(self) -> bool:
        """True if something is not saved."""
        return self.document.text != self.saved

    @property
    def analysed(self) -> str:
        """Hash of the text with the options of the analysis: an answer with another one is out of date."""
        return f"{self.document.hash}{' static' * self.static}{' frictionless' * (not self.friction)}"

    def state(self) -> Tree:
        """Contents of a tab without the forces."""
        d, reading = self.document, self.document.reading
        undo, redo = d.can
        return {
            "text": d.text,
            "hash": d.hash,
            "analysed": self.analysed,
            "form": d.form,
            "file": self.file.path.name,
            "dirty": self.dirty,
            "undo": undo,
            "redo": redo,
            "drawing": reading.drawing,
            "error": reading.error,
            "line": reading.line,
            "static": self.static,
            "friction": self.friction,
            "kept": self.kept is not None,
            "outside": self.outside is not None,
        }

    def question(self, ask: str) -> Question:
        """A question about the present text."""
        d, reading = self.document, self.document.reading
        read = None if reading.source is None else (reading.tree, reading.source)
        return Question(ask, d.text, d.form, d.name, self.static, self.friction, read, self.analysed)

    def handle(self, message: Any) -> Tree:
        """Do what a message says; returns the reply to its sender. Raises ModelError where it cannot be done."""
        kinds = [kind for kind in _DOES if kind in message] if isinstance(message, dict) else []
        if len(kinds) != 1:
            raise ModelError("the message cannot be read", "reload the page")
        return _DOES[kinds[0]](self, message[kinds[0]], message) or {}

    def look(self) -> bool:
        """Look at the disk and keep what is not saved; True if tabs need an update."""
        data = False
        outside = self.file.outside()
        if outside is not None and not self.dirty:
            self.document.replace(outside)
            self.saved = self.file.read() or ""
            data = True
        elif outside != self.outside:
            self.outside, data = outside, True
        if self.dirty and self.document.hash != self._kept_hash:
            self.file.keep(self.document.text)
            self._kept_hash = self.document.hash
        elif not self.dirty and self._kept_hash:
            self._kept_hash = ""
            if self.kept is None:
                self.file.discard()
        return data

    def _do(self, asked: Any, _: Any) -> None:
        self.document.do(gesture(asked))

    def _edit(self, splices: Any, message: Any) -> None:
        if message.get("base") != self.document.hash:
            raise ModelError("the text has changed meanwhile", "type it again")
        try:
            edits = [(int(a), int(b), str(text)) for a, b, text in splices]
        except (OverflowError, TypeError, ValueError):
            raise ModelError("the edit cannot be read", "reload the page") from None
        self.document.edit(edits)

    def _undo(self, *_: Any) -> None:
        self.document.undo()

    def _redo(self, *_: Any) -> None:
        self.document.redo()

    def _pull(self, asked: Any, message: Any) -> Tree:
        """The pose after a pull, which goes ``on`` from the last one or begins at the text's pose; the text stays."""
        sketch = self.document.reading.sketch
        try:
            link, steps = str(asked["link"]), asked["path"][-8:]
            at = (float(asked["at"][0]), float(asked["at"][1]))
            path = [(float(x), float(y)) for x, y in steps]
            on = bool(message["pull"].get("on"))
            if not all(map(math.isfinite, [*at, *(x for place in path for x in place)])):
                raise ValueError
        except (KeyError, IndexError, OverflowError, TypeError, ValueError):
            raise ModelError("the pull cannot be read", "reload the page") from None
        if sketch is None or link not in sketch.compiled.links:
            raise ModelError("this link cannot be pulled", "choose a moving link")
        what = self.document.hash, link, at
        if on and self._pulled is not None and self._pulled[0] == what:
            sketch = self._pulled[1]
        for x, y in path:
            sketch = sketch.pulled(link, at, (max(-1e6, min(x, 1e6)), max(-1e6, min(y, 1e6))))
        self._pulled = what, sketch
        drives = {drive: _position(sketch.drive_positions, m_drive) for drive, m_drive in _driven(sketch)}
        return {"pose": sketch.placed, "drives": {k: x for k, x in drives.items() if x is not None}}

    def _save(self, name: Any, _: Any) -> Tree:
        if isinstance(name, str) and name not in ("", self.file.path.name):
            self.file.discard()
            self.file = self.file.elsewhere(name)
            self.document.name = str(self.file.path)
        self.file.save(self.document.text)
        self.saved, self.outside, self.kept = self.document.text, None, None
        return {"said": f"Saved as {self.file.path.name}"}

    def _choose(self, which: Any, _: Any) -> None:
        """Choice between two versions: the one on disk (``disk``), the one here (``mine``), the one that an
        earlier run did not save (``kept``), or the saved one instead (``forget``)."""
        if which == "disk" and self.outside is not None:
            self.document.replace(self.outside)
            self.saved = self.file.read() or ""
            self.outside = None
        elif which == "mine":
            self.saved = self.file.read() or ""
            self.outside = None
        elif which == "kept":
            self.kept = None
        elif which == "forget":
            self.document.replace(self.saved)
            self.kept = None
            self.file.discard()

    def _options(self, asked: Any, _: Any) -> None:
        if isinstance(asked, dict):
            self.static, self.friction = bool(asked.get("static")), bool(asked.get("friction", True))

    def _open(self, asked: Any, _: Any) -> None:
        if asked == "empty":
            self.document.replace(EMPTY)
        elif isinstance(asked, dict):
            self.document.replace(problem_text(str(asked.get("kind")), str(asked.get("name"))))

    def _problems(self, *_: Any) -> Tree:
        return {"problems": problems()}

    def _keys(self, *_: Any) -> Tree:
        return {"keys": part_keys()}


def _driven(sketch: Any) -> list[tuple[str, tuple[str, str]]]:
    c = sketch.compiled
    return [(name, c.freedoms[int(f)]) for name, f in zip(c.schedule.names, c.layout.driven, strict=True)]


def _position(positions: dict[tuple[str, str], float], freedom: tuple[str, str]) -> float | None:
    return positions.get(freedom)


_DOES: dict[str, Any] = {
    "do": Session._do,
    "edit": Session._edit,
    "undo": Session._undo,
    "redo": Session._redo,
    "pull": Session._pull,
    "save": Session._save,
    "choose": Session._choose,
    "options": Session._options,
    "open": Session._open,
    "problems": Session._problems,
    "keys": Session._keys,
}
"""Key of a message -> what it does."""
