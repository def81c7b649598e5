"""Describes a deployment for other systems: systemd, compose and Kubernetes."""
