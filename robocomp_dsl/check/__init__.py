"""The checks: from files to checked models. This page lists the passes; read it first.

In: the path of a file, a `Workspace` (unsaved editor buffers take precedence over the disk) and a
`Report`. Out: the model of the file, possibly partial. The report contains all diagnostics of the
file itself, and the errors of the files that it references.

    language    parsing           name resolution          rules                  entry point
    IDSL        parse_idsl        idsl/resolve             idsl/rules             ModuleLoader.load
    ROS         parse_ros         as IDSL                  as IDSL                ModuleLoader.load
    CDSL        parse_cdsl        cdsl/resolve             cdsl/rules             check_cdsl
    PDSL        parse_pdsl        pdsl/resolve             pdsl/rules             check_pdsl
    DDSL        parse_ddsl        ddsl/resolve             in the parts below     check_ddsl
    BDSL        parse_bdsl        bdsl/resolve             in the parts below     check_bdsl
    SMDSL       parse_smdsl       states/resolve_smdsl  states/rules_smdsl  check_state_machine
    SCXML       parse_scxml       states/resolve_scxml  states/rules        check_state_machine
    InnerModel  parse_innermodel  innermodel/resolve       innermodel/rules       check_innermodel
    tactile description (YAML, XML)                        innermodel/tactile     check_tactile

The parts of a deployment (`ddsl/`): components, instances, settings, devices, order, connections,
implicit_connections, clocks, groups; definitions of groups go through definitions, expansion and
check_definitions, groups in one process through one_process.
The parts of a bridge (`bdsl/`): declarations, ports, hubs, outputs, services; values go through
expressions (types, bottom up), fitting (type and unit of the target) and assignments.

The last pass, `causes`, leaves one finding for each mistake: without what follows from a syntax
error, and at the declaration that is misspelled or has no name.

Every pass continues after an error, so one run reports all of them. No check raises because of the
content of a file. `workspace/` caches everything that did not change since the last run.
"""
