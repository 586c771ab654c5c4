// What a mesh is made of, as text that links hold behind their "#", such as naca=2412&reynolds=6e6&alpha=4. Files stand in
// it with their names, compressed.
import {deflateSync, inflateSync, strFromU8, strToU8} from "fflate";

export interface Case {
  /** The NACA section, which counts where there are no files. */
  naca: string;
  files: {name: string; text: Uint8Array}[];
  /** The texts of the options that are set, by their keys. */
  options: Map<string, string>;
}

export const firstNaca = "0012";
/** Browsers take links of this many characters, and more would be of no use. */
export const longestLink = 500_000;

const packedTexts = new WeakMap<Uint8Array, string>();

function packed(bytes: Uint8Array): string {
  let text = packedTexts.get(bytes);
  if (text === undefined) {
    const words = btoa(strFromU8(deflateSync(bytes, {level: 9}), true));
    text = words.replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
    packedTexts.set(bytes, text);
  }
  return text;
}

function unpacked(text: string): Uint8Array {
  return inflateSync(strToU8(atob(text.replaceAll("-", "+").replaceAll("_", "/")), true));
}

/** Returns a case as text; the empty text is the case that the page begins with. */
export function textOfCase({naca, files, options}: Case): string {
  const pairs: [string, string][] = files.map(({name, text}) => ["file", `${name}:${packed(text)}`]);
  if (files.length === 0 && naca !== firstNaca) pairs.push(["naca", naca]);
  return [...pairs, ...[...options].sort(([one], [other]) => (one < other ? -1 : 1))]
    .map(([key, value]) => `${key}=${encodeURIComponent(value).replaceAll("%3A", ":").replaceAll("%2C", ",")}`)
    .join("&");
}

/** Returns the case that a text holds. Throws an Error where it is damaged. */
export function caseOfText(text: string): Case {
  const made: Case = {naca: firstNaca, files: [], options: new Map()};
  for (const pair of text.split("&").filter((part) => part !== "")) {
    try {
      const [, key, value] = /^(\w+)=(.*)$/s.exec(pair)!,
        meant = decodeURIComponent(value!);
      if (key === "naca") made.naca = meant;
      else if (key === "file") {
        const [, name, coordinates] = /^(.+):([\w-]+)$/s.exec(meant)!;
        made.files.push({name: name!, text: unpacked(coordinates!)});
      } else made.options.set(key!, meant);
    } catch {
      throw new Error(`the link is damaged at "${pair.slice(0, 40)}"`);
    }
  }
  return made;
}

/** The cases that a person has had, to go back through. */
export class CaseHistory {
  #texts: string[];

  constructor(first: string) {
    this.#texts = [first];
  }

  get now(): string {
    return this.#texts.at(-1)!;
  }

  get canUndo(): boolean {
    return this.#texts.length > 1;
  }

  add(text: string): void {
    if (text !== this.now) this.#texts.push(text);
  }

  /** Goes back by one case, and returns it. */
  undo(): string {
    if (this.canUndo) this.#texts.pop();
    return this.now;
  }
}

/** A case to begin with; its files lie beside the page. */
export interface Example {
  label: string;
  files: string[];
  text: string;
}

const highLift = ["slat", "main", "flap"].map((part) => `crmhl2d_${part}.dat`);
export const examples: Example[] = [
  {label: "NACA 0012, turbulent layer", files: [], text: "reynolds=6e6"},
  {
    label: "NACA 2412 at 6 degrees, quadrilaterals",
    files: [],
    text: "naca=2412&reynolds=3e6&alpha=6&layer_topology=quads",
  },
  {
    label: "NACA 4412 with a base, layers along the wake",
    files: [],
    text: "naca=4412:blunt&reynolds=6e6&wake_layers=yes",
  },
  {
    label: "RAE 2822, transonic: finer at the shock",
    files: ["rae2822.dat"],
    text: "reynolds=6.5e6&mach=0.729&alpha=2.31",
  },
  {label: "CRM-HL with slat and flap", files: highLift, text: "reynolds=5e6&alpha=8"},
  {label: "NACA 0012, inviscid", files: [], text: "preset=euler"},
  {label: "NACA 0012, curved cells of order 3", files: [], text: "reynolds=6e6&layer_topology=quads&order=3"},
];
