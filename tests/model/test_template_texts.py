"""Templates without any argument are the model files that they were, to a billionth of each number."""

from __future__ import annotations

import re

import pytest

from dalembert.model.library import TEMPLATES
from tests.model.template_texts import text_of, texts

NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e-?\d+)?(?!\w)")
TEXTS = texts()


@pytest.mark.parametrize("name", TEMPLATES)
def test_a_template_is_as_it_was_read(name: str) -> None:
    now, was = text_of(name), TEXTS[name]
    assert NUMBER.sub("#", now) == NUMBER.sub("#", was)
    numbers = [[float(x) for x in NUMBER.findall(text)] for text in (now, was)]
    assert numbers[0] == pytest.approx(numbers[1], rel=1e-9, abs=1e-12)


def test_each_template_was_read() -> None:
    assert list(TEXTS) == list(TEMPLATES)
