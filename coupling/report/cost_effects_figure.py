#!/usr/bin/python3
"""What each effect costs and does: cost_effects_figure.py STUDY reads STUDY/cost-effects.csv, writes cost-effects.svg.

A bar an effect turned round: the change of processor time, of peak deflection and of impulse against the case as it is, in
percent of it, paired by seed; the whisker is the standard error.
"""
import collections
import csv
import math
import pathlib
import statistics
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    sys.exit("cost_effects_figure: matplotlib is missing; install it with: apt-get install python3-matplotlib")

QUANTITIES = [("cpu_s", "processor time"), ("peak_centre_deflection_m", "peak deflection"), ("impulse_Ns", "impulse")]


def read_runs(path):
    """{label: {seed: row}} of the successful runs, in the order of the file; the case as it is has the label ""."""
    runs = collections.OrderedDict()
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            if row["exit_code"] == "0":
                runs.setdefault(f"{row['effect']} {row['turned']}".strip(), {})[row["seed"]] = row
    return runs


def change(turned, plain, key):
    """Mean and standard error of the paired changes in percent of the mean as it is."""
    seeds = [s for s in turned if s in plain and turned[s][key] and plain[s][key]]
    if not seeds:
        return math.nan, 0.0
    scale = statistics.fmean(float(plain[s][key]) for s in seeds)
    if scale == 0.0:
        return math.nan, 0.0
    values = [100.0 * (float(turned[s][key]) - float(plain[s][key])) / scale for s in seeds]
    error = statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else 0.0
    return statistics.fmean(values), error


def main():
    study = pathlib.Path(sys.argv[1])
    runs = read_runs(study / "cost-effects.csv")
    plain = runs.pop("", {})
    labels = list(runs)
    figure, panels = plt.subplots(1, len(QUANTITIES), figsize=(12, 1.5 + 0.3 * len(labels)), sharey=True)
    for axes, (key, title) in zip(panels, QUANTITIES):
        changes = [change(runs[label], plain, key) for label in labels]
        axes.barh(range(len(labels)), [c[0] for c in changes], xerr=[c[1] for c in changes], color="#0072B2", capsize=3)
        axes.axvline(0.0, color="black", lw=0.8)
        axes.set(xlabel=f"change of {title}, %", yticks=range(len(labels)), yticklabels=labels)
    panels[0].invert_yaxis()
    figure.tight_layout()
    figure.savefig(study / "cost-effects.svg")


if __name__ == "__main__":
    main()
