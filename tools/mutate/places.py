"""Finds the operators and constants that can be changed.

Relies on clang-format: an operator with two operands has white space on both sides, the brackets of a template, a
reference, a pointer and a sign do not."""

import re
from bisect import bisect_right
from dataclasses import dataclass

from .tokens import tokens_of

PAIRS = (("<", "<="), (">", ">="), ("==", "!="), ("+", "-"), ("*", "/"), ("&&", "||"), ("&", "|"), ("<<", ">>"))
BINARY = {**dict(PAIRS), **{right: left for left, right in PAIRS}}
UNARY = {"++": "--", "--": "++", "!": ""}
WORDS = {"true": "false", "false": "true"}
ONE = re.compile(r"1(?=(\.0?)?[uUlLfFzZ]*\Z)")  # 1, 1u, 1.0F

# Calls whose arguments are not changed: assertions, messages of the log and of errors.
LEFT_ALONE = re.compile(r"(static_)?assert|TERRANE_(ASSERT|ZONE)\w*|log(Info|Warning|Error)|logProblems?|noexcept"
                        r"|fail|error|failure|problem|refuse|damaged|damagedStructure")


@dataclass(frozen=True)
class Place:
    module: str
    file: str  # relative to the root of the sources
    line: int  # from 1
    column: int  # from 0, in characters
    old: str
    new: str


def code_tokens(source):
    """Tokens without the arguments of assertions and messages, and without constraints of templates."""
    kept, depth, is_constraint = [], 0, False
    for token in tokens_of(source):
        if depth:
            depth += {"(": 1, ")": -1}.get(token.text, 0)
        elif is_constraint:
            is_constraint = token.text not in ("{", ";")
        elif token.text == "(" and kept and kept[-1].kind == "word" and LEFT_ALONE.fullmatch(kept[-1].text):
            depth = 1
        else:
            is_constraint = token.text in ("requires", "concept")
            kept.append(token)
    return kept


def changes_of(source):
    """Offset, old and new text of each possible change, in the order of the file."""
    tokens = code_tokens(source)
    for k, token in enumerate(tokens):
        before = tokens[k - 1].text if k else ""
        if before == "operator":
            continue  # its declaration
        neighbors = tokens[max(k - 1, 0):k + 2]
        if token.kind == "word" and token.text in WORDS:
            yield token.start, token.text, WORDS[token.text]
        elif token.kind == "number" and before == "+" and ONE.match(token.text) and is_binary(source, tokens[k - 1]):
            yield token.start, token.text, "2" + token.text[1:]
        elif token.kind == "operator" and token.text in UNARY:
            yield token.start, token.text, UNARY[token.text]
        elif token.text in BINARY and is_binary(source, token) and all(t.kind != "string" for t in neighbors):
            yield token.start, token.text, BINARY[token.text]


def is_binary(source, token):
    return source[token.start - 1:token.start].isspace() and source[token.end:token.end + 1].isspace()


def line_starts(source):
    return [0] + [match.end() for match in re.finditer("\n", source)]


def places_of_file(module, file, source):
    starts = line_starts(source)
    for offset, old, new in changes_of(source):
        line = bisect_right(starts, offset)
        yield Place(module, file, line, offset - starts[line - 1], old, new)


def modules_of(root):
    """All modules of the library, and the program, which is called app."""
    return ["app"] + sorted(path.name for path in (root / "terrane").iterdir() if path.is_dir())


def folder_of(root, module):
    return root / "apps" / "terrane" if module == "app" else root / "terrane" / module


def places_of_module(root, module):
    """All places of the module, and its lines of code: those with a token."""
    places, line_count = [], 0
    for path in sorted(path for path in folder_of(root, module).rglob("*") if path.suffix in (".h", ".cpp")):
        source = read_source(path)
        places += places_of_file(module, path.relative_to(root).as_posix(), source)
        starts = line_starts(source)
        line_count += len({bisect_right(starts, token.start) for token in tokens_of(source)})
    return places, line_count


def read_source(path):
    with open(path, encoding="utf-8", newline="") as file:
        return file.read()


def changed(source, place):
    """The source with the change, and the line before and after it."""
    lines = source.split("\n")
    before = lines[place.line - 1]
    if before[place.column:place.column + len(place.old)] != place.old:
        raise ValueError(f"{place.file}:{place.line}: expected {place.old} in column {place.column + 1}")
    after = before[:place.column] + place.new + before[place.column + len(place.old):]
    lines[place.line - 1] = after
    return "\n".join(lines), before.strip(), after.strip()
