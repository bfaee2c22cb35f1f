#!/usr/bin/python3
"""Only kernels eight lanes wide may leave the files compiled for AVX-512: of a function that others share, the linker keeps
one copy, and an older processor might meet that one.

    tests/house/check_eight_lanes.py OBJECT...      1 and the names of such functions, if there are any
"""
import subprocess
import sys

OWN = ("Pack8", "update_pairs", "eight_lane_update", "Mask8")


def shared(path):
    table = subprocess.run(["nm", "-C", "--defined-only", path], capture_output=True, text=True, check=True).stdout
    return [line for line in table.splitlines() if line.split()[1] in "WV" and not any(name in line for name in OWN)]


def main():
    found = [f"{path}: {line}" for path in sys.argv[1:] for line in shared(path)]
    print("\n".join(found) or f"{len(sys.argv) - 1} files share nothing")
    return 1 if found or len(sys.argv) == 1 else 0


if __name__ == "__main__":
    sys.exit(main())
