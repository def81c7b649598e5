"""Bridges at run time: hubs that join messages, outputs that send them, counts."""
