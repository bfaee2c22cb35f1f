#!/usr/bin/python3
"""Cylinder test: wall_figure.py RUN [NAME] draws RUN/wall_velocity.csv as NAME.svg (default: RUN/wall_velocity.svg).

Left: radial velocity of the outer wall against time at each station [Borvik 2011, fig. 9]. Right: the same against the way of the
wall, beside what the JWL equation of state of C-4 gives: the work of its isentrope from the Chapman-Jouguet state up to the volume of
the bore, shared between wall and gas as Gurney does (gas velocity linear in the radius): v = sqrt(2 Ed / rho0 / (M/C + 1/2)).
JWL constants: Souers 1996, as listed in [Borvik 2011, table 1]. Without strength of the wall, end effects and waves in it.
"""
import csv
import math
import pathlib
import sys
import tomllib

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    plt = None

COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"]
A, B, R1, R2, OMEGA, E0, RHO0, D = 597.4e9, 13.9e9, 4.5, 1.5, 0.32, 8.7e9, 1601.0, 8190.0
WAYS = [6e-3, 12.5e-3, 19e-3]  # m, where cylinder tests are read


def jwl_pressure(volume, energy):
    return (A * (1 - OMEGA / (R1 * volume)) * math.exp(-R1 * volume) + B * (1 - OMEGA / (R2 * volume)) * math.exp(-R2 * volume)
            + OMEGA * energy / volume)


def chapman_jouguet():
    """Relative volume and pressure where the Rayleigh line of D touches the Hugoniot: the largest gap between them closes there."""
    gap = lambda v: RHO0 * D * D * (1 - v) - jwl_pressure(v, E0 + 0.5 * RHO0 * D * D * (1 - v) ** 2)
    volume = min((0.5 + 0.0005 * i for i in range(900)), key=lambda v: abs(gap(v)))
    return volume, RHO0 * D * D * (1 - volume)


def jwl_work(volume):
    """J/m3 of explosive given away from the Chapman-Jouguet state to `volume`."""
    start, pressure = chapman_jouguet()
    bare = lambda v: A * math.exp(-R1 * v) + B * math.exp(-R2 * v)
    c = (pressure - bare(start)) * start ** (1 + OMEGA)
    return E0 - (A / R1 * math.exp(-R1 * volume) + B / R2 * math.exp(-R2 * volume) + c / OMEGA * volume**-OMEGA)


def jwl_velocity(pipe, way):
    """m/s of the outer wall when it has gone `way`, the wall keeping its volume."""
    inner = 0.5 * pipe["bore"]
    outer, wall = inner + pipe["wall"], (inner + pipe["wall"]) ** 2 - inner**2
    volume = ((outer + way) ** 2 - wall) / inner**2
    ratio = pipe["density"] * wall / (RHO0 * inner**2)
    return math.sqrt(2 * jwl_work(volume) / RHO0 / (ratio + 0.5))


def read_pipe(run):
    case = tomllib.loads((run / "case.resolved.toml").read_text())
    metres = lambda text: float(text.split()[0])
    shape = case["plate"]["pipe"]
    return {"bore": metres(shape["inner_diameter"]), "wall": metres(shape["wall"]), "length": metres(shape["length"]),
            "density": metres(case["plate"]["material"]["density"])}


def read_stations(run):
    """{place m: [(time s, way m, velocity m/s)]}"""
    stations = {}
    with open(run / "wall_velocity.csv", newline="") as file:
        for row in csv.DictReader(file):
            time, place, way, velocity = (float(row[k]) for k in ("time_s", "place_m", "displacement_m", "velocity_m_per_s"))
            stations.setdefault(place, []).append((time, way, velocity))
    return stations


def velocity_at(rows, way):
    """Velocity when the wall has gone `way`, None if it never does."""
    for (_, w0, v0), (_, w1, v1) in zip(rows, rows[1:]):
        if w0 <= way < w1:
            return v0 + (v1 - v0) * (way - w0) / (w1 - w0)
    return None


def make_figure(run):
    pipe, stations = read_pipe(run), read_stations(run)
    figure, axes = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    for (place, rows), colour in zip(sorted(stations.items(), reverse=True), COLOURS):
        label = f"{1e3 * (pipe['length'] - place):.0f} mm from the lit end"
        axes[0].plot([1e6 * t for t, _, _ in rows], [1e-3 * v for _, _, v in rows], color=colour, lw=1.4, label=label)
        axes[1].plot([1e3 * w for _, w, _ in rows], [1e-3 * v for _, _, v in rows], color=colour, lw=1.4)
    ways = [0.5e-3 * i for i in range(2, 61)]
    axes[1].plot([1e3 * w for w in ways], [1e-3 * jwl_velocity(pipe, w) for w in ways], "k--", lw=1.4, label="JWL, Gurney's shares")
    axes[0].set(xlabel="time, us", ylabel="radial velocity of the outer wall, km/s", xlim=(0, None), ylim=(0, None))
    axes[1].set(xlabel="way of the outer wall, mm", xlim=(0, 30), ylim=(0, None))
    for panel in axes:
        panel.legend(frameon=False, fontsize=8)
        panel.spines[["top", "right"]].set_visible(False)
    return figure


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    run = pathlib.Path(sys.argv[1])
    if not (run / "wall_velocity.csv").exists():
        sys.exit(f"wall_figure: {run} has no wall_velocity.csv; it comes from a run of a pipe with observe.probes")
    if plt is None:
        sys.exit("wall_figure: matplotlib is missing; install it with: apt-get install python3-matplotlib")
    out = (sys.argv[2] if len(sys.argv) == 3 else str(run / "wall_velocity")) + ".svg"
    matplotlib.rcParams["svg.hashsalt"] = "standoff"
    make_figure(run).savefig(out, metadata={"Date": None})
    print(out)


if __name__ == "__main__":
    main()
