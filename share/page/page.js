// The page round the view: colours, places, numbers, charts. The element "facts" holds a JSON object:
//   title          heading
//   report         the report of `lamina mesh --report`, or the result of `lamina check --json`
//   configuration  options in force: [{name, value, given}]
//   places         [{name, window: [x0, y0, x1, y1]}], as named_places() returns them
//   chord          the length that counts as one chord
import {decodeMesh} from "./decode.js";
import {cellCount, cornersOf, histogram, lowest, measureCells, shapeOf} from "./measures.js";
import {cssColor, distinctColor, viridis} from "./colors.js";
import {placesOfKind, placeTexts} from "./places.js";
import {createView} from "./view.js";
import {barChart, countText, curveChart, numberText} from "./charts.js";

const byId = (id) => document.getElementById(id);

// Makes an element; text becomes text, never markup.
function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (key === "style") element.style.cssText = value;
    else if (value !== null && value !== false) element.setAttribute(key, value === true ? "" : value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

function table(rows) {
  return make("table", {}, make("tbody", {}, ...rows.filter(Boolean).map(([name, value, note, given]) =>
      make("tr", {class: given ? "given" : null}, make("th", {scope: "row"}, name),
           make("td", {}, String(value), note ? make("small", {}, note) : null)))));
}

function section(title, {note = "", open = false}, ...children) {
  return make("details", {open}, make("summary", {}, title, note ? make("small", {}, note) : null), ...children);
}

const plain = (key) => key.replaceAll("_", " ");

// --- Colours

const themes = {
  light: {background: "#f6f7f9", edge: "#1d2733", wall: "#b3122a", farField: "#5c6775", selection: "#e8590c",
          cell: [255, 255, 255], layer: [217, 231, 250]},
  dark: {background: "#12161c", edge: "#c3cedb", wall: "#ff7b7b", farField: "#7d8896", selection: "#ffb454",
         cell: [27, 33, 42], layer: [28, 52, 84]},
};

// The colours that cells may have. A scale has values per cell; logarithmic ones hold logarithms.
function makeColorings(mesh, measures) {
  const logarithm = (values) => Float32Array.from(values, (value) => Math.log10(value));
  const power = (value) => numberText(10 ** value, 2);
  const colorings = [
    {key: "none", name: "plain; the boundary layer tinted"},
    {key: "ratio", name: "mean ratio (1: equilateral, square)", values: () => measures.ratio, range: [0, 1]},
    {key: "minAngle", name: "smallest angle", values: () => measures.minAngle, range: [0, 60],
     format: (value) => `${numberText(value, 3)}°`},
    {key: "maxAngle", name: "largest angle", values: () => measures.maxAngle, range: [60, 180],
     format: (value) => `${numberText(value, 3)}°`, reverse: true},
    {key: "aspect", name: "aspect ratio", values: () => logarithm(measures.aspect), format: power},
    {key: "size", name: "size: root of the area", values: () => logarithm(measures.size), format: power},
  ];
  if (mesh.region) colorings.push({key: "region", name: "region", classes: (cell) => mesh.region[cell],
                                   names: ["boundary layer", "elsewhere"]});
  if (mesh.layer) colorings.push({key: "layer", name: "number of the layer", values: () => mesh.layer,
                                  skipped: (cell) => mesh.layer[cell] === 0, least: 1});
  if (mesh.piece) colorings.push({key: "piece", name: "piece that made it", classes: (cell) => mesh.piece[cell]});
  return colorings;
}

function rangeOf(values, cells, skipped) {
  let low = Infinity, high = -Infinity;
  const include = (cell) => {
    const value = values[cell];
    if (!Number.isFinite(value) || (skipped && skipped(cell))) return;
    if (value < low) low = value;
    if (value > high) high = value;
  };
  cells(include);
  if (!(low <= high)) return [0, 1];
  return low === high ? [low, low + 1e-6 * Math.max(1, Math.abs(low))] : [low, high];
}

// --- The page

class Page {
  constructor(facts, mesh) {
    this.facts = facts;
    this.mesh = mesh;
    this.report = facts.report || {};
    this.chord = facts.chord > 0 ? facts.chord : 1;
    this.cells = cellCount(mesh);
    this.measures = measureCells(mesh);
    this.colorings = makeColorings(mesh, this.measures);
    this.coloring = this.colorings[0];
    this.view = createView(byId("view"), mesh, {onMove: () => this.moved(), onPick: (hit) => this.showHit(hit)});
    this.dark = matchMedia("(prefers-color-scheme: dark)");
    this.dark.addEventListener("change", () => this.paint());
    this.hit = make("div", {"aria-live": "polite"});
    this.showHit({cell: -1, vertex: -1});
    this.addColors();
    this.addPlaces();
    this.addPanel();
    byId("save").addEventListener("click", () => this.save());
    this.paint();
    const [start] = [...this.places("walls"), ...this.places("all")];
    if (start) this.view.show(start.window);
    this.view.draw();
  }

  places(kind) {
    return placesOfKind(this.facts.places || [], kind);
  }

  length(value) {
    if (!Number.isFinite(value)) return "none";
    const chords = `${numberText(value / this.chord)} chords`;
    return this.chord === 1 ? chords : `${numberText(value)} (${chords})`;
  }

  // --- Colours

  addColors() {
    const select = byId("color");
    for (const {key, name} of this.colorings) select.append(make("option", {value: key}, name));
    select.addEventListener("change", () => {
      this.coloring = this.colorings.find(({key}) => key === select.value);
      this.paint();
    });
    byId("fit").addEventListener("change", () => this.paint());
  }

  // Follows the view where the scale is to span what is in it.
  followView({x, y, scale}) {
    if (!byId("fit").checked || !this.coloring.values) return;
    if (this.painted && this.painted.x === x && this.painted.y === y && this.painted.scale === scale) return;
    clearTimeout(this.following);
    this.following = setTimeout(() => this.paint(), 250);
  }

  paint() {
    this.painted = this.view.view();
    const theme = themes[this.dark.matches ? "dark" : "light"], {coloring, mesh} = this;
    const colored = coloring.key !== "none";
    this.view.setTheme({...theme, edge: colored ? "#10151c" : theme.edge, strength: colored ? 0.45 : 0.6,
                        tone: colored ? 0 : 0.45});
    const fills = new Uint8Array(3 * this.cells);
    const fill = (cell, color) => {
      fills[3 * cell] = color[0];
      fills[3 * cell + 1] = color[1];
      fills[3 * cell + 2] = color[2];
    };
    const bar = byId("bar");
    bar.replaceChildren();
    byId("fit-label").hidden = !coloring.values;
    byId("fit-label").style.display = coloring.values ? "" : "none";
    if (!colored) {
      for (let cell = 0; cell < this.cells; ++cell)
        fill(cell, mesh.region && mesh.region[cell] === 0 ? theme.layer : theme.cell);
    } else if (coloring.classes) {
      const names = coloring.names || [];
      for (let cell = 0; cell < this.cells; ++cell) fill(cell, distinctColor(coloring.classes(cell)));
      if (names.length > 0)
        bar.append(make("div", {class: "swatches"}, ...names.map((name, number) =>
            make("span", {}, make("i", {style: `background:${cssColor(distinctColor(number))}`}), name))));
    } else {
      this.paintScale(coloring, fill, theme);
    }
    this.view.setColors(fills);
  }

  paintScale(coloring, fill, theme) {
    const values = coloring.values(), inView = byId("fit").checked;
    const all = (visit) => {
      for (let cell = 0; cell < this.cells; ++cell) visit(cell);
    };
    const [low, high] = !inView && coloring.range ? coloring.range
        : rangeOf(values, inView ? this.view.cellsInView : all, coloring.skipped);
    const steps = Array.from({length: 256}, (_, i) => viridis((coloring.reverse ? 255 - i : i) / 255));
    const scale = 255 / (high - low);
    for (let cell = 0; cell < this.cells; ++cell) {
      if (coloring.skipped && coloring.skipped(cell)) fill(cell, theme.cell);
      else fill(cell, steps[Math.max(0, Math.min(255, Math.round((values[cell] - low) * scale)))]);
    }
    const format = coloring.format || ((value) => numberText(value, 3));
    const stops = steps.filter((_, i) => i % 15 === 0).map(cssColor).join(",");
    byId("bar").append(
        make("div", {class: "ramp", style: `background:linear-gradient(to right,${stops})`}),
        make("div", {class: "ticks"}, ...[0, 0.25, 0.5, 0.75, 1].map((share) =>
            make("span", {}, format(low + share * (high - low))))));
  }

  // --- Places

  goTo(window) {
    this.view.show(window, {animate: true});
  }

  goToPoint(x, y, side) {
    this.goTo([x - side / 2, y - side / 2, x + side / 2, y + side / 2]);
  }

  goToCell(cell) {
    const v = cornersOf(this.mesh, cell), p = this.mesh.points, shape = shapeOf(this.mesh, cell);
    let x = 0, y = 0, longest = 0;
    v.forEach((corner, i) => {
      const next = v[(i + 1) % v.length];
      x += p[2 * corner] / v.length;
      y += p[2 * corner + 1] / v.length;
      longest = Math.max(longest, Math.hypot(p[2 * next] - p[2 * corner], p[2 * next + 1] - p[2 * corner + 1]));
    });
    // Of a thin cell the thickness should be seen rather than the length.
    const thickness = Math.max(shape.area / longest, 1e-9 * longest);
    const side = 20 * thickness * (longest / thickness) ** 0.25;
    this.view.select({cell, vertex: -1});
    this.showHit({cell, vertex: -1});
    this.goToPoint(x, y, side);
  }

  // Shows the first cells over a vertex of a wall.
  goToVertex(body, index) {
    const wall = this.mesh.walls[body], vertex = wall.vertices[index], height = wall.firstHeights[index];
    const p = this.mesh.points;
    this.view.select({cell: -1, vertex});
    this.showHit({cell: -1, vertex});
    this.goToPoint(p[2 * vertex], p[2 * vertex + 1],
                   Number.isFinite(height) && height > 0 ? 14 * height : 0.01 * this.chord);
  }

  firstCellAt(window) {
    const x = 0.5 * (window[0] + window[2]), y = 0.5 * (window[1] + window[3]), p = this.mesh.points;
    let nearest = Infinity, found = null;
    this.mesh.walls.forEach(({vertices}, body) => vertices.forEach((v, i) => {
      const distance = Math.hypot(p[2 * v] - x, p[2 * v + 1] - y);
      if (distance < nearest) [nearest, found] = [distance, [body, i]];
    }));
    if (found) this.goToVertex(...found);
  }

  addPlaces() {
    const places = this.facts.places || [], texts = placeTexts(places);
    places.forEach(({window}, i) => byId("places").append(make(
      "button", {type: "button", onclick: () => this.goTo(window)}, texts[i])));
    const [nose] = this.places("nose");
    if (nose && this.mesh.walls.length > 0)
      byId("places").append(make("button", {type: "button", id: "first-cell", title: "The first cells at the nose",
                                            onclick: () => this.firstCellAt(nose.window)}, "first cell"));
  }

  moved() {
    const {scale, width} = this.view.view();
    this.followView(this.view.view());
    // The longest length of 1, 2 or 5 times a power of ten that takes at most a quarter of the view.
    const most = Math.min(150, 0.25 * width) / scale / this.chord, unit = 10 ** Math.floor(Math.log10(most));
    const nice = [5, 2, 1].find((factor) => factor * unit <= most) * unit;
    const [text, line] = byId("scale").children;
    text.textContent = `${numberText(nice, 1)} ${nice === 1 ? "chord" : "chords"}`;
    line.style.width = `${nice * this.chord * scale}px`;
  }

  // --- What was hit

  showHit({cell, vertex}) {
    this.hit.replaceChildren();
    if (vertex >= 0)
      this.hit.append(make("h3", {}, `Vertex ${countText(vertex)} on the wall`), this.vertexTable(vertex));
    if (cell >= 0) this.hit.append(make("h3", {}, `Cell ${countText(cell)}`), this.cellTable(cell));
    if (cell < 0 && vertex < 0)
      this.hit.append(make("p", {class: "hint"},
                           "Click a cell or a vertex of a wall to read its numbers. Drag to move, turn the wheel or " +
                           "pinch to zoom; on the keyboard: arrows, + and −, and Enter for the cell in the middle."));
  }

  pointText(vertex) {
    return [0, 1].map((axis) => numberText(this.mesh.points[2 * vertex + axis], 12)).join(", ");
  }

  cellTable(cell) {
    const {mesh} = this, shape = shapeOf(mesh, cell), v = [...cornersOf(mesh, cell)];
    return table([
      ["kind", v.length === 3 ? "triangle" : "quadrilateral"],
      mesh.region && ["region", ["boundary layer", "outside the boundary layer"][mesh.region[cell]]],
      mesh.layer && mesh.layer[cell] > 0 && ["layer", mesh.layer[cell]],
      mesh.piece && ["piece", mesh.piece[cell]],
      ["smallest angle", `${numberText(shape.minAngle)}°`],
      ["largest angle", `${numberText(shape.maxAngle)}°`],
      ["mean ratio", numberText(shape.ratio)],
      ["aspect ratio", numberText(shape.aspect)],
      ["size", this.length(Math.sqrt(shape.area)), "root of the area"],
      ...v.map((corner, i) => [i === 0 ? "vertices" : "", countText(corner), this.pointText(corner)]),
    ]);
  }

  vertexTable(vertex) {
    const body = this.mesh.walls.findIndex(({vertices}) => vertices.includes(vertex));
    const {vertices, firstHeights} = this.mesh.walls[body], at = vertices.indexOf(vertex);
    const {arc, spacing} = this.wallCurves()[body];
    const marker = this.mesh.markers.find(({kind, edges}) => kind === "wall" && edges.includes(vertex));
    return table([
      ["wall", marker ? marker.name : body + 1],
      ["place", this.pointText(vertex)],
      ["along the wall", this.length(arc[at]), "from the first vertex of the body"],
      ["to the next", this.length(spacing[at])],
      ["first height", this.length(firstHeights[at])],
    ]);
  }

  // Returns, per body: arc length at each vertex, whole length, and the distance to the next vertex.
  wallCurves() {
    if (this.curves) return this.curves;
    const p = this.mesh.points;
    this.curves = this.mesh.walls.map(({vertices}) => {
      const arc = [], spacing = [];
      let length = 0;
      vertices.forEach((v, i) => {
        const next = vertices[(i + 1) % vertices.length];
        arc.push(length);
        spacing.push(Math.hypot(p[2 * next] - p[2 * v], p[2 * next + 1] - p[2 * v + 1]));
        length += spacing[i];
      });
      return {arc, spacing, length};
    });
    return this.curves;
  }

  // --- The panel

  addPanel() {
    const {report, facts} = this;
    document.title = `${facts.title || "mesh"} – lamina`;
    byId("title").textContent = facts.title || "mesh";
    const reynolds = report.conditions && report.conditions.reynolds;
    byId("subtitle").textContent = [
      `${countText(this.cells)} cells`, `${countText(this.mesh.points.length / 2)} vertices`,
      reynolds ? `Reynolds number ${numberText(reynolds.value)}` : null,
      report.valid === false ? "not valid" : null,
    ].filter(Boolean).join("  ·  ");
    byId("panel").append(...[
      section("Cell", {open: true}, this.hit), this.warnings(), this.quality(), this.walls(), this.worst(),
      this.conditions(), this.run(), this.configuration(),
    ].filter(Boolean));
  }

  warnings() {
    const found = [...(this.report.warnings || []).map(({message, at, code}) => ({title: plain(code), message, at})),
                   ...(this.report.defects || []).map(({what, at}) => ({title: "defect", message: what, at}))];
    if (found.length === 0) return null;
    const show = (at) => make("div", {}, make("button", {type: "button", onclick: () => this.goToWarning(at)}, "Show"));
    return section("Warnings", {open: true, note: countText(found.length)}, ...found.map(({title, message, at}) =>
        make("div", {class: "warning"}, make("b", {}, title), message, at ? show(at) : null)));
  }

  goToWarning([x, y]) {
    let cell = this.view.cellAt(x, y);
    // On a wall the point may lie a little outside of all cells.
    if (cell < 0) {
      const v = this.nearestVertex(x, y);
      cell = this.cellAtVertex(v);
    }
    this.view.select({cell, vertex: -1});
    this.showHit({cell, vertex: -1});
    const size = cell >= 0 ? Math.sqrt(shapeOf(this.mesh, cell).area) : 0.002 * this.chord;
    this.goToPoint(x, y, 30 * size);
  }

  nearestVertex(x, y) {
    const p = this.mesh.points;
    let nearest = Infinity, found = 0;
    for (let v = 0; v < p.length / 2; ++v) {
      const distance = (p[2 * v] - x) ** 2 + (p[2 * v + 1] - y) ** 2;
      if (distance < nearest) [nearest, found] = [distance, v];
    }
    return found;
  }

  cellAtVertex(vertex) {
    const triangle = this.mesh.triangles.indexOf(vertex), quad = this.mesh.quads.indexOf(vertex);
    if (triangle >= 0) return Math.floor(triangle / 3);
    return quad >= 0 ? this.mesh.triangles.length / 3 + Math.floor(quad / 4) : -1;
  }

  isOutside(cell) {
    return !this.mesh.region || this.mesh.region[cell] !== 0;
  }

  quality() {
    const {measures, mesh} = this, outside = (cell) => this.isOutside(cell), inside = (cell) => !this.isOutside(cell);
    const count = (selected) => {
      let found = 0;
      for (let cell = 0; cell < this.cells; ++cell) if (selected(cell)) ++found;
      return found;
    };
    const mean = (values, selected) => {
      let sum = 0;
      for (let cell = 0; cell < this.cells; ++cell) if (selected(cell)) sum += values[cell];
      return sum / count(selected);
    };
    const layered = mesh.region !== null && count(inside) > 0;
    const where = layered ? "outside the boundary layer" : "all cells";
    const chart = (title, note, options) => [make("h3", {}, title, make("small", {}, note)),
                                             barChart({label: title, ...options})];
    const scale = (share) => cssColor(viridis(share));
    const degrees = (value) => `${numberText(value, 3)}°`, power = (value) => numberText(10 ** value, 2);
    const charts = [];
    if (count(outside) > 0)
      charts.push(
          ...chart("Smallest angles", `${where}, mean ${degrees(mean(measures.minAngle, outside))}`,
                   {counts: histogram(measures.minAngle, 0, 60, 30, outside), from: 0, to: 60, format: degrees,
                    color: scale}),
          ...chart("Mean ratio", `${where}, mean ${numberText(mean(measures.ratio, outside), 3)}`,
                   {counts: histogram(measures.ratio, 0, 1, 40, outside), from: 0, to: 1, color: scale}));
    if (layered) {
      const logarithm = Float32Array.from(measures.aspect, (value) => Math.min(12, Math.log10(value)));
      let most = 1;
      for (let cell = 0; cell < this.cells; ++cell) if (inside(cell)) most = Math.max(most, Math.ceil(logarithm[cell]));
      charts.push(...chart("Aspect ratios", "in the boundary layer",
                           {counts: histogram(logarithm, 0, most, 40, inside), from: 0, to: most,
                            parts: Math.min(most, 8), format: power}),
                  ...chart("Largest angles", "in the boundary layer",
                           {counts: histogram(measures.maxAngle, 80, 180, 40, inside), from: 80, to: 180,
                            format: degrees}));
    }
    if (mesh.growth.some((number) => number > 0)) {
      const first = 0.8, width = 0.02, counts = [...mesh.growth];
      while (counts.length > 40 && counts[counts.length - 1] === 0) counts.pop();
      charts.push(...chart("Growth", "height of a cell over that of the one below",
                           {counts, from: first, to: first + width * counts.length}));
    }
    return section("Quality", {open: true}, ...charts);
  }

  walls() {
    if (this.mesh.walls.length === 0) return null;
    const curves = this.wallCurves(), names = this.mesh.walls.map(({vertices}, body) => {
      const marker = this.mesh.markers.find(({kind, edges}) => kind === "wall" && edges.includes(vertices[0]));
      return marker ? marker.name : `body ${body + 1}`;
    });
    const curveOf = (body, y) => ({
      name: names[body], color: `hsl(${(210 + 137.5 * body) % 360} 60% 52%)`, body,
      x: curves[body].arc.map((arc) => arc / curves[body].length), y: [...y].map((value) => value / this.chord)});
    const onPick = ({body}, index) => this.goToVertex(body, index);
    const chart = (title, values) => [
      make("h3", {}, title, make("small", {}, "chords")),
      make("div", {class: "curves"},
           curveChart({label: title, onPick, curves: curves.map((_, body) => curveOf(body, values(body)))}))];
    const legend = names.length < 2 ? null : make("p", {class: "hint"}, ...names.flatMap((name, body) =>
        [make("i", {class: "dot", style: `background:${curveOf(body, []).color}`}), `${name}   `]));
    return section("Walls", {open: true, note: "click a curve to go there"},
                   ...chart("Distance to the next vertex", (body) => curves[body].spacing),
                   ...chart("First heights", (body) => this.mesh.walls[body].firstHeights), legend);
  }

  worst() {
    const {measures} = this, outside = (cell) => this.isOutside(cell);
    const negative = (values) => values.map((value) => -value);
    const group = (title, cells, text) => cells.length === 0 ? [] : [
      make("h3", {}, title),
      make("div", {class: "links"}, ...cells.map((cell) =>
          make("button", {type: "button", class: "worst", onclick: () => this.goToCell(cell)}, text(cell))))];
    return section("Worst cells", {open: false},
                   ...group("Smallest angle outside the boundary layer", lowest(measures.minAngle, 5, outside),
                            (cell) => `${numberText(measures.minAngle[cell], 3)}°`),
                   ...group("Lowest mean ratio outside the boundary layer", lowest(measures.ratio, 5, outside),
                            (cell) => numberText(measures.ratio[cell], 3)),
                   ...group("Largest angle", lowest(negative(measures.maxAngle), 5),
                            (cell) => `${numberText(measures.maxAngle[cell], 4)}°`),
                   ...group("Largest aspect ratio", lowest(negative(measures.aspect), 5),
                            (cell) => numberText(measures.aspect[cell], 4)));
  }

  conditions() {
    const {conditions} = this.report;
    if (!conditions) return null;
    const rows = [];
    const add = (name, fact) => {
      if (fact.value !== undefined) rows.push([name, numberText(fact.value, 6), fact.source]);
      else if (fact.units !== undefined) rows.push([name, this.length(fact.units), fact.source]);
    };
    for (const [key, fact] of Object.entries(conditions)) {
      add(plain(key), fact);
      for (const of of fact.elements || []) add(`${plain(key)}, ${of.element}`, of);
    }
    for (const wake of conditions.wakes || [])
      rows.push([`wake of ${wake.element}`, `${this.length(wake.length.units)} long`, wake.source]);
    return section("Conditions", {open: false}, table(rows));
  }

  run() {
    const {report} = this, seconds = Object.entries(report.seconds || {}).filter(([key]) => key !== "total");
    const total = report.seconds ? report.seconds.total : 0;
    const color = (i) => cssColor(viridis(0.15 + 0.8 * i / Math.max(1, seconds.length - 1)));
    const times = total > 0 ? [
      make("h3", {}, "Time", make("small", {}, `${numberText(total, 3)} s on ${report.threads} threads`)),
      make("div", {class: "times", "aria-hidden": "true"}, ...seconds.map(([, value], i) =>
          make("i", {style: `flex:${value / total};background:${color(i)}`}))),
      table(seconds.map(([key, value]) => [plain(key), `${numberText(value, 3)} s`])),
    ] : [];
    const inputs = (report.input || []).map(({name, file, points, repairs, surface}) =>
        [name, `${countText(points)} points`, [file.split("/").pop(), ...repairs, ...surface].join("; ")]);
    const markers = this.mesh.markers.map(({name, kind, edges}) =>
        [name, `${countText(edges.length / 2)} edges`, kind]);
    return section("Mesh and run", {open: false},
                   ...(inputs.length > 0 ? [make("h3", {}, "Input"), table(inputs)] : []),
                   make("h3", {}, "Markers"), table(markers),
                   make("h3", {}, "Mesh"),
                   table([["triangles", countText(this.mesh.triangles.length / 3)],
                          ["quadrilaterals", countText(this.mesh.quads.length / 4)],
                          ["vertices", countText(this.mesh.points.length / 2)],
                          report.valid !== undefined && ["valid", report.valid ? "yes" : "no"],
                          report.hash && ["hash", report.hash],
                          report.version && ["made by", `lamina ${report.version}`]]),
                   ...times);
  }

  configuration() {
    const options = this.facts.configuration;
    if (!options) return null;
    return section("Configuration", {open: false, note: "given ones in bold"},
                   table(options.map(({name, value, given}) => [name, value, null, given])));
  }

  save() {
    this.view.snapshot().toBlob((blob) => {
      const link = make("a", {href: URL.createObjectURL(blob), download: `${this.facts.title || "mesh"}.png`});
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    });
  }
}

async function start() {
  const state = byId("state");
  try {
    const facts = JSON.parse(byId("facts").textContent);
    const mesh = await decodeMesh(byId("mesh").textContent);
    byId("mesh").remove();
    // What a page shows, for whoever looks into it with the developer tools.
    window.lamina = new Page(facts, mesh);
    state.textContent = "";
  } catch (error) {
    state.textContent = `The mesh cannot be shown: ${error.message}.`;
    console.error(error);
  }
}
// The page counts as loaded once its picture is there: browsers without a window take one of it then.
await start();
