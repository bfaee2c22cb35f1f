#!/usr/bin/python3
"""Flow curves of a material point: flow_figure.py RUN reads RUN/flow_curves.csv and writes RUN/flow_curves.svg.

Hardening at each rate (line: isothermal, dashes: adiabatic), strength over rate, strength over temperature.
"""
import csv
import pathlib
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    sys.exit("flow_figure: matplotlib is missing; install it with: apt-get install python3-matplotlib")

COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"]
AT = [0.02, 0.1, 0.3]  # plastic strains of the sections


def read_curves(path):
    """{(rate, temperature, heated): [(strain, MPa)]}"""
    curves = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            key = (float(row["rate_per_s"]), float(row["start_temperature_K"]), row["heated"] == "1")
            curves.setdefault(key, []).append((float(row["plastic_strain"]), 1e-6 * float(row["stress_Pa"])))
    return curves


def at_strain(curve, strain):
    return min(curve, key=lambda point: abs(point[0] - strain))[1]


def draw(curves, axes):
    room = min(temperature for _, temperature, _ in curves)
    rates = sorted({rate for rate, temperature, _ in curves if temperature == room})
    for rate, colour in zip(rates, COLOURS):
        for heated, style in ((False, "-"), (True, "--")):
            curve = curves.get((rate, room, heated))
            if curve:
                label = None if heated else f"{rate:g} 1/s"
                axes[0].plot(*zip(*curve), color=colour, ls=style, lw=1.6, label=label)
    axes[0].set(xlabel="plastic strain", ylabel="flow stress, MPa", title="hardening (dashed: adiabatic)", ylim=(0, None))
    held = sorted((t, r) for r, t, heated in curves if not heated and t > room)
    middle = held[0][1] if held else rates[0]
    for strain, colour in zip(AT, COLOURS):
        axes[1].semilogx(rates, [at_strain(curves[(r, room, False)], strain) for r in rates], "o-", color=colour, label=f"p = {strain:g}")
        kelvin = [room] + [t for t, _ in held]
        axes[2].plot(kelvin, [at_strain(curves[(middle, t, False)], strain) for t in kelvin], "o-", color=colour, label=f"p = {strain:g}")
    axes[1].set(xlabel="plastic strain rate, 1/s", title=f"rate, at {room:g} K", ylim=(0, None))
    axes[2].set(xlabel="temperature, K", title=f"temperature, at {middle:g} 1/s", ylim=(0, None))
    for each in axes:
        each.legend(frameon=False, fontsize=8)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    matplotlib.rcParams["svg.hashsalt"] = "standoff"
    figure, axes = plt.subplots(1, 3, figsize=(11, 3.6), constrained_layout=True)
    draw(read_curves(folder / "flow_curves.csv"), axes)
    figure.savefig(folder / "flow_curves.svg", metadata={"Date": None})


if __name__ == "__main__":
    main()
