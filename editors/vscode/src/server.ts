/** Starts, stops and queries the language server of this window. */

import * as vscode from "vscode";
import {
  LanguageClient,
  type ExecuteCommandSignature,
  type LanguageClientOptions,
  type Location,
  type Position,
  type ServerOptions,
} from "vscode-languageclient/node";

import { rcgen } from "./places";

export const LANGUAGES = ["idsl", "cdsl", "pdsl", "ddsl", "smdsl", "bdsl", "scxml", "innermodel"];
const SHOW_REFERENCES = "rcgen.showReferences";
const CHOOSE = "Choose rcgen …";
const SETTINGS = "Open settings";

let client: LanguageClient | undefined;

/** Start the server, or report that it is missing. */
export async function start(output: vscode.OutputChannel): Promise<void> {
  const program = await rcgen();
  if (program === undefined) {
    output.appendLine("rcgen was not found");
    void reportMissing();
    return;
  }
  output.appendLine(`starting ${program} lsp`);
  const server: ServerOptions = { command: program, args: ["lsp"], options: workingFolder() };
  client = new LanguageClient("robocomp", "RoboComp", server, options(output));
  try {
    await client.start();
  } catch (error) {
    client = undefined;
    const reason = error instanceof Error ? error.message : String(error);
    void vscode.window.showErrorMessage(`RoboComp: ${program} does not start: ${reason}`);
  }
}

/** Stop the server, if it runs. */
export async function stop(): Promise<void> {
  const ending = client;
  client = undefined;
  await ending?.dispose();
}

/** Report a missing server, with buttons to fix it. */
export async function reportMissing(): Promise<void> {
  const answer = await vscode.window.showErrorMessage(
    "RoboComp: `rcgen` was not found in the workspace's .venv, beside the Python interpreter, or on the PATH. " +
      "Install it there with pip install 'robocomp_dsl[editor]', or set its path.",
    CHOOSE,
    SETTINGS,
  );
  if (answer === SETTINGS) {
    await vscode.commands.executeCommand("workbench.action.openSettings", "robocomp.server.path");
  } else if (answer === CHOOSE) {
    const [chosen] = (await vscode.window.showOpenDialog({ title: "The program rcgen" })) ?? [];
    if (chosen) {
      const target = vscode.workspace.workspaceFolders
        ? vscode.ConfigurationTarget.Workspace
        : vscode.ConfigurationTarget.Global;
      await vscode.workspace.getConfiguration("robocomp").update("server.path", chosen.fsPath, target);
    }
  }
}

function workingFolder(): { cwd?: string } {
  const first = vscode.workspace.workspaceFolders?.[0];
  return first ? { cwd: first.uri.fsPath } : {};
}

function options(output: vscode.OutputChannel): LanguageClientOptions {
  return {
    documentSelector: LANGUAGES.map((language) => ({ scheme: "file", language })),
    outputChannel: output,
    synchronize: {
      fileEvents: vscode.workspace.createFileSystemWatcher("**/*.{idsl,cdsl,pdsl,ddsl,smdsl,bdsl,scxml,xml,py}"),
    },
    middleware: { executeCommand },
  };
}

/** Lists of references are shown by VS Code; all other commands are executed by the server. */
function executeCommand(command: string, given: unknown[], next: ExecuteCommandSignature): unknown {
  if (command !== SHOW_REFERENCES || !client) {
    return next(command, given);
  }
  const [uri, position, places] = given as [string, Position, Location[]];
  const convert = client.protocol2CodeConverter;
  return vscode.commands.executeCommand(
    "editor.action.showReferences",
    convert.asUri(uri),
    convert.asPosition(position),
    places.map((place) => convert.asLocation(place)),
  );
}
