// The picture of the mesh: the view that reports have, too, with colours and places.
import {colorLegend, type Legend} from "./legend.ts";
import type {Facts, MeshArrays} from "./values.ts";
import {distinctColor, viridis} from "report-page/colors.js";
import {measureCells, shapeOf} from "report-page/measures.js";
import {placesOfKind, placeTexts} from "report-page/places.js";
import {createView, type View} from "report-page/view.js";

type Box = [number, number, number, number];

/** A part of the plane with a name. */
export interface Place {
  name: string;
  box: Box;
}

/** What people may colour cells by. */
export type Coloring = "none" | "region" | "minAngle" | "ratio" | "size" | "layer" | "piece";

const pixelsNearWalls = 14;
const layerColor = [207, 226, 240],
  outerColor = [246, 246, 243];

/** Returns the vertex of a wall that is nearest to a point, and the name of its marker. */
function nearestWallVertex(mesh: MeshArrays, x: number, y: number): {vertex: number; marker: string} | undefined {
  let nearest = Infinity,
    found: {vertex: number; marker: string} | undefined;
  for (const {name, kind, edges} of mesh.markers)
    if (kind === "wall")
      for (const vertex of edges) {
        const distance = Math.hypot(mesh.points[2 * vertex]! - x, mesh.points[2 * vertex + 1]! - y);
        if (distance < nearest) [nearest, found] = [distance, {vertex, marker: name}];
      }
  return found;
}

/** Returns the places that are worth a look: those of reports, and the first cells at each nose. */
export function placesOf(mesh: MeshArrays, facts: Facts): Place[] {
  const texts = placeTexts(facts.places),
    places = facts.places.map(({window}, i) => ({name: texts[i]!, box: window})),
    noses = placesOfKind(facts.places, "nose");
  noses.forEach(({window: [x0, y0, x1, y1]}, i) => {
    const nose = nearestWallVertex(mesh, 0.5 * (x0 + x1), 0.5 * (y0 + y1));
    const height = facts.elements.find(({name}) => name === nose?.marker)?.first_height;
    if (!nose || !height) return;
    const x = mesh.points[2 * nose.vertex]!,
      y = mesh.points[2 * nose.vertex + 1]!,
      half = 6 * height;
    places.push({
      name: noses.length > 1 ? `first cells ${i + 1}` : "first cells",
      box: [x - half, y - half, x + half, y + half],
    });
  });
  return places;
}

/** Returns three bytes per cell, and the legend that explains them. */
function colorsOf(mesh: MeshArrays, coloring: Coloring): {fills: Uint8Array; legend: Legend} {
  const cells = mesh.triangles.length / 3 + mesh.quads.length / 4,
    fills = new Uint8Array(3 * cells);
  const paint = (colorOf: (cell: number) => readonly number[]): Uint8Array => {
    for (let cell = 0; cell < cells; ++cell) fills.set(colorOf(cell), 3 * cell);
    return fills;
  };
  const inLayer = (cell: number): boolean => mesh.region.length > 0 && mesh.region[cell] === 0;
  switch (coloring) {
    case "none":
      return {fills: fills.fill(255), legend: {kind: "empty"}};
    case "region":
      return {
        fills: paint((cell) => (inLayer(cell) ? layerColor : outerColor)),
        legend: {
          kind: "words",
          words: [
            ["layer", layerColor],
            ["isotropic", outerColor],
          ],
        },
      };
    case "piece":
      return {fills: paint((cell) => distinctColor(mesh.piece[cell]!)), legend: {kind: "empty"}};
    case "layer": {
      const last = mesh.layer.reduce((most, layer) => Math.max(most, layer), 1);
      return {
        fills: paint((cell) =>
          mesh.layer[cell] ? viridis((mesh.layer[cell]! - 1) / Math.max(1, last - 1)) : outerColor,
        ),
        legend: {kind: "ramp", from: "1", to: String(last)},
      };
    }
    default: {
      const values = measureCells(mesh)[coloring];
      // Angles in the layer are small by design, so the scale is that of the other cells.
      let low = Infinity,
        high = -Infinity;
      for (let cell = 0; cell < cells; ++cell) {
        if (coloring !== "size" && inLayer(cell)) continue;
        low = Math.min(low, values[cell]!);
        high = Math.max(high, values[cell]!);
      }
      const scaled = coloring === "size" ? Math.log : (value: number) => value,
        width = scaled(high) - scaled(low) || 1;
      return {
        fills: paint((cell) => viridis((scaled(values[cell]!) - scaled(low)) / width)),
        legend: {kind: "ramp", from: low.toPrecision(3), to: high.toPrecision(3)},
      };
    }
  }
}

/** Shows one mesh after another in a canvas. */
export class Picture {
  #canvas: HTMLCanvasElement;
  #bar: HTMLElement;
  #onPick: (text: string) => void;
  #onHover: (x: number, y: number, reach: number) => void;
  #picked = -1;
  #view: View | undefined;
  #mesh: MeshArrays | undefined;
  #coloring: Coloring = "region";
  #dark = matchMedia("(prefers-color-scheme: dark)");

  /**
   * `onPick` is called with what a cell that people choose has to tell, `onHover` with the place under the pointer and the
   * length of some pixels there.
   */
  constructor(
    canvas: HTMLCanvasElement,
    bar: HTMLElement,
    onPick: (text: string) => void,
    onHover: (x: number, y: number, reach: number) => void,
    onLeave: () => void,
  ) {
    this.#canvas = canvas;
    this.#bar = bar;
    this.#onPick = onPick;
    this.#onHover = onHover;
    canvas.parentElement!.addEventListener("pointermove", (event) => this.#hover(event));
    canvas.parentElement!.addEventListener("pointerleave", onLeave);
    this.#dark.addEventListener("change", () => this.setColoring(this.#coloring));
  }

  /** Shows a mesh; where `keepView`, in the same part of the plane as the one before. */
  setMesh(mesh: MeshArrays, box: Box, keepView: boolean): void {
    const before = keepView ? this.#view?.view() : undefined;
    this.#view?.destroy();
    // A canvas whose context was given up cannot draw again.
    const canvas = this.#canvas.cloneNode() as HTMLCanvasElement;
    this.#canvas.replaceWith(canvas);
    this.#canvas = canvas;
    this.#mesh = mesh;
    const markers = mesh.markers.map((marker) => ({...marker, kind: marker.kind.replace("_", " ")}));
    this.#view = createView(canvas, {...mesh, markers, walls: []}, {onPick: ({cell}) => this.#pick(cell)});
    this.setColoring(this.#coloring);
    if (before) {
      const halfWidth = (0.5 * before.width) / before.scale,
        halfHeight = (0.5 * before.height) / before.scale;
      this.#view.show([before.x - halfWidth, before.y - halfHeight, before.x + halfWidth, before.y + halfHeight], {
        animate: false,
      });
    } else this.#view.show(box, {animate: false});
    this.#picked = -1;
    this.#onPick("");
  }

  setColoring(coloring: Coloring): void {
    this.#coloring = coloring;
    if (!this.#mesh || !this.#view) return;
    const {fills, legend} = colorsOf(this.#mesh, coloring);
    if (coloring === "none" && this.#dark.matches) fills.fill(26);
    this.#setTheme();
    this.#view.setColors(fills);
    this.#bar.replaceChildren(...colorLegend(legend));
  }

  /** Marks the vertex of a wall that is nearest to a point; none where there is no point. */
  mark(at: [number, number] | undefined): void {
    const vertex = at && this.#mesh ? (nearestWallVertex(this.#mesh, ...at)?.vertex ?? -1) : -1;
    this.#view?.select({cell: this.#picked, vertex});
  }

  show(box: Box, animate = true): void {
    this.#view?.show(box, {animate});
  }

  /** Returns the pixels of one row of the picture, from the left: red, green, blue and 255 for each. */
  pixelRow(share: number): Uint8ClampedArray {
    const canvas = this.#view!.snapshot();
    return canvas.getContext("2d")!.getImageData(0, Math.floor(share * canvas.height), canvas.width, 1).data;
  }

  /** Returns the middle and the scale of the view, and the time that its last picture took. */
  state(): (ReturnType<View["view"]> & {frameTime: number}) | undefined {
    return this.#view && {...this.#view.view(), frameTime: this.#view.frameTime()};
  }

  #setTheme(): void {
    const dark = this.#dark.matches;
    // Cells that have colours are light in both themes, so their edges are dark.
    const edge = dark && this.#coloring === "none" ? "#aebccb" : "#1b2733";
    this.#view?.setTheme(
      dark
        ? {background: "#12161c", edge, wall: "#ff7b7b", farField: "#aebccb", strength: 0.55}
        : {background: "#f6f7f9", edge, wall: "#b01e28", farField: "#1b2733", strength: 0.6},
    );
  }

  #hover(event: PointerEvent): void {
    if (!this.#view || event.target !== this.#canvas) return;
    const {x, y, scale, width, height} = this.#view.view(),
      bounds = this.#canvas.getBoundingClientRect();
    this.#onHover(
      x + (event.clientX - bounds.left - 0.5 * width) / scale,
      y - (event.clientY - bounds.top - 0.5 * height) / scale,
      pixelsNearWalls / scale,
    );
  }

  #pick(cell: number): void {
    const mesh = this.#mesh!;
    this.#picked = cell;
    if (cell < 0) return this.#onPick("");
    const {minAngle, maxAngle, aspect, area} = shapeOf(mesh, cell);
    const layer = mesh.layer[cell];
    this.#onPick(
      [
        `cell ${cell}${layer ? `, layer ${layer}` : ""}`,
        `angles ${minAngle.toPrecision(3)} to ${maxAngle.toPrecision(4)} degrees`,
        `aspect ratio ${aspect.toPrecision(3)}`,
        `area ${area.toPrecision(3)}`,
      ].join("\n"),
    );
  }
}
