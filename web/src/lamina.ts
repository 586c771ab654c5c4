// lamina in JavaScript: viscous meshes round airfoils, and Delaunay triangulations. The work is done by lamina's C++
// code, compiled to WebAssembly; it makes the same meshes as the native program, bit by bit.

// @ts-ignore: Emscripten writes it without types
import makeModule from "lamina-module";
import {zipSync, type Zippable} from "fflate";
import {LaminaError} from "./error.ts";
import {wasmBytes, type WasmSource} from "./wasm_bytes.ts";
import type {Generated, HeldMesh, MakeModule, Module, Reply} from "./module.ts";
import type {
  Facts,
  Format,
  Input,
  Marker,
  MeshArrays,
  OptionRow,
  Options,
  Outline,
  OutputFile,
  Warning,
} from "./values.ts";

export {LaminaError};
export type * from "./values.ts";

function valueOf<Value>(reply: Reply<Value>): Value {
  if (reply.error) throw new LaminaError(reply.error);
  return reply.value as Value;
}

let loading: Promise<Module> | undefined;

function keep(made: Promise<Module>): Promise<Module> {
  loading = made
    .then((module) => {
      for (const folder of [inputFolder, outputFolder]) module.FS.mkdir(folder);
      return module;
    })
    .catch((error) => {
      loading = undefined;
      throw error;
    });
  return loading;
}

/**
 * Loads the WebAssembly module, once. The other functions call it by themselves; call it first to begin early, or to
 * say where lamina.wasm is (beside this file by default).
 */
export function load(wasm: WasmSource = new URL("lamina.wasm", import.meta.url)): Promise<Module> {
  return loading ?? keep(wasmBytes(wasm).then((wasmBinary) => (makeModule as MakeModule)({wasmBinary})));
}

/**
 * Loads the module with threads in place of that of load(), before any other function is called. Its three files are in
 * `folder` ("threads", beside this file, by default). Browsers have threads where the page is isolated from others
 * (crossOriginIsolated) and, but for short work, in workers alone; Node.js is not supported. Meshes are the same.
 */
export function loadThreads(folder: URL | string = new URL("threads/", import.meta.url)): Promise<Module> {
  if (loading) return loading;
  const script = new URL("lamina.mjs", folder).href;
  const make = async (): Promise<Module> => {
    if (!globalThis.crossOriginIsolated) throw new Error("threads need a page that is isolated from others");
    const [{default: makeThreads}, wasmBinary] = await Promise.all([
      import(/* @vite-ignore */ script) as Promise<{default: MakeModule}>,
      wasmBytes(new URL("lamina.wasm", folder)),
    ]);
    return makeThreads({wasmBinary, mainScriptUrlOrBlob: script});
  };
  return keep(make());
}

/** Returns the number of threads that mesh() and delaunay() work on. */
export async function threadCount(): Promise<number> {
  return (await load()).threadCount();
}

const inputFolder = "/input",
  outputFolder = "/output";

function remove(fs: Module["FS"], path: string): void {
  if (!fs.isDir(fs.stat(path).mode)) return fs.unlink(path);
  for (const name of fs.readdir(path)) if (name !== "." && name !== "..") remove(fs, `${path}/${name}`);
  fs.rmdir(path);
}

/** Calls work(names) while the files of the inputs lie in the module's file system under these names. */
function withInputs<Result>(module: Module, inputs: Input[], work: (names: string[]) => Result): Result {
  const written: string[] = [];
  try {
    module.FS.chdir(inputFolder);
    const names = inputs.map((input) => {
      if (typeof input === "string") return input;
      const name = input.name.replace(/^.*[/\\]/, "") || "section.dat";
      if (written.includes(name)) throw new LaminaError({kind: "usage", message: `two files are named ${name}`});
      module.FS.writeFile(name, input.text);
      written.push(name);
      return name;
    });
    return work(names);
  } finally {
    for (const name of written) module.FS.unlink(`${inputFolder}/${name}`);
    module.FS.chdir("/");
  }
}

/** A mesh, with the facts about it. Its arrays are copies, which may be changed and transferred. */
export class Mesh implements MeshArrays {
  readonly points!: Float64Array;
  readonly triangles!: Uint32Array;
  readonly quads!: Uint32Array;
  readonly markers!: Marker[];
  readonly region!: Uint8Array;
  readonly piece!: Uint32Array;
  readonly layer!: Uint16Array;
  readonly constraints!: Uint32Array;
  readonly warnings: Warning[];
  readonly facts: Facts;
  readonly #module: Module;
  readonly #held: HeldMesh;

  /** Meshes come from mesh(). */
  constructor(module: Module, generated: Generated) {
    this.#module = module;
    this.#held = generated.mesh;
    this.warnings = generated.warnings;
    this.facts = generated.facts;
    Object.assign(this, this.#held.arrays());
  }

  /** The number of triangles and quadrilaterals. */
  get cellCount(): number {
    return this.triangles.length / 3 + this.quads.length / 4;
  }

  /** A hash of the mesh as `lamina info` prints it. */
  get hash(): string {
    return this.#held.hash();
  }

  /**
   * Writes the mesh. The format follows from the extension of `name`, which may be the name of a folder ("polyMesh"),
   * unless it is given. Returns the files: one, or several for formats that take several.
   */
  write(name: string, {format = "", wallDistance = false} = {}): OutputFile[] {
    const fs = this.#module.FS;
    try {
      valueOf(this.#held.write(`${outputFolder}/${name}`, format, wallDistance));
      const files: OutputFile[] = [];
      const collect = (folder: string, prefix: string): void => {
        for (const entry of fs.readdir(folder)) {
          if (entry === "." || entry === "..") continue;
          const path = `${folder}/${entry}`;
          if (fs.isDir(fs.stat(path).mode)) collect(path, `${prefix}${entry}/`);
          else files.push({name: prefix + entry, bytes: fs.readFile(path)});
        }
      };
      collect(outputFolder, "");
      return files;
    } finally {
      for (const entry of fs.readdir(outputFolder))
        if (entry !== "." && entry !== "..") remove(fs, `${outputFolder}/${entry}`);
    }
  }

  /** Frees the memory of the mesh. write() and hash must not be used afterwards; the arrays stay. */
  delete(): void {
    this.#held.delete();
  }
}

/** Returns a zip file of these files, each below `folder`. */
export function zip(files: OutputFile[], folder = ""): Uint8Array {
  const entries: Zippable = {};
  for (const {name, bytes} of files) entries[folder + name] = [bytes, {level: 1, mtime: new Date(1980, 0, 1)}];
  return zipSync(entries);
}

/**
 * Makes a mesh round airfoils. `inputs` are NACA sections ("naca:0012") and files of coordinates; options have the
 * names and meanings of case files. `progress` is called with the name of each stage that begins. Throws LaminaError.
 */
export async function mesh(
  inputs: Input | Input[],
  options: Options = {},
  progress?: (stage: string) => void,
): Promise<Mesh> {
  const module = await load();
  const list = Array.isArray(inputs) ? inputs : [inputs];
  const generated = withInputs(module, list, (names) => valueOf(module.generate(names, options, progress ?? null)));
  return new Mesh(module, generated);
}

/** Returns the closed bodies that inputs hold, as they will be meshed. Throws LaminaError. */
export async function outlines(inputs: Input | Input[]): Promise<Outline[]> {
  const module = await load();
  return withInputs(module, Array.isArray(inputs) ? inputs : [inputs], (names) => valueOf(module.outlines(names)));
}

/**
 * Returns the Delaunay triangulation of points (x, y, x, y, ...): three numbers of points for each triangle,
 * counter-clockwise. It is exact, and the same for every order of the points. Throws LaminaError for duplicate points.
 */
export async function delaunay(points: ArrayLike<number>): Promise<Uint32Array> {
  const module = await load();
  return valueOf(module.delaunay(points instanceof Float64Array ? points : Float64Array.from(points)));
}

/** Returns the options of mesh(). */
export async function optionRows(): Promise<OptionRow[]> {
  return (await load()).optionRows();
}

/** Returns the formats of Mesh.write(). */
export async function formats(): Promise<Format[]> {
  return (await load()).formats();
}

/** Returns the version of lamina. */
export async function version(): Promise<string> {
  return (await load()).version;
}
