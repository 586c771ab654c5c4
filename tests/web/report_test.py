#!/usr/bin/env python3
"""Pages of meshes in a browser: they draw, zoom to a first cell of 1e-7 chords, pick, and switch colours.

usage: report_test.py LAMINA OUTPUT [--large]

Needs Playwright from PyPI and Debian's chromium. Keeps screenshots in OUTPUT. With --large it measures a second mesh of
a million triangles, most of which lie in the layer.
"""
import json
import subprocess
import sys
import time
import unittest
from pathlib import Path

from playwright.sync_api import sync_playwright

large = "--large" in sys.argv
if large:
    sys.argv.remove("--large")
lamina, output = (Path(name).resolve() for name in sys.argv[1:3])
del sys.argv[1:3]
repository = Path(__file__).resolve().parents[2]
first_height = 1e-7
browser_flags = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]

# The error, in pixels, of what the vertex shader computes for vertices in view: the same steps in single precision.
shader_error = """() => {
  const {x, y, scale, width, height} = lamina.view.view(), p = lamina.mesh.points, f = Math.fround;
  const along = (v, middle) => {
    const high = f(middle), low = f(middle - high), vHigh = f(v), vLow = f(v - vHigh);
    return f(f(vHigh - high) + f(vLow - low));
  };
  let worst = 0, count = 0;
  for (let i = 0; i < p.length; i += 2) {
    if (Math.abs(p[i] - x) * scale > width / 2 || Math.abs(p[i + 1] - y) * scale > height / 2) continue;
    ++count;
    worst = Math.max(worst, Math.abs(along(p[i], x) - (p[i] - x)) * scale,
                     Math.abs(along(p[i + 1], y) - (p[i + 1] - y)) * scale);
  }
  return [count, worst];
}"""

# What the view shows: the number of colours, a hash of the pixels, and their mean redness.
look = """() => {
  const picture = lamina.view.snapshot(), paper = picture.getContext("2d");
  window.image = paper.getImageData(0, 0, picture.width, picture.height);
  const words = new Uint32Array(image.data.buffer), colors = new Set(words);
  let hash = 0, red = 0;
  for (const word of words) {
    hash = Math.imul(hash, 31) + word | 0;
    red += word & 255;
  }
  return {colors: colors.size, hash, red: red / words.length};
}"""

# The texts that boxes cut: their own, or a box that hides what is wider than it, or an axis beside its chart.
cut_texts = """() => {
  const cut = [], say = (element) => cut.push(`${element.tagName} ${element.className.baseVal ?? element.className}: ` +
                                              element.textContent.slice(0, 60));
  for (const element of document.querySelectorAll("header *, main *")) {
    if (!element.checkVisibility() || !element.textContent.trim()) continue;
    const style = getComputedStyle(element);
    if (style.overflowX !== "visible" && element.scrollWidth > element.clientWidth + 1 && element.clientWidth > 0) say(element);
    if (element.tagName === "text") {
      const box = element.getBoundingClientRect(), chart = element.ownerSVGElement.getBoundingClientRect();
      if (box.left < chart.left - 1 || box.right > chart.right + 1 || box.bottom > chart.bottom + 1) say(element);
    }
    if (element.tagName === "SELECT") {
      const brush = document.createElement("canvas").getContext("2d");
      brush.font = style.font;
      const wide = Math.max(...[...element.options].map((option) => brush.measureText(option.text).width));
      const room = element.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight);
      if (wide > room) say(element);
    }
  }
  // Texts of an axis must not run into each other, nor boxes over the mesh.
  const groups = [...document.querySelectorAll("svg.chart")].map((chart) => [...chart.querySelectorAll("text")]);
  for (const group of [...groups, [...document.querySelectorAll(".over")]]) {
    const boxes = group.filter((one) => one.checkVisibility() && one.textContent.trim())
        .map((one) => [one, one.getBoundingClientRect()]);
    boxes.forEach(([one, a], i) => boxes.slice(0, i).forEach(([, b]) => {
      if (a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom) say(one);
    }));
  }
  return cut;
}"""

# The share of the pixels that differ between two images, of which the second has moved to the left.
difference = """([before, after, shift]) => {
  const a = window[before], b = window[after];
  let different = 0, total = 0;
  for (let row = 20; row < a.height - 20; ++row)
    for (let column = 20; column < a.width - shift - 20; ++column) {
      ++total;
      const at = 4 * (row * a.width + column);
      for (let k = 0; k < 3; ++k)
        if (Math.abs(a.data[at + 4 * shift + k] - b.data[at + k]) > 40) { ++different; break; }
    }
  return different / total;
}"""


def mesh(name, *arguments):
    page = output / f"{name}.html"
    subprocess.run([lamina, "mesh", *map(str, arguments), "-o", output / f"{name}.su2", "--html", page, "--quiet"],
                   check=True)
    return page


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        output.mkdir(parents=True, exist_ok=True)
        # Away from the origin, where single precision would do.
        cls.page_file = mesh("report", "naca:0012", "--transform", "airfoil:shift:0.37,0.21", "--first-height",
                             first_height, "--growth", 1.25, "--layers", 45, "--far-field", 100)
        cls.slots = mesh("high-lift", *(repository / "examples/geometry" / f"crmhl2d_{part}.dat"
                                        for part in ("slat", "main", "flap")), "--reynolds", 9e6)
        cls.playwright = sync_playwright().start()
        cls.browser = cls.playwright.chromium.launch(
            executable_path="/usr/bin/chromium",
            args=browser_flags)

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.playwright.stop()

    def open(self, file, scheme="light"):
        page = self.browser.new_page(viewport={"width": 1280, "height": 800}, color_scheme=scheme,
                                     reduced_motion="reduce")
        self.addCleanup(page.close)
        messages, requests = [], []
        page.on("console", lambda message: messages.append(message.text))
        page.on("pageerror", lambda error: messages.append(str(error)))
        page.on("request", lambda request: requests.append(request.url))
        self.addCleanup(lambda: self.assertEqual(messages, []))
        self.addCleanup(lambda: self.assertEqual([url for url in requests if not url.startswith(("file:", "data:"))],
                                                 []))
        page.goto(file.as_uri())
        page.wait_for_function("document.getElementById('state').textContent === ''", timeout=120_000)
        page.wait_for_timeout(400)
        return page

    def settle(self, page):
        page.wait_for_timeout(400)

    def go(self, page, place):
        page.click(f"#places button:text-is('{place}')")
        self.settle(page)

    def test_draws_and_switches_colours(self):
        page = self.open(self.slots)
        page.screenshot(path=output / "high-lift.png")
        pictures = {}
        for color in page.eval_on_selector_all("#color option", "options => options.map((option) => option.value)"):
            page.select_option("#color", color)
            self.settle(page)
            seen = page.evaluate(look)
            pictures[color] = seen["hash"]
            self.assertGreater(seen["colors"], 20, color)
        self.assertGreaterEqual(len(pictures), 9)
        self.assertEqual(len(set(pictures.values())), len(pictures))
        page.select_option("#color", "size")
        before = page.inner_text("#bar")
        page.check("#fit")
        self.settle(page)
        self.assertNotEqual(page.inner_text("#bar"), before)
        self.go(page, "slot 1")
        page.screenshot(path=output / "high-lift-size.png")

    def test_pictures_without_a_window_are_whole(self):
        """Chromium takes them as soon as the page is loaded, and changes its size before. Edges take more bytes of a
        picture than the areas of a rough one."""
        page = self.open(self.page_file)
        page.set_viewport_size({"width": 1440, "height": 900})
        self.settle(page)
        page.screenshot(path=output / "settled.png")
        for _ in range(3):
            taken = output / "without-window.png"
            subprocess.run(["/usr/bin/chromium", "--headless", *browser_flags, "--window-size=1440,900",
                            f"--screenshot={taken}", self.page_file.as_uri()], check=True, capture_output=True)
            self.assertGreater(taken.stat().st_size, 0.8 * (output / "settled.png").stat().st_size)

    def test_boxes_do_not_cut_texts(self):
        section = output / "long.dat"
        section.write_text("A section with a title as long as those of collections are, from a paper, with its thickness\n" +
                           (repository / "examples/geometry/rae2822.dat").read_text().partition("\n")[2])
        pages = [self.page_file, self.slots, mesh("long", section, "--reynolds", 6.5e6)]
        for file in pages:
            page = self.open(file)
            page.evaluate("document.querySelectorAll('details').forEach((section) => section.open = true)")
            for width in (1280, 900, 420):
                page.set_viewport_size({"width": width, "height": 800})
                self.settle(page)
                self.assertEqual(page.evaluate(cut_texts), [], f"{file.name}, {width} pixels wide")
            page.screenshot(path=output / f"{file.stem}-narrow.png")
        self.assertIn("with its thickness", page.inner_text("#title"))
        self.assertIn("with its thickness", page.title())

    def test_follows_the_theme(self):
        brightness = {}
        for scheme in ("light", "dark"):
            page = self.open(self.page_file, scheme)
            brightness[scheme] = page.evaluate(look)["red"]
            page.screenshot(path=output / f"report-{scheme}.png")
        self.assertGreater(brightness["light"], 160)
        self.assertLess(brightness["dark"], 90)

    def test_zooms_to_a_first_cell_and_picks(self):
        page = self.open(self.page_file)
        page.click("#first-cell")
        self.settle(page)
        page.screenshot(path=output / "first-cell.png")
        view = page.evaluate("lamina.view.view()")
        self.assertGreater(first_height * view["scale"], 20)
        self.assertIn("Vertex", page.inner_text("#panel"))
        # The flow comes from the left, so the first cells lie to the left of the nose.
        page.mouse.click(0.5 * view["width"] - 0.5 * first_height * view["scale"], 60 + 0.5 * view["height"] - 8)
        self.settle(page)
        text = page.inner_text("#panel")
        self.assertRegex(text, r"layer\s+1\n")
        self.assertRegex(text, r"aspect ratio\s+\d+")
        count, error = page.evaluate(shader_error)
        print(f"first cell: {first_height * view['scale']:.0f} pixels high, {count} vertices in view, "
              f"the shader's error is at most {error:.2g} pixels")
        self.assertGreater(count, 3)
        self.assertLess(error, 0.05)

    def test_does_not_jitter(self):
        """Where the view moves by whole pixels, so does the picture."""
        page = self.open(self.page_file)
        page.click("#first-cell")
        self.settle(page)
        page.evaluate("lamina.view.select({})")
        page.evaluate(look)
        page.evaluate("window.before = image")
        page.focus("#view")
        for _ in range(2):
            page.keyboard.press("ArrowRight")   # 60 pixels each
        self.settle(page)
        page.evaluate(look)
        share = page.evaluate(difference, ["before", "image", 120])
        print(f"moved by 120 pixels at a first cell: {100 * share:.3g} % of the pixels differ")
        self.assertLess(share, 0.002)
        self.assertGreater(page.evaluate(difference, ["before", "image", 0]), 0.01)

    def test_keys_wheel_and_drag(self):
        page = self.open(self.page_file)
        view = lambda: page.evaluate("lamina.view.view()")
        start = view()
        page.focus("#view")
        page.keyboard.press("+")
        self.assertAlmostEqual(view()["scale"] / start["scale"], 1.5, places=6)
        page.keyboard.press("Enter")
        self.settle(page)
        # What lies under the mouse stays there.
        at = lambda v, px, py: (v["x"] + (px - v["width"] / 2) / v["scale"],
                                v["y"] - (py - v["height"] / 2) / v["scale"])
        bounds = page.locator(".stage").bounding_box()
        # Browsers round places of the mouse to whole pixels of the page.
        px, py = 300 - bounds["x"] % 1, 200 - bounds["y"] % 1
        before = at(view(), px, py)
        page.mouse.move(bounds["x"] + px, bounds["y"] + py)
        for _ in range(10):
            page.mouse.wheel(0, -300)
        self.settle(page)
        after = at(view(), px, py)
        self.assertGreater(view()["scale"], 50 * start["scale"])
        for a, b in zip(before, after):
            self.assertAlmostEqual((a - b) * view()["scale"], 0, delta=1e-3)
        before = view()
        page.mouse.down()
        page.mouse.move(bounds["x"] + px + 100, bounds["y"] + py + 40, steps=5)
        page.mouse.up()
        self.settle(page)
        self.assertAlmostEqual((before["x"] - view()["x"]) * view()["scale"], 100, delta=1e-3)

    def test_places_worst_cells_and_warnings_lead_there(self):
        page = self.open(self.slots)
        places = json.loads(page.inner_html("#facts"))["places"]
        for place in places:
            if place["name"].startswith("slot"):
                self.go(page, place["name"].replace(":", " "))
                view = page.evaluate("lamina.view.view()")
                self.assertAlmostEqual(view["x"], (place["window"][0] + place["window"][2]) / 2, places=9)
        page.evaluate("document.querySelectorAll('details').forEach((section) => section.open = true)")
        worst = page.locator("button.worst")
        self.assertGreaterEqual(worst.count(), 15)
        for number in range(0, worst.count(), 6):
            worst.nth(number).click()
            self.settle(page)
            text = page.inner_text("#panel")
            self.assertIn("Cell ", text)
            # The cell is in the middle of the view.
            self.assertTrue(page.evaluate("""() => {
              const {x, y, scale} = lamina.view.view(), cell = lamina.view.cellAt(x, y);
              return document.getElementById("panel").innerText.includes(`Cell ${cell.toLocaleString("en-US")}`);
            }"""))
        page.screenshot(path=output / "worst-cell.png")
        for button in page.locator(".warning button").all():
            button.click()
            self.settle(page)

    def test_a_million_triangles(self):
        """Frames keep coming while the mouse drags and the wheel turns, and the picture is the same afterwards."""
        files = {"large": ("naca:0012", "--refine", "box:-2,-2,3,2,0.0062")}
        if large:
            files["large-layer"] = ("naca:0012", "--reynolds", 6e6, "--wall-size", 0.0003, "--gradation", 0.045)
        for name, arguments in files.items():
            file = mesh(name, *arguments)
            start = time.time()
            page = self.open(file)
            ready = time.time() - start
            cells, size = page.evaluate("lamina.cells"), file.stat().st_size
            self.assertGreater(cells, 1_000_000)
            print(f"{cells} cells, {size / cells:.2f} bytes a cell, shown after {ready:.1f} s")
            for place in ("far field", "bodies", "nose", "first cell"):
                self.go(page, place)
                page.evaluate("lamina.view.select({})")
                before = page.evaluate(look)
                page.mouse.move(500, 400)
                page.mouse.down()
                drag = self.frames(page, lambda i: page.mouse.move(500 + 5 * min(i, 60 - i), 400 + 2 * min(i, 60 - i)))
                page.mouse.up()
                self.assertEqual(page.evaluate(look), before, place)
                closer = self.frames(page, lambda i: page.mouse.wheel(0, -60))
                page.screenshot(path=output / f"{name}-{place.replace(' ', '-')}-closer.png")
                away = self.frames(page, lambda i: page.mouse.wheel(0, 60))
                page.screenshot(path=output / f"{name}-{place.replace(' ', '-')}-away.png")
                print(f"  {place}: a picture takes {page.evaluate('lamina.view.frameTime()'):.0f} ms; "
                      f"drag {drag['text']}; closer {closer['text']}; away {away['text']}")
                # Other processes may share the two cores: the bound is low.
                for seen in (drag, closer, away):
                    self.assertGreater(seen["rate"], 5, place)
                self.settle(page)

    def frames(self, page, act):
        """Calls act(0) ... act(60), and returns how many frames there were in each second."""
        page.evaluate("""() => {
          const times = window.times = [performance.now()];
          const step = () => {
            times.push(performance.now());
            if (window.times === times) requestAnimationFrame(step);
          };
          requestAnimationFrame(step);
        }""")
        for i in range(61):
            act(i)
            page.wait_for_timeout(12)
        times = page.evaluate("""() => {
          const seen = window.times;
          window.times = null;
          return seen.slice(1).map((now, i) => now - seen[i]).sort((a, b) => a - b);
        }""")
        rate = 1000 * len(times) / sum(times)
        return {"rate": rate, "text": f"{rate:.0f} frames a second, longest {times[-1]:.0f} ms"}


if __name__ == "__main__":
    unittest.main()
