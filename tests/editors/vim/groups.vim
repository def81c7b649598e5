" Writes the syntax group at each character of the file that is open: one line of names for each line.
let s:out = []
for s:line in range(1, line('$'))
  let s:names = []
  for s:column in range(1, len(getline(s:line)))
    call add(s:names, synIDattr(synIDtrans(synID(s:line, s:column, 1)), "name"))
  endfor
  call add(s:out, join(s:names, ','))
endfor
call writefile(s:out, $GROUPS_OUT)
qall!
