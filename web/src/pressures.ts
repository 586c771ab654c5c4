// The chart of the pressures on the walls, beside the mesh: cp over x/c, upwards where the flow is fast.
import type {FlowFacts} from "./values.ts";
import {numberText, svgElement} from "report-page/charts.js";

/** A point of a wall: the number of its element, and its own. */
export interface WallPlace {
  element: number;
  point: number;
}

/** How the chart is laid out, and where its curves are: x and y of each point, in units of the chart. */
export interface Layout {
  curves: {name: string; x: Float64Array; y: Float64Array}[];
  cpTicks: {y: number; text: string}[];
  xTicks: {x: number; text: string}[];
  /** The height of cp*; none where it is beyond the pressures shown. */
  critical: number | undefined;
}

const frame = {width: 340, height: 190, left: 34, right: 8, top: 10, bottom: 24};
const colors = ["#0b84b8", "#d9761c", "#2e9d6a", "#b3589a", "#8f8a2c", "#6d6fd0"];

/** Returns the colour of an element's curve. */
export function colorOf(element: number): string {
  return colors[element % colors.length]!;
}

/** Returns the pressures to show: all, unless few points at sharp corners, where speed has no limit, hide the rest. */
function pressuresShown({elements, compressible}: FlowFacts): [number, number] {
  const values = elements.flatMap(({cp}) => [...cp]).sort((a, b) => a - b),
    usual = values[Math.floor(values.length / 25)]!,
    least = values[0]!;
  return [compressible ? least : Math.max(least, Math.min(2 * usual, -1)), Math.max(1, values.at(-1)!)];
}

/** Returns a step of 1, 2 or 5 times a power of ten that divides a length into about five. */
function stepOf(length: number): number {
  const power = 10 ** Math.floor(Math.log10(length / 5));
  return power * [1, 2, 5, 10].find((factor) => 5 * factor * power >= 0.8 * length)!;
}

function ticks(low: number, high: number): number[] {
  const rounding = 1e-6, // sections of a chord of 1 are often a bit shorter
    step = stepOf(high - low),
    first = Math.ceil(low / step - rounding);
  return Array.from({length: Math.floor(high / step + rounding) - first + 1}, (_, i) => (first + i) * step);
}

/** Returns where the chart of a flow has its curves. x counts from the foremost point, in chords. */
export function layoutOf(flow: FlowFacts, chord: number): Layout {
  const [low, high] = pressuresShown(flow),
    along = flow.elements.flatMap(({points}) => [...points].filter((_, i) => i % 2 === 0)),
    first = Math.min(...along),
    length = (Math.max(...along) - first) / chord,
    right = frame.width - frame.right,
    ground = frame.height - frame.bottom;
  const placeX = (share: number): number => frame.left + (share / length) * (right - frame.left),
    placeY = (cp: number): number => frame.top + ((Math.max(cp, low) - low) / (high - low)) * (ground - frame.top);
  const {critical_cp: critical} = flow;
  return {
    curves: flow.elements.map(({name, points, cp}) => ({
      name,
      x: Float64Array.from(cp, (_, i) => placeX((points[2 * i]! - first) / chord)),
      y: Float64Array.from(cp, placeY),
    })),
    cpTicks: ticks(low, high).map((cp) => ({y: placeY(cp), text: numberText(cp, 3).replace("-", "−")})),
    xTicks: ticks(0, length).map((share) => ({x: placeX(share), text: numberText(share, 3)})),
    critical: critical !== null && critical >= low && critical <= high ? placeY(critical) : undefined,
  };
}

/** Returns the place whose point is nearest to (x, y), unless all are farther away than `reach`. */
export function nearestPlace(
  curves: {x: ArrayLike<number>; y: ArrayLike<number>}[],
  x: number,
  y: number,
  reach: number,
): WallPlace | undefined {
  let nearest = reach,
    found: WallPlace | undefined;
  curves.forEach((curve, element) => {
    for (let point = 0; point < curve.x.length; ++point) {
      const distance = Math.hypot(curve.x[point]! - x, curve.y[point]! - y);
      if (distance < nearest) [nearest, found] = [distance, {element, point}];
    }
  });
  return found;
}

function axisText(x: number, y: number, text: string, anchor: string): SVGElement {
  return svgElement("text", {x, y, "text-anchor": anchor, class: "axis"}, text);
}

/** A chart in an element of the page, which tells and shows the point of a wall that people look at. */
export class PressureChart {
  #box: HTMLElement;
  #onHover: (place: WallPlace | undefined) => void;
  #flow: FlowFacts | undefined;
  #layout: Layout | undefined;
  #dot: SVGElement | undefined;
  #told = document.createElement("p");

  /** `onHover` is called with the place in the chart that the pointer is near to, or with none. */
  constructor(box: HTMLElement, onHover: (place: WallPlace | undefined) => void) {
    this.#box = box;
    this.#onHover = onHover;
    this.#told.className = "hint";
  }

  /** Shows a flow; where there is none, what would make one. */
  setFlow(flow: FlowFacts | null, chord: number): void {
    this.#flow = flow ?? undefined;
    this.#layout = flow ? layoutOf(flow, chord) : undefined;
    this.#dot = svgElement("circle", {r: 3.5, class: "dot-of-curve", visibility: "hidden"});
    this.#box.replaceChildren(
      ...(this.#layout ? [this.#legend(), this.#chart(this.#layout), this.#told] : [this.#told]),
    );
    this.mark(undefined);
  }

  /** Marks a point of a wall, and says its pressure. */
  mark(place: WallPlace | undefined): void {
    const flow = this.#flow,
      layout = this.#layout;
    if (!flow || !layout) {
      this.#told.textContent =
        "No flow decided on this mesh: it needs a Reynolds number, and a flow that can be solved.";
      return;
    }
    const dot = this.#dot!;
    dot.setAttribute("visibility", place ? "visible" : "hidden");
    if (!place) {
      this.#told.textContent = this.#summary(flow);
      return;
    }
    const {element, point} = place,
      {name, points, cp} = flow.elements[element]!,
      curve = layout.curves[element]!;
    dot.setAttribute("cx", String(curve.x[point]));
    dot.setAttribute("cy", String(curve.y[point]));
    dot.setAttribute("fill", colorOf(element));
    const at = [2 * point, 2 * point + 1].map((i) => numberText(points[i]!, 4)).join(", ");
    this.#told.textContent = `${name} at (${at}): cp ${numberText(cp[point]!, 4)}`;
  }

  #summary({alpha, mach, lift, compressible}: FlowFacts): string {
    const kind = compressible ? "Euler equations" : "Potential flow";
    const at = `${numberText(alpha)} degrees${mach === null ? "" : `, Mach ${numberText(mach)}`}`;
    const rounded = Math.round(lift * 1e5) / 1e5 + 0; // what is left of sums is no lift, and -0 + 0 is 0
    return `${kind} at ${at}: lift coefficient ${numberText(rounded, 4)}`;
  }

  #legend(): HTMLElement {
    const legend = document.createElement("div");
    legend.className = "swatches";
    const elements = this.#flow!.elements;
    if (elements.length > 1)
      legend.append(
        ...elements.map(({name}, element) => {
          const entry = document.createElement("span"),
            swatch = document.createElement("i");
          swatch.style.background = colorOf(element);
          entry.append(swatch, name);
          return entry;
        }),
      );
    return legend;
  }

  #chart({curves, cpTicks, xTicks, critical}: Layout): SVGElement {
    const {width, height, left, right, bottom} = frame,
      ground = height - bottom;
    const chart = svgElement("svg", {
      viewBox: `0 0 ${width} ${height}`,
      role: "img",
      "aria-label": "Pressure coefficient over x/c",
      class: "chart pressures",
    });
    const level = (y: number, name: string): SVGElement =>
      svgElement("line", {x1: left, x2: width - right, y1: y, y2: y, class: name});
    for (const {y, text} of cpTicks) chart.append(level(y, "grid"), axisText(left - 5, y + 3.5, text, "end"));
    for (const {x, text} of xTicks) chart.append(axisText(x, height - 8, text, "middle"));
    chart.append(axisText(4, 9, "cp", "start"), axisText(width - right, ground - 4, "x/c", "end"));
    if (critical !== undefined)
      chart.append(level(critical, "critical"), axisText(width - right, critical - 4, "cp*", "end"));
    curves.forEach(({name, x, y}, element) => {
      const way = Array.from(x, (at, i) => `${i ? "L" : "M"}${at.toFixed(1)} ${y[i]!.toFixed(1)}`).join("");
      const title = svgElement("title", {}, name);
      chart.append(svgElement("path", {d: way, class: "curve", stroke: colorOf(element)}, title));
    });
    chart.append(this.#dot!);
    chart.addEventListener("pointermove", (event) => {
      const bounds = chart.getBoundingClientRect(),
        unit = width / bounds.width;
      const place = nearestPlace(curves, (event.clientX - bounds.left) * unit, (event.clientY - bounds.top) * unit, 25);
      this.mark(place);
      this.#onHover(place);
    });
    chart.addEventListener("pointerleave", () => {
      this.mark(undefined);
      this.#onHover(undefined);
    });
    return chart;
  }
}
