#!/usr/bin/env python3
"""Writes a C++ file that holds other files as bytes.

Usage: embed_files.py OUT.cpp FUNCTION virtual/path=real/file …
The C++ file defines terrane::embedded::FUNCTION(), declared beside its use; see terrane/base/files.h.
"""
import pathlib
import sys


def main() -> None:
    out, function, *entries = sys.argv[1:]
    lines = ['#include "terrane/base/files.h"', "", "#include <array>", "", "namespace terrane::embedded {", "namespace {"]
    table = []
    for number, entry in enumerate(entries):
        virtual, _, real = entry.partition("=")
        data = pathlib.Path(real).read_bytes()
        values = ",".join(str(byte) for byte in data)
        lines.append(f"constexpr unsigned char kData{number}[] = {{{values or '0'}}};")
        table.append(f'    {{"{virtual}", {{reinterpret_cast<const char*>(kData{number}), {len(data)}}}}},')
    lines += [f"const std::array<base::EmbeddedFile, {len(table)}> kFiles = {{{{", *table, "}};", "}  // namespace", ""]
    lines += [f"std::span<const base::EmbeddedFile> {function}() {{ return kFiles; }}", ""]
    lines += ["}  // namespace terrane::embedded", ""]
    path = pathlib.Path(out)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(lines))


if __name__ == "__main__":
    main()
