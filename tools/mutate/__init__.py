"""Mutation runs; tools/mutate.py is the program.

tokens.py splits C++ into tokens, places.py finds what can be changed, draw.py draws places, tree.py and build.py copy
and build the sources, programs.py says which test programs check which module and runs them, trial.py tries one change,
results.py keeps the results and report.py prints them.
"""


class BadInput(Exception):
    """One line that names the error and its place."""
