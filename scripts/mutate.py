# SPDX-License-Identifier: MIT
"""Breaks the core in seeded ways, one at a time, and tells how many the tests notice. `scripts/mutate.sh` calls it.

A mutant of which the compiler makes the code that it makes of the original is no mutant. The tests are asked from the
cheapest to the dearest: those of the file, the quickest of all, those of its room, of the other rooms, the slow ones, then
the one that compares with a hash, and after it what takes many seconds. What the hash is the first to notice is counted
apart: it says that something has changed, and not that it is wrong. Who passes them all survives.

A mutant that no claim can tell from the original is explained in scripts/mutate_equivalents.json, by the text of its line
(and of the line before, `after`, where that is needed), and is not run again unless asked for.
"""

import argparse
import hashlib
import json
import os
import platform
import random
import re
import resource
import shutil
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from xml.etree import ElementTree

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "mutation"
OBJECTS = BUILD / "objects"
EXPLAINED = ROOT / "scripts" / "mutate_equivalents.json"
FLAGS = "-std=c++20 -O1 -ffp-contract=off -fno-math-errno -Wno-psabi -pthread".split()
MOST_OBJECTS = 40  # Headers that more objects use hold declarations, vectors and state: each fault there builds most tests anew.
# No test depends on a clock, so none can notice what changes nothing but the time that a step takes.
SPEED_ONLY = ("src/core/dynamics/state_prefetch.h",)
HASH_TEST = "a mixed scene ends in the bits that it always has ended in"
# s of the processor; tests that take longer than the second come after the others, those above the third after the hashes.
CHEAP_TEST, SLOW_TEST, DEAR_TEST = 0.1, 1.0, 6.0
LEAST_SECONDS, TIMES_USUAL = 15, 5  # of the processor; a mutant that takes longer is noticed, as a scene that hangs would be
MOST_MEMORY = 6 << 30  # bytes

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
    (r" / [\w.:()\[\]]+(?=[;)])", "", "drop a factor"),
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
    (r"\bif \((?!Status)(.*)\) \{$", r"if (!(\1)) {", "change a condition"),
    (r"\bif \((?!Status)(.*)\) \{$", r"if (false && (\1)) {", "drop a branch"),
    (r"\bReal\((\d+)\)", lambda m: f"Real({int(m[1]) + 1})", "change a number"),
    (r"(?<=\w\.)x\b(?!\()", "y", "swap an axis"),
    (r"(?<=\w\.)y\b(?!\()", "x", "swap an axis"),
    # An assignment or call that stands alone. Reserving memory ahead changes nothing that a step computes.
    (r"(?<=\t)(?!return|break|continue|throw|delete|case|default|.*reserve\()[\w.:()\[\]>*-]+( [-+*/&|]?= .*|\(.*\));$", ";", "drop a statement"),
]

# `a < b` becomes `a <softbody_tie> b`, which compiles where both are whole numbers: between reals, `<` and `<=` differ where
# two are equal to the last bit, which mostly makes no difference to anything.
WHOLE_NUMBERS = """#pragma once
#include <concepts>
namespace softbody_mutation {
struct Tie {};
template <std::integral T> struct Left { T value; };
template <std::integral T> constexpr Left<T> operator<(T value, Tie) { return { value }; }
template <std::integral T, std::integral U> constexpr bool operator>(Left<T> left, U right) { return left.value < T(right); }
}
inline constexpr softbody_mutation::Tie softbody_tie;
"""


class Mutant:
    def __init__(self, kind, source, lines, number, column, became):
        self.kind, self.source, self.number, self.column = kind, source, number, column
        self.before, self.was, self.became = lines[number - 1].strip(), lines[number], became
        self.by = None  # what noticed it

    def key(self):
        return (str(self.source), squeeze(self.was), squeeze(self.became))

    def told(self):
        return {
            "kind": self.kind,
            "file": str(self.source),
            "line": self.number + 1,
            "after": squeeze(self.before),
            "was": squeeze(self.was),
            "became": squeeze(self.became),
            **({"by": self.by} if self.by else {}),
        }


def squeeze(line):
    return " ".join(line.split("//")[0].split())


def code_lines(lines):
    """Numbers and texts of the lines that hold code, without what templates and messages make of the same signs."""
    for number, line in enumerate(lines):
        bare = line.split("//")[0].rstrip()
        if not bare.startswith("\t") or '"' in bare or "template" in bare or "assert" in bare or "#" in bare:
            continue
        yield number, bare


def is_balanced(line):
    return all(line.count(a) == line.count(b) for a, b in ("()", "[]", "{}"))


def candidates(only, objects_of):
    files = [p.relative_to(ROOT) for p in sorted((ROOT / "src" / "core").rglob("*")) if p.suffix in (".cpp", ".h")]
    for source in files:
        if only not in str(source) or str(source) in SPEED_ONLY:
            continue
        if source.suffix == ".h" and not 0 < len(objects_of.get(source, ())) <= MOST_OBJECTS:
            continue
        lines = (ROOT / source).read_text(encoding="utf-8").split("\n")
        for number, line in code_lines(lines):
            for pattern, replacement, kind in RULES:
                if kind == "drop a statement" and not re.search(r"[;{}:]$|^$", lines[number - 1].split("//")[0].strip()):
                    continue
                for match in re.finditer(pattern, line):
                    became = line[: match.start()] + match.expand(replacement) + line[match.end() :] if isinstance(replacement, str) \
                        else line[: match.start()] + replacement(match) + line[match.end() :]
                    if became != line and is_balanced(became) == is_balanced(line):
                        yield Mutant(kind, source, lines, number, match.start(), became)


def choose(seed, only, objects_of):
    """As many of each kind as the kinds are, in an order that the seed decides."""
    by_kind = {}
    for mutant in candidates(only, objects_of):
        by_kind.setdefault(mutant.kind, []).append(mutant)
    generator = random.Random(seed)
    for kind in by_kind.values():
        generator.shuffle(kind)
    chosen = []
    while any(by_kind.values()):
        chosen += [by_kind[kind].pop() for kind in sorted(by_kind) if by_kind[kind]]
    return chosen


def compiler(source):
    wide = ["-mavx2"] if source.name.endswith("_avx2.cpp") and platform.machine().lower() in ("x86_64", "amd64") else []
    cache = ["ccache"] if shutil.which("ccache") else []
    return [*cache, os.environ.get("CXX", "g++"), *FLAGS, *wide]


def object_of(source):
    return OBJECTS / source.with_suffix(".o")


def compile_one(source, target, *before, cwd=ROOT):
    """Whether it compiles. From a folder and by a path that are alike for all, as the name becomes part of the object."""
    target.parent.mkdir(parents=True, exist_ok=True)
    command = [*compiler(source), *before, f"-I{ROOT}/src", f"-I{ROOT}/tests", "-c", "-o", str(target), str(source)]
    return subprocess.run(command, cwd=cwd, stderr=subprocess.DEVNULL).returncode == 0


def included(source):
    """What the object was made of, as far as it is the project's."""
    list_of_files = object_of(source).with_suffix(".d")
    if not list_of_files.exists():
        return None
    names = list_of_files.read_text(encoding="utf-8").replace("\\\n", " ").split()[1:]
    paths = (Path(os.path.normpath(ROOT / name)) for name in names)
    return [path.relative_to(ROOT) for path in paths if path.is_relative_to(ROOT)]


def build_base(jobs):
    """All sources, and in which objects code of each file of the core is."""
    sources = [p.relative_to(ROOT) for folder in ("src/core", "src/thesis", "tests") for p in sorted((ROOT / folder).rglob("*.cpp"))]
    # Linked last, as the core asks for: no other code may run its copies of inline functions.
    sources.sort(key=lambda source: source.name.endswith("_avx2.cpp"))

    def make(source):
        parts, target = included(source), object_of(source)
        if parts and target.exists() and all((ROOT / p).exists() and (ROOT / p).stat().st_mtime < target.stat().st_mtime for p in parts):
            return True
        return compile_one(source, target, "-MMD", "-MF", str(target.with_suffix(".d")))

    with ThreadPoolExecutor(jobs) as pool:
        if not all(pool.map(make, sources)):
            sys.exit("error: the core or its tests do not compile")
    # A test that gets a header of the core by way of another one runs none of its code but the core's.
    objects_of, named_by = {}, {}

    def names(part):
        if part not in named_by:
            text = (ROOT / part).read_text(encoding="utf-8")
            named_by[part] = {Path("src") / name for name in re.findall(r'#include "(core/.*)"', text)}
        return named_by[part]

    for source in sources:
        parts = included(source)
        named = set().union(*(names(part) for part in parts if part.parts[0] == "tests"))
        for part in parts:
            if source.parts[0] == "src" or part in named:
                objects_of.setdefault(part, []).append(source)
    return sources, objects_of


def link(sources, instead, program):
    objects = [str(instead.get(source, object_of(source))) for source in sources]
    quick_linker = ["-fuse-ld=gold"] if shutil.which("ld.gold") else []
    subprocess.run([os.environ.get("CXX", "g++"), *quick_linker, "-pthread", "-o", str(program), *objects], check=True)


def pattern_of(name):
    return re.sub(r"[^\w ]", "?", name)


class Stage:
    """Some of the tests, and how long they take when nothing is broken."""

    def __init__(self, name, usual, *arguments):
        self.name, self.usual, self.arguments = name, usual, arguments

    def run(self, program):
        """None if all pass, else what failed."""
        most = int(max(LEAST_SECONDS, TIMES_USUAL * self.usual))

        def limit():
            resource.setrlimit(resource.RLIMIT_CPU, (most, most + 5))
            resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        command = [str(program), "--abort-after=1", "--no-colors=true", *self.arguments]
        try:
            done = subprocess.run(command, cwd=ROOT, timeout=10 * most, preexec_fn=limit, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        except subprocess.TimeoutExpired:
            return "time"
        if done.returncode == 0:
            return None
        if done.returncode in (-24, -9):  # SIGXCPU, or what comes after it
            return "time"
        name = re.search(r"TEST CASE: +(.*)", done.stdout.decode(errors="replace"))
        return ("crash in " if done.returncode < 0 else "") + (name[1].strip() if name else self.name)


def run_unbroken(program):
    """Name, file and duration of all tests; known already where the program is the one that was run last."""
    kept = BUILD / "times.json"
    digest = hashlib.sha256(program.read_bytes()).hexdigest()
    if kept.exists() and (known := json.loads(kept.read_text(encoding="utf-8")))["program"] == digest:
        return known["tests"]
    begin, begin_wall = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run([str(program), "--reporters=xml", "--duration=true"], cwd=ROOT, stdout=subprocess.PIPE)
    if done.returncode != 0:
        sys.exit("error: the tests fail before anything is broken")
    end = resource.getrusage(resource.RUSAGE_CHILDREN)
    # Of the processor, as others may be at work on it.
    share = (end.ru_utime + end.ru_stime - begin.ru_utime - begin.ru_stime) / (time.monotonic() - begin_wall)
    tests = []
    for case in ElementTree.fromstring(done.stdout).iter("TestCase"):
        seconds = float(case.find("OverallResultsAsserts").get("duration"))
        tests.append((pattern_of(case.get("name")), case.get("filename"), seconds * share))
    kept.write_text(json.dumps({"program": digest, "tests": tests}), encoding="utf-8")
    return tests


class Runner:
    def __init__(self, sources, objects_of, near, cheap):
        self.sources, self.objects_of, self.near, self.cheap = sources, objects_of, near, cheap
        program = BUILD / "tests"
        link(sources, {}, program)
        tests = run_unbroken(program)
        hash_test = pattern_of(HASH_TEST)
        if hash_test not in (name for name, *_ in tests):
            sys.exit(f"error: no test is called: {HASH_TEST}")
        slow = sorted((seconds, name) for name, _, seconds in tests if seconds > SLOW_TEST)
        self.quick = [test for test in tests if test[2] <= SLOW_TEST and test[0] != hash_test]
        self.slow = [Stage("a slow test", seconds, "--test-case=" + name) for seconds, name in slow]
        self.hash = Stage("a hash", 1, "--test-case=" + hash_test)
        total = sum(seconds for *_, seconds in tests)
        print(f"==> {len(tests)} tests take {total:.0f} s, {len(slow)} of them {sum(s for s, _ in slow):.0f} s; breaking the core", flush=True)

    def stages(self, source):
        own = f"/test_{source.stem.removesuffix('_lanes')}.cpp"
        room = f"tests/{source.parts[2]}/"

        def some(name, takes):
            """Of the quick tests those that `takes` accepts, by file and duration, and no other stage has had."""
            chosen = [test for test in left if takes(*test[1:])]
            left[:] = [test for test in left if test not in chosen]
            if chosen:
                yield Stage(name, sum(seconds for *_, seconds in chosen), "--test-case=" + ",".join(name for name, *_ in chosen))

        left = list(self.quick)
        yield from some("tests of the file", lambda file, _: own in file)
        if not self.near:
            yield from some("the cheapest tests", lambda _, seconds: seconds < CHEAP_TEST)
        yield from some("tests of the room", lambda file, _: room in file)
        if self.near:
            return
        yield from some("tests of other rooms", lambda *_: True)
        yield from (stage for stage in self.slow if stage.usual <= DEAR_TEST)
        yield self.hash
        if not self.cheap:
            yield from (stage for stage in self.slow if stage.usual > DEAR_TEST)

    def try_mutant(self, mutant, place):
        """`does not compile`, `same code`, `not whole numbers`, `noticed`, `hash` or `survived`."""
        shutil.rmtree(place, ignore_errors=True)
        text = (ROOT / mutant.source).read_text(encoding="utf-8").split("\n")

        def write(line):
            text[mutant.number] = line
            (place / mutant.source).parent.mkdir(parents=True, exist_ok=True)
            (place / mutant.source).write_text("\n".join(text), encoding="utf-8")

        parts = self.objects_of[mutant.source] if mutant.source.suffix == ".h" else [mutant.source]
        # Sources that are as they were are found through a link, so that their path is the one that their object knows.
        overlay = f"-I{place}/src"
        for part in parts:
            if part != mutant.source:
                (place / part).parent.mkdir(parents=True, exist_ok=True)
                (place / part).symlink_to(ROOT / part)
        if mutant.kind == "off by one" and (sign := re.match(r" ([<>]=?) ", mutant.was[mutant.column :])):
            at = mutant.column
            write(mutant.was[:at] + " <softbody_tie> " + mutant.was[at + len(sign[0]) :])
            (place / "whole.h").write_text(WHOLE_NUMBERS, encoding="utf-8")
            if not compile_one(parts[0], place / "whole.o", overlay, "-include", str(place / "whole.h"), "-fsyntax-only", cwd=place):
                return "not whole numbers"
        write(mutant.became)
        instead = {}
        for part in parts:
            target = place / "objects" / part.with_suffix(".o")
            if not compile_one(part, target, overlay, cwd=place):
                return "does not compile"
            if target.read_bytes() != object_of(part).read_bytes():
                instead[part] = target
        if not instead:
            return "same code"
        program = place / "program"  # `tests` is a folder where a header is tried
        link(self.sources, instead, program)
        for stage in self.stages(mutant.source):
            if failed := stage.run(program):
                mutant.by = failed
                return "hash" if stage is self.hash else "noticed"
        return "survived"


def read_explained():
    """Why a mutant cannot be told from the original, by its key; those whose line is no more are named."""
    explained = {}
    for entry in json.loads(EXPLAINED.read_text(encoding="utf-8")):
        path = ROOT / entry["file"]
        lines = {squeeze(line) for line in path.read_text(encoding="utf-8").split("\n")} if path.exists() else set()
        if entry["was"] not in lines:
            print(f"  out of date: {EXPLAINED.name} explains a line that {entry['file']} has no more: {entry['was']}")
            continue
        explained.setdefault((entry["file"], entry["was"], entry["became"]), []).append(entry.get("after"))
    return explained


def is_explained(mutant, explained):
    return any(after in (None, squeeze(mutant.before)) for after in explained.get(mutant.key(), ()))


def main():
    parser = argparse.ArgumentParser(prog="scripts/mutate.sh", description=__doc__.split(".")[0] + ".")
    parser.add_argument("--count", type=int, default=120, help="mutants (default 120)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="mutants that are tried side by side")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="begin no further mutant after that")
    parser.add_argument("--near", action="store_true", help="only the tests of the same room: quick, and notices fewer")
    parser.add_argument("--cheap", action="store_true", help=f"without tests that take more than {DEAR_TEST:g} s each")
    parser.add_argument("--only", default="", help="part of the path of the files to break")
    parser.add_argument("--run-explained", action="store_true", help="run those that are explained too: none may be noticed")
    parser.add_argument("--resume", action="store_true", help="go on after what build/mutation/result.json has already")
    parser.add_argument("--again", metavar="FILE", help="only what survived, or a hash alone noticed, in this earlier result")
    arguments = parser.parse_args()

    print("==> Building the tests", flush=True)
    sources, objects_of = build_base(arguments.jobs)
    explained = read_explained()
    chosen = choose(arguments.seed, arguments.only, objects_of)
    if arguments.again:
        earlier = json.loads(Path(arguments.again).read_text(encoding="utf-8"))
        wanted = {(m["file"], m["was"], m["became"], m["after"]) for kind in ("survived", "hash") for m in earlier["details"][kind]}
        chosen = [mutant for mutant in chosen if (*mutant.key(), squeeze(mutant.before)) in wanted]
    done = {}
    if arguments.resume:
        details = json.loads((BUILD / "result.json").read_text(encoding="utf-8"))["details"]
        done = {(m["file"], m["was"], m["became"], m["after"]): (name, m.get("by")) for name in details for m in details[name]}
    runner = Runner(sources, objects_of, arguments.near, arguments.cheap)

    begin = time.monotonic()
    found = {name: [] for name in ("noticed", "hash", "explained", "survived", "does not compile", "same code", "not whole numbers")}
    valid = ("noticed", "hash", "explained", "survived")
    lock, queue = threading.Lock(), iter(chosen)

    def result():
        count = {name: len(found[name]) for name in found}
        mutants = sum(count[name] for name in valid)
        noticed = count["noticed"] + count["hash"]
        distinct = mutants - count["explained"]
        return {
            "seed": arguments.seed,
            "mutants": mutants,
            "noticed": noticed,
            "by_hash_alone": count["hash"],
            "explained": count["explained"],
            "survived": count["survived"],
            "share": round(noticed / mutants, 3) if mutants else None,
            "share_of_unexplained": round(noticed / distinct, 3) if distinct else None,
            "left_out": {name: count[name] for name in found if name not in valid},
        }

    def take_next(under_way):
        with lock:
            if sum(len(found[name]) for name in valid) + under_way[0] >= arguments.count or time.monotonic() - begin > arguments.seconds:
                return None
            mutant = next(queue, None)
            under_way[0] += mutant is not None
            return mutant

    def work(job, under_way=[0]):
        while mutant := take_next(under_way):
            known = is_explained(mutant, explained)
            if before := done.get((*mutant.key(), squeeze(mutant.before))):
                outcome, mutant.by = before
            elif known and not arguments.run_explained:
                outcome = "explained"
            else:
                outcome = runner.try_mutant(mutant, BUILD / f"mutant{job}")
            with lock:
                under_way[0] -= 1
                if known and outcome == "survived":
                    outcome = "explained"
                elif known and outcome in valid and outcome != "explained":
                    print(f"  noticed, though it is explained: {mutant.source}:{mutant.number + 1}: {mutant.by}", flush=True)
                found[outcome].append(mutant)
                if outcome in ("hash", "survived"):
                    told = "only a hash notices" if outcome == "hash" else "survived"
                    place = f"{mutant.source}:{mutant.number + 1}: {mutant.kind}"
                    print(f"  {told}: {place}: {squeeze(mutant.was)}  ->  {squeeze(mutant.became)}", flush=True)
                details = {name: [each.told() for each in found[name]] for name in ("survived", "hash", "explained", "noticed")}
                (BUILD / "result.json").write_text(json.dumps({**result(), "details": details}, indent=1) + "\n", encoding="utf-8")

    with ThreadPoolExecutor(arguments.jobs) as pool:
        list(pool.map(work, range(arguments.jobs)))
    print(json.dumps(result()))


if __name__ == "__main__":
    main()
