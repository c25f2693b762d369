#!/usr/bin/env python3
"""Measures the bytes to join a server's world: Terrane and Luanti, one after the other on this machine.

In each world 1,000 blocks near the spawn were changed; players see 256 blocks. Terrane: a bot joins until it knows all
edits in view; the bytes of its TLS connection are counted in both directions. Luanti (Debian: minetest, minetest-server,
xvfb): a client on a virtual screen joins through a proxy that counts bytes of UDP in both directions; it keeps turning,
since the server sends blocks ahead first, until nothing new arrives. The blocks are changed during a first visit, which
also fetches the game's images and sounds; the second visit is measured.

Times are not compared: Terrane's bot draws nothing and does not generate the land around it."""
import argparse
import json
import pathlib
import select
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time

from server_tools import Server, bots_command

EDITS = 1000
CHUNKS = 16
CLIENTS = ("/usr/games/minetest", "/usr/games/luanti")  # Debian 12; later releases
SERVERS = ("/usr/lib/minetest/minetestserver", "/usr/lib/luanti/luantiserver")
QUIET_BYTES, QUIET_SECONDS, LONGEST_SECONDS = 20_000, 20, 400

MOD = """
local function around(pos) return {x = pos.x + math.random(-51, 51), y = pos.y + math.random(-8, 8),
                                   z = pos.z + math.random(-51, 51)} end
local built = false
minetest.register_on_joinplayer(function(player)
  minetest.set_timeofday(0.5)
  player:set_physics_override({gravity = 0, speed = 0, jump = 0})
  player:set_pos({x = 0, y = 40, z = 0})
  if player:get_player_name() == "first" then
    minetest.after(30, function()
      for _ = 1, EDITS do minetest.set_node(around({x = 0, y = 20, z = 0}), {name = "default:stonebrick"}) end
      minetest.log("action", "joining: built")
    end)
  end
  local yaw = 0
  local function turn()
    if not player:get_pos() then return end
    player:set_look_horizontal(yaw)
    player:set_look_vertical(0.2)
    yaw = yaw + math.pi / 4
    minetest.after(1, turn)
  end
  turn()
end)
"""

CONFIG = f"""
mg_name = v7
fixed_map_seed = 42
server_announce = false
enable_damage = false
creative_mode = true
time_speed = 0
enable_sound = false
screen_w = 320
screen_h = 240
fps_max = 20
fps_max_unfocused = 20
viewing_range = {16 * CHUNKS}
max_block_send_distance = {CHUNKS}
max_block_generate_distance = {CHUNKS}
max_simultaneous_block_sends_per_client = 400
client_mapblock_limit = -1
"""


class Proxy(threading.Thread):
    """Passes datagrams between a client and a server, and counts them."""

    def __init__(self, server_port):
        super().__init__(daemon=True)
        self.front, self.back = (socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2))
        self.front.bind(("127.0.0.1", 0))
        self.back.connect(("127.0.0.1", server_port))
        self.port = self.front.getsockname()[1]
        self.down = self.up = 0
        self.is_done = False

    def run(self):
        client = None
        while not self.is_done:
            for ready in select.select([self.front, self.back], [], [], 0.2)[0]:
                try:
                    if ready is self.front:
                        data, client = self.front.recvfrom(65536)
                        self.up += len(data)
                        self.back.send(data)
                    elif client:
                        data = self.back.recv(65536)
                        self.down += len(data)
                        self.front.sendto(data, client)
                except ConnectionRefusedError:
                    pass  # the server has not started yet

    def wait_until_quiet(self):
        """Waits until at most QUIET_BYTES arrive in QUIET_SECONDS; the bytes received before these seconds."""
        start, history = time.monotonic(), []
        while True:
            now = time.monotonic() - start
            history.append((now, self.down + self.up))
            before = [total for at, total in history if at <= now - QUIET_SECONDS]
            if now > LONGEST_SECONDS or (self.down > 0 and before and history[-1][1] - before[-1] < QUIET_BYTES):
                return before[-1] if before else history[-1][1]
            time.sleep(0.5)


def terrane(program, folder):
    server = Server(program, folder, 0)
    run = lambda *arguments: json.loads(subprocess.run(
        bots_command(program, server.port, *arguments), stdout=subprocess.PIPE, check=True, stderr=subprocess.DEVNULL).stdout)
    try:
        built = run("--count", "10", "--name", "builder", "--behaviour", "build", "--edits-per-second", "10", "--seconds",
                    str(EDITS / 100 + 3))
        visit = run("--count", "1", "--name", "visitor", "--builders", "0", "--view-distance", str(CHUNKS), "--seconds", "5")
    finally:
        server.stop()
    return {"program": "Terrane", "edits": built["edits"] - built["refused"], "kb": visit["joined_kb_median"]}


def visit_luanti(folder, name, port, program):
    proxy = Proxy(port)
    proxy.start()
    client = subprocess.Popen(
        ["xvfb-run", "-a", "-s", "-screen 0 320x240x24", program, "--go", "--address", "127.0.0.1", "--port",
         str(proxy.port), "--name", name, "--config", folder / "luanti.conf", "--logfile", folder / f"{name}.log"],
        env={"HOME": str(folder), "PATH": "/usr/games:/usr/bin:/bin", "LIBGL_ALWAYS_SOFTWARE": "1"},
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        if name == "first":
            time.sleep(60)  # the blocks are changed meanwhile
        total = proxy.wait_until_quiet()
    finally:
        subprocess.run(["pkill", "-g", str(client.pid)], check=False)
        client.wait(30)
    proxy.is_done = True
    proxy.join()
    return total / 1000


def luanti(folder, client, server_program):
    world = folder / "world"
    mod = world / "worldmods" / "joining"
    mod.mkdir(parents=True)
    (mod / "init.lua").write_text(MOD.replace("EDITS", str(EDITS)))
    (mod / "mod.conf").write_text("name = joining\n")
    (world / "world.mt").write_text("gameid = minetest\nbackend = sqlite3\nplayer_backend = sqlite3\nauth_backend = sqlite3\n")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    (folder / "luanti.conf").write_text(CONFIG + f"port = {port}\nbind_address = 127.0.0.1\n")
    server = subprocess.Popen(
        [server_program, "--world", world, "--gameid", "minetest", "--config", folder / "luanti.conf",
         "--logfile", folder / "server.log"], env={"HOME": str(folder)}, stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL)
    try:
        time.sleep(5)
        visit_luanti(folder, "first", port, client)
        kilobytes = visit_luanti(folder, "second", port, client)
    finally:
        server.terminate()
        server.wait(60)
    if "joining: built" not in (folder / "server.log").read_text():
        sys.exit("joining: Luanti's world was not changed")
    return {"program": "Luanti", "edits": EDITS, "kb": kilobytes}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--without-luanti", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="terrane-joining-") as name:
        folder = pathlib.Path(name)
        (folder / "terrane").mkdir()
        (folder / "luanti").mkdir()
        rows = [terrane(options.program.resolve(), folder / "terrane")]
        if not options.without_luanti:
            programs = [next(filter(shutil.which, names), None) for names in (CLIENTS, SERVERS)]
            if None in programs:
                sys.exit("joining: install minetest, minetest-server and xvfb, or say --without-luanti")
            rows.append(luanti(folder / "luanti", *programs))
    print("program\tedits\tkB")
    for row in rows:
        print(f"{row['program']}\t{row['edits']}\t{row['kb']:.1f}")


if __name__ == "__main__":
    main()
