// Makes meshes beside the page, so that the page answers while it does. It keeps the last mesh, which it can write.
import {formats, LaminaError, load, loadThreads, mesh, optionRows, threadCount, version, zip} from "./lamina.ts";
import type {Mesh} from "./lamina.ts";
import type {Download, MadeMesh, Offer, ReplyMessage, Request} from "./messages.ts";

let last: Mesh | undefined;

function send(message: ReplyMessage, transfer: Transferable[] = []): void {
  (self as unknown as Worker).postMessage(message, transfer);
}

async function begin(): Promise<Offer> {
  // Threads are a matter of speed: where they fail, for want of memory they share, one will do.
  await (self.crossOriginIsolated ? loadThreads().catch(() => load()) : load());
  return {threads: await threadCount(), version: await version(), rows: await optionRows(), formats: await formats()};
}

async function make(request: Request & {kind: "mesh"}, number: number): Promise<MadeMesh> {
  const start = performance.now();
  last?.delete();
  last = undefined;
  last = await mesh(request.inputs, request.options, (stage) => send({number, stage}));
  const {points, triangles, quads, markers, region, piece, layer, constraints, warnings, facts} = last;
  const seconds = (performance.now() - start) / 1000;
  const arrays = {points, triangles, quads, markers, region, piece, layer, constraints};
  return {arrays, warnings, facts, seconds};
}

function write({name, format}: Request & {kind: "write"}): Download {
  if (!last) throw new LaminaError({kind: "usage", message: "there is no mesh to write"});
  const files = last.write(name, {format});
  if (files.length === 1) return {name, bytes: files[0]!.bytes as Uint8Array<ArrayBuffer>};
  return {name: `${name}.zip`, bytes: zip(files) as Uint8Array<ArrayBuffer>};
}

function buffersOf(value: Offer | MadeMesh | Download): Transferable[] {
  if ("bytes" in value) return [value.bytes.buffer];
  if (!("arrays" in value)) return [];
  const {markers, ...arrays} = value.arrays;
  return [...Object.values(arrays), ...markers.map(({edges}) => edges)].map(({buffer}) => buffer as ArrayBuffer);
}

self.onmessage = async ({data}: MessageEvent<Request & {number: number}>) => {
  const {number} = data;
  try {
    const value = data.kind === "begin" ? await begin() : data.kind === "mesh" ? await make(data, number) : write(data);
    send({number, value}, buffersOf(value));
  } catch (error) {
    const failure =
      error instanceof LaminaError
        ? {
            kind: error.kind,
            message: error.message,
            file: error.file,
            line: error.line,
            option: error.option,
            at: error.at,
          }
        : {kind: "internal" as const, message: String(error)};
    send({number, error: failure});
  }
};
