"""A table as data: its entries and the cells that they need. An entry is a text, a known number (from the thesis), or
an Entry that computes a number from measurements."""

from collections.abc import Callable
from dataclasses import dataclass, field

import pandas

CHUNKS_IN_VIEW = "/chunks_in_view"


@dataclass(frozen=True)
class Value:
    """A number in a measurement, and its conversion to the shown figure."""
    pointer: str              # JSON pointer
    factor: float = 1
    is_inverse: bool = False  # factor / number
    per: str = ""             # JSON pointer of the divisor; empty: none

    def of(self, results, cell):
        """None if the number or the divisor is missing or zero."""
        number = results.number(cell, self.pointer)
        if self.per:
            per = results.number(cell, self.per)
            if not per or number is None:
                return None
            number /= per
        if number is None or (self.is_inverse and number == 0):
            return None
        return self.factor / number if self.is_inverse else self.factor * number


FRAMES_PER_SECOND = Value("/milliseconds/frame", 1000, True)
FRAME_MS = Value("/milliseconds/frame")
CPU_MS = Value("/milliseconds/frame_processor")
LOAD_SECONDS = Value("/milliseconds/load", 1e-3)


@dataclass(frozen=True)
class Entry:
    cells: list
    compute: Callable  # from results; None without a number

    def number(self, results):
        return self.compute(results) if all(map(results.has, self.cells)) else None


def value(cell, what):
    return Entry([cell], lambda results: what.of(results, cell))


def share(part, whole, what):
    """Percentage of the same value in `whole`."""
    def compute(results):
        some, whole_number = what.of(results, part), what.of(results, whole)
        return None if some is None or not whole_number else 100 * some / whole_number
    return Entry([part, whole], compute)


def difference(cell, than, what):
    """Difference to the same value in `than`."""
    def compute(results):
        one, other = what.of(results, cell), what.of(results, than)
        return None if one is None or other is None else one - other
    return Entry([cell, than], compute)


def total(cell, values):
    """The sum of several values of one measurement."""
    return Entry([cell], lambda results: sum_of(results, cell, values))


def sum_of(results, cell, values):
    numbers = [what.of(results, cell) for what in values]
    return None if None in numbers else sum(numbers)


def slope(cells, x, ys):
    """Slope of the least-squares line through the points (x, sum of ys) of several measurements."""
    return Entry(cells, lambda results: line_through(points(results, cells, x, ys))[0])


def intercept(cells, x, ys):
    return Entry(cells, lambda results: line_through(points(results, cells, x, ys))[1])


def points(results, cells, x, ys):
    return pandas.DataFrame([(x.of(results, cell), sum_of(results, cell, ys)) for cell in cells], columns=["x", "y"],
                            dtype=float).dropna()


def line_through(at):
    """Slope and intercept; None with fewer than two different x."""
    count, x, y = len(at), at.x.sum(), at.y.sum()
    spread = count * (at.x * at.x).sum() - x * x
    if count < 2 or spread <= 0:
        return None, None
    grows = (count * (at.x * at.y).sum() - x * y) / spread
    return grows, (y - grows * x) / count


@dataclass(frozen=True)
class Plot:
    """Columns as bars (one group per row, named by the first columns) or as lines over the first column."""
    x_label: str
    y_label: str
    columns: list
    name: str = ""         # of its file, after the table's; empty if it is the only plot
    name_columns: int = 1  # of bars
    is_lines: bool = False  # on logarithmic axes


@dataclass(frozen=True)
class Curve:
    """A line of a plot from arrays in a measurement."""
    cell: str
    x: str  # JSON pointers
    y: str
    label: str
    is_right_axis: bool = False


@dataclass(frozen=True)
class CurvePlot:
    x_label: str
    y_label: str
    curves: list
    right_label: str = ""


@dataclass(frozen=True)
class Table:
    name: str   # on command lines, and of its files
    title: str  # with the thesis's number if it has one
    about: str  # measurement and how to read it; Markdown
    cut: str    # parts that --quick omits
    columns: list
    rows: list
    plots: list = field(default_factory=list)
    curve_plot: CurvePlot = None

    def cells(self):
        """Cells of its entries and curves, each once."""
        cells = [cell for row in self.rows for entry in row if isinstance(entry, Entry) for cell in entry.cells]
        if self.curve_plot:
            cells += [curve.cell for curve in self.curve_plot.curves]
        return list(dict.fromkeys(cells))


def number_of(entry, results):
    """None for a text and for a missing number."""
    if isinstance(entry, Entry):
        return entry.number(results)
    return None if isinstance(entry, str) else entry
