"""Actions of someone who does anything in the studio: keys, clicks, drags, typed values, letters in the file."""

from __future__ import annotations

from collections.abc import Callable
from random import Random

from tests.browser.studio_tab import Studio

TOOLS = "vvvbbxpslogaiwrejdfmknc"
KEYS = (
    *("Delete", "Escape", "Escape", "Enter", "Tab", "Backspace", "PageDown", "PageUp", "Space", "0", "+"),
    *("Control+z", "Control+z", "Control+Shift+Z", "ArrowLeft", "ArrowUp", "Shift+ArrowRight"),
)
TYPED = (
    "12",
    "-30",
    "1,5",
    "2 in",
    "0",
    "1e-3",
    "45 deg",
    "3 N*m",
    "abc",
    "[0.1, 20]",
    "standard",
    "none",
    "",
)
LETTERS = ("#", " ", "1", ".", "-", "a", ":", "[", "}", "\n", "mass: 2", "Backspace", "Enter", "Control+z")
PANES = ("Part", "Forces", "File", "Answers", "Problems")


def place(s: Studio, r: Random) -> tuple[float, float]:
    """A pixel of the drawing, mostly at a point of a link."""
    ends = s.page.evaluate("(studio.state().drawing.links ?? []).flatMap(l => Object.values(l.points))")
    if ends and r.random() < 0.7:
        x, y = s.pixel(*r.choice(ends))
        if 100 < x < 690 and 60 < y < 700:
            return x, y
    return r.uniform(110, 680), r.uniform(70, 690)


def drag(s: Studio, r: Random) -> None:
    s.page.mouse.move(*place(s, r))
    s.page.mouse.down()
    s.page.mouse.move(*place(s, r), steps=r.choice([1, 2, 5]))
    if r.random() < 0.05:
        s.page.keyboard.press(r.choice(KEYS))
    s.page.mouse.up()


def click(s: Studio, r: Random) -> None:
    s.page.mouse.click(*place(s, r), click_count=r.choice([1, 1, 1, 2]))


def tool(s: Studio, r: Random) -> None:
    s.page.evaluate("document.activeElement?.blur()")
    s.page.keyboard.press(r.choice(TOOLS))


def key(s: Studio, r: Random) -> None:
    s.page.keyboard.press(r.choice(KEYS))


def line(s: Studio, r: Random) -> None:
    """A tool, its line, and typed values for it."""
    tool(s, r)
    click(s, r)
    s.page.mouse.move(*place(s, r))
    if r.random() < 0.7:
        s.page.keyboard.type(r.choice(TYPED))
        s.page.keyboard.press(r.choice(["Enter", "Tab"]))
        s.page.keyboard.press("Enter")
    else:
        click(s, r)


def field(s: Studio, r: Random) -> None:
    """A value of a part under Part."""
    pane(s, "Part")
    script = """k => { const all = [...document.querySelectorAll('.pane.part input')];
        all[k % all.length]?.focus(); return all.length; }"""
    if not s.page.evaluate(script, r.randrange(1000)):
        return
    s.page.keyboard.press("Control+a")
    s.page.keyboard.type(r.choice(TYPED))
    s.page.keyboard.press(r.choice(["Enter", "Enter", "Escape", "Tab"]))


def press(s: Studio, r: Random) -> None:
    """A button of the part that is chosen, or the choice of one."""
    pane(s, "Part")
    script = """k => { const all = [...document.querySelectorAll('.pane.part button')];
        if (all.length) all[k % all.length].click(); }"""
    s.page.evaluate(script, r.randrange(1000))


def letters(s: Studio, r: Random) -> None:
    """Letters in the file, mostly taken back."""
    pane(s, "File")
    box = s.page.locator(".cm-scroller").bounding_box()
    if not box:
        return  # a part was chosen by what was done before
    s.page.mouse.click(box["x"] + 60 + r.uniform(0, 200), box["y"] + r.uniform(0, 0.9) * box["height"])
    if r.random() < 0.5:
        s.page.keyboard.press("Home")
    some = [r.choice(LETTERS) for _ in range(r.randrange(1, 4))]
    for letter in some:
        (s.page.keyboard.press if letter[0].isupper() else s.page.keyboard.insert_text)(letter)
    if r.random() < 0.8:
        s.page.keyboard.press("Control+z")
    s.page.evaluate("document.activeElement?.blur()")


def forces(s: Studio, r: Random) -> None:
    """A handle of the page of forces is dragged, the time moved."""
    pane(s, "Forces")
    script = """() => [...document.querySelectorAll('.pane.forces:not(.stale) .handle')]
        .map(e => e.getBoundingClientRect()).filter(b => b.width)
        .map(b => [b.x + b.width / 2, b.y + b.height / 2])"""
    if handles := s.page.evaluate(script):
        x, y = r.choice(handles)
        s.page.mouse.move(x, y)
        s.page.mouse.down()
        s.page.mouse.move(x + r.uniform(-25, 25), y + r.uniform(-25, 25), steps=3)
        s.page.mouse.up()
        s.page.keyboard.press(r.choice([".", ",", " ", " "]))


def option(s: Studio, r: Random) -> None:
    s.page.locator("header input[type=checkbox]").nth(r.randrange(2)).click()


def look(s: Studio, r: Random) -> None:
    pane(s, r.choice(PANES))


def zoom(s: Studio, r: Random) -> None:
    s.page.mouse.move(*place(s, r))
    s.page.mouse.wheel(0, r.uniform(-200, 200))


def pane(s: Studio, name: str) -> None:
    s.page.click(f"[role=tab][data-pane={name}]")


ACTIONS: tuple[Callable[[Studio, Random], None], ...] = (
    *(drag, click, tool, key, line) * 3,
    *(field, press, letters, forces) * 2,
    *(option, look, zoom),
)
