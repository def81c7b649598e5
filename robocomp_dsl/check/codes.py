"""Every kind of finding of the check stage, family by family: what `rcgen explain` shows."""

from robocomp_dsl.check.codes_body import *  # noqa: F403 - the families have no names in common
from robocomp_dsl.check.codes_clock import *  # noqa: F403
from robocomp_dsl.check.codes_deployment import *  # noqa: F403
from robocomp_dsl.check.codes_devices import *  # noqa: F403
from robocomp_dsl.check.codes_names import *  # noqa: F403
from robocomp_dsl.check.codes_parameters import *  # noqa: F403
from robocomp_dsl.check.codes_states import *  # noqa: F403
from robocomp_dsl.check.codes_tactile import *  # noqa: F403
from robocomp_dsl.check.codes_types import *  # noqa: F403
