"""Medians with spread, and ratios of pairs, for the table."""
import statistics


def format_number(number):
    """Three significant digits, all digits of large integers: 0.0123, 1.23, 12.3, 123, 12,345."""
    size = abs(number)
    if number == 0:
        return "0"
    if size < 0.9995:
        return f"{number:.3g}"
    if size < 9.995:
        return f"{number:.2f}"
    if size < 99.95:
        return f"{number:.1f}"
    return f"{number:,.0f}"


def with_spread(numbers):
    """"median (min … max)"; only the median for one number; empty for none."""
    if not numbers:
        return ""
    median = format_number(statistics.median(numbers))
    return median if len(numbers) == 1 else f"{median} ({format_number(min(numbers))} … {format_number(max(numbers))})"


def ratios_of_pairs(ours, theirs):
    """Terrane's value divided by the peer's, for each round that has both."""
    return [ours[number] / theirs[number] for number in sorted(ours) if theirs.get(number)]
