// The options of the page. Names, help and ranges are the library's; the page adds which of them are always in sight,
// and how far their sliders go.
import type {OptionRow, Options, OptionValue} from "./values.ts";

interface Slider {
  key: string;
  label: string;
  from: number;
  to: number;
  /** Equal steps of the slider are equal ratios. */
  ratios?: boolean;
  step?: number;
}

const mainOptions: Slider[] = [
  {key: "reynolds", label: "Reynolds number", from: 1e4, to: 1e8, ratios: true},
  {key: "alpha", label: "Angle of attack, degrees", from: -10, to: 20, step: 0.5},
  {key: "mach", label: "Mach number", from: 0.1, to: 3, step: 0.01},
  {key: "first_height", label: "First height, chords", from: 1e-7, to: 1e-2, ratios: true},
  {key: "y_plus", label: "y+ of the first layer", from: 0.1, to: 200, ratios: true},
  {key: "growth", label: "Growth of layers", from: 1.05, to: 1.5, step: 0.01},
  {key: "max_ray_angle", label: "Angle between rays, degrees", from: 1, to: 20, step: 0.5},
  {key: "gradation", label: "Growth of triangles", from: 0.02, to: 0.5, step: 0.01},
  {key: "far_field", label: "Far field, chords", from: 2, to: 500, ratios: true},
  {key: "order", label: "Order of the cells", from: 1, to: 4, step: 1},
];
const mainChoices = [
  {key: "layer_topology", label: "Cells of the layer"},
  {key: "preset", label: "Preset"},
];
/** Options that mean nothing here: there is no file beside those dropped. */
const leftOut = new Set(["background"]);
const sliderSteps = 1000;

function numberText(value: number): string {
  return String(Number(value.toPrecision(3)));
}

function defaultText(row: OptionRow): string {
  if (row.default === null) return "";
  return Array.isArray(row.default) ? row.default.join(" ") : String(row.default);
}

/** Returns a button that opens a text, and the text. */
export function helpOf(name: string, text: string): [HTMLButtonElement, HTMLElement] {
  const button = Object.assign(document.createElement("button"), {type: "button", className: "help", textContent: "?"});
  const help = Object.assign(document.createElement("p"), {className: "hint", hidden: true, textContent: text});
  button.setAttribute("aria-label", `help: ${name}`);
  button.setAttribute("aria-expanded", "false");
  button.addEventListener("click", () => {
    help.hidden = !help.hidden;
    button.setAttribute("aria-expanded", String(!help.hidden));
  });
  return [button, help];
}

/** Returns what a text means for an option of this kind; undefined for an empty text. */
function valueOfText(row: OptionRow, text: string): OptionValue | undefined {
  const trimmed = text.trim();
  if (trimmed === "") return undefined;
  if (row.kind === "flag") return trimmed === "true";
  if (row.kind === "words" || row.kind === "repeated") return trimmed.split(/\s+/);
  const number = Number(trimmed);
  return Number.isNaN(number) || row.kind === "word" ? trimmed : number;
}

/** The options that people have set. */
export class OptionForm {
  #rows = new Map<string, OptionRow>();
  #texts = new Map<string, string>();
  /** The fields of an option: it may stand in both parts of the form. */
  #fields = new Map<string, ((text: string) => void)[]>();
  #boxes = new Map<string, HTMLElement[]>();
  #onChange: () => void;

  constructor(rows: OptionRow[], main: HTMLElement, all: HTMLElement, onChange: () => void) {
    this.#onChange = onChange;
    for (const row of rows) if (!leftOut.has(row.key)) this.#rows.set(row.key, row);
    for (const slider of mainOptions) main.append(this.#numberField(this.#rows.get(slider.key)!, slider.label, slider));
    for (const {key, label} of mainChoices) main.append(this.#choiceField(this.#rows.get(key)!, label));
    let group = "";
    for (const row of this.#rows.values()) {
      if (row.group !== group) {
        group = row.group;
        all.append(Object.assign(document.createElement("h3"), {textContent: group}));
      }
      const isChoice = row.kind === "flag" || (row.kind === "word" && row.metavar.includes("|"));
      all.append(isChoice ? this.#choiceField(row, row.key) : this.#numberField(row, row.key));
    }
  }

  /** Returns the options that are set. */
  values(): Options {
    const values: Options = {};
    for (const [key, text] of this.#texts) {
      const value = valueOfText(this.#rows.get(key)!, text);
      if (value !== undefined) values[key] = value;
    }
    return values;
  }

  /** Returns the texts of the options that are set. */
  texts(): Map<string, string> {
    return new Map(this.#texts);
  }

  /** Sets these options, and no others. Returns the keys that are not options of the page. */
  replace(texts: Map<string, string>): string[] {
    for (const key of [...this.#texts.keys()]) if (!texts.has(key)) this.#put(key, "");
    for (const [key, text] of texts) if (this.#rows.has(key)) this.#put(key, text);
    return [...texts.keys()].filter((key) => !this.#rows.has(key));
  }

  /** Sets an option as if a person had typed the text. Options that it excludes are no longer set. */
  set(key: string, text: string): void {
    this.#put(key, text);
    if (text.trim() !== "")
      for (const row of this.#rows.values())
        if (row.excludes.includes(key) || this.#rows.get(key)!.excludes.includes(row.key)) this.#put(row.key, "");
    this.#onChange();
  }

  #put(key: string, text: string): void {
    if (text.trim() === "") this.#texts.delete(key);
    else this.#texts.set(key, text);
    for (const show of this.#fields.get(key) ?? []) show(text);
  }

  /** Marks the option that an error is about, or none. */
  markWrong(wrong: string | undefined): void {
    for (const [key, boxes] of this.#boxes) for (const box of boxes) box.classList.toggle("wrong", key === wrong);
  }

  /** Returns the program's arguments for the options that are set. */
  commandLine(): string[] {
    const words: string[] = [];
    for (const [key, text] of this.#texts) {
      const row = this.#rows.get(key)!,
        name = `--${key.replaceAll("_", "-")}`;
      if (row.kind === "flag") {
        if (text === "true") words.push(name);
      } else if (row.kind === "repeated") {
        for (const word of text.trim().split(/\s+/)) words.push(name, word);
      } else
        words.push(
          name,
          text
            .trim()
            .split(/\s+/)
            .join(row.kind === "words" ? "," : " "),
        );
    }
    return words;
  }

  #box(row: OptionRow, label: string): {box: HTMLElement; body: HTMLLabelElement} {
    const box = document.createElement("div"),
      body = document.createElement("label");
    box.className = "option";
    box.dataset.key = row.key;
    box.title = row.help + (row.range ? ` (${row.range})` : "");
    body.append(label);
    box.append(body, ...helpOf(label, box.title));
    this.#boxes.set(row.key, [...(this.#boxes.get(row.key) ?? []), box]);
    return {box, body};
  }

  #register(key: string, show: (text: string) => void): void {
    this.#fields.set(key, [...(this.#fields.get(key) ?? []), show]);
  }

  #numberField(row: OptionRow, label: string, slider?: Slider): HTMLElement {
    const {box, body} = this.#box(row, label);
    const text = Object.assign(document.createElement("input"), {
      className: "text",
      placeholder: defaultText(row) || "none",
      spellcheck: false,
      autocomplete: "off",
    });
    text.addEventListener("change", () => this.set(row.key, text.value));
    body.append(text);
    this.#register(row.key, (value) => (text.value = value));
    if (slider) body.append(this.#slider(row, slider));
    return box;
  }

  #slider(row: OptionRow, {from, to, ratios, step}: Slider): HTMLInputElement {
    const range = Object.assign(document.createElement("input"), {type: "range", min: "0", max: String(sliderSteps)});
    range.setAttribute("aria-label", row.key);
    const [low, high] = ratios ? [Math.log(from), Math.log(to)] : [from, to];
    const valueAt = (position: number): number => {
      const value = low + (position / sliderSteps) * (high - low);
      return ratios ? Math.exp(value) : Math.round(value / step!) * step!;
    };
    const show = (text: string): void => {
      const value = Number(text.trim() || defaultText(row) || NaN);
      const at = ((ratios ? Math.log(value) : value) - low) / (high - low);
      range.value = String(Number.isFinite(at) ? Math.round(sliderSteps * at) : sliderSteps / 2);
      range.classList.toggle("unset", text.trim() === "");
    };
    range.addEventListener("input", () => this.set(row.key, numberText(valueAt(Number(range.value)))));
    this.#register(row.key, show);
    show("");
    return range;
  }

  #choiceField(row: OptionRow, label: string): HTMLElement {
    const {box, body} = this.#box(row, label);
    const select = Object.assign(document.createElement("select"), {className: "text"});
    const words = row.kind === "flag" ? ["false", "true"] : row.metavar.split("|");
    for (const word of words) select.append(new Option(word, word));
    const preset = defaultText(row);
    select.value = preset;
    select.addEventListener("change", () => this.set(row.key, select.value === preset ? "" : select.value));
    body.append(select);
    this.#register(row.key, (text) => (select.value = text === "" ? preset : text));
    return box;
  }
}
