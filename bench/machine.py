# SPDX-License-Identifier: MIT
"""Where and from what a result was measured: the head of every section of a result file."""

import datetime
import os
import platform
import re
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# What a result depends on. Other files may differ from the commit without making it another program.
SOURCES = ("src/core", "bench/*.cpp", "bench/*.h", "bench/*.py", "bench/engine", "src/godot", "tests/scenes", "SConstruct")


def output_of(*command):
    """What the command prints, or nothing if it cannot be run."""
    try:
        return subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def cpu():
    """The processor's own name."""
    try:
        info = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        info = ""
    name = re.search(r"^model name\s*:\s*(.+)$", info, re.MULTILINE)
    return (name[1] if name else output_of("sysctl", "-n", "machdep.cpu.brand_string") or platform.processor()).strip()


def machine_name():
    """A file name for results of machines like this one."""
    text = re.sub(r"\((r|tm)\)|\bcpu\b|@.*|processor", " ", f"{cpu()} ".lower())
    parts = re.findall(r"[a-z0-9_]+", f"{text} {platform.system()} {platform.machine()}".lower())
    return "-".join(parts)


def commit():
    """The commit, marked if the sources differ from it."""
    name = output_of("git", "rev-parse", "--short=12", "HEAD") or "unknown"
    return name + ("-dirty" if output_of("git", "status", "--porcelain", "--", *SOURCES) else "")


def build_of(measuring):
    """Compiler and flags of a program, as the build noted them beside it."""
    try:
        program, *flags = measuring.with_suffix(".flags").read_text(encoding="utf-8").split()
    except OSError:
        return "unknown", "unknown"
    return output_of(program, "--version").partition("\n")[0] or program, " ".join(flags)


def priority_command():
    """The words before a timed program that keep others from interrupting it, or none where we may not."""
    return os.environ.get("BENCH_PRIORITY_COMMAND", "").split()


def head(command, measuring):
    """What every section begins with."""
    compiler, flags = build_of(measuring)
    now = datetime.datetime.now(datetime.timezone.utc)
    return {
        "commit": commit(),
        "compiler": compiler,
        "flags": flags,
        "cpu": cpu(),
        "date": now.strftime("%Y-%m-%dT%H:%M:%SZ"),
        "command": command,
        # Over the last minute, how many threads ran or wanted to: above the number of cores other programs were in the way.
        "load": round(os.getloadavg()[0], 1) if hasattr(os, "getloadavg") else None,
    }
