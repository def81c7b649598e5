"""Bottle definitions: `.bottle` files, which describe the items of a message of YARP."""
