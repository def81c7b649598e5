"""The target language Python: `component_files` lists the files of a component."""
