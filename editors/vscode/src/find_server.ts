/** Finds the programs of robocomp_dsl. In: settings and folders. Out: a path, or undefined. */

import * as path from "path";

/** The places to search. */
export interface Places {
  /** The setting `robocomp.server.path`; empty if it is not set. */
  readonly configured: string;
  /** The folders of the workspace. */
  readonly folders: readonly string[];
  /** Python interpreters or environment folders that the user chose. */
  readonly interpreters: readonly string[];
  /** The folders of the `PATH`. */
  readonly searched: readonly string[];
  readonly windows: boolean;
  readonly isProgram: (file: string) => boolean;
}

/** The first `rcgen` found: of the setting, or else of the workspace, the interpreters, the PATH. */
export function findServer(places: Places): string | undefined {
  if (places.configured) {
    return configured(places).find(places.isProgram);
  }
  const bin = places.windows ? "Scripts" : "bin";
  const folders = [
    ...places.folders.map((folder) => path.join(folder, ".venv", bin)),
    ...places.interpreters.flatMap((python) => [path.dirname(python), path.join(python, bin)]),
    ...places.searched,
  ];
  return folders.map((folder) => path.join(folder, program("rcgen", places.windows))).find(places.isProgram);
}

/** The program `name` in the folder of `rcgen`. */
export function siblingProgram(rcgen: string, name: string, windows: boolean): string {
  return path.join(path.dirname(rcgen), program(name, windows));
}

function configured(places: Places): string[] {
  const home = process.env["HOME"] ?? process.env["USERPROFILE"] ?? "~";
  const written = places.configured.replace(/^~(?=[/\\])/, home);
  if (path.isAbsolute(written)) {
    return [written];
  }
  const where = written.includes("/") || written.includes("\\") ? places.folders : places.searched;
  return where.map((folder) => path.join(folder, written));
}

function program(name: string, windows: boolean): string {
  return windows ? `${name}.exe` : name;
}
