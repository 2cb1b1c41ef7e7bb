from tests.browser.opened import browser, opened

__all__ = ["browser", "opened"]
