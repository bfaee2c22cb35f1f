#!/usr/bin/python3
"""Unit cell under uniaxial compression: cell_figure.py --out FILE.svg CELL... draws one or several folders of `standoff cell`.

Axial (full line) and lateral (dashed) stress against engineering strain, residual stress subtracted, mean over cells with
the spread between them; beside it the secant bulk modulus with the target and, for the first folder, the affine estimate.
The curves are those of figures 11 (dry) and 13 (wet) of [Borvik 2011].
"""
import argparse
import csv
import json
import pathlib
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    sys.exit("cell_figure: matplotlib is missing; install it with: apt-get install python3-matplotlib")

plt.rcParams["svg.hashsalt"] = "standoff"  # the same figure gives the same file
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"]
TARGET_GPA = {"dry": 1.7, "wet": 10.7}  # [Borvik 2011, sec. 3.3]


def read(folder):
    facts = json.loads((folder / "cell.json").read_text())
    with open(folder / "stress_strain.csv", newline="") as file:
        rows = [{k: float(v) if v else None for k, v in row.items()} for row in csv.DictReader(file)]
    return facts, rows


def name_of(facts):
    text = f"$k_0$ = {facts['stiffness_N_per_m'] / 1e9:g} GN/m, µ = {facts['friction']:g}"
    return text + (f", ξ = {facts['damping']:g}" if facts["damping"] else "")


def draw_stress(axes, facts, rows, colour):
    strain = [100 * row["strain"] for row in rows]
    for kind, style, label in (("axial", "-", name_of(facts)), ("lateral", "--", None)):
        stress = [row[f"{kind}_Pa"] / 1e6 for row in rows]
        spread = [row[f"{kind}_deviation_Pa"] / 1e6 for row in rows]
        axes.plot(strain, stress, style, color=colour, label=label)
        axes.fill_between(strain, [a - b for a, b in zip(stress, spread)], [a + b for a, b in zip(stress, spread)], color=colour,
                          alpha=0.15, lw=0)


def draw_modulus(axes, rows, colour, with_estimate):
    strain = [100 * row["strain"] for row in rows[1:]]
    axes.plot(strain, [row["secant_bulk_modulus_Pa"] / 1e9 for row in rows[1:]], "-", color=colour)
    if with_estimate:
        axes.plot(strain, [row["affine_bulk_modulus_Pa"] / 1e9 for row in rows[1:]], ":", color=colour,
                  label="every contact follows the mean strain")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", required=True, type=pathlib.Path)
    parser.add_argument("folders", nargs="+", type=pathlib.Path, metavar="CELL")
    options = parser.parse_args()
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    kinds = set()
    for n, folder in enumerate(options.folders):
        facts, rows = read(folder)
        kinds.add(facts["kind"])
        draw_stress(left, facts, rows, COLOURS[n % len(COLOURS)])
        draw_modulus(right, rows, COLOURS[n % len(COLOURS)], n == 0)
    for kind in sorted(kinds):
        right.axhline(TARGET_GPA[kind], color="0.5", lw=1, ls="-.", label=f"aimed at, {kind}: {TARGET_GPA[kind]} GPa")
    left.plot([], [], "-", color="0.3", label="axial")
    left.plot([], [], "--", color="0.3", label="lateral")
    left.set(xlabel="engineering strain, %", ylabel="stress, MPa", xlim=(0, None), ylim=(0, None))
    right.set(xlabel="engineering strain, %", ylabel="secant bulk modulus, GPa", xlim=(0, None), ylim=(0, None))
    for axes in (left, right):
        axes.legend(frameon=False, fontsize=8)
        axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(options.out, metadata={"Date": None})


if __name__ == "__main__":
    main()
