# SPDX-License-Identifier: MIT
"""Writes every GDScript example of the documentation as a script that can be run, and checks the links between pages.

Usage: snippets.py REPOSITORY FOLDER
An example that says what it extends is a script as it stands. Any other one becomes the `_ready` of a Node2D that knows the
nodes `jelly`, `other` and `crate`. The first of the README is also written as `first.gd`: what a newcomer types."""

import re
import sys
from pathlib import Path

from markdown import linked_files

BLOCK = re.compile(r"^```gdscript\n(.*?)^```", re.MULTILINE | re.DOTALL)
HEAD = "extends Node2D\nvar jelly: SoftBody2D\nvar other: SoftBody2D\nvar crate: StaticBody2D\n\nfunc _ready() -> void:\n"


def as_script(code):
    """The example as a whole script."""
    if code.startswith("extends "):
        return code
    return HEAD + "".join("\t" + line if line.strip() else line for line in code.splitlines(keepends=True))


def main():
    repository, folder = Path(sys.argv[1]), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    pages = [repository / "README.md", repository / "addons/soft_body_2d/README.md", *sorted((repository / "docs").glob("*.md"))]
    dead = []
    for page in pages:
        text = page.read_text(encoding="utf-8")
        name = page.relative_to(repository).with_suffix("").as_posix().replace("/", "_").lower()
        for number, code in enumerate(BLOCK.findall(text), 1):
            (folder / f"{name}_{number}.gd").write_text(as_script(code), encoding="utf-8")
            if name == "readme" and number == 1:
                (folder / "first.gd").write_text(code, encoding="utf-8")
        for link in linked_files(text):
            if not (page.parent / link).exists():
                dead.append(f"{page.relative_to(repository)} links {link}, which is not there")
    if dead:
        sys.exit("\n".join(dead))


main()
