// Delaunay triangulations with the arrays of delaunator, and with constraints: a small module of its own, which has
// nothing of the meshes. Decisions are exact.

// @ts-ignore: Emscripten writes it without types
import makeModule from "triangulation-module";
import {wasmBytes, type WasmSource} from "./wasm_bytes.ts";

/** The module that Emscripten makes of web/bindings/triangulation.cpp. Addresses are numbers of bytes. */
interface Module {
  HEAPU8: Uint8Array;
  _malloc(bytes: number): number;
  _free(address: number): void;
  _triangulate_arrays(coordinates: number, points: number, ends: number, segments: number): number;
  _numbers_of_view(view: number): number;
  _release(view: number): void;
}

let loaded: Module | undefined;
let loading: Promise<void> | undefined;

/**
 * Loads the WebAssembly module, once; the constructor needs it. Say where triangulation.wasm is unless it lies beside
 * this file.
 */
export function load(wasm: WasmSource = new URL("triangulation.wasm", import.meta.url)): Promise<void> {
  loading ??= wasmBytes(wasm)
    .then((wasmBinary) => makeModule({wasmBinary}) as Promise<Module>)
    .then((module) => void (loaded = module))
    .catch((error) => {
      loading = undefined;
      throw error;
    });
  return loading;
}

/** Copies numbers into the memory of the module, and returns their address. */
function copyIn(module: Module, numbers: Float64Array | Uint32Array): number {
  const address = module._malloc(numbers.byteLength);
  if (address === 0) throw new RangeError("out of memory: a page may use 4 GB");
  module.HEAPU8.set(new Uint8Array(numbers.buffer, numbers.byteOffset, numbers.byteLength), address);
  return address;
}

/** A Delaunay triangulation of points, with the arrays of delaunator. */
export class Triangulation {
  /** x and y of each point, as given. */
  readonly coords: ArrayLike<number>;
  /** Pairs of points that edges must run between. */
  readonly constraints: ArrayLike<number>;
  /** Three points of each triangle: clockwise where y points upwards, as in delaunator. */
  triangles = new Uint32Array(0);
  /**
   * For each half-edge the opposite one, -1 on the hull. Half-edge 3 t + i runs from corner i of triangle t to the
   * next one.
   */
  halfedges = new Int32Array(0);
  /** For each half-edge 1 where it lies on a constraint, else 0. */
  constrainedEdges = new Uint8Array(0);
  /** The points of the hull in the order of its half-edges; points on one line from end to end. */
  hull = new Uint32Array(0);

  /**
   * Triangulates points (x, y, x, y, ...) with edges along `constraints` (from, to, from, to, ...), which may pass
   * through other points, but must not cross. Of equal points the first counts. Throws Error for other input, and
   * before load().
   */
  constructor(coords: ArrayLike<number>, constraints: ArrayLike<number> = []) {
    if (coords.length > 0 && typeof coords[0] !== "number") throw new Error("Expected coords to contain numbers.");
    this.coords = coords;
    this.constraints = constraints;
    this.update();
  }

  /** Does the same for points of any form. */
  static from<P = ArrayLike<number>>(
    points: ArrayLike<P>,
    x: (point: P) => number = (point) => (point as ArrayLike<number>)[0],
    y: (point: P) => number = (point) => (point as ArrayLike<number>)[1],
    constraints: ArrayLike<number> = [],
  ): Triangulation {
    const coords = new Float64Array(2 * points.length);
    for (let i = 0; i < points.length; i++) {
      coords[2 * i] = x(points[i]);
      coords[2 * i + 1] = y(points[i]);
    }
    return new Triangulation(coords, constraints);
  }

  /** The number of half-edges. */
  get trianglesLen(): number {
    return this.triangles.length;
  }

  /** Triangulates again, after coords or constraints were changed. */
  update(): void {
    if (!loaded) throw new Error("await load() before the first triangulation");
    const module = loaded;
    const coordinates = new Float64Array(this.coords.length);
    coordinates.set(this.coords);
    const ends = Uint32Array.from(this.constraints);
    if (coordinates.length % 2 || ends.length % 2) throw new Error("coords and constraints hold pairs of numbers");
    const addresses: number[] = [];
    try {
      addresses.push(copyIn(module, coordinates));
      addresses.push(copyIn(module, ends));
      this.#takeFrom(
        module,
        module._triangulate_arrays(addresses[0], coordinates.length / 2, addresses[1], ends.length / 2),
      );
    } finally {
      for (const address of addresses) module._free(address);
    }
  }

  /** Copies the arrays out of the memory of the module, and frees them there. */
  #takeFrom(module: Module, view: number): void {
    try {
      const memory = module.HEAPU8.buffer;
      const [triangles, corners, halfedges, constrained, hull, hullSize, error, errorSize] = new Uint32Array(
        memory,
        module._numbers_of_view(view),
        8,
      );
      if (errorSize) throw new Error(new TextDecoder().decode(module.HEAPU8.slice(error, error + errorSize)));
      this.triangles = new Uint32Array(memory, triangles, corners).slice();
      this.halfedges = new Int32Array(memory, halfedges, corners).slice();
      this.constrainedEdges = new Uint8Array(memory, constrained, corners).slice();
      this.hull = new Uint32Array(memory, hull, hullSize).slice();
    } finally {
      module._release(view);
    }
  }
}

/** The same under the name that code for delaunator knows. */
export default Triangulation;
