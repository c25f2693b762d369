"""The tables as Markdown."""

from statistics import median

from .programs import MOST_OBJECTS, PROGRAMS


def report_of(results):
    """Reports the last result of each change."""
    latest = results.latest()
    compiled = [result for result in latest if result.outcome != "not_compiled"]
    modules = [module for module in results.settings["modules"] if any(r.place.module == module for r in latest)]
    lines = ["| module | places | noticed | of these by time-out | not noticed | share | not compiled |",
             "|---|---|---|---|---|---|---|"]
    lines += [row(module, [r for r in latest if r.place.module == module]) for module in modules]
    lines += [row("all", latest), ""]
    if compiled:
        seconds = [result.build_seconds + result.test_seconds for result in compiled]
        lines += [f"{len(compiled)} of {results.settings['count']} places; {median(seconds):.0f} s a place (median), "
                  f"{sum(r.build_seconds + r.test_seconds for r in results.tried) / 3600:.1f} h in all.", ""]
    lines += programs_table(modules, latest)
    lines += listing("Not noticed", [r for r in latest if r.outcome == "not_noticed"])
    lines += listing("Noticed by time-out", [r for r in latest if r.outcome == "timed_out"])
    return "\n".join(lines)


def row(name, results):
    count = {outcome: sum(result.outcome == outcome for result in results)
             for outcome in ("noticed", "timed_out", "not_noticed", "not_compiled")}
    noticed = count["noticed"] + count["timed_out"]
    places = noticed + count["not_noticed"]
    share = f"{100 * noticed / places:.1f} %" if places else "–"
    return (f"| {name} | {places} | {noticed} | {count['timed_out']} | {count['not_noticed']} | {share} "
            f"| {count['not_compiled']} |")


def programs_table(modules, results):
    lines = ["Test programs are built and run in this order, until one notices the change. For a header that more than "
             f"{MOST_OBJECTS} object files", "include, only the first one is.", "",
             "| module | programs | only the first one |", "|---|---|---|"]
    for module in modules:
        wide = sum(result.is_wide for result in results if result.place.module == module)
        lines.append(f"| {module} | {', '.join(PROGRAMS.get(module, (f'{module}_tests',)))} | {wide} |")
    return lines + [""]


def listing(title, results):
    if not results:
        return []
    lines = [f"## {title}", ""]
    for result in sorted(results, key=lambda r: (r.place.file, r.place.line, r.place.column)):
        place = result.place_now or result.place
        where = f" in {result.by}" if result.by else ""
        lines += [f"- {place.file}:{place.line}, column {place.column + 1}: `{place.old}` → `{place.new}`{where}", "",
                  f"      {result.before}", f"      {result.after}", ""]
    return lines
