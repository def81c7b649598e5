"""Texts of the systemd user units of a deployment; pure."""
