// The module that Emscripten makes of web/bindings, as TypeScript sees it.

import type {Facts, Failure, Format, MeshArrays, OptionRow, Outline, Warning} from "./values.ts";

/** The path of a file in the module's own file system, which lives in memory. */
type Path = string;

/** The reply of a function that may fail: its value, or what went wrong. */
export interface Reply<Value> {
  value?: Value;
  error?: Failure;
}

export interface HeldMesh {
  arrays(): MeshArrays;
  hash(): string;
  write(file: Path, format: string, wallDistance: boolean): Reply<undefined>;
  delete(): void;
}

export interface Generated {
  mesh: HeldMesh;
  warnings: Warning[];
  facts: Facts;
}

export interface Module {
  version: string;
  formats(): Format[];
  threadCount(): number;
  optionRows(): OptionRow[];
  generate(inputs: string[], options: object, progress: ((stage: string) => void) | null): Reply<Generated>;
  outlines(inputs: string[]): Reply<Outline[]>;
  delaunay(points: Float64Array): Reply<Uint32Array>;
  FS: {
    chdir(folder: Path): void;
    mkdir(folder: Path): void;
    rmdir(folder: Path): void;
    readdir(folder: Path): string[];
    readFile(file: Path): Uint8Array;
    writeFile(file: Path, content: string | Uint8Array): void;
    unlink(file: Path): void;
    stat(path: Path): {mode: number};
    isDir(mode: number): boolean;
  };
}

export type MakeModule = (settings: {
  wasmBinary: ArrayBuffer | Uint8Array;
  /** Where the module comes from, for its threads. */
  mainScriptUrlOrBlob?: string;
}) => Promise<Module>;
