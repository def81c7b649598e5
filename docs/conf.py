"""Settings of Sphinx for the documentation site; `python -m docs.build_site` runs it."""

from robocomp_dsl import __version__

project = "robocomp_dsl"
author = "the robocomp_dsl authors"
release = version = __version__
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx_click", "docs.docstrings"]
root_doc = "index"
exclude_patterns = ["generators", "*.py"]

html_theme = "furo"
html_title = "robocomp_dsl"
html_copy_source = False
html_show_copyright = False
html_theme_options = {"navigation_with_keys": True}

myst_heading_anchors = 3
myst_enable_extensions = ["deflist", "attrs_block"]
suppress_warnings = ["myst.header"]  # generated documentation opens a page with its path

default_role = "code"  # docstrings write `name` as Markdown does
autodoc_typehints = "signature"
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
nitpicky = False
