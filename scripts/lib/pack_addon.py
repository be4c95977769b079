# SPDX-License-Identifier: MIT
"""Packs what users install: the addon with its license, its manual and the libraries that have been built.

Usage: pack_addon.py REPOSITORY OUTPUT.zip
Below `addons/soft_body_2d`, as Godot's asset library wants it. The same files make the same bytes."""

import sys
import zipfile
from pathlib import Path, PurePosixPath

from markdown import linked_files

ADDON = PurePosixPath("addons/soft_body_2d")
# Of the documentation, what is about using the addon.
MANUAL = ("cookbook.md", "manual.md", "editor.md", "performance.md", "troubleshooting.md", "limits.md", "accuracy.md")
LONG_AGO = (1980, 1, 1, 0, 0, 0)


def packed_files(repository):
    """Where each file of the archive comes from, by its place there."""
    files = {}
    for path in sorted((repository / ADDON).rglob("*")):
        if path.is_file():
            files[PurePosixPath(path.relative_to(repository).as_posix())] = path
    files[ADDON / "CHANGELOG.md"] = repository / "CHANGELOG.md"
    for page in MANUAL:
        source = repository / "docs" / page
        if not source.is_file():
            continue
        files[ADDON / "docs" / page] = source
        for link in linked_files(source.read_text(encoding="utf-8")):
            if not link.endswith(".md"):
                files[ADDON / "docs" / link] = source.parent / link
    return files


def main():
    repository, output = Path(sys.argv[1]), Path(sys.argv[2])
    files = packed_files(repository)
    missing = [str(source) for source in files.values() if not source.is_file()]
    if missing:
        sys.exit("the manual links what is not there: " + ", ".join(missing))
    for needed in ("LICENSE", "README.md", "plugin.cfg", "soft_body_2d.gdextension"):
        if ADDON / needed not in files:
            sys.exit(f"the addon has no {needed}")
    if not any(name.parts[2] == "bin" for name in files):
        sys.exit("the addon has no libraries: build it first, with scripts/build.sh")
    output.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(output, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, source in sorted(files.items()):
            entry = zipfile.ZipInfo(str(name), LONG_AGO)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o755 if name.suffix == ".so" else 0o644) << 16
            archive.writestr(entry, source.read_bytes())
    print(f"{output} ({len(files)} files, {output.stat().st_size / 1e6:.1f} MB)")


main()
