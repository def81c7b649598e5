" Vim syntax file: BDSL of RoboComp
" Written by `python -m editors.highlight` from the grammars; do not edit.

if exists("b:current_syntax")
  finish
endif
let s:cpo_save = &cpo
set cpo&vim

syn case ignore
syn match bdslOperator contained /->\|=>\|::\|[=:+*\/.-]/
syn match bdslFunction contained /\h\w*\ze\s*(/
syn match bdslText contained /\h\w*\ze\%(\s*(\)\@!\>/
syn match bdslNumber contained /\%(\<0[xX]\x\+\|[-+]\=\%(\<\d\+\.\=\d*\|\.\d\+\)\%([eE][-+]\=\d\+\)\=\)\>\=/
syn match bdslType contained /\<\%(unsigned short\|unsigned long\|unsigned int\|double\|string\|float\|short\|bool\|byte\|long\|int\)\>\ze\%(\s\+\h\|\s*[[;{]\|\s*$\)/
syn match bdslTruth contained /\<\%(counter\|false\|true\|now\)\>/
syn match bdslUnit contained /\%(\<\d\+\.\=\d*\s*\)\@<=\<\%(min\|ms\|Hz\|s\|h\)\>/
syn match bdslUnit contained /\[[^][]*\]/
syn match bdslNumber contained /\[[0-9:, \t]*\]/
syn region bdslString start=/"/ skip=/\\./ end=/"/ end=/$/
syn cluster bdslAny contains=bdslOperator,bdslFunction,bdslText,bdslNumber,bdslType,bdslTruth,bdslUnit,bdslPattern,bdslValue,bdslString
syn match bdsl_plain_inner contained /\.\@<!\<to\>\.\@!\%(\s*\%(\[\|\/[*\/]\|$\)\)\@=/
hi def link bdsl_plain_inner bdslModifier
hi def link bdsl_plain_value bdslValue
hi def link bdsl_plain_name bdslName
hi def link bdsl_plain_field bdslField
syn region bdsl_plain start=/\ze[A-Za-z_[:]/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_plain_inner,bdsl_plain_value,bdsl_plain_name,bdsl_plain_field
syn match bdsl_Bridge_name contained /\%(\<Bridge\s\+\)\@<=\h\w*/
hi def link bdsl_Bridge_inner bdslModifier
hi def link bdsl_Bridge_value bdslValue
hi def link bdsl_Bridge_name bdslName
hi def link bdsl_Bridge_field bdslField
syn region bdsl_Bridge matchgroup=bdslDeclaration start=/\<Bridge\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_Bridge_inner,bdsl_Bridge_value,bdsl_Bridge_name,bdsl_Bridge_field
syn match bdsl_abort_inner contained /\.\@<!\<and\>\.\@!\%(\s*\%("\|(\|-\|[-+.0-9]\|\h\|{\|\/[*\/]\|$\)\)\@=/
syn match bdsl_abort_inner contained /\.\@<!\<to\>\.\@!\%(\s*\%(\[\|\/[*\/]\|$\)\)\@=/
syn match bdsl_abort_inner contained /\.\@<!\<when\>\.\@!\%(\s*\%("\|(\|-\|[-+.0-9]\|\h\|{\|\/[*\/]\|$\)\)\@=/
hi def link bdsl_abort_inner bdslModifier
hi def link bdsl_abort_value bdslValue
hi def link bdsl_abort_name bdslName
hi def link bdsl_abort_field bdslField
syn region bdsl_abort matchgroup=bdslKeyword start=/\<abort\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_abort_inner,bdsl_abort_value,bdsl_abort_name,bdsl_abort_field
syn match bdsl_action_inner contained /\.\@<!\<at\>\.\@!\%(\s*\%("\|\/[*\/]\|$\)\)\@=/
syn match bdsl_action_inner contained /\.\@<!\<over\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match bdsl_action_name contained /\%(\<action\s\+\)\@<=\h\w*/
hi def link bdsl_action_inner bdslModifier
hi def link bdsl_action_value bdslValue
hi def link bdsl_action_name bdslName
hi def link bdsl_action_field bdslField
syn region bdsl_action matchgroup=bdslDeclaration start=/\<action\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_action_inner,bdsl_action_value,bdsl_action_name,bdsl_action_field
hi def link bdsl_best_effort_inner bdslModifier
hi def link bdsl_best_effort_value bdslValue
hi def link bdsl_best_effort_name bdslName
hi def link bdsl_best_effort_field bdslField
syn region bdsl_best_effort matchgroup=bdslKeyword start=/\<best_effort\>\%(\s*\%(;\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_best_effort_inner,bdsl_best_effort_value,bdsl_best_effort_name,bdsl_best_effort_field
syn match bdsl_call_inner contained /\.\@<!\<at\>\.\@!\%(\s*\%("\|\/[*\/]\|$\)\)\@=/
syn match bdsl_call_inner contained /\.\@<!\<over\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match bdsl_call_name contained /\%(\<call\s\+\)\@<=\h\w*/
hi def link bdsl_call_inner bdslModifier
hi def link bdsl_call_value bdslValue
hi def link bdsl_call_name bdslName
hi def link bdsl_call_field bdslField
syn region bdsl_call matchgroup=bdslDeclaration start=/\<call\>\%(\s*\%(;\|\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_call_inner,bdsl_call_value,bdsl_call_name,bdsl_call_field
syn match bdsl_command_inner contained /\.\@<!\<at\>\.\@!\%(\s*\%("\|\/[*\/]\|$\)\)\@=/
syn match bdsl_command_inner contained /\.\@<!\<cancel\>\.\@!\%(\s*\%(;\|{\|\/[*\/]\|$\)\)\@=/
syn match bdsl_command_inner contained /\.\@<!\<on\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match bdsl_command_inner contained /\.\@<!\<over\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match bdsl_command_name contained /\%(\<command\s\+\)\@<=\h\w*/
hi def link bdsl_command_inner bdslModifier
hi def link bdsl_command_value bdslValue
hi def link bdsl_command_name bdslName
hi def link bdsl_command_field bdslField
syn region bdsl_command matchgroup=bdslDeclaration start=/\<command\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_command_inner,bdsl_command_value,bdsl_command_name,bdsl_command_field
hi def link bdsl_deadline_inner bdslModifier
hi def link bdsl_deadline_value bdslValue
hi def link bdsl_deadline_name bdslName
hi def link bdsl_deadline_field bdslField
syn region bdsl_deadline matchgroup=bdslKeyword start=/\<deadline\>\%(\s*\%(;\|\.\=\d\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_deadline_inner,bdsl_deadline_value,bdsl_deadline_name,bdsl_deadline_field
hi def link bdsl_depth_inner bdslModifier
hi def link bdsl_depth_value bdslValue
hi def link bdsl_depth_name bdslName
hi def link bdsl_depth_field bdslField
syn region bdsl_depth matchgroup=bdslKeyword start=/\<depth\>\%(\s*\%(;\|\.\=\d\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_depth_inner,bdsl_depth_value,bdsl_depth_name,bdsl_depth_field
hi def link bdsl_function_inner bdslModifier
hi def link bdsl_function_value bdslValue
hi def link bdsl_function_name bdslName
hi def link bdsl_function_field bdslField
syn region bdsl_function matchgroup=bdslKeyword start=/\<function\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_function_inner,bdsl_function_value,bdsl_function_name,bdsl_function_field
syn match bdsl_hub_inner contained /\.\@<!\<to\>\.\@!\%(\s*\%(\[\|\/[*\/]\|$\)\)\@=/
syn match bdsl_hub_name contained /\%(\<hub\s\+\)\@<=\h\w*/
hi def link bdsl_hub_inner bdslModifier
hi def link bdsl_hub_value bdslValue
hi def link bdsl_hub_name bdslName
hi def link bdsl_hub_field bdslField
syn region bdsl_hub matchgroup=bdslDeclaration start=/\<hub\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_hub_inner,bdsl_hub_value,bdsl_hub_name,bdsl_hub_field
hi def link bdsl_import_inner bdslModifier
hi def link bdsl_import_value bdslValue
hi def link bdsl_import_name bdslName
hi def link bdsl_import_field bdslField
syn region bdsl_import matchgroup=bdslKeyword start=/\<import\>\%(\s*\%("\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_import_inner,bdsl_import_value,bdsl_import_name,bdsl_import_field
syn match bdsl_input_inner contained /\.\@<!\<at\>\.\@!\%(\s*\%("\|\/[*\/]\|$\)\)\@=/
syn match bdsl_input_inner contained /\.\@<!\<over\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match bdsl_input_name contained /\%(\<input\s\+\)\@<=\h\w*/
hi def link bdsl_input_inner bdslModifier
hi def link bdsl_input_value bdslValue
hi def link bdsl_input_name bdslName
hi def link bdsl_input_field bdslField
syn region bdsl_input matchgroup=bdslDeclaration start=/\<input\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_input_inner,bdsl_input_value,bdsl_input_name,bdsl_input_field
syn match bdsl_item_inner contained /\.\@<!\<to\>\.\@!\%(\s*\%(\[\|\/[*\/]\|$\)\)\@=/
hi def link bdsl_item_inner bdslModifier
hi def link bdsl_item_value bdslValue
hi def link bdsl_item_name bdslName
hi def link bdsl_item_field bdslField
syn region bdsl_item matchgroup=bdslKeyword start=/\<item\>\%(\s*\%("\|(\|-\|;\|\.\=\d\|\h\|{\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_item_inner,bdsl_item_value,bdsl_item_name,bdsl_item_field
syn match bdsl_keep_inner contained /\.\@<!\<all\>\.\@!\%(\s*\%(;\|\/[*\/]\|$\)\)\@=/
syn match bdsl_keep_inner contained /\.\@<!\<last\>\.\@!\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/
hi def link bdsl_keep_inner bdslModifier
hi def link bdsl_keep_value bdslValue
hi def link bdsl_keep_name bdslName
hi def link bdsl_keep_field bdslField
syn region bdsl_keep matchgroup=bdslKeyword start=/\<keep\>\%(\s*\%(;\|\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_keep_inner,bdsl_keep_value,bdsl_keep_name,bdsl_keep_field
hi def link bdsl_latched_inner bdslModifier
hi def link bdsl_latched_value bdslValue
hi def link bdsl_latched_name bdslName
hi def link bdsl_latched_field bdslField
syn region bdsl_latched matchgroup=bdslKeyword start=/\<latched\>\%(\s*\%(;\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_latched_inner,bdsl_latched_value,bdsl_latched_name,bdsl_latched_field
hi def link bdsl_length_inner bdslModifier
hi def link bdsl_length_value bdslValue
hi def link bdsl_length_name bdslName
hi def link bdsl_length_field bdslField
syn region bdsl_length matchgroup=bdslKeyword start=/\<length\>\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_length_inner,bdsl_length_value,bdsl_length_name,bdsl_length_field
hi def link bdsl_liveliness_inner bdslModifier
hi def link bdsl_liveliness_value bdslValue
hi def link bdsl_liveliness_name bdslName
hi def link bdsl_liveliness_field bdslField
syn region bdsl_liveliness matchgroup=bdslKeyword start=/\<liveliness\>\%(\s*\%(;\|\.\=\d\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_liveliness_inner,bdsl_liveliness_value,bdsl_liveliness_name,bdsl_liveliness_field
hi def link bdsl_max_age_inner bdslModifier
hi def link bdsl_max_age_value bdslValue
hi def link bdsl_max_age_name bdslName
hi def link bdsl_max_age_field bdslField
syn region bdsl_max_age matchgroup=bdslKeyword start=/\<max_age\>\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_max_age_inner,bdsl_max_age_value,bdsl_max_age_name,bdsl_max_age_field
syn match bdsl_middleware_value contained /\.\@<!\<\%(rmw_zenoh\|inproc\|local\|zenoh\|ros1\|ros2\|yarp\|dds\|ice\)\>/
hi def link bdsl_middleware_inner bdslModifier
hi def link bdsl_middleware_value bdslValue
hi def link bdsl_middleware_name bdslName
hi def link bdsl_middleware_field bdslField
syn region bdsl_middleware matchgroup=bdslKeyword start=/\<middleware\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_middleware_inner,bdsl_middleware_value,bdsl_middleware_name,bdsl_middleware_field
syn match bdsl_output_inner contained /\.\@<!\<at\>\.\@!\%(\s*\%("\|\/[*\/]\|$\)\)\@=/
syn match bdsl_output_inner contained /\.\@<!\<over\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match bdsl_output_inner contained /\.\@<!\<to\>\.\@!\%(\s*\%(\[\|\/[*\/]\|$\)\)\@=/
syn match bdsl_output_name contained /\%(\<output\s\+\)\@<=\h\w*/
hi def link bdsl_output_inner bdslModifier
hi def link bdsl_output_value bdslValue
hi def link bdsl_output_name bdslName
hi def link bdsl_output_field bdslField
syn region bdsl_output matchgroup=bdslDeclaration start=/\<output\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_output_inner,bdsl_output_value,bdsl_output_name,bdsl_output_field
syn match bdsl_policy_inner contained /\.\@<!\<within\>\.\@!\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/
syn match bdsl_policy_value contained /\.\@<!\<\%(synchronised\|latest\|all\)\>/
hi def link bdsl_policy_inner bdslModifier
hi def link bdsl_policy_value bdslValue
hi def link bdsl_policy_name bdslName
hi def link bdsl_policy_field bdslField
syn region bdsl_policy matchgroup=bdslKeyword start=/\<policy\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_policy_inner,bdsl_policy_value,bdsl_policy_name,bdsl_policy_field
syn match bdsl_priority_value contained /\.\@<!\<\%(background\|realtime\|normal\|high\|low\)\>/
hi def link bdsl_priority_inner bdslModifier
hi def link bdsl_priority_value bdslValue
hi def link bdsl_priority_name bdslName
hi def link bdsl_priority_field bdslField
syn region bdsl_priority matchgroup=bdslKeyword start=/\<priority\>\%(\s*\%(;\|\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_priority_inner,bdsl_priority_value,bdsl_priority_name,bdsl_priority_field
syn match bdsl_rate_inner contained /\.\@<!\<Hz\>\.\@!\%(\s*\%(;\|\/[*\/]\|$\)\)\@=/
hi def link bdsl_rate_inner bdslModifier
hi def link bdsl_rate_value bdslValue
hi def link bdsl_rate_name bdslName
hi def link bdsl_rate_field bdslField
syn region bdsl_rate matchgroup=bdslKeyword start=/\<rate\>\%(\s*\%(;\|\.\=\d\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_rate_inner,bdsl_rate_value,bdsl_rate_name,bdsl_rate_field
hi def link bdsl_reliable_inner bdslModifier
hi def link bdsl_reliable_value bdslValue
hi def link bdsl_reliable_name bdslName
hi def link bdsl_reliable_field bdslField
syn region bdsl_reliable matchgroup=bdslKeyword start=/\<reliable\>\%(\s*\%(;\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_reliable_inner,bdsl_reliable_value,bdsl_reliable_name,bdsl_reliable_field
syn match bdsl_service_inner contained /\.\@<!\<at\>\.\@!\%(\s*\%("\|\/[*\/]\|$\)\)\@=/
syn match bdsl_service_inner contained /\.\@<!\<over\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match bdsl_service_name contained /\%(\<service\s\+\)\@<=\h\w*/
hi def link bdsl_service_inner bdslModifier
hi def link bdsl_service_value bdslValue
hi def link bdsl_service_name bdslName
hi def link bdsl_service_field bdslField
syn region bdsl_service matchgroup=bdslDeclaration start=/\<service\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_service_inner,bdsl_service_value,bdsl_service_name,bdsl_service_field
hi def link bdsl_stamp_inner bdslModifier
hi def link bdsl_stamp_value bdslValue
hi def link bdsl_stamp_name bdslName
hi def link bdsl_stamp_field bdslField
syn region bdsl_stamp matchgroup=bdslKeyword start=/\<stamp\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_stamp_inner,bdsl_stamp_value,bdsl_stamp_name,bdsl_stamp_field
syn match bdsl_state_inner contained /\.\@<!\<at\>\.\@!\%(\s*\%("\|\/[*\/]\|$\)\)\@=/
syn match bdsl_state_inner contained /\.\@<!\<over\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match bdsl_state_name contained /\%(\<state\s\+\)\@<=\h\w*/
hi def link bdsl_state_inner bdslModifier
hi def link bdsl_state_value bdslValue
hi def link bdsl_state_name bdslName
hi def link bdsl_state_field bdslField
syn region bdsl_state matchgroup=bdslDeclaration start=/\<state\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_state_inner,bdsl_state_value,bdsl_state_name,bdsl_state_field
syn match bdsl_succeed_inner contained /\.\@<!\<and\>\.\@!\%(\s*\%("\|(\|-\|[-+.0-9]\|\h\|{\|\/[*\/]\|$\)\)\@=/
syn match bdsl_succeed_inner contained /\.\@<!\<to\>\.\@!\%(\s*\%(\[\|\/[*\/]\|$\)\)\@=/
syn match bdsl_succeed_inner contained /\.\@<!\<when\>\.\@!\%(\s*\%("\|(\|-\|[-+.0-9]\|\h\|{\|\/[*\/]\|$\)\)\@=/
hi def link bdsl_succeed_inner bdslModifier
hi def link bdsl_succeed_value bdslValue
hi def link bdsl_succeed_name bdslName
hi def link bdsl_succeed_field bdslField
syn region bdsl_succeed matchgroup=bdslKeyword start=/\<succeed\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_succeed_inner,bdsl_succeed_value,bdsl_succeed_name,bdsl_succeed_field
hi def link bdsl_timeout_inner bdslModifier
hi def link bdsl_timeout_value bdslValue
hi def link bdsl_timeout_name bdslName
hi def link bdsl_timeout_field bdslField
syn region bdsl_timeout matchgroup=bdslKeyword start=/\<timeout\>\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@bdslAny,bdslComment,bdslDoc,bdsl_timeout_inner,bdsl_timeout_value,bdsl_timeout_name,bdsl_timeout_field
syn match bdslComment ,//.*,
syn match bdslComment /#.*/
syn match bdslDoc ,///[/<]\@!.*,
syn region bdslComment start=,/\*, end=,\*/,
syn region bdslDoc start=,/\*\*[*/<]\@!, end=,\*/,
hi def link bdslKeyword Statement
hi def link bdslDeclaration Structure
hi def link bdslModifier Keyword
hi def link bdslLegacy Todo
hi def link bdslValue Constant
hi def link bdslTruth Boolean
hi def link bdslType Type
hi def link bdslPattern PreProc
hi def link bdslNumber Number
hi def link bdslUnit Special
hi def link bdslString String
hi def link bdslComment Comment
hi def link bdslDoc SpecialComment
hi def link bdslOperator Operator
hi def link bdslName Identifier
hi def link bdslField Identifier
hi def link bdslFunction Function

syn sync minlines=200
let b:current_syntax = "bdsl"
let &cpo = s:cpo_save
unlet s:cpo_save
