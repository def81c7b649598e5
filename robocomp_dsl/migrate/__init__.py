"""Migrate existing RoboComp components and deployments. `migration` lists the stages."""
