// The triangles of a view in an order in which neighbours are near to each other, so that parts of the plane are few
// ranges of them. Quadrilaterals count as two triangles.

const leafSize = 512;

// Returns
//   corners   per triangle: its vertices, and bits of its edges that are no edges of cells
//   cell      per triangle: the cell
//   leaves    ranges of triangles (first, count) with the box round them (x0, y0, x1, y1) and their area
export function orderTriangles(mesh) {
  const triangles = mesh.triangles.length / 3, quads = mesh.quads.length / 4, count = triangles + 2 * quads;
  const vertex = new Uint32Array(3 * count);
  vertex.set(mesh.triangles);
  for (let q = 0, at = 3 * triangles; q < quads; ++q) {
    const v = mesh.quads.subarray(4 * q, 4 * q + 4);
    vertex.set([v[0], v[1], v[2], v[0], v[2], v[3]], at);
    at += 6;
  }
  const order = sortedTree(mesh.points, vertex, count);

  const corners = new Uint32Array(4 * count), cell = new Uint32Array(count);
  for (let i = 0; i < count; ++i) {
    const t = order.triangles[i], half = t < triangles ? -1 : (t - triangles) % 2;
    cell[i] = half < 0 ? t : triangles + Math.floor((t - triangles) / 2);
    for (let k = 0; k < 3; ++k) corners[4 * i + k] = vertex[3 * t + k];
    // Bit k hides the edge that lies opposite corner k: the diagonal.
    corners[4 * i + 3] = half < 0 ? 0 : half === 0 ? 2 : 4;
  }
  for (const leaf of order.leaves) {
    leaf.box = boxOf(mesh.points, corners, leaf.first, leaf.count);
    leaf.area = areaOf(mesh.points, corners, leaf.first, leaf.count);
  }
  return {count, corners, cell, leaves: order.leaves};
}

function boxOf(points, corners, first, count) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (let i = first; i < first + count; ++i)
    for (let k = 0; k < 3; ++k) {
      const x = points[2 * corners[4 * i + k]], y = points[2 * corners[4 * i + k] + 1];
      if (x < box[0]) box[0] = x;
      if (y < box[1]) box[1] = y;
      if (x > box[2]) box[2] = x;
      if (y > box[3]) box[3] = y;
    }
  return box;
}

function areaOf(points, corners, first, count) {
  let area = 0;
  for (let i = first; i < first + count; ++i) {
    const [a, b, c] = [2 * corners[4 * i], 2 * corners[4 * i + 1], 2 * corners[4 * i + 2]];
    area += 0.5 * Math.abs((points[b] - points[a]) * (points[c + 1] - points[a + 1]) -
                           (points[b + 1] - points[a + 1]) * (points[c] - points[a]));
  }
  return area;
}

// Halves the triangles at the median of their centres, across the longer side of the box round these, until few are
// left.
function sortedTree(points, vertex, count) {
  const x = new Float32Array(count), y = new Float32Array(count);
  const triangles = new Uint32Array(count);
  for (let t = 0; t < count; ++t) {
    const a = 2 * vertex[3 * t], b = 2 * vertex[3 * t + 1], c = 2 * vertex[3 * t + 2];
    x[t] = (points[a] + points[b] + points[c]) / 3;
    y[t] = (points[a + 1] + points[b + 1] + points[c + 1]) / 3;
    triangles[t] = t;
  }
  const leaves = [], stack = count > 0 ? [[0, count]] : [];
  while (stack.length > 0) {
    const [first, end] = stack.pop();
    if (end - first <= leafSize) {
      leaves.push({first, count: end - first});
      continue;
    }
    let x0 = Infinity, x1 = -Infinity, y0 = Infinity, y1 = -Infinity;
    for (let i = first; i < end; ++i) {
      const t = triangles[i];
      if (x[t] < x0) x0 = x[t];
      if (x[t] > x1) x1 = x[t];
      if (y[t] < y0) y0 = y[t];
      if (y[t] > y1) y1 = y[t];
    }
    const middle = (first + end) >> 1;
    select(triangles, x1 - x0 > y1 - y0 ? x : y, first, end - 1, middle);
    stack.push([middle, end], [first, middle]);
  }
  return {triangles, leaves};
}

// Puts the smallest keys of items[left ... right] before items[middle]. Source: C. A. R. Hoare, CACM 4 (1961).
function select(items, key, left, right, middle) {
  while (left < right) {
    const pivot = key[items[(left + right) >> 1]];
    let i = left, j = right;
    while (i <= j) {
      while (key[items[i]] < pivot) ++i;
      while (pivot < key[items[j]]) --j;
      if (i > j) break;
      const item = items[i];
      items[i++] = items[j];
      items[j--] = item;
    }
    if (middle <= j) right = j;
    else if (middle >= i) left = i;
    else return;
  }
}
