//! Tells Zed how to start the language server of RoboComp's languages.
//!
//! In: a worktree. Out: the command `rcgen lsp`: from the settings, from the
//! worktree's `.venv`, or from the PATH of its shell.

use zed_extension_api::{self as zed, settings::LspSettings, Command, LanguageServerId, Result};

const OWN: &str = ".venv/bin/rcgen";
const MISSING: &str = "rcgen was not found, neither in .venv nor on the PATH: install it with \
    pip install 'robocomp_dsl[editor]', or set lsp.rcgen.binary.path in the settings";

struct RoboComp;

impl zed::Extension for RoboComp {
    fn new() -> Self {
        RoboComp
    }

    fn language_server_command(
        &mut self,
        server: &LanguageServerId,
        worktree: &zed::Worktree,
    ) -> Result<Command> {
        let settings = LspSettings::for_worktree(server.as_ref(), worktree).ok();
        let set = settings
            .and_then(|all| all.binary)
            .and_then(|binary| binary.path);
        // An extension cannot list files, but it can read the program, which is a text.
        let own = worktree
            .read_text_file(OWN)
            .ok()
            .map(|_| format!("{}/{OWN}", worktree.root_path()));
        let command = set
            .or(own)
            .or_else(|| worktree.which("rcgen"))
            .ok_or(MISSING)?;
        Ok(Command {
            command,
            args: vec!["lsp".into()],
            env: worktree.shell_env(),
        })
    }
}

zed::register_extension!(RoboComp);
