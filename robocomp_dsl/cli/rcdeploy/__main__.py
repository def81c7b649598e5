"""`python -m robocomp_dsl.cli.rcdeploy`."""

from robocomp_dsl.cli.rcdeploy.main import main

main()
