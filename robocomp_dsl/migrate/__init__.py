"""Existing RoboComp components and deployments become ours. Nothing of the old is changed."""
