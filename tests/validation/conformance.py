#!/usr/bin/python3
"""Runs `standoff conform` on every structure model of the catalogue, on the particle program and on the membrane in Python.

    tests/validation/conformance.py [--junit FOLDER]

The rules mostly wait (for silence, for a late partner), so the subjects are judged side by side.
"""
import argparse
import concurrent.futures
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
STANDOFF = ROOT / "build/release/bin/standoff"
PYTHON = ROOT / "tests/contract/python"
# One plays a tape, so there is nothing to judge without one; the other has no surface and takes part in no run.
NOT_COUPLED = {"replay", "material_point"}
# Models that are no plate bring a case of their own.
CASES = {"pipe_hex64": ["--case", ROOT / "cases/borvik_2011/cylinder_test", "--level", "small"]}
# The sins of careless.py, rule by rule: a suite that cannot find them would be worth nothing.
SINS = {"structure_sums", "wrong_checksum", "sigterm"}


def subjects():
    models = json.loads(subprocess.run([STANDOFF, "models", "--json"], capture_output=True, text=True, check=True).stdout)
    for model in models:
        if model["name"] not in NOT_COUPLED:
            case = CASES.get(model["name"], ["--set", f"plate.model={model['name']}"])
            yield model["name"], [*case, "--", "standoff-structure"]
    yield "particles", ["--", "standoff-particles"]
    yield "membrane.py", ["--", PYTHON / "membrane.py"]


def judge(name, arguments, folder):
    report = ["--junit", folder / f"{name}.xml"] if folder else []
    done = subprocess.run([*map(str, [STANDOFF, "conform", *report, *arguments])], capture_output=True, text=True)
    return name, done.returncode, done.stdout + done.stderr


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("--junit", type=pathlib.Path, help="folder for one XML file a subject")
    folder = options.parse_args().junit
    if folder:
        folder.mkdir(parents=True, exist_ok=True)
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(max_workers=4) as pool:
        for name, code, text in pool.map(lambda s: judge(*s, folder), subjects()):
            print(f"  {'pass' if code == 0 else 'FAIL'}  {name}: {text.strip().splitlines()[-1]}", flush=True)
            if code != 0:
                failed += 1
                print("\n".join(line for line in text.splitlines() if not line.startswith("PASS")))
    found = set(re.findall(r"^FAIL  (\S+)", judge("careless", ["--", PYTHON / "careless.py"], None)[2], re.M))
    print(f"  {'pass' if found == SINS else 'FAIL'}  careless.py: its sins are found, {', '.join(sorted(found))}")
    return 1 if failed or found != SINS else 0


if __name__ == "__main__":
    sys.exit(main())
