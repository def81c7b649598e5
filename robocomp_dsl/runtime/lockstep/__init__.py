"""Lock-step: of all components of a deployment one acts at a time, in the same order in every run.

The source lets the others compute one after the other (`conductor`, `follower`); a publication and
a command have been handled when they return (`ports`). So the order of everything that happens
depends on the descriptions and on what the components do, not on processors and networks.
"""
