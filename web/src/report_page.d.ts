// The parts of the report's page (share/page) that this page uses, too.

declare module "report-page/view.js" {
  export interface ShownMesh {
    points: Float64Array;
    triangles: Uint32Array;
    quads: Uint32Array;
    markers: {name: string; kind: string; edges: Uint32Array}[];
    walls: {vertices: Uint32Array; firstHeights: Float32Array}[];
  }
  export interface Theme {
    background: string;
    edge: string;
    wall: string;
    farField: string;
    selection: string;
    strength: number;
    tone: number;
  }
  export interface View {
    setColors(fills: Uint8Array): void;
    setTheme(theme: Partial<Theme>): void;
    show(box: [number, number, number, number], options?: {animate?: boolean}): void;
    view(): {x: number; y: number; scale: number; width: number; height: number};
    frameTime(): number;
    snapshot(): HTMLCanvasElement;
    select(what: {cell: number; vertex: number}): void;
    destroy(): void;
  }
  export function createView(
    canvas: HTMLCanvasElement,
    mesh: ShownMesh,
    options?: {onMove?(view: ReturnType<View["view"]>): void; onPick?(picked: {cell: number; vertex: number}): void},
  ): View;
}

declare module "report-page/measures.js" {
  export interface Shape {
    area: number;
    minAngle: number;
    maxAngle: number;
    aspect: number;
    ratio: number;
  }
  export function shapeOf(mesh: object, cell: number): Shape;
  export function measureCells(
    mesh: object,
  ): Record<"minAngle" | "maxAngle" | "aspect" | "ratio" | "size", Float32Array>;
}

declare module "report-page/colors.js" {
  export function viridis(t: number): [number, number, number];
  export function distinctColor(number: number): [number, number, number];
  export function cssColor(rgb: [number, number, number]): string;
}

declare module "report-page/charts.js" {
  export function numberText(value: number, digits?: number): string;
  export function countText(count: number): string;
  export function svgElement(
    name: string,
    attributes?: Record<string, string | number>,
    ...children: (Node | string)[]
  ): SVGElement;
}

declare module "report-page/places.js" {
  export interface NamedPlace {
    name: string;
    window: [number, number, number, number];
  }
  export function placesOfKind(places: NamedPlace[], kind: string): NamedPlace[];
  export function placeTexts(places: NamedPlace[]): string[];
}
