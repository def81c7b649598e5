"""Every kind of finding of the syntax stage, family by family: what `rcgen explain` shows."""

from robocomp_dsl.syntax.codes_file import *  # noqa: F403 - the families have no names in common
from robocomp_dsl.syntax.codes_form import *  # noqa: F403
from robocomp_dsl.syntax.codes_legacy import *  # noqa: F403
from robocomp_dsl.syntax.codes_xml import *  # noqa: F403
