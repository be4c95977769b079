# SPDX-License-Identifier: MIT
"""Breaks the core in seeded ways, one at a time, and tells how many the tests notice. `scripts/mutate.sh` calls it."""

import argparse
import json
import os
import platform
import random
import re
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "mutation"
FLAGS = "-std=c++20 -O1 -ffp-contract=off -fno-math-errno -Wno-psabi -Isrc -Itests -pthread".split()
LOWEST_LIMIT = 60  # s; a mutant that hangs is noticed

# What is looked for in a line, what takes its place, and what that is called.
RULES = [
    (r" \+ ", " - ", "flip a sign"),
    (r" - ", " + ", "flip a sign"),
    (r" \+= ", " -= ", "flip a sign"),
    (r" -= ", " += ", "flip a sign"),
    (r"(?<=[(=,] )-(?=[a-z(])", "", "flip a sign"),
    (r" \+ [\w.:()\[\]]+(?=[;)])", "", "drop a term"),
    (r" - [\w.:()\[\]]+(?=[;)])", "", "drop a term"),
    (r" \* [\w.:()\[\]]+(?=[;)])", "", "drop a factor"),
    (r" < ", " <= ", "off by one"),
    (r" > ", " >= ", "off by one"),
    (r" <= ", " < ", "off by one"),
    (r" >= ", " > ", "off by one"),
    (r" \+ 1\b", "", "off by one"),
    (r" - 1\b", "", "off by one"),
    (r"= 0;", "= 1;", "off by one"),
    (r"std::min\(", "std::max(", "swap a bound"),
    (r"std::max\(", "std::min(", "swap a bound"),
    (r" < ", " > ", "swap a bound"),
    (r" > ", " < ", "swap a bound"),
    (r" && ", " || ", "change a condition"),
    (r" \|\| ", " && ", "change a condition"),
    (r" == ", " != ", "change a condition"),
    (r" != ", " == ", "change a condition"),
    (r"\bif \((?!Status)", "if (!", "change a condition"),  # of the first operand
]


def code_lines(text):
    """Numbers and texts of the lines that hold code, without what templates and messages make of the same signs."""
    for number, line in enumerate(text.split("\n")):
        bare = line.split("//")[0].rstrip()
        if not bare.startswith("\t") or '"' in bare or "template" in bare or "assert" in bare or "#" in bare:
            continue
        yield number, bare


def candidates():
    found = []
    for file in sorted((ROOT / "src" / "core").rglob("*.cpp")):
        text = file.read_text(encoding="utf-8")
        for number, line in code_lines(text):
            for pattern, replacement, kind in RULES:
                for match in re.finditer(pattern, line):
                    mutated = line[: match.start()] + replacement + line[match.end() :]
                    if mutated != line and all(mutated.count(a) == mutated.count(b) for a, b in ("()", "[]", "{}")) == all(
                        line.count(a) == line.count(b) for a, b in ("()", "[]", "{}")
                    ):
                        found.append((kind, file.relative_to(ROOT), number, mutated))
    return found


def choose(count, seed):
    """As many of each kind as the kinds are, in an order that the seed decides."""
    by_kind = {}
    for candidate in candidates():
        by_kind.setdefault(candidate[0], []).append(candidate)
    generator = random.Random(seed)
    for kind in by_kind.values():
        generator.shuffle(kind)
    kinds = sorted(by_kind)
    chosen = []
    while len(chosen) < 2 * count and kinds:  # twice, as some do not compile
        for kind in list(kinds):
            if by_kind[kind]:
                chosen.append(by_kind[kind].pop())
            else:
                kinds.remove(kind)
    return chosen


def object_of(source):
    return BUILD / "objects" / source.with_suffix(".o")


def compile_one(source, target, text=None):
    """Whether it compiles. `text` instead of what is in the file."""
    target.parent.mkdir(parents=True, exist_ok=True)
    wide = ["-mavx2"] if source.name.endswith("_avx2.cpp") and platform.machine().lower() in ("x86_64", "amd64") else []
    command = [os.environ.get("CXX", "g++"), *FLAGS, *wide, "-c", "-o", str(target)]
    if text is None:
        return subprocess.run([*command, str(source)], cwd=ROOT, stderr=subprocess.DEVNULL).returncode == 0
    # Beside the original's folder on the include path, as sources include by paths from src.
    return subprocess.run([*command, "-x", "c++", "-"], cwd=ROOT, input=text.encode(), stderr=subprocess.DEVNULL).returncode == 0


def build_base(jobs):
    sources = [p.relative_to(ROOT) for folder in ("src/core", "tests") for p in sorted((ROOT / folder).rglob("*.cpp"))]
    newest_header = max(p.stat().st_mtime for folder in ("src/core", "tests") for p in (ROOT / folder).rglob("*.h"))

    def is_stale(source):
        target = object_of(source)
        return not target.exists() or target.stat().st_mtime < max((ROOT / source).stat().st_mtime, newest_header)

    stale = [source for source in sources if is_stale(source)]
    with ThreadPoolExecutor(jobs) as pool:
        if not all(pool.map(lambda source: compile_one(source, object_of(source)), stale)):
            sys.exit("error: the core or its tests do not compile")
    return sources


def link(sources, replaced, by, program):
    objects = [str(by if source == replaced else object_of(source)) for source in sources]
    subprocess.run([os.environ.get("CXX", "g++"), "-pthread", "-o", str(program), *objects], check=True)


def fails(program, limit, *arguments):
    try:
        command = [str(program), "--abort-after=1", "--no-colors=true", *arguments]
        return subprocess.run(command, cwd=ROOT, timeout=limit, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode != 0
    except subprocess.TimeoutExpired:
        return True


def main():
    parser = argparse.ArgumentParser(prog="scripts/mutate.sh", description=__doc__.split(".")[0] + ".")
    parser.add_argument("--count", type=int, default=120, help="mutants (default 120)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--seconds", type=float, default=float("inf"), help="begin no further mutant after that")
    parser.add_argument("--near", action="store_true", help="only the tests of the same room: quick, and notices fewer")
    parser.add_argument("--only", default="", help="part of the path of the files to break")
    arguments = parser.parse_args()

    print("==> Building the tests", flush=True)
    sources = build_base(arguments.jobs)
    program = BUILD / "tests"
    link(sources, None, None, program)
    begin = time.monotonic()
    if fails(program, 3600, *(["--source-file=*tests/base/*"] if arguments.near else [])):
        sys.exit("error: the tests fail before anything is broken")
    whole = time.monotonic() - begin
    print(f"==> The tests take {whole:.0f} s; breaking the core", flush=True)

    begin = time.monotonic()
    survivors, noticed, invalid = [], 0, 0
    mutant, broken = BUILD / "mutant.o", BUILD / "broken_tests"
    for kind, source, number, line in choose(arguments.count, arguments.seed):
        if noticed + len(survivors) >= arguments.count or time.monotonic() - begin > arguments.seconds:
            break
        if arguments.only not in str(source):
            continue
        lines = (ROOT / source).read_text(encoding="utf-8").split("\n")
        before = lines[number].strip()
        lines[number] = line
        if not compile_one(source, mutant, "\n".join(lines)):
            invalid += 1
            continue
        link(sources, source, mutant, broken)
        # First the tests of the same file and room, which notice most.
        mirrors = (f"--source-file=*test_{source.stem}.cpp", f"--source-file=*tests/{source.parts[2]}/*", "")
        limit = max(LOWEST_LIMIT, 5 * whole)
        if any(fails(broken, limit, *([each] if each else [])) for each in mirrors[: 2 if arguments.near else 3]):
            noticed += 1
        else:
            survivors.append({"kind": kind, "place": f"{source}:{number + 1}", "was": before, "became": line.strip()})
            print(f"  survived ({len(survivors)} of {noticed + len(survivors)}): {source}:{number + 1}: {kind}: {before}  ->  {line.strip()}", flush=True)
    total = noticed + len(survivors)
    result = {
        "seed": arguments.seed,
        "mutants": total,
        "noticed": noticed,
        "share": round(noticed / total, 3) if total else None,
        "did_not_compile": invalid,
        "survivors": survivors,
    }
    (BUILD / "result.json").write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    print(json.dumps({key: value for key, value in result.items() if key != "survivors"}))


if __name__ == "__main__":
    main()
