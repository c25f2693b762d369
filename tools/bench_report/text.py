"""Tables as Markdown and CSV."""

import pandas

from .table import Entry, number_of


def format_figure(number):
    """At least three digits, all digits of whole numbers: 0.0123, 1.23, 12.3, 123, 12,345; 7; < 0.001."""
    size = abs(number)
    if size < 1000 and number == round(number):
        return f"{number + 0.0:.0f}"
    if size < 0.0005:
        return "< 0.001"
    if size < 0.9995:
        return f"{number:.3g}"
    if size < 9.995:
        return f"{number:.2f}"
    if size < 99.95:
        return f"{number:.1f}"
    return f"{number:,.0f}"


def shown(entry, results):
    """"–": the measurement has no such value; empty: not measured yet."""
    number = number_of(entry, results)
    if number is not None:
        return format_figure(number)
    if not isinstance(entry, Entry):
        return entry
    missing = [cell for cell in entry.cells if not results.has(cell)]
    if any(cell in results.failures for cell in missing):
        return "failed"
    return "" if missing else "–"


def markdown_row(texts):
    return "|" + "".join(" " + text.replace("|", "\\|") + " |" for text in texts) + "\n"


def markdown_of(table, results):
    head = markdown_row(table.columns) + "|" + len(table.columns) * "---|" + "\n"
    return head + "".join(markdown_row(shown(entry, results) for entry in row) for row in table.rows)


def csv_of(table, results):
    """Numbers in full; missing numbers are empty."""
    def text(entry):
        number = number_of(entry, results)
        if number is not None:
            return f"{number:.9g}"
        return "" if isinstance(entry, Entry) else entry
    frame = pandas.DataFrame([[text(entry) for entry in row] for row in table.rows], columns=table.columns)
    return frame.to_csv(index=False, lineterminator="\n")
