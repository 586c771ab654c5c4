// Serves a folder on this computer alone: node serve.mjs [FOLDER] [PORT]; port 0 takes a free one.
import {createServer} from "node:http";
import {readFile} from "node:fs/promises";
import {extname, join, normalize, resolve} from "node:path";
import {fileURLToPath} from "node:url";

const types = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript",
  ".mjs": "text/javascript",
  ".css": "text/css",
  ".wasm": "application/wasm",
};

/** What a page has to be served with to be isolated from others, so that browsers let it have threads. */
export const isolation = {"cross-origin-opener-policy": "same-origin", "cross-origin-embedder-policy": "require-corp"};

/** Starts a server; the promise is that of its address. */
export function serve(folder, port = 0, isolated = true) {
  const root = resolve(folder);
  const server = createServer(async (request, response) => {
    // What is no address throws, too, and must not end the server.
    try {
      const path = decodeURIComponent(new URL(request.url, "http://localhost").pathname);
      const file = join(root, normalize(path.endsWith("/") ? `${path}index.html` : path));
      if (!file.startsWith(root)) throw new Error("outside");
      const bytes = await readFile(file);
      response.writeHead(200, {
        "content-type": types[extname(file)] ?? "application/octet-stream",
        "cache-control": "no-cache",
        ...(isolated ? isolation : {}),
      });
      response.end(bytes);
    } catch {
      response.writeHead(404).end("not found");
    }
  });
  return new Promise((done, failed) => {
    server.on("error", failed);
    server.listen(port, "127.0.0.1", () =>
      done({address: `http://127.0.0.1:${server.address().port}/`, close: () => server.close()}),
    );
  });
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [folder = fileURLToPath(new URL("../build/browser/site", import.meta.url)), port = "8080"] =
    process.argv.slice(2);
  const {address} = await serve(folder, Number(port));
  console.log(`${address} (Ctrl-C ends)`);
}
