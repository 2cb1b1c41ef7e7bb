"""The text of one mechanism as the one truth: gestures and typed edits change it, and every step can be undone."""

from __future__ import annotations

import contextlib
import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from dalembert.arrays import Tree
from dalembert.errors import DalembertError, ModelError
from dalembert.model import GROUND, Mechanism
from dalembert.model.description import mechanism
from dalembert.model.files.model_files import read_text
from dalembert.model.files.places import places
from dalembert.model.files.source import FileSource
from dalembert.model.files.splicing import Change, with_changes
from dalembert.studio.drawing import drawing
from dalembert.studio.editing.draft import Draft
from dalembert.studio.editing.gesture import Gesture
from dalembert.studio.editing.sketch_pose import SketchPose, sketch_pose
from dalembert.studio.tab_messages import sentence

STEPS = 100
"""Steps that can be undone."""
LONGEST = 256_000
"""Characters of a text in the studio."""
HIDDEN = "a link that is in no file"
"""A moving link beside a ground that is still alone, so that its points can be read and drawn."""

EMPTY = """\
dalembert: 1
title: New mechanism
units: {length: mm, force: N, mass: kg, time: s, angle: deg, moment: N*m}
gravity: none

links:
  ground: {points: {}}
"""


@dataclass(frozen=True)
class Reading:
    """A text as it is read: a mechanism with its sketch and drawing, or the error and its line."""

    mechanism: Mechanism | None
    sketch: SketchPose | None
    drawing: Tree
    error: str = ""
    line: int = 0
    tree: Tree = field(default_factory=dict)
    source: FileSource | None = None
    alone: bool = False
    """True where the file has no moving link yet."""


@dataclass
class Document:
    """A text with its history. Operations raise ModelError and change nothing where they cannot be done.

    >>> d = Document("links: {ground: {}, a: {mass: 1}}")
    >>> d.edit([(0, 0, "title: T\\n")]), d.text[:5], d.undo(), d.text[:5]
    (True, 'title', True, 'links')
    """

    text: str = EMPTY
    form: str = "yaml"
    name: str = "text"
    _past: list[str] = field(default_factory=list)
    _future: list[str] = field(default_factory=list)
    _reading: tuple[str, Reading] | None = None

    @property
    def hash(self) -> str:
        """Hash of the text, by which an edit names the text it is meant for."""
        return text_hash(self.text)

    @property
    def can(self) -> tuple[bool, bool]:
        """True if a step can be undone, and redone."""
        return bool(self._past), bool(self._future)

    @property
    def reading(self) -> Reading:
        """The present text as it is read; of one with an error, the drawing of the last good one."""
        if self._reading is None or self._reading[0] != self.text:
            before = self._reading[1] if self._reading else None
            self._reading = self.text, read(self.text, self.form, self.name, before)
        return self._reading[1]

    def prepare(self) -> None:
        """Find every value in the text, which the next gesture then need not wait for."""
        with contextlib.suppress(DalembertError):
            places(self.text, self.form)

    def do(self, gesture: Gesture) -> None:
        """A gesture: one step. A text that can be read is never changed into one that cannot."""
        now = self.reading
        if now.error:
            raise ModelError(f"line {now.line} of the text is wrong", "correct it before you go on drawing")
        m = now.mechanism
        if m is not None and m.dimension == 3:
            raise ModelError("the studio draws plane mechanisms", "edit the text of one in space")
        d = Draft(self.text, self.form, now.tree, now.sketch.placed if now.sketch else {})
        if m is not None:
            d.points = {(link, point): u for link in m.links for point, u in m.points(link).items()}  # type: ignore[misc]
        try:
            gesture.apply(d)
        except DalembertError:
            raise
        except (
            AssertionError,
            AttributeError,
            KeyError,
            IndexError,
            TypeError,
            ValueError,
            ArithmeticError,
        ) as error:
            raise ModelError(
                "the text is written in a form that this gesture cannot change", "edit the text"
            ) from error
        after = read(d.text, self.form, self.name, now)
        if after.error:
            raise ModelError(after.error)
        self.replace(d.text)
        self._reading = self.text, after

    def edit(self, splices: Sequence[tuple[int, int, str]]) -> bool:
        """Characters typed by hand, from and to places of the present text; True if something changed."""
        last = len(self.text)
        changes = [Change(*splice) for splice in splices]
        ordered = sorted(changes)
        wrong = any(not 0 <= c.start <= c.end <= last for c in changes)
        if wrong or any(a.end > b.start for a, b in pairwise(ordered)):
            raise ModelError("an edit is outside the text", "reload the page")
        return self.replace(with_changes(self.text, changes))

    def replace(self, text: str) -> bool:
        """Another text: one step; True if it differs."""
        if len(text) > LONGEST:
            raise ModelError(
                f"the text has more than {LONGEST} characters", "keep large tables in a file beside it"
            )
        if text == self.text:
            return False
        self._past = [*self._past, self.text][-STEPS:]
        self._future.clear()
        self.text = text
        return True

    def undo(self) -> bool:
        """One step back; False where there is none."""
        return self._step(self._past, self._future)

    def redo(self) -> bool:
        """One step forward again; False where there is none."""
        return self._step(self._future, self._past)

    def _step(self, back: list[str], ahead: list[str]) -> bool:
        if not back:
            return False
        ahead.append(self.text)
        self.text = back.pop()
        return True


def text_hash(text: str) -> str:
    """Hash of a text, short."""
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:16]


def read(text: str, form: str, name: str, before: Reading | None) -> Reading:
    """A text with its sketch, near the pose that was drawn before."""
    known = before.sketch.placed if before and before.sketch else {}
    alone = False
    try:
        written, source = read_text(text, form, name)
        tree: Tree = written
        links = tree.get("links") if isinstance(written, dict) else None
        if isinstance(links, dict) and set(links) <= {GROUND}:
            alone = True
            tree = {**tree, "links": {GROUND: links.get(GROUND) or {}, HIDDEN: {}}}
        m = mechanism(tree, source)
        if m.dimension == 3:
            return Reading(m, None, {"space": True, "title": m.title}, tree=written, source=source)
        sketch = None if alone else sketch_pose(m, known)
        drawn = drawing(m, sketch, written, HIDDEN if alone else "")
        return Reading(m, sketch, drawn, tree=written, source=source, alone=alone)
    except DalembertError as error:
        line = error.line if isinstance(error, ModelError) else 0
        return Reading(None, None, before.drawing if before else {}, sentence(error), line or 1)
    except OverflowError:
        said = "a length or an angle of the file exceeds the range of numbers; correct it or its unit"
        return Reading(None, None, before.drawing if before else {}, said, 1)
    except Exception as error:  # a fault of the program is the text's, which can then be changed
        return Reading(None, None, before.drawing if before else {}, sentence(error), 1)
