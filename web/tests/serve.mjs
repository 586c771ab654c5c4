// Asks the server for what is no address, and for files outside of its folder: node --test serve.mjs.
import assert from "node:assert/strict";
import {mkdtemp, mkdir, rm, writeFile} from "node:fs/promises";
import {connect} from "node:net";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {test} from "node:test";
import {serve} from "../serve.mjs";

/** Returns the answer to GET of a text that no client would send. */
function get(address, path) {
  const {hostname, port} = new URL(address);
  return new Promise((done, failed) => {
    let answer = "";
    connect(Number(port), hostname, function () {
      this.write(`GET ${path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n`);
    })
      .on("data", (bytes) => (answer += bytes))
      .on("end", () => done(answer))
      .on("error", failed);
  });
}

test("what is no address ends no server, and files outside are not served", async () => {
  const folder = await mkdtemp(join(tmpdir(), "lamina-serve-"));
  await mkdir(join(folder, "site"));
  await writeFile(join(folder, "site", "index.html"), "the page");
  await writeFile(join(folder, "secret"), "a secret");
  const server = await serve(join(folder, "site"));
  try {
    for (const path of ["/%", "//[", "/%00", "/%E0%A4%A", "*", "/../secret", "/..%2fsecret", "/%2e%2e/secret"]) {
      const answer = await get(server.address, path);
      assert.match(answer, /^HTTP\/1.1 404 /, path);
      assert(!answer.includes("a secret"), path);
    }
    assert.match(await get(server.address, "/"), /^HTTP\/1.1 200 .*the page/s);
  } finally {
    server.close();
    await rm(folder, {recursive: true});
  }
});
