"""What is copied to hosts: a tree of files per component, and its Python environment.

`describe.py` and `lock.py` say what a host needs, `survey.py` what it lacks, `upload.py` and
`install.py` bring it there, `collect.py` deletes what no version uses. `on_host.py` runs there.
"""
