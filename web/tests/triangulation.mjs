// Tries the triangulation alone in Node.js: node --test triangulation.mjs.
import assert from "node:assert/strict";
import {readFile} from "node:fs/promises";
import {test} from "node:test";
import {gzipSync} from "node:zlib";
import Delaunator, {load, Triangulation} from "../../build/browser/package/dist/triangulation.js";

const dist = new URL("../../build/browser/package/dist/", import.meta.url);

let state = 1;
const random = () => (state = (state * 48271) % 2147483647) / 2147483647;

/** Twice the area of a triangle or polygon, negative where it is clockwise. Differences are exact where points lie far off. */
function doubledArea(coords, corners) {
  const [x0, y0] = [coords[2 * corners[0]], coords[2 * corners[0] + 1]];
  let sum = 0;
  for (let i = 0, j = corners.length - 1; i < corners.length; j = i++) {
    const [xi, yi, xj, yj] = [corners[i], corners[j]].flatMap((c) => [coords[2 * c] - x0, coords[2 * c + 1] - y0]);
    sum += xj * yi - xi * yj;
  }
  return sum;
}

const next = (h) => (h % 3 === 2 ? h - 2 : h + 1);
const edgeOf = (made, h) => [made.triangles[h], made.triangles[next(h)]];

/** Half-edges are opposite to each other, and clockwise triangles cover the hull, whose edges have none opposite. */
function check(made) {
  let sum = 0;
  for (let t = 0; t < made.triangles.length; t += 3) {
    const area = doubledArea(made.coords, made.triangles.subarray(t, t + 3));
    assert(area <= 1e-15, `${area}`); // rounding
    sum += area;
  }
  assert.equal(made.trianglesLen, made.triangles.length);
  assert.equal(made.halfedges.length, made.triangles.length);
  assert.equal(made.constrainedEdges.length, made.triangles.length);
  const border = new Map();
  for (let h = 0; h < made.halfedges.length; h++) {
    const twin = made.halfedges[h];
    if (twin === -1) border.set(...edgeOf(made, h));
    else {
      assert.equal(made.halfedges[twin], h);
      assert.deepEqual(edgeOf(made, twin), edgeOf(made, h).reverse());
      assert.equal(made.constrainedEdges[twin], made.constrainedEdges[h]);
    }
  }
  assert.equal(border.size, made.hull.length);
  made.hull.forEach((point, i) => assert.equal(border.get(point), made.hull[(i + 1) % made.hull.length]));
  assert(Math.abs(sum - doubledArea(made.coords, made.hull)) <= 1e-12 * Math.abs(sum));
}

test("nothing is made before the module is loaded", async () => {
  assert.throws(() => new Triangulation([0, 0, 1, 0, 0, 1]), /load/);
  await load();
  assert.deepEqual([...new Triangulation([5, 5, 7, 5, 7, 6]).triangles], [0, 2, 1]);
  assert.equal(Delaunator, Triangulation);
});

test("points at random, on a grid, on a circle and far from the origin", () => {
  const grid = Array.from({length: 400}, (_, i) => [i % 20, Math.floor(i / 20)]);
  const circle = Array.from({length: 100}, (_, i) => [Math.cos(i / 16), Math.sin(i / 16)]);
  const cloud = Array.from({length: 2000}, () => [random(), random()]);
  for (const points of [grid, circle, cloud, cloud.map(([x, y]) => [x + 1e6, y - 1e6]), [...grid, ...grid]])
    check(Triangulation.from(points));
  assert.equal(Triangulation.from([...grid, ...grid]).trianglesLen, 3 * 2 * 19 * 19);
});

test("circles are empty", () => {
  const {coords, triangles} = Triangulation.from(Array.from({length: 200}, () => [random(), random()]));
  for (let t = 0; t < triangles.length; t += 3)
    for (let p = 0; p < coords.length; p += 2) {
      const [u, v, w] = [2, 1, 0].map((k) => {
        const [x, y] = [coords[2 * triangles[t + k]] - coords[p], coords[2 * triangles[t + k] + 1] - coords[p + 1]];
        return [x, y, x * x + y * y];
      });
      const inside =
        u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
      assert(inside < 1e-12);
    }
});

test("few points, and points on a line, have a hull alone", () => {
  const arrays = (points) => [[...Triangulation.from(points).triangles], [...Triangulation.from(points).hull]];
  assert.deepEqual(arrays([]), [[], []]);
  assert.deepEqual(arrays([[3, 4]]), [[], [0]]);
  assert.deepEqual(arrays([[0, 0], [1, 0], [3, 0], [2, 0]]), [[], [0, 1, 3, 2]]); // prettier-ignore
});

test("edges run along constraints", () => {
  const coords = [0, 0, 4, 0, 4, 1, 0, 1, 2, 0.1, 1, 0.9, 0, 0];
  const constrained = (made) =>
    Array.from(made.constrainedEdges.keys())
      .filter((h) => made.constrainedEdges[h] && !(made.halfedges[h] > h))
      .map((h) => edgeOf(made, h).sort().join())
      .sort();
  const without = new Triangulation(coords);
  assert.deepEqual(constrained(without), []);
  const made = new Triangulation(coords, [0, 2, 3, 0, 6, 1]); // point 6 equals point 0
  check(made);
  assert.deepEqual(constrained(made), ["0,1", "0,2", "0,3"]);
  assert.throws(() => new Triangulation(coords, [0, 2, 1, 3]), /cross/);
  assert.throws(() => new Triangulation(coords, [0, 99]), /99/);
});

test("points of other forms, and points that move", () => {
  const points = [{x: 0, y: 0}, {x: 1, y: 0}, {x: 0, y: 1}, {x: 0.2, y: 0.2}]; // prettier-ignore
  const made = Triangulation.from(points, ({x}) => x, ({y}) => y); // prettier-ignore
  assert.equal(made.hull.length, 3);
  made.coords.set([2, 2], 6);
  made.update();
  check(made);
  assert.equal(made.hull.length, 4);
  assert.throws(() => new Triangulation([[0, 0]]), /numbers/);
  assert.throws(() => new Triangulation([0, 0, 1]), /pairs/);
  assert.throws(() => new Triangulation([0, 0, 1, 0, NaN, 1]), /./);
});

test("it stays small", async () => {
  const files = await Promise.all(
    ["triangulation.js", "triangulation.wasm"].map((name) => readFile(new URL(name, dist))),
  );
  const bytes = files.reduce((sum, file) => sum + gzipSync(file, {level: 9}).length, 0);
  assert(bytes <= 200_000, `${bytes} bytes`);
});
