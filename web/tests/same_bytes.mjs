// Meshes the cases of cases.json with the native program and with the npm package, and compares the SHA-256 of every
// file: node same_bytes.mjs PROGRAM. The exit status is 1 where one differs.
import {execFileSync} from "node:child_process";
import {createHash} from "node:crypto";
import {mkdtempSync, readdirSync, readFileSync, rmSync, statSync} from "node:fs";
import {tmpdir} from "node:os";
import {basename, join, resolve} from "node:path";
import {fileURLToPath} from "node:url";
import {mesh} from "../../build/browser/package/dist/lamina.js";

const root = fileURLToPath(new URL("../..", import.meta.url));
const program = resolve(process.argv[2] ?? `${root}build/release/src/app/lamina`);
const cases = JSON.parse(readFileSync(new URL("cases.json", import.meta.url)));
/** What each run of the program writes: names of files, and the format where it does not follow from the name. */
const runs = [
  {names: ["mesh.su2", "mesh.msh", "mesh.vtu", "polyMesh"], format: ""},
  {names: ["packed.vtu"], format: "vtu-zlib"},
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
    for (const {names, format} of runs) {
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

async function webHashes({inputs, options}) {
  const files = inputs.map((input) =>
    input.startsWith("naca:") ? input : {name: basename(input), text: readFileSync(join(root, input))},
  );
  const made = await mesh(files, options);
  const hashes = {};
  for (const {names, format} of runs)
    for (const name of names) for (const file of made.write(name, {format})) hashes[file.name] = hash(file.bytes);
  made.delete();
  return {hashes, cells: made.cellCount, seconds: made.facts.seconds};
}

let different = 0,
  files = 0;
for (const meshCase of cases) {
  const native = nativeHashes(meshCase),
    web = await webHashes(meshCase);
  const names = [...new Set([...Object.keys(native.hashes), ...Object.keys(web.hashes)])];
  const wrong = names.filter((name) => native.hashes[name] !== web.hashes[name]);
  files += names.length;
  different += wrong.length;
  console.log(
    `${wrong.length ? `DIFFERENT (${wrong.join(", ")})` : "same"}  ${argumentsOf(meshCase).join(" ")}: ` +
      `${web.cells} cells, ${web.seconds.toFixed(2)} s, native ${native.seconds.toFixed(2)} s`,
  );
}
console.log(`${cases.length} cases, ${files} files, ${different} differ`);
process.exitCode = different > 0 || files !== 9 * cases.length ? 1 : 0;
