"""The studio in a tab of a real browser: what a person does with mouse and keys, and what is then to be seen."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest

from dalembert.studio.document import EMPTY


class Studio:
    """One tab of the studio."""

    def __init__(self, context: Any, address: str) -> None:
        self.page, self.complaints = context.new_page(), list[str]()
        self.page.on("console", lambda m: self.complaints.append(m.text))
        self.page.on("pageerror", lambda e: self.complaints.append(str(e)))
        self.page.goto(address)
        self.until("window.studio && studio.state() && studio.answered()")

    def until(self, holds: str) -> None:
        """Wait for something; the page's policy forbids what Playwright would wait by."""
        for _ in range(3000):
            if self.page.evaluate(f"() => !!({holds})"):
                return
            self.page.wait_for_timeout(20)
        raise AssertionError(f"never: {holds}; {self.text}; {self.page.inner_text('.banners')}")

    def answered(self) -> None:
        """Wait until the state is that after all that was done."""
        self.until("studio.answered()")

    def settled(self) -> None:
        """Wait until all that was done is answered, and shown as far as it has an answer."""
        self.until("studio.settled()")

    @property
    def text(self) -> str:
        return str(self.page.evaluate("studio.state().text"))

    def changes(self, act: Callable[[], object]) -> None:
        """Do something, and wait until the text is another one."""
        before = self.page.evaluate("studio.state().hash")
        act()
        self.until(f"studio.answered() && studio.state().hash !== '{before}'")

    def pixel(self, x: float, y: float) -> tuple[float, float]:
        script = """p => { const b = studio.canvas.svg.getBoundingClientRect();
            const q = studio.canvas.window.px(p); return [b.left + q[0], b.top + q[1]]; }"""
        a, b = self.page.evaluate(script, [x, y])
        return a, b

    def see(self, x: float, y: float, scale: float) -> None:
        """Look at a place, pixels per metre."""
        self.page.evaluate(
            "([x, y, s]) => { const w = studio.canvas.window; w.middle = [x, y]; w.scale = s; studio.hand.cancel(); }",
            [x, y, scale],
        )

    def click(self, key: str, *at: float) -> None:
        self.page.evaluate("document.activeElement?.blur()")
        self.page.keyboard.press(key)
        self.changes(lambda: self.page.mouse.click(*self.pixel(*at)))

    def line(self, key: str, a: tuple[float, float], b: tuple[float, float], *typed: str) -> None:
        """Drag from a to b; or, with typed values, click, type and press Enter."""
        self.page.evaluate("document.activeElement?.blur()")
        self.page.keyboard.press(key)
        self.page.mouse.move(*self.pixel(*a))
        if not typed:
            self.page.mouse.down()
            self.page.mouse.move(*self.pixel(*b), steps=5)
            self.changes(self.page.mouse.up)
            return
        self.page.mouse.click(*self.pixel(*a))
        self.page.mouse.move(*self.pixel(*b), steps=3)
        for k, value in enumerate(typed):
            if k:
                self.page.keyboard.press("Tab")
            self.page.keyboard.type(value)
        self.changes(lambda: self.page.keyboard.press("Enter"))

    def field(self, part: str, label: str, value: str) -> None:
        """Choose a part in the list, or the last point of the ground, and type one of its values."""
        self.page.click("[role=tab][data-pane=Part]")
        self.page.keyboard.press("v")
        self.page.keyboard.press("Escape")
        self.page.evaluate("studio.pick(null)")
        if part in ("ground", ""):
            name = self.page.evaluate("Object.keys(studio.state().drawing.links[0].points).at(-1)")
            self.page.evaluate("name => studio.pick({ kind: 'points', link: 'ground', name })", name)
        else:
            self.page.click(f".parts button:text-is('{part}')")
        box = self.page.get_by_label(label, exact=True)
        box.fill(value)
        self.changes(lambda: box.press("Enter"))

    def reads(self, text: str) -> None:
        """Wait until the text is this one, also of what was done in another tab."""
        for _ in range(3000):
            if self.text == text:
                return
            self.page.wait_for_timeout(20)
        raise AssertionError(f"never {text!r}, but {self.text!r}")

    def point(self, link: str, name: str = "") -> tuple[float, float]:
        """Place of a point of a link, by default its second one."""
        script = """([l, p]) => { const q = studio.state().drawing.links.find(k => k.name === l).points;
            return q[p] ?? Object.values(q)[1]; }"""
        x, y = self.page.evaluate(script, [link, name])
        return x, y

    def choose(self, kind: str, name: str, link: str = "") -> None:
        """Choose a part by the list under Part; nothing where there is no name."""
        self.page.click("[role=tab][data-pane=Part]")
        self.page.evaluate("document.activeElement?.blur()")
        self.page.keyboard.press("v")
        self.page.evaluate("studio.pick(null)")
        if name and kind == "points":
            self.page.evaluate("([link, name]) => studio.pick({ kind: 'points', link, name })", [link, name])
        elif name:
            self.page.click(
                f".parts button[data-kind={'joints' if kind == 'drives' else kind}]:text-is('{name}')"
            )

    def drawing(self) -> Any:
        return self.page.evaluate("studio.state().drawing")

    def send(self, message: object) -> None:
        """A message as the page sends it."""
        self.page.evaluate("m => void studio.socket.send(m)", message)

    def gesture(self, asked: object) -> None:
        self.send({"do": asked})

    def open(self, kind: str, name: str) -> None:
        """A bundled file, by the list of problems."""
        self.page.click("[role=tab][data-pane=Problems]")
        self.send({"open": {"kind": kind, "name": name}})
        self.answered()

    def type(self, label: str, value: str) -> None:
        """A value of the part that is chosen."""
        box = self.page.locator(f".pane.part input[aria-label='{label}']")
        box.fill(value)
        self.changes(lambda: box.press("Enter"))

    def place(self, link: str, name: str, value: str) -> None:
        """The place of a point, typed under Part."""
        self.choose("points", name, link)
        if self.page.locator(".pane.part input[aria-label=place]").input_value() != value:
            self.type("place", value)

    def second(self, link: str) -> str:
        """Name of a link's second point."""
        script = "l => Object.keys(studio.state().drawing.links.find(k => k.name === l).points)[1]"
        return str(self.page.evaluate(script, link))

    def write(self, text: str) -> None:
        """Type at the end of the file."""
        self.page.click("[role=tab][data-pane=File]")
        self.page.click(".cm-content")
        self.page.keyboard.press("Control+End")
        self.changes(lambda: self.page.keyboard.insert_text(text))
        self.page.evaluate("document.activeElement.blur()")

    def empty(self) -> None:
        """Begin with an empty drawing."""
        self.page.click("[role=tab][data-pane=Problems]")
        self.page.wait_for_selector(".list button")
        self.answered()
        if self.text != EMPTY:
            self.changes(lambda: self.page.click(".list button:text-is('Empty drawing')"))

    def effort(self) -> float:
        """The effort of the drive that the page of forces computes, of the text as it is."""
        self.until("studio.solved()")
        script = """() => { const p = studio.page(), k = p.kernel;
            const r = p.data.views.table.find(t => t.name.startsWith('effort')).rows[0];
            return k.rows[r * k.row + Math.round(p.data.start)]; }"""
        return float(self.page.evaluate(script))


@pytest.fixture
def tabs(browser: Any) -> Iterator[Callable[[Any], Studio]]:
    """Opens tabs of a served studio; none may complain."""
    contexts, opened = list[Any](), list[Studio]()

    def one(served: Any, **options: Any) -> Studio:
        contexts.append(browser.new_context(**{"viewport": {"width": 1280, "height": 800}, **options}))
        opened.append(Studio(contexts[-1], served.access.address))
        return opened[-1]

    yield one
    for context in contexts:
        context.close()
    said = [s.complaints for s in opened if s.complaints]
    assert said == [], said
