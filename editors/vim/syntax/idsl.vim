" Vim syntax file: IDSL of RoboComp
" Written by `python -m editors.highlight` from the grammars; do not edit.

if exists("b:current_syntax")
  finish
endif
let s:cpo_save = &cpo
set cpo&vim

syn case match
syn match idslOperator contained /->\|=>\|::\|[=:<>+.-]/
syn match idslFunction contained /\h\w*\ze\s*(/
syn match idslText contained /\h\w*\ze\%(\s*(\)\@!\>/
syn match idslNumber contained /\%(\<0[xX]\x\+\|[-+]\=\%(\<\d\+\.\=\d*\|\.\d\+\)\%([eE][-+]\=\d\+\)\=\)\>\=/
syn match idslType contained /\<\%(unsigned short\|unsigned long\|unsigned int\|double\|string\|float\|short\|bool\|byte\|long\|void\|int\)\>\ze\%(\s\+\h\|\s*[<>,)]\|\s*$\)/
syn match idslTruth contained /\<\%(false\|true\)\>/
syn match idslUnit contained /\[[^][]*\]/
syn match idslNumber contained /\[[0-9: \t]*\]/
syn match idslPattern contained /\[\s*\<\%(command\|publish\|query\)\>\s*\]/
syn region idslString start=/"/ skip=/\\./ end=/"/ end=/$/
syn cluster idslAny contains=idslOperator,idslFunction,idslText,idslNumber,idslType,idslTruth,idslUnit,idslPattern,idslValue,idslString
syn match idsl_plain_inner contained /\.\@<!\<dictionary\>\.\@!\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/
syn match idsl_plain_inner contained /\.\@<!\<idempotent\>\.\@!\%(\s*\%(\[\|\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_plain_inner contained /\.\@<!\<out\>\.\@!\%(\s*\%(\[\|\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_plain_inner contained /\.\@<!\<sequence\>\.\@!\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/
syn match idsl_plain_inner contained /\.\@<!\<throws\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_plain_inner contained /\.\@<!\<unsigned\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
hi def link idsl_plain_inner idslModifier
hi def link idsl_plain_value idslValue
hi def link idsl_plain_name idslName
hi def link idsl_plain_field idslField
syn region idsl_plain start=/\ze[A-Za-z_[:]/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@idslAny,idslComment,idslDoc,idsl_plain_inner,idsl_plain_value,idsl_plain_name,idsl_plain_field
syn match idsl_dictionary_inner contained /\.\@<!\<dictionary\>\.\@!\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/
syn match idsl_dictionary_inner contained /\.\@<!\<idempotent\>\.\@!\%(\s*\%(\[\|\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_dictionary_inner contained /\.\@<!\<out\>\.\@!\%(\s*\%(\[\|\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_dictionary_inner contained /\.\@<!\<sequence\>\.\@!\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/
syn match idsl_dictionary_inner contained /\.\@<!\<throws\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_dictionary_inner contained /\.\@<!\<unsigned\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
hi def link idsl_dictionary_inner idslModifier
hi def link idsl_dictionary_value idslValue
hi def link idsl_dictionary_name idslName
hi def link idsl_dictionary_field idslField
syn region idsl_dictionary matchgroup=idslKeyword start=/\<dictionary\>\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@idslAny,idslComment,idslDoc,idsl_dictionary_inner,idsl_dictionary_value,idsl_dictionary_name,idsl_dictionary_field
syn match idsl_enum_name contained /\%(\<enum\s\+\)\@<=\h\w*/
hi def link idsl_enum_inner idslModifier
hi def link idsl_enum_value idslValue
hi def link idsl_enum_name idslName
hi def link idsl_enum_field idslField
syn region idsl_enum matchgroup=idslDeclaration start=/\<enum\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@idslAny,idslComment,idslDoc,idsl_enum_inner,idsl_enum_value,idsl_enum_name,idsl_enum_field
syn match idsl_exception_inner contained /\.\@<!\<dictionary\>\.\@!\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/
syn match idsl_exception_inner contained /\.\@<!\<extends\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_exception_inner contained /\.\@<!\<sequence\>\.\@!\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/
syn match idsl_exception_inner contained /\.\@<!\<unsigned\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_exception_name contained /\%(\<exception\s\+\)\@<=\h\w*/
hi def link idsl_exception_inner idslModifier
hi def link idsl_exception_value idslValue
hi def link idsl_exception_name idslName
hi def link idsl_exception_field idslField
syn region idsl_exception matchgroup=idslDeclaration start=/\<exception\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@idslAny,idslComment,idslDoc,idsl_exception_inner,idsl_exception_value,idsl_exception_name,idsl_exception_field
syn match idsl_idempotent_inner contained /\.\@<!\<dictionary\>\.\@!\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/
syn match idsl_idempotent_inner contained /\.\@<!\<idempotent\>\.\@!\%(\s*\%(\[\|\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_idempotent_inner contained /\.\@<!\<out\>\.\@!\%(\s*\%(\[\|\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_idempotent_inner contained /\.\@<!\<sequence\>\.\@!\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/
syn match idsl_idempotent_inner contained /\.\@<!\<throws\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_idempotent_inner contained /\.\@<!\<unsigned\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
hi def link idsl_idempotent_inner idslModifier
hi def link idsl_idempotent_value idslValue
hi def link idsl_idempotent_name idslName
hi def link idsl_idempotent_field idslField
syn region idsl_idempotent matchgroup=idslKeyword start=/\<idempotent\>\%(\s*\%(\[\|\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@idslAny,idslComment,idslDoc,idsl_idempotent_inner,idsl_idempotent_value,idsl_idempotent_name,idsl_idempotent_field
hi def link idsl_import_inner idslModifier
hi def link idsl_import_value idslValue
hi def link idsl_import_name idslName
hi def link idsl_import_field idslField
syn region idsl_import matchgroup=idslKeyword start=/\<import\>\%(\s*\%("\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@idslAny,idslComment,idslDoc,idsl_import_inner,idsl_import_value,idsl_import_name,idsl_import_field
syn match idsl_interface_inner contained /\.\@<!\<dictionary\>\.\@!\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/
syn match idsl_interface_inner contained /\.\@<!\<extends\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_interface_inner contained /\.\@<!\<sequence\>\.\@!\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/
syn match idsl_interface_inner contained /\.\@<!\<unsigned\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_interface_name contained /\%(\<interface\s\+\)\@<=\h\w*/
hi def link idsl_interface_inner idslModifier
hi def link idsl_interface_value idslValue
hi def link idsl_interface_name idslName
hi def link idsl_interface_field idslField
syn region idsl_interface matchgroup=idslDeclaration start=/\<interface\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@idslAny,idslComment,idslDoc,idsl_interface_inner,idsl_interface_value,idsl_interface_name,idsl_interface_field
syn match idsl_module_name contained /\%(\<module\s\+\)\@<=\h\w*/
hi def link idsl_module_inner idslModifier
hi def link idsl_module_value idslValue
hi def link idsl_module_name idslName
hi def link idsl_module_field idslField
syn region idsl_module matchgroup=idslDeclaration start=/\<module\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@idslAny,idslComment,idslDoc,idsl_module_inner,idsl_module_value,idsl_module_name,idsl_module_field
syn match idsl_out_inner contained /\.\@<!\<dictionary\>\.\@!\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/
syn match idsl_out_inner contained /\.\@<!\<idempotent\>\.\@!\%(\s*\%(\[\|\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_out_inner contained /\.\@<!\<out\>\.\@!\%(\s*\%(\[\|\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_out_inner contained /\.\@<!\<sequence\>\.\@!\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/
syn match idsl_out_inner contained /\.\@<!\<throws\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_out_inner contained /\.\@<!\<unsigned\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
hi def link idsl_out_inner idslModifier
hi def link idsl_out_value idslValue
hi def link idsl_out_name idslName
hi def link idsl_out_field idslField
syn region idsl_out matchgroup=idslKeyword start=/\<out\>\%(\s*\%(\[\|\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@idslAny,idslComment,idslDoc,idsl_out_inner,idsl_out_value,idsl_out_name,idsl_out_field
syn match idsl_sequence_inner contained /\.\@<!\<dictionary\>\.\@!\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/
syn match idsl_sequence_inner contained /\.\@<!\<idempotent\>\.\@!\%(\s*\%(\[\|\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_sequence_inner contained /\.\@<!\<out\>\.\@!\%(\s*\%(\[\|\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_sequence_inner contained /\.\@<!\<sequence\>\.\@!\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/
syn match idsl_sequence_inner contained /\.\@<!\<throws\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_sequence_inner contained /\.\@<!\<unsigned\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
hi def link idsl_sequence_inner idslModifier
hi def link idsl_sequence_value idslValue
hi def link idsl_sequence_name idslName
hi def link idsl_sequence_field idslField
syn region idsl_sequence matchgroup=idslKeyword start=/\<sequence\>\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@idslAny,idslComment,idslDoc,idsl_sequence_inner,idsl_sequence_value,idsl_sequence_name,idsl_sequence_field
syn match idsl_struct_inner contained /\.\@<!\<dictionary\>\.\@!\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/
syn match idsl_struct_inner contained /\.\@<!\<extends\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_struct_inner contained /\.\@<!\<sequence\>\.\@!\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/
syn match idsl_struct_inner contained /\.\@<!\<unsigned\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_struct_name contained /\%(\<struct\s\+\)\@<=\h\w*/
hi def link idsl_struct_inner idslModifier
hi def link idsl_struct_value idslValue
hi def link idsl_struct_name idslName
hi def link idsl_struct_field idslField
syn region idsl_struct matchgroup=idslDeclaration start=/\<struct\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@idslAny,idslComment,idslDoc,idsl_struct_inner,idsl_struct_value,idsl_struct_name,idsl_struct_field
syn match idsl_unsigned_inner contained /\.\@<!\<dictionary\>\.\@!\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/
syn match idsl_unsigned_inner contained /\.\@<!\<idempotent\>\.\@!\%(\s*\%(\[\|\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_unsigned_inner contained /\.\@<!\<out\>\.\@!\%(\s*\%(\[\|\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_unsigned_inner contained /\.\@<!\<sequence\>\.\@!\%(\s*\%(<\|\/[*\/]\|$\)\)\@=/
syn match idsl_unsigned_inner contained /\.\@<!\<throws\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
syn match idsl_unsigned_inner contained /\.\@<!\<unsigned\>\.\@!\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/
hi def link idsl_unsigned_inner idslModifier
hi def link idsl_unsigned_value idslValue
hi def link idsl_unsigned_name idslName
hi def link idsl_unsigned_field idslField
syn region idsl_unsigned matchgroup=idslKeyword start=/\<unsigned\>\%(\s*\%(\h\|\/[*\/]\|$\)\)\@=/ matchgroup=NONE end=/;/ end=/[{}]/me=s-1 contains=@idslAny,idslComment,idslDoc,idsl_unsigned_inner,idsl_unsigned_value,idsl_unsigned_name,idsl_unsigned_field
syn match idslComment ,//.*,
syn match idslComment /#.*/
syn match idslDoc ,///[/<]\@!.*,
syn region idslComment start=,/\*, end=,\*/,
syn region idslDoc start=,/\*\*[*/<]\@!, end=,\*/,
hi def link idslKeyword Statement
hi def link idslDeclaration Structure
hi def link idslModifier Keyword
hi def link idslLegacy Todo
hi def link idslValue Constant
hi def link idslTruth Boolean
hi def link idslType Type
hi def link idslPattern PreProc
hi def link idslNumber Number
hi def link idslUnit Special
hi def link idslString String
hi def link idslComment Comment
hi def link idslDoc SpecialComment
hi def link idslOperator Operator
hi def link idslName Identifier
hi def link idslField Identifier
hi def link idslFunction Function

syn sync minlines=200
let b:current_syntax = "idsl"
let &cpo = s:cpo_save
unlet s:cpo_save
