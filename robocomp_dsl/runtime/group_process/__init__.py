"""Runs the components of a group in one process; `python -m robocomp_dsl.runtime.group_process`."""
