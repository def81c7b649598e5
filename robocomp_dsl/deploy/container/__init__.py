"""The first process of a container that runs one component."""
