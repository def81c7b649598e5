"""Lock-step: one component of a deployment runs at a time, in the same order in every run.

The clock source runs the others one after the other (`coordinator`, `follower`); a publication or
command was handled when its call returns (`ports`). The order of all events therefore depends only
on the descriptions and the components, not on processors and networks.
"""
