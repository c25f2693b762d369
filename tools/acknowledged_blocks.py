"""Blocks that servers acknowledged to bots (`terrane bots --acknowledged FILE`), compared with those of a saved world."""
import json
import subprocess

CHUNK = 16


def read_kept(*files):
    """Position to the name of the block, of the last file that has it; undecided ones ("?") are left out."""
    blocks = {}
    for file in files:
        for line in file.read_text(encoding="utf-8").splitlines():
            x, y, z, name = line.split()
            blocks[int(x), int(y), int(z)] = name
    return {pos: name for pos, name in blocks.items() if name != "?"}


def read_world(program, world, positions, folder):
    """Position to the name of the block in a world, a file or a URL."""
    chunks = [(x // CHUNK, y // CHUNK) for x, y, _ in positions]
    x0, y0 = min(x for x, _ in chunks), min(y for _, y in chunks)
    x1, y1 = max(x for x, _ in chunks) + 1, max(y for _, y in chunks) + 1
    file = folder / "blocks.npy"
    subprocess.run([program, "dump", "--what", "blocks", "--world", world, f"--area={x0},{y0},{x1},{y1}", "-o", file],
                   check=True, stdout=subprocess.DEVNULL)
    # An exit code of 1 tells of damage.
    checked = subprocess.run([program, "check", world, "--json"], check=False, stdout=subprocess.PIPE).stdout
    bottom = json.loads(checked)["bottom"]
    types = json.loads(subprocess.run([program, "blocks", "--json"], check=True, stdout=subprocess.PIPE).stdout)
    names = {block["id"]: block["name"] for block in types}
    data = file.read_bytes()
    ids = memoryview(data)[10 + int.from_bytes(data[8:10], "little"):].cast("H")  # [x][y][z]
    width, depth = (x1 - x0) * CHUNK, (y1 - y0) * CHUNK
    height = len(ids) // (width * depth)
    return {(x, y, z): names[ids[((x - x0 * CHUNK) * depth + y - y0 * CHUNK) * height + z - bottom]]
            for x, y, z in positions}


def lost_blocks(program, world, kept, folder):
    """A line for each block that is not there. Bots build with stone; where they removed it, water or sand may be."""
    there = read_world(program, world, kept, folder)
    return [f"{x} {y} {z}: {name} became {there[x, y, z]}" for (x, y, z), name in kept.items()
            if (there[x, y, z] == "stone") != (name == "stone")]
