// Meshes the cases of cases.json with the native program and with the npm package, in Node.js and on several threads in
// Debian's Chromium, and compares the SHA-256 of every file: node same_bytes.mjs PROGRAM. What is refused must be refused
// in the same words on threads. The exit status is 1 where one differs.
import {execFileSync} from "node:child_process";
import {createHash} from "node:crypto";
import {mkdtempSync, readdirSync, readFileSync, rmSync, statSync} from "node:fs";
import {tmpdir} from "node:os";
import {basename, join, resolve} from "node:path";
import {fileURLToPath} from "node:url";
import {chromium} from "playwright-core";
import {mesh} from "../../build/browser/package/dist/lamina.js";
import {isolation, serve} from "../serve.mjs";

const root = fileURLToPath(new URL("../..", import.meta.url));
const program = resolve(process.argv[2] ?? `${root}build/release/src/app/lamina`);
const cases = JSON.parse(readFileSync(new URL("cases.json", import.meta.url)));
/** What each run of the program writes: names of files, and the format where it does not follow from the name. */
const runs = [
  {names: ["mesh.su2", "mesh.msh", "mesh.vtu", "polyMesh"], format: ""},
  {names: ["packed.vtu"], format: "vtu-zlib"},
];

/** Returns the runs of a case: curved cells stand in few formats. */
function runsOf({options}) {
  const isWritten = (name) => !("order" in options) || /(msh|vtu)$/.test(name);
  return runs.map(({names, format}) => ({names: names.filter(isWritten), format}));
}

/** What the library refuses: by an option, by a file, and by where bodies lie. */
const refusedCases = [
  {inputs: ["naca:0012"], options: {growth: 0.5}},
  {inputs: ["naca:0012"], options: {groth: 1.2}},
  {inputs: [{name: "bad.dat", text: "bad\n1 0\n0.5 nonsense\n"}], options: {}},
  {inputs: ["naca:0012", "naca:2412"], options: {}},
  {inputs: ["naca:0012"], options: {y_plus: 1}},
];

const hash = (bytes) => createHash("sha256").update(bytes).digest("hex");

function argumentsOf({inputs, options}) {
  const words = [...inputs];
  for (const [key, value] of Object.entries(options)) {
    const name = `--${key.replaceAll("_", "-")}`;
    if (value === true) words.push(name);
    else for (const one of [value].flat()) words.push(name, String(one));
  }
  return words;
}

/** Returns the hash of each file below a folder. */
function hashesBelow(folder, prefix = "") {
  const hashes = {};
  for (const name of readdirSync(folder)) {
    const path = join(folder, name);
    if (statSync(path).isDirectory()) Object.assign(hashes, hashesBelow(path, `${prefix}${name}/`));
    else hashes[prefix + name] = hash(readFileSync(path));
  }
  return hashes;
}

/** Returns the hashes of the files that the native program writes, and the seconds that it took to make the mesh. */
function nativeHashes(meshCase) {
  const folder = mkdtempSync(join(tmpdir(), "lamina-web-"));
  try {
    // Where layers are not said to be triangles, those of a mesh for OpenFOAM alone become quadrilaterals.
    const topology = "layer_topology" in meshCase.options ? [] : ["--layer-topology", "layered"];
    const report = join(folder, "report.json");
    let seconds = 0;
    for (const {names, format} of runsOf(meshCase)) {
      const files = names.flatMap((name) => ["-o", join(folder, name)]);
      execFileSync(
        program,
        [
          "mesh",
          ...argumentsOf(meshCase),
          ...topology,
          "--quiet",
          "--threads",
          "1",
          ...files,
          ...(format ? ["--format", format] : []),
          "--report",
          report,
        ],
        {cwd: root, stdio: ["ignore", "ignore", "pipe"]},
      );
      const times = JSON.parse(readFileSync(report)).seconds;
      seconds = times.total - times.write;
      rmSync(report);
    }
    const hashes = hashesBelow(folder);
    return {hashes, seconds};
  } finally {
    rmSync(folder, {recursive: true});
  }
}

function filesOf({inputs}) {
  return inputs.map((input) =>
    typeof input !== "string" || input.startsWith("naca:")
      ? input
      : {name: basename(input), text: readFileSync(join(root, input), "utf8")},
  );
}

async function nodeHashes(meshCase) {
  const made = await mesh(filesOf(meshCase), meshCase.options);
  const hashes = {};
  for (const {names, format} of runsOf(meshCase))
    for (const name of names) for (const file of made.write(name, {format})) hashes[file.name] = hash(file.bytes);
  made.delete();
  return {hashes, cells: made.cellCount, seconds: made.facts.seconds};
}

/** Starts a browser; returns a function like nodeHashes(), and one that ends it. */
async function startBrowser() {
  const {address, close} = await serve(root);
  const browser = await chromium.launch({executablePath: "/usr/bin/chromium", args: ["--no-sandbox"]});
  const page = await browser.newPage();
  await page.route(`${address}empty`, (route) =>
    route.fulfill({contentType: "text/html", headers: isolation, body: "<!doctype html>"}),
  );
  await page.goto(`${address}empty`);
  await page.evaluate(() => {
    window.meshes = new Worker("/web/tests/mesh_on_threads.mjs", {type: "module"});
  });
  const threadHashes = async (meshCase) => {
    const made = await page.evaluate(
      (request) =>
        new Promise((resolve) => {
          window.meshes.onmessage = ({data}) => resolve(data);
          window.meshes.onerror = ({message}) => resolve({failure: message});
          window.meshes.postMessage(request);
        }),
      {inputs: filesOf(meshCase), options: {threads: 3, ...meshCase.options}, runs: runsOf(meshCase)},
    );
    if (made.failure) throw new Error(made.failure);
    return made;
  };
  const end = async () => {
    await browser.close();
    close();
  };
  return {threadHashes, end};
}

const {threadHashes, end} = await startBrowser();
let different = 0,
  files = 0,
  expected = 0;
for (const meshCase of cases) {
  const native = nativeHashes(meshCase);
  // polyMesh is five files.
  for (const name of runsOf(meshCase).flatMap(({names}) => names)) expected += name === "polyMesh" ? 10 : 2;
  for (const [where, hashesOf] of [
    ["Node.js", nodeHashes],
    ["threads", threadHashes],
  ]) {
    const web = await hashesOf(meshCase);
    const names = [...new Set([...Object.keys(native.hashes), ...Object.keys(web.hashes)])];
    const wrong = names.filter((name) => native.hashes[name] !== web.hashes[name]);
    files += names.length;
    different += wrong.length;
    console.log(
      `${wrong.length ? `DIFFERENT (${wrong.join(", ")})` : "same"}  ${where}  ${argumentsOf(meshCase).join(" ")}: ` +
        `${web.cells} cells, ${web.seconds.toFixed(2)} s, native ${native.seconds.toFixed(2)} s`,
    );
  }
}
for (const refusedCase of refusedCases) {
  const {kind, message} = await mesh(filesOf(refusedCase), refusedCase.options).catch((error) => error);
  const {refused} = await threadHashes(refusedCase);
  const same = refused?.kind === kind && refused?.message === message;
  if (!same) ++different;
  console.log(`${same ? "same" : `DIFFERENT (${refused?.message})`}  threads  refused: ${message}`);
}
await end();
console.log(`${cases.length} cases, ${files} files, ${refusedCases.length} refusals, ${different} differ`);
process.exitCode = different > 0 || files !== expected ? 1 : 0;
