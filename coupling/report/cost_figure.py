#!/usr/bin/python3
"""Error against seconds: cost_figure.py STUDY reads STUDY/cost.csv, stages.csv, and writes STUDY/cost.svg and cost.html.

Every run is a dot, every level its mean with the spread over seeds; the error of a level is its distance from the finest
level, with the standard error of that distance. Below: where the seconds of each process go, stage by stage.
"""
import collections
import csv
import html
import math
import pathlib
import statistics
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    sys.exit("cost_figure: matplotlib is missing; install it with: apt-get install python3-matplotlib")

QUANTITIES = [
    ("permanent_centre_deflection_m", "permanent deflection of the centre, mm", 1e3),
    ("peak_centre_deflection_m", "peak deflection of the centre, mm", 1e3),
    ("impulse_Ns", "impulse, N s", 1.0),
]
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"]


def read_runs(path):
    """Successful runs by level, in the order of the file (coarse to fine)."""
    levels = collections.OrderedDict()
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            if row["exit_code"] == "0":
                levels.setdefault(row["level"], []).append({k: float(v) if v else math.nan for k, v in row.items() if k != "level"})
    return levels


def mean_and_error(values):
    """Mean, sample deviation and standard error of the mean; the last two are NaN for a single value."""
    values = [v for v in values if not math.isnan(v)]
    if not values:
        return math.nan, math.nan, math.nan
    deviation = statistics.stdev(values) if len(values) > 1 else math.nan
    return statistics.fmean(values), deviation, deviation / math.sqrt(len(values))


def draw_values(axes, levels, key, label, factor):
    for (level, runs), colour in zip(levels.items(), COLOURS * 9):
        seconds = [run["wall_s"] for run in runs]
        mean, deviation, _ = mean_and_error([factor * run[key] for run in runs])
        axes.plot(seconds, [factor * run[key] for run in runs], "o", ms=4, color=colour, alpha=0.5)
        axes.errorbar(statistics.fmean(seconds), mean, yerr=0.0 if math.isnan(deviation) else deviation, fmt="s", ms=7,
                      color=colour, capsize=4, label=f"{level or 'case'} ({len(runs)})")
    axes.set(xlabel="wall-clock seconds of a run", ylabel=label, xscale="log")


def draw_errors(axes, levels):
    """|distance from the finest level| in %, all quantities; the finest is the reference and has no dot."""
    names = list(levels)
    for (key, label, _), colour, marker in zip(QUANTITIES, COLOURS, "osD"):
        finest, _, finest_error = mean_and_error([run[key] for run in levels[names[-1]]])
        points = []
        for name in names[:-1]:
            mean, _, error = mean_and_error([run[key] for run in levels[name]])
            seconds = statistics.fmean(run["wall_s"] for run in levels[name])
            if finest and not math.isnan(mean):
                points.append((seconds, 100 * abs(mean / finest - 1), 100 * math.hypot(error, finest_error) / abs(finest)))
        if points:
            x, y, bars = zip(*points)
            axes.errorbar(x, y, yerr=[0 if math.isnan(b) else b for b in bars], fmt=marker + "-", color=colour, capsize=4,
                          label=label.split(",")[0])
    axes.set(xlabel="wall-clock seconds of a run", ylabel=f"distance from level {names[-1]}, %", xscale="log")


def read_stages(path, levels):
    """Mean seconds of {(level, process): {stage: seconds}}, in the order of `levels`; empty without the file."""
    if not path.exists():
        return {}
    sums = {(level, process): collections.Counter() for level in levels for process in ("particle", "structure")}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            if (row["level"], row["process"]) in sums:
                sums[row["level"], row["process"]][row["stage"]] += float(row["seconds"]) / len(levels[row["level"]])
    return {bar: stages for bar, stages in sums.items() if stages}


def draw_stages(axes, bars):
    """A bar per process and level, 100 % its seconds; stages above 4 % somewhere by name, the rest as `others`."""
    share = {bar: {stage: 100 * s / sum(stages.values()) for stage, s in stages.items()} for bar, stages in bars.items()}
    names = sorted({n for stages in share.values() for n, s in stages.items() if s > 4} - {"wait"},
                   key=lambda n: -sum(stages.get(n, 0) for stages in share.values()))
    palette = dict(zip(names, matplotlib.colormaps["tab20"].colors)) | {"others": "#bbbbbb", "wait": "#eeeeee"}
    labels = [f"{level or 'case'}, {process}" for level, process in bars]
    left = [0.0] * len(bars)
    for name in [*names, "others", "wait"]:
        widths = [stages.get(name, 0.0) if name != "others" else sum(s for n, s in stages.items() if n not in palette)
                  for stages in share.values()]
        axes.barh(labels, widths, left=left, color=palette[name], label=name)
        left = [a + b for a, b in zip(left, widths)]
    for y, stages in enumerate(bars.values()):
        axes.text(101, y, f"{sum(stages.values()):.0f} s", va="center", fontsize=8)
    axes.invert_yaxis()
    axes.set(xlabel="share of the seconds of the process, %", xlim=(0, 112))
    axes.legend(frameon=False, fontsize=8, ncols=1, loc="center left", bbox_to_anchor=(1.0, 0.5))


def table_html(levels):
    head = "<tr><th>level</th><th>runs</th>" + "".join(f"<th>{html.escape(label)}</th>" for _, label, _ in QUANTITIES) + "<th>seconds</th></tr>"
    rows = ""
    for level, runs in levels.items():
        cells = f"<td>{html.escape(level)}</td><td>{len(runs)}</td>"
        for key, factor in [(k, f) for k, _, f in QUANTITIES] + [("wall_s", 1.0)]:
            mean, deviation, _ = mean_and_error([factor * run[key] for run in runs])
            cells += "<td>" + ("–" if math.isnan(mean) else f"{mean:.2f}") + ("" if math.isnan(deviation) else f" ± {deviation:.2f}") + "</td>"
        rows += f"<tr>{cells}</tr>"
    return f"<table>{head}{rows}</table>"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    study = pathlib.Path(sys.argv[1])
    levels = read_runs(study / "cost.csv")
    if not levels:
        sys.exit("cost_figure: no successful run in cost.csv")
    bars = read_stages(study / "stages.csv", levels)
    rows = [["permanent", "peak"], ["impulse", "error"], *([["stages", "stages"]] if bars else [])]
    figure, axes = plt.subplot_mosaic(rows, figsize=(10, 10 if bars else 7), layout="constrained")
    for panel, (key, label, factor) in zip(("permanent", "peak", "impulse"), QUANTITIES):
        if any(not math.isnan(run[key]) for runs in levels.values() for run in runs):
            draw_values(axes[panel], levels, key, label, factor)
        else:
            axes[panel].set_axis_off()
    if len(levels) > 1:
        draw_errors(axes["error"], levels)
        axes["error"].legend(frameon=False, fontsize=8)
    else:
        axes["error"].set_axis_off()
    axes["impulse"].legend(frameon=False, fontsize=8, title="level (runs)")
    if bars:
        draw_stages(axes["stages"], bars)
    for panel in axes.values():
        panel.spines[["top", "right"]].set_visible(False)
    figure.suptitle(f"{study.resolve().parent.name}: what accuracy costs", fontsize=11)
    figure.savefig(study / "cost.svg")
    picture = (study / "cost.svg").read_text()
    (study / "cost.html").write_text(
        "<!doctype html><meta charset=utf-8><title>What accuracy costs</title>"
        "<style>body{font:15px sans-serif;max-width:60em;margin:2em auto}td,th{padding:.3em 1em;text-align:right}svg{max-width:100%;height:auto}</style>"
        f"<h1>{html.escape(study.resolve().parent.name)}</h1>{picture[picture.index('<svg'):]}{table_html(levels)}"
        "<p>Mean ± spread over seeds. Dots are single runs.</p>"
    )
    print(f"{study}/cost.svg\n{study}/cost.html")


if __name__ == "__main__":
    main()
