// A view of a mesh in a canvas: WebGL 2 draws the cells, and a second canvas over it walls and what is selected.
//
// Single precision would let the picture jitter from some 1e-5 of the coordinates on. So a coordinate is kept as two
// floats whose sum has 48 bits, and so is the middle of the view; the shader subtracts high from high and low from low
// parts, which is exact where the view is small.
import {orderTriangles} from "./order.js";

const textureWidth = 2048, textureShift = 11;
const smallestLeaf = 1.5;   // CSS pixels; what is smaller is drawn as one point
const slowFrame = 30;       // milliseconds; where frames take longer, the last picture moves while the mouse does
const nearWall = 10;        // CSS pixels from a wall vertex that count as a hit

const cellShader = `#version 300 es
precision highp float;
precision highp int;
precision highp usampler2D;
precision highp sampler2D;
uniform usampler2D corners;
uniform sampler2D points;
uniform sampler2D fills;
uniform vec4 middle;   // of the view: high parts, low parts
uniform vec2 scale;    // to the view's coordinates from -1 to 1
uniform float pixels;  // per unit of length
flat out vec3 fill;
flat out float height;  // the smallest of the triangle, in pixels
flat out vec3 edges[3]; // (n, c): a pixel at p from the middle is at |n.p + c| from an edge
ivec2 texel(int i) { return ivec2(i & ${textureWidth - 1}, i >> ${textureShift}); }
vec2 between(vec4 a, vec4 b) { return (b.xy - a.xy) + (b.zw - a.zw); }
void main() {
  int triangle = gl_VertexID / 3, corner = gl_VertexID - 3 * triangle;
  uvec4 c = texelFetch(corners, texel(triangle), 0);
  vec4 p[3];
  vec2 at[3];
  for (int k = 0; k < 3; ++k) {
    p[k] = texelFetch(points, texel(int(c[k])), 0);
    at[k] = between(middle, p[k]) * pixels;
  }
  float longest = 1e-20;
  vec2 along[3];
  for (int k = 0; k < 3; ++k) {
    int from = (k + 1) % 3, to = (k + 2) % 3;
    along[k] = between(p[from], p[to]) * pixels;
    float size = length(along[k]);
    longest = max(longest, size);
    edges[k] = vec3(0.0, 0.0, 1e6);
    if (size == 0.0 || (c.w >> k & 1u) == 1u) continue;
    vec2 normal = vec2(-along[k].y, along[k].x) / size;
    vec2 near = dot(at[from], at[from]) < dot(at[to], at[to]) ? at[from] : at[to];
    edges[k] = vec3(normal, -dot(normal, near));
  }
  height = abs(along[0].x * along[1].y - along[0].y * along[1].x) / longest;
  fill = texelFetch(fills, texel(triangle), 0).rgb;
  gl_Position = vec4(between(middle, p[corner]) * scale, 0.0, 1.0);
}`;

const cellPainter = `#version 300 es
precision highp float;
flat in vec3 fill;
flat in float height;
flat in vec3 edges[3];
uniform vec4 edge;    // colour and strength of edges
uniform vec2 extent;  // of the picture, in pixels
uniform float width;  // of edges, in pixels
uniform float tone;   // how much of the edges' colour small triangles get
out vec4 color;
void main() {
  vec3 here = vec3(gl_FragCoord.xy - 0.5 * extent, 1.0);
  float nearest = min(abs(dot(edges[0], here)), min(abs(dot(edges[1], here)), abs(dot(edges[2], here))));
  float line = 1.0 - smoothstep(0.5 * width - 0.5, 0.5 * width + 0.5, nearest);
  float shown = smoothstep(1.5 * width, 7.0 * width, height);
  color = vec4(mix(fill, edge.rgb, edge.a * max(line * shown, tone * (1.0 - shown))), 1.0);
}`;

const pointShader = `#version 300 es
precision highp float;
in vec2 place;
in vec3 paint;
uniform float size;
out vec3 fill;
void main() {
  fill = paint;
  gl_PointSize = size;
  gl_Position = vec4(place, 0.0, 1.0);
}`;

const pointPainter = `#version 300 es
precision highp float;
in vec3 fill;
out vec4 color;
void main() { color = vec4(fill, 1.0); }`;

function makeProgram(gl, vertexSource, fragmentSource) {
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertexSource], [gl.FRAGMENT_SHADER, fragmentSource]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error(gl.getProgramInfoLog(program) || "a shader does not compile");
  const uniforms = {};
  for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
    const {name} = gl.getActiveUniform(program, i);
    uniforms[name] = gl.getUniformLocation(program, name);
  }
  return {program, uniforms};
}

// Makes a texture of one texel per entry, and binds it to a unit; `values` has four numbers per entry.
function makeTexture(gl, unit, internalFormat, format, type, values) {
  const rows = Math.max(1, Math.ceil(values.length / 4 / textureWidth));
  const texels = new values.constructor(4 * textureWidth * rows);
  texels.set(values);
  gl.activeTexture(gl.TEXTURE0 + unit);
  gl.deleteTexture(gl.getParameter(gl.TEXTURE_BINDING_2D));
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texImage2D(gl.TEXTURE_2D, 0, internalFormat, textureWidth, rows, 0, format, type, texels);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
}

// Returns the high and low parts of both coordinates of all points: four floats per point.
function splitPoints(points) {
  const parts = new Float32Array(2 * points.length);
  for (let i = 0; i < points.length; i += 2) {
    parts[2 * i] = points[i];
    parts[2 * i + 1] = points[i + 1];
    parts[2 * i + 2] = points[i] - parts[2 * i];
    parts[2 * i + 3] = points[i + 1] - parts[2 * i + 1];
  }
  return parts;
}

// Returns the way from one view to another as a function of the share of the way, from 0 to 1, and its length. Views
// are {x, y, width}. Source: J. van Wijk, W. Nuij, Smooth and efficient zooming and panning (2003).
function smoothWay(from, to) {
  const rho = 1.4, distance = Math.hypot(to.x - from.x, to.y - from.y), zoom = Math.log(to.width / from.width);
  if (distance < 1e-6 * Math.min(from.width, to.width)) {
    return {length: Math.abs(zoom) / rho, at: (share) => ({
      x: from.x + share * (to.x - from.x), y: from.y + share * (to.y - from.y),
      width: from.width * Math.exp(share * zoom)})};
  }
  const bend = (width, sign) => -Math.asinh((to.width ** 2 - from.width ** 2 + sign * rho ** 4 * distance ** 2) /
                                            (2 * width * rho ** 2 * distance));
  const begin = bend(from.width, 1), length = (bend(to.width, -1) - begin) / rho;
  return {length, at: (share) => {
    const r = rho * share * length + begin;
    const along = from.width / rho ** 2 * (Math.cosh(begin) * Math.tanh(r) - Math.sinh(begin)) / distance;
    return {x: from.x + along * (to.x - from.x), y: from.y + along * (to.y - from.y),
            width: from.width * Math.cosh(begin) / Math.cosh(r)};
  }};
}

function insideTriangle(points, corners, i, x, y) {
  for (let k = 0; k < 3; ++k) {
    const a = 2 * corners[4 * i + k], b = 2 * corners[4 * i + (k + 1) % 3];
    if ((points[b] - points[a]) * (y - points[a + 1]) - (points[b + 1] - points[a + 1]) * (x - points[a]) < 0)
      return false;
  }
  return true;
}

// Returns the part of a segment inside a box, or null. Source: Y.-D. Liang, B. Barsky, ACM Trans. Graph. 3 (1984).
function clippedSegment(ax, ay, bx, by, box) {
  let from = 0, to = 1;
  for (const [step, room] of [[ax - bx, ax - box[0]], [bx - ax, box[2] - ax],
                              [ay - by, ay - box[1]], [by - ay, box[3] - ay]]) {
    if (step === 0 && room < 0) return null;
    if (step > 0) to = Math.min(to, room / step);
    if (step < 0) from = Math.max(from, room / step);
  }
  return from > to ? null : [ax + from * (bx - ax), ay + from * (by - ay), ax + to * (bx - ax), ay + to * (by - ay)];
}

// Shows a mesh in a canvas, which must have a positioned parent, and lets people pan, zoom and pick. A mesh has points,
// triangles, quads, markers and walls as decodeMesh() returns them. `options` may have onMove(view), called after each
// change of the view, and onPick({cell, vertex}), called with the cell and the wall vertex that were hit, or -1. Throws
// an Error where the browser has no WebGL 2.
//
// Returns an object with
//   setColors(fills)       three bytes per cell: red, green, blue
//   setTheme(theme)        {background, edge, wall, farField, selection}: CSS colours; strength: of edges, 0 to 1;
//                          tone: the share of the edges' colour that triangles smaller than a pixel get
//   show(box, {animate})   shows a part of the plane, [x0, y0, x1, y1]
//   view()                 {x, y, scale, width, height}: the middle, CSS pixels per unit, CSS pixels
//   select({cell, vertex}) marks a cell and a vertex, or nothing where they are -1
//   cellAt(x, y)           the cell at a point, or -1
//   cellsInView(visit)     calls visit(cell) for the cells whose boxes reach into the view
//   snapshot()             a canvas with the picture
//   frameTime()            milliseconds that the last picture took
//   destroy()
export function createView(canvas, mesh, options = {}) {
  const gl = canvas.getContext("webgl2", {antialias: false, alpha: false, depth: false});
  if (!gl) throw new Error("this browser shows no WebGL 2");
  const parts = orderTriangles(mesh), {points} = mesh;
  const overlay = document.createElement("canvas");
  overlay.setAttribute("aria-hidden", "true");
  overlay.style.cssText = "position:absolute;inset:0;width:100%;height:100%;pointer-events:none";
  canvas.after(overlay);
  const paper = overlay.getContext("2d");
  const still = matchMedia("(prefers-reduced-motion: reduce)");

  let theme = {background: "#fff", edge: "#222", wall: "#b01e28", farField: "#222", selection: "#e8590c", strength: 0.6,
               tone: 0.5};
  let fills = new Uint8Array(3 * (mesh.triangles.length / 3 + mesh.quads.length / 4)).fill(255);
  let leafFills = new Float32Array(3 * parts.leaves.length);
  let x = 0, y = 0, scale = 1, width = 1, height = 1, ratio = 1;
  let selected = {cell: -1, vertex: -1};
  let frameTime = 0, moving = 0, settling = 0, drawn = null, animation = 0, requested = 0;
  let cells, spots, spotBuffer;

  const setUp = () => {
    cells = makeProgram(gl, cellShader, cellPainter);
    spots = makeProgram(gl, pointShader, pointPainter);
    spotBuffer = gl.createBuffer();
    makeTexture(gl, 0, gl.RGBA32UI, gl.RGBA_INTEGER, gl.UNSIGNED_INT, parts.corners);
    makeTexture(gl, 1, gl.RGBA32F, gl.RGBA, gl.FLOAT, splitPoints(points));
    gl.useProgram(cells.program);
    gl.uniform1i(cells.uniforms.corners, 0);
    gl.uniform1i(cells.uniforms.points, 1);
    gl.uniform1i(cells.uniforms.fills, 2);
    putColors();
  };

  const putColors = () => {
    const texels = new Uint8Array(4 * parts.count);
    for (let i = 0; i < parts.count; ++i)
      for (let k = 0; k < 3; ++k) texels[4 * i + k] = fills[3 * parts.cell[i] + k];
    makeTexture(gl, 2, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, texels);
    parts.leaves.forEach(({first, count}, leaf) => {
      const samples = Math.min(16, count);
      for (let k = 0; k < 3; ++k) {
        let sum = 0;
        for (let i = 0; i < samples; ++i) sum += fills[3 * parts.cell[first + Math.floor(i * count / samples)] + k];
        leafFills[3 * leaf + k] = sum / samples / 255;
      }
    });
  };

  // --- Drawing

  const colorParts = (css) => {
    paper.fillStyle = css;
    const hex = paper.fillStyle;
    return [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);
  };

  const visibleParts = () => {
    const halfWidth = 0.5 * width / scale, halfHeight = 0.5 * height / scale;
    const ranges = [], places = [], edge = colorParts(theme.edge), tone = theme.strength * theme.tone;
    parts.leaves.forEach(({first, count, box}, leaf) => {
      if (box[0] > x + halfWidth || box[2] < x - halfWidth || box[1] > y + halfHeight || box[3] < y - halfHeight)
        return;
      if ((box[2] - box[0]) * scale < smallestLeaf && (box[3] - box[1]) * scale < smallestLeaf) {
        places.push((0.5 * (box[0] + box[2]) - x) / halfWidth, (0.5 * (box[1] + box[3]) - y) / halfHeight);
        for (let k = 0; k < 3; ++k) places.push((1 - tone) * leafFills[3 * leaf + k] + tone * edge[k]);
        return;
      }
      const last = ranges[ranges.length - 1];
      if (last && last[1] === first) last[1] += count;
      else ranges.push([first, first + count]);
    });
    return {ranges, places: new Float32Array(places)};
  };

  const drawSpots = (places) => {
    gl.useProgram(spots.program);
    gl.uniform1f(spots.uniforms.size, Math.ceil(smallestLeaf * ratio));
    gl.bindBuffer(gl.ARRAY_BUFFER, spotBuffer);
    gl.bufferData(gl.ARRAY_BUFFER, places, gl.DYNAMIC_DRAW);
    [["place", 2, 0], ["paint", 3, 8]].forEach(([name, size, offset]) => {
      const at = gl.getAttribLocation(spots.program, name);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, size, gl.FLOAT, false, 20, offset);
    });
    gl.drawArrays(gl.POINTS, 0, places.length / 5);
    for (const name of ["place", "paint"]) gl.disableVertexAttribArray(gl.getAttribLocation(spots.program, name));
  };

  const drawCells = () => {
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(...colorParts(theme.background), 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    const {ranges, places} = visibleParts();
    if (places.length > 0) drawSpots(places);
    const {uniforms} = cells, highX = Math.fround(x), highY = Math.fround(y);
    gl.useProgram(cells.program);
    gl.uniform4f(uniforms.middle, highX, highY, x - highX, y - highY);
    gl.uniform2f(uniforms.scale, 2 * scale / width, 2 * scale / height);
    gl.uniform1f(uniforms.pixels, scale * ratio);
    gl.uniform2f(uniforms.extent, canvas.width, canvas.height);
    gl.uniform4f(uniforms.edge, ...colorParts(theme.edge), theme.strength);
    gl.uniform1f(uniforms.width, ratio);
    gl.uniform1f(uniforms.tone, theme.tone);
    for (const [first, end] of ranges) gl.drawArrays(gl.TRIANGLES, 3 * first, 3 * (end - first));
  };

  const toPixelX = (px) => (px - x) * scale + 0.5 * width;
  const toPixelY = (py) => 0.5 * height - (py - y) * scale;

  const drawMarkers = () => {
    const margin = 8 / scale;
    const box = [x - 0.5 * width / scale - margin, y - 0.5 * height / scale - margin,
                 x + 0.5 * width / scale + margin, y + 0.5 * height / scale + margin];
    for (const marker of mesh.markers) {
      const wall = marker.kind === "wall" || marker.kind === "other";
      paper.strokeStyle = wall ? theme.wall : theme.farField;
      paper.lineWidth = wall ? 2 : 1;
      paper.beginPath();
      let lastX = NaN, lastY = NaN;
      for (let i = 0; i < marker.edges.length; i += 2) {
        const a = 2 * marker.edges[i], b = 2 * marker.edges[i + 1];
        const ax = points[a], ay = points[a + 1], bx = points[b], by = points[b + 1];
        if (Math.min(ax, bx) > box[2] || Math.max(ax, bx) < box[0] || Math.min(ay, by) > box[3] ||
            Math.max(ay, by) < box[1])
          continue;
        const kept = clippedSegment(ax, ay, bx, by, box);
        if (!kept) continue;
        if (kept[0] !== lastX || kept[1] !== lastY) paper.moveTo(toPixelX(kept[0]), toPixelY(kept[1]));
        paper.lineTo(toPixelX(kept[2]), toPixelY(kept[3]));
        [lastX, lastY] = [kept[2], kept[3]];
      }
      paper.stroke();
    }
  };

  const cornersOfCell = (cell) => {
    const triangles = mesh.triangles.length / 3;
    return cell < triangles ? mesh.triangles.subarray(3 * cell, 3 * cell + 3)
                            : mesh.quads.subarray(4 * (cell - triangles), 4 * (cell - triangles) + 4);
  };

  const drawSelection = () => {
    paper.strokeStyle = theme.selection;
    paper.fillStyle = theme.selection;
    paper.lineWidth = 2.5;
    if (selected.cell >= 0) {
      const margin = 50 / scale;
      const box = [x - 0.5 * width / scale - margin, y - 0.5 * height / scale - margin,
                   x + 0.5 * width / scale + margin, y + 0.5 * height / scale + margin];
      const v = cornersOfCell(selected.cell);
      paper.beginPath();
      let longest = 0, middleX = 0, middleY = 0;
      for (let i = 0; i < v.length; ++i) {
        const a = 2 * v[i], b = 2 * v[(i + 1) % v.length];
        const kept = clippedSegment(points[a], points[a + 1], points[b], points[b + 1], box);
        longest = Math.max(longest, Math.hypot(points[b] - points[a], points[b + 1] - points[a + 1]) * scale);
        middleX += points[a] / v.length;
        middleY += points[a + 1] / v.length;
        if (!kept) continue;
        paper.moveTo(toPixelX(kept[0]), toPixelY(kept[1]));
        paper.lineTo(toPixelX(kept[2]), toPixelY(kept[3]));
      }
      paper.stroke();
      if (longest < 12) {
        paper.beginPath();
        paper.arc(toPixelX(middleX), toPixelY(middleY), 11, 0, 2 * Math.PI);
        paper.stroke();
      }
    }
    if (selected.vertex >= 0) {
      paper.beginPath();
      paper.arc(toPixelX(points[2 * selected.vertex]), toPixelY(points[2 * selected.vertex + 1]), 5, 0, 2 * Math.PI);
      paper.fill();
    }
  };

  const draw = () => {
    const begin = performance.now();
    drawCells();
    // Reading a pixel waits until the picture is there; while the view moves nothing should wait.
    if (!moving) {
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
      frameTime = performance.now() - begin;
    }
    paper.setTransform(ratio, 0, 0, ratio, 0, 0);
    paper.clearRect(0, 0, width, height);
    paper.lineCap = paper.lineJoin = "round";
    drawMarkers();
    drawSelection();
    canvas.style.transform = overlay.style.transform = "";
    drawn = {x, y, scale};
  };

  // Returns whether the last picture is too coarse or too small for the view of now.
  const outgrown = () => {
    const factor = scale / drawn.scale, far = Math.max(Math.abs(drawn.x - x) / width, Math.abs(drawn.y - y) / height);
    return factor > 3 || factor < 0.4 || far * scale > 0.5;
  };

  // Moves the last picture to where it belongs in the view of now.
  const moveDrawn = () => {
    const factor = scale / drawn.scale;
    const transform = `translate(${(drawn.x - x) * scale}px, ${(y - drawn.y) * scale}px) scale(${factor})`;
    canvas.style.transform = overlay.style.transform = transform;
  };

  const update = () => {
    requested = 0;
    if (gl.isContextLost()) return;
    if (moving && frameTime > slowFrame && drawn && !outgrown()) moveDrawn();
    else draw();
    if (options.onMove) options.onMove(view());
  };
  const request = () => {
    if (!requested) requested = requestAnimationFrame(update);
  };
  const endOfMove = () => {
    moving = 0;
    request();
  };
  const moved = () => {
    moving = 1;
    clearTimeout(settling);
    settling = setTimeout(endOfMove, 140);
    request();
  };

  // --- Moving

  const view = () => ({x, y, scale, width, height});
  const extent = points.reduce((largest, value) => Math.max(largest, Math.abs(value)), 1e-300);
  const setScale = (wanted) => {
    // Below 2^-46 of the largest coordinate even the two floats have no more digits.
    scale = Math.min(2 ** 46 / extent, Math.max(10 / extent, wanted));
  };
  const zoomAt = (factor, px, py) => {
    cancelAnimationFrame(animation);
    const fixedX = x + (px - 0.5 * width) / scale, fixedY = y - (py - 0.5 * height) / scale;
    setScale(scale * factor);
    x = fixedX - (px - 0.5 * width) / scale;
    y = fixedY + (py - 0.5 * height) / scale;
    moved();
  };
  const panBy = (px, py) => {
    cancelAnimationFrame(animation);
    x -= px / scale;
    y += py / scale;
    moved();
  };
  const show = (box, {animate = false} = {}) => {
    cancelAnimationFrame(animation);
    const wanted = Math.min(width / (box[2] - box[0]), height / (box[3] - box[1]));
    const target = {x: 0.5 * (box[0] + box[2]), y: 0.5 * (box[1] + box[3]), width: width / wanted};
    const arrive = () => {
      [x, y] = [target.x, target.y];
      setScale(wanted);
      endOfMove();
    };
    if (!animate || still.matches || frameTime > slowFrame) return arrive();
    const way = smoothWay({x, y, width: width / scale}, target), begin = performance.now();
    const duration = Math.min(1600, Math.max(250, 160 * way.length));
    const step = (now) => {
      const share = Math.min(1, Math.max(0, (now - begin) / duration));
      if (share === 1) return arrive();
      const at = way.at(share * share * (3 - 2 * share));
      [x, y] = [at.x, at.y];
      setScale(width / at.width);
      moving = 1;
      request();
      animation = requestAnimationFrame(step);
    };
    animation = requestAnimationFrame(step);
  };

  // --- Picking

  const cellAt = (atX, atY) => {
    for (const {first, count, box} of parts.leaves) {
      if (atX < box[0] || atX > box[2] || atY < box[1] || atY > box[3]) continue;
      for (let i = first; i < first + count; ++i)
        if (insideTriangle(points, parts.corners, i, atX, atY)) return parts.cell[i];
    }
    return -1;
  };
  const wallVertexAt = (px, py) => {
    let nearest = nearWall, found = -1;
    for (const {vertices} of mesh.walls)
      for (const v of vertices) {
        const distance = Math.hypot(toPixelX(points[2 * v]) - px, toPixelY(points[2 * v + 1]) - py);
        if (distance < nearest) [nearest, found] = [distance, v];
      }
    return found;
  };
  const pick = (px, py) => {
    const cell = cellAt(x + (px - 0.5 * width) / scale, y - (py - 0.5 * height) / scale);
    select({cell, vertex: wallVertexAt(px, py)});
    if (options.onPick) options.onPick(selected);
  };
  const select = (what) => {
    selected = {cell: -1, vertex: -1, ...what};
    request();
  };
  const cellsInView = (visit) => {
    const halfWidth = 0.5 * width / scale, halfHeight = 0.5 * height / scale;
    for (const {first, count, box} of parts.leaves) {
      if (box[0] > x + halfWidth || box[2] < x - halfWidth || box[1] > y + halfHeight || box[3] < y - halfHeight)
        continue;
      for (let i = first; i < first + count; ++i) {
        const [ax, ay, bx, by, cx, cy] = [0, 1, 2].flatMap((k) => {
          const v = 2 * parts.corners[4 * i + k];
          return [points[v] - x, points[v + 1] - y];
        });
        if (Math.min(ax, bx, cx) > halfWidth || Math.max(ax, bx, cx) < -halfWidth ||
            Math.min(ay, by, cy) > halfHeight || Math.max(ay, by, cy) < -halfHeight)
          continue;
        visit(parts.cell[i]);
      }
    }
  };

  // --- Events

  const pointers = new Map();
  let travelled = 0;
  const place = (event) => {
    const bounds = (canvas.parentElement || canvas).getBoundingClientRect();
    return [event.clientX - bounds.left, event.clientY - bounds.top];
  };
  const events = {
    pointerdown(event) {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, place(event));
      if (pointers.size === 1) travelled = 0;
    },
    pointermove(event) {
      const before = pointers.get(event.pointerId);
      if (!before) return;
      const now = place(event), other = [...pointers].find(([id]) => id !== event.pointerId);
      pointers.set(event.pointerId, now);
      travelled += Math.hypot(now[0] - before[0], now[1] - before[1]);
      if (other) {
        const [ox, oy] = other[1];
        const factor = Math.hypot(now[0] - ox, now[1] - oy) / Math.max(1, Math.hypot(before[0] - ox, before[1] - oy));
        panBy(0.5 * (now[0] - before[0]), 0.5 * (now[1] - before[1]));
        zoomAt(factor, 0.5 * (now[0] + ox), 0.5 * (now[1] + oy));
      } else if (travelled > 3) panBy(now[0] - before[0], now[1] - before[1]);
    },
    pointerup(event) {
      pointers.delete(event.pointerId);
      if (pointers.size === 0 && travelled <= 3) pick(...place(event));
    },
    pointercancel(event) {
      pointers.delete(event.pointerId);
    },
    wheel(event) {
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 16 : 1;
      zoomAt(Math.exp(-0.0018 * Math.max(-400, Math.min(400, event.deltaY * lines))), ...place(event));
    },
    dblclick(event) {
      zoomAt(event.shiftKey ? 1 / 3 : 3, ...place(event));
    },
    keydown(event) {
      const step = 60, keys = {
        ArrowLeft: () => panBy(step, 0), ArrowRight: () => panBy(-step, 0), ArrowUp: () => panBy(0, step),
        ArrowDown: () => panBy(0, -step), "+": () => zoomAt(1.5, 0.5 * width, 0.5 * height),
        "=": () => zoomAt(1.5, 0.5 * width, 0.5 * height), "-": () => zoomAt(1 / 1.5, 0.5 * width, 0.5 * height),
        Enter: () => pick(0.5 * width, 0.5 * height),
      };
      if (event.ctrlKey || event.metaKey || event.altKey || !keys[event.key]) return;
      event.preventDefault();
      keys[event.key]();
    },
    webglcontextlost(event) {
      event.preventDefault();
    },
    webglcontextrestored() {
      setUp();
      request();
    },
  };
  for (const [name, listener] of Object.entries(events)) canvas.addEventListener(name, listener, {passive: false});
  canvas.style.touchAction = "none";

  const resize = () => {
    const bounds = (canvas.parentElement || canvas).getBoundingClientRect();
    [width, height] = [Math.max(1, bounds.width), Math.max(1, bounds.height)];
    ratio = Math.min(2, window.devicePixelRatio || 1);
    for (const surface of [canvas, overlay])
      [surface.width, surface.height] = [Math.round(width * ratio), Math.round(height * ratio)];
    drawn = null;
    request();
  };
  const observer = new ResizeObserver(resize);
  observer.observe(canvas.parentElement || canvas);
  resize();
  setUp();

  return {
    setColors(newFills) {
      fills = newFills;
      putColors();
      request();
    },
    setTheme(newTheme) {
      theme = {...theme, ...newTheme};
      request();
    },
    show, view, select, cellAt, cellsInView,
    snapshot() {
      draw();
      const picture = document.createElement("canvas");
      [picture.width, picture.height] = [canvas.width, canvas.height];
      for (const layer of [canvas, overlay]) picture.getContext("2d").drawImage(layer, 0, 0);
      return picture;
    },
    frameTime: () => frameTime,
    destroy() {
      observer.disconnect();
      cancelAnimationFrame(animation);
      cancelAnimationFrame(requested);
      clearTimeout(settling);
      for (const [name, listener] of Object.entries(events)) canvas.removeEventListener(name, listener);
      overlay.remove();
      gl.getExtension("WEBGL_lose_context")?.loseContext();
    },
  };
}
