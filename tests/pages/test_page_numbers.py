"""What a page is told: every item of its drawings, field, handle and channel as they were, its programs left out.

`page_numbers.txt` has it, a line for each object of the data; `python -m tests.pages.test_page_numbers` writes it anew,
after a look at the page itself. What the programs compute is compared in `test_page_data.py`.
"""

from __future__ import annotations

import base64
import binascii
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.pages.html_page import html_text
from dalembert.pages.inputs import floats
from dalembert.pages.page_data import page_data
from tests.methods.test_drawn_alike import Seen, plane_machine
from tests.methods.test_drawn_numbers import alike

CHECKED = Path(__file__).with_name("page_numbers.txt")
PROGRAM = ("version", "wasm", "style", "shown", "closure", "gradient")
"""Keys that hold machine code, looks or a whole file."""
LONG = 12


def machines() -> dict[str, Any]:
    turned = plane_machine(Seen(), friction=True)
    position = {"from": 20, "to": 80, "count": 5}
    swept = turned.with_values({"drives.O.position": position, "drives.O.acceleration": 0.0})
    return {
        "arm": swept,
        "rssr": da.load(examples()["rssr"]),
        "worm": da.worm_gear(positions=3),
        "ratchet": da.ratchet(positions=3),
        "follower": da.disc_cam(positions=3),
    }


def lines(value: Any, path: str = "") -> Iterator[str]:
    """A line for each object: its plain values; arrays by their length, ends and sum."""
    if isinstance(value, dict):
        plain = {k: short(v) for k, v in value.items() if k not in PROGRAM}
        words = [f"{k} {text}" for k, text in plain.items() if text is not None]
        if words:
            yield f"{path}: {', '.join(words)}"
        for key, inner in value.items():
            if key not in PROGRAM and plain[key] is None:
                yield from lines(inner, f"{path}.{key}".lstrip("."))
    elif isinstance(value, list):
        for k, inner in enumerate(value):
            text = short(inner)
            yield from lines(inner, f"{path} {k + 1}") if text is None else [f"{path} {k + 1}: {text}"]


def short(value: Any) -> str | None:
    """A plain value or a list of them on one line; None of what has objects inside."""
    if isinstance(value, (bool, int, float)) or value is None:
        return f"{value:.6g}" if isinstance(value, float) else str(value)
    if isinstance(value, str):
        return repr(value) if not value or decoded(value) is None else summary(decoded(value))
    if isinstance(value, list) and all(isinstance(x, (int, float)) for x in value):
        return f"[{' '.join(f'{x + 0.0:.6g}' for x in value)}]" if len(value) <= LONG else summary(value)
    if isinstance(value, list) and all(isinstance(x, str) for x in value) and len(" ".join(value)) < 200:
        return repr(value)
    return None


def decoded(text: str) -> Any:
    """The numbers of an array in base 64, if it is one."""
    try:
        return np.frombuffer(base64.b64decode(text, validate=True), "<f8")
    except (ValueError, binascii.Error):
        return None


def written_out(value: Any) -> Any:
    """Data with evenly spaced series as the others are: which of the two a channel of mere rounding is, is chance."""
    if isinstance(value, dict):
        if value.keys() == {"from", "to", "count"} and isinstance(value["count"], int):
            return floats(np.linspace(value["from"], value["to"], value["count"]))
        return {key: written_out(inner) for key, inner in value.items()}
    return [written_out(inner) for inner in value] if isinstance(value, list) else value


def summary(values: Any) -> str:
    v = np.asarray(values, float)
    some = (v[0], v[-1], np.nansum(v), np.nansum(v * np.arange(len(v))))
    return f"{len(v)} numbers {' '.join(f'{x:.6g}' for x in some)}"


@cache
def checked() -> dict[str, list[str]]:
    parts = CHECKED.read_text(encoding="utf-8").split("\n\n")
    return {name: rest for name, *rest in (part.strip().splitlines() for part in parts)}


@pytest.mark.parametrize("name", ["arm", "rssr", "worm", "ratchet", "follower"])
def test_a_page_is_told_what_it_was(name: str) -> None:
    told = list(lines(written_out(page_data(machines()[name]))))
    for now, before in zip(told, checked()[name], strict=False):
        assert alike(now, before, 1e-8), f"{name}: '{now}', and before '{before}'"
    assert len(told) == len(checked()[name])


def test_a_page_is_written_whole_and_not_over_another(tmp_path: Path) -> None:
    path = tmp_path / "p.html"
    text = da.page(da.four_bar(), path)
    assert path.read_text(encoding="utf-8") == text == html_text(page_data(da.four_bar()))
    with pytest.raises(da.ModelError, match="exists"):
        da.page(da.four_bar(), path)
    other = da.page(da.four_bar(), path, static=True, overwrite=True)
    assert path.read_text(encoding="utf-8") == other != text


if __name__ == "__main__":
    each = ["\n".join([name, *lines(written_out(page_data(m)))]) for name, m in machines().items()]
    CHECKED.write_text("\n\n".join(each) + "\n", encoding="utf-8")
