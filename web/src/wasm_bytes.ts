// Where the bytes of a WebAssembly module come from, in browsers and in Node.js.

/** The bytes of a WebAssembly module, or where they are. */
export type WasmSource = URL | string | ArrayBuffer | Uint8Array;

/** Returns the bytes of a module. Addresses are relative to the file of the package that is loaded. */
export async function wasmBytes(source: WasmSource): Promise<ArrayBuffer | Uint8Array> {
  if (source instanceof ArrayBuffer || source instanceof Uint8Array) return source;
  const url = new URL(source, import.meta.url);
  if (url.protocol === "file:" && typeof process === "object") {
    const {readFile} = await import(/* @vite-ignore */ nodeFiles);
    return readFile(url);
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url} cannot be loaded: ${response.status} ${response.statusText}`);
  return response.arrayBuffer();
}

// A name that bundlers for browsers do not follow.
const nodeFiles: string = "node:fs/promises";
declare const process: unknown;
