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
    plt = None
MISSING = "matplotlib is missing; install it with: apt-get install python3-matplotlib"

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
    whole = path.read_text().rpartition("\n")[0]  # a run that is still written may end in half a row
    rows = list(csv.reader(whole.splitlines()))
    if len(rows) < 2:
        return {}
    return {name: [float(row[i]) if row[i] else float("nan") for row in rows[1:]] for i, name in enumerate(rows[0])}


def add_legend(axes):
    if axes.get_legend_handles_labels()[0]:
        axes.legend(frameon=False, fontsize=8)


def draw_impulse(axes, history):
    time = [1e3 * t for t in history["time_s"]]
    for column, colour in IMPULSES:
        if column in history:
            axes.plot(time, history[column], color=COLOURS[colour], lw=2 if colour == "total" else 1.3, label=colour)
    axes.set(xlabel="time, ms", ylabel="impulse on the plate, N s", title="impulse")
    add_legend(axes)


def draw_deflection(axes, history, results, references):
    if "centre_deflection_m" not in history:
        return axes.set_axis_off()
    axes.plot([1e3 * t for t in history["time_s"]], [1e3 * w for w in history["centre_deflection_m"]], color=COLOURS["plate"], lw=2)
    permanent = results.get("permanent_centre_deflection_m")
    if permanent is not None:
        axes.axhline(1e3 * permanent, color=COLOURS["plate"], ls="--", lw=1, label=f"at rest {1e3 * permanent:.1f} mm")
    for (source, value), style in zip(references, [":", "-.", (0, (1, 4)), (0, (4, 2, 1, 2, 1, 2))]):
        axes.axhline(1e3 * value, color=COLOURS["total"], ls=style, lw=1, label=f"{source} {1e3 * value:.1f} mm")
    axes.set(xlabel="time, ms", ylabel="deflection of the centre, mm", title="centre of the plate")
    add_legend(axes)


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
    add_legend(axes)


# Factors to SI of the units that references are written in; a resolved case holds SI alone.
TO_SI = {"": 1.0, "m": 1.0, "mm": 1e-3, "um": 1e-6, "N s": 1.0, "s": 1.0, "ms": 1e-3, "us": 1e-6, "K": 1.0, "1/s": 1.0}


def all_references(run):
    """(quantity, source, value) of every published or measured figure that the resolved case carries."""
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
        value, _, unit = str(entry["value"]).partition(" ")
        if unit in TO_SI:
            found.append((entry["quantity"], entry["source"], float(value) * TO_SI[unit]))
    return found


def references_of(run):
    """(source, value) of the permanent deflections to show: the test and the nearest computation."""
    found = [(source, value) for name, source, value in all_references(run) if name == "permanent_centre_deflection_m"]
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
    wall = record.get("timing", {}).get("wall_s", 0.0)
    return f"{rest}; energy errors: {', '.join(errors) or 'not reported'}; {wall:.0f} s of wall clock"


def make_figure(run, record, history):
    """The four panels of a run; `history` are the columns of its histories.csv."""
    profile = read_columns(run / "profile.csv")
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
    return figure


def draw_run(run, stem):
    record, history = json.loads((run / "run.json").read_text()), read_columns(run / "histories.csv")
    if not history:
        sys.exit(f"run_figure: {run}/histories.csv holds no rows")
    figure = make_figure(run, record, history)
    for extension in ("svg", "png"):
        figure.savefig(f"{stem}.{extension}", dpi=150)
        print(f"{stem}.{extension}")


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    run = pathlib.Path(sys.argv[1])
    if not (run / "run.json").exists():
        sys.exit(f"run_figure: {run} is not a run folder (no run.json)")
    if plt is None:
        sys.exit(f"run_figure: {MISSING}")
    draw_run(run, sys.argv[2] if len(sys.argv) == 3 else str(run / "figure"))


if __name__ == "__main__":
    main()
