// Draws the cells of a mesh with WebGL 2: whole pictures where the view rests, and rough ones in time for each frame
// where it moves and whole ones would take too long.
import {RoughTriangles} from "./rough.js";
import {cellPainter, cellShader, copyPainter, copyShader, pointPainter, pointShader} from "./shaders.js";
import {makeProgram, makeTexture, roughPainter, roughShader, splitPoints} from "./shaders.js";

const smallestLeaf = 1.5;       // CSS pixels; what is smaller is drawn as one point
const frameShare = 30;          // milliseconds of a frame that may go into drawing cells
const firstGuess = 4e-4;        // milliseconds that a triangle takes, before any has been measured
const leastMeasured = 1 << 15;  // triangles; fewer are no measurement
const leastStep = 1 << 13;      // triangles of a whole picture that are drawn at once
const leastDrawn = 1 << 12;     // triangles; for fewer a frame is not worth it
const slowFrame = 50;           // milliseconds from one frame to the next; then the next has fewer triangles
const fastFrame = 25;           // then it has more
const roughShare = 0.4;         // of that time is what a triangle takes that stands for others
const mostMagnified = 4;        // times that a whole picture may be stretched or shrunk while the view moves
const finestDetail = 4;         // square pixels; what a triangle that stands for others covers at least

// Returns whether two views show the same pixels.
function sameView(a, b) {
  return a !== null && b !== null && a.x === b.x && a.y === b.y && a.scale === b.scale;
}

// Draws the cells of a mesh into the canvas of a WebGL 2 context. `points` are those of the mesh, `parts` what
// orderTriangles() returns. A view is {x, y, scale, width, height}: the middle, CSS pixels per unit of length, and the
// size of the canvas in CSS pixels.
//
// Returns an object with
//   setUp()                  makes what lies in the memory of the graphics card; also after that was lost
//   setColors(fills)         three bytes per cell: red, green, blue
//   setTheme(theme)          {background, edge}: red, green and blue from 0 to 1; strength, tone: as in createView()
//   resize(ratio)            says that the canvas has changed, and how many of its pixels a CSS pixel has
//   drawRest(view)           goes on with the whole picture for some milliseconds, and returns whether it is shown;
//                            until then the canvas shows a rough one
//   drawMoving(view)         draws what can be drawn in time
//   time()                   milliseconds that the last whole picture took
//   pace()                   milliseconds between the last two frames of a moving view, at most some
export function createPainter(gl, points, parts) {
  const {canvas} = gl;
  let theme = {background: [1, 1, 1], edge: [0, 0, 0], strength: 0.6, tone: 0.5};
  let fills = null, leafFills = new Float32Array(3 * parts.leaves.length);
  let ratio = 1, cells, rough, spots, copy, spotBuffer, roughBuffer;
  const roughTriangles = new RoughTriangles();
  let perTriangle = firstGuess, lastTime = 0, effort = leastDrawn, lastMove = -Infinity, pace = Infinity;
  // A whole picture, {x, y, scale} with the image that holds it, and the one that is being drawn; null: none.
  let kept = null, job = null, shown = null;
  let images = [];

  const setUp = () => {
    cells = makeProgram(gl, cellShader, cellPainter);
    rough = makeProgram(gl, roughShader, roughPainter);
    spots = makeProgram(gl, pointShader, pointPainter);
    copy = makeProgram(gl, copyShader, copyPainter);
    [spotBuffer, roughBuffer] = [gl.createBuffer(), gl.createBuffer()];
    makeTexture(gl, 0, gl.RGBA32UI, gl.RGBA_INTEGER, gl.UNSIGNED_INT, parts.corners);
    makeTexture(gl, 1, gl.RGBA32F, gl.RGBA, gl.FLOAT, splitPoints(points));
    gl.useProgram(cells.program);
    ["corners", "points", "fills"].forEach((name, unit) => gl.uniform1i(cells.uniforms[name], unit));
    images = [];
    forget();
    if (fills) putColors();
  };

  const forget = () => {
    kept = job = shown = null;
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

  // Two images of the size of the canvas, of which one is shown while the other is drawn.
  const makeImages = () => {
    for (const {texture, framebuffer} of images) {
      gl.deleteTexture(texture);
      gl.deleteFramebuffer(framebuffer);
    }
    gl.activeTexture(gl.TEXTURE3);
    images = [0, 1].map(() => {
      const texture = gl.createTexture(), framebuffer = gl.createFramebuffer();
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, canvas.width, canvas.height);
      gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
      return {texture, framebuffer, width: canvas.width, height: canvas.height};
    });
  };

  // --- What to draw

  // Calls visit(leaf, number) for the leaves that reach into a box, [x0, y0, x1, y1].
  const leavesIn = (box, visit) => {
    for (let i = 0; i < parts.leaves.length; ++i) {
      const leaf = parts.leaves[i], around = leaf.box;
      if (around[0] <= box[2] && around[2] >= box[0] && around[1] <= box[3] && around[3] >= box[1]) visit(leaf, i);
    }
  };

  const boxOfView = ({x, y, scale, width, height}) => [
    x - 0.5 * width / scale, y - 0.5 * height / scale, x + 0.5 * width / scale, y + 0.5 * height / scale];

  // Returns what a box in a view shows: leaves as {leaf, number, extent: longer side in pixels}, the spots that stand
  // for leaves below a pixel as five numbers each, and the number of triangles in the leaves.
  const partsIn = (view, box) => {
    const {x, y, scale, width, height} = view, leaves = [], places = [], tone = theme.strength * theme.tone;
    let count = 0;
    leavesIn(box, (leaf, number) => {
      const around = leaf.box, extent = Math.max(around[2] - around[0], around[3] - around[1]) * scale;
      if (extent < smallestLeaf) {
        places.push((around[0] + around[2] - 2 * x) * scale / width, (around[1] + around[3] - 2 * y) * scale / height);
        for (let k = 0; k < 3; ++k) places.push((1 - tone) * leafFills[3 * number + k] + tone * theme.edge[k]);
        return;
      }
      leaves.push({leaf, number, extent: extent * ratio});
      count += leaf.count;
    });
    return {leaves, count, places: new Float32Array(places)};
  };

  const addRange = (ranges, {first, count}) => {
    const last = ranges[ranges.length - 1];
    if (last && last[1] === first) last[1] += count;
    else ranges.push([first, first + count]);
  };

  // Returns the binary logarithm of how many triangles of a leaf one may stand for, where it is to cover `detail`
  // square pixels.
  const levelOf = ({leaf, extent}, detail, pixels) => {
    const wanted = Math.max(leaf.area * pixels * pixels / detail, 2 * extent / Math.sqrt(detail));
    return wanted >= leaf.count ? 0 : Math.min(9, Math.floor(Math.log2(leaf.count / wanted)));
  };

  // Returns how many triangles a frame should have time for.
  const affordable = () => Math.max(leastDrawn, Math.floor(frameShare / perTriangle));

  // Returns the smallest detail at which the leaves take no longer than so many triangles.
  const affordableDetail = (leaves, pixels, most) => {
    for (let detail = finestDetail;; detail *= 2) {
      let count = 0;
      for (const entry of leaves) {
        const level = levelOf(entry, detail, pixels);
        count += level === 0 ? entry.leaf.count : roughShare * (entry.leaf.count >> level);
      }
      if (count <= most || detail > 4096) return detail;
    }
  };

  // --- Drawing

  const bind = (framebuffer) => {
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    gl.viewport(0, 0, canvas.width, canvas.height);
  };

  const clear = () => {
    gl.clearColor(...theme.background, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
  };

  const attribute = (program, name, set) => {
    const at = gl.getAttribLocation(program, name);
    gl.enableVertexAttribArray(at);
    set(at);
    return () => gl.disableVertexAttribArray(at);
  };

  const drawSpots = (places) => {
    if (places.length === 0) return;
    gl.useProgram(spots.program);
    gl.uniform1f(spots.uniforms.size, Math.ceil(smallestLeaf * ratio));
    gl.bindBuffer(gl.ARRAY_BUFFER, spotBuffer);
    gl.bufferData(gl.ARRAY_BUFFER, places, gl.DYNAMIC_DRAW);
    const ends = [["place", 2, 0], ["paint", 3, 8]].map(([name, size, offset]) => attribute(
        spots.program, name, (at) => gl.vertexAttribPointer(at, size, gl.FLOAT, false, 20, offset)));
    gl.drawArrays(gl.POINTS, 0, places.length / 5);
    for (const end of ends) end();
  };

  const drawRanges = ({x, y, scale, width, height}, ranges) => {
    const {program, uniforms} = cells, highX = Math.fround(x), highY = Math.fround(y);
    gl.useProgram(program);
    gl.uniform4f(uniforms.middle, highX, highY, x - highX, y - highY);
    gl.uniform2f(uniforms.scale, 2 * scale / width, 2 * scale / height);
    gl.uniform1f(uniforms.pixels, scale * ratio);
    gl.uniform2f(uniforms.extent, canvas.width, canvas.height);
    gl.uniform4f(uniforms.edge, ...theme.edge, theme.strength);
    gl.uniform1f(uniforms.width, ratio);
    gl.uniform1f(uniforms.tone, theme.tone);
    for (const [first, end] of ranges) gl.drawArrays(gl.TRIANGLES, 3 * first, 3 * (end - first));
  };

  // Draws leaves of which triangles stand for others: {leaf, number, level}.
  const drawRough = ({x, y, scale}, leaves, detail) => {
    const {corners, cell} = parts, pixels = scale * ratio, made = roughTriangles;
    made.begin({width: ratio, strength: theme.strength, tone: theme.tone, edge: theme.edge.map((value) => 255 * value)},
               2 * Math.sqrt(detail));
    // Leaves that are full are filled, so that nothing shines through their triangles.
    made.reserve(18 * leaves.length);
    for (const {leaf: {area, box, count}, number} of leaves)
      if (area > 0.8 * (box[2] - box[0]) * (box[3] - box[1]))
        made.addBox((box[0] - x) * pixels, (box[1] - y) * pixels, (box[2] - x) * pixels, (box[3] - y) * pixels,
                    area / count * pixels * pixels, 255 * leafFills[3 * number], 255 * leafFills[3 * number + 1],
                    255 * leafFills[3 * number + 2]);
    for (const {leaf: {first, count}, level} of leaves) {
      const step = 1 << level;
      made.reserve(made.length + 9 * (count / step + 1));
      for (let i = first; i < first + count; i += step) {
        const a = 2 * corners[4 * i], b = 2 * corners[4 * i + 1], c = 2 * corners[4 * i + 2], fill = 3 * cell[i];
        made.add((points[a] - x) * pixels, (points[a + 1] - y) * pixels, (points[b] - x) * pixels,
                 (points[b + 1] - y) * pixels, (points[c] - x) * pixels, (points[c + 1] - y) * pixels, step,
                 fills[fill], fills[fill + 1], fills[fill + 2]);
      }
    }
    if (made.length === 0) return;
    gl.useProgram(rough.program);
    gl.uniform2f(rough.uniforms.extent, canvas.width, canvas.height);
    gl.bindBuffer(gl.ARRAY_BUFFER, roughBuffer);
    gl.bufferData(gl.ARRAY_BUFFER, made.words.subarray(0, made.length), gl.DYNAMIC_DRAW);
    const ends = [
      attribute(rough.program, "place", (at) => gl.vertexAttribPointer(at, 2, gl.FLOAT, false, 12, 0)),
      attribute(rough.program, "paint", (at) => gl.vertexAttribPointer(at, 4, gl.UNSIGNED_BYTE, true, 12, 8))];
    gl.drawArrays(gl.TRIANGLES, 0, made.length / 3);
    for (const end of ends) end();
  };

  // Draws what a box of a view shows as well as there is time for.
  const drawInTime = (view, {leaves, places}) => {
    const pixels = view.scale * ratio, detail = affordableDetail(leaves, pixels, effort), ranges = [], groups = [];
    for (const entry of leaves) {
      const level = levelOf(entry, detail, pixels);
      if (level === 0) addRange(ranges, entry.leaf);
      else groups.push({leaf: entry.leaf, number: entry.number, level});
    }
    drawSpots(places);
    drawRough(view, groups, detail);
    drawRanges(view, ranges);
  };

  // Copies an image to a part of the canvas, {left, bottom, right, top}. (Blitting takes SwiftShader longer.)
  const copyToCanvas = ({texture, width, height}, {left, bottom, right, top}) => {
    bind(null);
    gl.viewport(left, bottom, right - left, top - bottom);
    gl.useProgram(copy.program);
    gl.activeTexture(gl.TEXTURE3);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    const filter = right - left === width && top - bottom === height ? gl.NEAREST : gl.LINEAR;
    for (const when of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, when, filter);
    gl.uniform1i(copy.uniforms.image, 3);
    gl.uniform4f(copy.uniforms.place, left, bottom, right - left, top - bottom);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    // What is drawn into must not be bound.
    gl.bindTexture(gl.TEXTURE_2D, null);
    bind(null);
  };

  // Draws a part of the canvas, in pixels, as well as there is time for.
  const drawStripe = (view, left, bottom, right, top) => {
    if (right <= left || top <= bottom) return;
    const {width, height} = canvas, pixels = view.scale * ratio;
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(left, bottom, right - left, top - bottom);
    drawInTime(view, partsIn(view, [
      view.x + (left - 0.5 * width) / pixels, view.y + (bottom - 0.5 * height) / pixels,
      view.x + (right - 0.5 * width) / pixels, view.y + (top - 0.5 * height) / pixels]));
    gl.disable(gl.SCISSOR_TEST);
  };

  // Moves the whole picture that is kept to a part of the canvas, and draws what it leaves.
  const drawMoved = (view, place) => {
    const {width, height} = canvas, left = Math.max(0, place.left), right = Math.min(width, place.right);
    drawStripe(view, 0, 0, left, height);
    drawStripe(view, right, 0, width, height);
    drawStripe(view, left, 0, right, place.bottom);
    drawStripe(view, left, place.top, right, height);
    copyToCanvas(kept.image, place);
  };

  // Returns the part of the canvas that the whole picture that is kept covers in a view, or null where it is of no use.
  const placeOfKept = (view) => {
    if (!kept) return null;
    const {width, height} = canvas, factor = view.scale / kept.scale, pixels = view.scale * ratio;
    if (factor > mostMagnified || factor < 1 / mostMagnified) return null;
    const middleX = 0.5 * width + (kept.x - view.x) * pixels, middleY = 0.5 * height + (kept.y - view.y) * pixels;
    const left = Math.round(middleX - 0.5 * width * factor), bottom = Math.round(middleY - 0.5 * height * factor);
    const right = left + Math.round(width * factor), top = bottom + Math.round(height * factor);
    return left < width && right > 0 && bottom < height && top > 0 ? {left, bottom, right, top} : null;
  };

  // What moves has as many triangles as the frames before it had time for.
  const followPace = () => {
    const now = performance.now();
    pace = now - lastMove;
    lastMove = now;
    if (pace > 4 * slowFrame) effort = affordable();
    else if (pace > slowFrame) effort = Math.max(leastDrawn, 0.8 * effort);
    else if (pace < fastFrame) effort = Math.min(1.1 * effort, 2 * affordable());
  };

  const drawMoving = (view) => {
    job = null;
    followPace();
    bind(null);
    clear();
    shown = {...view};
    const seen = partsIn(view, boxOfView(view)), place = placeOfKept(view);
    if (place && (kept.scale === view.scale || seen.count > effort)) drawMoved(view, place);
    else drawInTime(view, seen);
  };

  const begin = (view) => {
    if (images.length === 0 || images[0].width !== canvas.width || images[0].height !== canvas.height) {
      makeImages();
      kept = null;
    }
    const ranges = [], {leaves, count, places} = partsIn(view, boxOfView(view));
    for (const {leaf} of leaves) addRange(ranges, leaf);
    const image = images.find((other) => !kept || other !== kept.image);
    return {...view, image, ranges: ranges.reverse(), places, count, time: 0, begun: false};
  };

  // Takes ranges with at most so many triangles off the end of a list.
  const takeRanges = (ranges, most) => {
    const taken = [];
    while (ranges.length > 0 && most > 0) {
      const range = ranges[ranges.length - 1], count = Math.min(most, range[1] - range[0]);
      taken.push([range[0], range[0] + count]);
      range[0] += count;
      most -= count;
      if (range[0] === range[1]) ranges.pop();
    }
    return taken;
  };

  const pixel = new Uint8Array(4);
  // Returns when all that was asked for is drawn.
  const wait = () => gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);

  const goOn = () => {
    bind(job.image.framebuffer);
    wait();
    const start = performance.now();
    if (!job.begun) {
      clear();
      drawSpots(job.places);
      job.begun = true;
    }
    const taken = takeRanges(job.ranges, Math.max(leastStep, affordable()));
    drawRanges(job, taken);
    wait();
    job.time += performance.now() - start;
  };

  const drawRest = (view) => {
    if (!sameView(kept, view)) {
      if (!sameView(job, view)) job = begin(view);
      if (!sameView(shown, view) && job.count > affordable()) {
        const begun = job;
        drawMoving(view);
        job = begun;
        return false;
      }
      goOn();
      if (job.ranges.length > 0) return false;
      lastTime = job.time;
      if (job.count >= leastMeasured) perTriangle = lastTime / job.count;
      [kept, job] = [job, null];
    }
    copyToCanvas(kept.image, {left: 0, bottom: 0, right: canvas.width, top: canvas.height});
    shown = {...view};
    return true;
  };

  return {
    setUp, drawRest, drawMoving,
    setColors(newFills) {
      fills = newFills;
      putColors();
      forget();
    },
    setTheme(newTheme) {
      theme = newTheme;
      forget();
    },
    resize(newRatio) {
      ratio = newRatio;
      forget();
    },
    time: () => lastTime,
    pace: () => Math.min(pace, 4 * slowFrame),
  };
}
