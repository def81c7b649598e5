"""From a resolved deployment to running processes.

`plan` (pure) says what to start and how; `preflight` says what this machine lacks for it; `session`
runs it with an engine; `folder` and `control` let other terminals find it and talk to it.
"""
