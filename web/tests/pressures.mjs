// Tries the layout of the chart of pressures, without a browser: node --test pressures.mjs.
import assert from "node:assert/strict";
import {test} from "node:test";
import {fileURLToPath} from "node:url";
import {build} from "esbuild";

const web = fileURLToPath(new URL("..", import.meta.url));
const {outputFiles} = await build({
  absWorkingDir: web,
  entryPoints: ["src/pressures.ts"],
  alias: {"report-page": `${web}../share/page`},
  bundle: true,
  format: "esm",
  write: false,
});
const {layoutOf, nearestPlace} = await import(`data:text/javascript,${encodeURIComponent(outputFiles[0].text)}`);

/** Returns an element whose points lie at these places, with these pressures. */
const elementOf = (name, x, cp) => ({
  name,
  points: Float64Array.from(x.flatMap((at) => [at, 0.1])),
  cp: Float64Array.from(cp),
});
const facts = {alpha: 2, lift: 0.3, mach: null, critical_cp: null, compressible: false};
const flow = {...facts, elements: [elementOf("main", [3, 2, 1, 2, 3], [0.2, -1, 1, 0.4, 0.2])]};

test("suction points upwards, and x counts chords from the foremost point", () => {
  const {curves, cpTicks, xTicks, critical} = layoutOf(flow, 2);
  const [{x, y}] = curves;
  assert(y[1] < y[0] && y[0] < y[2], "fast flow must be above slow flow");
  assert.equal(Math.min(...y), y[1]);
  assert.equal(x[0], x[4]);
  assert(Math.abs(x[1] - 0.5 * (x[0] + x[2])) < 1e-9);
  assert.equal(critical, undefined);
  assert.equal(xTicks[0].text, "0");
  assert.equal(xTicks.at(-1).text, "1");
  assert(Math.abs(xTicks.at(-1).x - x[0]) < 1e-9 && Math.abs(xTicks[0].x - x[2]) < 1e-9);
  assert.deepEqual(
    cpTicks.map(({text}) => text),
    ["−1", "−0.5", "0", "0.5", "1"],
  );
  assert(Math.abs(cpTicks[4].y - y[2]) < 1e-9);
});

test("a section that is a bit shorter than its chord has a last tick", () => {
  const short = {...facts, elements: [elementOf("main", [0.99999996, 0, 0.99999996], [0.2, 1, 0.2])]};
  assert.equal(layoutOf(short, 1).xTicks.at(-1).text, "1");
});

test("cp* is a level where pressures reach it, and none where they do not", () => {
  const {curves, critical} = layoutOf({...flow, mach: 0.6, critical_cp: -1}, 2);
  assert.equal(critical, curves[0].y[1]);
  assert.equal(layoutOf({...flow, mach: 0.2, critical_cp: -16}, 2).critical, undefined);
});

test("a peak at a sharp corner does not hide the rest, but a shock is shown whole", () => {
  const cp = Array.from({length: 100}, (_, i) => (i === 50 ? -400 : -0.5)),
    peaked = {
      ...facts,
      elements: [
        elementOf(
          "main",
          Array.from(cp, (_, i) => Math.abs(i - 50)),
          cp,
        ),
      ],
    };
  const potential = layoutOf(peaked, 50),
    compressible = layoutOf({...peaked, compressible: true}, 50);
  assert.equal(potential.cpTicks[0].text, "−1");
  assert(compressible.cpTicks[0].text.startsWith("−400"));
  for (const {curves} of [potential, compressible]) for (const y of curves[0].y) assert(y >= 10 && y <= 166);
});

test("the nearest point of all elements is found, within reach alone", () => {
  const curves = [
    {x: [0, 1], y: [0, 0]},
    {x: [5, 6], y: [0, 1]},
  ];
  assert.deepEqual(nearestPlace(curves, 5.9, 0.9, 1), {element: 1, point: 1});
  assert.deepEqual(nearestPlace(curves, 0.1, 0, 1), {element: 0, point: 0});
  assert.equal(nearestPlace(curves, 3, 3, 1), undefined);
  assert.equal(nearestPlace([], 0, 0, 1), undefined);
});
