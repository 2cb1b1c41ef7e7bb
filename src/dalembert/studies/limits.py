"""Limits that outputs of a study have to keep, for the share of its designs that do."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags
from dalembert.errors import ModelError
from dalembert.model import Mechanism
from dalembert.model.part import ReadingRules
from dalembert.units import NUMBER
from dalembert.wording import closest, quote_value

FORMS = "write '< 45 N*m', '>= 3 kN', or '2..5 kN'"
BETWEEN = re.compile(rf"({NUMBER})\s*(.*?)\s*\.\.\s*({NUMBER})\s*(.*)")


class Limit(NamedTuple):
    """An output, the least and largest value it may have, SI, and the words they were given in."""

    output: str
    low: float
    high: float
    text: str

    def kept(self, values: Array) -> Flags:
        """True for each design (first axis) within the limit, in all components and positions; false for NaN."""
        good = (values >= self.low) & (values <= self.high)
        return np.asarray(good.reshape(len(values), -1).all(axis=1))


def read_limit(name: str, limit: object, kinds: Mapping[str, str], m: Mechanism) -> Limit:
    """Limit of an output from its text; raises ModelError."""
    if name not in kinds:
        raise ModelError(
            f"limits names {name!r}, which is not an output of the study",
            closest(name, list(kinds)),
            ("limits", name),
        )
    text = " ".join(str(limit).split())
    try:
        low, high = _ends(text, kinds[name], ReadingRules(m.units, parameters=m.parameters))
    except ModelError as error:
        raise ModelError(f"limit of {name}: {error.what}", error.remedy, ("limits", name)) from None
    if not low < high:
        raise ModelError(f"limit of {name}: {text!r} leaves nothing between", FORMS, ("limits", name))
    return Limit(name, low, high, text)


def _ends(text: str, kind: str, rules: ReadingRules) -> tuple[float, float]:
    if match := BETWEEN.fullmatch(text):
        low, first, high, last = match.groups()
        a = rules.quantity(f"{low} {first or last}".strip(), kind)
        return a, rules.quantity(f"{high} {last or first}".strip(), kind)
    sign = re.match(r"<=?|>=?|≤|≥", text)
    if sign is None:
        raise ModelError(f"{quote_value(text)} is not a limit", FORMS)
    value = float(rules.quantity(text[sign.end() :].strip(), kind))
    return (-math.inf, value) if sign[0] in ("<", "<=", "≤") else (value, math.inf)
