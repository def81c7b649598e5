" Vim syntax file: DDSL of RoboComp
" Written by `python -m editors.highlight` from the grammars; do not edit.

if exists("b:current_syntax")
  finish
endif
let s:cpo_save = &cpo
set cpo&vim

syn case ignore
syn match ddslOperator contained /->\|=>\|::\|[=:<>+.-]/
syn match ddslText contained /\h\w*/
syn match ddslNumber contained /\%(\<0[xX]\x\+\|[-+]\=\%(\<\d\+\.\=\d*\|\.\d\+\)\%([eE][-+]\=\d\+\)\=\)\>\=/
syn match ddslTruth contained /\<\%(false\|true\)\>/
syn match ddslUnit contained /\%(\<\d\+\.\=\d*\s*\)\@<=\<\%(min\|ms\|s\|h\)\>/
syn region ddslString start=/"/ skip=/\\./ end=/"/ end=/$/
syn cluster ddslAny contains=ddslOperator,ddslFunction,ddslText,ddslNumber,ddslType,ddslTruth,ddslUnit,ddslPattern,ddslValue,ddslString
hi def link ddsl_plain_inner ddslModifier
hi def link ddsl_plain_value ddslValue
hi def link ddsl_plain_name ddslName
hi def link ddsl_plain_field ddslField
syn region ddsl_plain start=/\ze[A-Za-z_[:]/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_plain_inner,ddsl_plain_value,ddsl_plain_name,ddsl_plain_field
syn match ddsl_Deployment_name contained /\%(\<Deployment\s\+\)\@<=\h\w*/
hi def link ddsl_Deployment_inner ddslModifier
hi def link ddsl_Deployment_value ddslValue
hi def link ddsl_Deployment_name ddslName
hi def link ddsl_Deployment_field ddslField
syn region ddsl_Deployment matchgroup=ddslDeclaration start=/\<Deployment\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_Deployment_inner,ddsl_Deployment_value,ddsl_Deployment_name,ddsl_Deployment_field
hi def link ddsl_address_inner ddslModifier
hi def link ddsl_address_value ddslValue
hi def link ddsl_address_name ddslName
hi def link ddsl_address_field ddslField
syn region ddsl_address matchgroup=ddslKeyword start=/\<address\>\%(\s*\%("\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_address_inner,ddsl_address_value,ddsl_address_name,ddsl_address_field
hi def link ddsl_after_inner ddslModifier
hi def link ddsl_after_value ddslValue
hi def link ddsl_after_name ddslName
hi def link ddsl_after_field ddslField
syn region ddsl_after matchgroup=ddslKeyword start=/\<after\>\%(\s*\%([-+.0-9]\|\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_after_inner,ddsl_after_value,ddsl_after_name,ddsl_after_field
syn match ddsl_arbitrate_name contained /\%(\<arbitrate\s\+\)\@<=\h\w*/
hi def link ddsl_arbitrate_inner ddslModifier
hi def link ddsl_arbitrate_value ddslValue
hi def link ddsl_arbitrate_name ddslName
hi def link ddsl_arbitrate_field ddslField
syn region ddsl_arbitrate matchgroup=ddslDeclaration start=/\<arbitrate\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_arbitrate_inner,ddsl_arbitrate_value,ddsl_arbitrate_name,ddsl_arbitrate_field
syn match ddsl_attach_inner contained /\.\@<!\<to\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
hi def link ddsl_attach_inner ddslModifier
hi def link ddsl_attach_value ddslValue
hi def link ddsl_attach_name ddslName
hi def link ddsl_attach_field ddslField
syn region ddsl_attach matchgroup=ddslKeyword start=/\<attach\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_attach_inner,ddsl_attach_value,ddsl_attach_name,ddsl_attach_field
hi def link ddsl_best_effort_inner ddslModifier
hi def link ddsl_best_effort_value ddslValue
hi def link ddsl_best_effort_name ddslName
hi def link ddsl_best_effort_field ddslField
syn region ddsl_best_effort matchgroup=ddslKeyword start=/\<best_effort\>\%(\s*\%(;\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_best_effort_inner,ddsl_best_effort_value,ddsl_best_effort_name,ddsl_best_effort_field
syn match ddsl_clock_inner contained /\.\@<!\<from\>\.\@!\%(\s*\%("\|\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_clock_inner contained /\.\@<!\<limit\>\.\@!\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/
syn match ddsl_clock_inner contained /\.\@<!\<lockstep\>\.\@!\%(\s*\%(;\|\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_clock_inner contained /\.\@<!\<lost\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
hi def link ddsl_clock_inner ddslModifier
hi def link ddsl_clock_value ddslValue
hi def link ddsl_clock_name ddslName
hi def link ddsl_clock_field ddslField
syn region ddsl_clock matchgroup=ddslKeyword start=/\<clock\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_clock_inner,ddsl_clock_value,ddsl_clock_name,ddsl_clock_field
syn match ddsl_component_inner contained /\.\@<!\<label\>\.\@!\%(\s*\%(,\|;\|\h\|{\|\/[*\/]\|$\)\)\@=/
syn match ddsl_component_inner contained /\.\@<!\<on\>\.\@!\%(\s*\%(-\|\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_component_name contained /\%(\<component\s\+\)\@<=\h\w*/
hi def link ddsl_component_inner ddslModifier
hi def link ddsl_component_value ddslValue
hi def link ddsl_component_name ddslName
hi def link ddsl_component_field ddslField
syn region ddsl_component matchgroup=ddslDeclaration start=/\<component\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_component_inner,ddsl_component_value,ddsl_component_name,ddsl_component_field
hi def link ddsl_config_inner ddslModifier
hi def link ddsl_config_value ddslValue
hi def link ddsl_config_name ddslName
hi def link ddsl_config_field ddslField
syn region ddsl_config matchgroup=ddslKeyword start=/\<config\>\%(\s*\%("\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_config_inner,ddsl_config_value,ddsl_config_name,ddsl_config_field
syn match ddsl_connect_inner contained /\.\@<!\<carrier\>\.\@!\%(\s*\%("\|\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_connect_inner contained /\.\@<!\<over\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
hi def link ddsl_connect_inner ddslModifier
hi def link ddsl_connect_value ddslValue
hi def link ddsl_connect_name ddslName
hi def link ddsl_connect_field ddslField
syn region ddsl_connect matchgroup=ddslDeclaration start=/\<connect\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_connect_inner,ddsl_connect_value,ddsl_connect_name,ddsl_connect_field
hi def link ddsl_context_inner ddslModifier
hi def link ddsl_context_value ddslValue
hi def link ddsl_context_name ddslName
hi def link ddsl_context_field ddslField
syn region ddsl_context matchgroup=ddslKeyword start=/\<context\>\%(\s*\%("\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_context_inner,ddsl_context_value,ddsl_context_name,ddsl_context_field
hi def link ddsl_cores_inner ddslModifier
hi def link ddsl_cores_value ddslValue
hi def link ddsl_cores_name ddslName
hi def link ddsl_cores_field ddslField
syn region ddsl_cores matchgroup=ddslKeyword start=/\<cores\>\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_cores_inner,ddsl_cores_value,ddsl_cores_name,ddsl_cores_field
hi def link ddsl_cpu_inner ddslModifier
hi def link ddsl_cpu_value ddslValue
hi def link ddsl_cpu_name ddslName
hi def link ddsl_cpu_field ddslField
syn region ddsl_cpu matchgroup=ddslKeyword start=/\<cpu\>\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_cpu_inner,ddsl_cpu_value,ddsl_cpu_name,ddsl_cpu_field
hi def link ddsl_deadline_inner ddslModifier
hi def link ddsl_deadline_value ddslValue
hi def link ddsl_deadline_name ddslName
hi def link ddsl_deadline_field ddslField
syn region ddsl_deadline matchgroup=ddslKeyword start=/\<deadline\>\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_deadline_inner,ddsl_deadline_value,ddsl_deadline_name,ddsl_deadline_field
hi def link ddsl_depth_inner ddslModifier
hi def link ddsl_depth_value ddslValue
hi def link ddsl_depth_name ddslName
hi def link ddsl_depth_field ddslField
syn region ddsl_depth matchgroup=ddslKeyword start=/\<depth\>\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_depth_inner,ddsl_depth_value,ddsl_depth_name,ddsl_depth_field
syn match ddsl_device_name contained /\%(\<device\s\+\)\@<=\h\w*/
hi def link ddsl_device_inner ddslModifier
hi def link ddsl_device_value ddslValue
hi def link ddsl_device_name ddslName
hi def link ddsl_device_field ddslField
syn region ddsl_device matchgroup=ddslDeclaration start=/\<device\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_device_inner,ddsl_device_value,ddsl_device_name,ddsl_device_field
hi def link ddsl_env_inner ddslModifier
hi def link ddsl_env_value ddslValue
hi def link ddsl_env_name ddslName
hi def link ddsl_env_field ddslField
syn region ddsl_env matchgroup=ddslKeyword start=/\<env\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_env_inner,ddsl_env_value,ddsl_env_name,ddsl_env_field
hi def link ddsl_executable_inner ddslModifier
hi def link ddsl_executable_value ddslValue
hi def link ddsl_executable_name ddslName
hi def link ddsl_executable_field ddslField
syn region ddsl_executable matchgroup=ddslKeyword start=/\<executable\>\%(\s*\%("\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_executable_inner,ddsl_executable_value,ddsl_executable_name,ddsl_executable_field
syn match ddsl_export_inner contained /\.\@<!\<as\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_export_inner contained /\.\@<!\<from\>\.\@!\%(\s*\%("\|\h\|\/[*\/]\|$\)\)\@=/
hi def link ddsl_export_inner ddslModifier
hi def link ddsl_export_value ddslValue
hi def link ddsl_export_name ddslName
hi def link ddsl_export_field ddslField
syn region ddsl_export matchgroup=ddslKeyword start=/\<export\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_export_inner,ddsl_export_value,ddsl_export_name,ddsl_export_field
syn match ddsl_extern_inner contained /\.\@<!\<at\>\.\@!\%(\s*\%("\|\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_extern_inner contained /\.\@<!\<implements\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_extern_inner contained /\.\@<!\<over\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_extern_inner contained /\.\@<!\<publishes\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_extern_inner contained /\.\@<!\<requires\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_extern_inner contained /\.\@<!\<subscribesTo\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
hi def link ddsl_extern_inner ddslModifier
hi def link ddsl_extern_value ddslValue
hi def link ddsl_extern_name ddslName
hi def link ddsl_extern_field ddslField
syn region ddsl_extern matchgroup=ddslKeyword start=/\<extern\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_extern_inner,ddsl_extern_value,ddsl_extern_name,ddsl_extern_field
hi def link ddsl_files_inner ddslModifier
hi def link ddsl_files_value ddslValue
hi def link ddsl_files_name ddslName
hi def link ddsl_files_field ddslField
syn region ddsl_files matchgroup=ddslKeyword start=/\<files\>\%(\s*\%("\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_files_inner,ddsl_files_value,ddsl_files_name,ddsl_files_field
syn match ddsl_from_inner contained /\.\@<!\<and\>\.\@!\%(\s*\%((\|\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_from_inner contained /\.\@<!\<not\>\.\@!\%(\s*\%((\|\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_from_inner contained /\.\@<!\<or\>\.\@!\%(\s*\%((\|\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_from_inner contained /\.\@<!\<when\>\.\@!\%(\s*\%((\|\h\|\/[*\/]\|$\)\)\@=/
hi def link ddsl_from_inner ddslModifier
hi def link ddsl_from_value ddslValue
hi def link ddsl_from_name ddslName
hi def link ddsl_from_field ddslField
syn region ddsl_from matchgroup=ddslKeyword start=/\<from\>\%(\s*\%("\|\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_from_inner,ddsl_from_value,ddsl_from_name,ddsl_from_field
syn match ddsl_group_inner contained /\.\@<!\<label\>\.\@!\%(\s*\%(,\|;\|\h\|{\|\/[*\/]\|$\)\)\@=/
syn match ddsl_group_inner contained /\.\@<!\<on\>\.\@!\%(\s*\%(-\|\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_group_name contained /\%(\<group\s\+\)\@<=\h\w*/
hi def link ddsl_group_inner ddslModifier
hi def link ddsl_group_value ddslValue
hi def link ddsl_group_name ddslName
hi def link ddsl_group_field ddslField
syn region ddsl_group matchgroup=ddslDeclaration start=/\<group\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_group_inner,ddsl_group_value,ddsl_group_name,ddsl_group_field
syn match ddsl_host_name contained /\%(\<host\s\+\)\@<=\h\w*/
hi def link ddsl_host_inner ddslModifier
hi def link ddsl_host_value ddslValue
hi def link ddsl_host_name ddslName
hi def link ddsl_host_field ddslField
syn region ddsl_host matchgroup=ddslDeclaration start=/\<host\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_host_inner,ddsl_host_value,ddsl_host_name,ddsl_host_field
hi def link ddsl_import_inner ddslModifier
hi def link ddsl_import_value ddslValue
hi def link ddsl_import_name ddslName
hi def link ddsl_import_field ddslField
syn region ddsl_import matchgroup=ddslKeyword start=/\<import\>\%(\s*\%("\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_import_inner,ddsl_import_value,ddsl_import_name,ddsl_import_field
hi def link ddsl_inprocess_inner ddslModifier
hi def link ddsl_inprocess_value ddslValue
hi def link ddsl_inprocess_name ddslName
hi def link ddsl_inprocess_field ddslField
syn region ddsl_inprocess matchgroup=ddslKeyword start=/\<inprocess\>\%(\s*\%(;\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_inprocess_inner,ddsl_inprocess_value,ddsl_inprocess_name,ddsl_inprocess_field
syn match ddsl_keep_inner contained /\.\@<!\<all\>\.\@!\%(\s*\%(;\|\/[*\/]\|$\)\)\@=/
syn match ddsl_keep_inner contained /\.\@<!\<last\>\.\@!\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/
hi def link ddsl_keep_inner ddslModifier
hi def link ddsl_keep_value ddslValue
hi def link ddsl_keep_name ddslName
hi def link ddsl_keep_field ddslField
syn region ddsl_keep matchgroup=ddslKeyword start=/\<keep\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_keep_inner,ddsl_keep_value,ddsl_keep_name,ddsl_keep_field
hi def link ddsl_labels_inner ddslModifier
hi def link ddsl_labels_value ddslValue
hi def link ddsl_labels_name ddslName
hi def link ddsl_labels_field ddslField
syn region ddsl_labels matchgroup=ddslKeyword start=/\<labels\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_labels_inner,ddsl_labels_value,ddsl_labels_name,ddsl_labels_field
hi def link ddsl_latched_inner ddslModifier
hi def link ddsl_latched_value ddslValue
hi def link ddsl_latched_name ddslName
hi def link ddsl_latched_field ddslField
syn region ddsl_latched matchgroup=ddslKeyword start=/\<latched\>\%(\s*\%(;\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_latched_inner,ddsl_latched_value,ddsl_latched_name,ddsl_latched_field
hi def link ddsl_liveliness_inner ddslModifier
hi def link ddsl_liveliness_value ddslValue
hi def link ddsl_liveliness_name ddslName
hi def link ddsl_liveliness_field ddslField
syn region ddsl_liveliness matchgroup=ddslKeyword start=/\<liveliness\>\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_liveliness_inner,ddsl_liveliness_value,ddsl_liveliness_name,ddsl_liveliness_field
hi def link ddsl_memory_inner ddslModifier
hi def link ddsl_memory_value ddslValue
hi def link ddsl_memory_name ddslName
hi def link ddsl_memory_field ddslField
syn region ddsl_memory matchgroup=ddslKeyword start=/\<memory\>\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_memory_inner,ddsl_memory_value,ddsl_memory_name,ddsl_memory_field
syn match ddsl_middleware_value contained /\.\@<!\<\%(rmw_zenoh\|inproc\|local\|zenoh\|ros1\|ros2\|yarp\|dds\|ice\)\>/
hi def link ddsl_middleware_inner ddslModifier
hi def link ddsl_middleware_value ddslValue
hi def link ddsl_middleware_name ddslName
hi def link ddsl_middleware_field ddslField
syn region ddsl_middleware matchgroup=ddslKeyword start=/\<middleware\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_middleware_inner,ddsl_middleware_value,ddsl_middleware_name,ddsl_middleware_field
syn match ddsl_monitor_inner contained /\.\@<!\<at\>\.\@!\%(\s*\%("\|\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_monitor_inner contained /\.\@<!\<failure\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_monitor_inner contained /\.\@<!\<on\>\.\@!\%(\s*\%(-\|\h\|\/[*\/]\|$\)\)\@=/
hi def link ddsl_monitor_inner ddslModifier
hi def link ddsl_monitor_value ddslValue
hi def link ddsl_monitor_name ddslName
hi def link ddsl_monitor_field ddslField
syn region ddsl_monitor matchgroup=ddslDeclaration start=/\<monitor\>\%(\s*\%("\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_monitor_inner,ddsl_monitor_value,ddsl_monitor_name,ddsl_monitor_field
syn match ddsl_on_inner contained /\.\@<!\<by\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_on_inner contained /\.\@<!\<level\>\.\@!\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/
hi def link ddsl_on_inner ddslModifier
hi def link ddsl_on_value ddslValue
hi def link ddsl_on_name ddslName
hi def link ddsl_on_field ddslField
syn region ddsl_on matchgroup=ddslKeyword start=/\<on\>\%(\s*\%(-\|\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_on_inner,ddsl_on_value,ddsl_on_name,ddsl_on_field
syn match ddsl_place_inner contained /\.\@<!\<by\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_place_inner contained /\.\@<!\<label\>\.\@!\%(\s*\%(,\|;\|\h\|{\|\/[*\/]\|$\)\)\@=/
syn match ddsl_place_inner contained /\.\@<!\<load\>\.\@!\%(\s*\%(;\|\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_place_inner contained /\.\@<!\<on\>\.\@!\%(\s*\%(-\|\h\|\/[*\/]\|$\)\)\@=/
hi def link ddsl_place_inner ddslModifier
hi def link ddsl_place_value ddslValue
hi def link ddsl_place_name ddslName
hi def link ddsl_place_field ddslField
syn region ddsl_place matchgroup=ddslKeyword start=/\<place\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_place_inner,ddsl_place_value,ddsl_place_name,ddsl_place_field
syn match ddsl_port_inner contained /\.\@<!\<at\>\.\@!\%(\s*\%("\|\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_port_inner contained /\.\@<!\<over\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
hi def link ddsl_port_inner ddslModifier
hi def link ddsl_port_value ddslValue
hi def link ddsl_port_name ddslName
hi def link ddsl_port_field ddslField
syn region ddsl_port matchgroup=ddslKeyword start=/\<port\>\%(\s*\%([-+.0-9]\|\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_port_inner,ddsl_port_value,ddsl_port_name,ddsl_port_field
hi def link ddsl_prefix_inner ddslModifier
hi def link ddsl_prefix_value ddslValue
hi def link ddsl_prefix_name ddslName
hi def link ddsl_prefix_field ddslField
syn region ddsl_prefix matchgroup=ddslKeyword start=/\<prefix\>\%(\s*\%("\|\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_prefix_inner,ddsl_prefix_value,ddsl_prefix_name,ddsl_prefix_field
syn match ddsl_priority_value contained /\.\@<!\<\%(background\|realtime\|normal\|high\|low\)\>/
hi def link ddsl_priority_inner ddslModifier
hi def link ddsl_priority_value ddslValue
hi def link ddsl_priority_name ddslName
hi def link ddsl_priority_field ddslField
syn region ddsl_priority matchgroup=ddslKeyword start=/\<priority\>\%(\s*\%([-+.0-9]\|\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_priority_inner,ddsl_priority_value,ddsl_priority_name,ddsl_priority_field
syn match ddsl_program_inner contained /\.\@<!\<label\>\.\@!\%(\s*\%(,\|;\|\h\|{\|\/[*\/]\|$\)\)\@=/
syn match ddsl_program_inner contained /\.\@<!\<on\>\.\@!\%(\s*\%(-\|\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_program_name contained /\%(\<program\s\+\)\@<=\h\w*/
hi def link ddsl_program_inner ddslModifier
hi def link ddsl_program_value ddslValue
hi def link ddsl_program_name ddslName
hi def link ddsl_program_field ddslField
syn region ddsl_program matchgroup=ddslDeclaration start=/\<program\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_program_inner,ddsl_program_value,ddsl_program_name,ddsl_program_field
syn match ddsl_ready_inner contained /\.\@<!\<after\>\.\@!\%(\s*\%([-+.0-9]\|\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_ready_inner contained /\.\@<!\<answers\>\.\@!\%(\s*\%(;\|\/[*\/]\|$\)\)\@=/
syn match ddsl_ready_inner contained /\.\@<!\<log\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_ready_inner contained /\.\@<!\<matches\>\.\@!\%(\s*\%("\|\/[*\/]\|$\)\)\@=/
syn match ddsl_ready_inner contained /\.\@<!\<port\>\.\@!\%(\s*\%([-+.0-9]\|\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_ready_inner contained /\.\@<!\<when\>\.\@!\%(\s*\%((\|\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_ready_inner contained /\.\@<!\<within\>\.\@!\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/
hi def link ddsl_ready_inner ddslModifier
hi def link ddsl_ready_value ddslValue
hi def link ddsl_ready_name ddslName
hi def link ddsl_ready_field ddslField
syn region ddsl_ready matchgroup=ddslKeyword start=/\<ready\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_ready_inner,ddsl_ready_value,ddsl_ready_name,ddsl_ready_field
syn match ddsl_realtime_inner contained /\.\@<!\<priority\>\.\@!\%(\s*\%([-+.0-9]\|\h\|\/[*\/]\|$\)\)\@=/
hi def link ddsl_realtime_inner ddslModifier
hi def link ddsl_realtime_value ddslValue
hi def link ddsl_realtime_name ddslName
hi def link ddsl_realtime_field ddslField
syn region ddsl_realtime matchgroup=ddslKeyword start=/\<realtime\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_realtime_inner,ddsl_realtime_value,ddsl_realtime_name,ddsl_realtime_field
hi def link ddsl_reliable_inner ddslModifier
hi def link ddsl_reliable_value ddslValue
hi def link ddsl_reliable_name ddslName
hi def link ddsl_reliable_field ddslField
syn region ddsl_reliable matchgroup=ddslKeyword start=/\<reliable\>\%(\s*\%(;\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_reliable_inner,ddsl_reliable_value,ddsl_reliable_name,ddsl_reliable_field
syn match ddsl_restart_inner contained /\.\@<!\<in\>\.\@!\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/
syn match ddsl_restart_inner contained /\.\@<!\<max\>\.\@!\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/
syn match ddsl_restart_inner contained /\.\@<!\<on\>\.\@!\%(\s*\%(-\|\h\|\/[*\/]\|$\)\)\@=/
syn match ddsl_restart_value contained /\.\@<!\<\%(on-failure\|always\|never\)\>/
hi def link ddsl_restart_inner ddslModifier
hi def link ddsl_restart_value ddslValue
hi def link ddsl_restart_name ddslName
hi def link ddsl_restart_field ddslField
syn region ddsl_restart matchgroup=ddslKeyword start=/\<restart\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_restart_inner,ddsl_restart_value,ddsl_restart_name,ddsl_restart_field
hi def link ddsl_set_inner ddslModifier
hi def link ddsl_set_value ddslValue
hi def link ddsl_set_name ddslName
hi def link ddsl_set_field ddslField
syn region ddsl_set matchgroup=ddslKeyword start=/\<set\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_set_inner,ddsl_set_value,ddsl_set_name,ddsl_set_field
syn match ddsl_thread_inner contained /\.\@<!\<priority\>\.\@!\%(\s*\%([-+.0-9]\|\h\|\/[*\/]\|$\)\)\@=/
hi def link ddsl_thread_inner ddslModifier
hi def link ddsl_thread_value ddslValue
hi def link ddsl_thread_name ddslName
hi def link ddsl_thread_field ddslField
syn region ddsl_thread matchgroup=ddslKeyword start=/\<thread\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_thread_inner,ddsl_thread_value,ddsl_thread_name,ddsl_thread_field
hi def link ddsl_user_inner ddslModifier
hi def link ddsl_user_value ddslValue
hi def link ddsl_user_name ddslName
hi def link ddsl_user_field ddslField
syn region ddsl_user matchgroup=ddslKeyword start=/\<user\>\%(\s*\%("\|\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_user_inner,ddsl_user_value,ddsl_user_name,ddsl_user_field
hi def link ddsl_watchdog_inner ddslModifier
hi def link ddsl_watchdog_value ddslValue
hi def link ddsl_watchdog_name ddslName
hi def link ddsl_watchdog_field ddslField
syn region ddsl_watchdog matchgroup=ddslKeyword start=/\<watchdog\>\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@ddslAny,ddslComment,ddslDoc,ddsl_watchdog_inner,ddsl_watchdog_value,ddsl_watchdog_name,ddsl_watchdog_field
syn match ddslComment ,//.*,
syn match ddslComment /#.*/
syn match ddslDoc ,///[/<]\@!.*,
syn region ddslComment start=,/\*, end=,\*/,
syn region ddslDoc start=,/\*\*[*/<]\@!, end=,\*/,
hi def link ddslKeyword Statement
hi def link ddslDeclaration Structure
hi def link ddslModifier Keyword
hi def link ddslLegacy Todo
hi def link ddslValue Constant
hi def link ddslTruth Boolean
hi def link ddslType Type
hi def link ddslPattern PreProc
hi def link ddslNumber Number
hi def link ddslUnit Special
hi def link ddslString String
hi def link ddslComment Comment
hi def link ddslDoc SpecialComment
hi def link ddslOperator Operator
hi def link ddslName Identifier
hi def link ddslField Identifier
hi def link ddslFunction Function

syn sync minlines=200
let b:current_syntax = "ddsl"
let &cpo = s:cpo_save
unlet s:cpo_save
