"""Meaning of the columns of a class's table: the student, the variant, a figure, or nothing that counts.

Figures are named as on the sheets: `effort.O2`, `F23` (the force of link 2 on link 3), `T12`, `Force at A`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from dalembert.errors import ModelError
from dalembert.grading.answer_sheet import KNOWN, named_figure
from dalembert.grading.written_figure import written_unit

if TYPE_CHECKING:
    from dalembert.model import Mechanism, StatedAnswer

STUDENT = re.compile(
    r"student(?: name)?|name|full name|e-?mail(?: address)?|user ?name|login|(?:student )?id(?: number)?"
    r"|sis[_ ]?id|matric\w*|roll ?no\.?",
    re.I,
)
GIVEN_NAME = re.compile(r"first name|given name|forename", re.I)
SURNAME = re.compile(r"last name|surname|family name", re.I)
VARIANT = re.compile(r"variant|version|set|group|problem no\.?|(?:.*\W)?(?:variant|version)(?:\W.*)?", re.I)
PASSED_OVER = re.compile(
    r"time ?stamp|(?:start|completion|last modified|grade posted) time|started(?: on)?|completed(?: on)?|duration"
    r"|time taken|state|status|score|grade/?[\d.]*|(?:points|feedback|score) ?-.*|(?:quiz|grader) feedback|language"
    r"|section\w*|submitted|attempt|n (?:in)?correct|total.*|q\. ?\d+ ?/.*|\d+(?:\.\d+)?|institution"
    r"|department|last downloaded.*|instructions?|",
    re.I,
)

_COMPONENT = re.compile(
    r"(?:[._ ]|(?<=\d)|(?<=\d\}))\(?(x|y|z|size|magnitude|mag|direction|angle|dir)\)?\s*$", re.I
)
_WORDS = {"size": "magnitude", "mag": "magnitude", "angle": "direction", "dir": "direction"}
_NUMBERED = re.compile(r"([FGRT])_?\{?(\d)[,_ ]?(\d)\}?")
_FORCE = re.compile(
    r"(?:(?:joint |pin )?(?:reaction|force)s?\s*(?:at|in|of|on|\.)?\s*(?:joint|pin)?\s*|[FR]_?\{?)(\w+)\}?",
    re.I,
)
_EFFORT = re.compile(
    r"effort\.?\s*(?:of|at)?\s*(\w+)?"
    r"|(?:driving|input|crank|motor|required)?\s*(?:torque|moment|couple)\s*(?:at|of|on)?\s*(\w+)?",
    re.I,
)

_IN_UNIT = re.compile(
    r"\s+in (k?N(?:[ *·.]?(?:m|mm|cm))?|newtons?|lbf?(?:[ *·.-]?(?:in|ft))?|(?:in|ft)[ *·.-]?lbf?)\.?$",
    re.I,
)
_SYMBOL = re.compile(r"(.*[^\s,:])[\s,:]+([FGRT]_?\{?\d[,_ ]?\d\}?)")
_PART_OF = re.compile(r"(size|magnitude|direction|angle) of (?:the )?(.+)", re.I)
_ON = re.compile(r"(.+) on (?:the )?(\w+)", re.I)


@dataclass(frozen=True)
class FigureNames:
    """Names of a problem: links in their order, the links of each joint, the joint of each drive; figures required."""

    links: tuple[str, ...] = ()
    joints: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    drives: Mapping[str, str] = field(default_factory=dict)
    asked: frozenset[tuple[str, str | None, str | None]] = frozenset()

    @classmethod
    def of(cls, m: Mechanism | None, asked: Iterable[StatedAnswer]) -> FigureNames:
        """Names of a mechanism and its required figures; without a mechanism what the figures name."""
        answers = list(asked)
        wanted = frozenset((a.quantity, a.of, a.component) for a in answers)
        if m is None:
            joints = {str(a.of): ("", "") for a in answers if a.quantity == "reaction"}
            drives = {str(a.of): "" for a in answers if a.quantity == "effort"}
            return cls((), joints, drives, wanted)
        joints = {name: (joint.links[0], joint.links[1]) for name, joint in m.joints.items()}
        return cls(tuple(m.links), joints, {name: d.joint or name for name, d in m.drives.items()}, wanted)

    def keys(self, name: str) -> dict[str, Any] | None:
        """The keys of the figure that a name means; None where it means none, or may mean two.

        >>> four_bar = {"A": ("crank", "coupler"), "O2": ("ground", "crank")}
        >>> names = FigureNames(("ground", "crank", "coupler"), four_bar, {"O2": "O2"})
        >>> names.keys("F23"), names.keys("T12")
        ({'quantity': 'reaction', 'of': 'A', 'on': 'coupler'}, {'quantity': 'effort', 'of': 'O2'})
        >>> names.keys("Force at A (size)")
        {'quantity': 'reaction', 'of': 'A', 'component': 'magnitude'}
        """
        text = re.sub(r"\[[^\]]*\]|\((?!x|y|z|size|magn|dir|angle)[^)]*\)", " ", name).strip(" ._:")
        text = _IN_UNIT.sub("", text)
        if (exact := _exact(text)) is not None:
            return exact
        if part_of := _PART_OF.fullmatch(text):
            text = f"{part_of[2]} {part_of[1]}"
        if (words := self._with_symbol(text)) is not None:
            return words
        if (linked := _ON.fullmatch(text)) and linked[2] in self.links:
            value = self.keys(linked[1])
            return None if value is None or value["quantity"] != "reaction" else value | {"on": linked[2]}
        component = _COMPONENT.search(text)
        part: dict[str, Any] = {}
        if component and text not in self.joints:
            word = component[1].lower()
            part, text = {"component": _WORDS.get(word, word)}, text[: component.start()].strip(" ._:,")
        value = self._numbered(text) or self._of_joint(text) or self._of_drive(text)
        return None if value is None else value | part

    def _with_symbol(self, text: str) -> dict[str, Any] | None:
        """A figure in words with its symbol behind, as sheets print it: `Reaction of A on coupler, F23`."""
        both = _SYMBOL.fullmatch(text)
        if both is None:
            return None
        words, symbol = self.keys(both[1]), self._numbered(both[2])
        if words is None or symbol is None:
            return None
        agree = all(words.get(key, value) == value for key, value in symbol.items())
        return words | symbol if agree else None

    def _numbered(self, text: str) -> dict[str, Any] | None:
        """`F23`, the force of 2 on 3; `T12`, the effort between 1 and 2."""
        named = _NUMBERED.fullmatch(text)
        if named is None:
            return None
        numbers = self._numbers()
        pair = {int(named[2]), int(named[3])}
        at = [n for n, ends in self.joints.items() if {numbers.get(end) for end in ends} == pair]
        if named[1] == "T":
            at = [drive for drive, joint in self.drives.items() if joint in at]
            return {"quantity": "effort", "of": at[0]} if len(at) == 1 else None
        on = [link for link, k in numbers.items() if k == int(named[3])]
        return {"quantity": "reaction", "of": at[0], "on": on[0]} if len(at) == len(on) == 1 else None

    def _numbers(self) -> dict[str, int]:
        """Numbers of the links: the one at the end of a name, else its place; the ground is 1."""
        own = {link: re.search(r"(\d+)$", link) for link in self.links}
        if all(one for link, one in own.items() if link != "ground"):
            return {link: int(one[1]) if one else 1 for link, one in own.items()}
        return {link: k + 1 for k, link in enumerate(["ground", *(n for n in self.links if n != "ground")])}

    def _of_joint(self, text: str) -> dict[str, Any] | None:
        named = _FORCE.fullmatch(text)
        for candidate in filter(None, (text, named and named[1])):
            same = [n for n in self.joints if n.lower() == str(candidate).lower()]
            either = candidate == text and text in self.drives and not self._asks_only_force_of(text)
            if len(same) == 1 and not either:
                return {"quantity": "reaction", "of": same[0]}
        return None

    def _asks_only_force_of(self, name: str) -> bool:
        """True if the unknown of this name is a force, not an effort."""
        quantities = {quantity for quantity, of, _ in self.asked if of == name}
        return "reaction" in quantities and "effort" not in quantities

    def _of_drive(self, text: str) -> dict[str, Any] | None:
        named = _EFFORT.fullmatch(text)
        if named is None:
            return None
        of = (named[1] or named[2] or "").lower()
        same = [d for d in self.drives if d.lower() == of] or ([] if of else list(self.drives))
        return {"quantity": "effort", "of": same[0]} if len(same) == 1 else None


def _exact(text: str) -> dict[str, Any] | None:
    """The keys of a name as the program writes it, `reaction.A.x`."""
    if text in KNOWN:
        return {"quantity": text}
    if "." not in text:
        return None
    try:
        keys = named_figure(text, "")
    except ModelError:
        return None
    keys.pop("value")
    return keys


def unit_of(head: str) -> str:
    """The unit that a heading gives behind its words; empty without one.

    >>> unit_of("Force at A (kN)"), unit_of("T12 in N m"), unit_of("F23 (size)")
    ('kN', 'N m', '')
    """
    match = re.search(r"\(([^()]*)\)\s*$", head) or _IN_UNIT.search(head)
    return match[1] if match and written_unit(match[1]) else ""


@dataclass(frozen=True)
class TableColumns:
    """Headings by what they are: of the student (one, or first name and surname), of the variant, of figures."""

    student: tuple[str, ...]
    variant: str | None
    figures: Mapping[str, dict[str, Any]]


def columns_of(heads: Iterable[str], names: FigureNames, given: Mapping[str, str]) -> TableColumns:
    """Meaning of each column of a table with a row a student; ``given`` maps headings to figures, `student`,
    `variant` or `-`. Raises ModelError where a heading says nothing, or no column is a figure."""
    heads = list(heads)
    for head in given:
        if head not in heads:
            raise ModelError(f"unknown column {head!r}", f"the columns are {', '.join(map(repr, heads))}")
    roles = {head: _role(given.get(head, _bare(head)), names) for head in heads}
    figures = {head: role for head, role in roles.items() if isinstance(role, dict)}
    unknown = [head for head, role in roles.items() if role is None]
    if unknown or not figures:
        raise ModelError(*_unknown(unknown, heads, names))
    first, last, both = (
        next((h for h, role in roles.items() if role == word), None) for word in ("first", "last", "student")
    )
    full = next((h for h in heads if re.fullmatch(r"(?:student |full )?name|student", _bare(h), re.I)), both)
    student = tuple(filter(None, (first, last) if first or last else (full,)))
    return TableColumns(student, next((h for h, role in roles.items() if role == "variant"), None), figures)


def _bare(head: str) -> str:
    """A heading without the number that a form or a learning platform puts before a question."""
    return re.sub(r"^\s*(?:\d{3,}\s*:|Q?\d+[.)])\s*(?=\S)", "", head).strip()


def _role(text: str, names: FigureNames) -> dict[str, Any] | str | None:
    for word, pattern in (
        ("first", GIVEN_NAME),
        ("last", SURNAME),
        ("student", STUDENT),
        ("variant", VARIANT),
    ):
        if pattern.fullmatch(text):
            return word
    value = names.keys(text)
    if value is not None:
        return value
    return "-" if text == "-" or PASSED_OVER.fullmatch(text) else None


def _unknown(unknown: list[str], heads: list[str], names: FigureNames) -> tuple[str, str]:
    wanted = sorted(".".join(filter(None, key)) for key in names.asked)
    example = (unknown or heads)[0]
    what = (
        f"no figure is known by the heading{'s' if len(unknown) > 1 else ''} {', '.join(map(repr, unknown))}"
        if unknown
        else f"no column is a figure: {', '.join(map(repr, heads))}"
    )
    target = wanted[0] if wanted else "effort.NAME"
    requested = f"; asked are {', '.join(wanted)}" if wanted else ""
    each = ", --columns once for each heading" if len(unknown) > 1 else ""
    return what + requested, f'write --columns "{example}={target}", or "{example}=-" to ignore it{each}'
