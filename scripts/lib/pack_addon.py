# SPDX-License-Identifier: MIT
"""Packs what users install: the addon with its license, its manual and its libraries.

Usage: pack_addon.py [--partial] REPOSITORY FOLDER
Makes FOLDER/soft_body_2d-VERSION.zip and prints its path. Below `addons/soft_body_2d`, as Godot's asset store wants it. The same files make the same bytes. Every library that the
`.gdextension` lists must have been built; with --partial the platforms are packed of which debug and release were built, and the
packed `.gdextension` lists these alone; the name then ends with -partial.zip."""

import argparse
import re
import sys
import zipfile
from pathlib import Path, PurePosixPath

from addon_files import ADDON, EXTENSION, LIBRARIES, counterpart, only_listed, sections_of
from markdown import linked_files

# Of the documentation, what is about using the addon.
MANUAL = ("cookbook.md", "manual.md", "editor.md", "performance.md", "troubleshooting.md", "limits.md", "accuracy.md", "csharp.md")
LONG_AGO = (1980, 1, 1, 0, 0, 0)


def packed_files(repository):
    """Where each file of the archive comes from, by its place there. Of the libraries, those that are listed."""
    files = {}
    listed = {path.rpartition("/")[2] for _, path in sections_of((repository / EXTENSION).read_text()).get("libraries", [])}
    for path in sorted((repository / ADDON).rglob("*")):
        place = PurePosixPath(path.relative_to(repository).as_posix())
        if path.is_file() and (place.parent != LIBRARIES or place.name in listed):
            files[place] = path
    files[ADDON / "CHANGELOG.md"] = repository / "CHANGELOG.md"
    for page in MANUAL:
        source = repository / "docs" / page
        if not source.is_file():
            continue
        files[ADDON / "docs" / page] = source
        for link in linked_files(source.read_text(encoding="utf-8")):
            if not link.endswith(".md") and (source.parent / link).suffix in (".webp", ".png", ".svg"):
                files[ADDON / "docs" / link] = source.parent / link
    return files


def version_of(repository):
    found = re.search(r'^version="([^"]+)"$', (repository / ADDON / "plugin.cfg").read_text(encoding="utf-8"), re.MULTILINE)
    return found[1] if found else sys.exit(f"{ADDON / 'plugin.cfg'} names no version")


def pack(repository, folder, partial=False):
    """Writes the archive. Returns its path, and the names of the libraries that are listed and have not been built."""
    files = packed_files(repository)
    missing = [str(source) for source in files.values() if not source.is_file()]
    if missing:
        sys.exit("the manual links what is not there: " + ", ".join(missing))
    extension = (repository / EXTENSION).read_text(encoding="utf-8")
    listed = {key: path.rpartition("/")[2] for key, path in sections_of(extension).get("libraries", [])}
    built = [key for key, name in listed.items() if LIBRARIES / name in files]
    absent = [name for key, name in listed.items() if key not in built or counterpart(key) not in built]
    if len(absent) == len(listed):
        sys.exit("the addon has no platform with a debug and a release library: build both, with scripts/build.sh")
    if absent and not partial:
        sys.exit(f"{EXTENSION} lists libraries that have not been built: {', '.join(absent)}. Build them, or pack with --partial")
    contents = {name: source.read_bytes() for name, source in files.items() if name.parent != LIBRARIES or name.name not in absent}
    contents[ADDON / "docs" / ".gdignore"] = b""  # else Godot imports the pictures, and complains of those that move
    if absent:
        contents[EXTENSION] = only_listed(extension, set(listed.values()) - set(absent)).encode()
    output = folder / f"soft_body_2d-{version_of(repository)}{'-partial' if absent else ''}.zip"
    folder.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(output, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in sorted(contents.items()):
            entry = zipfile.ZipInfo(str(name), LONG_AGO)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o755 if name.suffix in (".so", ".dylib") else 0o644) << 16
            archive.writestr(entry, content)
    return output, absent


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--partial", action="store_true")
    parser.add_argument("repository", type=Path)
    parser.add_argument("folder", type=Path)
    options = parser.parse_args()
    output, absent = pack(options.repository, options.folder, options.partial)
    print(f"{output.stat().st_size / 1e6:.1f} MB" + (f", without {', '.join(absent)}" if absent else ""), file=sys.stderr)
    print(output)


if __name__ == "__main__":
    main()
