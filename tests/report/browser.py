"""A headless chromium that looks at pages as a reader does, and records what goes wrong in them."""

from __future__ import annotations

import base64
import io
import json
import shutil
from pathlib import Path
from typing import Any

CHROMIUM = next((p for n in ("chromium", "chromium-browser", "google-chrome")
                 if (p := shutil.which(n))), None)  # fmt: skip
DRIVER = shutil.which("chromedriver")

_TILE = 2000  # pixels of height that one shot may have


def why_not() -> str:
    """Why no page can be looked at on this machine; nothing if one can."""
    if CHROMIUM is None or DRIVER is None:
        lacking = "chromium" if CHROMIUM is None else "chromedriver"
        return f"no {lacking} on this machine (apt-get install chromium chromium-driver)"
    try:
        import selenium  # noqa: F401
    except ImportError:
        return "no selenium (pip install '.[test]')"
    return ""


def open_browser() -> Any:
    """A headless chromium with WebGL in software, whose console and requests are recorded."""
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for flag in (
        "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars",
        "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--force-device-scale-factor=1",
    ):  # fmt: skip
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(options=options, service=Service(DRIVER))


def load(browser: Any, page: Path, *, width: int = 1280, height: int = 900) -> None:
    """Open a page at a width of ``width`` pixels and wait until all its charts are drawn."""
    from selenium.webdriver.support.ui import WebDriverWait

    size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    for kind in ("browser", "performance"):
        browser.get_log(kind)  # forgets what was before
    browser.get(page.resolve().as_uri())
    WebDriverWait(browser, 240).until(
        lambda b: b.execute_script("return document.body.dataset.drawn") == "yes"
    )


def complaints(browser: Any) -> list[str]:
    """Errors and warnings of the page's console, but for those on speed of the software's GL."""
    return [
        entry["message"]
        for entry in browser.get_log("browser")
        if entry["level"] in ("SEVERE", "WARNING")
        and "GPU stall due to ReadPixels" not in entry["message"]
        and "GL Driver Message" not in entry["message"]
        and "willReadFrequently" not in entry["message"]
    ]


def requests(browser: Any) -> list[str]:
    """Addresses that the page asked for, but for itself and what it holds inside."""
    found = []
    for entry in browser.get_log("performance"):
        message = json.loads(entry["message"])["message"]
        if message["method"] == "Network.requestWillBeSent":
            found.append(message["params"]["request"]["url"])
    return [url for url in found[1:] if not url.startswith(("data:", "blob:"))]


def picture(browser: Any, path: Path) -> None:
    """The whole page, top to bottom, as PNG."""
    from PIL import Image

    size = browser.execute_cdp_cmd("Page.getLayoutMetrics", {})["cssContentSize"]
    whole = Image.new("RGB", (int(size["width"]), int(size["height"])), "white")
    for top in range(0, whole.height, _TILE):
        clip = {"x": 0, "y": top, "width": whole.width, "height": min(_TILE, whole.height - top)}
        shot = browser.execute_cdp_cmd(
            "Page.captureScreenshot", {"captureBeyondViewport": True, "clip": {**clip, "scale": 1}}
        )
        whole.paste(Image.open(io.BytesIO(base64.b64decode(shot["data"]))), (0, top))
    whole.save(path)
