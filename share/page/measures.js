// Measures of cells, with the definitions of src/core/cell_shape.hpp and src/mesh/quality.hpp.

// Cells are numbered as in C++: triangles, then quads.
export function cellCount(mesh) {
  return mesh.triangles.length / 3 + mesh.quads.length / 4;
}

export function cornersOf(mesh, cell) {
  const triangles = mesh.triangles.length / 3;
  return cell < triangles ? mesh.triangles.subarray(3 * cell, 3 * cell + 3)
                          : mesh.quads.subarray(4 * (cell - triangles), 4 * (cell - triangles) + 4);
}

const toDegrees = 180 / Math.PI;
const flat = {area: 0, minAngle: 0, maxAngle: 180, aspect: Infinity, ratio: 0};

function triangleShape(ax, ay, bx, by, cx, cy, out) {
  const ux = bx - ax, uy = by - ay, vx = cx - ax, vy = cy - ay, wx = cx - bx, wy = cy - by;
  const twice = ux * vy - uy * vx;
  if (!(twice > 0)) return Object.assign(out, flat);
  const ab = ux * ux + uy * uy, ca = vx * vx + vy * vy, bc = wx * wx + wy * wy;
  const longest = Math.max(ab, bc, ca), shortest = Math.min(ab, bc, ca);
  const middle = Math.max(Math.min(bc, ca), Math.min(Math.max(bc, ca), ab));
  // Half of each sum is the scalar product of the edges at the angle.
  const smallest = toDegrees * Math.atan2(twice, 0.5 * (longest + middle - shortest));
  const medium = toDegrees * Math.atan2(twice, 0.5 * (longest + shortest - middle));
  out.area = 0.5 * twice;
  out.minAngle = smallest;
  out.maxAngle = 180 - smallest - medium;
  out.aspect = longest / twice;
  out.ratio = 2 * Math.sqrt(3) * twice / (ab + bc + ca);
  return out;
}

function quadShape(p, v, out) {
  const x = (i) => p[2 * v[i % 4]], y = (i) => p[2 * v[i % 4] + 1];
  const twice = (x(2) - x(0)) * (y(3) - y(1)) - (y(2) - y(0)) * (x(3) - x(1));
  if (!(twice > 0)) return Object.assign(out, flat);
  Object.assign(out, {area: 0.5 * twice, minAngle: 360, maxAngle: 0, aspect: 0, ratio: 1});
  for (let i = 0; i < 4; ++i) {
    const ux = x(i + 1) - x(i), uy = y(i + 1) - y(i), vx = x(i + 3) - x(i), vy = y(i + 3) - y(i);
    const cross = ux * vy - uy * vx, squares = ux * ux + uy * uy + vx * vx + vy * vy;
    let angle = toDegrees * Math.atan2(cross, ux * vx + uy * vy);
    if (angle < 0) angle += 360;
    out.minAngle = Math.min(out.minAngle, angle);
    out.maxAngle = Math.max(out.maxAngle, angle);
    out.aspect = Math.max(out.aspect, (ux * ux + uy * uy) / out.area);
    out.ratio = Math.min(out.ratio, squares > 0 ? Math.max(0, 2 * cross / squares) : 0);
  }
  return out;
}

// Returns area, minAngle and maxAngle (degrees), aspect and ratio (the mean ratio) of a cell.
export function shapeOf(mesh, cell, out = {}) {
  const p = mesh.points, triangles = mesh.triangles.length / 3;
  if (cell >= triangles) return quadShape(p, cornersOf(mesh, cell), out);
  const t = mesh.triangles, a = 2 * t[3 * cell], b = 2 * t[3 * cell + 1], c = 2 * t[3 * cell + 2];
  return triangleShape(p[a], p[a + 1], p[b], p[b + 1], p[c], p[c + 1], out);
}

// Returns an array per measure with an entry per cell: minAngle, maxAngle, aspect, ratio, and size, the root of the
// area.
export function measureCells(mesh) {
  const count = cellCount(mesh), shape = {};
  const measures = {};
  for (const name of ["minAngle", "maxAngle", "aspect", "ratio", "size"]) measures[name] = new Float32Array(count);
  for (let cell = 0; cell < count; ++cell) {
    shapeOf(mesh, cell, shape);
    measures.minAngle[cell] = shape.minAngle;
    measures.maxAngle[cell] = shape.maxAngle;
    measures.aspect[cell] = shape.aspect;
    measures.ratio[cell] = shape.ratio;
    measures.size[cell] = Math.sqrt(shape.area);
  }
  return measures;
}

// Returns how many of the values of the selected cells lie in each of `bins` equal parts of [from, to]; the first and
// last take what lies beyond.
export function histogram(values, from, to, bins, selected = () => true) {
  const counts = new Array(bins).fill(0);
  for (let cell = 0; cell < values.length; ++cell) {
    if (!selected(cell)) continue;
    const bin = Math.floor((values[cell] - from) / (to - from) * bins);
    ++counts[Math.min(bins - 1, Math.max(0, bin))];
  }
  return counts;
}

// Returns the `count` selected cells with the smallest values, the smallest first; ties go to lower numbers.
export function lowest(values, count, selected = () => true) {
  const found = [];
  for (let cell = 0; cell < values.length; ++cell) {
    if (!selected(cell)) continue;
    if (found.length === count && !(values[cell] < values[found[count - 1]])) continue;
    let at = found.length;
    while (at > 0 && values[cell] < values[found[at - 1]]) --at;
    found.splice(at, 0, cell);
    found.length = Math.min(found.length, count);
  }
  return found;
}
