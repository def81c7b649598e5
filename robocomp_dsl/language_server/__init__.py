"""The language server: the results of the checks, shown in an editor while the user types.

In: messages of the Language Server Protocol 3.17. Out: diagnostics and responses. `server` holds
the table of features; read it first. Each feature is one module with one function that takes the
`Session` and the request's parameters and returns the response:

    session         the open documents, their diagnostics and models; unsaved buffers override files
    symbols/index   what each name in a file refers to; most features query it
    positions       the only module that converts offsets to UTF-16 columns

No feature changes a file: the server proposes edits, the editor applies them.
"""
