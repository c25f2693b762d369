"""Plots of tables as SVG. Equal results make equal files."""

import matplotlib
import matplotlib.pyplot
import pandas

from .table import number_of

matplotlib.use("svg")
COLOURS = ("#1f6fb4", "#e08020", "#3a9a50", "#a04a9a")
MARKERS = ("o", "s", "^", "D")
STYLE = {
    "svg.fonttype": "none",  # texts stay texts
    "svg.hashsalt": "terrane",
    "font.size": 10,
    "axes.prop_cycle": matplotlib.cycler(color=COLOURS),
    "axes.grid": True, "axes.grid.axis": "y", "axes.axisbelow": True, "grid.color": "#dddddd",
    "axes.spines.top": False, "axes.spines.right": False,
    "axes.titlepad": 30,  # room for the legend
}


def draw_plots(table, results, folder):
    """Returns the names of the written files. A plot without numbers is skipped."""
    plots = [(table.name + (f"-{plot.name}" if plot.name else ""), draw_table, plot) for plot in table.plots]
    if table.curve_plot:
        plots.append((table.name + "-curve", draw_curves, table.curve_plot))
    names = []
    for name, draw, plot in plots:
        with matplotlib.rc_context(STYLE):
            figure, axes = matplotlib.pyplot.subplots(figsize=(9, 4.8))
            axes.set(title=table.title, xlabel=plot.x_label, ylabel=plot.y_label)
            if draw(axes, table, plot, results):
                names.append(name + ".svg")
                figure.savefig(folder / names[-1], bbox_inches="tight", metadata={"Date": None})
            matplotlib.pyplot.close(figure)
    return names


def legend(axes, *more_axes):
    """One legend for all axes, above the plot."""
    handles = [handle for one in (axes, *more_axes) for handle in one.get_legend_handles_labels()[0]]
    axes.legend(handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1), ncol=4, frameon=False)


def draw_table(axes, table, plot, results):
    """Returns whether there was something to draw."""
    numbers = pandas.DataFrame(
        [[number_of(row[column], results) for column in plot.columns] for row in table.rows],
        columns=[table.columns[column] for column in plot.columns], dtype=float)
    if numbers.isna().all(axis=None):
        return False
    if plot.is_lines:
        xs = [float(row[0]) for row in table.rows]
        for name, marker in zip(numbers, MARKERS):
            axes.plot(xs, numbers[name], marker=marker, label=name)
        axes.set(xscale="log", yscale="log")
        axes.set_xticks(xs, [row[0] for row in table.rows])
        axes.set_xticks([], minor=True)
    else:
        numbers.index = [", ".join(row[:plot.name_columns]) for row in table.rows]
        numbers.plot.bar(ax=axes, width=0.8, legend=False, xlabel=plot.x_label)
        axes.xaxis.grid(False)
        axes.set_xticklabels(numbers.index, rotation=35, ha="right", rotation_mode="anchor", fontsize=8)
    legend(axes)
    return True


def draw_curves(axes, _, plot, results):
    right = axes.twinx() if any(curve.is_right_axis for curve in plot.curves) else None
    is_anything_drawn = False
    for k, curve in enumerate(plot.curves):
        x, y = (results.arrays.get((curve.cell, pointer), []) for pointer in (curve.x, curve.y))
        count = min(len(x), len(y))
        if count > 0:
            onto = right if curve.is_right_axis else axes
            onto.plot(x[:count], y[:count], label=curve.label, color=COLOURS[k % len(COLOURS)])
            is_anything_drawn = True
    axes.set_ylim(bottom=0)
    if right:
        right.set_ylabel(plot.right_label)
        right.set_ylim(bottom=0)
        right.spines["right"].set_visible(True)
        right.grid(False)
    legend(axes, *([right] if right else []))
    return is_anything_drawn
