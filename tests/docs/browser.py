# SPDX-License-Identifier: MIT
"""Headless Chromium by chromedriver's HTTP interface (W3C WebDriver), with the standard library alone."""

import base64
import json
import shutil
import subprocess
import tempfile
import time
import urllib.error
import urllib.request
from pathlib import Path

FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync",
         "--disable-ipc-flooding-protection",  # 200 steps of a page in ten seconds
         # No name is found, so that nothing can be fetched unnoticed.
         "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE localhost, EXCLUDE 127.0.0.1"]


def is_installed() -> bool:
    return bool(shutil.which("chromium") and shutil.which("chromedriver"))


class Browser:
    """A window of the given size. A narrow one is emulated as a phone: a real one is 500 pixels wide at least."""

    def __init__(self, width: int, height: int, dark: bool = False) -> None:
        self.folder = tempfile.TemporaryDirectory(prefix="tetmend-browser-")
        log = Path(self.folder.name) / "log"
        with log.open("w") as output:
            self.driver = subprocess.Popen(["chromedriver", "--port=0"], stdout=output, stderr=subprocess.DEVNULL)
        self.base = f"http://127.0.0.1:{self._port(log)}"
        options = {"args": [*FLAGS, f"--user-data-dir={self.folder.name}/profile", f"--window-size={width},{height}"],
                   "binary": shutil.which("chromium")}
        if width < 500:
            options["mobileEmulation"] = {"deviceMetrics": {"width": width, "height": height, "pixelRatio": 2.0}}
        wanted = {"goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"}}
        self.session = ""
        self.session = f"/session/{self._post('/session', {'capabilities': {'alwaysMatch': wanted}})['sessionId']}"
        if dark:
            self.command("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])

    def _port(self, log: Path) -> int:
        for _ in range(100):
            words = log.read_text().replace(".", " ").split()
            if "port" in words and "successfully" in words:
                return int(words[len(words) - 1 - words[::-1].index("port") + 1])
            time.sleep(0.1)
        raise RuntimeError(f"chromedriver does not start: {log.read_text()}")

    def _post(self, path: str, content: dict) -> dict:
        body = json.dumps(content).encode()
        request = urllib.request.Request(self.base + path, body, {"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(json.load(error)["value"]["message"]) from None

    def command(self, name: str, **parameters: object) -> dict:
        """One of the DevTools protocol."""
        return self._post(f"{self.session}/goog/cdp/execute", {"cmd": name, "params": parameters})

    def open(self, url: str) -> None:
        self._post(f"{self.session}/url", {"url": url})

    def run(self, script: str, *arguments: object) -> object:
        return self._post(f"{self.session}/execute/sync", {"script": script, "args": list(arguments)})

    def wait_for(self, script: str, seconds: float = 20) -> object:
        """The value of the script, as soon as it is one."""
        end = time.monotonic() + seconds
        while True:
            value = self.run(script)
            if value or time.monotonic() > end:
                return value
            time.sleep(0.1)

    def _log(self, kind: str) -> list[dict]:
        return self._post(f"{self.session}/se/log", {"type": kind})

    def complaints(self) -> list[str]:
        """What the console has said since the last call."""
        return [entry["message"] for entry in self._log("browser") if entry["level"] in ("SEVERE", "WARNING")]

    def requests(self) -> list[str]:
        """The addresses that were asked for since the last call."""
        events = (json.loads(entry["message"])["message"] for entry in self._log("performance"))
        return [event["params"]["request"]["url"] for event in events if event["method"] == "Network.requestWillBeSent"]

    def picture(self) -> bytes:
        """What is seen, as PNG."""
        return base64.b64decode(self.command("Page.captureScreenshot")["data"])

    def printed(self) -> bytes:
        """The page on paper, as PDF."""
        return base64.b64decode(self.command("Page.printToPDF", paperWidth=8.27, paperHeight=11.69)["data"])

    def close(self) -> None:
        try:
            request = urllib.request.Request(self.base + self.session, method="DELETE")
            urllib.request.urlopen(request, timeout=30).close()
        except OSError:
            pass
        self.driver.terminate()
        self.driver.wait()
        self.folder.cleanup()


def window(width: int, height: int, dark: bool = False) -> Browser:
    """A browser whose page has exactly this size, and in which nothing moves by itself."""
    opened = Browser(width, height, dark)
    if width >= 500:
        opened.command("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
    looks = [{"name": "prefers-reduced-motion", "value": "reduce"}, {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]
    opened.command("Emulation.setEmulatedMedia", features=looks)
    return opened
