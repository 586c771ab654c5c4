// The worker that same_bytes.mjs starts in a browser: it meshes a case on threads, and replies with the hash of each file,
// or with what the library refused.
import {LaminaError, loadThreads, mesh, threadCount} from "../../build/browser/package/dist/lamina.js";

const hex = (bytes) => Array.from(new Uint8Array(bytes), (byte) => byte.toString(16).padStart(2, "0")).join("");

self.onmessage = async ({data: {inputs, options, runs}}) => {
  try {
    await loadThreads();
    const made = await mesh(inputs, options),
      hashes = {};
    for (const {names, format} of runs)
      for (const name of names)
        for (const file of made.write(name, {format}))
          hashes[file.name] = hex(await crypto.subtle.digest("SHA-256", file.bytes));
    made.delete();
    self.postMessage({hashes, cells: made.cellCount, seconds: made.facts.seconds, threads: await threadCount()});
  } catch (error) {
    const refused = error instanceof LaminaError && {kind: error.kind, message: error.message};
    self.postMessage(refused ? {refused} : {failure: String(error.stack ?? error)});
  }
};
