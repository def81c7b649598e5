"""Simulated humanoids, built of boxes, balls and capsules from published data.

`links` defines the data types, `nao` and `icub` the robots as data, `build` makes MuJoCo models,
`descriptions/` has their generic arms and skins. Lengths in m, masses in kg, angles in rad.
"""
