/** Where the programs of robocomp_dsl are. In: what the user set and has. Out: a path, or nothing. */

import * as path from "path";

/** What there is to look at. */
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

/** The first `rcgen` that is there: the one set, or else the workspace's, the interpreter's, the PATH's. */
export function findServer(places: Places): string | undefined {
  if (places.configured) {
    return configured(places).find(places.isProgram);
  }
  const bin = places.windows ? "Scripts" : "bin";
  const folders = [
    ...places.folders.map((folder) => path.join(folder, ".venv", bin)),
    ...places.interpreters.flatMap((one) => [path.dirname(one), path.join(one, bin)]),
    ...places.searched,
  ];
  return folders.map((folder) => path.join(folder, program("rcgen", places.windows))).find(places.isProgram);
}

/** The program `name` that came with `rcgen`. */
export function besides(rcgen: string, name: string, windows: boolean): string {
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
