// What the page and its worker tell each other. Each request has a number, which the replies to it carry.
import type {Facts, Failure, Format, InputFile, MeshArrays, OptionRow, Options, Warning} from "./values.ts";

export type Request =
  | {kind: "begin"}
  | {kind: "mesh"; inputs: (string | InputFile)[]; options: Options}
  | {kind: "write"; name: string; format: string};

/** What the library offers. */
export interface Offer {
  version: string;
  /** How many a mesh is made on. */
  threads: number;
  rows: OptionRow[];
  formats: Format[];
}

/** A mesh as plain arrays, which move to the page without a copy. */
export interface MadeMesh {
  arrays: MeshArrays;
  warnings: Warning[];
  facts: Facts;
  /** From the request to the arrays, in seconds. */
  seconds: number;
}

/** A file to download. */
export interface Download {
  name: string;
  bytes: Uint8Array<ArrayBuffer>;
}

export type ReplyMessage =
  | {number: number; stage: string}
  | {number: number; value: Offer | MadeMesh | Download}
  | {number: number; error: Failure};
