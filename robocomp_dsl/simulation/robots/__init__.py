"""Simulated humanoids, built of boxes, balls and capsules from published numbers.

`links` holds the nouns, `nao` and `icub` the robots as data, `build` makes a MuJoCo model of them,
`descriptions/` their generic arms and skins. Lengths in m, masses in kg, angles in rad.
"""
