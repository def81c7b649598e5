"""The listener as a program."""

from robocomp_dsl.runtime import main
from tests.monitors.components import Listener

if __name__ == "__main__":
    raise SystemExit(main(Listener))
