// Compares what numbers become as text, and texts as numbers, in WebAssembly and natively.
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {readFileSync} from "node:fs";
import {fileURLToPath} from "node:url";

const built = fileURLToPath(new URL("../../build/browser", import.meta.url)),
  tests = fileURLToPath(new URL(".", import.meta.url));
execFileSync("c++", ["-std=c++20", "-O2", "-ffp-contract=off", `${tests}numbers.cpp`, "-o", `${built}/numbers`]);
const native = execFileSync(`${built}/numbers`, {encoding: "utf8"}).trimEnd().split("\n");

const web = [];
const {default: run} = await import(`${built}/module/numbers.mjs`);
await run({wasmBinary: readFileSync(`${built}/module/numbers.wasm`), print: (line) => web.push(line)});
assert.equal(native.length, 218);
assert.deepEqual(web, native);
console.log("200,000 numbers, and as many texts: the same");
