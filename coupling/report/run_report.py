#!/usr/bin/python3
"""One HTML page of one or several runs: run_report.py --out FILE RUN... The page holds its figures and opens offline.

Result table beside the published figures, figure, conservation, effects, provenance. Without matplotlib the page has no
figures and says so.
"""
import html
import io
import json
import os
import pathlib
import sys

import run_figure
import wall_figure

STYLE = """
body { font: 15px/1.45 sans-serif; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; color: #222; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.15rem; margin-top: 2rem; border-bottom: 1px solid #ccc; }
h3 { font-size: 1rem; margin-bottom: .3rem; } table { border-collapse: collapse; margin: .4rem 0 1rem; }
th, td { text-align: left; padding: .15rem .9rem .15rem 0; vertical-align: top; border-bottom: 1px solid #eee; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.bad { color: #b00020; font-weight: bold; } .faint { color: #777; } svg { max-width: 100%; height: auto; }
"""

# As coupling/launcher/text_format: the suffix of a key is its unit; longest first.
UNITS = [
    ("_m_per_period", 1e6, "um/period"), ("_per_s", 1.0, "1/s"), ("_Pa_s", 1.0, "Pa s"), ("_Ns", 1.0, "N s"),
    ("_Hz", 1.0, "Hz"), ("_m", 1e3, "mm"), ("_K", 1.0, "K"), ("_J", 1.0, "J"), ("_N", 1.0, "N"), ("_s", 1e6, "us"),
]
# Largest error a result may have and still be believed, with what the error is relative to.
BOOKS = [
    ("energy_error_particles", 0.01, "energy of the particles, of initial energy and inflow"),
    ("energy_error_structure", 0.01, "energy of the structure, of peak external work"),
    ("interface_work_error", 0.05, "work across the interface, of external work"),
    ("momentum_error", 1e-9, "momentum of everything, of the sum of impulses"),
]


def text(value):
    return html.escape(str(value))


def label_and_value(key, value):
    for suffix, factor, unit in UNITS:
        if key.endswith(suffix):
            return key[: -len(suffix)].replace("_", " "), f"{value * factor:.4g} {unit}"
    return key.replace("_", " "), f"{value:.4g}"


def table(rows, heads=(), numbers=()):
    """Rows of texts that are already HTML; `numbers` are the columns that align right."""
    if not rows:
        return ""
    head = "<tr>" + "".join(f"<th>{text(h)}</th>" for h in heads) + "</tr>" if heads else ""
    cells = lambda row: "".join(f'<td{" class=number" if i in numbers else ""}>{c}</td>' for i, c in enumerate(row))
    return "<table>" + head + "".join(f"<tr>{cells(row)}</tr>" for row in rows) + "</table>"


def results_section(runs):
    keys = list(dict.fromkeys(key for run in runs for key, v in run["record"].get("results", {}).items() if v is not None))
    rows = []
    for key in keys:
        values = [run["record"].get("results", {}).get(key) for run in runs]
        row = [text(label_and_value(key, 0.0)[0])]
        row += [text(label_and_value(key, v)[1]) if isinstance(v, (int, float)) else "" for v in values]
        if len(runs) == 1:
            found = [(s, v) for q, s, v in runs[0]["references"] if q == key]
            row.append("<br>".join(f"{text(label_and_value(key, v)[1])}" for _, v in found))
            row.append("<br>".join(f"{100 * (values[0] / v - 1):+.1f} %" for _, v in found if v))
            row.append("<br>".join(text(s) for s, _ in found))
        rows.append(row)
    if not rows:
        return "<p>No results: the run did not come that far.</p>"
    if len(runs) == 1:
        return table(rows, ["quantity", "ours", "reference", "difference", "source"], {1, 2, 3})
    return table(rows, ["quantity"] + [run["name"] for run in runs], set(range(1, len(runs) + 1)))


def rest_text(record):
    rest = record.get("relaxation")
    if rest is None:
        return ""
    word = "yes" if rest.get("at_rest") else f'<span class="bad">no: the permanent deflection is not certified</span> {text(rest.get("message", ""))}'
    return f"<p>Plate at rest: {word}</p>"


def conservation_section(record):
    rows = []
    for key, limit, label in BOOKS:
        value = record.get("conservation", {}).get(key)
        if value is None:
            continue
        good = abs(value) < limit
        rows.append([text(label), f"{value:.2e}", f"{limit:.0e}", "" if good else '<span class="bad">beyond</span>'])
    return table(rows, ["largest error", "found", "believed below", ""], {1, 2}) or "<p>None were reported.</p>"


def effects_section(record):
    rows = []
    for effect in record.get("effects", []):
        seconds = effect.get("seconds")
        rows.append([
            text(effect["name"]), "on" if effect["on"] else '<span class="faint">off</span>', text(effect.get("reason", "")),
            f"{1e-6 * (effect.get('bytes') or 0):.2f} MB" if effect["on"] else "",
            f"{seconds:.2f} s" if effect["on"] and seconds is not None else "",
        ])
    return table(rows, ["effect", "", "why", "memory", "time"], {3, 4})


def flat(tree, path=""):
    for key, value in tree.items():
        name = f"{path}.{key}" if path else key
        if isinstance(value, dict):
            yield from flat(value, name)
        elif value is not None:
            yield name, value


def timing_section(record):
    rows = [[text(k), f"{v:.2f} s"] for k, v in flat(record.get("timing", {})) if isinstance(v, (int, float)) and v >= 0.005]
    return table(rows, (), {1})


def figure_svg(folder, record):
    """The figure as text to stand inside the page, or the reason why there is none."""
    if run_figure.plt is None:
        return f"<p>No figure: {text(run_figure.MISSING)}</p>"
    history = run_figure.read_columns(folder / "histories.csv")
    if not history:
        return "<p>No figure: histories.csv holds no rows.</p>"
    return svg_text(folder, lambda: run_figure.make_figure(folder, record, history))


def wall_section(folder):
    if run_figure.plt is None or not (folder / "wall_velocity.csv").exists():
        return ""
    return f"<h3>Wall of the pipe</h3>{svg_text(folder / 'wall', lambda: wall_figure.make_figure(folder))}"


def svg_text(salt, make):
    # Names inside an SVG must differ between the figures of one page; without dates the page is reproducible.
    with run_figure.matplotlib.rc_context({"svg.hashsalt": str(salt), "svg.fonttype": "none"}):
        figure = make()
        buffer = io.StringIO()
        figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
        run_figure.plt.close(figure)
    svg = buffer.getvalue()
    return svg[svg.index("<svg") :]


def run_section(run):
    record = run["record"]
    reason = f'<p class="bad">{text(record["status"])}: {text(record.get("reason", ""))}</p>' if record["status"] != "done" else ""
    level = f", level {text(record['level'])}" if record.get("level") else ""
    provenance = [[text(k), text(v)] for k, v in flat(record.get("provenance", {}))]
    return f"""<h2>{text(record.get("case", "?"))}{level}, seed {text(record.get("seed", "?"))}</h2>
<p class="faint">{text(run["folder"])}: {text(record["status"])}, model {text(record.get("structure_model", "?"))}</p>
{reason}{rest_text(record)}
{results_section([run])}
{figure_svg(run["folder"], record)}
{wall_section(run["folder"])}
<h3>Conservation</h3>{conservation_section(record)}
<h3>Effects</h3>{effects_section(record)}
<h3>Counts</h3>{table([[text(k.replace("_", " ")), f"{v:,}"] for k, v in flat(record.get("counts", {}))], (), {1})}
<h3>Time</h3>{timing_section(record)}
<h3>Provenance</h3>{table(provenance)}
"""


def read_run(name):
    folder = pathlib.Path(name)
    try:
        record = json.loads((folder / "run.json").read_text())
    except FileNotFoundError:
        sys.exit(f"run_report: {name} is not a run folder (no run.json)")
    except json.JSONDecodeError as error:
        sys.exit(f"run_report: {name}/run.json cannot be read: {error}")
    return {"folder": folder, "name": folder.name, "record": record, "references": run_figure.all_references(folder)}


def page(runs):
    title = ", ".join(dict.fromkeys(run["record"].get("case", "?") for run in runs))
    together = f"<h2>Side by side</h2>{results_section(runs)}" if len(runs) > 1 else ""
    return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{text(title)}</title><style>{STYLE}</style></head>
<body><h1>Standoff: {text(title)}</h1>
{together}{"".join(run_section(run) for run in runs)}</body></html>
"""


def main():
    if len(sys.argv) < 4 or sys.argv[1] != "--out":
        sys.exit(__doc__)
    out, runs = pathlib.Path(sys.argv[2]), [read_run(name) for name in sys.argv[3:]]
    if run_figure.plt is None:
        print(f"the page has no figures: {run_figure.MISSING}")
    part = out.with_name(out.name + f".{os.getpid()}.part")
    try:
        part.write_text(page(runs), encoding="utf-8")
        part.replace(out)
    except OSError as error:
        sys.exit(f"run_report: cannot write {out}: {error.strerror}")
    print(out)


if __name__ == "__main__":
    main()
