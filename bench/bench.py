# SPDX-License-Identifier: MIT
"""Runs one benchmark, judges what it measured, prints a table and keeps the result. `scripts/bench.sh` calls it."""

import argparse
import json
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import machine
import tables_b
import tables_books
import tables_c
import tables_dents
import tables_detail
import tables_editor
import tables_engine
import tables_heap
import tables_model
import tables_peers
import tables_rollback
import tables_stress
import work_precision

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "bench"
RESULTS = ROOT / "bench" / "results"


@dataclass(frozen=True)
class Bench:
    """One benchmark: which programs measure it, what becomes of their results, and how that is shown."""

    precisions: tuple  # the first is the one whose figures count; the others stand beside it
    summarize: Callable  # {precision: result of the program} -> the section of the result file
    print_table: Callable  # the same section -> None
    timed: bool = False  # measures time: its programs run one after the other
    program: str | None = "softbody_bench"  # with _PRECISION; None: scripts/bench.sh has measured already


def per_precision(summarize):
    """For benchmarks whose precisions are judged apart: the first one's figures, and the others' without lists."""

    def summarize_all(results):
        (first, main), *others = ((precision, summarize(result)) for precision, result in results.items())
        brief = {name: {k: v for k, v in one.items() if not isinstance(v, list)} for name, one in others}
        return {"precision": first, **main, **brief}

    return summarize_all


BENCHES = {
    "work-precision": Bench(("double", "float"), work_precision.summarize, work_precision.print_table, timed=True),
    "stability": Bench(("double",), per_precision(tables_b.summarize_stability), tables_b.print_stability),
    "energy": Bench(("double", "float"), per_precision(tables_b.summarize_energy), tables_b.print_energy),
    "recovery": Bench(("float",), per_precision(tables_b.summarize_recovery), tables_b.print_recovery),
    "auto": Bench(("float",), per_precision(tables_b.summarize_auto), tables_b.print_auto),
    "table-4-1": Bench(("float",), per_precision(tables_c.summarize_table_4_1), tables_c.print_table_4_1, timed=True),
    "pile": Bench(("float",), per_precision(tables_c.summarize_pile), tables_c.print_pile, timed=True),
    "scaling": Bench(("float",), per_precision(tables_c.summarize_scaling), tables_c.print_scaling, timed=True),
    "contact-accuracy": Bench(("float",), per_precision(tables_c.summarize_contacts), tables_c.print_contacts, timed=True),
    "contact-books": Bench(("float",), per_precision(tables_books.summarize), tables_books.print_table),
    "model": Bench(("float",), per_precision(tables_model.summarize), tables_model.print_table, timed=True),
    "heap": Bench(("float",), per_precision(tables_heap.summarize), tables_heap.print_table, timed=True),
    "dents": Bench(("float",), per_precision(tables_dents.summarize), tables_dents.print_table, timed=True),
    "detail": Bench(("float",), per_precision(tables_detail.summarize), tables_detail.print_table, timed=True),
    "rollback": Bench(("float",), per_precision(tables_rollback.summarize), tables_rollback.print_table, timed=True),
    "peers": Bench(
        ("float",), tables_peers.summarize, tables_peers.print_table, timed=True, program="softbody_peers"
    ),
    "stress": Bench(("float",), tables_stress.summarize, tables_stress.print_table),
    "soak": Bench(("float",), tables_stress.summarize_soak, tables_stress.print_soak),
    "engine": Bench(("release",), tables_engine.summarize, tables_engine.print_table, timed=True, program=None),
    "editor": Bench(("debug",), tables_editor.summarize, tables_editor.print_table, timed=True, program=None),
}


def measure(name, precision, quick):
    """Runs the program of that precision and returns what it wrote."""
    output = BUILD / f"{name}_{precision}.json"
    if BENCHES[name].program is None:
        return json.loads(output.read_text(encoding="utf-8"))
    output.unlink(missing_ok=True)
    priority = machine.priority_command() if BENCHES[name].timed else []
    command = [*priority, BUILD / f"{BENCHES[name].program}_{precision}", name, output] + (["--quick"] if quick else [])
    subprocess.run(command, check=True, stdout=sys.stderr, cwd=ROOT)  # some read files of the repository
    return json.loads(output.read_text(encoding="utf-8"))


def as_lines(value, indent=0):
    """JSON with one line a key, and one line an entry of a list of objects: small, and a change of one point shows."""
    pad = " " * (indent + 1)
    if isinstance(value, dict) and indent < 2:
        entries = [f"{pad}{json.dumps(key)}: {as_lines(item, indent + 1)}" for key, item in value.items()]
        return "{\n" + ",\n".join(entries) + "\n" + " " * indent + "}"
    if isinstance(value, list) and any(isinstance(item, dict) for item in value):
        return "[\n" + ",\n".join(pad + json.dumps(item, allow_nan=False) for item in value) + "\n" + " " * indent + "]"
    return json.dumps(value, allow_nan=False)


def keep(section, name, quick):
    """Puts the section into this machine's file. A quick run stays in the build folder: it is no result to quote."""
    folder = BUILD / "quick_results" if quick else RESULTS
    file = folder / f"{machine.machine_name()}.json"
    folder.mkdir(parents=True, exist_ok=True)
    content = json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}
    content[name] = section
    ordered = {key: content[key] for key in BENCHES if key in content}
    file.write_text(as_lines(ordered) + "\n", encoding="utf-8")
    return file


def main():
    parser = argparse.ArgumentParser(prog="scripts/bench.sh", description=__doc__.split(".")[0] + ".")
    parser.add_argument("name", metavar="NAME", choices=BENCHES, help=", ".join(BENCHES))
    parser.add_argument("--json", action="store_true", help="with the result as one JSON object in the last line")
    parser.add_argument("--quick", action="store_true", help="fewer cases, within 60 s")
    arguments = parser.parse_args()
    name, quick, bench = arguments.name, arguments.quick, BENCHES[arguments.name]

    begin = time.monotonic()
    with ThreadPoolExecutor(max_workers=1 if bench.timed else len(bench.precisions)) as pool:
        measured = list(pool.map(lambda precision: measure(name, precision, quick), bench.precisions))
    program = BUILD / f"{bench.program or name}_{bench.precisions[0]}.program"
    section = machine.head(f"scripts/bench.sh {name}{' --quick' if quick else ''}", program)
    if bench.timed:
        section["priority"] = "real-time" if machine.priority_command() else "normal"
    section.update(bench.summarize(dict(zip(bench.precisions, measured))))
    bench.print_table(section)
    file = keep(section, name, quick)
    print(f"==> {time.monotonic() - begin:.0f} s; the full result: {file.relative_to(ROOT)}")
    if arguments.json:
        print(json.dumps(section, allow_nan=False))


if __name__ == "__main__":
    try:
        main()
    except (OSError, subprocess.CalledProcessError) as problem:
        sys.exit(f"error: {problem}")
