/** What VS Code knows of where programs are. */

import * as fs from "fs";
import * as path from "path";
import * as vscode from "vscode";

import { findServer } from "./finding";

const WINDOWS = process.platform === "win32";

/** The path of `rcgen`, or nothing. */
export async function rcgen(): Promise<string | undefined> {
  return findServer({
    configured: vscode.workspace.getConfiguration("robocomp").get<string>("server.path", "").trim(),
    folders: (vscode.workspace.workspaceFolders ?? []).map((folder) => folder.uri.fsPath),
    interpreters: await interpreters(),
    searched: (process.env["PATH"] ?? "").split(path.delimiter).filter(Boolean),
    windows: WINDOWS,
    isProgram,
  });
}

/** What the part of the Python extension that we use looks like. */
interface PythonExtension {
  readonly environments?: { getActiveEnvironmentPath?: () => { readonly path?: string } };
}

async function interpreters(): Promise<string[]> {
  const set = vscode.workspace.getConfiguration("python").get<string>("defaultInterpreterPath");
  const python = vscode.extensions.getExtension<PythonExtension>("ms-python.python");
  let chosen: string | undefined;
  try {
    const its = python && (python.isActive ? python.exports : await python.activate());
    chosen = its?.environments?.getActiveEnvironmentPath?.().path;
  } catch {
    // Another extension's failure is told by that extension; there are other places to look at.
  }
  return [chosen, set].filter((one): one is string => Boolean(one) && path.isAbsolute(one ?? ""));
}

function isProgram(file: string): boolean {
  try {
    fs.accessSync(file, fs.constants.X_OK);
    return fs.statSync(file).isFile();
  } catch {
    return false;
  }
}
