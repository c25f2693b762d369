"""The report of `terrane bench`; tools/bench_report.py is the program.

results.py reads measurements, cells.py has the command lines that they are found by, *_tables.py say as data what each
table shows, text.py and plots.py write tables, report.py puts all together.
"""
