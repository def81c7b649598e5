"""From text to tree, one parser per language. `parse` has a function for each."""
