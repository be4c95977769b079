# SPDX-License-Identifier: MIT
"""A small repository whose addon has a library of every platform: heads of real formats around the entry's name."""

import struct
import sys
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "lib"))

from addon_files import ADDON, ENTRY, LIBRARIES, keys_of, library_name  # noqa: E402

ENTRY_BYTES = b"\0" + ENTRY.encode() + b"\0"
CPUS = {"x86_64": 0x01000007, "arm64": 0x0100000C}


def elf(machine):
    return b"\x7fELF\x02\x01\x01".ljust(16, b"\0") + struct.pack("<HH", 3, machine) + bytes(44) + ENTRY_BYTES


def pe(machine, flags=0x2000):
    return b"MZ".ljust(0x3C, b"\0") + struct.pack("<I", 0x80) + bytes(0x40) + b"PE\0\0" + struct.pack("<HHIIIHH", machine, 0, 0, 0, 0, 0, flags) + ENTRY_BYTES


def mach(cpu, signed=True):
    commands = struct.pack("<IIII", 0x1D if signed else 0x2, 16, 0, 0)
    return struct.pack("<IiiIIIII", 0xFEEDFACF, cpu, 0, 6, 1, len(commands), 0, 0) + commands + ENTRY_BYTES


def universal(signed=("x86_64", "arm64"), cpus=("x86_64", "arm64")):
    slices = [(CPUS[name], mach(CPUS[name], name in signed)) for name in cpus]
    head, body, at = struct.pack(">II", 0xCAFEBABE, len(slices)), b"", 8 + 20 * len(slices)
    for cpu, content in slices:
        head += struct.pack(">5I", cpu, 0, at + len(body), len(content), 0)
        body += content
    return head + body


def png(width, height):
    def chunk(name, content):
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))

    rows = zlib.compress((b"\0" + bytes(width)) * height)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) + chunk(b"IDAT", rows) + chunk(b"IEND", b"")


def library(key):
    """What the checker takes for the library of a key of the `.gdextension`."""
    system, arch = key.split(".")[0], key.split(".")[-1]
    if system == "macos":
        return universal()
    if system == "web":
        return b"\0asm\1\0\0\0" + ENTRY_BYTES
    if system == "windows":
        return pe(0x8664)
    return elf({"x86_64": 62, "arm64": 183}[arch])


def write(repository, version="0.1.0", changelog="## [Unreleased]\n\n- A change.\n"):
    """Makes the repository in that folder: the real addon's text files, and libraries of all platforms."""
    for path in (ROOT / ADDON).rglob("*"):
        place = path.relative_to(ROOT)
        if path.is_file() and place.parent.as_posix() != str(LIBRARIES):
            (repository / place).parent.mkdir(parents=True, exist_ok=True)
            (repository / place).write_bytes(path.read_bytes())
    plugin = repository / ADDON / "plugin.cfg"
    lines = [f'version="{version}"' if line.startswith("version=") else line for line in plugin.read_text().splitlines()]
    plugin.write_text("\n".join(lines) + "\n")
    (repository / LIBRARIES).mkdir(parents=True, exist_ok=True)
    for key in keys_of():
        (repository / LIBRARIES / library_name(key)).write_bytes(library(key))
    (repository / "docs").mkdir(exist_ok=True)
    (repository / "docs" / "manual.md").write_text("# Manual\n\n![A body](pictures/body.png), of [a script](../scripts/body.py).\n")
    (repository / "docs" / "pictures").mkdir(exist_ok=True)
    (repository / "docs" / "pictures" / "body.png").write_bytes(png(4, 4))
    (repository / "CHANGELOG.md").write_text("# Changelog\n\n" + changelog)
    (repository / "README.md").write_text(f"# SoftBody2D\n\nFor Godot 4.3 and later: unpack soft_body_2d-{version}.zip.\n")
    (repository / "SConstruct").write_text('env = Environment(api_version="4.3")\n')
