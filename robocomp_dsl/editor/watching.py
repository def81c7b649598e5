"""Files that change outside of the editor: what the client is asked to tell.

In: what a client can do. Out: registrations for the files of our languages.
"""

from __future__ import annotations

from lsprotocol import types as lsp

from robocomp_dsl.check import CHECKS

MOVED = (
    lsp.WORKSPACE_DID_CREATE_FILES,
    lsp.WORKSPACE_DID_RENAME_FILES,
    lsp.WORKSPACE_DID_DELETE_FILES,
)
OURS = lsp.FileOperationRegistrationOptions(
    [
        lsp.FileOperationFilter(lsp.FileOperationPattern(glob), scheme="file")
        for glob in (*(f"**/*{suffix}" for suffix in sorted(CHECKS)), "**/")
    ]
)
"""Files that matter here; and folders, as they may hold some."""


def registration(can: lsp.ClientCapabilities) -> lsp.RegistrationParams | None:
    """What a client that can watch files is asked to watch."""
    watching = can.workspace.did_change_watched_files if can.workspace else None
    if not watching or not watching.dynamic_registration:
        return None
    watched = [lsp.FileSystemWatcher(f"**/*{suffix}") for suffix in sorted(CHECKS)]
    options = lsp.DidChangeWatchedFilesRegistrationOptions(watched)
    method = lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES
    return lsp.RegistrationParams([lsp.Registration("rcgen-files", method, options)])
