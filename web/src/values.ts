// The values that lamina takes and gives in JavaScript.

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

/** The pressures on the walls of one element. */
export interface WallPressures {
  name: string;
  /** x and y of each point, from the trailing edge along the upper side and along the lower one back to it. */
  points: Float64Array;
  /** The pressure coefficient at each point. */
  cp: Float64Array;
}

/** The flow before the mesh, which decided on first heights, sizes and wakes. */
export interface FlowFacts {
  /** The angle of attack in degrees: of several, the one in the middle. */
  alpha: number;
  /** Its lift coefficient. */
  lift: number;
  mach: number | null;
  /** The pressure coefficient at which flow is as fast as sound; null without a Mach number. */
  critical_cp: number | null;
  /** Whether it solves the Euler equations; else it is potential flow, with pressures after Karman and Tsien. */
  compressible: boolean;
  elements: WallPressures[];
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
  /** Null where no flow decided: without a Reynolds number, where it could not be solved, and where it was not asked for. */
  flow: FlowFacts | null;
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

/** A file that Mesh.write() made. */
export interface OutputFile {
  name: string;
  bytes: Uint8Array;
}

/** What went wrong: LaminaError holds the same. */
export interface Failure {
  kind: "input" | "option" | "usage" | "mesh" | "io" | "memory" | "internal";
  message: string;
  file?: string;
  line?: number;
  option?: string;
  at?: [number, number] | null;
}
