"""Look of each role: stroke, width in mm, dashes in mm, fill. Themes: light, dark, print (black and white)."""

from __future__ import annotations

from typing import NamedTuple


class Look(NamedTuple):
    """Stroke colour, width, dashes and fill of a role; letters take ``stroke``."""

    stroke: str
    width: float = 0.25
    dash: tuple[float, ...] = ()
    fill: str = "none"
    weight: str = "normal"


INK, GREY, PAPER = "#1d2733", "#6b7785", "#ffffff"

_LIGHT: dict[str, Look] = {
    "link": Look(INK, 0.55),
    "link-area": Look(INK, 0.35, (), "#e9eef4"),
    "image": Look("#9aa4af", 0.2, (), "#eef1f4"),
    "pin": Look(INK, 0.35, (), PAPER),
    "block": Look(INK, 0.45, (), "#dde5ee"),
    "ground": Look(GREY, 0.4),
    "hatch": Look(GREY, 0.2),
    "support": Look(GREY, 0.35, (), "#eef1f4"),
    "center": Look(INK, 0.2, (), PAPER),
    "center-dark": Look(INK, 0.1, (), INK),
    "weld": Look(INK, 0.2, (), INK),
    "pitch": Look(INK, 0.3, (3.0, 0.8, 0.6, 0.8)),
    "belt": Look(INK, 0.15, (), "#d9b382"),
    "spring": Look("#356", 0.3),
    "trace": Look("#8a95a1", 0.2, (0.9, 0.9)),
    "joint-force": Look("#1c56a8", 0.45, (), "#1c56a8"),
    "load": Look("#c1272d", 0.5, (), "#c1272d"),
    "weight": Look("#8a5a00", 0.45, (), "#8a5a00"),
    "inertia": Look("#1a7f4b", 0.45, (), "#1a7f4b"),
    "effort": Look("#7a2fa0", 0.5, (), "#7a2fa0"),
    "friction": Look("#b85c00", 0.45, (), "#b85c00"),
    "friction-circle": Look("#b85c00", 0.3),
    "journal": Look(GREY, 0.2),
    "line-of-action": Look("#1c56a8", 0.22, (4.0, 0.7, 0.7, 0.7)),
    "faint": Look("#b3bcc6", 0.18),
    "velocity": Look("#0f7d8c", 0.4, (), "#0f7d8c"),
    "acceleration": Look("#9a3b8f", 0.4, (), "#9a3b8f"),
    "velocity-part": Look("#0f7d8c", 0.22, (1.2, 0.7), "#0f7d8c"),
    "acceleration-part": Look("#9a3b8f", 0.28, (1.2, 0.7), "#9a3b8f"),
    "load-end": Look("#c1272d", 0.4, (), PAPER),
    "effort-end": Look("#7a2fa0", 0.4, (), PAPER),
    "joint-force-end": Look("#1c56a8", 0.4, (), PAPER),
    "weight-end": Look("#8a5a00", 0.4, (), PAPER),
    "inertia-end": Look("#1a7f4b", 0.4, (), PAPER),
    "friction-end": Look("#b85c00", 0.4, (), PAPER),
    "guide": Look(GREY, 0.25),
    "thread": Look(INK, 0.25),
    "gap": Look("#c1272d", 0.3, (0.6, 0.6), "#c1272d"),
    "axis-arrow": Look(GREY, 0.25, (), GREY),
    "construction": Look("#7d8894", 0.18, (1.6, 1.0)),
    "resultant": Look("#7d8894", 0.3, (2.4, 0.8)),
    "resultant-force": Look(INK, 0.65, (), INK),
    "leader": Look("#9aa4af", 0.15),
    "dimension": Look(GREY, 0.18, (), GREY),
    "axis": Look(GREY, 0.25),
    "grid": Look("#d5dbe1", 0.15),
    "level": Look(GREY, 0.3, (4.5, 0.8, 0.8, 0.8)),
    "missing-fill": Look("#eef1f4", 0.1, (), "#eef1f4"),
    "curve-1": Look("#1c56a8", 0.45),
    "curve-2": Look("#c1272d", 0.45, (2.0, 0.8)),
    "curve-3": Look("#1a7f4b", 0.45, (0.7, 0.7)),
    "curve-4": Look("#7a2fa0", 0.45, (2.4, 0.7, 0.6, 0.7)),
    "curve-5": Look("#b85c00", 0.45, (4.0, 1.0)),
    "curve-6": Look("#0f7d8c", 0.45, (1.2, 0.5)),
    "bar": Look("#1c56a8", 0.15, (), "#dde5ee"),
    "mark": Look(INK, 0.2, (), INK),
    "text": Look(INK),
    "title": Look(INK, weight="bold"),
    "note": Look(GREY),
}

SOLIDS: dict[str, tuple[str, str, str]] = {
    "solid": ("#f1f4f8", "#dfe6ee", "#c3ceda"),
    "ground-solid": ("#e6e8ea", "#d3d7db", "#b9bfc6"),
    "outer": ("#d3dfee", "#b4c8e2", "#93afd2"),
    "inner": ("#fbf1dc", "#f3dfb4", "#dfc48b"),
}
"""Role of a solid -> its tones on top, in front and aside: links, ground, a joint's part on i and on j."""


def _solid_looks(tones: tuple[str, str, str]) -> dict[str, Look]:
    """Looks by ending: faces with an outline, `-fill` the same without one, edges, the highlight on a ball."""
    named = dict(zip(("-top", "-front", "-side"), tones, strict=True)) | {"": tones[1]}
    out = {end: Look(INK, 0.2, (), fill) for end, fill in named.items()}
    out |= {f"{end}-fill": Look(fill, 0.15, (), fill) for end, fill in named.items()}
    return out | {"-edge": Look(INK, 0.2), "-spot": Look(tones[0], 0.1, (), tones[0])}


for _role, _tones in SOLIDS.items():
    _LIGHT |= {f"{_role}{end}": look for end, look in _solid_looks(_tones).items()}

_DARK = {"ink": "#e8edf2", "grey": "#9aa7b4", "paper": "#151b22"}
_DARK_FILLS = {
    "#e9eef4": "#26313d",
    "#dde5ee": "#33414f",
    "#eef1f4": "#222b35",
    "#ffffff": "#151b22",
    "#d9b382": "#8a6a3c",
}
_DARK_TONES = (
    ("#4a5a6b", "#3a4857", "#2b3744"),
    ("#3a4148", "#2f353b", "#24292e"),
    ("#3f628f", "#31507a", "#253f63"),
    ("#8a733f", "#6f5b30", "#554523"),
)
_DARK_FILLS |= {
    light: dark
    for one, other in zip(SOLIDS.values(), _DARK_TONES, strict=True)
    for light, dark in zip(one, other, strict=True)
}
_DARK_STROKES = {
    INK: _DARK["ink"],
    GREY: _DARK["grey"],
    "#1c56a8": "#6fa8f5",
    "#c1272d": "#ff7b74",
    "#8a5a00": "#e0b050",
    "#1a7f4b": "#5fd394",
    "#7a2fa0": "#c792ea",
    "#b85c00": "#f2a65a",
    "#0f7d8c": "#59cbd9",
    "#9a3b8f": "#e58ada",
    "#d5dbe1": "#323d48",
    "#b3bcc6": "#4c5864",
    "#356": "#9fc1e0",
}
_PRINT_DASH = {"inertia": (2.2, 0.7), "weight": (0.8, 0.5), "effort": (3.0, 0.6, 0.6, 0.6)}


def _dark(look: Look) -> Look:
    fill = _DARK_FILLS.get(look.fill, _DARK_STROKES.get(look.fill, look.fill))
    stroke = fill if look.stroke == look.fill else _DARK_STROKES.get(look.stroke, look.stroke)
    return look._replace(stroke=stroke, fill=fill)


def _print(role: str, look: Look) -> Look:
    fill = look.fill if look.fill in ("none", PAPER) else _print_fill(look.fill)
    grey = look.stroke in ("#d5dbe1", "#9aa4af", "#b3bcc6")
    seamless = look.stroke == look.fill and look.fill in _DARK_FILLS
    stroke = fill if seamless else "#999999" if grey else "#000000"
    return look._replace(stroke=stroke, fill=fill, dash=_PRINT_DASH.get(role, look.dash))


def _print_fill(fill: str) -> str:
    """Greys for areas, three tones for solids; black for inked areas."""
    tones = {
        tone: ("#f7f7f7", "#e8e8e8", "#cfcfcf")[k] for some in SOLIDS.values() for k, tone in enumerate(some)
    }
    return tones.get(fill) or ("#f0f0f0" if fill in _DARK_FILLS else "#000000")


THEMES: dict[str, dict[str, Look]] = {
    "light": _LIGHT,
    "dark": {role: _dark(look) for role, look in _LIGHT.items()},
    "print": {role: _print(role, look) for role, look in _LIGHT.items()},
}
"""Theme -> role -> look."""

BACKGROUND = {"light": PAPER, "dark": _DARK["paper"], "print": PAPER}
"""Colour of the paper, so that a drawing is legible on any page."""

FONT = "'DejaVu Sans', 'Helvetica Neue', Arial, sans-serif"
