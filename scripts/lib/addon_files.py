# SPDX-License-Identifier: MIT
"""Which files the addon consists of, and what its libraries are called."""

import re
from pathlib import PurePosixPath

ADDON = PurePosixPath("addons/soft_body_2d")
EXTENSION = ADDON / "soft_body_2d.gdextension"
LIBRARIES = ADDON / "bin"
ENTRY = "soft_body_2d_library_init"
ENDINGS = {"linux": ".so", "android": ".so", "windows": ".dll", "macos": ".dylib", "web": ".wasm"}

# The platforms of a release, as the `.gdextension` names them. Each has a debug and a release library.
PLATFORMS = ("linux.x86_64", "linux.arm64", "windows.x86_64", "macos", "android.arm64", "android.x86_64", "web.threads.wasm32",
             "web.wasm32")


def keys_of(platforms=PLATFORMS):
    """The keys of the `.gdextension` for these platforms: linux.debug.x86_64 for linux.x86_64."""
    keys = []
    for platform in platforms:
        system, _, rest = platform.partition(".")
        keys += [".".join(filter(None, (system, build, rest))) for build in ("debug", "release")]
    return keys


def library_name(key):
    """The name that the build gives to the library of a key: web.debug.threads.wasm32 is libsoft_body_2d.web.template_debug.wasm32.wasm.
    None for a key that names no platform of ours."""
    system, build, *rest = key.split(".") + [""]
    rest = [part for part in rest if part]
    if system not in ENDINGS or build not in ("debug", "release"):
        return None
    threads = "threads" in rest
    arch = [part for part in rest if part != "threads"] or ["universal"]
    nothreads = ".nothreads" if system == "web" and not threads else ""
    return f"libsoft_body_2d.{system}.template_{build}.{'.'.join(arch)}{nothreads}{ENDINGS[system]}"


def counterpart(key):
    """The release key of a debug key, and the other way round."""
    return key.replace(".debug", ".release") if ".debug" in key else key.replace(".release", ".debug")


def sections_of(text):
    """The entries of a `.gdextension`, by section and key, with the quotes taken off. A key that stands twice is kept twice."""
    sections, section = {}, None
    for line in text.splitlines():
        if head := re.fullmatch(r"\[(\w+)\]\s*", line):
            section = sections.setdefault(head[1], [])
        elif (entry := re.fullmatch(r'\s*([\w.]+)\s*=\s*"?([^"]*)"?\s*', line)) and section is not None:
            section.append((entry[1], entry[2]))
    return sections


def only_listed(text, names):
    """The text of a `.gdextension` with the libraries of these names alone."""
    kept, in_libraries = [], False
    for line in text.splitlines():
        if line.startswith("["):
            in_libraries = line.strip() == "[libraries]"
        if in_libraries and "=" in line and line.rpartition("/")[2].rstrip('" ') not in names:
            continue
        if line or (kept and kept[-1]):
            kept.append(line)
    return "\n".join(kept).rstrip("\n") + "\n"
