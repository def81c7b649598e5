"""The language server: what the checks know, shown in an editor while the user types.

In: messages of the Language Server Protocol 3.17. Out: diagnostics, and answers. `server` holds the
table of the features; read it first. Each feature is one file with one function from a `Session`
and the client's question to an answer:

    session      the open files, their findings and models; unsaved buffers win over the disk
    index        what every name in a file means; most features are a question to it
    positions    the only place that counts in UTF-16

No feature changes a file: edits are proposed, the editor makes them.
"""
