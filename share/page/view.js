// A view of a mesh in a canvas: WebGL 2 draws the cells, and a second canvas over it walls and what is selected.
import {orderTriangles} from "./order.js";
import {createPainter} from "./painter.js";

const nearWall = 10;  // CSS pixels from a wall vertex that count as a hit
// Milliseconds that draw() takes at most. For so long pictures stay whole where browsers without a window, which take
// one as soon as the page is there, change its size before. Without a graphics card a million triangles take a second;
// where ten programs share a core, 40,000 do, and their picture must be whole there, too.
const longestDraw = 20000;

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
//   draw()                 shows the whole picture at once, unless that takes seconds
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
  // The processor draws a few lines in some milliseconds; what stands in for a graphics card took 0.2 s.
  const paper = overlay.getContext("2d", {willReadFrequently: true});
  const still = matchMedia("(prefers-reduced-motion: reduce)");

  let theme = {background: "#fff", edge: "#222", wall: "#b01e28", farField: "#222", selection: "#e8590c", strength: 0.6,
               tone: 0.5};
  let x = 0, y = 0, scale = 1, width = 1, height = 1, ratio = 1;
  let selected = {cell: -1, vertex: -1};
  let moving = 0, settling = 0, animation = 0, requested = 0, stale = true;
  const painter = createPainter(gl, points, parts);

  // --- Drawing

  const colorParts = (css) => {
    paper.fillStyle = css;
    const hex = paper.fillStyle;
    return [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);
  };

  const putTheme = () => painter.setTheme({...theme, background: colorParts(theme.background),
                                           edge: colorParts(theme.edge)});

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
      let lastX = NaN, lastY = NaN, penX = NaN, penY = NaN;
      const drawTo = (px, py) => {
        paper.lineTo(toPixelX(px), toPixelY(py));
        [penX, penY] = [px, py];
      };
      for (let i = 0; i < marker.edges.length; i += 2) {
        const a = 2 * marker.edges[i], b = 2 * marker.edges[i + 1];
        const ax = points[a], ay = points[a + 1], bx = points[b], by = points[b + 1];
        if (Math.min(ax, bx) > box[2] || Math.max(ax, bx) < box[0] || Math.min(ay, by) > box[3] ||
            Math.max(ay, by) < box[1])
          continue;
        const kept = clippedSegment(ax, ay, bx, by, box);
        if (!kept) continue;
        if (kept[0] !== lastX || kept[1] !== lastY) {
          if (!Number.isNaN(lastX) && (penX !== lastX || penY !== lastY)) drawTo(lastX, lastY);
          paper.moveTo(toPixelX(kept[0]), toPixelY(kept[1]));
          [penX, penY] = kept;
        }
        [lastX, lastY] = [kept[2], kept[3]];
        // While the view moves, steps of less than a pixel are joined.
        if (!moving || Math.max(Math.abs(lastX - penX), Math.abs(lastY - penY)) * scale > 1) drawTo(lastX, lastY);
      }
      if (!Number.isNaN(lastX) && (penX !== lastX || penY !== lastY)) drawTo(lastX, lastY);
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

  const drawOverlay = () => {
    paper.setTransform(ratio, 0, 0, ratio, 0, 0);
    paper.clearRect(0, 0, width, height);
    paper.lineCap = paper.lineJoin = "round";
    drawMarkers();
    drawSelection();
  };

  const update = () => {
    requested = 0;
    if (gl.isContextLost()) return;
    if (moving) {
      painter.drawMoving(view());
      if (settling) settle();
    } else if (!painter.drawRest(view())) {
      requested = requestAnimationFrame(update);
    }
    if (!stale) return;
    stale = false;
    drawOverlay();
    if (options.onMove) options.onMove(view());
  };
  const request = () => {
    stale = true;
    if (!requested) requested = requestAnimationFrame(update);
  };
  const endOfMove = () => {
    moving = settling = 0;
    request();
  };
  // The view rests once nothing has moved it for a while, and for longer than frames take: a whole picture would hold
  // up the next one.
  const settle = () => {
    clearTimeout(settling);
    settling = setTimeout(endOfMove, Math.max(140, 2 * painter.pace()));
  };
  const moved = () => {
    moving = 1;
    settle();
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
    if (!animate || still.matches) return arrive();
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
      painter.setUp();
      request();
    },
  };
  for (const [name, listener] of Object.entries(events)) canvas.addEventListener(name, listener, {passive: false});
  canvas.style.touchAction = "none";

  const resize = () => {
    const bounds = (canvas.parentElement || canvas).getBoundingClientRect(), before = [width, height, ratio];
    [width, height] = [Math.max(1, bounds.width), Math.max(1, bounds.height)];
    ratio = Math.min(2, window.devicePixelRatio || 1);
    // An observer tells the first size, too. Setting the size of a canvas would clear it.
    if ([width, height, ratio].every((size, i) => size === before[i])) return;
    for (const surface of [canvas, overlay])
      [surface.width, surface.height] = [Math.round(width * ratio), Math.round(height * ratio)];
    painter.resize(ratio);
    request();
  };
  let opening = 0;
  const draw = () => {
    if (opening === 0) opening = performance.now() + longestDraw;
    while (!painter.drawRest(view()) && performance.now() < opening) continue;
    update();
  };
  const observer = new ResizeObserver(() => {
    resize();
    if (performance.now() < opening) draw();
  });
  observer.observe(canvas.parentElement || canvas);
  resize();
  painter.setUp();
  putTheme();
  painter.setColors(new Uint8Array(3 * (mesh.triangles.length / 3 + mesh.quads.length / 4)).fill(255));

  return {
    setColors(fills) {
      painter.setColors(fills);
      request();
    },
    setTheme(newTheme) {
      theme = {...theme, ...newTheme};
      putTheme();
      request();
    },
    show, view, select, cellAt, cellsInView, draw,
    snapshot() {
      while (!painter.drawRest(view()));
      drawOverlay();
      const picture = document.createElement("canvas");
      [picture.width, picture.height] = [canvas.width, canvas.height];
      for (const layer of [canvas, overlay]) picture.getContext("2d").drawImage(layer, 0, 0);
      return picture;
    },
    frameTime: painter.time,
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
