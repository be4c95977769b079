# SPDX-License-Identifier: MIT
"""Films the screen of an Xvfb: keeps a PNG whenever what is seen, or the name of the step, has changed.

Usage: film_screen.py FRAME_BUFFER STEP_FILE FOLDER
  FRAME_BUFFER  the file Xvfb_screen0 in the folder of Xvfb's option -fbdir (an X window dump of 32 bits a pixel)
  STEP_FILE     holds the name of the step that is under way; the pictures are called by it
  FOLDER        where the pictures go, twice a second at most
Ends when it is told to by a signal."""

import struct
import sys
import time
import zlib
from pathlib import Path

INTERVAL = 0.5  # s


def read_screen(file: Path) -> tuple[int, int, bytes]:
    """Width, height, and the rows of RGB values."""
    dump = file.read_bytes()
    header = struct.unpack(">25I", dump[:100])
    size, width, height, row_length, colors = header[0], header[4], header[5], header[12], header[19]
    start = size + 12 * colors
    rows = []
    for y in range(height):
        row = dump[start + y * row_length : start + y * row_length + 4 * width]
        rgb = bytearray(3 * width)
        rgb[0::3], rgb[1::3], rgb[2::3] = row[2::4], row[1::4], row[0::4]  # stored blue first
        rows.append(bytes(rgb))
    return width, height, b"".join(rows)


def chunk(kind: bytes, content: bytes) -> bytes:
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))


def write_png(file: Path, width: int, height: int, rgb: bytes) -> None:
    rows = b"".join(b"\0" + rgb[3 * width * y : 3 * width * (y + 1)] for y in range(height))
    header = struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0)
    file.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 6)) + chunk(b"IEND", b"")
    )


def main() -> None:
    screen, step_file, folder = map(Path, sys.argv[1:])
    last, number = None, 0
    while True:
        step = step_file.read_text().strip() if step_file.exists() else "begin"
        try:
            width, height, rgb = read_screen(screen)
        except (OSError, struct.error):  # not there yet
            rgb = b""
        if rgb and (step, zlib.crc32(rgb)) != last:
            last = (step, zlib.crc32(rgb))
            write_png(folder / f"{number:03}_{step}.png", width, height, rgb)
            number += 1
        time.sleep(INTERVAL)


main()
