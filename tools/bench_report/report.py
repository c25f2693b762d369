"""The report: the machine and all tables as Markdown, each table as CSV, and plots."""

import json

from .frame_tables import frame_tables
from .growth_tables import growth_tables
from .own_tables import goals, own_tables
from .plots import draw_plots
from .text import csv_of, markdown_of
from .world_tables import world_tables

EXPLANATION = """
Each measurement is a separate run of the program. Figures are medians of its runs; frame times are medians of the \
frames of a run, without the first one. The frames of the thesis's tables are drawn with `--preset thesis`. A load \
average above that of one program on all cores means that other programs ran, so times are too long.

*The thesis*: D. Čejchan, Brno 2019; i7-6700HQ, GeForce GTX 960M, 1920×1080, view distance 32 unless a table says \
otherwise. Its frames per second are counted on a screen.
"""

# Shown in place of keys of results.jsonl.
NAMES = {"picture": "image", "processor": "CPU", "processors": "CPU cores"}


def all_tables(settings):
    return [goals(settings), *world_tables(settings), *frame_tables(settings), *own_tables(settings),
            *growth_tables(settings)]


def head_of(results, is_quick):
    text = f"# Measurements{', quick' if is_quick else ''}\n\n| | |\n|---|---|\n"
    for name, value in sorted(results.about.items()):
        shown = value if isinstance(value, str) else json.dumps(value, separators=(",", ":"), ensure_ascii=False)
        text += f"| {NAMES.get(name, name.replace('_', ' '))} | {shown} |\n"
    runs = results.runs.reindex(columns=["/run/load_average", "/run/seconds", "/run/processor_seconds"]).fillna(0)
    if len(runs) > 0:
        loads, seconds, processor_seconds = (runs[column] for column in runs)
        text += f"| load average before each run | {loads.min():.2f} to {loads.max():.2f} |\n"
        text += f"| runs | {len(runs)}, {seconds.sum():.0f} s, {processor_seconds.sum():.0f} s of CPU time |\n"
    return text + EXPLANATION


def section_of(table, results, is_quick, plots):
    text = f"\n## {table.title}\n\n{table.about}\n\n"
    if is_quick:
        text += f"Cut for `--quick`: {table.cut}.\n\n"
    text += markdown_of(table, results)
    text += "".join(f"\n![{table.title}](plots/{plot})\n" for plot in plots)
    failures = [f"- `{cell}`: {results.failures[cell]}\n" for cell in table.cells() if cell in results.failures]
    return text + ("\nFailed measurements:\n\n" + "".join(failures) if failures else "")


def write_report(folder, results, tables, is_quick):
    """Raises OSError."""
    for part in ("tables", "plots"):
        (folder / part).mkdir(parents=True, exist_ok=True)
    report = head_of(results, is_quick)
    for table in tables:
        (folder / "tables" / f"{table.name}.csv").write_text(csv_of(table, results), encoding="utf-8")
        report += section_of(table, results, is_quick, draw_plots(table, results, folder / "plots"))
    (folder / "report.md").write_text(report, encoding="utf-8")
