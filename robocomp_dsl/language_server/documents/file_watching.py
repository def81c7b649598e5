"""File watching: registrations for changes outside the editor.

In: the capabilities of the client. Out: registrations for the files of all languages.
"""

from __future__ import annotations

from lsprotocol import types as lsp

from robocomp_dsl.check.languages import CHECKS

FILE_OPERATIONS = (
    lsp.WORKSPACE_DID_CREATE_FILES,
    lsp.WORKSPACE_DID_RENAME_FILES,
    lsp.WORKSPACE_DID_DELETE_FILES,
)
WATCHED_GLOBS = lsp.FileOperationRegistrationOptions(
    [
        lsp.FileOperationFilter(lsp.FileOperationPattern(glob), scheme="file")
        for glob in (*(f"**/*{suffix}" for suffix in sorted(CHECKS)), "**/")
    ]
)
"""Files of all languages, and folders, which may contain such files."""


def registration(capabilities: lsp.ClientCapabilities) -> lsp.RegistrationParams | None:
    """The request to watch files, or None if the client cannot watch files."""
    watching = capabilities.workspace.did_change_watched_files if capabilities.workspace else None
    if not watching or not watching.dynamic_registration:
        return None
    watched = [lsp.FileSystemWatcher(f"**/*{suffix}") for suffix in (*sorted(CHECKS), ".py")]
    options = lsp.DidChangeWatchedFilesRegistrationOptions(watched)
    method = lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES
    return lsp.RegistrationParams([lsp.Registration("rcgen-files", method, options)])
