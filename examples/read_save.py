#!/usr/bin/env python3
"""Reads a chunk of a save by docs/file-format.md alone. Usage: read_save.py SAVE.sqlite CX CY [OUT.bin [LEVEL]]

Prints how many blocks of each type the chunk has; OUT.bin ("": none) gets the blocks as u16, in the order of
x + 16 y + 256 z, from the bottom of the world. Reads formats 1 to 4. Debian: apt-get install python3-zstandard python3-xxhash
"""
import collections
import functools
import operator
import sqlite3
import struct
import sys

import xxhash
import zstandard

SECTION = 16 * 16 * 16


def check_names(names, settings):
    """Compares the checksum of settings and block names: the exclusive or of a hash of each row."""
    rows = [xxhash.xxh64_intdigest(f"{name}\0{value}") for name, value in settings.items() if name != "checksum"]
    rows += [xxhash.xxh64_intdigest(name, 1 + number) for number, name in names.items()]
    if settings["checksum"] not in ("", str(functools.reduce(operator.xor, rows))):
        raise ValueError("the checksum of settings and names is wrong")


def unpack(data, seed, wanted):
    checksum, version, length = struct.unpack_from("<QBI", data)
    if xxhash.xxh64_intdigest(data[8:], seed) != checksum or version != wanted:
        raise ValueError("the checksum is wrong, or the version unknown")
    return zstandard.ZstdDecompressor().decompress(data[13:], max_output_size=length)


def read_head(content, at):
    """Bits a block, the palette, and where the head ends."""
    bits = content[at]
    count = struct.unpack_from("<H", content, at + 1)[0] if 0 < bits < 16 else int(bits == 0)
    at += 3 if 0 < bits < 16 else 1
    return bits, struct.unpack_from(f"<{count}H", content, at), at + 2 * count


def read_blocks(content, heights):
    """Ids of the save. All heads come first, those of blocks and those of block state; format 4 has them in runs."""
    parts, blocks, at = [], [], 0
    sections = 16
    if heights:
        if struct.unpack_from("<hh", content) != heights:
            raise ValueError("the chunk has other heights than the world")
        sections, at = (heights[1] - heights[0]) // 16, 4
    for _ in range(2):
        runs = []
        while sum(count for count, _, _ in runs) < sections:
            count = content[at] + 1 if heights else 1
            bits, palette, at = read_head(content, at + bool(heights))
            runs.append((count, bits, palette))
        parts.append(runs)
    for count, bits, palette in parts[0]:
        body = content[at:at + SECTION * bits // 8]
        at += len(body)
        blocks.extend(palette * SECTION * count if bits == 0 else
                      struct.unpack(f"<{SECTION}H", body) if bits == 16 else
                      [palette[byte >> shift & (1 << bits) - 1] for byte in body for shift in range(0, 8, bits)])
    return blocks


def main(path, cx, cy, out="", level="0"):
    save = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
    file_format = save.execute("PRAGMA user_version").fetchone()[0]
    if file_format not in (1, 2, 3, 4):
        sys.exit(f"{path}: no save of format 1 to 4")
    names = dict(save.execute("SELECT id, name FROM blocks"))
    settings = dict(save.execute("SELECT name, value FROM settings"))
    if file_format >= 3:
        check_names(names, settings)
    heights = (int(settings["bottom"]), int(settings["top"])) if file_format == 4 else None
    key = (int(level) << 56) + (int(cx) + 2**27 << 28) + int(cy) + 2**27
    row = save.execute("SELECT data, origin FROM chunks WHERE key = ?", [key]).fetchone()
    if not row:
        sys.exit(f"{path}: chunk {cx},{cy} of level {level} was not saved")
    seed = 2 * key + row[1] if file_format >= 3 else 0
    blocks = read_blocks(unpack(row[0], seed, 2 if heights else 1), heights)
    print(*(f"{count} {names[block]}" for block, count in collections.Counter(blocks).most_common()), sep="\n")
    if out:
        with open(out, "wb") as file:
            file.write(struct.pack(f"<{len(blocks)}H", *blocks))


if __name__ == "__main__":
    try:
        main(*sys.argv[1:]) if len(sys.argv) in (4, 5, 6) else sys.exit(__doc__)
    except (KeyError, ValueError, sqlite3.Error) as error:
        sys.exit(f"{sys.argv[1]}: {error}")
