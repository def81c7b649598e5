"""Turns a resolved deployment into running processes.

`plan` (pure) computes the processes; `preflight` checks this machine; `session` runs the plan with
a supervisor; `instances` and `control` let other terminals find the deployment and control it.
"""
