"""A process that has imported the runtime and forks into components: they start faster."""
