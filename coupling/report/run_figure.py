#!/usr/bin/python3
"""One figure of one run: run_figure.py RUN [NAME] writes RUN/figure.svg and RUN/figure.png (or NAME.svg and NAME.png).

Impulse and centre deflection against time, the permanent profile, the energies, and what makes the run believable.
"""
import csv
import json
import pathlib
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    sys.exit("run_figure: matplotlib is missing; install it with: apt-get install python3-matplotlib")

# One colour a thing, in every panel; distinguishable without colour vision (Okabe and Ito 2008).
COLOURS = {"total": "#000000", "gas": "#D55E00", "sand": "#E69F00", "air": "#56B4E9", "plate": "#0072B2", "loss": "#999999"}
IMPULSES = [("impulse_Ns", "total"), ("impulse_gas_Ns", "gas"), ("impulse_sand_Ns", "sand"), ("impulse_air_Ns", "air")]
ENERGIES = [
    ("gas, kinetic and internal", "gas", ["gas_internal_J", "gas_kinetic_J"], "-"),
    ("sand, kinetic", "sand", ["sand_kinetic_J"], "-"),
    ("sand, elastic", "sand", ["sand_elastic_J"], ":"),
    ("lost in the sand", "loss", ["friction_loss_J", "damping_loss_J", "contact_loss_J"], "-"),
    ("left the domain", "air", ["escaped_J"], "-"),
    ("plate", "plate", ["plate_kinetic_J", "plate_elastic_J", "plate_plastic_J"], "-"),
]


def read_columns(path):
    """Columns of a table by name; an empty field is NaN. Nothing if there is no such file."""
    if not path.exists():
        return {}
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    if len(rows) < 2:
        return {}
    return {name: [float(row[i]) if row[i] else float("nan") for row in rows[1:]] for i, name in enumerate(rows[0])}


def draw_impulse(axes, history):
    time = [1e3 * t for t in history["time_s"]]
    for column, colour in IMPULSES:
        if column in history:
            axes.plot(time, history[column], color=COLOURS[colour], lw=2 if colour == "total" else 1.3, label=colour)
    axes.set(xlabel="time, ms", ylabel="impulse on the plate, N s", title="impulse")
    axes.legend(frameon=False)


def draw_deflection(axes, history, results, references):
    axes.plot([1e3 * t for t in history["time_s"]], [1e3 * w for w in history["centre_deflection_m"]], color=COLOURS["plate"], lw=2)
    permanent = results.get("permanent_centre_deflection_m")
    if permanent is not None:
        axes.axhline(1e3 * permanent, color=COLOURS["plate"], ls="--", lw=1, label=f"at rest {1e3 * permanent:.1f} mm")
    for (source, value), style in zip(references, [":", "-.", (0, (1, 4)), (0, (4, 2, 1, 2, 1, 2))]):
        axes.axhline(1e3 * value, color=COLOURS["total"], ls=style, lw=1, label=f"{source} {1e3 * value:.1f} mm")
    axes.set(xlabel="time, ms", ylabel="deflection of the centre, mm", title="centre of the plate")
    axes.legend(frameon=False, fontsize=8)


def draw_profile(axes, profile):
    axes.plot([1e3 * x for x in profile["x_m"]], [-1e3 * w for w in profile["deflection_m"]], color=COLOURS["plate"], lw=2)
    axes.axhline(0.0, color=COLOURS["loss"], lw=0.8)
    axes.set(xlabel="x along the centre line, mm", ylabel="shape, mm (charge above)", title="shape along the centre line")


def draw_energies(axes, history):
    time = [1e3 * t for t in history["time_s"]]
    for label, colour, columns, style in ENERGIES:
        there = [history[c] for c in columns if c in history]
        if not there:
            continue
        total = [1e-3 * sum(values) for values in zip(*there)]
        if max((t for t in total if t == t), default=0.0) > 0.0:
            axes.plot(time, total, color=COLOURS[colour], ls=style, lw=1.5, label=label)
    axes.set(xlabel="time, ms", ylabel="energy, kJ", title="where the energy is", yscale="log")
    axes.set_ylim(bottom=1e-2)
    axes.legend(frameon=False, fontsize=8)


def references_of(run):
    """(source, value) of the published permanent deflections that the resolved case carries: the test and the nearest run."""
    import tomllib

    path = run / "case.resolved.toml"
    if not path.exists():
        return []
    try:
        case = tomllib.loads(path.read_text())
    except tomllib.TOMLDecodeError:
        return []
    found = []
    for entry in case.get("references", []):
        if entry.get("quantity") == "permanent_centre_deflection_m":
            value, _, unit = str(entry["value"]).partition(" ")
            found.append((entry["source"], float(value) * {"mm": 1e-3, "m": 1.0, "": 1.0}[unit]))
    tests = [f for f in found if "test" in f[0]]
    papers = [f for f in found if "test" not in f[0]]
    return tests + papers[:1]


def subtitle(record):
    rest = "at rest" if record.get("relaxation", {}).get("at_rest") else "not at rest"
    books = record.get("conservation", {})
    errors = [
        f"{name} {100 * books[key]:.2g} %"
        for key, name in [
            ("energy_error_particles", "particles"),
            ("energy_error_structure", "plate"),
            ("interface_work_error", "interface"),
        ]
        if key in books
    ]
    return f"{rest}; energy errors: {', '.join(errors)}; {record['timing']['wall_s']:.0f} s of wall clock"


def draw_run(run, stem):
    record = json.loads((run / "run.json").read_text())
    history, profile = read_columns(run / "histories.csv"), read_columns(run / "profile.csv")
    if not history:
        sys.exit(f"run_figure: {run}/histories.csv holds no rows")
    figure, axes = plt.subplots(2, 2, figsize=(10, 7), layout="constrained")
    draw_impulse(axes[0, 0], history)
    draw_deflection(axes[0, 1], history, record.get("results", {}), references_of(run))
    if profile:
        draw_profile(axes[1, 0], profile)
    else:
        axes[1, 0].set_axis_off()
    draw_energies(axes[1, 1], history)
    for panel in axes.flat:
        panel.spines[["top", "right"]].set_visible(False)
    level = f", level {record['level']}" if record.get("level") else ""
    figure.suptitle(f"{record['case']}{level}, seed {record['seed']}\n{subtitle(record)}", fontsize=11)
    for extension in ("svg", "png"):
        figure.savefig(f"{stem}.{extension}", dpi=150)
        print(f"{stem}.{extension}")


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    run = pathlib.Path(sys.argv[1])
    if not (run / "run.json").exists():
        sys.exit(f"run_figure: {run} is not a run folder (no run.json)")
    draw_run(run, sys.argv[2] if len(sys.argv) == 3 else str(run / "figure"))


if __name__ == "__main__":
    main()
