"""The documentation: Markdown pages, and what builds the site from them."""
