#!/usr/bin/env python3
"""Each command and output of tools/first_minutes is quoted from its page of docs/start, and the page has the steps; nothing
is run. Usage: first_minutes_test.py ROOT"""
import ast
import pathlib
import sys
import unittest

ROOT = pathlib.Path(sys.argv.pop(1))
QUOTING = ("quoted", "run", "prints")  # methods of Page whose arguments are in the page


def calls(name):
    """(function, method, constant arguments) of all calls of a page's methods in a file."""
    tree = ast.parse((ROOT / "tools" / "first_minutes" / name).read_text(encoding="utf-8"))
    for function in (node for node in tree.body if isinstance(node, ast.FunctionDef)):
        for node in ast.walk(function):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and \
                    isinstance(node.func.value, ast.Name) and node.func.value.id == "page":
                yield function.name, node.func.attr, [a.value for a in node.args if isinstance(a, ast.Constant)]


def all_calls():
    for name in ("windows.py", "without_windows.py"):
        for function, method, arguments in calls(name):
            yield function.removesuffix("_steps"), method, arguments


class FirstMinutes(unittest.TestCase):
    def page(self, name):
        return (ROOT / "docs" / "start" / f"{name}.md").read_text(encoding="utf-8")

    def test_what_is_quoted_is_in_its_page(self):
        quotes = [(page, text) for page, method, arguments in all_calls() if method in QUOTING for text in arguments]
        self.assertGreater(len(quotes), 40)
        for page, text in quotes:
            self.assertIn(" ".join(text.split()), " ".join(self.page(page).split()), page)

    def test_the_pages_have_the_steps(self):
        steps = [(page, str(number)) for page, method, arguments in all_calls() if method == "step" for number in arguments]
        self.assertGreater(len(steps), 25)
        for page, number in steps:
            self.assertRegex(self.page(page), rf"(?m)^## {number}\. ")

    def test_every_page_is_tried(self):
        tried = {page for page, _, _ in all_calls()}
        pages = {path.stem for path in (ROOT / "docs" / "start").glob("*.md")}
        self.assertLessEqual(pages, tried)


if __name__ == "__main__":
    unittest.main()
