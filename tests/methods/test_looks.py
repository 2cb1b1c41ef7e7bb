"""Looks of roles in the three themes: widths and dashes as chosen, colours by the rules of each theme."""

from __future__ import annotations

from pathlib import Path

import pytest

from dalembert.views.formats.themes import (
    BACKGROUND,
    GREY,
    INK,
    PAPER,
    SOLIDS,
    THEMES,
    Look,
    _dark,
    _print,
    _print_fill,
    _solid_looks,
)

STROKES = Path(__file__).with_name("formats") / "strokes.txt"
"""A role a line: its width in mm, its dashes, and whether its area is filled with its stroke, otherwise, or not."""


def filled(look: Look) -> str:
    return "open" if look.fill == "none" else "inked" if look.fill == look.stroke else "area"


def lines(theme: str) -> list[str]:
    return [
        f"{role}: {look.width:g} mm, {' '.join(f'{d:g}' for d in look.dash) or 'whole'}, {filled(look)}"
        for role, look in THEMES[theme].items()
        if look.width != 0.25 or look.dash or look.fill != "none"
    ]


def light(color: str) -> float:
    """How light a colour is, from 0 to 1, as eyes weigh red, green and blue."""
    digits = color.lstrip("#")
    digits = digits if len(digits) == 6 else "".join(2 * d for d in digits)
    return sum(w * int(digits[k : k + 2], 16) / 255 for w, k in ((0.2126, 0), (0.7152, 2), (0.0722, 4)))


def test_widths_dashes_and_areas_are_as_chosen() -> None:
    assert lines("light") == STROKES.read_text(encoding="utf-8").splitlines()
    plain = {role for role, look in THEMES["light"].items() if look[1:4] == (0.25, (), "none")}
    assert plain == {"guide", "thread", "axis", "text", "title", "note"}
    assert [role for role, look in THEMES["light"].items() if look.weight == "bold"] == ["title"]


def test_a_theme_changes_colours_only_and_on_black_and_white_three_dashes() -> None:
    dashes = {"inertia": (2.2, 0.7), "weight": (0.8, 0.5), "effort": (3.0, 0.6, 0.6, 0.6)}
    for role, look in THEMES["light"].items():
        dark, printed = THEMES["dark"][role], THEMES["print"][role]
        assert (dark.width, dark.dash, dark.weight) == (look.width, look.dash, look.weight)
        assert (printed.width, printed.weight) == (look.width, look.weight)
        assert printed.dash == dashes.get(role, look.dash)
        assert {filled(look), filled(dark)} in ({"open"}, {"inked"}, {"area"})
        assert (_dark(look), _print(role, look)) == (dark, printed)
    assert THEMES.keys() == BACKGROUND.keys() == {"light", "dark", "print"}


@pytest.mark.parametrize("theme", THEMES)
def test_lines_and_letters_stand_out_from_the_paper(theme: str) -> None:
    paper = light(BACKGROUND[theme])
    for role, look in THEMES[theme].items():
        if filled(look) != "inked":
            assert abs(light(look.stroke) - paper) > 0.13, role
    assert all(abs(light(THEMES[theme][role].stroke) - paper) > 0.45 for role in ("text", "note", "load"))


def test_in_the_dark_what_is_known_by_its_colour_has_the_colour_of_the_dark() -> None:
    assert _dark(Look("#c1272d", 0.7, (1.0, 2.0), "#c1272d", "bold")) == Look(
        "#ff7b74", 0.7, (1.0, 2.0), "#ff7b74", "bold"
    )
    assert _dark(Look(INK, fill=PAPER)) == Look("#e8edf2", fill="#151b22")
    assert _dark(Look(GREY, fill="#eef1f4")) == Look("#9aa7b4", fill="#222b35")
    assert _dark(Look("#eef1f4", 0.1, (), "#eef1f4")) == Look("#222b35", 0.1, (), "#222b35")
    assert _dark(Look("#123456", fill="#654321")) == Look("#123456", fill="#654321")
    assert _dark(Look("#356")) == Look("#9fc1e0")


@pytest.mark.parametrize(
    ("look", "stroke", "fill"),
    [
        (Look("#c1272d", fill="#c1272d"), "#000000", "#000000"),
        (Look("#c1272d", fill=PAPER), "#000000", PAPER),
        (Look(INK, fill="#dde5ee"), "#000000", "#f0f0f0"),
        (Look("#d5dbe1"), "#999999", "none"),
        (Look("#9aa4af", fill="#eef1f4"), "#999999", "#f0f0f0"),
        (Look("#b3bcc6"), "#999999", "none"),
        (Look("#8a95a1"), "#000000", "none"),
        (Look("#eef1f4", fill="#eef1f4"), "#f0f0f0", "#f0f0f0"),
        (Look("#93afd2", fill="#93afd2"), "#cfcfcf", "#cfcfcf"),
    ],
)
def test_in_black_and_white_lines_are_black_and_what_is_faint_is_grey(
    look: Look, stroke: str, fill: str
) -> None:
    """An area without an outline keeps none: its border has its colour."""
    assert _print("block", look) == look._replace(stroke=stroke, fill=fill)
    assert _print("inertia", look).dash == (2.2, 0.7)


def test_solids_are_lit_from_above_and_darkest_aside() -> None:
    greys = ("#f7f7f7", "#e8e8e8", "#cfcfcf")
    for role, tones in SOLIDS.items():
        for theme in THEMES:
            faces = [THEMES[theme][f"{role}{end}"].fill for end in ("-top", "-front", "-side")]
            assert light(faces[0]) > light(faces[1]) > light(faces[2]), (role, theme)
            assert THEMES[theme][role].fill == faces[1]
            assert [THEMES[theme][f"{role}{end}-fill"].fill for end in ("-top", "-front", "-side")] == faces
            spot = THEMES[theme][f"{role}-spot"]
            assert (spot.stroke, spot.fill) == (faces[0], faces[0])
        assert tuple(map(_print_fill, tones)) == greys
        looks = _solid_looks(tones)
        assert looks == {
            end.removeprefix(role): look
            for end, look in THEMES["light"].items()
            if end.startswith(role) and end.removeprefix(role) in looks
        }
        ends = ["-top", "-front", "-side", ""]
        assert [*looks] == [*ends, *(f"{end}-fill" for end in ends), "-edge", "-spot"]
    assert looks["-edge"] == Look(INK, 0.2)
    assert looks["-top"] == Look(INK, 0.2, (), tones[0])
    assert looks["-side-fill"] == Look(tones[2], 0.15, (), tones[2])
    assert looks["-spot"] == Look(tones[0], 0.1, (), tones[0])
