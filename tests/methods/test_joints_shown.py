"""`dalembert joints` and its page against the classic table of pairs, typed here by itself."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

import pytest

import dalembert as da
from dalembert.cli import main
from dalembert.model.joints.pairs import PAIRS
from tests.methods.readable import text_over_lines, text_overlaps
from tests.space.test_pairs import TABLE
from tests.tiers import crossed

ROOT = Path(__file__).resolve().parents[2]

CLASSIC = TABLE | {
    "universal": (2, 0, "Fx Fy Fz Mx"),
    "screw": (1, 0, "Fx Fy Fz My Mz"),
    "weld": (0, 0, "Fx Fy Fz Mx My Mz"),
}
"""Turns, slides, reactions of all joints; a screw's slide goes with its turn."""


def test_the_classic_table(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["joints"]) == 0
    lines = capsys.readouterr().out.splitlines()[2:]
    shown = {}
    for line in lines[: len(CLASSIC)]:
        kind, turns, slides, rest = line.split(maxsplit=3)
        shown[kind] = (int(turns), int(slides), rest.split("  ")[0])
    assert shown == CLASSIC
    for turns, slides, reactions in CLASSIC.values():
        assert turns + slides + len(reactions.split()) == 6


@crossed("kind, camera", PAIRS, ["isometric", (20.0, 15.0)])
def test_pictures_show_the_reactions(kind: str, camera: Any) -> None:
    scene = da.draw.joint(kind, camera)
    named = dict.fromkeys(a.of for a in scene.arrows() if a.of)
    assert list(named) == sorted(named, key=lambda name: "xyz".index(name[1]))
    assert set(named) == set(CLASSIC[kind][2].split())
    assert text_overlaps(scene) == []
    assert text_over_lines(scene) == []


def test_one_picture_or_many(tmp_path: Path) -> None:
    assert main(["joints", "-o", str(tmp_path / "all.svg"), "--camera", "20,15"]) == 0
    assert (tmp_path / "all.svg").read_text(encoding="utf-8").count("<text") > 100
    assert main(["joints", "-o", str(tmp_path / "each")]) == 0
    assert {path.stem for path in (tmp_path / "each").iterdir()} == set(PAIRS)
    again = ["joints", "-o", str(tmp_path / "each")]
    assert (main(again), main([*again, "--force"])) == (2, 0)  # a folder that is there, its pictures anew


def test_no_such_joint() -> None:
    with pytest.raises(da.ModelError, match="unknown joint 'sperical' in space; did you mean 'spherical'"):
        da.draw.joint("sperical")


def test_the_page_is_made_of_the_table() -> None:
    spec = importlib.util.spec_from_file_location("gallery", ROOT / "docs" / "gallery.py")
    assert spec
    assert spec.loader
    gallery = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(gallery)
    assert (ROOT / "docs" / "joints.md").read_text(encoding="utf-8") == gallery.joints_page()
