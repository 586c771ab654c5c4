// Bundles the page into build/browser/site and the npm package into build/browser/package. The modules of
// Emscripten must be in build/browser/module and build/browser/module-threads.
import {build} from "esbuild";
import {cp, mkdir, readFile, rm, writeFile} from "node:fs/promises";
import {execFileSync} from "node:child_process";
import {fileURLToPath} from "node:url";

const root = fileURLToPath(new URL("..", import.meta.url));
const module = `${root}build/browser/module`,
  threads = `${root}build/browser/module-threads`,
  site = `${root}build/browser/site`,
  made = `${root}build/browser/package`;
const alias = {
  "lamina-module": `${module}/lamina.mjs`,
  "triangulation-module": `${module}/triangulation.mjs`,
  "report-page": `${root}share/page`,
};
const shared = {
  bundle: true,
  format: "esm",
  target: "es2022",
  minify: true,
  alias,
  logLevel: "warning",
  legalComments: "none",
  absWorkingDir: `${root}web`,
};

for (const folder of [site, made]) {
  await rm(folder, {recursive: true, force: true});
  await mkdir(folder, {recursive: true});
}

await build({...shared, entryPoints: ["src/page.ts", "src/worker.ts"], outdir: site});
await cp("src/index.html", `${site}/index.html`);
const isExample = (path) => !/\.(md|svg)$/.test(path);
await cp(`${root}examples/geometry`, `${site}/examples`, {recursive: true, filter: isExample});
const styles = await Promise.all([`${root}share/page/page.css`, "src/page.css"].map((file) => readFile(file, "utf8")));
await writeFile(`${site}/page.css`, styles.join("\n"));
await cp(`${module}/lamina.wasm`, `${site}/lamina.wasm`);
await cp(threads, `${site}/threads`, {recursive: true});

await build({...shared, entryPoints: ["src/lamina.ts", "src/triangulation.ts"], outdir: `${made}/dist`});
for (const name of ["lamina", "triangulation"]) await cp(`${module}/${name}.wasm`, `${made}/dist/${name}.wasm`);
await cp(threads, `${made}/dist/threads`, {recursive: true});
execFileSync("node_modules/.bin/tsc", ["-p", "tsconfig.types.json", "--outDir", `${made}/dist`], {stdio: "inherit"});
const {scripts, devDependencies, prettier, ...published} = JSON.parse(await readFile("package.json", "utf8"));
await writeFile(`${made}/package.json`, `${JSON.stringify(published, null, 2)}\n`);
for (const file of ["README.md", "../LICENSE"]) await cp(file, `${made}/${file.replace("../", "")}`);
