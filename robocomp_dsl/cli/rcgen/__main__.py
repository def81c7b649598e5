"""`python -m robocomp_dsl.cli.rcgen`."""

from robocomp_dsl.cli.rcgen.main import main

main()
