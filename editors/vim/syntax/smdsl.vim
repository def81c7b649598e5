" Vim syntax file: SMDSL of RoboComp
" Written by `python -m editors.highlight` from the grammars; do not edit.

if exists("b:current_syntax")
  finish
endif
let s:cpo_save = &cpo
set cpo&vim

syn case ignore
syn match smdslOperator contained /->\|=>\|::\|[=:<>+.-]/
syn match smdslText contained /\h\w*/
syn match smdslNumber contained /\%(\<0[xX]\x\+\|[-+]\=\%(\<\d\+\.\=\d*\|\.\d\+\)\%([eE][-+]\=\d\+\)\=\)\>\=/
syn match smdslUnit contained /\%(\<\d\+\.\=\d*\s*\)\@<=\<\%(min\|ms\|s\|h\)\>/
syn region smdslString start=/"/ skip=/\\./ end=/"/ end=/$/
syn cluster smdslAny contains=smdslOperator,smdslFunction,smdslText,smdslNumber,smdslType,smdslTruth,smdslUnit,smdslPattern,smdslValue,smdslString
syn match smdsl_plain_inner contained /\.\@<!\<after\>\.\@!\%(\s*\%([-+.0-9]\|\/[*\/]\|$\)\)\@=/
syn match smdsl_plain_inner contained /\.\@<!\<on\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match smdsl_plain_inner contained /\.\@<!\<parallel\>\.\@!\%(\s*\%({\|\/[*\/]\|$\)\)\@=/
hi def link smdsl_plain_inner smdslModifier
hi def link smdsl_plain_value smdslValue
hi def link smdsl_plain_name smdslName
hi def link smdsl_plain_field smdslField
syn region smdsl_plain start=/\ze[A-Za-z_[:]/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@smdslAny,smdslComment,smdslDoc,smdsl_plain_inner,smdsl_plain_value,smdsl_plain_name,smdsl_plain_field
hi def link smdsl_end_state_inner smdslModifier
hi def link smdsl_end_state_value smdslValue
hi def link smdsl_end_state_name smdslName
hi def link smdsl_end_state_field smdslField
syn region smdsl_end_state matchgroup=smdslKeyword start=/\<end_state\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@smdslAny,smdslComment,smdslDoc,smdsl_end_state_inner,smdsl_end_state_value,smdsl_end_state_name,smdsl_end_state_field
hi def link smdsl_initial_state_inner smdslModifier
hi def link smdsl_initial_state_value smdslValue
hi def link smdsl_initial_state_name smdslName
hi def link smdsl_initial_state_field smdslField
syn region smdsl_initial_state matchgroup=smdslKeyword start=/\<initial_state\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@smdslAny,smdslComment,smdslDoc,smdsl_initial_state_inner,smdsl_initial_state_value,smdsl_initial_state_name,smdsl_initial_state_field
hi def link smdsl_states_inner smdslModifier
hi def link smdsl_states_value smdslValue
hi def link smdsl_states_name smdslName
hi def link smdsl_states_field smdslField
syn region smdsl_states matchgroup=smdslKeyword start=/\<states\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@smdslAny,smdslComment,smdslDoc,smdsl_states_inner,smdsl_states_value,smdsl_states_name,smdsl_states_field
hi def link smdsl_transition_inner smdslModifier
hi def link smdsl_transition_value smdslValue
hi def link smdsl_transition_name smdslName
hi def link smdsl_transition_field smdslField
syn region smdsl_transition matchgroup=smdslLegacy start=/\<transition\>\%(\s*\%({\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@smdslAny,smdslComment,smdslDoc,smdsl_transition_inner,smdsl_transition_value,smdsl_transition_name,smdsl_transition_field
hi def link smdsl_transitions_inner smdslModifier
hi def link smdsl_transitions_value smdslValue
hi def link smdsl_transitions_name smdslName
hi def link smdsl_transitions_field smdslField
syn region smdsl_transitions matchgroup=smdslDeclaration start=/\<transitions\>\%(\s*\%({\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@smdslAny,smdslComment,smdslDoc,smdsl_transitions_inner,smdsl_transitions_value,smdsl_transitions_name,smdsl_transitions_field
syn match smdslComment ,//.*,
syn match smdslComment /#.*/
syn match smdslDoc ,///[/<]\@!.*,
syn region smdslComment start=,/\*, end=,\*/,
syn region smdslDoc start=,/\*\*[*/<]\@!, end=,\*/,
hi def link smdslKeyword Statement
hi def link smdslDeclaration Structure
hi def link smdslModifier Keyword
hi def link smdslLegacy Todo
hi def link smdslValue Constant
hi def link smdslTruth Boolean
hi def link smdslType Type
hi def link smdslPattern PreProc
hi def link smdslNumber Number
hi def link smdslUnit Special
hi def link smdslString String
hi def link smdslComment Comment
hi def link smdslDoc SpecialComment
hi def link smdslOperator Operator
hi def link smdslName Identifier
hi def link smdslField Identifier
hi def link smdslFunction Function

syn sync minlines=200
let b:current_syntax = "smdsl"
let &cpo = s:cpo_save
unlet s:cpo_save
