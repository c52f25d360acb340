"""Takes the picture of the live view: python tests/viewer/take_picture.py walker.footwork docs/images/live-view.png

Needs Chromium. Take it on an idle machine: the graphs in it tell how busy that is.
"""

import shutil
import subprocess
import sys
import time
from typing import Any

from playwright.sync_api import sync_playwright

FLAGS = ["--no-sandbox", "--enable-unsafe-swiftshader"]
PATIENCE = 120.0


def main(bundle: str, picture: str) -> None:
    command = [sys.executable, "-m", "footwork.cli.main", "play", bundle, "--no-open"]
    playing = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    try:
        address = next(line for line in playing.stderr if line.startswith("live view at "))  # type: ignore[union-attr]
        with sync_playwright() as driver:
            browser = driver.chromium.launch(executable_path=shutil.which("chromium"), args=FLAGS)
            page = browser.new_page(viewport={"width": 1280, "height": 800})
            page.goto(address.removeprefix("live view at ").strip())
            play(page)
            page.evaluate("footwork.stage.detail(1); footwork.stage.draw(footwork.camera.target); 0")
            page.screenshot(path=picture)
            browser.close()
    finally:
        playing.terminate()
        playing.wait()


def play(page: Any) -> None:
    """Walks, jumps, and runs round a corner."""
    wait(page, "globalThis.footwork?.session.poses > 60")
    page.keyboard.down("w")
    time.sleep(3.0)
    press(page, "Space")
    time.sleep(3.0)
    page.keyboard.down("Shift")
    time.sleep(2.0)
    page.keyboard.down("a")
    time.sleep(1.2)
    wait(page, "footwork.figure.speed > 2 && Object.values(footwork.figure.standing).some(Boolean)")


def press(page: Any, key: str) -> None:
    page.keyboard.down(key)
    time.sleep(0.2)
    page.keyboard.up(key)


def wait(page: Any, condition: str) -> None:
    end = time.monotonic() + PATIENCE
    while not page.evaluate(condition):
        if time.monotonic() > end:
            raise SystemExit(f"the page never came to {condition}")
        time.sleep(0.02)


if __name__ == "__main__":
    main(*sys.argv[1:])
