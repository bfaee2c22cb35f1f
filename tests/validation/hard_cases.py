#!/usr/bin/python3
"""Runs the hard cases and judges what each declares in its outcome.toml.

    hard_cases.py [--level small|full] [--keep] [CASE ...]     all cases of cases/hard without a name

Exit 0 declared: the case runs with 1 thread, with 2, and once more interrupted at its worst moment (`worst`) and resumed with 2
threads. All three must end in the same bits, and the first must hold the invariants below. Exit 3: the text must name cause, place,
time and remedy (`says`), and frames of the plate up to the stop are left. Exit 2: nothing is started. --keep writes the figures
to cases/hard/results/LEVEL.json, from which tests/house/readme_numbers.py makes the table of cases/hard/README.md.
"""
import argparse
import csv
import json
import math
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
STANDOFF = ROOT / "build/release/bin/standoff"
HARD = ROOT / "cases/hard"
# Energy: velocity Verlet and central differences leave a few per mille. Momentum: impulses, not forces, cross the interface, so
# rounding only. Slipped: a particle below the lowest point of the plate has passed through it. outcome.toml may ask for less.
# Overlap, where the hard core is on: it begins half a radius deep, and a step of at most half a radius each way leads one deeper.
BOUNDS = {"energy_error_particles": 1e-2, "energy_error_structure": 1e-2, "momentum_error": 1e-9, "slipped_below_the_surface": 0}
CORE_BOUND = {"max_overlap_over_radius": 1.5}
MAY_BE_EMPTY = {"sand_front_radius_m"}  # no such radius once all of the sand has left
UNITS = {"us": 1e-6, "ms": 1e-3}
failures = []


def expect(case, what, holds, detail=""):
    if not holds:
        failures.append(f"{case}: {what}  {detail}")
        print(f"    FAIL  {what}  {detail}", flush=True)


def command(case, out, level, *options):
    levels = tomllib.loads((HARD / case / "case.toml").read_text()).get("case", {}).get("use", [])
    chosen = ["--level", level] if any("levels_hard" in name for name in levels) else []
    values = tomllib.loads((HARD / case / "outcome.toml").read_text()).get("set", [])
    changed = [part for value in values for part in ("--set", value)]
    return [str(part) for part in (STANDOFF, "run", HARD / case, "--out", out, *chosen, *changed, *options)]


def record(out):
    return json.loads((out / "run.json").read_text())


def figures(run):
    found = {**run.get("conservation", {}), **run.get("counts", {}), **run.get("results", {})}
    kept = {key: found[key] for key in (*BOUNDS, "max_overlap_over_radius", "interface_work_error", "impulse_Ns") if key in found}
    return {key: float(f"{value:.3g}") + 0.0 for key, value in kept.items()}


def numbers_are_finite(case, out):
    with open(out / "histories.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    bad = [f"{name} at {row['time_s']} s" for row in rows for name, text in row.items()
           if name not in MAY_BE_EMPTY and not math.isfinite(float(text or "nan"))]
    expect(case, "no NaN in histories.csv", not bad, ", ".join(bad[:3]))
    unset = [key for part in ("results", "conservation") for key, value in record(out)[part].items() if value is None]
    expect(case, "no NaN in run.json", not unset, ", ".join(unset))


def judge_invariants(case, outcome, out):
    run = record(out)
    found = figures(run)
    core = any(effect["name"] == "hard_core" and effect["on"] for effect in run["effects"])
    for key, bound in {**BOUNDS, **(CORE_BOUND if core else {}), **outcome.get("bounds", {})}.items():
        if key in found and key not in outcome.get("only_reported", []):
            expect(case, f"{key} <= {bound:g}", found[key] <= bound, f"{found[key]:g}")
    for key, wanted in outcome.get("exactly", {}).items():
        expect(case, f"{key} = {wanted:g}", run["results"].get(key) == wanted, f"{run['results'].get(key)}")
    if "relaxation" in run:
        expect(case, "at rest", run["relaxation"]["at_rest"] is True, run["relaxation"]["message"])
    numbers_are_finite(case, out)
    return found


def same_bits(case, what, first, other):
    one, two = record(first), record(other)
    for part in ("results", "counts", "coupling"):
        expect(case, f"{what}: same {part}", one.get(part) == two.get(part), f"{one.get(part)}\n{two.get(part)}")
    hashes = [run["provenance"].get("state_hash") for run in (one, two)]
    expect(case, f"{what}: same state hash", hashes[0] is not None and hashes[0] == hashes[1], f"{hashes}")
    expect(case, f"{what}: same histories.csv", (first / "histories.csv").read_bytes() == (other / "histories.csv").read_bytes())


def last_time(out):
    try:
        return float((out / "histories.csv").read_text().rstrip("\n").rpartition("\n")[2].partition(",")[0])
    except (OSError, ValueError):
        return -1.0


def break_off(case, outcome, out, level):
    """Interrupts the run once histories.csv has reached the worst moment, and resumes it."""
    value, unit = outcome["worst"].split()
    moment = float(value) * UNITS[unit]
    process = subprocess.Popen(command(case, out, level, "--quiet", "--threads", "1"), stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    while process.poll() is None and last_time(out) < moment:
        time.sleep(0.002)
    if process.poll() is None:
        process.send_signal(signal.SIGINT)
    expect(case, "interrupted at the worst moment: exit 130", process.wait() == 130, f"exit {process.returncode}")
    if process.returncode == 130:
        done = subprocess.run([STANDOFF, "resume", out, "--quiet", "--threads", "2"], capture_output=True, text=True)
        expect(case, "resumed: exit 0", done.returncode == 0, done.stderr[-500:])


def judge_done(case, outcome, folder, level):
    runs = [folder / f"{case}-{name}" for name in ("one", "two", "resumed")]
    for out, threads in zip(runs, ("1", "2")):
        done = subprocess.run(command(case, out, level, "--quiet", "--threads", threads), capture_output=True, text=True)
        expect(case, "exit 0", done.returncode == 0, f"exit {done.returncode} {done.stderr[-700:]}")
        if done.returncode != 0:
            return {}
    same_bits(case, "1 and 2 threads", *runs[:2])
    break_off(case, outcome, runs[2], level)
    if (runs[2] / "run.json").exists() and record(runs[2])["status"] == "done":
        same_bits(case, "restart", runs[0], runs[2])
    return judge_invariants(case, outcome, runs[0])


def judge_stopped(case, outcome, folder, level):
    out = folder / case
    done = subprocess.run(command(case, out, level, "--quiet"), capture_output=True, text=True)
    text = done.stdout + done.stderr
    expect(case, f"exit {outcome['exit']}", done.returncode == outcome["exit"], f"exit {done.returncode} {text[-700:]}")
    for part in outcome["says"]:
        expect(case, f"says \"{part}\"", part in text, text[-700:])
    if outcome["exit"] == 2:
        expect(case, "nothing was created", not out.exists())
        return {}
    expect(case, "run.json says failed and why", record(out)["status"] == "failed" and bool(record(out)["reason"]))
    frames = re.findall(r'file="([^"]+)"', (out / "plate/plate.pvd").read_text())
    expect(case, "frames of the plate are left", frames and all((out / "plate" / name).exists() for name in frames))
    return {}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--level", choices=("small", "full"), default="small")
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("cases", nargs="*")
    options = parser.parse_args()
    known = sorted(path.parent.name for path in HARD.glob("*/case.toml"))
    kept = HARD / f"results/{options.level}.json"
    results = json.loads(kept.read_text()) if kept.exists() else {}
    with tempfile.TemporaryDirectory() as name:
        for case in options.cases or known:
            outcome = tomllib.loads((HARD / case / "outcome.toml").read_text())
            begin, before = time.monotonic(), len(failures)
            judge = judge_done if outcome["exit"] == 0 else judge_stopped
            results[case] = {"exit": outcome["exit"], **judge(case, outcome, pathlib.Path(name), options.level)}
            print(f"  {'pass' if len(failures) == before else 'FAIL'}  {case:32} exit {outcome['exit']}  "
                  f"{time.monotonic() - begin:.1f} s  {results[case]}", flush=True)
    if options.keep and not failures:
        kept.parent.mkdir(exist_ok=True)
        kept.write_text(json.dumps({case: results[case] for case in known if case in results}, indent=1) + "\n")
    print(f"{len(failures)} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
