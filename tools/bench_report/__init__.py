"""The report of `terrane bench`; tools/bench_report.py is the program.

results.py reads measurements, cells.py has the command lines that identify them, *_tables.py describe each table as
data, text.py and plots.py write tables, report.py writes the report.
"""
