"""The pages with windows: on a virtual display, with keys and clicks."""
import contextlib
import re
import signal
import sqlite3
import time
import urllib.request

from .page import PageError
from .running import PAUSE, SCREEN, Display, Running


@contextlib.contextmanager
def window(page, display, command, title="Terrane"):
    running = Running(page, command, display)
    try:
        yield running.open(title)
    finally:
        running.close()


def setting(world, name):
    """A value that the world's file keeps for its player; none if there is no file yet."""
    try:
        with contextlib.closing(sqlite3.connect(f"file:{world}?mode=ro", uri=True)) as file:
            row = file.execute("SELECT value FROM settings WHERE name = ?", (name,)).fetchone()
            return row[0] if row else None
    except sqlite3.OperationalError:
        return None


def take_block(running, name):
    running.press("Tab")
    running.type(name)
    running.press("Return")


def quit_window(running):
    running.press("Escape", "q")
    running.end()


def player(page):
    folder = page.home / ".local/share/terrane"
    with page.step(1):
        page.run("./run build")
        page.run('export PATH="$PWD/build:$PATH"')
        page.run("terrane --version")
    with Display(SCREEN) as display:
        with window(page, display, page.quoted("terrane")) as game:
            with page.step(2):
                game.press("Return", "Return")  # New world, Create
                game.wait_for(lambda: setting(folder / "World.sqlite", "camera"), "no new world")
                page.output = game.output()
            with page.step(3):
                game.press("m", "m", "m", "m", "h", "F1", "F1")
                game.look_down()
            with page.step(4):
                take_block(game, page.quoted("white lamp"))
                game.hold(3)
                game.press("ctrl+z", "ctrl+y")
            with page.step(5):
                game.press("F12")
                game.wait_for(lambda: list(folder.glob("screenshots/terrane-0001.png")), "no screenshot")
            with page.step(6):
                quit_window(game)
                page.run("terrane check World")
                if not re.search(r"[1-9]\d* of them edited", page.output):
                    raise PageError(f"no lamp was placed: {page.output}")
        with page.step(6), window(page, display, "terrane") as game:
            game.press("Return")  # Continue World
            quit_window(game)
    with page.step(7):
        page.do("cd ~")
        page.run("terrane map --world World --radius 32 -o map.png")
        page.prints("terrane: map.png: 4225 chunks, 1040x1040 blocks")


def game(page):
    with page.step(1):
        page.run("mkdir -p ~/small-game && cd ~/small-game")
        page.do(page.quoted("cp TERRANE/examples/small_game.cpp .").replace("TERRANE", str(page.source)))
        page.write("CMakeLists.txt", page.code("cmake"))
        page.run('cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$HOME/.local"')
        page.run("cmake --build build")
        with Display(SCREEN) as display, window(page, display, page.quoted("./build/small_game world.sqlite"), "Ore hills") as own:
            own.press("w", "space", "Escape")
            own.end()


def server(page):
    start = "terrane serve --world ./home.sqlite --seed 7 --http 0.0.0.0:8080"
    page.do(f'export PATH="{page.source}/build:$PATH"')
    with page.step(1):
        page.run("mkdir -p ~/server && cd ~/server")
        console = Running(page, page.quoted(start))
        console.wait_for_line(page.quoted("the map is at http://localhost:8080/"))
    try:
        with Display(SCREEN) as display:
            command = page.quoted("terrane play --connect HOST --name Ann").replace("HOST", "localhost")
            with page.step(2):
                ann = Running(page, command, display).open()
                console.wait_for_line("Ann joined from")
                ann.look_down()
                take_block(ann, "white lamp")
                ann.hold(3)
            server_steps(page, console, ann)
    finally:
        console.close()
    with page.step(8):
        again = Running(page, page.quoted("terrane serve --world ./home.sqlite --http 0.0.0.0:8080"))
        again.wait_for_line("on port 25560")
        again.process.send_signal(signal.SIGINT)
        again.end()


def server_steps(page, console, ann):
    with page.step(3):
        console.say(page.quoted("op Ann"))
        console.wait_for_line(page.quoted("Ann is an operator now"))
        ann.press("t")
        ann.type("/list")
        ann.press("Return")
    with page.step(4):
        console.say(page.quoted("claim house 0 0 31 31 Ann"))
        console.say(page.quoted("claims"))
        console.wait_for_line("house")
    with page.step(5):
        with urllib.request.urlopen("http://localhost:8080/", timeout=60) as answer:
            if b"<html" not in answer.read():
                raise PageError("no page with the map")
    with page.step(6):
        page.run("""cd ~/server
            terrane backup ./home.sqlite ./backup.sqlite
            terrane check backup.sqlite""")
        page.prints("backup.sqlite: format 4, generator wilderness version 1, seed 7", "good")
    with page.step(7):
        page.run("terrane history --world ./home.sqlite")
        if " Ann at " not in page.output:
            raise PageError(f"no edit by Ann: {page.output}")
    quit_window(ann)
    with page.step(8):
        console.say(page.quoted("stop"))
        console.end()


def pack(page):
    page.do(f'export PATH="{page.source}/build:$PATH"')
    with page.step(1):
        page.run("terrane packs init isles")
        page.run("cd ~/.local/share/terrane/packs/isles\nls")
        page.prints(*"README.md blocks.toml generators languages pack.toml textures".split())
    with page.step(2):
        page.run("terrane packs check isles")
        page.prints("isles: good: 3 blocks, 1 generator, 5 files")
    with Display(SCREEN) as display:
        with page.step(3):
            game = Running(page, page.quoted("terrane play --content isles --generator isles:hills --watch"), display).open()
            game.wait_for(lambda: setting(page.home / ".local/share/terrane/isles:hills-1.sqlite", "camera"), "no world")
        with page.step(4):
            page.write("blocks.toml", "\n" + page.code("toml"), mode="a")
            page.run("terrane packs check isles")
            take_block(game, page.quoted("ember"))
            game.hold(3)
            page.replace("languages/en.toml", "[blocks]\n", "[blocks]\n" + page.code("toml", 1))
        with page.step(5):
            page.write("generators/hills.lua", page.code("lua"))
            page.run("terrane packs check isles")
            page.replace("generators/hills.lua", '"ember"}', '"embr"}')
            game.wait_for_line(page.quoted('hills.lua:11: unknown block "embr"; did you mean ember?'))
            page.write("generators/hills.lua", page.code("lua"))
            game.wait_for(lambda: game.output().count("regenerated") == 1, "does not load the pack again")
            game.wait_for(lambda: game.display.xdotool("search", "--onlyvisible", "--name", "Terrane"), "closes its window")
            time.sleep(2 * PAUSE)
        quit_window(game)
    with page.step(6):
        page.run("terrane map --content isles --generator isles:hills --radius 16 -o ~/map.png")
        page.run("terrane render --content isles --generator isles:hills --at=0,0,130 --look=45,-25 -o ~/isles.png")
    with page.step(7):
        page.run("cd .. && zip -r ~/isles.zip isles")
        shared = Running(page, page.quoted("terrane serve --content isles --generator isles:hills --world shared"))
        shared.wait_for_line("on port 25560")
        shared.process.send_signal(signal.SIGINT)
        shared.end()


def rules(page):
    page.do(f'export PATH="{page.source}/build:$PATH"')
    with page.step(1):
        page.run("terrane packs init goldrush")
        page.run("cd ~/.local/share/terrane/packs/goldrush")
        page.replace("pack.toml", "# " + page.quoted("rules = 1"), "rules = 1")
    with Display(SCREEN) as display:
        with page.step(2):
            page.write("scripts/gold.lua", page.code("lua"))
            page.run("terrane packs check goldrush")
            game = Running(page, page.quoted("terrane play --content goldrush --world goldrush --watch"), display).open()
            game.wait_for(lambda: setting(page.home / ".local/share/terrane/goldrush.sqlite", "camera"), "no world")
            take_block(game, page.quoted("gold ore"))
            game.look_down()
            game.hold(3)
            game.hold(1)
            game.press("t")
            game.type(page.quoted("/mode survival"))
            game.press("Return")
            game.wait_for(lambda: "torch" in (setting(page.home / ".local/share/terrane/goldrush.sqlite", "items") or ""),
                          "no torches")
            game.press("t")
            game.type(page.quoted("/mode creative"))
            game.press("Return")
            game.press("Escape")
        with page.step(3):
            page.write("scripts/gold.lua", "\n" + page.code("lua", 1), mode="a")
            page.run("terrane packs check goldrush")
        with page.step(4):
            page.write("scripts/gold.lua", page.code("lua", 2))
            page.run("terrane packs check goldrush")
            time.sleep(4 * PAUSE)
            game.press("t")
            game.type(page.quoted("/race"))
            game.press("Return")
            time.sleep(4 * PAUSE)
        quit_window(game)
    with page.step(5):
        shared = Running(page, page.quoted("terrane serve --content goldrush --world goldrush"))
        shared.wait_for_line("on port 25560")
        shared.process.send_signal(signal.SIGINT)
        shared.end()
