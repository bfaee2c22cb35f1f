#!/usr/bin/python3
"""Every fault of faults.csv again and again; the count goes to results/faults.csv, for the table of README.md.

    tests/contract/fault_soak.py [REPEATS]     default 20; 1 if any failed
"""
import collections
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
PROGRAM = HERE.parents[1] / "build/release/bin/test_coupling"
ENDED = re.compile(r"\[ +(OK|FAILED|SKIPPED) +\] Table/Fault\.\w+/(\w+).*\((\d+) ms\)$")


def test_name(fault):
    return re.sub(r"[^A-Za-z0-9]", "_", fault)


def main():
    repeats = sys.argv[1] if len(sys.argv) > 1 else "20"
    run = subprocess.run([PROGRAM, "--gtest_filter=Table/Fault.*", f"--gtest_repeat={repeats}"], capture_output=True, text=True)
    ends, longest = collections.defaultdict(collections.Counter), collections.Counter()
    for line in run.stdout.splitlines():
        if found := ENDED.match(line):
            how, name, milliseconds = found.groups()
            ends[name][how] += 1
            longest[name] = max(longest[name], int(milliseconds))
        elif "Actual" in line or "Failure" in line or "Which is" in line:
            print(line)
    rows = ["fault|passed|failed|skipped|longest_s"]
    for line in (HERE / "faults.csv").read_text().splitlines():
        fault = line.partition("|")[0]
        if count := ends.get(test_name(fault)):
            rows.append(f"{fault}|{count['OK']}|{count['FAILED']}|{count['SKIPPED']}|{longest[test_name(fault)] / 1000:.1f}")
    (HERE / "results/faults.csv").write_text("\n".join(rows) + "\n")
    failed = sum(count["FAILED"] for count in ends.values())
    print(f"{len(ends)} faults, {repeats} times each, {failed} failed; now tests/house/readme_numbers.py --write tests/contract/README.md")
    return 1 if failed or run.returncode != 0 else 0


if __name__ == "__main__":
    sys.exit(main())
