#!/usr/bin/env python3
"""Reads a chunk of a save by docs/file-format.md alone. Usage: read_save.py SAVE.sqlite CX CY [OUT.bin [LEVEL]]

Prints how many blocks of each type the chunk has; OUT.bin ("": none) gets the blocks as u16, in the order of
x + 16 y + 256 z. Reads formats 1 to 3. Debian: apt-get install python3-zstandard python3-xxhash
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


def unpack(data, seed):
    checksum, version, length = struct.unpack_from("<QBI", data)
    if xxhash.xxh64_intdigest(data[8:], seed) != checksum or version != 1:
        raise ValueError("the checksum is wrong, or the version unknown")
    return zstandard.ZstdDecompressor().decompress(data[13:], max_output_size=length)


def read_blocks(content):
    """Ids of the save. All heads come first, 16 of blocks and 16 of block state: bits a block and the palette."""
    heads, blocks, at = [], [], 0
    for _ in range(32):
        bits = content[at]
        count = struct.unpack_from("<H", content, at + 1)[0] if 0 < bits < 16 else int(bits == 0)
        at += 3 if 0 < bits < 16 else 1
        heads.append((bits, struct.unpack_from(f"<{count}H", content, at)))
        at += 2 * count
    for bits, palette in heads[:16]:
        body = content[at:at + SECTION * bits // 8]
        at += len(body)
        blocks.extend(palette * SECTION if bits == 0 else struct.unpack(f"<{SECTION}H", body) if bits == 16 else
                      [palette[byte >> shift & (1 << bits) - 1] for byte in body for shift in range(0, 8, bits)])
    return blocks


def main(path, cx, cy, out="", level="0"):
    save = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
    file_format = save.execute("PRAGMA user_version").fetchone()[0]
    if file_format not in (1, 2, 3):
        sys.exit(f"{path}: no save of format 1 to 3")
    names = dict(save.execute("SELECT id, name FROM blocks"))
    if file_format == 3:
        check_names(names, dict(save.execute("SELECT name, value FROM settings")))
    key = (int(level) << 56) + (int(cx) + 2**27 << 28) + int(cy) + 2**27
    row = save.execute("SELECT data, origin FROM chunks WHERE key = ?", [key]).fetchone()
    if not row:
        sys.exit(f"{path}: chunk {cx},{cy} of level {level} was not saved")
    blocks = read_blocks(unpack(row[0], 2 * key + row[1] if file_format == 3 else 0))
    print(*(f"{count} {names[block]}" for block, count in collections.Counter(blocks).most_common()), sep="\n")
    if out:
        with open(out, "wb") as file:
            file.write(struct.pack(f"<{len(blocks)}H", *blocks))


if __name__ == "__main__":
    try:
        main(*sys.argv[1:]) if len(sys.argv) in (4, 5, 6) else sys.exit(__doc__)
    except (KeyError, ValueError, sqlite3.Error) as error:
        sys.exit(f"{sys.argv[1]}: {error}")
