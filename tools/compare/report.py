#!/usr/bin/env python3
"""Makes the tables of a comparison: FOLDER/report.md, and FOLDER/summary.md, a short table for a README.

    tools/compare/report.py FOLDER [-o DIR]

Reads FOLDER/results.jsonl, even while run.py still writes it: missing measurements are gaps. Exit code: 0, or 2 if
something cannot be read or written."""
import argparse
import pathlib
import statistics
import sys
import tomllib

from figures import format_number, ratios_of_pairs, with_spread
from measures import FLOORS, HIGHER, MEASURES, NEITHER
from results import BadInput, read_results

SIDES = {"terrane": "Terrane", "peer": "other"}
BOLD_ROUNDS = 3  # at least
PUBLISHED = pathlib.Path(__file__).with_name("published.toml")

EXPLANATION = """
Each figure is the median of the rounds, with the minimum and maximum in parentheses. The ratio is Terrane divided by the
other program in the same round, also as median, minimum and maximum. A round measures both programs in turn, and rounds
alternate which one is first. Each round uses the next of five seeds and places, so the spread includes differences between
places. A chunk is 16×16×256 blocks. Empty fields were not measured. The measured programs use all cores, so load averages up
to about the number of cores are normal; higher ones mean that other programs ran.
"""


def row(*texts):
    return "|" + "".join(f" {str(text).replace('|', chr(92) + '|')} |" for text in texts) + "\n"


def head(*texts):
    return row(*texts) + "|" + len(texts) * "---|" + "\n"


def bold_if_better(text, measure, ratios):
    """Marks a ratio by which Terrane is better in all rounds."""
    if len(ratios) < BOLD_ROUNDS or measure.better == NEITHER or measure in FLOORS:
        return text
    wins = all(ratio > 1 for ratio in ratios) if measure.better == HIGHER else all(ratio < 1 for ratio in ratios)
    return f"**{text}**" if wins else text


def main_table(results):
    text = head("measurement", "unit", "better", "Terrane", "other", "", "ratio of pairs", "rounds")
    for measure in MEASURES:
        ours, theirs = (results.values.get((measure.name, side), {}) for side in ("terrane", "peer"))
        if not ours and not theirs:
            continue
        ratios = ratios_of_pairs(ours, theirs)
        text += row(measure.title, measure.unit, {NEITHER: ""}.get(measure.better, measure.better),
                    with_spread(list(ours.values())), measure.peer, with_spread(list(theirs.values())),
                    bold_if_better(with_spread(ratios), measure, ratios), len(set(ours) | set(theirs)))
    return text


def methods_table(results):
    text = head("measurement", "Terrane", "other")
    for measure in MEASURES:
        if any((measure.name, side) in results.values for side in ("terrane", "peer")):
            text += row(measure.title, measure.ours, measure.theirs)
    return text


def about_table(results):
    text = head("", "")
    for part in ("machine", "versions", "settings"):
        for name, value in results.about.get(part, {}).items():
            text += row(name, value)
    if results.loads:
        text += row("load average before each measurement",
                    f"{with_spread(list(results.loads.values()))}, {len(results.loads)} measurements")
    return text


def loads_table(results):
    """Load averages before each job, of both sides."""
    if not results.loads:
        return ""
    jobs, rounds = (list(dict.fromkeys(key[part] for key in results.loads)) for part in (1, 0))
    text = "\n## Load averages\n\nAverages over the minute before each measurement: before Terrane, then before the other program.\n\n"
    text += head("round", *jobs)
    shown = lambda *key: f"{results.loads[key]:.2f}" if key in results.loads else "–"
    for number in sorted(rounds):
        text += row(number, *(f"{shown(number, job, 'terrane')}, {shown(number, job, 'peer')}" for job in jobs))
    return text


def places_table(results):
    """Openness of the views of both sides."""
    rounds = {side: results.details.get((job, side), {}) for job, side in sorted(results.details)
              for job in [job] if job.startswith("frames")}
    numbers = sorted({number for details in rounds.values() for number, place in details.items() if "openness" in place})
    if not numbers:
        return ""
    text = "\n## Places\n\nOpenness is the share of the ground within 256 blocks that is visible from the camera.\n\n"
    text += head("round", "Terrane: camera", "openness", "Luanti: camera", "openness")
    for number in numbers:
        fields = []
        for side in ("terrane", "peer"):
            place = rounds.get(side, {}).get(number, {})
            fields += [place.get("camera", ""), format_number(place["openness"]) if "openness" in place else ""]
        text += row(number, *fields)
    return text


def failures_list(results):
    lines = [f"- round {number}, {job}, {SIDES.get(side, side)}: {reason}\n"
             for (number, job, side), reason in sorted(results.failures.items())]
    lines += [f"- round {number}, {job}, {SIDES.get(side, side)}: the view was not complete after {details['fill_s']:.0f} s\n"
              for (job, side), rounds in sorted(results.details.items())
              for number, details in sorted(rounds.items()) if details.get("is_full") is False]
    if results.dropped:
        lines.append(f"- {results.dropped} lines of results.jsonl could not be read\n")
    return "\n## What failed\n\n" + "".join(lines) if lines else ""


def published_table(path=PUBLISHED):
    """Raises BadInput."""
    try:
        figures = tomllib.loads(path.read_text(encoding="utf-8"))["figure"]
        rows = [(f["program"], f["what"], f["figure"], f["machine"], f["by"], f["source"]) for f in figures]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise BadInput(f"{path}: cannot be read: {error}") from error
    text = "\n## Figures of others, not measured here\n\nThese programs did not run on this machine. Do not divide these " \
           "figures by those above: machines and loads differ.\n\n"
    return text + head("program", "what", "figure", "machine", "measured by", "source") + "".join(row(*r) for r in rows)


def report_of(results):
    text = "# Terrane beside other programs\n\n"
    if results.about.get("settings", {}).get("sizes") == "quick":
        text += "Sizes are those of `--quick`, which only shows that everything works.\n\n"
    text += about_table(results) + EXPLANATION + "\n## In turn on this machine\n\n" + main_table(results)
    text += "\nBold: Terrane is better in every round, of at least three.\n\n## What each side does\n\n" + methods_table(results)
    return text + places_table(results) + loads_table(results) + failures_list(results) + published_table()


def summary_of(results):
    text = head("", "Terrane", "others", "ratio of pairs")
    for measure in MEASURES:
        ours, theirs = (list(results.values.get((measure.name, side), {}).values()) for side in ("terrane", "peer"))
        if measure in FLOORS or measure.better == NEITHER or not ours or not theirs:
            continue
        ratios = ratios_of_pairs(*(results.values[measure.name, side] for side in ("terrane", "peer")))
        text += row(f"{measure.title}, {measure.unit}", format_number(statistics.median(ours)),
                    f"{measure.peer} {format_number(statistics.median(theirs))}", with_spread(ratios))
    return text


def write_report(folder, output):
    """Raises BadInput and OSError."""
    results = read_results(folder / "results.jsonl")
    texts = {"report.md": report_of(results), "summary.md": summary_of(results)}
    output.mkdir(parents=True, exist_ok=True)
    for name, text in texts.items():
        (output / name).write_text(text, encoding="utf-8")


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, metavar="DIR", help="where the report goes (FOLDER)")
    options = parser.parse_args(arguments)
    try:
        write_report(options.folder, options.output or options.folder)
    except BadInput as error:
        print(f"compare: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"compare: {error.filename}: cannot be written: {error.strerror}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
