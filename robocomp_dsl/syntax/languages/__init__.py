"""From text to tree, one builder per language."""
