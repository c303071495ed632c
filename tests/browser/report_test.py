#!/usr/bin/env python3
"""Opens HTML reports in headless Chromium and clicks: exposure, divider, layers, error maps, tables, a NaN pixel, failures. Pixels on
the screen must be those that the formulas give; the console must stay empty and nothing may be loaded."""

import argparse
import base64
import json
import math
import pathlib
import sys
import tempfile
import time

from selenium import webdriver
from selenium.common.exceptions import WebDriverException
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from blackbox import Failure, require, run, run_checks
from plain_exr import write_exr

SIZE = 8
PATIENCE_S = 60
PIXEL = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg=="  # grey
HOSTILE = "</script><img src=x onerror=document.title='broken'>&amp;\"'"
MAGENTA = [255, 0, 255]


def pixels(value):
    return [value(i % SIZE, i // SIZE) for i in range(SIZE * SIZE)]


def layer(name, red, green, blue):
    return {f"{name}.R": pixels(red), f"{name}.G": pixels(green), f"{name}.B": pixels(blue)}


def test_image(gain):
    return {**layer("indirect", lambda x, y: gain * (0.05 + 0.01 * x), lambda x, y: gain * (0.2 + 0.02 * y), lambda x, y: gain * 0.1),
            **layer("diffuse", lambda x, y: gain * 0.03, lambda x, y: gain * 0.02, lambda x, y: gain * (0.01 + 0.01 * x))}


A = test_image(1.3)
B = test_image(1.0)


def srgb8(linear):
    x = min(1.0, max(0.0, linear))
    return 255 * (12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055)


def shown(image, name, x, y, stops):
    return [srgb8(image[f"{name}.{c}"][y * SIZE + x] * 2 ** stops) for c in "RGB"]


def differs(found, expected, tolerance):
    return max(abs(a - b) for a, b in zip(found, expected)) > tolerance


class Page:
    """A report in the browser."""

    def __init__(self, browser, path):
        self.browser = browser
        browser.get(path.as_uri())
        self.viewer = browser.find_element(By.CSS_SELECTOR, ".viewer")
        browser.execute_script("arguments[0].scrollIntoView()", self.viewer)
        self.wait(lambda: self.viewer.get_attribute("data-ready"), "the viewer to be ready")
        self.canvas = self.find(".stage canvas")

    def wait(self, condition, what):
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            if condition():
                return
            time.sleep(0.05)
        raise Failure(f"waited {PATIENCE_S} s for {what}")

    def script(self, text, *arguments):
        return self.browser.execute_script(text, *arguments)

    def find(self, selector):
        return self.viewer.find_element(By.CSS_SELECTOR, selector)

    def press(self, label):
        """The button of the viewer with that text."""
        buttons = [b for b in self.viewer.find_elements(By.CSS_SELECTOR, "button") if b.text == label]
        require(len(buttons) == 1, f"{len(buttons)} buttons are called {label!r}")
        buttons[0].click()

    def settle(self, layer_index, error):
        """Until the pair of that layer and error map is shown."""
        self.wait(lambda: self.viewer.get_attribute("data-ready") == f"{layer_index} 1 0 {error}", f"layer {layer_index}, error map {error}")
        time.sleep(0.1)

    def place(self, x, y):
        """Where the middle of an image pixel is on the stage, in CSS pixels."""
        zoom, cx, cy = (float(self.viewer.get_attribute(f"data-{name}")) for name in ("zoom", "centre-x", "centre-y"))
        width, height = self.script("const s = arguments[0].parentElement; return [s.clientWidth, s.clientHeight]", self.canvas)
        return width / 2 + (x + 0.5 - cx) * zoom, height / 2 + (y + 0.5 - cy) * zoom

    def at(self, x, y, offset=(0.42, 0.42)):
        """The canvas's colour there, beside the middle, where the divider and the values are not."""
        zoom = float(self.viewer.get_attribute("data-zoom"))
        left, top = self.place(x, y)
        return self.script(
            "const c = arguments[0], d = c.width / c.parentElement.clientWidth;"
            "return [...c.getContext('2d').getImageData(Math.floor(arguments[1] * d), Math.floor(arguments[2] * d), 1, 1).data].slice(0, 3)",
            self.canvas, left + offset[0] * zoom, top + offset[1] * zoom)

    def expect(self, x, y, expected, what, tolerance=2):
        found = self.at(x, y)
        require(not differs(found, expected, tolerance), f"{what}: pixel ({x}, {y}) is {found}, expected {[round(v, 1) for v in expected]}")

    def exposure(self, stops):
        field = self.find(".exposure-number")
        field.send_keys(Keys.CONTROL, "a")
        field.send_keys(str(stops), Keys.TAB)
        time.sleep(0.2)


class ReportTest:
    def __init__(self, browser, compare, report, folder):
        self.browser = browser
        self.compare = compare
        self.report = report
        self.folder = pathlib.Path(folder)
        broken = {name: list(values) for name, values in A.items()}
        broken["indirect.G"][3 * SIZE + 2] = math.nan
        for name, image in {"a": A, "b": B, "nan": broken}.items():
            write_exr(self.folder / f"{name}.exr", SIZE, SIZE, image)

    def compared(self, test, *arguments):
        """The page of `compare test b.exr`."""
        name = f"{test}.html"
        done = run([self.compare, f"{test}.exr", "b.exr", "--html", name, "--overwrite", *arguments], cwd=self.folder)
        require(done.status == 1, f"{done}: the images differ")
        return Page(self.browser, self.folder / name)

    def exposure(self):
        page = self.compared("a")
        page.press("A")
        for stops in (0, 1.5, -2):
            page.exposure(stops)
            page.expect(2, 6, shown(A, "indirect", 2, 6, stops), f"A at {stops} stops")
        page.canvas.send_keys("+")
        time.sleep(0.2)
        page.expect(2, 6, shown(A, "indirect", 2, 6, -1.5), "A after the key +")
        page.press("B")
        page.expect(2, 6, shown(B, "indirect", 2, 6, -1.5), "B")

    def tone(self):
        page = self.compared("a")
        page.press("A")
        page.exposure(2)
        r, g, b = (4 * A[f"indirect.{c}"][6 * SIZE + 2] for c in "RGB")
        Select(page.find(".choose-tone")).select_by_value("reinhard")
        scale = 1 / (1 + 0.2126 * r + 0.7152 * g + 0.0722 * b)
        page.expect(2, 6, [srgb8(v * scale) for v in (r, g, b)], "Reinhard")
        Select(page.find(".choose-tone")).select_by_value("aces")
        page.expect(2, 6, [srgb8(v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14)) for v in (r, g, b)], "ACES")

    def divider(self):
        page = self.compared("a")
        page.exposure(0)
        page.expect(1, 5, shown(A, "indirect", 1, 5, 0), "left of the divider")
        page.expect(6, 5, shown(B, "indirect", 6, 5, 0), "right of the divider")
        target = page.place(1, 5)[0] - page.place(3.5, 5)[0]  # from the middle to pixel 1's left part
        ActionChains(self.browser).drag_and_drop_by_offset(page.find(".divider"), int(target) - 20, 0).perform()
        page.expect(2, 5, shown(B, "indirect", 2, 5, 0), "right of the dragged divider")
        page.expect(0, 5, shown(A, "indirect", 0, 5, 0), "left of the dragged divider")
        before = int(page.find(".divider").get_attribute("aria-valuenow"))
        page.find(".divider").send_keys(Keys.ARROW_RIGHT * 5)
        require(int(page.find(".divider").get_attribute("aria-valuenow")) == before + 10, "five arrows move the divider by 10 %")

    def flip(self):
        page = self.compared("a")
        page.exposure(0)
        page.press("A")
        ActionChains(self.browser).click_and_hold(page.find(".flip")).perform()
        page.expect(2, 6, shown(B, "indirect", 2, 6, 0), "A while flipped")
        ActionChains(self.browser).release().perform()
        page.expect(2, 6, shown(A, "indirect", 2, 6, 0), "A after the flip")

    def layers_and_errors(self):
        page = self.compared("a")
        page.exposure(0)
        page.press("diffuse")
        page.settle(1, 0)
        page.expect(1, 4, shown(A, "diffuse", 1, 4, 0), "layer diffuse")
        page.press("error")
        relative = page.at(1, 4)
        require(differs(relative, shown(A, "diffuse", 1, 4, 0), 20), "the error map is not the image")
        # |1.3 Y - Y| / (Y + mean Y / 100) is nearly 0.3 everywhere: one colour, that of the legend at log10(0.3).
        legend = page.script("const c = arguments[0].querySelector('.legend-bar'); return [...c.getContext('2d').getImageData(arguments[1], 0, 1, 1)"
                             ".data].slice(0, 3)", page.viewer, round(255 * (math.log10(0.297) + 4) / 4))
        require(not differs(relative, legend, 6), f"the relative error 0.3 is {relative}, its legend {legend}")
        Select(page.find(".choose-error")).select_by_visible_text("signed difference A − B")
        page.settle(1, 2)
        require(differs(page.at(1, 4), relative, 20), "another error map has other colours")
        page.press("indirect")
        page.settle(0, 2)
        require("FLIP" in [option.text for option in Select(page.find(".choose-error")).options], "FLIP is offered for indirect")

    def readout(self):
        page = self.compared("a")
        zoom = float(page.viewer.get_attribute("data-zoom"))
        ActionChains(self.browser).move_to_element_with_offset(page.canvas, int(1.4 * zoom), int(0.6 * zoom)).perform()
        text = page.find(".readout").text.split()
        require(text[:4] == ["x", "5", "y", "4"], f"the pixel under the pointer is {text[:4]}")
        for word in ("0.130", "0.364", "0.280", "0.100", "0.0686"):
            require(word in text, f"{word} is missing in {text}")
        before = page.find(".zoom-text").text
        page.press("A")  # no divider in the way
        page.canvas.click()
        page.script("arguments[0].dispatchEvent(new WheelEvent('wheel', {deltaY: -300, bubbles: true, cancelable: true, clientX: 300, clientY: 300}))",
                    page.canvas)
        require(page.find(".zoom-text").text != before, "the wheel zooms")
        page.press("Fit")
        require(page.find(".zoom-text").text == before, "Fit goes back")

    def table(self):
        page = self.compared("a")
        table = page.script("return [...document.querySelectorAll('table.sortable')].find(t => t.caption?.textContent === 'channels')")
        column = "[...arguments[0].tHead.rows[0].cells].findIndex(c => c.textContent === 'mse')"
        values = f"const k = {column}; return [...arguments[0].tBodies[0].rows].map(r => Number(r.cells[k].dataset.value))"
        page.script(f"arguments[0].tHead.rows[0].cells[{column}].querySelector('button').click()", table)
        rising = page.script(values, table)
        page.script(f"arguments[0].tHead.rows[0].cells[{column}].querySelector('button').click()", table)
        falling = page.script(values, table)
        require(len(set(rising)) > 3 and rising == sorted(rising), f"not sorted: {rising}")
        require(falling == rising[::-1], f"not reversed: {falling}")
        page.script("arguments[0].tBodies[0].querySelector('.pixel-link').click()", table)
        require(page.find(".readout").text.startswith("x "), "the worst pixel is shown")

    def non_finite(self):
        page = self.compared("nan")
        page.press("A")
        page.exposure(0)
        page.expect(2, 3, MAGENTA, "a NaN", 0)
        page.expect(3, 3, shown(A, "indirect", 3, 3, 0), "its neighbour")
        page.press("error")
        page.expect(2, 3, MAGENTA, "a NaN's error", 0)
        text = page.find(".non-finite").text
        require("1 in A, 0 in B" in text, f"the count is {text!r}")
        failures = self.browser.find_element(By.CSS_SELECTOR, ".failures").text
        require("indirect.G" in failures and "not finite" in failures.lower() or "nan" in failures.lower(), f"failures: {failures!r}")
        require(self.browser.find_element(By.CSS_SELECTOR, ".verdict").text == "differs", "the verdict")

    def chain(self):
        """A page of compare --step: every image of the chain is in one viewer."""
        write_exr(self.folder / "between.exr", SIZE, SIZE, test_image(1.1))
        page = self.compared("a", "--step", "sampling=between.exr")
        Select(page.find(".choose-a")).select_by_visible_text("without sampling")
        page.wait(lambda: page.viewer.get_attribute("data-ready") == "0 2 0 0", "the other image")
        page.exposure(0)
        page.expect(2, 5, shown(test_image(1.1), "indirect", 2, 5, 0), "the image without sampling")
        require("steps" in page.script("return [...document.querySelectorAll('caption')].map(c => c.textContent)"), "the steps have a table")

    def described(self):
        """A report from a description with hostile texts, an SVG and a fragment that would run scripts."""
        svg = ("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 10 10'><rect width='10' height='10' fill='#0a0'/>"
               "<script>parent.document.title='broken'</script></svg>")
        (self.folder / "plot.svg").write_text(svg)
        (self.folder / "pixel.png").write_bytes(base64.b64decode(PIXEL))
        (self.folder / "fragment.html").write_text("<p id=here>fragment</p><script>top.document.title='broken'</script><img src='http://127.0.0.1:9/x.png'>")
        (self.folder / "table.csv").write_text(f'name,value\n"{HOSTILE.replace(chr(34), chr(34) * 2)}",10\nb,9\n')
        spec = {"$schema": "vsgltools/report/1", "title": HOSTILE, "summary": HOSTILE, "failures": [HOSTILE], "sections": [
            {"title": HOSTILE, "content": [
                {"type": "text", "text": HOSTILE},
                {"type": "table", "caption": HOSTILE, "csv": "table.csv"},
                {"type": "figure", "svg": "plot.svg", "alt": HOSTILE, "caption": HOSTILE},
                {"type": "figure", "png": "pixel.png", "alt": HOSTILE},
                {"type": "fragment", "html": "fragment.html", "title": HOSTILE},
                {"type": "images", "reference": {"file": "b.exr", "label": HOSTILE}, "tests": [
                    {"file": "a.exr", "label": HOSTILE}, {"file": "b.exr", "label": "same"}]}]}]}
        (self.folder / "spec.json").write_text(json.dumps(spec))
        run([self.report, "spec.json", "-o", "spec.html", "--overwrite"], cwd=self.folder).expect_success()
        page = Page(self.browser, self.folder / "spec.html")
        require(self.browser.title == HOSTILE, f"the title is {self.browser.title!r}")
        require(self.browser.find_element(By.TAG_NAME, "h1").text == HOSTILE, "the heading shows the text as it is")
        require(page.script("return [...document.querySelectorAll('main img')].map(i => i.naturalWidth > 0)") == [True, True],
                "only the figures are images, and both are drawn")
        require(page.script("const t = document.querySelector('table.sortable'); t.tHead.rows[0].cells[1].querySelector('button').click();"
                            "return t.tBodies[0].rows[0].cells[0].textContent") == "b", "9 sorts before 10")
        Select(page.find(".choose-a")).select_by_visible_text("same")
        page.wait(lambda: page.viewer.get_attribute("data-ready") == "0 2 0 0", "the other image")
        require("0 %" in page.find(".statistics").text, "an image has no error against itself")
        self.refused += ["127.0.0.1", "Blocked script execution"]

    def quiet(self, check):
        """The check, and then: no message on the console, nothing loaded, the policy in force."""
        self.refused = ["willReadFrequently"]  # the test reads the canvas, not the page
        try:
            check()
        except WebDriverException as failure:
            raise Failure(str(failure)) from failure
        entries = [e["message"] for e in self.browser.get_log("browser") if not any(word in e["message"] for word in self.refused)]
        require(not entries, f"the console says {entries}")
        loaded = self.browser.execute_script("return performance.getEntriesByType('resource').map(e => e.name).filter(n => !n.startsWith('data:'))")
        require(not loaded, f"the page loaded {loaded}")
        refused = self.browser.execute_async_script(
            "const done = arguments[0]; fetch('http://127.0.0.1:9/').then(() => done(false), () => done(true))")
        violations = [e for e in self.browser.get_log("browser") if "Content Security Policy" in e["message"]]
        require(refused and violations, "the policy lets the page fetch")

    def checks(self):
        return [(check.__name__, lambda c=check: self.quiet(c)) for check in (
            self.exposure, self.tone, self.divider, self.flip, self.layers_and_errors, self.readout, self.table, self.non_finite,
            self.chain, self.described)]


def start_browser(profile):
    options = webdriver.ChromeOptions()
    options.binary_location = "/usr/bin/chromium"
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--window-size=1280,900",
                     "--force-device-scale-factor=1", "--no-first-run", f"--user-data-dir={profile}"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    browser = webdriver.Chrome(options=options, service=webdriver.chrome.service.Service("/usr/bin/chromedriver"))
    browser.set_page_load_timeout(PATIENCE_S)
    browser.set_script_timeout(PATIENCE_S)
    return browser


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--compare", type=pathlib.Path, required=True, help="the executable")
    parser.add_argument("--report", type=pathlib.Path, required=True, help="the executable")
    parser.add_argument("--only", action="append", help="run this check alone (repeatable)")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as profile:
        try:
            browser = start_browser(profile)
        except WebDriverException as failure:
            print(f"FAIL Chromium does not start: {failure}")
            return 1
        try:
            checks = ReportTest(browser, arguments.compare.resolve(), arguments.report.resolve(), folder).checks()
            return run_checks([check for check in checks if not arguments.only or check[0] in arguments.only])
        finally:
            browser.quit()


if __name__ == "__main__":
    raise SystemExit(main())
