#!/usr/bin/env python3
"""Reads a chunk of a save by docs/file-format.md alone. Usage: read_save.py SAVE.sqlite CX CY [OUT.bin [LEVEL]]

Prints how many blocks of each type the chunk has; OUT.bin gets the blocks as u16, in the order of x + 16 y + 256 z.
Reads formats 1 and 2. "" as OUT.bin: none.
Debian: apt-get install python3-zstandard python3-xxhash
"""
import collections
import sqlite3
import struct
import sys

import xxhash
import zstandard

SECTION = 16 * 16 * 16


def unpack(data):
    """The content of chunk data: its checksum, version and length are checked."""
    checksum, version, length = struct.unpack_from("<QBI", data)
    if xxhash.xxh64_intdigest(data[8:]) != checksum:
        raise ValueError("the checksum is wrong")
    if version != 1:
        raise ValueError(f"version {version} of chunk data is unknown")
    return zstandard.ZstdDecompressor().decompress(data[13:], max_output_size=length)


def read_head(content, at):
    """Bits a block, the palette (or the one value), and where the next head is."""
    bits = content[at]
    if bits == 16:
        return bits, None, at + 1
    count = 1 if bits == 0 else struct.unpack_from("<H", content, at + 1)[0]
    first = at + (1 if bits == 0 else 3)
    return bits, struct.unpack_from(f"<{count}H", content, first), first + 2 * count


def read_body(content, at, bits, palette):
    """4096 values, and where the next body is."""
    if bits == 0:
        return palette * SECTION, at
    if bits == 16:
        return struct.unpack_from(f"<{SECTION}H", content, at), at + 2 * SECTION
    end, mask = at + SECTION * bits // 8, (1 << bits) - 1
    return [palette[byte >> shift & mask] for byte in content[at:end] for shift in range(0, 8, bits)], end


def read_blocks(content):
    """Ids of the save, x + 16 y + 256 z."""
    heads, at = [], 0
    for _ in range(32):  # 16 sections of blocks, then 16 of small data
        bits, palette, at = read_head(content, at)
        heads.append((bits, palette))
    blocks = []
    for bits, palette in heads[:16]:
        values, at = read_body(content, at, bits, palette)
        blocks.extend(values)
    return blocks


def main(path, cx, cy, out=None, level=0):
    save = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
    marks = [save.execute(f"PRAGMA {name}").fetchone()[0] for name in ("application_id", "user_version")]
    if marks not in ([0x5445524E, 1], [0x5445524E, 2]):
        sys.exit(f"{path}: no save of format 1 or 2")
    names = dict(save.execute("SELECT id, name FROM blocks"))
    key = (int(level) << 56) + (cx + 2**27 << 28) + cy + 2**27
    row = save.execute("SELECT data FROM chunks WHERE key = ?", [key]).fetchone()
    if row is None:
        sys.exit(f"{path}: chunk {cx},{cy} of level {level} was not saved")
    blocks = read_blocks(unpack(row[0]))
    for block, count in collections.Counter(blocks).most_common():
        print(count, names[block])
    if out:
        with open(out, "wb") as file:
            file.write(struct.pack(f"<{len(blocks)}H", *blocks))


if __name__ == "__main__":
    if len(sys.argv) not in (4, 5, 6):
        sys.exit(__doc__)
    try:
        main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), *sys.argv[4:])
    except (ValueError, sqlite3.Error) as error:
        sys.exit(f"{sys.argv[1]}: {error}")
