" Vim syntax file: CDSL of RoboComp
" Written by `python -m editors.highlight` from the grammars; do not edit.

if exists("b:current_syntax")
  finish
endif
let s:cpo_save = &cpo
set cpo&vim

syn case ignore
syn match cdslOperator contained /->\|=>\|::\|[=:<>+.-]/
syn match cdslText contained /\h\w*/
syn match cdslNumber contained /\%(\<0[xX]\x\+\|[-+]\=\%(\<\d\+\.\=\d*\|\.\d\+\)\%([eE][-+]\=\d\+\)\=\)\>\=/
syn region cdslString start=/"/ skip=/\\./ end=/"/ end=/$/
syn cluster cdslAny contains=cdslOperator,cdslFunction,cdslText,cdslNumber,cdslType,cdslTruth,cdslUnit,cdslPattern,cdslValue,cdslString
hi def link cdsl_plain_inner cdslModifier
hi def link cdsl_plain_value cdslValue
hi def link cdsl_plain_name cdslName
hi def link cdsl_plain_field cdslField
syn region cdsl_plain start=/\ze[A-Za-z_[:]/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_plain_inner,cdsl_plain_value,cdsl_plain_name,cdsl_plain_field
hi def link cdsl_Communications_inner cdslModifier
hi def link cdsl_Communications_value cdslValue
hi def link cdsl_Communications_name cdslName
hi def link cdsl_Communications_field cdslField
syn region cdsl_Communications matchgroup=cdslDeclaration start=/\<Communications\>\%(\s*\%({\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_Communications_inner,cdsl_Communications_value,cdsl_Communications_name,cdsl_Communications_field
syn match cdsl_Component_name contained /\%(\<Component\s\+\)\@<=\h\w*/
hi def link cdsl_Component_inner cdslModifier
hi def link cdsl_Component_value cdslValue
hi def link cdsl_Component_name cdslName
hi def link cdsl_Component_field cdslField
syn region cdsl_Component matchgroup=cdslDeclaration start=/\<Component\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_Component_inner,cdsl_Component_value,cdsl_Component_name,cdsl_Component_field
hi def link cdsl_RoboCompClasses_inner cdslModifier
hi def link cdsl_RoboCompClasses_value cdslValue
hi def link cdsl_RoboCompClasses_name cdslName
hi def link cdsl_RoboCompClasses_field cdslField
syn region cdsl_RoboCompClasses matchgroup=cdslLegacy start=/\<RoboCompClasses\>\%(\s*\%({\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_RoboCompClasses_inner,cdsl_RoboCompClasses_value,cdsl_RoboCompClasses_name,cdsl_RoboCompClasses_field
hi def link cdsl_RoboCompModules_inner cdslModifier
hi def link cdsl_RoboCompModules_value cdslValue
hi def link cdsl_RoboCompModules_name cdslName
hi def link cdsl_RoboCompModules_field cdslField
syn region cdsl_RoboCompModules matchgroup=cdslLegacy start=/\<RoboCompModules\>\%(\s*\%({\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_RoboCompModules_inner,cdsl_RoboCompModules_value,cdsl_RoboCompModules_name,cdsl_RoboCompModules_field
syn match cdsl_gui_value contained /\.\@<!\<\%(QMainWindow\|QWidget\|QDialog\|Qt\)\>/
hi def link cdsl_gui_inner cdslModifier
hi def link cdsl_gui_value cdslValue
hi def link cdsl_gui_name cdslName
hi def link cdsl_gui_field cdslField
syn region cdsl_gui matchgroup=cdslKeyword start=/\<gui\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_gui_inner,cdsl_gui_value,cdsl_gui_name,cdsl_gui_field
syn match cdsl_implements_inner contained /\.\@<!\<as\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match cdsl_implements_inner contained /\.\@<!\<optional\>\.\@!\%(\s*\%((\|,\|;\|\h\|\/[*\/]\|$\)\)\@=/
hi def link cdsl_implements_inner cdslModifier
hi def link cdsl_implements_value cdslValue
hi def link cdsl_implements_name cdslName
hi def link cdsl_implements_field cdslField
syn region cdsl_implements matchgroup=cdslKeyword start=/\<implements\>\%(\s*\%(;\|\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_implements_inner,cdsl_implements_value,cdsl_implements_name,cdsl_implements_field
hi def link cdsl_import_inner cdslModifier
hi def link cdsl_import_value cdslValue
hi def link cdsl_import_name cdslName
hi def link cdsl_import_field cdslField
syn region cdsl_import matchgroup=cdslKeyword start=/\<import\>\%(\s*\%("\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_import_inner,cdsl_import_value,cdsl_import_name,cdsl_import_field
syn match cdsl_language_value contained /\.\@<!\<\%(Python\|Cpp11\|Cpp\)\>/
hi def link cdsl_language_inner cdslModifier
hi def link cdsl_language_value cdslValue
hi def link cdsl_language_name cdslName
hi def link cdsl_language_field cdslField
syn region cdsl_language matchgroup=cdslKeyword start=/\<language\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_language_inner,cdsl_language_value,cdsl_language_name,cdsl_language_field
syn match cdsl_middleware_value contained /\.\@<!\<\%(rmw_zenoh\|inproc\|local\|zenoh\|ros1\|ros2\|yarp\|dds\|ice\)\>/
hi def link cdsl_middleware_inner cdslModifier
hi def link cdsl_middleware_value cdslValue
hi def link cdsl_middleware_name cdslName
hi def link cdsl_middleware_field cdslField
syn region cdsl_middleware matchgroup=cdslKeyword start=/\<middleware\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_middleware_inner,cdsl_middleware_value,cdsl_middleware_name,cdsl_middleware_field
hi def link cdsl_no_gui_inner cdslModifier
hi def link cdsl_no_gui_value cdslValue
hi def link cdsl_no_gui_name cdslName
hi def link cdsl_no_gui_field cdslField
syn region cdsl_no_gui matchgroup=cdslLegacy start=/\<no_gui\>\%(\s*\%(;\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_no_gui_inner,cdsl_no_gui_value,cdsl_no_gui_name,cdsl_no_gui_field
syn match cdsl_options_value contained /\.\@<!\<\%(InnerModelViewer\|agmagent\|dsr\)\>/
hi def link cdsl_options_inner cdslModifier
hi def link cdsl_options_value cdslValue
hi def link cdsl_options_name cdslName
hi def link cdsl_options_field cdslField
syn region cdsl_options matchgroup=cdslKeyword start=/\<options\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_options_inner,cdsl_options_value,cdsl_options_name,cdsl_options_field
hi def link cdsl_parameters_inner cdslModifier
hi def link cdsl_parameters_value cdslValue
hi def link cdsl_parameters_name cdslName
hi def link cdsl_parameters_field cdslField
syn region cdsl_parameters matchgroup=cdslKeyword start=/\<parameters\>\%(\s*\%("\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_parameters_inner,cdsl_parameters_value,cdsl_parameters_name,cdsl_parameters_field
hi def link cdsl_period_inner cdslModifier
hi def link cdsl_period_value cdslValue
hi def link cdsl_period_name cdslName
hi def link cdsl_period_field cdslField
syn region cdsl_period matchgroup=cdslKeyword start=/\<period\>\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_period_inner,cdsl_period_value,cdsl_period_name,cdsl_period_field
syn match cdsl_publishes_inner contained /\.\@<!\<as\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match cdsl_publishes_inner contained /\.\@<!\<optional\>\.\@!\%(\s*\%((\|,\|;\|\h\|\/[*\/]\|$\)\)\@=/
hi def link cdsl_publishes_inner cdslModifier
hi def link cdsl_publishes_value cdslValue
hi def link cdsl_publishes_name cdslName
hi def link cdsl_publishes_field cdslField
syn region cdsl_publishes matchgroup=cdslKeyword start=/\<publishes\>\%(\s*\%(;\|\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_publishes_inner,cdsl_publishes_value,cdsl_publishes_name,cdsl_publishes_field
hi def link cdsl_qtversion_inner cdslModifier
hi def link cdsl_qtversion_value cdslValue
hi def link cdsl_qtversion_name cdslName
hi def link cdsl_qtversion_field cdslField
syn region cdsl_qtversion matchgroup=cdslLegacy start=/\<qtversion\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_qtversion_inner,cdsl_qtversion_value,cdsl_qtversion_name,cdsl_qtversion_field
syn match cdsl_requires_inner contained /\.\@<!\<as\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match cdsl_requires_inner contained /\.\@<!\<optional\>\.\@!\%(\s*\%((\|,\|;\|\h\|\/[*\/]\|$\)\)\@=/
hi def link cdsl_requires_inner cdslModifier
hi def link cdsl_requires_value cdslValue
hi def link cdsl_requires_name cdslName
hi def link cdsl_requires_field cdslField
syn region cdsl_requires matchgroup=cdslKeyword start=/\<requires\>\%(\s*\%(;\|\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_requires_inner,cdsl_requires_value,cdsl_requires_name,cdsl_requires_field
syn match cdsl_statemachine_inner contained /\.\@<!\<visual\>\.\@!\%(\s*\%(;\|\/[*\/]\|$\)\)\@=/
hi def link cdsl_statemachine_inner cdslModifier
hi def link cdsl_statemachine_value cdslValue
hi def link cdsl_statemachine_name cdslName
hi def link cdsl_statemachine_field cdslField
syn region cdsl_statemachine matchgroup=cdslKeyword start=/\<statemachine\>\%(\s*\%("\|\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_statemachine_inner,cdsl_statemachine_value,cdsl_statemachine_name,cdsl_statemachine_field
syn match cdsl_subscribesTo_inner contained /\.\@<!\<as\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match cdsl_subscribesTo_inner contained /\.\@<!\<optional\>\.\@!\%(\s*\%((\|,\|;\|\h\|\/[*\/]\|$\)\)\@=/
hi def link cdsl_subscribesTo_inner cdslModifier
hi def link cdsl_subscribesTo_value cdslValue
hi def link cdsl_subscribesTo_name cdslName
hi def link cdsl_subscribesTo_field cdslField
syn region cdsl_subscribesTo matchgroup=cdslKeyword start=/\<subscribesTo\>\%(\s*\%(;\|\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_subscribesTo_inner,cdsl_subscribesTo_value,cdsl_subscribesTo_name,cdsl_subscribesTo_field
hi def link cdsl_threads_inner cdslModifier
hi def link cdsl_threads_value cdslValue
hi def link cdsl_threads_name cdslName
hi def link cdsl_threads_field cdslField
syn region cdsl_threads matchgroup=cdslKeyword start=/\<threads\>\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_threads_inner,cdsl_threads_value,cdsl_threads_name,cdsl_threads_field
hi def link cdsl_useQt_inner cdslModifier
hi def link cdsl_useQt_value cdslValue
hi def link cdsl_useQt_name cdslName
hi def link cdsl_useQt_field cdslField
syn region cdsl_useQt matchgroup=cdslLegacy start=/\<useQt\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_useQt_inner,cdsl_useQt_value,cdsl_useQt_name,cdsl_useQt_field
hi def link cdsl_watchdog_inner cdslModifier
hi def link cdsl_watchdog_value cdslValue
hi def link cdsl_watchdog_name cdslName
hi def link cdsl_watchdog_field cdslField
syn region cdsl_watchdog matchgroup=cdslKeyword start=/\<watchdog\>\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_watchdog_inner,cdsl_watchdog_value,cdsl_watchdog_name,cdsl_watchdog_field
hi def link cdsl_worker_inner cdslModifier
hi def link cdsl_worker_value cdslValue
hi def link cdsl_worker_name cdslName
hi def link cdsl_worker_field cdslField
syn region cdsl_worker matchgroup=cdslLegacy start=/\<worker\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@cdslAny,cdslComment,cdslDoc,cdsl_worker_inner,cdsl_worker_value,cdsl_worker_name,cdsl_worker_field
syn match cdslComment ,//.*,
syn match cdslComment /#.*/
syn match cdslDoc ,///[/<]\@!.*,
syn region cdslComment start=,/\*, end=,\*/,
syn region cdslDoc start=,/\*\*[*/<]\@!, end=,\*/,
hi def link cdslKeyword Statement
hi def link cdslDeclaration Structure
hi def link cdslModifier Keyword
hi def link cdslLegacy Todo
hi def link cdslValue Constant
hi def link cdslTruth Boolean
hi def link cdslType Type
hi def link cdslPattern PreProc
hi def link cdslNumber Number
hi def link cdslUnit Special
hi def link cdslString String
hi def link cdslComment Comment
hi def link cdslDoc SpecialComment
hi def link cdslOperator Operator
hi def link cdslName Identifier
hi def link cdslField Identifier
hi def link cdslFunction Function

syn sync minlines=200
let b:current_syntax = "cdsl"
let &cpo = s:cpo_save
unlet s:cpo_save
