"""Measured figures: every `bench_*.py` here has `run()`, which gives its figures as dictionaries.

A figure has `name`, `value`, `unit`, and, where the project set itself one, a `goal`; `better` is
"lower" (the default) or "higher". Ratios are of things run side by side, in turns, in one run.
"""
