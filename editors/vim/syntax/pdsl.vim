" Vim syntax file: PDSL of RoboComp
" Written by `python -m editors.highlight` from the grammars; do not edit.

if exists("b:current_syntax")
  finish
endif
let s:cpo_save = &cpo
set cpo&vim

syn case ignore
syn match pdslOperator contained /->\|=>\|::\|[=:<>+.-]/
syn match pdslText contained /\h\w*/
syn match pdslNumber contained /\%(\<0[xX]\x\+\|[-+]\=\%(\<\d\+\.\=\d*\|\.\d\+\)\%([eE][-+]\=\d\+\)\=\)\>\=/
syn match pdslType contained /\<\%(string\|float\|bool\|int\)\>/
syn match pdslTruth contained /\<\%(false\|true\)\>/
syn match pdslUnit contained /\[[^][]*\]/
syn match pdslNumber contained /\[[0-9: \t]*\]/
syn match pdslValue contained /{[A-Za-z0-9_, \t\n]*}/
syn region pdslString start=/"/ skip=/\\./ end=/"/ end=/$/
syn cluster pdslAny contains=pdslOperator,pdslFunction,pdslText,pdslNumber,pdslType,pdslTruth,pdslUnit,pdslPattern,pdslValue,pdslString
syn match pdsl_plain_inner contained /\.\@<!\<live\>\.\@!\%(\s*\%("\|:\|;\|[-+.0-9]\|\[\|\h\|\/[*\/]\|$\)\)\@=/
syn match pdsl_plain_field contained /\%([;{]\_s*\|\*\/\_s*\|^\s*\)\@<=\h\w*/
hi def link pdsl_plain_inner pdslModifier
hi def link pdsl_plain_value pdslValue
hi def link pdsl_plain_name pdslName
hi def link pdsl_plain_field pdslField
syn region pdsl_plain start=/\ze\h/ matchgroup=NONE end=/;/ end=/\%({[A-Za-z0-9_, \t\n]*}\)\@![{}]/me=s-1 contains=@pdslAny,pdslComment,pdslDoc,pdsl_plain_inner,pdsl_plain_value,pdsl_plain_name,pdsl_plain_field
syn match pdsl_ComponentParams_name contained /\%(\<ComponentParams\s\+\)\@<=\h\w*/
hi def link pdsl_ComponentParams_inner pdslModifier
hi def link pdsl_ComponentParams_value pdslValue
hi def link pdsl_ComponentParams_name pdslName
hi def link pdsl_ComponentParams_field pdslField
syn region pdsl_ComponentParams matchgroup=pdslDeclaration start=/\<ComponentParams\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/\%({[A-Za-z0-9_, \t\n]*}\)\@![{}]/me=s-1 contains=@pdslAny,pdslComment,pdslDoc,pdsl_ComponentParams_inner,pdsl_ComponentParams_value,pdsl_ComponentParams_name,pdsl_ComponentParams_field
syn match pdslComment ,//.*,
syn match pdslComment /#.*/
syn match pdslDoc ,///[/<]\@!.*,
syn region pdslComment start=,/\*, end=,\*/,
syn region pdslDoc start=,/\*\*[*/<]\@!, end=,\*/,
hi def link pdslKeyword Statement
hi def link pdslDeclaration Structure
hi def link pdslModifier Keyword
hi def link pdslLegacy Todo
hi def link pdslValue Constant
hi def link pdslTruth Boolean
hi def link pdslType Type
hi def link pdslPattern PreProc
hi def link pdslNumber Number
hi def link pdslUnit Special
hi def link pdslString String
hi def link pdslComment Comment
hi def link pdslDoc SpecialComment
hi def link pdslOperator Operator
hi def link pdslName Identifier
hi def link pdslField Identifier
hi def link pdslFunction Function

syn sync minlines=200
let b:current_syntax = "pdsl"
let &cpo = s:cpo_save
unlet s:cpo_save
