#!/usr/bin/python3
"""What each structural model costs beside plate_hex64: the figures of coupling/case/structural_models.hpp.

    model_costs.py [--repeats 3] [--until "2 ms"]

Runs borvik_2011/dry_150mm at level coarse with every model in turn, one thread a process, `--repeats` times, and prints medians.
A cost is processor time of the structure process (timing.cpu_s.structure) less that of a recorded motion played back (replay),
which exchanges the same windows and computes nothing; relative: over that of plate_hex64 in the same turn. By the clock on the
wall (timing.structure.compute_s, in the last columns) the figures are the same only where nothing else uses the machine.
The figures depend on how long a run is: the metal flows most until 0.5 ms, and steps get shorter as the plate thins. The default
is the whole of the case.
A pipe does not fit into that case. Its wall is the plate rolled up, 406 mm round and long, with as many elements, a charge inside;
beside it stands the plate under a bare charge, both for 0.2 ms.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
STANDOFF = ROOT / "build/release/bin/standoff"
MODELS = ["plate_hex64", "replay", "plate_hex27", "plate_hex8", "plate_shell", "rigid_plate", "single_dof"]
PIPE = """[case]
title = "The plate rolled up"
[charge]
explosive = "c4"
radius = "20 mm"
length = "40 mm"
particles = 10_000
[plate]
model = "pipe_hex64"
material = "al6xn"
elements = [20, 5, 1]
[plate.pipe]
inner_diameter = "125.83 mm"
wall = "3.4 mm"
length = "406 mm"
[domain]
lower = ["-0.3 m", "-0.3 m", "-0.3 m"]
upper = ["0.3 m", "0.3 m", "0.7 m"]
[run]
until = "0.2 ms"
"""


def measure(case, out, *options):
    out.parent.mkdir(parents=True, exist_ok=True)
    command = [STANDOFF, "run", case, "--out", out, "--quiet", "--particle-threads", "1", "--structure-threads", "1", *options]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\nexit {done.returncode}\n{done.stdout}{done.stderr}")
    record = json.loads((out / "run.json").read_text())
    return {"compute": record["timing"]["structure"]["compute_s"], "cpu": record["timing"]["cpu_s"]["structure"],
            "steps": record["counts"].get("structure_steps", 0)}


def turn_of(case, models, folder, until):
    """One run with each model, the first recorded; by model."""
    tape, found = folder / "motion.tape", {}
    for model in models:
        options = ["--level", "coarse", "--structure", f"replay:{tape}" if model == "replay" else model]
        options += ["--set", f"run.until={until}", "--set", "run.settle=false"] + ([] if found else ["--tape", tape])
        found[model] = measure(ROOT / "cases/borvik_2011" / case, folder / model, *options)
    return found


def with_shares(turn):
    base, nothing = turn["plate_hex64"], turn["replay"]["cpu"]
    for one in turn.values():
        one |= {"relative": (one["cpu"] - nothing) / (base["cpu"] - nothing), "by_clock": one["compute"] / base["compute"],
                "step": base["steps"] / one["steps"] if one["steps"] else 0.0}
    return turn


def pipe_turn(folder):
    (folder / "pipe").mkdir(parents=True)
    (folder / "pipe/case.toml").write_text(PIPE)
    turn = turn_of("bare_150mm", ["plate_hex64", "replay"], folder, "0.2 ms")
    return with_shares(turn | {"pipe_hex64": measure(folder / "pipe", folder / "pipe_hex64")})


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--until", default="2 ms")
    asked = parser.parse_args()
    turns = []
    with tempfile.TemporaryDirectory() as name:
        for i in range(asked.repeats):
            turn = turn_of("dry_150mm", MODELS, pathlib.Path(name) / f"dry-{i}", asked.until)
            turns.append(with_shares(turn) | {"pipe_hex64": pipe_turn(pathlib.Path(name) / f"bare-{i}")["pipe_hex64"]})
    print(f"{'model':14}{'relative':>10}{'lowest':>9}{'highest':>9}{'cpu_s':>8}{'steps':>8}{'step':>7}{'compute_s':>11}{'by clock':>10}")
    for model in turns[0]:
        every = {key: [turn[model][key] for turn in turns] for key in turns[0][model]}
        middle = {key: statistics.median(values) for key, values in every.items()}
        print(f"{model:14}{middle['relative']:10.3f}{min(every['relative']):9.3f}{max(every['relative']):9.3f}{middle['cpu']:8.2f}"
              f"{middle['steps']:8.0f}{middle['step']:7.2f}{middle['compute']:11.4f}{middle['by_clock']:10.3f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
