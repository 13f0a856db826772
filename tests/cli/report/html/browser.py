"""Reports in headless Chromium: opened, operated, and looked at."""

from __future__ import annotations

import base64
import json
import shutil
from pathlib import Path
from typing import Any

import pytest

CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
SWITCHES = ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-background-networking")
PHONE = 390
"""The width of a phone, in CSS pixels."""


class Browser:
    """A window of Chromium without a network. `profile` is an empty folder."""

    def __init__(self, profile: Path) -> None:
        webdriver = pytest.importorskip("selenium.webdriver")
        if CHROMIUM is None or DRIVER is None:
            pytest.skip("chromium and chromedriver are not installed")
        options = webdriver.ChromeOptions()
        options.binary_location = CHROMIUM
        for switch in (*SWITCHES, f"--user-data-dir={profile}"):
            options.add_argument(switch)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver: Any = webdriver.Chrome(
            options=options, service=webdriver.ChromeService(DRIVER)
        )

    def open(
        self,
        page: Path,
        *,
        width: int = 1280,
        dark: bool = False,
        media: str = "screen",
        script: bool = True,
        fragment: str = "",
    ) -> None:
        """Shows a page anew, and waits until its figures are drawn."""
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self._command(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=900,
            deviceScaleFactor=1,
            mobile=False,
        )
        self._command("Emulation.setEmulatedMedia", media=media, features=[scheme])
        self._command("Emulation.setScriptExecutionDisabled", value=not script)
        self.driver.get("about:blank")
        self.driver.get(page.as_uri() + fragment)
        if script and self.run("return Boolean(document.querySelector('[data-figure]'))"):
            self.wait("return document.documentElement.dataset.drawn !== undefined")

    def run(self, script: str, *arguments: Any) -> Any:
        """The result of a script in the page."""
        return self.driver.execute_script(script, *arguments)

    def wait(self, condition: str, seconds: float = 30) -> None:
        """Waits until a script returns something true."""
        from selenium.webdriver.support.wait import WebDriverWait

        WebDriverWait(self.driver, seconds).until(lambda driver: driver.execute_script(condition))

    def all(self, selector: str) -> list[Any]:
        """The elements of a CSS selector."""
        return list(self.driver.find_elements("css selector", selector))

    def texts(self, selector: str) -> list[str]:
        """The texts of these elements, as shown."""
        return [element.text for element in self.all(selector)]

    def keys(self, selector: str, *keys: str) -> None:
        """Types keys where an element has the focus."""
        self.all(selector)[0].send_keys(*keys)

    def complaints(self) -> list[str]:
        """Errors of scripts, and violations of the Content-Security-Policy, since the last call."""
        return [
            entry["message"]
            for entry in self.driver.get_log("browser")
            if entry["level"] in ("SEVERE", "WARNING")
        ]

    def violations(self) -> list[str]:
        """What axe finds against the rules of WCAG."""
        axe = pytest.importorskip("axe_core_python.selenium").Axe()
        found = axe.run(self.driver)["violations"]
        return [
            f"{each['id']}: {json.dumps([node['html'][:200] for node in each['nodes'][:3]])}"
            for each in found
        ]

    def overflow(self) -> int:
        """The pixels by which the page is wider than the window."""
        return int(
            self.run(
                "return document.documentElement.scrollWidth - document.documentElement.clientWidth"
            )
        )

    def picture(self, path: Path, *, height: int, top: int = 0) -> None:
        """Writes a part of the page as PNG."""
        width = self.run("return innerWidth")
        clip = {"x": 0, "y": top, "width": width, "height": height, "scale": 1}
        data = self._command("Page.captureScreenshot", captureBeyondViewport=True, clip=clip)[
            "data"
        ]
        path.write_bytes(base64.b64decode(data))

    def _command(self, name: str, **parameters: Any) -> Any:
        return self.driver.execute_cdp_cmd(name, parameters)
