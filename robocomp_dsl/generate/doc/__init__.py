"""Documentation of interfaces, components and deployments. `documentation` starts it."""
