# SPDX-License-Identifier: MIT
"""Joins numbered PNG files into one animated WebP.

Usage: animate.py FOLDER OUTPUT.webp FRAMES_PER_SECOND WIDTH FIRST_FRAME"""

import sys
from pathlib import Path

from PIL import Image


def main():
    folder, output, rate, width, first = Path(sys.argv[1]), Path(sys.argv[2]), *map(int, sys.argv[3:6])
    frames = []
    for file in sorted(folder.glob("*.png"))[first:]:
        with Image.open(file) as image:
            height = round(image.height * width / image.width)
            frames.append(image.convert("RGB").resize((width, height), Image.Resampling.LANCZOS))
    if not frames:
        sys.exit(f"no pictures in {folder} from number {first} on")
    ends = [round(1000 * (i + 1) / rate) for i in range(len(frames))]  # ms, whole ones in the file
    durations = [end - begin for begin, end in zip([0, *ends], ends)]
    frames[0].save(output, save_all=True, append_images=frames[1:], duration=durations, loop=0, quality=60, method=4)
    print(f"{output} ({len(frames)} frames, {output.stat().st_size / 1000:.0f} kB)")


main()
