"""One self-contained HTML page of a results folder: how the run went, what it conserved, gauges, pictures of the state
at several times with a slider over all outputs, and the resolved case.

    python3 -m mudlark.report DIR                  writes DIR/report.html
    python3 -m mudlark.report DIR --out FILE.html
    python3 -m mudlark.report DIR --frames 60      at most so many outputs under the slider

Needs nothing to be looked at but a browser: pictures are inside the page.
"""
import argparse
import base64
import contextlib
import html
import io
import json
import sys
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from mudlark import plot
from mudlark.results import Results, ResultsError

PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{title}</title>
<style>
body {{ font: 15px/1.5 system-ui, sans-serif; color: #222; max-width: 1100px; margin: 2em auto; padding: 0 1em; }}
h1 {{ font-size: 1.5em; }} h2 {{ font-size: 1.15em; margin-top: 2em; border-bottom: 1px solid #ddd; }}
img {{ max-width: 100%; }} table {{ border-collapse: collapse; }}
td, th {{ padding: 0.15em 1em 0.15em 0; text-align: left; vertical-align: top; }}
td.number {{ text-align: right; font-variant-numeric: tabular-nums; }}
pre {{ background: #f6f6f4; padding: 1em; overflow-x: auto; font-size: 13px; }}
.done {{ color: #176f2c; }} .other {{ color: #a4262c; }} input[type=range] {{ width: 100%; }}
</style></head><body>
<h1>{title}</h1>
{body}
</body></html>
"""
SLIDER = """<img id="frame" src="{first}" alt="state">
<input id="time" type="range" min="0" max="{last}" value="0" aria-label="output">
<div id="label">{label}</div>
<script>
const frames = {frames}, labels = {labels}, slider = document.getElementById("time");
slider.oninput = () => {{ document.getElementById("frame").src = frames[slider.value];
                          document.getElementById("label").textContent = labels[slider.value]; }};
</script>
"""


def embedded(path):
    return "data:image/png;base64," + base64.b64encode(Path(path).read_bytes()).decode()


def flat(values, prefix=""):
    """(name, value) pairs of nested tables."""
    for key, value in values.items():
        name = f"{prefix}{key}"
        if isinstance(value, dict):
            yield from flat(value, f"{name}: ")
        else:
            yield name, value


def shown(value):
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, list):
        return ", ".join(shown(entry) for entry in value)
    return "-" if value is None else str(value)


def table(rows, heads=()):
    head = "".join(f"<th>{html.escape(name)}</th>" for name in heads)
    lines = [f"<tr>{head}</tr>"] if head else []
    for row in rows:
        cells = [f"<td>{html.escape(shown(row[0]))}</td>"]
        cells += [f'<td class="number">{html.escape(shown(cell))}</td>' for cell in row[1:]]
        lines.append("<tr>" + "".join(cells) + "</tr>")
    return "<table>" + "".join(lines) + "</table>"


def run_section(summary):
    status = summary.get("status", "unknown")
    colour = "done" if status == "done" else "other"
    text = f'<p class="{colour}"><b>{html.escape(str(status))}</b> {html.escape(str(summary.get("message", "")))}</p>'
    rows = [row for row in flat({k: v for k, v in summary.items() if k not in ("gauges", "stages", "status", "message")})]
    return text + table(rows)


def stage_section(stages):
    """What became of the stages of a run that has some."""
    rows = [[stage["name"]] + [shown(value) for key, value in stage.items() if key != "name"] for stage in stages]
    heads = ["stage", *(key for key in stages[0] if key != "name")]
    return f"<h2>Stages</h2>{table(rows, heads)}"


def gauge_rows(results):
    for name in results.gauge_names:
        gauge = results.gauge(name)
        for column, values in gauge.columns.items():
            if values.size:
                yield (f"{name}: {column} [{gauge.units[column]}]", float(values[-1]), float(np.nanmin(values)),
                       float(np.nanmax(values)))


def picture(draw, *arguments):
    """What a function of mudlark.plot draws, as an embedded image."""
    with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
        return embedded(draw(*arguments, Path(folder) / "picture.png"))


def state_section(results, most):
    times = results.times
    if len(times) > most:
        times = [times[i] for i in np.unique(np.round(np.linspace(0, len(times) - 1, most)).astype(int))]
    frames = [picture(plot.draw_states, results, [time]) for time in times]
    labels = [f"t = {time:.6g} s" for time in times]
    return SLIDER.format(first=frames[0], last=len(frames) - 1, label=labels[0], frames=json.dumps(frames),
                         labels=json.dumps(labels))


def write_report(folder, out=None, most_frames=40):
    """Writes the page and returns its path."""
    results = Results(folder)
    summary = results.summary
    case = results.folder / "case.toml"
    text = case.read_text() if case.exists() else ""
    if not summary and not text:
        raise ResultsError(f"{results.folder} is no results folder: it has neither summary.json nor case.toml")
    title = next((line.split("=", 1)[1].strip().strip('"') for line in text.splitlines() if line.startswith("title")),
                 results.folder.name)
    sections = ["<h2>Run</h2>" + run_section(summary)]
    if summary.get("stages"):
        sections.append(stage_section(summary["stages"]))
    with plt.rc_context(plot.STYLE):
        if results.times:
            sections.append("<h2>State</h2>" + state_section(results, most_frames))
        names = [name for name in results.gauge_names if results.gauge(name).time.size]
        if names:
            image = picture(plot.draw_gauges, results, names)
            sections.append("<h2>Gauges</h2>" + f'<img src="{image}" alt="gauges">'
                            + table(gauge_rows(results), ("", "last", "smallest", "largest")))
    log = results.folder / "log.txt"
    if log.exists():
        sections.append("<h2>Log</h2><pre>" + html.escape("\n".join(log.read_text().splitlines()[-40:])) + "</pre>")
    if text:
        sections.append("<h2>Case, every default written out</h2><pre>" + html.escape(text) + "</pre>")
    path = Path(out) if out else results.folder / "report.html"
    path.write_text(PAGE.format(title=html.escape(title), body="\n".join(sections)))
    return path


def main(words=None):
    parser = argparse.ArgumentParser(prog="mudlark report", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--out", type=Path)
    parser.add_argument("--frames", type=int, default=40, help="at most so many outputs under the slider")
    arguments = parser.parse_args(words)
    if arguments.frames < 1:
        parser.error("--frames needs at least 1")
    try:
        print(write_report(arguments.folder, arguments.out, arguments.frames))
    except (ResultsError, OSError) as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
