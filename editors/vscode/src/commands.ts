/** The commands: each runs a program in its own terminal. */

import * as path from "path";
import * as vscode from "vscode";

import { siblingProgram } from "./find_server";
import { rcgen } from "./places";
import { reportMissing } from "./server";

/** The commands by the names that `package.json` gives them. */
export const COMMANDS: Readonly<Record<string, (chosen?: vscode.Uri) => Promise<void>>> = {
  "robocomp.generate": (chosen) => onFile(chosen, ".cdsl", "rcgen", ["component"], "Generate"),
  "robocomp.deploy": (chosen) => onFile(chosen, ".ddsl", "rcdeploy", ["up"], "Deploy"),
  "robocomp.stop": (chosen) => onFile(chosen, ".ddsl", "rcdeploy", ["stop"], "Stop"),
  "robocomp.check": checkWorkspace,
};

async function onFile(
  chosen: vscode.Uri | undefined,
  suffix: string,
  program: string,
  words: readonly string[],
  title: string,
): Promise<void> {
  const file = chosen ?? vscode.window.activeTextEditor?.document.uri;
  if (file?.scheme !== "file" || path.extname(file.fsPath).toLowerCase() !== suffix) {
    void vscode.window.showErrorMessage(`RoboComp: ${title} needs a ${suffix} file: open one, or choose it in the explorer.`);
    return;
  }
  if (!(await saved())) {
    return;
  }
  const name = path.basename(file.fsPath);
  await run(program, [...words, file.fsPath], path.dirname(file.fsPath), `${title} ${name}`);
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
