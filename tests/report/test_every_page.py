"""Every kind of page on a desk and in a hand, light and dark: it fits, axe-core finds nothing, and every control of it does something."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from browser_pages import WAIT_MS, Opened, chromium, findings
from page_kinds import KINDS, REPORTS, SCHEMES, SCREENS, address_of

CONTROLS = "button, input, select, textarea, summary, canvas, a[href]"
"""What of a page a person can operate."""
NAMED = """(one) => {
  const way = [];
  for (let at = one; at && at.tagName !== "BODY"; at = at.parentElement) {
    way.unshift(at.id ? "#" + at.id : at.tagName.toLowerCase() + [...at.parentElement.children].indexOf(at));
  }
  return way.slice(Math.max(0, way.findLastIndex((part) => part.startsWith("#")))).join(" > ");
}"""
"""A name that a control has alone: its way from the nearest element with an id."""
DRAWN = {"relighting": "document.documentElement.dataset.rest === 'true'", "model": "document.documentElement.dataset.drawn === 'yes'",
    "mark": "document.documentElement.dataset.ready"}  # fmt: skip
"""What is true on a page once it has drawn."""
DOWNLOADS = ("#save-section", "#save")
"""Controls of the viewers that hand over a file."""


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Headless Chromium, one for the module."""
    with chromium() as running:
        yield running


def shown(browser: Any, at: str, kind: str, **context: Any) -> Opened:
    """The page, once it has drawn; what it asks of its own server is nothing to tell."""
    page = browser.new_context(**context).new_page()
    found = Opened(page)
    page.goto(at)
    drawn = DRAWN.get(kind, "document.documentElement.dataset.drawn || !document.querySelector('.scene')")
    page.wait_for_function(drawn, timeout=WAIT_MS)
    return found


def strange(found: Opened, at: str) -> list[str]:
    """What the page said, or asked of anyone but its server."""
    own = at.partition("?")[0].rstrip("/")
    return [line for line in found.said if not (own.startswith("http") and line.startswith(own))]


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_it_fits_every_screen_and_axe_finds_nothing(browser: Any, tmp_path: Path, kind: str) -> None:
    with address_of(kind, tmp_path) as at:
        for screen, (width, height) in SCREENS.items():
            for scheme in SCHEMES:
                found = shown(browser, at, kind, viewport={"width": width, "height": height}, color_scheme=scheme)
                wide = found.page.evaluate("document.documentElement.scrollWidth")
                assert wide <= width, f"{screen}: wider than the screen"
                assert findings(found.page) == [], (screen, scheme)
                assert strange(found, at) == []
                found.page.context.close()


class Driver:
    """Operates the controls of a page by mouse and keys, and sees whether each one does something."""

    def __init__(self, found: Opened, again: Callable[[Any], None] | None = None) -> None:
        self.page, self.again = found.page, again
        self.driven: list[str] = []
        self.page.add_style_tag(content="* { outline: none !important; transition: none !important; scroll-behavior: auto !important }")

    def picture(self, control: Any = None) -> bytes:
        """The window's picture; without a control, which may show that it is pressed."""
        hidden = [] if control is None else [self.page.locator(f"[data-driven='{control.get_attribute('data-driven')}']")]
        return bytes(self.page.screenshot(mask=hidden))

    def open_ones(self) -> list[tuple[str, Any]]:
        """Controls that can be operated now and have not been."""
        found = [(handle.evaluate(NAMED), handle) for handle in self.page.query_selector_all(CONTROLS)]
        return [(name, one) for name, one in found if name not in self.driven and one.is_visible() and one.is_enabled()]

    def drive_all(self) -> None:
        """Operate what is open until nothing new is; a button that is pressed already waits until another one was."""
        while True:
            ready = [(name, one) for name, one in self.open_ones() if not self.waits(name, one)]
            if not ready:
                return
            for name, one in ready:
                if one.is_visible() and not self.waits(name, one):
                    self.drive(name, one)

    def waits(self, name: str, one: Any) -> bool:
        """Whether it would do nothing now, or end the page."""
        return name == "#done" or one.get_attribute("aria-pressed") == "true"

    def drive(self, name: str, one: Any) -> None:
        one.evaluate("(one, name) => { one.dataset.driven = name; }", name)
        one.scroll_into_view_if_needed()
        if name in DOWNLOADS and "mark" not in self.page.title():
            with self.page.expect_download() as saved:
                one.click()
            assert saved.value.suggested_filename
        elif one.evaluate("(one) => one.tagName === 'A'") and not str(one.get_attribute("href")).startswith("#"):
            self.follow(one)
        else:
            assert any(self.answers(one, disturb) for disturb in (None, self.disturb)), f"{name} does nothing"
        if one.get_attribute("type") == "checkbox":
            one.click()  # as it was: what it shows is needed to see what others do
        self.driven.append(name)

    def follow(self, link: Any) -> None:
        """A link leads to a page that is there."""
        where = link.evaluate("(one) => one.href")
        other = self.page.context.new_page()
        other.goto(where)
        assert other.title() == "a surface"
        other.close()

    def answers(self, one: Any, before: Callable[[], None] | None) -> bool:
        """Whether something else on the page, or whether it is pressed, is another once it was operated."""
        if before is not None:
            before()
        kind = one.evaluate("(one) => one.tagName === 'INPUT' ? one.type : one.tagName.toLowerCase()")
        apart = one if kind in {"button", "checkbox", "a", "summary"} else None
        one.scroll_into_view_if_needed()
        one.hover()
        one.focus()
        self.page.wait_for_timeout(150)
        was, pressed = self.picture(apart), one.get_attribute("aria-pressed")
        self.operate(one, kind)
        for _ in range(20):
            if self.picture(apart) != was or one.get_attribute("aria-pressed") != pressed:
                return True
            self.page.wait_for_timeout(100)
        return False

    def operate(self, one: Any, kind: str) -> None:
        if kind == "range":
            low, high, value = (float(one.evaluate(f"(one) => one.{key}")) for key in ("min", "max", "value"))
            one.fill(f"{low + (high - low) * (0.75 if (value - low) < (high - low) / 2 else 0.25):g}")
        elif kind == "select":
            options, value = one.evaluate("(one) => [[...one.options].map((each) => each.value), one.value]")
            one.select_option(next(each for each in reversed(options) if each != value))
        elif kind == "canvas":
            one.press("ArrowLeft")
        else:
            one.click()

    def disturb(self) -> None:
        """Bring the page out of its first state: turn what is drawn, and go to the other end."""
        for canvas in self.page.query_selector_all("canvas"):
            if canvas.is_visible():
                canvas.press("ArrowUp")
                canvas.press("ArrowLeft")
                for _ in range(14):
                    canvas.press("-")
        if self.again is not None:
            self.again(self.page)
        self.page.evaluate("scrollTo(0, scrollY ? 0 : document.body.scrollHeight)")

    def left(self) -> list[str]:
        """Controls that were never operated."""
        return [name for name in (one.evaluate(NAMED) for one in self.page.query_selector_all(CONTROLS)) if name not in self.driven]


def drag(page: Any, start: tuple[float, float], end: tuple[float, float]) -> None:
    """A drag between two places of the canvas, in shares of it."""
    box = page.locator("#view").bounding_box()
    page.mouse.move(box["x"] + start[0] * box["width"], box["y"] + start[1] * box["height"])
    page.mouse.down()
    page.mouse.move(box["x"] + end[0] * box["width"], box["y"] + end[1] * box["height"], steps=4)
    page.mouse.up()


def measured(page: Any) -> None:
    """Two points of what is drawn are picked, seen as at first; a busy machine may not have drawn it yet when it is clicked."""
    page.click("#reset")
    page.click("[data-does=measure]")
    for share, told in ((0.45, "second"), (0.55, "±")):
        for _ in range(20):
            page.wait_for_timeout(300)
            drag(page, (share, 0.5), (share, 0.5))
            if told in page.inner_text("#found"):
                break
    page.wait_for_selector("#section svg")


def boxed(page: Any) -> None:
    """A circle is drawn, and a box into the mask."""
    page.click("[data-tool=circle]")
    drag(page, (0.5, 0.5), (0.6, 0.5))
    page.click("[data-tool=box]")
    drag(page, (0.3, 0.3), (0.5, 0.6))
    page.click("[data-tool=circle]")


STEPS: dict[str, list[Callable[[Any], None]]] = {
    "relighting": [
        lambda page: page.click("#names [data-light=pointer]"),
        lambda page: page.click("#names [data-light=raking]"),
        lambda page: page.click("[data-does=turn]"),
        measured,
        measured,
    ],
    "model": [measured, measured],
    "mark": [boxed, lambda page: page.click("[data-tool=box]")],
}
"""What opens further controls of a page, in turn."""


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_every_control_does_something(browser: Any, tmp_path: Path, kind: str) -> None:
    with address_of(kind, tmp_path) as at:
        found = shown(browser, at, kind, viewport={"width": 1000, "height": 760}, accept_downloads=True)
        driver = Driver(found, boxed if kind == "mark" else None)
        for step in [*STEPS.get(kind, []), None]:
            if step is None:
                driver.drive_all()
            else:
                step(found.page)
                driver.drive_all()
        if kind == "mark":
            driver.drive("#done", found.page.query_selector("#done"))
        assert driver.left() == []
        refused = "409 (Conflict)" if kind == "mark" else "nothing"  # every light is given one and the same picture, which is refused
        assert [line for line in strange(found, at) if refused not in line] == []
        if kind in REPORTS:
            assert len(driver.driven) > 4
        found.page.context.close()
