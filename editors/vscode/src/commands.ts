/** The commands: each runs a program in its own terminal. */

import * as path from "path";
import * as vscode from "vscode";

import { siblingProgram } from "./find_server";
import { rcgen } from "./places";
import { reportMissing } from "./server";

/** The commands by the names that `package.json` gives them. */
export const COMMANDS: Readonly<Record<string, (chosen?: vscode.Uri) => Promise<void>>> = {
  "robocomp.generate": (chosen) => onFile(chosen, { ".cdsl": "component", ".bdsl": "bridge" }, "rcgen", "Generate"),
  "robocomp.deploy": (chosen) => onFile(chosen, { ".ddsl": "up" }, "rcdeploy", "Deploy"),
  "robocomp.stop": (chosen) => onFile(chosen, { ".ddsl": "stop" }, "rcdeploy", "Stop"),
  "robocomp.check": checkWorkspace,
};

/** Run the command of `program` that belongs to the suffix of the file. */
async function onFile(
  chosen: vscode.Uri | undefined,
  commands: Readonly<Record<string, string>>,
  program: string,
  title: string,
): Promise<void> {
  const file = chosen ?? vscode.window.activeTextEditor?.document.uri;
  const command = file?.scheme === "file" ? commands[path.extname(file.fsPath).toLowerCase()] : undefined;
  if (file === undefined || command === undefined) {
    const suffixes = Object.keys(commands).join(" or ");
    void vscode.window.showErrorMessage(`RoboComp: ${title} needs a ${suffixes} file: open one, or choose it in the explorer.`);
    return;
  }
  if (!(await saved())) {
    return;
  }
  const name = path.basename(file.fsPath);
  await run(program, [command, file.fsPath], path.dirname(file.fsPath), `${title} ${name}`);
}

async function checkWorkspace(): Promise<void> {
  const folders = (vscode.workspace.workspaceFolders ?? []).map((folder) => folder.uri.fsPath);
  const [first] = folders;
  if (first === undefined) {
    void vscode.window.showErrorMessage("RoboComp: there is no workspace to check: open a folder first.");
  } else if (await saved()) {
    await run("rcgen", ["check", ...folders], first, "Check workspace");
  }
}

/** Save all files, because the programs read them from disk. */
async function saved(): Promise<boolean> {
  return vscode.workspace.saveAll(false);
}

async function run(name: string, words: readonly string[], cwd: string, title: string): Promise<void> {
  const generator = await rcgen();
  if (generator === undefined) {
    await reportMissing();
    return;
  }
  const program = name === "rcgen" ? generator : siblingProgram(generator, name, process.platform === "win32");
  const execution = new vscode.ProcessExecution(program, [...words], { cwd });
  const kind: vscode.TaskDefinition = { type: "robocomp", title };
  const task = new vscode.Task(kind, vscode.TaskScope.Workspace, title, "RoboComp", execution, []);
  task.presentationOptions = { reveal: vscode.TaskRevealKind.Always, panel: vscode.TaskPanelKind.Dedicated, clear: true };
  await vscode.tasks.executeTask(task);
}
