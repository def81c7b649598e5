/** Collects the places where VS Code's settings and extensions locate programs. */

import * as fs from "fs";
import * as path from "path";
import * as vscode from "vscode";

import { findServer } from "./find_server";

const WINDOWS = process.platform === "win32";

/** The path of `rcgen`, or undefined. */
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

/** The part of the Python extension's API that is used here. */
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
    // The Python extension reports its own failure; the other places are still searched.
  }
  return [chosen, set].filter((file): file is string => Boolean(file) && path.isAbsolute(file ?? ""));
}

function isProgram(file: string): boolean {
  try {
    fs.accessSync(file, fs.constants.X_OK);
    return fs.statSync(file).isFile();
  } catch {
    return false;
  }
}
