// Reads the mesh that a page holds: a zlib stream in base64, made by src/page/packed_mesh.cpp.
//
// The stream is a sequence of arrays of whole numbers. Each is its length (4 bytes), the number of bytes of a number
// (1 byte), all lowest bytes, all second bytes, and so on; all is little-endian. "Signed" numbers are stored as
// 0, -1, 1, -2, ... -> 0, 1, 2, 3, ... The arrays, in their order:
//   header      version, points, triangles, quadrilaterals of the mesh
//   symbols, references          the cells, one found across an edge of another: src/page/traversal.hpp
//   exponents   per vertex in the order in which cells meet them, signed: that of its step, less that of vertex a
//   numbers     per vertex, signed: its number in the mesh, less that of vertex b
//   x, y        per vertex, signed: in steps, less what a + b - o predicts
//   cells       per cell in the order of the symbols, signed: its number in the mesh, less that of the cell before
//   regions, pieces, layers      likewise, less those of the cell before; empty where the mesh has none
//   marker names (UTF-8, each with a zero byte behind), kinds, numbers of edges, ends of edges (signed, less the last)
//   wall vertices (signed, less the last), number of them per body, first heights (bits of 32-bit floats)
//   growth      how many pairs of cells in successive layers have each ratio of heights: src/page/growth.hpp

const symbol = {none: 0, fresh: 1, before: 2, behind: 3, closing: 4, distant: 5, quad: 6};

async function inflated(base64) {
  const text = atob(base64.trim());
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function arrayReader(bytes) {
  let at = 0;
  const next = () => {
    const length = bytes[at] + 256 * (bytes[at + 1] + 256 * (bytes[at + 2] + 256 * bytes[at + 3]));
    const planes = bytes[at + 4];
    const numbers = planes > 4 ? new Float64Array(length) : new Uint32Array(length);
    at += 5;
    for (let plane = 0, unit = 1; plane < planes; ++plane, unit *= 256)
      for (let i = 0; i < length; ++i) numbers[i] += unit * bytes[at++];
    return numbers;
  };
  // Doubles hold these whole numbers exactly.
  const signed = () => {
    const numbers = next();
    const result = new Float64Array(numbers.length);
    for (let i = 0; i < result.length; ++i) {
      const n = numbers[i];
      result[i] = n % 2 === 0 ? n / 2 : -(n + 1) / 2;
    }
    return result;
  };
  return {next, signed};
}

// Follows the symbols. Calls addVertex(a, b, o) for each fresh vertex, and addCell(parent, t, s, c, d) for each cell,
// counter-clockwise, with d = -1 for triangles. The names are those of src/page/traversal.cpp.
function followSymbols(symbols, references, cells, addVertex, addCell) {
  let gateRoom = 1024;
  let s = new Int32Array(gateRoom), t = new Int32Array(gateRoom), o = new Int32Array(gateRoom);
  let cell = new Int32Array(gateRoom), previous = new Int32Array(gateRoom), next = new Int32Array(gateRoom);
  let open = new Uint8Array(gateRoom);
  let gates = 0, vertices = 0, made = 0, nextSymbol = 0, nextReference = 0;

  const grown = (array) => {
    const larger = new array.constructor(2 * array.length);
    larger.set(array);
    return larger;
  };
  const addGate = (from, to, opposite) => {
    if (gates === gateRoom) {
      [s, t, o, cell, previous, next, open] = [s, t, o, cell, previous, next, open].map(grown);
      gateRoom *= 2;
    }
    s[gates] = from;
    t[gates] = to;
    o[gates] = opposite;
    cell[gates] = made - 1;
    open[gates] = 1;
    return gates++;
  };
  const link = (gate, behind) => {
    next[gate] = behind;
    previous[behind] = gate;
  };
  let first = -1, second = -1;  // the gates that attach() made
  const attach = (gate, kind) => {
    const from = s[gate], to = t[gate], before = previous[gate], behind = next[gate];
    const closesBefore = kind === symbol.before || kind === symbol.closing;
    const closesBehind = kind === symbol.behind || kind === symbol.closing;
    open[gate] = 0;
    let c;
    if (closesBefore) c = s[before];
    else if (closesBehind) c = t[behind];
    else if (kind === symbol.fresh) {
      addVertex(from, to, o[gate]);
      c = vertices++;
    } else c = vertices - references[nextReference++];
    first = second = -1;
    let left = before, right = behind;
    if (closesBefore) {
      open[before] = 0;
      left = previous[before];
    } else first = addGate(from, c, to);
    if (closesBehind) {
      open[behind] = 0;
      right = next[behind];
    } else second = addGate(c, to, from);
    let last = left;
    if (first >= 0) {
      link(last, first);
      last = first;
    }
    if (second >= 0) {
      link(last, second);
      last = second;
    }
    link(last, right);
    return c;
  };
  const begin = () => {
    const corners = symbols[nextSymbol++] === symbol.quad ? 4 : 3, v = [-1, -1, -1, -1];
    for (let i = 0; i < corners; ++i) {
      const back = references[nextReference++];
      v[i] = back > 0 ? vertices - back : vertices;
      if (back > 0) continue;
      const near = i > 0 ? v[i - 1] : vertices - 1;
      addVertex(near, near, near);
      ++vertices;
    }
    addCell(-1, v[0], v[1], v[2], v[3]);
    ++made;
    const gate = gates;
    for (let i = 0; i < corners; ++i) {
      const added = addGate(v[i], v[(i + 1) % corners], v[(i + 2) % corners]);
      previous[added] = gate + (i + corners - 1) % corners;
      next[added] = gate + (i + 1) % corners;
    }
  };

  let head = 0;
  while (made < cells) {
    begin();
    for (; head < gates; ++head) {
      if (!open[head]) continue;
      const kind = symbols[nextSymbol++];
      if (kind === symbol.none) {
        open[head] = 0;
        continue;
      }
      const from = s[head], to = t[head], parent = cell[head];
      ++made;
      if (kind < symbol.quad) {
        addCell(parent, to, from, attach(head, kind), -1);
        continue;
      }
      const c = attach(head, kind - symbol.quad), firstHalf = first;
      const d = attach(second, symbols[nextSymbol++]);
      addCell(parent, to, from, c, d);
      if (firstHalf >= 0) o[firstHalf] = d;
      if (second >= 0) o[second] = from;
    }
  }
}

// Returns the mesh: points (x, y of each vertex), triangles and quads (vertices of each cell, counter-clockwise), and
// per cell, triangles before quads, region (0 layer, 1 elsewhere), piece and layer, or null. Markers have name, kind
// ("wall", "far field", "symmetry", "other", "periodic", "internal") and edges (pairs of vertices). `walls` has the
// vertices of each body and the first heights over them; `growth` is a histogram. The numbers of vertices and cells
// are those of the mesh that was packed.
export async function decodeMesh(base64) {
  const read = arrayReader(await inflated(base64));
  const [version, pointCount, triangleCount, quadCount] = read.next();
  if (version !== 1) throw new Error(`this page holds a mesh of another version: ${version}`);
  const cells = triangleCount + quadCount;
  const symbols = read.next(), references = read.next();
  const exponents = read.signed(), numbers = read.signed(), dx = read.signed(), dy = read.signed();
  const cellNumbers = read.signed();
  const cellData = [read.signed(), read.signed(), read.signed()];

  const points = new Float64Array(2 * pointCount);
  const number = new Uint32Array(numbers.length), exponent = new Int16Array(numbers.length);
  let vertices = 0;
  const addVertex = (a, b, o) => {
    const i = vertices++;
    let x = 0, y = 0;
    exponent[i] = exponents[i];
    number[i] = numbers[i];
    if (a >= 0) {
      exponent[i] += exponent[a];
      number[i] += number[b];
      x = points[2 * number[a]] + points[2 * number[b]] - points[2 * number[o]];
      y = points[2 * number[a] + 1] + points[2 * number[b] + 1] - points[2 * number[o] + 1];
    }
    const step = 2 ** exponent[i];
    points[2 * number[i]] = (Math.floor(x / step + 0.5) + dx[i]) * step;
    points[2 * number[i] + 1] = (Math.floor(y / step + 0.5) + dy[i]) * step;
  };

  const triangles = new Uint32Array(3 * triangleCount), quads = new Uint32Array(4 * quadCount);
  const data = cellData.map((differences, kind) =>
      differences.length > 0 ? new [Uint8Array, Uint32Array, Uint16Array][kind](cells) : null);
  const cellNumber = new Uint32Array(cells);
  let made = 0;
  const addCell = (parent, t, s, c, d) => {
    const i = made++, before = parent >= 0 ? cellNumber[parent] : 0;
    const cell = cellNumber[i] = cellNumbers[i] + before;
    if (d < 0) {
      triangles[3 * cell] = number[t];
      triangles[3 * cell + 1] = number[s];
      triangles[3 * cell + 2] = number[c];
    } else {
      quads.set([number[t], number[s], number[c], number[d]], 4 * (cell - triangleCount));
    }
    for (let kind = 0; kind < 3; ++kind)
      if (data[kind]) data[kind][cell] = cellData[kind][i] + (parent >= 0 ? data[kind][before] : 0);
  };
  followSymbols(symbols, references, cells, addVertex, addCell);

  const names = new TextDecoder().decode(Uint8Array.from(read.next())).split("\0");
  const kinds = read.next(), sizes = read.next(), ends = summed(read.signed(), 2, sizes);
  const markers = Array.from(sizes, (size, m) => ({
    name: names[m], kind: ["wall", "far field", "symmetry", "other", "periodic", "internal"][kinds[m]], edges: ends[m],
  }));
  const wallDifferences = read.signed(), bodySizes = read.next();
  const wallVertices = summed(wallDifferences, 1, [wallDifferences.length])[0];
  const heights = new Float32Array(Uint32Array.from(read.next()).buffer);
  const walls = [];
  for (let body = 0, at = 0; body < bodySizes.length; at += bodySizes[body++])
    walls.push({vertices: wallVertices.subarray(at, at + bodySizes[body]),
                firstHeights: heights.subarray(at, at + bodySizes[body])});
  return {points, triangles, quads, region: data[0], piece: data[1], layer: data[2], markers, walls,
          growth: read.next()};
}

// Returns runs of sums of differences; each run of `sizes` takes `each` numbers per entry and begins at 0.
function summed(differences, each, sizes) {
  const runs = [];
  let at = 0;
  for (const size of sizes) {
    const run = new Uint32Array(each * size);
    let last = 0;
    for (let i = 0; i < run.length; ++i) run[i] = last += differences[at++];
    runs.push(run);
  }
  return runs;
}
