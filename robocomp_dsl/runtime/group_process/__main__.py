"""`python -m robocomp_dsl.runtime.group_process`."""

from robocomp_dsl.runtime.component.process_exit import exit_with
from robocomp_dsl.runtime.group_process.main import main

if __name__ == "__main__":
    code = main()
    exit_with(code)
    raise SystemExit(code)
