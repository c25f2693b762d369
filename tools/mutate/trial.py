"""Tries changes: builds the copy with one and runs the tests."""

from dataclasses import replace

from . import BadInput
from .places import changed, read_source
from .programs import MOST_OBJECTS, Program, programs_of, target_of
from .results import Result


class Trial:
    def __init__(self, tree, build, unchangeds, options):
        self.tree = tree  # the copy's root
        self.build = build
        self.unchangeds = unchangeds
        self.options = options  # of the command line: jobs and patience
        self.programs = {}  # names by module

    def prepare(self, modules, tell):
        """Builds all test programs of the modules and measures their tests, once."""
        targets = self.build.targets()
        self.programs = {module: programs_of(module, targets) for module in modules}
        for name in dict.fromkeys(name for names in self.programs.values() for name in names):
            built = self.build.build(target_of(name), limit_seconds=None)
            if not built.is_good:
                raise BadInput(f"{name} cannot be built unchanged: {built.error}")
            if name in self.unchangeds.by_program:
                continue
            unchanged = self.program(name).measure()
            self.unchangeds.add(name, unchanged)
            tell(f"{name}: built in {built.seconds:.0f} s; quick tests {unchanged.quick_seconds:.1f} s, "
                 f"{len(unchanged.slow)} others {unchanged.slow_seconds:.1f} s")
            if unchanged.failing:
                tell(f"{name}: left out, they fail unchanged: {', '.join(unchanged.failing)}")
        self.build.read_dependencies()

    def program(self, name):
        script = self.tree / "tests" / "app" / name if name.endswith(".py") else None
        return Program(self.build.folder / target_of(name), self.options.jobs, self.options.patience, script)

    def run(self, place):
        path = self.tree / place.file
        source = read_source(path)
        text, before, after = changed(source, place)
        result = Result(place, "not_noticed", before, after)
        result.is_wide = place.file.endswith(".h") and self.build.objects_of(place.file) > MOST_OBJECTS
        try:
            write_source(path, text)
            self.run_programs(result)
        finally:
            write_source(path, source)
        return result

    def run_programs(self, result):
        for name in self.programs[result.place.module][:1 if result.is_wide else None]:
            built = self.build.build(target_of(name))
            result.build_seconds = round(result.build_seconds + built.seconds, 1)
            if not built.is_good:
                result.outcome, result.by = "not_compiled", built.error
                return
            run = self.program(name).run(self.unchangeds.by_program[name])
            result.programs.append(name)
            result.test_seconds = round(result.test_seconds + run.seconds, 1)
            if run.kind != "passed":
                result.outcome, result.by = run.kind, f"{name} {run.test}".strip()
                return


def write_source(path, text):
    with open(path, "w", encoding="utf-8", newline="") as file:
        file.write(text)


def place_now(result, source):
    """The place of the result's line in newer sources; None if it is gone or not unique."""
    place = result.place
    lines = source.split("\n")
    same = [number for number, line in enumerate(lines, 1) if line.strip() == result.before]
    if place.line not in same and len(same) != 1:
        return None
    number = place.line if place.line in same else same[0]
    line = lines[number - 1]
    # The column is relative to the start of the text: the indentation may have changed.
    for column in range(len(line)):
        changed_line = line[:column] + place.new + line[column + len(place.old):]
        if line.startswith(place.old, column) and changed_line.strip() == result.after:
            return replace(place, line=number, column=column)
    return None
