"""Fuzzing of all parsers and checks; `make fuzz` runs it for minutes, the tests for seconds."""
