"""One browser for all tests of pages."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from .browser import Browser


@pytest.fixture(scope="session")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    """A window of Chromium; the test is skipped where there is none."""
    window = Browser(tmp_path_factory.mktemp("profile"))
    yield window
    window.driver.quit()
