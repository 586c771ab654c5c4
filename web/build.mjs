// Bundles the npm package into build/web/package. The module of Emscripten must be in build/web/module.
import {build} from "esbuild";
import {cp, mkdir, readFile, rm, writeFile} from "node:fs/promises";
import {execFileSync} from "node:child_process";
import {fileURLToPath} from "node:url";

const root = fileURLToPath(new URL("..", import.meta.url));
const module = `${root}build/web/module`, made = `${root}build/web/package`;
const alias = {"lamina-module": `${module}/lamina.mjs`};
const shared = {bundle: true, format: "esm", target: "es2022", minify: true, alias, logLevel: "warning",
                legalComments: "none", absWorkingDir: `${root}web`};

await rm(made, {recursive: true, force: true});
await mkdir(made, {recursive: true});

await build({...shared, entryPoints: ["src/lamina.ts"], outdir: `${made}/dist`});
await cp(`${module}/lamina.wasm`, `${made}/dist/lamina.wasm`);
execFileSync("node_modules/.bin/tsc", ["-p", "tsconfig.types.json", "--outDir", `${made}/dist`], {stdio: "inherit"});
const {scripts, devDependencies, ...published} = JSON.parse(await readFile("package.json", "utf8"));
await writeFile(`${made}/package.json`, `${JSON.stringify(published, null, 2)}\n`);
for (const file of ["README.md", "../LICENSE"]) await cp(file, `${made}/${file.replace("../", "")}`);
