"""Runs a plan: starts, monitors, restarts and stops the processes of one machine."""
