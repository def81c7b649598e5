"""Chooses hosts for the components whose host the description leaves open. Pure.

host_load           the load of a host, and its score
one_host            which components must run on the same host
place               the choice: by label, by load
placement_choice    the result: choices with their numbers
placed_deployment   a deployment with other hosts
placement_text      the choices as text
"""
