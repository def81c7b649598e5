"""From a model to files: `plan` lists them and is pure, `write` is the only writer."""
