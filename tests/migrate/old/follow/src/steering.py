"""How to turn."""


def turn(nearest, threshold):
    return 0.6 if nearest < threshold else 0.0
