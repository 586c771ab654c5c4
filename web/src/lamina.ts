// lamina in JavaScript: viscous meshes round airfoils, and Delaunay triangulations. The work is done by lamina's C++
// code, compiled to WebAssembly; it makes the same meshes as the native program, bit by bit.

// @ts-ignore: Emscripten writes it without types
import makeModule from "lamina-module";
import {zipSync, type Zippable} from "fflate";
import {LaminaError} from "./error.ts";
import {wasmBytes, type WasmSource} from "./wasm_bytes.ts";
import type {Generated, HeldMesh, MakeModule, Module, Reply} from "./module.ts";

export {LaminaError};

/** A file in memory: its name, which names the marker of its section, and its text. */
export interface InputFile {
  name: string;
  text: string | Uint8Array;
}

/** What to mesh: a NACA section such as "naca:0012", or a file of coordinates. */
export type Input = string | InputFile;

/** The value of an option, as in a case file. */
export type OptionValue = number | string | boolean | string[];

/** Options by their names in case files, such as first_height. optionRows() lists them all. */
export type Options = Record<string, OptionValue>;

/** One option of mesh(). */
export interface OptionRow {
  key: string;
  kind:
    | "number"
    | "number_or_range"
    | "number_or_word"
    | "length"
    | "count"
    | "count_or_auto"
    | "flag"
    | "word"
    | "words"
    | "repeated"
    | "path"
    | "paths";
  /** What stands for the value in help; the words of an option of kind "word", parted by bars. */
  metavar: string;
  help: string;
  /** The values that it takes, such as "> 0 and <= 90"; empty where the metavar says it. */
  range: string;
  group: string;
  default: OptionValue | null;
  /** Keys of options that must not be given beside this one. */
  excludes: string[];
}

export interface Marker {
  name: string;
  kind: "wall" | "far_field" | "symmetry" | "other" | "periodic" | "internal";
  /** Pairs of vertices; the mesh lies on the left of each edge. */
  edges: Uint32Array;
}

/** The arrays of a mesh. Those with an entry per cell have the triangles before the quadrilaterals. */
export interface MeshArrays {
  /** x and y of each vertex. */
  points: Float64Array;
  /** Three vertices of each triangle, counter-clockwise. */
  triangles: Uint32Array;
  /** Four vertices of each quadrilateral, counter-clockwise. */
  quads: Uint32Array;
  markers: Marker[];
  /** Per cell: 0 in the layer at the walls, 1 elsewhere. */
  region: Uint8Array;
  /** Per cell: the subdomain that made it. */
  piece: Uint32Array;
  /** Per cell: its layer from the wall, from 1; 0 outside the layer. */
  layer: Uint16Array;
  /** Pairs of vertices of interior edges that are exempt from the Delaunay property. */
  constraints: Uint32Array;
}

export interface Warning {
  code: string;
  element: string;
  at: [number, number] | null;
  number: number;
  unit: string;
  message: string;
}

export interface Quality {
  cells: number;
  min_angle: number;
  max_angle: number;
  mean_ratio: number;
  max_aspect_ratio: number;
  /** The numbers of smallest angles in [0, 5), [5, 10), ... degrees. */
  angle_histogram: Uint32Array;
}

export interface ElementFacts {
  name: string;
  source: string;
  title: string;
  wall_vertices: number;
  trailing_edge: [number, number];
  /** In units of the input; null without layers. */
  first_height: number | null;
  repairs: string[];
}

/** A part of the plane with a name. */
export interface Place {
  name: string;
  /** Smallest x, smallest y, largest x, largest y. */
  window: [number, number, number, number];
}

/** How cells of an order above 1 follow the walls. All are proved valid. */
export interface Curving {
  order: number;
  wall_edges: number;
  curved_wall_edges: number;
  min_scaled_jacobian: number;
}

export interface Facts {
  /** The reference chord, in units of the input. */
  chord: number;
  elements: ElementFacts[];
  /** Parts of the plane that people want to see: "all", "walls", "nose:1", "tail:1", "slot:1", as `lamina plot` knows. */
  places: Place[];
  layer: Quality;
  isotropic: Quality;
  /** Null where the cells are straight. */
  curved: Curving | null;
  /** The time that the mesh took. */
  seconds: number;
}

/** One closed body that an input holds. */
export interface Outline {
  name: string;
  title: string;
  format: string;
  /** x and y of each point, counter-clockwise. */
  points: Float64Array;
  repairs: string[];
}

/** A format that Mesh.write() knows. */
export interface Format {
  name: string;
  extensions: string[];
  description: string;
}

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

/** A file that Mesh.write() made. */
export interface OutputFile {
  name: string;
  bytes: Uint8Array;
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
