if exists("b:did_indent")
  finish
endif
let b:did_indent = 1
" Blocks as in C; a statement that goes on in the next line is one step further in.
setlocal cindent cinoptions=+4,J1 indentkeys=0{,0},:,0#,!^F,o,O
let b:undo_indent = "setlocal cindent< cinoptions< indentkeys<"
