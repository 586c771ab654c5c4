// Tries the npm package in Node.js: node --test package.mjs.
import assert from "node:assert/strict";
import {test} from "node:test";
import {
  delaunay,
  formats,
  LaminaError,
  mesh,
  optionRows,
  outlines,
  version,
  zip,
} from "../../build/browser/package/dist/lamina.js";

/** Returns twice the area of each triangle. */
function doubledAreas(points, triangles) {
  const areas = [];
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => [points[2 * triangles[t + k]], points[2 * triangles[t + k] + 1]]);
    areas.push((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  }
  return areas;
}

test("a mesh covers its domain once", async () => {
  const stages = [];
  const made = await mesh("naca:0012", {far_field: 20, layer_topology: "delaunay"}, (stage) => stages.push(stage));
  const areas = doubledAreas(made.points, made.triangles);
  assert(Math.min(...areas) > 0);
  // The shoelace formula over the markers, which have the mesh on their left.
  let boundary = 0;
  for (const {edges} of made.markers)
    for (let e = 0; e < edges.length; e += 2) {
      const [a, b] = [edges[e], edges[e + 1]];
      boundary += made.points[2 * a] * made.points[2 * b + 1] - made.points[2 * b] * made.points[2 * a + 1];
    }
  const sum = areas.reduce((total, area) => total + area, 0);
  assert(Math.abs(sum - boundary) < 1e-9 * boundary, `${sum} ${boundary}`);
  assert.deepEqual(made.markers.map(({kind}) => kind).sort(), ["far_field", "wall"]);
  assert.equal(made.region.length, made.cellCount);
  assert.match(made.hash, /^[0-9a-f]{32}$/);
  assert(stages.length > 3);
  made.delete();
});

test("an outline in memory is the same as in a file of the package's own", async () => {
  const [section] = await outlines("naca:2412:100");
  assert.equal(section.points.length, 200);
  let text = "NACA 2412\n";
  for (let i = 0; i < section.points.length; i += 2) text += `${section.points[i]} ${section.points[i + 1]}\n`;
  const [again] = await outlines({name: "again.dat", text});
  assert.equal(again.name, "airfoil");
  assert.deepEqual([...again.points].sort(), [...section.points].sort());
});

test("a Delaunay triangulation has empty circles", async () => {
  let state = 1;
  const random = () => (state = (state * 48271) % 2147483647) / 2147483647;
  const points = Float64Array.from({length: 400}, random),
    triangles = await delaunay(points);
  assert(Math.min(...doubledAreas(points, triangles)) > 0);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => [points[2 * triangles[t + k]], points[2 * triangles[t + k] + 1]]);
    for (let p = 0; p < points.length; p += 2) {
      const rows = [a, b, c].map(([x, y]) => [x - points[p], y - points[p + 1]]).map(([x, y]) => [x, y, x * x + y * y]);
      const [u, v, w] = rows;
      const inside =
        u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
      assert(inside < 1e-12);
    }
  }
  assert.equal((await delaunay([0, 0, 1, 0, 1, 1, 0, 1])).length, 6);
});

test("errors say what is wrong, and the next call works", async () => {
  const rejects = async (promise, kind, pattern, facts = {}) => {
    const error = await promise.then(
      () => assert.fail("nothing was thrown"),
      (thrown) => thrown,
    );
    assert(error instanceof LaminaError, String(error));
    assert.equal(error.kind, kind);
    assert.match(error.message, pattern);
    for (const [name, value] of Object.entries(facts)) assert.deepEqual(error[name], value);
  };
  await rejects(mesh("naca:0012", {groth: 1.2}), "option", /did you mean 'growth'/, {option: "groth"});
  await rejects(mesh("naca:0012", {growth: 0.5}), "option", /growth: .* must be > 1/, {option: "growth"});
  await rejects(mesh("naca:0012", {growth: {}}), "option", /growth/);
  await rejects(mesh("naca:0012", {y_plus: 1}), "option", /needs reynolds/);
  await rejects(mesh({name: "bad.dat", text: "bad\n1 0\n0.5 nonsense\n"}), "input", /bad\.dat:3/, {
    file: "bad.dat",
    line: 3,
  });
  await rejects(mesh("missing.dat"), "io", /missing\.dat/);
  await rejects(
    mesh([
      {name: "a/x.dat", text: "1 0"},
      {name: "x.dat", text: "1 0"},
    ]),
    "usage",
    /two files/,
  );
  await rejects(delaunay([0, 0, 1, 0, 0, 0]), "input", /./);
  await rejects(delaunay([0, 0, 1]), "usage", /even/);
  const made = await mesh("naca:0012", {far_field: 5});
  assert.throws(() => made.write("mesh.nonsense"), LaminaError);
  made.delete();
});

test("meshes beyond the memory of a page are refused before the work", async () => {
  const error = await mesh("naca:0012", {refine: ["box:-2,-2,3,2,1e-5"]}).catch((thrown) => thrown);
  assert.equal(error.kind, "option");
  assert.match(error.message, /memory/);
});

test("formats are written and zipped", async () => {
  const made = await mesh("naca:0012", {far_field: 5, layer_topology: "quads"});
  assert(made.quads.length > 0);
  for (const {name, extensions} of await formats()) {
    if (name === "triangle") continue; // holds no quadrilaterals
    const files = made.write(extensions[0].startsWith(".") ? `mesh${extensions[0]}` : extensions[0], {format: name});
    assert(files.length > 0 && files.every(({bytes}) => bytes.length > 0), name);
  }
  const folder = made.write("polyMesh");
  assert.deepEqual(
    folder.map(({name}) => name).sort(),
    ["boundary", "faces", "neighbour", "owner", "points"].map((name) => `polyMesh/${name}`),
  );
  assert.deepEqual([...zip(folder).subarray(0, 4)], [0x50, 0x4b, 3, 4]);
  made.delete();
});

test("curved cells are written as such, or refused", async () => {
  const [straight, curved] = [
    await mesh("naca:0012", {far_field: 5}),
    await mesh("naca:0012", {far_field: 5, order: 2}),
  ];
  assert.equal(straight.facts.curved, null);
  assert.equal(curved.facts.curved.order, 2);
  assert(curved.facts.curved.min_scaled_jacobian > 0);
  // Each edge has a node more, and there are three edges for two triangles.
  const [few, many] = [straight, curved].map((made) => made.write("mesh.vtu")[0].bytes.length);
  assert(many > 1.5 * few, `${few} ${many}`);
  assert.throws(() => curved.write("mesh.su2"), /curved/);
  for (const made of [straight, curved]) made.delete();
});

test("the flow that decided tells its pressures", async () => {
  const flowOf = async (inputs, options) => {
    const made = await mesh(inputs, {layer_topology: "quads", ...options});
    made.delete();
    return made.facts.flow;
  };
  assert.equal(await flowOf("naca:0012", {}), null);
  const slow = await flowOf("naca:2412", {reynolds: 3e6, alpha: 4}),
    [{name, points, cp}] = slow.elements,
    nose = cp.indexOf(Math.max(...cp));
  assert.deepEqual([name, slow.mach, slow.critical_cp, slow.compressible], ["airfoil", null, null, false]);
  assert(slow.lift > 0.6 && slow.lift < 0.8, `lift ${slow.lift}`);
  assert.equal(points.length, 2 * cp.length);
  assert(Math.abs(cp[nose] - 1) < 1e-6 && points[2 * nose] < 0.05);
  for (const end of [0, cp.length - 1]) assert(Math.abs(points[2 * end] - 1) < 1e-6);
  // The upper side comes first: with lift its pressures are lower.
  assert(Math.min(...cp.slice(0, nose)) < Math.min(...cp.slice(nose)));
  // Karman and Tsien raise suction by more than 1 / sqrt(1 - Mach^2).
  const faster = await flowOf("naca:2412", {reynolds: 3e6, alpha: 4, mach: 0.3}),
    ratio = Math.min(...faster.elements[0].cp) / Math.min(...cp);
  assert(ratio > 1 / Math.sqrt(0.91) && ratio < 1.3, `ratio ${ratio}`);
  assert(Math.abs(faster.critical_cp - -6.95) < 0.05, `cp* ${faster.critical_cp}`);
  const shock = await flowOf("naca:0012", {reynolds: 6.5e6, alpha: 1.25, mach: 0.8});
  assert(shock.compressible);
  assert(Math.abs(shock.critical_cp - -0.435) < 0.002, `cp* ${shock.critical_cp}`);
  assert(Math.min(...shock.elements[0].cp) < 2 * shock.critical_cp);
});

test("memory is given back", async () => {
  for (let i = 0; i < 40; ++i) (await mesh("naca:0012", {far_field: 5})).delete();
});

test("options have names, kinds and help", async () => {
  const rows = await optionRows();
  assert(rows.length > 40);
  for (const {key, kind, help} of rows) assert(/^[a-z0-9_]+$/.test(key) && kind && help, key);
  assert.deepEqual(rows.find(({key}) => key === "first_height").excludes, ["y_plus"]);
  assert.match(await version(), /^\d+\.\d+\.\d+/);
});
