#!/usr/bin/env python3
"""Maps in a real browser: headless Chromium with simulated input. Usage: browser_test.py PROGRAM

Needs chromium, chromium-driver and python3-selenium; skipped if they are missing. TERRANE_SCREENSHOTS names a folder
for images of the page."""
import os
import pathlib
import shutil
import sqlite3
import subprocess
import sys
import time

import support
from support import HANG_SECONDS, ProgramTest

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    sys.exit(77)

DRIVER, CHROMIUM = shutil.which("chromedriver"), shutil.which("chromium")
SIZE, PHONE = (1024, 700), (390, 800)
ZOOMS = range(2, -11, -1)


def start_browser():
    options = Options()
    options.binary_location = CHROMIUM
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--lang=en",
                     "--allow-file-access-from-files", f"--window-size={SIZE[0]},{SIZE[1]}"):
        options.add_argument(argument)
    options.add_experimental_option("prefs", {"intl.accept_languages": "en"})
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service(DRIVER), options=options)


class Program(support.RunningProgram):
    """`terrane serve` or `terrane map --http`, until the test ends."""

    def __init__(self, folder, *arguments):
        super().__init__(folder, *arguments)
        self.url = self.wait_for(r"the map is at (http://\S+)")[1]


class Page:
    """Actions on the page."""

    def __init__(self, test, browser):
        self.test, self.browser = test, browser

    def open(self, url):
        self.browser.get("about:blank")
        self.browser.get(url)
        self.wait_for_tiles()

    def js(self, script, *arguments):
        return self.browser.execute_script(script, *arguments)

    def wait_until(self, script, what):
        deadline = time.monotonic() + HANG_SECONDS
        while time.monotonic() < deadline:
            if value := self.js(script):
                return value
            time.sleep(0.05)
        raise AssertionError(f"{what} does not come; the page says {self.js('return document.body.innerText')!r}")

    def wait_for_tiles(self):
        """Waits until all images in view are loaded completely."""
        self.wait_until("""
            const tiles = [...document.querySelectorAll('.leaflet-tile')];
            return tiles.length > 0 && tiles.every(
                tile => tile.classList.contains('leaflet-tile-loaded') && tile.naturalWidth === 256);""", "the map")

    def hash(self):
        return self.js("return location.hash").lstrip("#").split(",")

    def press(self, key):
        ActionChains(self.browser).send_keys(key).perform()

    def click(self, selector):
        self.browser.find_element(By.CSS_SELECTOR, selector).click()

    def image(self, name):
        if folder := os.environ.get("TERRANE_SCREENSHOTS"):
            time.sleep(0.5)  # images are faded in
            self.browser.save_screenshot(str(pathlib.Path(folder) / f"{name}.png"))

    def errors(self):
        return [entry["message"] for entry in self.browser.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")]


class BrowserTest(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.browser = start_browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()

    def setUp(self):
        super().setUp()
        self.browser.set_window_size(*SIZE)
        self.browser.get_log("browser")
        self.page = Page(self, self.browser)

    def tearDown(self):
        self.assertEqual(self.page.errors(), [], "the console has errors")

    def start(self, *arguments):
        program = Program(self.folder, *arguments)
        self.addCleanup(program.clean_up)
        # Closed before the program ends: it would log failed requests.
        self.addCleanup(self.browser.get, "about:blank")
        return program

    def show_map(self, *arguments):
        return self.start("map", "--http", "0", "--seed", "7", *arguments)


class Looking(BrowserTest):
    """A map without a game server."""

    def test_every_zoom_and_panning(self):
        self.page.open(self.show_map().url + "#296,104,2,day")
        for zoom in ZOOMS:
            self.assertEqual(int(self.page.hash()[2]), zoom)
            self.page.wait_for_tiles()
            self.page.image(f"zoom_{zoom}")
            colors = self.page.js("""
                const canvas = document.createElement('canvas'), context = canvas.getContext('2d', {willReadFrequently: true}), found = new Set();
                canvas.width = canvas.height = 256;
                for (const tile of document.querySelectorAll('.leaflet-tile')) {
                    context.drawImage(tile, 0, 0);
                    const bytes = context.getImageData(0, 0, 256, 256).data;
                    for (let k = 0; k < bytes.length; k += 404) found.add(bytes[k] << 16 | bytes[k + 1] << 8 | bytes[k + 2]);
                }
                return found.size;""")
            self.assertGreater(colors, 50, f"zoom {zoom} shows nothing")
            if zoom > ZOOMS[-1]:
                self.page.click(".leaflet-control-zoom-out")
                self.page.wait_until(f"return location.hash.split(',')[2] === '{zoom - 1}'", "the next zoom")
        self.page.open(self.page.js("return location.href").split("#")[0] + "#0,0,0,day")
        self.page.press(Keys.ARROW_RIGHT)
        self.page.wait_until("return Number(location.hash.slice(1).split(',')[0]) < -50", "land to the east, which is -x")
        self.page.press(Keys.ARROW_UP)
        self.page.wait_until("return Number(location.hash.split(',')[1]) < -50", "land to the north, which is -y")
        ActionChains(self.browser).move_to_element(self.browser.find_element(By.ID, "map")).click_and_hold().move_by_offset(
            150, 0).release().perform()
        self.page.wait_until("return Number(location.hash.slice(1).split(',')[0]) > -60", "land to the west")
        self.page.wait_for_tiles()

    def test_a_link_leads_to_the_same_place(self):
        url = self.show_map().url
        self.page.open(url + "#-1234,567,-1,night,height")
        self.assertEqual(self.page.hash(), ["-1234", "567", "-1", "night", "height"])
        self.page.image("link")
        self.assertEqual(self.page.js("return document.querySelectorAll('img.leaflet-tile[src*=\"/night/-1/\"], "
                                      "img.leaflet-tile[src*=\"tiles/night/-1/\"]').length > 0"), True)
        self.page.js("location.hash = '#10,20,1,isometric'")
        self.page.wait_until("return location.hash === '#10,20,1,isometric'", "the other place")
        self.page.wait_for_tiles()
        for odd in ("#", "#x,y,z", "#1,2", "#1e999,0,0", "#1,2,3,nothing,else", "#%", "#9999999999,0,0,day"):
            self.page.js("location.hash = arguments[0]", odd)
        self.page.js("location.hash = '#10,20,1,day'")  # the page still follows
        self.page.wait_for_tiles()
        self.page.open(url)

    def test_layers(self):
        self.page.open(self.show_map().url)
        for layer in ("night", "isometric", "day"):
            self.page.click(f"#bases input[value={layer}]")
            self.page.wait_for_tiles()
            self.assertEqual(self.page.hash()[3], layer)
            self.page.image(f"layer_{layer}")
        for overlay in ("height", "biome"):
            self.page.click(f"#overlays input[value={overlay}]")
            self.page.wait_for_tiles()
            self.assertIn(overlay, self.page.hash())
            self.page.image(f"overlay_{overlay}")
            self.page.click(f"#overlays input[value={overlay}]")
        self.page.press("n")
        self.page.wait_until("return location.hash.includes('night')", "the night")

    def test_search_measure_and_the_cursor(self):
        places = self.folder / "positions.txt"
        places.write_text("1000.5 -2000.5 90 0 0 The old mill\n5 6 70 0 0\n")
        self.page.open(self.show_map("--map-places", places).url)
        query = self.browser.find_element(By.ID, "query")
        for typed, x, y in (("-300, 400", -300, 400), ("the OLD", 1000, -2000), ("1", 5, 6), ("7 8", 7, 8)):
            query.clear()
            query.send_keys(typed, Keys.ENTER)
            self.page.wait_until(f"""const [x, y] = location.hash.slice(1).split(',').map(Number);
                return Math.abs(x - {x}) < 2 && Math.abs(y - {y}) < 2""", typed)
            query = self.browser.find_element(By.ID, "query")
        query.clear()
        query.send_keys("nowhere", Keys.ENTER)
        self.page.wait_until("return document.getElementById('notice').innerText.includes('nowhere')", "a word of it")
        self.page.click("#map")
        self.page.press("m")
        surface = self.browser.find_element(By.ID, "map")
        for dx in (-200, 100):
            ActionChains(self.browser).move_to_element_with_offset(surface, dx, 50).click().perform()
        scale = self.page.js("return 2 ** -terrane.map.getZoom()")
        shown = self.page.wait_until("return document.getElementById('notice').innerText.match(/^\\d+ blocks/)?.[0]", "a length")
        self.assertAlmostEqual(int(shown.split()[0]), 300 * scale, delta=3)
        self.page.image("measure")
        self.page.press(Keys.ESCAPE)
        facts = self.page.wait_until("return document.getElementById('place').innerText.match(/^-?\\d+, -?\\d+, \\d+ · .+/)?.[0]",
                                     "what is under the cursor")
        self.assertGreaterEqual(facts.count("·"), 2, facts)

    def test_a_phone(self):
        self.browser.set_window_size(*PHONE)
        self.page.open(self.show_map().url)
        self.page.image("phone")
        self.assertTrue(self.page.js("return document.getElementById('panel').hidden"), "the panel hides the map")
        self.page.click("#open")
        self.page.wait_until("return !document.getElementById('panel').hidden", "the panel")
        self.page.image("phone_panel")
        for selector in ("#query", "#open", "#panel", ".leaflet-control-zoom-in"):
            box = self.page.js("const b = document.querySelector(arguments[0]).getBoundingClientRect();"
                               "return [b.left, b.top, b.right, b.bottom, innerWidth, innerHeight]", selector)
            self.assertGreaterEqual(min(box[0], box[1]), 0, selector)
            self.assertLessEqual(box[2], box[4], selector)
            self.assertLessEqual(box[3], box[5] + 1, selector)
        self.assertLessEqual(self.page.js("return document.documentElement.scrollWidth - innerWidth"), 0)

    def test_dark_and_light(self):
        self.page.open(self.show_map().url)
        ink = lambda: self.page.js("return getComputedStyle(document.getElementById('panel')).color")
        before = ink()
        self.page.press("t")
        self.assertNotEqual(ink(), before)
        self.page.image("dark")
        self.page.open(self.page.js("return location.href"))
        self.assertNotEqual(ink(), before, "the choice is kept")
        self.page.press("t")
        self.assertEqual(ink(), before)
        self.page.press("?")
        self.page.wait_until("return document.getElementById('keys').open", "the list of keys")
        self.page.image("keys")

    def test_a_folder_of_files(self):
        folder = self.folder / "site"
        arguments = ("map", "--seed", "7", "--radius", "12", "--max-zoom", "1", "--tiles", folder)
        self.succeed(*arguments)
        written = {file: file.stat().st_mtime_ns for file in folder.rglob("*.png")}
        self.assertEqual({file.parent.parent.parent.name for file in written}, {"day", "night", "height", "biome", "isometric"})
        self.assertIn(" 0 of ", support.run(*arguments).stderr)
        victim = next(iter(written))
        victim.unlink()
        self.assertIn(" 1 of ", support.run(*arguments).stderr)
        self.assertTrue(victim.exists())
        self.page.open((folder / "index.html").as_uri())
        for zoom in range(-1, 4):
            for layer in ("day", "isometric"):
                self.page.js(f"location.hash = '#0,0,{zoom},{layer}'")
                self.page.wait_until(f"return location.hash.includes('{layer}')", layer)
                self.page.wait_for_tiles()
                self.page.image(f"files_{layer}_{zoom}")
        done = support.run("map", "--seed", "8", "--radius", "12", "--tiles", folder)
        self.assertRefused(done, "another world")
        self.assertRefused(support.run("map", "--seed", "8", "--radius", "1", "--tiles", self.folder), "other files")


class Playing(BrowserTest):
    """A server with bots on it."""

    def setUp(self):
        super().setUp()
        # Players begin at about 290,100.
        self.server = self.start("serve", "--world", self.folder / "w.sqlite", "--generator", "continents", "--seed", "7",
                                 "--address", "127.0.0.1", "--port", "0", "--http", "0")
        self.port = self.server.wait_for(r"on port (\d+)")[1]

    def send_bot(self, *arguments):
        bot = subprocess.Popen([support.program(), "bots", "--connect", f"127.0.0.1:{self.port}", "--count", "1",
                                "--seconds", "600", *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               env=support.environment(None, self.folder))
        self.addCleanup(bot.wait)
        self.addCleanup(bot.kill)

    def test_players_are_seen_and_move(self):
        self.page.open(self.server.url)
        self.assertIn("Nobody plays.", self.page.js("return document.getElementById('playing').innerText"))
        self.send_bot("--builders", "0", "--name", "Zoë")
        self.page.wait_until("return document.querySelector('.player span')?.innerText === 'Zoë0'", "the player")
        where = "const [p] = [...terrane.live.players.values()].map(marker => marker.place); return p && [p.x, p.y]"
        first = self.page.wait_until(where, "where it is")
        self.page.js("window.row = document.querySelector('#playing button')")
        self.page.wait_until(f"const [p] = [...terrane.live.players.values()].map(marker => marker.place);"
                             f"return p && Math.hypot(p.x - {first[0]}, p.y - {first[1]}) > 3", "a step")
        self.assertTrue(self.page.js("return window.row !== null && window.row === document.querySelector('#playing button')"),
                        "a row that is replaced would lose a click")
        self.page.image("player")
        self.server.say("kick Zoë0")
        self.page.wait_until("return document.querySelector('.player') === null", "an empty map")
        for _ in range(2):
            self.page.click("#overlays input[value=markers]")
        self.assertEqual(self.page.js("return document.querySelectorAll('.player').length"), 0, "who left comes back")

    def test_an_edit_is_seen_soon(self):
        self.page.open(self.server.url + "#296,104,0,day")
        self.page.js("""
            const context = new OffscreenCanvas(256, 256).getContext('2d', {willReadFrequently: true});
            function pixels(image) {
                context.drawImage(image, 0, 0);
                return context.getImageData(0, 0, 256, 256).data.reduce((sum, byte) => (sum * 31 + byte) % 1e9, 7);
            }
            window.loads = [];
            for (const image of document.querySelectorAll('.leaflet-tile')) {
                const [, x, y] = image.src.match(/tiles\\/day\\/0\\/(-?\\d+)\\/(-?\\d+)/);
                window.loads.push([0, Number(x), Number(y), pixels(image)]);
            }
            window.before = window.loads.length;
            document.getElementById('map').addEventListener('load', event => {
                const found = event.target.src?.match(/tiles\\/day\\/0\\/(-?\\d+)\\/(-?\\d+)\\.png\\?/);
                if (found) window.loads.push([Date.now(), Number(found[1]), Number(found[2]), pixels(event.target)]);
            }, true);""")
        self.send_bot("--behaviour", "build", "--edits-per-second", "0.5")
        self.page.wait_until("return [...document.querySelectorAll('.leaflet-tile')].every("
                             "tile => tile.style.opacity === '1' || tile.style.opacity === '')", "the end of fading in")
        self.page.js("""
            window.fades = 0;
            new MutationObserver(changes => { window.fades += changes.filter(({target}) => target.style.opacity < 1).length; })
                .observe(document.querySelector('.leaflet-tile-pane'), {attributes: true, attributeFilter: ['style'], subtree: true});""")
        self.page.wait_until("return window.loads.length >= window.before + 3", "an edit")
        self.assertEqual(self.page.js("return window.fades"), 0, "images flicker")
        self.page.image("edit")
        loads = self.page.js("return window.loads")
        edits = self.edits()
        at, x, y = min(edits)
        of_tile = [(when, pixels) for when, *tile, pixels in loads if tile == [x // 256, y // 256]]
        before = of_tile[0][1]
        shown = [when for when, pixels in of_tile if pixels != before and when >= at * 1000]
        self.assertTrue(shown, f"{edits[:3]} is not among {loads[:5]}")
        # Half a second on a free machine. Tests may share theirs.
        self.assertLess(min(shown) / 1000 - at, 20)
        print(f"an edit was on the map after {min(shown) / 1000 - at:.2f} s", file=sys.stderr)

    def edits(self):
        """Time, x and y of each."""
        with sqlite3.connect(f"file:{self.folder}/w.server.sqlite?mode=ro", uri=True) as records:
            return [(when / 1000, *chunk_corner(key)) for when, key in records.execute("SELECT time, chunk FROM edits")]

    def test_places_get_names(self):
        self.page.open(self.server.url)
        self.server.say("mark 280 90 80 <b>Mill</b> & Söhne")
        self.page.wait_until("return [...document.querySelectorAll('.named span')].some("
                             "label => label.textContent === '<b>Mill</b> & Söhne')", "the place")
        self.page.image("place")
        self.server.say("unmark <b>Mill</b> & Söhne")
        self.page.wait_until("return document.querySelectorAll('.named').length === 1", "the spawn alone")

    def test_a_server_that_comes_back(self):
        self.page.open(self.server.url)
        port = self.server.url.rsplit(":", 1)[1].strip("/")
        self.server.say("stop")
        self.page.wait_until("return document.getElementById('notice').innerText.includes('does not answer')", "a word of it")
        self.browser.get_log("browser")  # clear failed requests
        self.start("serve", "--world", self.folder / "w.sqlite", "--address", "127.0.0.1", "--port", "0", "--http", port)
        self.page.wait_until("return document.getElementById('notice').hidden", "the server")
        self.page.wait_for_tiles()
        self.browser.get_log("browser")


def chunk_corner(key):
    """x and y of the first block of a chunk, by docs/file-format.md."""
    x, y = key >> 28 & 0xFFFFFFF, key & 0xFFFFFFF
    return (x - (1 << 27)) * 16, (y - (1 << 27)) * 16


if __name__ == "__main__":
    if not DRIVER or not CHROMIUM:
        sys.exit(77)
    support.main()
