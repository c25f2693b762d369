"""results.jsonl: the settings, then a line for each tried change.

A truncated line is skipped, and its change is tried again."""

import json
from dataclasses import asdict, dataclass, field

from . import BadInput
from .places import Place

OUTCOMES = ("noticed", "timed_out", "not_noticed", "not_compiled")


@dataclass
class Result:
    place: Place
    outcome: str  # one of OUTCOMES
    before: str  # the line
    after: str
    by: str = ""  # the test that detected it, or the compiler's first error
    programs: list = field(default_factory=list)  # that ran
    is_wide: bool = False  # a header that many files include: only the module's own program was built
    build_seconds: float = 0.0
    test_seconds: float = 0.0
    place_now: "Place | None" = None  # its place in newer sources, if it was tried again


def from_json(value):
    value = dict(value, place=Place(**value["place"]))
    if value.get("place_now"):
        value["place_now"] = Place(**value["place_now"])
    result = Result(**value)
    if result.outcome not in OUTCOMES:
        raise ValueError(result.outcome)
    return result


class Results:
    def __init__(self, path):
        self.path = path
        self.settings = None
        self.tried = []

    def read(self):
        try:
            with open(self.path, encoding="utf-8", errors="replace") as file:
                lines = file.read().split("\n")
        except FileNotFoundError:
            return self
        for line in lines:
            try:
                value = json.loads(line)
                if "settings" in value:
                    self.settings = value["settings"]
                else:
                    self.tried.append(from_json(value))
            except (ValueError, TypeError, KeyError):
                continue
        if self.settings is None and self.tried:
            raise BadInput(f"{self.path}: has no line of settings")
        return self

    def begin(self, settings):
        self.settings = settings
        self.append({"settings": settings})

    def add(self, result):
        self.tried.append(result)
        self.append(asdict(result))

    def append(self, value):
        is_cut = False
        if self.path.exists() and self.path.stat().st_size:
            with open(self.path, "rb") as file:
                file.seek(-1, 2)
                is_cut = file.read(1) != b"\n"
        with open(self.path, "a", encoding="utf-8") as file:
            file.write("\n" * is_cut + json.dumps(value, ensure_ascii=False) + "\n")

    def first_tries(self):
        return [result for result in self.tried if result.place_now is None]

    def latest(self):
        """The last result of each change."""
        return list({result.place: result for result in self.tried}.values())
