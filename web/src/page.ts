// The page: a form on the left, the picture in the middle, what came out on the right. Each change makes a new mesh.
import {Mesher, Stopped} from "./client.ts";
import {caseOfText, CaseHistory, examples, firstNaca, longestLink, textOfCase, type Case} from "./case.ts";
import {LaminaError} from "./error.ts";
import {helpOf, OptionForm} from "./form.ts";
import type {Facts, InputFile} from "./values.ts";
import type {MadeMesh, Offer} from "./messages.ts";
import {Picture, placesOf, type Coloring} from "./picture.ts";
import {nearestPlace, PressureChart} from "./pressures.ts";
import {countText, numberText} from "report-page/charts.js";

function byId<Kind extends HTMLElement = HTMLElement>(id: string): Kind {
  return document.getElementById(id) as Kind;
}

const mesher = new Mesher();
const picture = new Picture(
  byId<HTMLCanvasElement>("view"),
  byId("bar"),
  (text) => {
    byId("picked").hidden = text === "";
    byId("picked").textContent = text;
  },
  (x, y, reach) => chart.mark(nearestPlace(walls, x, y, reach)),
  () => chart.mark(undefined),
);
/** x and y of the points whose pressures the chart shows. */
let walls: {x: Float64Array; y: Float64Array}[] = [];
const chart = new PressureChart(byId("pressures"), (place) => {
  if (!place) return picture.mark(undefined);
  const {x, y} = walls[place.element]!;
  picture.mark([x[place.point]!, y[place.point]!]);
});
const naca = byId<HTMLInputElement>("naca"),
  state = byId("state");
const pauseBeforeMeshing = 120; // milliseconds; a slider that moves changes options many times a second

let form: OptionForm;
let files: Case["files"] = [];
/** What a link asked for that cannot be had; empty after the next change. */
let wrongLink = "";
/** The inputs of the mesh in the picture: where others come, the picture shows all of them. */
let shownInputs = "";
let busy = false,
  again = false,
  timer = 0,
  timerOfCase = 0;
const pauseBeforeKeeping = 400; // milliseconds; browsers refuse to change addresses more often
let cases = new CaseHistory("");

function inputs(): (string | InputFile)[] {
  return files.length > 0 ? files : [`naca:${naca.value.trim()}`];
}

function inputNames(): string[] {
  return inputs().map((input) => (typeof input === "string" ? input : input.name));
}

function make<Name extends keyof HTMLElementTagNameMap>(
  name: Name,
  text: string,
  click?: () => void,
): HTMLElementTagNameMap[Name] {
  const element = document.createElement(name);
  element.textContent = text;
  if (click) element.addEventListener("click", click);
  return element;
}

// --- The case, which the address of the page holds

function caseText(): string {
  const options = form.texts();
  options.delete("threads"); // no matter of the mesh
  return textOfCase({naca: naca.value.trim(), files, options});
}

/** Keeps the case to come back to, and puts it into the address. */
function keepCase(): void {
  const text = caseText(),
    fits = text.length <= longestLink;
  clearTimeout(timerOfCase);
  cases.add(text);
  history.replaceState(null, "", text && fits ? `#${text}` : location.pathname + location.search);
  byId<HTMLButtonElement>("undo").disabled = !cases.canUndo;
  byId<HTMLButtonElement>("copy").disabled = !fits || !navigator.clipboard;
}

/** Takes over the case that a text holds, and those of its parts that the page knows. */
function showCase(text: string): void {
  let wanted: Case = {naca: firstNaca, files: [], options: new Map()};
  wrongLink = "";
  try {
    wanted = caseOfText(text);
  } catch (error) {
    wrongLink = (error as Error).message;
  }
  naca.value = wanted.naca;
  files = wanted.files;
  const unknown = form.replace(wanted.options);
  if (unknown.length > 0) wrongLink = `the link sets what is no option of this page: ${unknown.join(", ")}`;
  listFiles();
}

async function showExample(label: string): Promise<void> {
  const {files: names, text} = examples.find((example) => example.label === label)!;
  try {
    const read = names.map(async (name) => {
      const reply = await fetch(`examples/${name}`);
      if (!reply.ok) throw new Error(`examples/${name} cannot be had from the server`);
      return {name, text: new Uint8Array(await reply.arrayBuffer())};
    });
    showCase(textOfCase({...caseOfText(text), files: await Promise.all(read)}));
    changed();
  } catch (error) {
    showError(error as Error);
  }
}

function takeCases(): void {
  const chooser = byId<HTMLSelectElement>("examples"),
    copy = byId<HTMLButtonElement>("copy");
  chooser.append(...examples.map(({label}) => new Option(label, label)));
  chooser.addEventListener("change", () => {
    const {value} = chooser;
    chooser.value = "";
    if (value) void showExample(value);
  });
  const undo = (): void => {
    keepCase();
    showCase(cases.undo());
    changed();
  };
  byId("undo").addEventListener("click", undo);
  document.addEventListener("keydown", (event) => {
    const inText = event.target instanceof HTMLInputElement && event.target.type !== "range";
    if (event.key !== "z" || !(event.ctrlKey || event.metaKey) || event.shiftKey || inText) return;
    event.preventDefault();
    undo();
  });
  byId("reset").addEventListener("click", () => {
    showCase("");
    changed();
  });
  copy.addEventListener("click", async () => {
    keepCase();
    await navigator.clipboard.writeText(location.href);
    copy.textContent = "Copied";
    setTimeout(() => (copy.textContent = "Copy link"), 1500);
  });
  window.addEventListener("hashchange", () => {
    if (location.hash.slice(1) !== caseText()) showCase(location.hash.slice(1));
    changed();
  });
}

// --- Making a mesh

function changed(): void {
  clearTimeout(timer);
  timer = window.setTimeout(update, pauseBeforeMeshing);
  clearTimeout(timerOfCase);
  timerOfCase = window.setTimeout(keepCase, pauseBeforeKeeping);
}

async function update(): Promise<void> {
  again = busy;
  if (busy) return;
  const wrong = wrongLink;
  wrongLink = "";
  if (wrong) return showError(new Error(wrong));
  busy = true;
  const late = window.setTimeout(() => showState("Meshing ...", true), 250);
  try {
    const names = inputNames().join(" ");
    const made = await mesher.mesh({inputs: inputs(), options: form.values()}, (stage) => {
      if (state.dataset.busy) showState(`Meshing: ${stage} ...`, true);
    });
    showMesh(made, names);
    showError(undefined);
  } catch (error) {
    showError(error as Error);
  } finally {
    clearTimeout(late);
    showState("");
    busy = false;
  }
  if (again) void update();
}

function showState(text: string, canStop = false): void {
  if (canStop) state.dataset.busy = "yes";
  else delete state.dataset.busy;
  state.replaceChildren(...(text ? [text] : []), ...(canStop ? [make("button", "Stop", () => mesher.stop())] : []));
}

function showError(error: Error | undefined): void {
  const shown = error && !(error instanceof Stopped) ? error.message : "";
  byId("error").hidden = shown === "";
  byId("error").textContent = shown;
  form.markWrong(error instanceof LaminaError ? error.option : undefined);
  document.body.dataset.state = shown ? "failed" : "done";
}

// --- What came out

function showPressures({flow, chord}: Facts): void {
  walls = (flow?.elements ?? []).map(({points}) => ({
    x: points.filter((_, i) => i % 2 === 0),
    y: points.filter((_, i) => i % 2 === 1),
  }));
  chart.setFlow(flow, chord);
}

function showMesh(made: MadeMesh, names: string): void {
  const {arrays, facts, warnings, seconds} = made,
    places = placesOf(arrays, facts);
  picture.setMesh(arrays, (places[1] ?? places[0]!).box, names === shownInputs);
  shownInputs = names;
  showPressures(facts);
  byId("places").replaceChildren(...places.map(({name, box}) => make("button", name, () => picture.show(box))));
  const triangles = arrays.triangles.length / 3,
    quads = arrays.quads.length / 4;
  byId("headline").textContent = `${countText(triangles + quads)} cells in ${seconds.toFixed(2)} s`;
  const rows: [string, string][] = [
    ["vertices", countText(arrays.points.length / 2)],
    ["triangles", countText(triangles)],
    ...(quads > 0 ? [["quadrilaterals", countText(quads)] as [string, string]] : []),
    ...facts.elements.map(
      ({name, wall_vertices, first_height}) =>
        [
          name,
          `${countText(wall_vertices)} on the wall` +
            (first_height === null ? "" : `, first height ${numberText(first_height, 3)}`),
        ] as [string, string],
    ),
    [
      "angles beyond layers",
      `${facts.isotropic.min_angle.toFixed(1)} to ${facts.isotropic.max_angle.toFixed(1)} degrees`,
    ],
    ["mean ratio there", facts.isotropic.mean_ratio.toFixed(3)],
    ...(facts.curved
      ? [
          [
            `cells of order ${facts.curved.order}`,
            `scaled Jacobian from ${numberText(facts.curved.min_scaled_jacobian, 3)}`,
          ] as [string, string],
        ]
      : []),
    ["made and checked", `in ${facts.seconds.toFixed(2)} s`],
  ];
  byId("facts").replaceChildren(
    ...rows.map(([name, value]) => {
      const row = document.createElement("tr");
      row.append(make("th", name), make("td", value));
      return row;
    }),
  );
  const near = 0.02 * facts.chord;
  byId("warnings").replaceChildren(
    ...warnings.map(({message, at}) => {
      const box = make("div", "");
      box.className = "warning";
      box.append(make("b", "Warning"), message);
      if (at)
        box.append(
          document.createElement("br"),
          make("button", "show", () => picture.show([at[0] - near, at[1] - near, at[0] + near, at[1] + near])),
        );
      return box;
    }),
  );
  const file = facts.curved ? "mesh.msh" : "mesh.su2";
  byId("command").textContent = ["lamina", "mesh", ...inputNames(), ...form.commandLine(), "-o", file]
    .map(quoted)
    .join(" ");
}

/** Returns a word as a shell takes it. */
function quoted(word: string): string {
  return /^[\w.:,=/+-]+$/.test(word) ? word : `'${word.replaceAll("'", `'\\''`)}'`;
}

async function download(name: string, format: string): Promise<void> {
  try {
    const file = await mesher.write(name, format);
    const link = make("a", "");
    link.href = URL.createObjectURL(new Blob([file.bytes]));
    link.download = file.name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
  } catch (error) {
    showError(error as Error);
  }
}

function offerDownloads({formats}: Offer): void {
  const common: [string, string, string][] = [
    ["SU2", "mesh.su2", "su2"],
    ["Gmsh MSH", "mesh.msh", "msh41"],
    ["VTU", "mesh.vtu", "vtu"],
    ["OpenFOAM", "polyMesh", "openfoam"],
  ];
  const other = document.createElement("select"),
    row = make("div", "");
  row.className = "other";
  for (const {name, extensions, description} of formats) {
    const option = new Option(description, name);
    const extension = extensions[0]!;
    option.dataset.file = extension.startsWith(".") ? `mesh${extension}` : extension;
    other.append(option);
  }
  row.append(
    other,
    make("button", "Save", () => void download(other.selectedOptions[0]!.dataset.file!, other.value)),
  );
  byId("downloads").append(
    ...common.map(([label, name, format]) => make("button", label, () => void download(name, format))),
    row,
  );
}

// --- Input

async function addFiles(given: Iterable<File>): Promise<void> {
  const read = await Promise.all(
    [...given].map(async (file) => ({name: file.name, text: new Uint8Array(await file.arrayBuffer())})),
  );
  const names = new Set(read.map(({name}) => name));
  files = [...files.filter(({name}) => !names.has(name)), ...read];
  listFiles();
  changed();
}

function listFiles(): void {
  byId("list").replaceChildren(
    ...files.map((file) => {
      const entry = make("li", file.name),
        remove = make("button", "×", () => {
          files = files.filter((other) => other !== file);
          listFiles();
          changed();
        });
      remove.setAttribute("aria-label", `remove ${file.name}`);
      entry.append(remove);
      return entry;
    }),
  );
  naca.disabled = files.length > 0;
}

function takeInput(): void {
  const chooser = byId<HTMLInputElement>("files");
  byId("naca-option").append(...helpOf("NACA", naca.title));
  byId("pressures-title").append(
    ...helpOf(
      "Pressures",
      "The pressure coefficient on the walls of the flow before the mesh, over x in chords from the foremost point. It is " +
        "potential flow with boundary layers, with pressures after Karman and Tsien where a Mach number is given; where " +
        "flow is faster than sound, beyond cp*, the Euler equations are solved. Point at a curve or at a wall of the mesh.",
    ),
  );
  naca.addEventListener("change", changed);
  byId("choose").addEventListener("click", () => chooser.click());
  chooser.addEventListener("change", () => {
    void addFiles(chooser.files ?? []);
    chooser.value = "";
  });
  for (const name of ["dragover", "dragleave", "drop"] as const)
    document.addEventListener(name, (event) => {
      event.preventDefault();
      document.body.classList.toggle("dropping", name === "dragover");
      if (name === "drop") void addFiles(event.dataTransfer?.files ?? []);
    });
  const color = byId<HTMLSelectElement>("color");
  color.addEventListener("change", () => picture.setColoring(color.value as Coloring));
}

async function begin(): Promise<void> {
  try {
    const offer = await mesher.begin();
    document.body.dataset.threads = String(offer.threads);
    const rows = offer.rows.filter(({key}) => key !== "threads" || offer.threads > 1);
    form = new OptionForm(rows, byId("main-options"), byId("all-options"), changed);
    offerDownloads(offer);
    takeInput();
    takeCases();
    showCase(location.hash.slice(1));
    cases = new CaseHistory(caseText());
    document.querySelector(".heading p")!.textContent += ` Version ${offer.version}.`;
    await update();
  } catch (error) {
    showState(`The mesher could not be loaded: ${(error as Error).message}`);
  }
}

// For tests, and for those who like the console.
Object.assign(window, {lamina: {picture}});
void begin();
