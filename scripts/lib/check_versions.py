# SPDX-License-Identifier: MIT
"""Judges whether all places that name a version name the same one.

Usage: check_versions.py [--tag TAG] REPOSITORY
The version of the addon: plugin.cfg, the newest release of the CHANGELOG, packages that pages name. The lowest Godot: the
`.gdextension`, SConstruct, both READMEs. A tag, given or of the commit that is checked out, asks for more: it is v and the version,
and the CHANGELOG has nothing unreleased. Prints every fault, then "N passed, N failed"."""

import argparse
import re
import subprocess
import sys
from datetime import date
from pathlib import Path

from addon_files import ADDON, EXTENSION, sections_of

VERSION = re.compile(r"(0|[1-9]\d*)\.(0|[1-9]\d*)\.(0|[1-9]\d*)(?:-([0-9A-Za-z.-]+))?")
README_FILES = ("README.md", str(ADDON / "README.md"))


def order(version):
    """Semantic Versioning's order, for the versions that we use: a release comes after what leads to it."""
    found = VERSION.fullmatch(version)
    return tuple(int(part) for part in found.groups()[:3]) + (found[4] is None, found[4] or "")


def plugin_version(repository, faults):
    found = re.search(r'^version="([^"]*)"$', (repository / ADDON / "plugin.cfg").read_text(encoding="utf-8"), re.MULTILINE)
    version = found[1] if found else ""
    if not VERSION.fullmatch(version):
        faults.append(f"{ADDON / 'plugin.cfg'}: version={version!r} is no version such as 1.2.3")
        return None
    return version


def check_changelog(repository, version, tag, faults):
    """Headings as Keep a Changelog has them: [Unreleased] first, if at all, then releases with their days, the newest first."""
    text = (repository / "CHANGELOG.md").read_text(encoding="utf-8")
    heads = re.findall(r"^## (.*)$", text, re.MULTILINE)
    unreleased, releases = heads[:1] == ["[Unreleased]"], []
    for head in heads[unreleased:]:
        found = re.fullmatch(r"\[([^\]]+)\] - (\d{4}-\d{2}-\d{2})", head)
        if not found or not VERSION.fullmatch(found[1]):
            faults.append(f"CHANGELOG.md: the heading {head!r} is not as [1.2.3] - 2026-01-31, or [Unreleased] at the top")
            continue
        try:
            date.fromisoformat(found[2])
        except ValueError:
            faults.append(f"CHANGELOG.md: {found[2]} is no day")
        releases.append(found[1])
    if releases != sorted(set(releases), key=order, reverse=True):
        faults.append(f"CHANGELOG.md: releases are not in order, or one stands twice: {', '.join(releases)}")
    if not heads:
        faults.append("CHANGELOG.md has no heading")
    if version and releases and releases[0] != version:
        faults.append(f"CHANGELOG.md: the newest release is {releases[0]}, and plugin.cfg has {version}")
    if tag:
        if not releases:
            faults.append(f"CHANGELOG.md has no release, and the tag is {tag}: call what is unreleased [{version}] and give it a day")
        elif unreleased and re.search(r"^[-*] ", text.split("\n## ")[1], re.MULTILINE):
            faults.append(f"CHANGELOG.md lists changes that are unreleased, and the tag is {tag}")


def check_godot(repository, faults):
    """One lowest Godot everywhere."""
    extension = dict(sections_of((repository / EXTENSION).read_text(encoding="utf-8")).get("configuration", []))
    lowest = extension.get("compatibility_minimum")
    built = re.search(r'api_version="([^"]+)"', (repository / "SConstruct").read_text(encoding="utf-8"))
    if not built or built[1] != lowest:
        faults.append(f"{EXTENSION}: compatibility_minimum is {lowest}, and SConstruct builds for {built[1] if built else 'no API'}")
    for name in README_FILES:
        named = re.findall(r"Godot (4\.\d+) and later", (repository / name).read_text(encoding="utf-8"))
        if not named:
            faults.append(f'{name} does not say "Godot {lowest} and later"')
        for other in sorted(set(named) - {lowest}):
            faults.append(f"{name} says Godot {other} and later, and {EXTENSION} says {lowest}")


def check_pages(repository, version, faults):
    """Packages that pages name."""
    for page in [repository / name for name in README_FILES] + sorted((repository / "docs").glob("*.md")):
        for named in re.findall(r"soft_body_2d-(\d[\w.-]*?)(?:-partial)?\.zip", page.read_text(encoding="utf-8")):
            if named != version:
                faults.append(f"{page.relative_to(repository)} names the package of {named}, and the version is {version}")


def tag_of(repository):
    """The tag of the commit that is checked out, if it is one of a version."""
    asked = subprocess.run(["git", "-C", str(repository), "tag", "--points-at", "HEAD", "--list", "v*"], capture_output=True, text=True,
                           check=False)
    return (asked.stdout.split() or [None])[0]


def check(repository, tag=None):
    faults = []
    version = plugin_version(repository, faults)
    if tag and version and tag != f"v{version}":
        faults.append(f"the tag is {tag}, and plugin.cfg has {version}: call it v{version}")
    check_changelog(repository, version, tag, faults)
    check_godot(repository, faults)
    check_pages(repository, version, faults)
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tag")
    parser.add_argument("repository", type=Path)
    options = parser.parse_args()
    faults = check(options.repository, options.tag or tag_of(options.repository))
    for fault in faults:
        print(f"error: {fault}", file=sys.stderr)
    print(f"{int(not faults)} passed, {len(faults)} failed")
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
