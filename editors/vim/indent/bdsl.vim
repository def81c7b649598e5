if exists("b:did_indent")
  finish
endif
let b:did_indent = 1
" Blocks as in C; continuation lines are indented by one more level.
setlocal cindent cinoptions=+4,J1 indentkeys=0{,0},:,0#,!^F,o,O
let b:undo_indent = "setlocal cindent< cinoptions< indentkeys<"
