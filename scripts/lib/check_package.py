# SPDX-License-Identifier: MIT
"""Judges a package before it goes out: whether it would install, and holds what users install and nothing else.

Usage: check_package.py [--partial] PACKAGE.zip
Prints every fault with its remedy, then "N passed, N failed", and fails if there is a fault. With --partial a package may lack
platforms of a release; what it lists must be there all the same."""

import argparse
import re
import sys
import zipfile
from pathlib import Path, PurePosixPath

from addon_files import ADDON, ENTRY, EXTENSION, LIBRARIES, counterpart, keys_of, library_name, sections_of
from binaries import fault_of_library

# Ours, below the 100 MB that hosts of repositories take in one file without complaint.
LARGEST_PACKAGE = 64_000_000
SMALLEST_ICON = 128
NEEDED = ("plugin.cfg", "soft_body_2d.gdextension", "soft_body_2d_plugin.gd", "LICENSE", "README.md", "CHANGELOG.md", "icon.png")
# What users have a use for. All else, sources of the library above all, has no place in their projects.
ENDINGS = {".gd", ".uid", ".cs", ".cfg", ".gdextension", ".tres", ".tscn", ".svg", ".png", ".webp", ".import", ".md"}
OTHERS = {"LICENSE", ".gdignore"}
LEAST_LICENSE = 500  # characters


class Package:
    """The files of an archive below the addon's folder, and the faults that were found."""

    def __init__(self, archive, path):
        self.archive = archive
        self.path = path
        self.names = [info.filename for info in archive.infolist() if not info.is_dir()]
        self.faults = []

    def fault(self, text):
        self.faults.append(text)

    def read(self, place):
        """The bytes of a file, or None."""
        return self.archive.read(str(place)) if str(place) in self.names else None

    def text(self, place):
        return (self.read(place) or b"").decode("utf-8", "replace")


def check_places(package):
    """Every file lies in the addon's folder, once, under a name that every system takes."""
    seen = {}
    for info in package.archive.infolist():
        name = info.filename
        path = PurePosixPath(name)
        if name.startswith("/") or "\\" in name or ".." in path.parts or path.parts[:2] != ADDON.parts:
            package.fault(f"{name} lies outside of {ADDON}: pack it below that folder")
        if (info.external_attr >> 16) & 0o170000 == 0o120000:
            package.fault(f"{name} is a link, which not every system unpacks: pack the file itself")
        if (before := seen.setdefault(name.lower(), name)) != name or package.names.count(name) > 1:
            package.fault(f"{name} and {before} are one file on Windows: rename one")


def check_contents(package):
    """What users need is there; what they have no use for is not."""
    for name in NEEDED:
        if not package.read(ADDON / name):
            package.fault(f"{ADDON / name} is missing or empty")
    if package.read(ADDON / "LICENSE") and len(package.text(ADDON / "LICENSE")) < LEAST_LICENSE:
        package.fault(f"{ADDON / 'LICENSE'} is no license: it has fewer than {LEAST_LICENSE} characters")
    for name in package.names:
        path = PurePosixPath(name)
        if path.parent != LIBRARIES and path.suffix not in ENDINGS and path.name not in OTHERS:
            package.fault(f"{name} is nothing that users install: leave it out")


def check_icon(package):
    """The store shows a square picture of at least 128 by 128 pixels."""
    icon = package.read(ADDON / "icon.png")
    if not icon:
        return
    if icon[:8] != b"\x89PNG\r\n\x1a\n" or icon[12:16] != b"IHDR":
        package.fault("icon.png is no PNG")
        return
    width, height = (int.from_bytes(icon[at:at + 4], "big") for at in (16, 20))
    if width != height or width < SMALLEST_ICON:
        package.fault(f"icon.png is {width} by {height} pixels: it must be square, and {SMALLEST_ICON} at least")


def check_libraries(package, partial):
    """The `.gdextension` lists the libraries that are packed, under the names of the build, and no others; each is what its name says."""
    text = package.text(EXTENSION)
    if not text:
        return
    sections = sections_of(text)
    configuration = dict(sections.get("configuration", []))
    if configuration.get("entry_symbol") != ENTRY:
        package.fault(f"{EXTENSION}: entry_symbol is {configuration.get('entry_symbol')}, and the libraries have {ENTRY}")
    if not re.fullmatch(r"4\.\d+", configuration.get("compatibility_minimum", "")):
        package.fault(f"{EXTENSION}: compatibility_minimum is missing, or no version of Godot 4")
    entries = sections.get("libraries", [])
    keys = [key for key, _ in entries]
    for key in sorted({key for key in keys if keys.count(key) > 1}):
        package.fault(f"{EXTENSION} lists {key} twice")
    if missing := [key for key in keys_of() if key not in keys]:
        if not partial:
            package.fault(f"{EXTENSION} does not list {', '.join(missing)}: a release has every platform")
        elif not keys:
            package.fault(f"{EXTENSION} lists no library")
    for key, place in entries:
        name = library_name(key)
        if key not in keys_of():
            package.fault(f"{EXTENSION} lists {key}, which is no platform of a release")
        elif place != f"res://{LIBRARIES / name}":
            package.fault(f"{EXTENSION}: {key} is {place}, and the build calls it res://{LIBRARIES / name}")
        elif str(LIBRARIES / name) not in package.names:
            package.fault(f"{EXTENSION} lists {name}, which is not in the package: build it")
        elif fault := fault_of_library(package.read(LIBRARIES / name), key):
            package.fault(f"{name} {fault}")
        if counterpart(key) not in keys:
            package.fault(f"{EXTENSION} lists {key} and not {counterpart(key)}: an editor loads the one, an exported game the other")
    listed = {place for _, place in entries}
    for name in package.names:
        if PurePosixPath(name).parent == LIBRARIES and f"res://{name}" not in listed:
            package.fault(f"{name} is not listed in {EXTENSION}: list it, or leave it out")
    for key, place in sections.get("icons", []):
        if place.removeprefix("res://") not in package.names:
            package.fault(f"{EXTENSION}: the icon of {key}, {place}, is not in the package")


def check_version(package):
    """The package is called by the version that the editor shows."""
    found = re.search(r'^version="([^"]+)"$', package.text(ADDON / "plugin.cfg"), re.MULTILINE)
    if not found:
        package.fault(f"{ADDON / 'plugin.cfg'} names no version")
    elif package.path.name not in (f"soft_body_2d-{found[1]}.zip", f"soft_body_2d-{found[1]}-partial.zip"):
        package.fault(f"{package.path.name} holds version {found[1]}: call it soft_body_2d-{found[1]}.zip")
    script = re.search(r'^script="([^"]+)"$', package.text(ADDON / "plugin.cfg"), re.MULTILINE)
    if script and str(ADDON / script[1]) not in package.names:
        package.fault(f"{ADDON / 'plugin.cfg'} names the script {script[1]}, which is not in the package")


def check(path, partial=False):
    """The faults of the package at that path. None, and it may go out."""
    size = path.stat().st_size
    if not zipfile.is_zipfile(path):
        return [f"{path.name} is no zip archive"]
    with zipfile.ZipFile(path) as archive:
        package = Package(archive, path)
        if size > LARGEST_PACKAGE:
            package.fault(f"{path.name} has {size / 1e6:.1f} MB: {LARGEST_PACKAGE / 1e6:.0f} at most")
        if damaged := archive.testzip():
            package.fault(f"{damaged} does not unpack: its checksum differs")
            return package.faults
        for judge in (check_places, check_contents, check_icon, check_version):
            judge(package)
        check_libraries(package, partial)
        return package.faults


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--partial", action="store_true")
    parser.add_argument("package", type=Path)
    options = parser.parse_args()
    faults = check(options.package, options.partial)
    for fault in faults:
        print(f"error: {fault}", file=sys.stderr)
    print(f"{int(not faults)} passed, {len(faults)} failed")
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
