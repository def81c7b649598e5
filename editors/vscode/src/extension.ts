/** Entry point: called when VS Code loads and unloads the extension. */

import * as vscode from "vscode";

import { COMMANDS } from "./commands";
import { recognize } from "./innermodel";
import { start, stop } from "./server";

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  const output = vscode.window.createOutputChannel("RoboComp");
  const again = async (): Promise<void> => {
    await stop();
    await start(output);
  };
  context.subscriptions.push(output, recognize());
  for (const [name, command] of Object.entries(COMMANDS)) {
    context.subscriptions.push(vscode.commands.registerCommand(name, command));
  }
  context.subscriptions.push(
    vscode.commands.registerCommand("robocomp.restart", again),
    vscode.workspace.onDidChangeConfiguration(async (change) => {
      if (change.affectsConfiguration("robocomp.server.path")) {
        await again();
      }
    }),
  );
  await start(output);
}

export async function deactivate(): Promise<void> {
  await stop();
}
