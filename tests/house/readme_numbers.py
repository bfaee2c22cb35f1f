#!/usr/bin/python3
"""Numbers in Markdown files are made here, from finished runs, never typed.

    readme_numbers.py --write [FILE ...]   makes every block again; takes the numbers of new runs from runs/
    readme_numbers.py --check [FILE ...]   1 if a block is not what its committed input gives (default: all READMEs)

A block is what stands between `<!-- numbers: COMMAND INPUT ... -->` and `<!-- end -->`. Commands:

    result RUN                  one run beside the figures of the case's reference.toml, with its certificate
    cell   CELL ...             folders of `standoff cell`: packing of each, then modulus and lateral stress against strain
    faults FAULTS.csv SOAK.csv  the table of faults with how often each was done and how long the longest took
    hard   RESULTS.json ...     the hard cases: what is known of other codes, what ours does, figures of hard_cases.py --keep, a file a level
    wall   RUN ...              cylinder tests: velocity of the wall when it has gone so far, a row per station and run
    effects STUDY/cost-effects.csv   a row per effect turned round: what changes against the case as it is, paired by seed
    cost   STUDY/cost.csv ...   a row per level of each study, with its name: mean and spread over seeds, seconds

RUN, CELL and STUDY are folders runs/CASE/NAME. They are not committed: what a block needs is kept in the folder of the case, run.json,
reduced, or cell.json as results/NAME.json and cost.csv as results/NAME.csv (cost.csv where NAME is cost-NUMBER). Blocks are made from
these copies alone. An input may also be such a copy itself.
"""
import argparse
import csv
import json
import pathlib
import re
import statistics
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "coupling/report"))
import wall_figure  # noqa: E402

WAYS = wall_figure.WAYS
BLOCK = re.compile(r"^(<!-- numbers: (\S+) ([^\n]+) -->\n)(.*?)(<!-- end -->)", re.S | re.M)
# A name ends in its unit: factor and text of the unit shown, decimals.
UNITS = {"_Ns": (1, " N s", 1), "_per_s": (1, " 1/s", 0), "_m": (1e3, " mm", 2), "_K": (1, " K", 1), "_s": (1e6, " us", 1)}
STATED = {"mm": 1e-3, "m": 1.0, "N s": 1.0, "us": 1e-6, "ms": 1e-3, "s": 1.0, "K": 1.0, "1/s": 1.0}
BOOKS = [("energy_error_particles", "energy of the particles, largest error of initial energy and inflow", "{:.2%}"),
         ("energy_error_structure", "energy of the plate, largest error of peak external work", "{:.3%}"),
         ("interface_work_error", "work across the interface, difference of external work", "{:.2%}"),
         ("momentum_error", "momentum of everything, error of the sum of impulses", "{:.0e}")]
COLUMNS = [("permanent_centre_deflection_m", "permanent centre mm", 1e3, 2), ("permanent_max_deflection_m", "profile max mm", 1e3, 2),
           ("peak_centre_deflection_m", "peak centre mm", 1e3, 2), ("impulse_Ns", "impulse N s", 1, 1), ("wall_s", "seconds", 1, 0), ("cpu_s", "CPU s", 1, 0)]


def unit_of(name):
    return next(((ending, *rest) for ending, rest in UNITS.items() if name.endswith(ending)), ("", 1, "", 3))


def show(name, value):
    _, factor, text, decimals = unit_of(name)
    return f"{value * factor:.{decimals}f}{text}"


def table(rows, texts=1):
    """The first `texts` columns are words, the others numbers."""
    lines = ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join([lines[0], "| --- " * texts + "| ---: " * (len(rows[0]) - texts) + "|", *lines[1:]]) + "\n"


def references(copy):
    """Figures to compare with, of the case that owns `copy`: (quantity, source, value in SI)."""
    path = copy.parent.parent / "reference.toml"
    found = tomllib.loads(path.read_text())["references"] if path.exists() else []
    value = lambda text: float(text.partition(" ")[0]) * STATED[text.partition(" ")[2]]
    return [(one["quantity"], one["source"], value(one["value"])) for one in found]


def committed_copy(text):
    path = pathlib.PurePosixPath(text)
    if path.parts[0] != "runs":
        return ROOT / path
    folders = [p.parent for p in (ROOT / "cases").rglob("case.toml") if p.parent.name == path.parts[1]]
    if len(folders) != 1:
        raise SystemExit(f"readme_numbers: {text}: {len(folders)} cases have the name {path.parts[1]}")
    study = "cost" if re.fullmatch(r"cost-\d+", path.parent.name) else path.parent.name
    return folders[0] / "results" / (f"{study}.csv" if path.suffix == ".csv" else f"{path.name}.json")


def read_record(folder):
    """run.json; six digits are what a README may need, and the same on every machine."""
    return json.loads((folder / "run.json").read_text(), parse_float=lambda digits: float(f"{float(digits):.6g}"))


def kept_of_cell(folder):
    found = json.loads((folder / "cell.json").read_text(), parse_float=lambda digits: float(f"{float(digits):.6g}"))
    return json.dumps(found, indent=1) + "\n"


def changed_values(run_folder):
    return re.findall(r"^(\w+ = \S.*?) +# --set$", (run_folder / "case.resolved.toml").read_text(), re.M)


def kept_of_wall(folder):
    pipe, stations = wall_figure.read_pipe(folder), wall_figure.read_stations(folder)
    digits = lambda v: None if v is None else float(f"{v:.6g}")
    explosive = tomllib.loads((folder / "case.resolved.toml").read_text())["charge"]["explosive"]
    return {"explosive": {key: explosive[key] for key in ("name", "fill", "gamma")},
            "stations": [{"from_lit_end_m": digits(pipe["length"] - place),
                          "velocity_m_per_s": [digits(wall_figure.velocity_at(rows, way)) for way in WAYS]}
                         for place, rows in sorted(stations.items(), reverse=True)],
            "jwl_m_per_s": [digits(wall_figure.jwl_velocity(pipe, way)) for way in WAYS]}


def kept_of_run(folder):
    record = read_record(folder)
    if record["status"] != "done":
        raise SystemExit(f"readme_numbers: {folder}: status is {record['status']}; only a finished run has results")
    kept = {key: record[key] for key in ("case", "level", "seed", "structure_model", "results", "counts")}
    kept["set"] = changed_values(folder)
    kept["conservation"] = {key: record["conservation"][key] for key, _, _ in BOOKS}
    kept["relaxation"] = {key: record.get("relaxation", {}).get(key) for key in ("at_rest", "kinetic_ratio", "residual_N", "drift_m_per_period")}
    if (folder / "wall_velocity.csv").exists():
        kept["wall"] = kept_of_wall(folder)
    kept["wall_s"] = record["timing"]["wall_s"]
    kept["provenance"] = {key: record["provenance"][key] for key in ("version", "git", "cpu", "threads", "case_hash")}
    return json.dumps(kept, indent=1) + "\n"


def kept_of_study(path):
    """The table as it is; above it, what it does not say: the processor behind its seconds, and what was set."""
    runs = sorted(p.parent for p in path.parent.glob("*/run.json"))
    provenance = read_record(runs[0])["provenance"]
    head = {key: provenance[key] for key in ("version", "git", "cpu")} | {"set": changed_values(runs[0])}
    return f"# {json.dumps(head)}\n{path.read_text()}"


def keep(text):
    source, copy = ROOT / text, committed_copy(text)
    if source == copy or not source.exists():
        return
    copy.parent.mkdir(exist_ok=True)
    kept = kept_of_study if source.suffix == ".csv" else kept_of_cell if (source / "cell.json").exists() else kept_of_run
    copy.write_text(kept(source))


def result(copy):
    run = json.loads(copy.read_text())
    rows = [["quantity", "ours", "reference", "difference", "source"]]
    known = references(copy)
    for name, value in run["results"].items():
        beside = [[show(name, other), f"{value / other - 1:+.1%}", source] for what, source, other in known if what == name]
        own = [name.removesuffix(unit_of(name)[0]).replace("_", " "), show(name, value)]
        for i, cells in enumerate(beside or [["", "", ""]]):
            rows.append([*(own if i == 0 else ["", ""]), *cells])
    books = [["book", "value"]] + [[text, form.format(run["conservation"][key])] for key, text, form in BOOKS]
    rest, counts = run["relaxation"], run["counts"]
    books.append(["at rest", f"{'yes' if rest['at_rest'] else 'NO'}: kinetic energy {rest['kinetic_ratio']:.0e} of its peak, "
                  f"unbalanced force {rest['residual_N']:.1g} N, drift {1e6 * rest['drift_m_per_period']:.2f} um per period"])
    particles = ", ".join(f"{counts[f'{medium}_particles']:,} {medium} particles" for medium in ("charge", "sand", "air")
                          if f"{medium}_particles" in counts)
    return (table(rows) + "\n" + table(books) + f"\n{', '.join([*filter(None, [run['level'], *run['set']]), 'seed'])} {run['seed']}: {particles}, "
            f"{counts['elements']} elements; {run['wall_s']:.0f} s on {run['provenance']['cpu']}.\n")


def study(copy):
    head, *lines = copy.read_text().splitlines()
    return json.loads(head[2:]), list(csv.DictReader(lines))


def spread(runs, column, factor, decimals):
    values = [float(run[column]) * factor for run in runs if run.get(column)]
    deviation = f" ± {statistics.stdev(values):.{decimals}f}" if len(values) > 1 else ""
    return f"{statistics.mean(values):.{decimals}f}{deviation}" if values else ""


def cost_row(first, tried, columns):
    runs = [run for run in tried if run["exit_code"] == "0"]
    counts = " / ".join(f"{int(tried[0][key]):,}" for key in ("charge_particles", "sand_particles", "elements"))
    failed = f" ({len(tried) - len(runs)} failed)" if len(runs) < len(tried) else ""
    worst = max((float(run["energy_error_particles"]) for run in runs), default=float("nan"))
    return [first, counts, f"{len(runs)}{failed}", *(spread(runs, name, *form) for name, _, *form in columns), f"{worst:.2%}"]


def cost(*copies):
    studies = [study(copy) for copy in copies]
    columns = [column for column in COLUMNS if any(column[0] in run for _, runs in studies for run in runs)]
    rows = [["level", "C-4 / sand / elements", "runs", *(title for _, title, *_ in columns), "energy error"]]
    for copy, (_, runs) in zip(copies, studies):
        name = "" if copy.stem == "cost" else ", " + copy.stem.replace("_", " ")
        for level in dict.fromkeys(run["level"] for run in runs):
            rows.append(cost_row(level + name, [run for run in runs if run["level"] == level], columns))
    places = {name: 3 + i for i, (name, *_) in enumerate(columns)}
    for name, source, value in references(copies[0]):
        if name in places:
            rows.append([source, *[""] * (len(rows[0]) - 1)])
            rows[-1][places[name]] = f"{value * unit_of(name)[1]:.1f}"
    return table(rows) + ("\nMean ± standard deviation over seeds; energy error of the particles: the largest; "
                          f"seconds on {'; '.join(sorted({head['cpu'] for head, _ in studies}))}.\n")


def effects(copy):
    """Change of every quantity, with the standard error over the seeds where there are several."""
    head, runs = study(copy)
    plain = {run["seed"]: run for run in runs if not run["effect"]}
    what = [("cpu_s", "CPU s", 1, 1), *(column for column in COLUMNS if column[0] in plain[next(iter(plain))] and column[0] not in ("wall_s", "cpu_s"))]

    def change(turned, column, factor, decimals):
        pairs = [(float(run[column]), float(plain[run["seed"]][column])) for run in turned if run[column] and plain[run["seed"]][column]]
        values = [factor * (a - b) for a, b in pairs]
        error = f" ± {statistics.stdev(values) / len(values) ** 0.5:.{decimals}f}" if len(values) > 1 else ""
        return f"{statistics.mean(values):+.{decimals}f}{error}" if values else ""

    rows = [["effect turned", "runs", *(title for _, title, *_ in what)]]
    rows.append(["as it is", str(len(plain)), *(spread(list(plain.values()), name, *form) for name, _, *form in what)])
    for effect, turned in dict.fromkeys((run["effect"], run["turned"]) for run in runs if run["effect"]):
        done = [run for run in runs if run["effect"] == effect and run["exit_code"] == "0"]
        rows.append([f"{effect} {turned}", str(len(done)), *(change(done, name, *form) for name, _, *form in what)])
    return table(rows) + f"\nChange against the case as it is, same seeds; processor time of all processes on {head['cpu']}.\n"


def cell(*copies):
    tests = [json.loads(copy.read_text()) for copy in copies]
    names = [f"k0 {t['stiffness_N_per_m'] / 1e9:g} GN/m, friction {t['friction']:g}, damping {t['damping']:g}{', grains turn' * t.get('grain_rotation', False)}" for t in tests]
    packed = [["cells", "packing", "contacts a grain", "largest overlap, % of a diameter", "residual axial / lateral MPa"]]
    with_spread = lambda t, key, factor, form: f"{factor * t[key]['mean']:{form}} ± {factor * t[key]['deviation']:{form}}"
    for test, name in zip(tests, names):
        packed.append([f"{test['cells']} of {test['grains']}, {name}", f"{test['packing']:g}", with_spread(test, "coordination", 1, ".2f"),
                       with_spread(test, "overlap_over_diameter", 100, ".2g"),
                       f"{with_spread(test, 'residual_axial_Pa', 1e-6, '.3g')} / {with_spread(test, 'residual_lateral_Pa', 1e-6, '.3g')}"])
    rows = [["strain", *(f"{what}, {name}" for name in names for what in ("secant K GPa", "lateral / axial"))]]
    points = tests[0]["points"]
    for n in range((len(points) - 1) % 2, len(points), 2):
        cells = [(t["points"][n]["secant_bulk_modulus_Pa"] / 1e9, t["points"][n]["secant_bulk_modulus_deviation_Pa"] / 1e9,
                  t["points"][n]["lateral_over_axial"]) for t in tests]
        rows.append([f"{points[n]['strain']:.1%}", *(text for k, d, r in cells for text in (f"{k:.2f} ± {d:.2f}", f"{r:.3f}"))])
    return table(packed) + "\n" + table(rows) + "\nMean ± standard deviation over cells; residual stress subtracted.\n"


def faults(listed, soaked):
    cells = lambda path: [line.split("|") for line in path.read_text().splitlines() if not line.startswith("#")][1:]
    done = {name: row for name, *row in cells(soaked)}
    rows = [["fault", "of", "when", "exit", "first cause that everyone prints", "passed", "longest s"]]
    for name, who, when, what, code, cause, *_ in cells(listed):
        passed, failed, skipped, longest = done.get(name, ["0", "0", "0", ""])
        times = f"{passed} of {int(passed) + int(failed)}" + (f", {skipped} skipped" if skipped != "0" else "")
        rows.append([name, who, f"{when.removesuffix(' -1')}: {what}", code, re.sub(r" *\* *", " … ", cause.removeprefix("first cause: ")), times, longest])
    return table(rows)


HARD_FIGURES = [("energy_error_particles", "energy of the particles", "{:.1e}"), ("energy_error_structure", "energy of the plate", "{:.1e}"),
                ("momentum_error", "momentum", "{:.0e}"), ("slipped_below_the_surface", "through the plate", "{:.0f}"),
                ("max_overlap_over_radius", "largest overlap / radius", "{:.2f}")]


def hard(copy, *others):
    """One table of the levels, figures side by side."""
    rows = [["case", "known of other codes", "ours", "exit", *(title for _, title, _ in HARD_FIGURES)]]
    levels = [json.loads(level.read_text()) for level in (copy, *others)]
    for name in levels[0]:
        folder = copy.parent.parent / name
        outcome = tomllib.loads((folder / "outcome.toml").read_text())
        title = tomllib.loads((folder / "case.toml").read_text())["case"]["title"]
        rows.append([f"[{title}]({name})", outcome["others"], outcome["ours"], str(outcome["exit"]),
                     *(" / ".join(form.format(level[name][key]) for level in levels if key in level[name]) for key, _, form in HARD_FIGURES)])
    tests = tomllib.loads((copy.parent.parent / "tests.toml").read_text())["test"]
    more = [["situation", "known of other codes", "ours", "test"]]
    more += [[test["title"], test["others"], test["ours"], f"[{pathlib.Path(test['file']).name}](../../{test['file']})"] for test in tests]
    return table(rows, texts=3) + "\n" + table(more, texts=4)


def wall(*copies):
    rows = [["explosive", "particles", "station, mm from the lit end", *(f"km/s at {1e3 * way:g} mm" for way in WAYS), "interface", "seconds"]]
    for copy in copies:
        run = json.loads(copy.read_text())
        for station in run["wall"]["stations"]:
            rows.append([f"{run['wall']['explosive']['name']}, fill {run['wall']['explosive']['fill']}",
                         f"{run['counts']['charge_particles']:,}", f"{1e3 * station['from_lit_end_m']:.0f}",
                         *(f"{1e-3 * v:.2f}" if v else "" for v in station["velocity_m_per_s"]),
                         f"{run['conservation']['interface_work_error']:.1%}", f"{run['wall_s']:.0f}"])
    rows.append(["JWL, shared as Gurney does", "", "", *(f"{1e-3 * v:.2f}" for v in run["wall"]["jwl_m_per_s"]), "", ""])
    return table(rows) + f"\nInterface: `interface_work_error`. Energy error of the particles at most {max(json.loads(c.read_text())['conservation']['energy_error_particles'] for c in copies):.2%}.\n"


COMMANDS = {"wall": wall, "faults": faults, "effects": effects, "result": result, "cell": cell, "cost": cost, "hard": hard}


def block_text(match):
    head, command, inputs, _, end = match.groups()
    if command not in COMMANDS:
        raise SystemExit(f"readme_numbers: unknown command {command}; there are {', '.join(COMMANDS)}")
    copies = [committed_copy(text) for text in inputs.split()]
    for copy in copies:
        if not copy.exists():
            raise SystemExit(f"readme_numbers: {copy.relative_to(ROOT)} is missing; make the run and use --write")
    return head + COMMANDS[command](*copies) + end


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    how = parser.add_mutually_exclusive_group(required=True)
    for name in ("--write", "--check"):
        how.add_argument(name, action="store_true")
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    options = parser.parse_args()
    stale = 0
    for path in options.files or [ROOT / "README.md", *sorted((ROOT / "cases").rglob("README.md"))]:
        text = path.read_text()
        if options.write:
            for block in BLOCK.findall(text):
                list(map(keep, block[2].split()))
        fresh = BLOCK.sub(block_text, text)
        if fresh != text:
            stale += 1
            print(f"{path}: {'rewritten' if options.write else 'numbers are not those of the committed results; use --write'}")
            if options.write:
                path.write_text(fresh)
    return 1 if options.check and stale else 0


if __name__ == "__main__":
    sys.exit(main())
