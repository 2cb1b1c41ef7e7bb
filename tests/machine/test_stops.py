"""End stops and what is said of them: closed forms, momentum written by hand, and how a person meets them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import dalembert as da
from dalembert.errors import ModelError

HAMMER = Path(__file__).parents[2] / "docs" / "drop-hammer.yaml"

FLYWHEEL = """
units: {length: mm, angle: deg}
links:
  ground: {points: {O: [0, 0]}}
  rotor: {points: {O: [0, 0]}, mass: 1 kg, inertia: 0.5 kg*m^2}
joints: {O: {type: pin, links: [ground, rotor]}}
drives: {O: {effort: -0.5 N*m, stops: {from: 0, to: 90, restitution: 0.5}}}
start: {O: {position: 45 deg, speed: 0}}
"""


@pytest.mark.parametrize(
    ("path", "value", "found"),
    [
        ("drives.ram.stops.restitution", 0.7, lambda m: m.drives["ram"].stops.restitution == 0.7),
        ("drives.ram.stops.to", "800 mm", lambda m: m.drives["ram"].stops.greatest == 0.8),
        ("start.ram.position", 0.3, lambda m: m.start["ram"].position == 0.3),
        ("start.ram.speed", "-1 m/s", lambda m: m.start["ram"].speed == -1.0),
    ],
)
def test_numbers_of_stops_and_starts_change_by_path(path: str, value: object, found: Any) -> None:
    m = da.load(HAMMER)
    other = m.with_values({path: value})
    assert found(other)
    assert not found(m)
    assert da.loads(str(other)) == other
    assert other.drives["ram"].stops is not None
    assert (other.drives["ram"].stops.least, other.start["ram"].turns) == (0.0, False)


@pytest.mark.parametrize(
    ("path", "value", "sentence"),
    [
        (
            "drives.ram.stops.restituton",
            0.7,
            "drives.ram: there is no key 'restituton' in stops; did you mean 'restitution'",
        ),
        ("drives.ram.stops.restitution", 7, "restitution of stops: a restitution of 7"),
        ("drives.ram.stops.restitution.x", 7, "goes into a single value"),
        ("start.ram.sped", 0.3, "there is no key 'sped' in start; did you mean 'speed'?"),
        ("start.rm.speed", 0.3, "there is no 'rm' in start"),
    ],
)
def test_what_is_no_such_path_says_so(path: str, value: object, sentence: str) -> None:
    with pytest.raises(ModelError) as raised:
        da.load(HAMMER).with_values({path: value})
    assert sentence in str(raised.value)


def test_sentences_have_the_units_of_the_tables() -> None:
    """w^2 = 2 alpha q: 45 deg at 1 rad/s2; 0.25 J at the first impact are lost for e = 0.5 to 3/4."""
    s = da.simulate(da.loads(FLYWHEEL), "4 s")
    speed = (2 * 0.7853981633974483) ** 0.5
    assert s.event("impact")[0].sentence.startswith(f"O strikes its stop at 0 rad with {speed:.6g} rad/s")
    text = s.text()
    assert f"in the first, O strikes its stop at 0 deg with {speed:.6g} rad/s" in " ".join(text.split())
    assert text.count("strikes") == 1
    assert s.record(da.analysis.output.columns.scale(s.result, "file"))["events"][0]["sentence"].startswith(
        "O strikes its stop at 0 deg with "
    )
