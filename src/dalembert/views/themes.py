"""How each role looks: stroke, width in mm, dashes in mm, fill. Themes: light, dark, print (black and white)."""

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
    "pin": Look(INK, 0.35, (), PAPER),
    "block": Look(INK, 0.45, (), "#dde5ee"),
    "ground": Look(GREY, 0.4),
    "hatch": Look(GREY, 0.2),
    "support": Look(GREY, 0.35, (), "#eef1f4"),
    "center": Look(INK, 0.2, (), PAPER),
    "center-dark": Look(INK, 0.1, (), INK),
    "weld": Look(INK, 0.2, (), INK),
    "pitch": Look(INK, 0.3, (3.0, 0.8, 0.6, 0.8)),
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
    "gap": Look("#c1272d", 0.3, (0.6, 0.6), "#c1272d"),
    "axis-arrow": Look(GREY, 0.25, (), GREY),
    "construction": Look("#7d8894", 0.18, (1.6, 1.0)),
    "resultant": Look("#7d8894", 0.3, (2.4, 0.8)),
    "resultant-force": Look(INK, 0.65, (), INK),
    "leader": Look("#9aa4af", 0.15),
    "dimension": Look(GREY, 0.18, (), GREY),
    "axis": Look(GREY, 0.25),
    "grid": Look("#d5dbe1", 0.15),
    "curve-1": Look("#1c56a8", 0.45),
    "curve-2": Look("#c1272d", 0.45, (2.0, 0.8)),
    "curve-3": Look("#1a7f4b", 0.45, (0.7, 0.7)),
    "curve-4": Look("#7a2fa0", 0.45, (2.4, 0.7, 0.6, 0.7)),
    "curve-5": Look("#b85c00", 0.45, (4.0, 1.0)),
    "curve-6": Look("#0f7d8c", 0.45, (1.2, 0.5)),
    "mark": Look(INK, 0.2, (), INK),
    "text": Look(INK),
    "title": Look(INK, weight="bold"),
    "note": Look(GREY),
}

_DARK = {"ink": "#e8edf2", "grey": "#9aa7b4", "paper": "#151b22"}
_DARK_FILLS = {"#e9eef4": "#26313d", "#dde5ee": "#33414f", "#eef1f4": "#222b35", "#ffffff": "#151b22"}
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
_BLACK = ("text", "title", "link", "link-area", "pin", "block", "mark")
_PRINT_DASH = {"inertia": (2.2, 0.7), "weight": (0.8, 0.5), "effort": (3.0, 0.6, 0.6, 0.6)}


def _dark(look: Look) -> Look:
    fill = _DARK_FILLS.get(look.fill, _DARK_STROKES.get(look.fill, look.fill))
    return look._replace(stroke=_DARK_STROKES.get(look.stroke, look.stroke), fill=fill)


def _print(role: str, look: Look) -> Look:
    black = "#000000"
    fill = look.fill if look.fill in ("none", PAPER) else "#f0f0f0" if look.fill in _DARK_FILLS else black
    grey = look.stroke in ("#d5dbe1", "#9aa4af", "#b3bcc6")
    return look._replace(
        stroke="#999999" if grey else black, fill=fill, dash=_PRINT_DASH.get(role, look.dash)
    )


THEMES: dict[str, dict[str, Look]] = {
    "light": _LIGHT,
    "dark": {role: _dark(look) for role, look in _LIGHT.items()},
    "print": {role: _print(role, look) for role, look in _LIGHT.items()},
}
"""Theme -> role -> look."""

BACKGROUND = {"light": PAPER, "dark": _DARK["paper"], "print": PAPER}
"""Colour of the paper, so that a drawing reads on any page."""

FONT = "'DejaVu Sans', 'Helvetica Neue', Arial, sans-serif"
