#!/usr/bin/env python3
"""House rules as numbers: one-way dependencies, sizes of files and functions, format, spelling, README per folder."""
import collections
import json
import pathlib
import re
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
# A folder may include these folders (and itself). The two solvers never see each other; base sees nothing.
MAY_INCLUDE = {
    "coupling/base": [],
    "coupling/case": ["coupling/base"],
    "coupling/output": ["coupling/base"],
    "coupling/session": ["coupling/base"],
    "coupling/schedule": ["coupling/base"],
    "coupling/transport": ["coupling/base", "coupling/session", "coupling/schedule"],
    "coupling/contract": ["coupling/base", "coupling/case", "coupling/output", "coupling/session", "coupling/schedule",
                          "coupling/transport"],
    "coupling/tape": ["coupling/base", "coupling/contract", "coupling/session", "coupling/transport"],
    "coupling/replay": ["coupling/base", "coupling/case", "coupling/contract", "coupling/session", "coupling/tape"],
    "coupling/broker": ["coupling/base", "coupling/output", "coupling/session", "coupling/schedule", "coupling/transport",
                        "coupling/contract", "coupling/tape"],
    "coupling/launcher": ["coupling/base", "coupling/case", "coupling/output", "coupling/tape"],
    "coupling/conform": ["coupling/base", "coupling/case", "coupling/session", "coupling/transport", "coupling/contract",
                         "coupling/launcher"],
    "particle_solver": ["coupling/base", "coupling/case", "coupling/contract", "coupling/output", "particle_solver"],
    "structure_solver": ["coupling/base", "coupling/case", "coupling/contract", "coupling/output", "structure_solver"],
    "particle_solver/kernels": ["coupling/base"],
    "structure_solver/materials": ["coupling/base", "structure_solver/elements"],
}
MAX_FILE_BYTES = 20 * 1024
MAX_FUNCTION_LINES_P99 = 80
MAX_FUNCTION_LINES = 120


def tracked(*patterns):
    out = subprocess.run(["git", "ls-files", *patterns], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    return [ROOT / line for line in out.split()]


def allowed_for(folder):
    best = max((k for k in MAY_INCLUDE if folder == k or folder.startswith(k + "/")), key=len, default=None)
    return None if best is None else MAY_INCLUDE[best] + [best]


def check_includes(problems):
    for path in tracked("coupling/*.?pp", "particle_solver/*.?pp", "structure_solver/*.?pp"):
        folder = str(path.parent.relative_to(ROOT))
        allowed = allowed_for(folder)
        if allowed is None:
            problems.append(f"{folder}: no dependency rule for this folder")
            continue
        for name in re.findall(r'^#include "([^"]+)"', path.read_text(), re.M):
            target = str(pathlib.PurePosixPath(name).parent)
            if target == ".":
                continue  # written by the build
            if not any(target == a or target.startswith(a + "/") for a in allowed):
                problems.append(f"{path.relative_to(ROOT)}: includes {name}, which {folder} may not see")


def check_sizes(problems):
    files = tracked("*.cpp", "*.hpp", "*.py", "*.proto")
    for path in files:
        if path.stat().st_size > MAX_FILE_BYTES:
            problems.append(f"{path.relative_to(ROOT)}: {path.stat().st_size} bytes, at most {MAX_FILE_BYTES}")
    sources = [str(p) for p in files if p.suffix in (".cpp", ".hpp")]
    tags = subprocess.run(["ctags", "--output-format=json", "--fields=+ne", "--kinds-C++=f", "-f", "-", *sources],
                          capture_output=True, text=True, check=True).stdout
    lengths = []
    for line in tags.splitlines():
        tag = json.loads(line)
        if "end" in tag:
            lengths.append((tag["end"] - tag["line"] + 1, tag["path"], tag["name"]))
    lengths.sort(reverse=True)
    p99 = lengths[len(lengths) // 100][0]
    if p99 > MAX_FUNCTION_LINES_P99:
        problems.append(f"function length p99 is {p99} lines, at most {MAX_FUNCTION_LINES_P99}")
    for length, path, name in lengths:
        if length > MAX_FUNCTION_LINES:
            problems.append(f"{path}: {name} has {length} lines, at most {MAX_FUNCTION_LINES}")
    print(f"{len(files)} files, {len(lengths)} functions: median {statistics.median(l for l, _, _ in lengths)} lines, p99 {p99}")


def check_readmes(problems):
    folders = collections.Counter(p.parent for p in tracked("coupling/*.?pp", "particle_solver/*.?pp", "structure_solver/*.?pp"))
    for folder in folders:
        readme = folder / "README.md"
        if not readme.exists():
            problems.append(f"{folder.relative_to(ROOT)}: no README.md")
        elif len(readme.read_text().splitlines()) > 60:
            problems.append(f"{readme.relative_to(ROOT)}: more than 60 lines")


def check_tools(problems):
    sources = [str(p) for p in tracked("*.cpp", "*.hpp")]
    for command in (["clang-format", "--dry-run", "--Werror", *sources],
                    ["codespell", "--ignore-words-list", "ans,inout,nd,te,ist,fo,brach,strack", *map(str, tracked("*.md", "*.cpp", "*.hpp", "*.toml", "*.py"))]):
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
        if done.returncode != 0:
            problems.append(f"{command[0]}:\n{(done.stdout + done.stderr)[:4000]}")


def main():
    problems = []
    for check in (check_includes, check_sizes, check_readmes, check_tools):
        check(problems)
    for problem in problems:
        print(problem)
    print("house rules: " + (f"{len(problems)} broken" if problems else "kept"))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
