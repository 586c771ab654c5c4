// What explains the colours of a picture.
import {cssColor, viridis} from "report-page/colors.js";

export type Legend =
  {kind: "empty"} | {kind: "words"; words: [string, readonly number[]][]} | {kind: "ramp"; from: string; to: string};

function element(name: string, className: string, ...children: (Node | string)[]): HTMLElement {
  const made = document.createElement(name);
  made.className = className;
  made.append(...children);
  return made;
}

/** Returns the elements of a legend. */
export function colorLegend(legend: Legend): HTMLElement[] {
  if (legend.kind === "empty") return [];
  if (legend.kind === "words") {
    return [
      element(
        "div",
        "swatches",
        ...legend.words.map(([word, color]) => {
          const swatch = element("i", "");
          swatch.style.background = cssColor(color as [number, number, number]);
          return element("span", "", swatch, word);
        }),
      ),
    ];
  }
  const ramp = element("div", "ramp"),
    stops = Array.from({length: 9}, (_, i) => cssColor(viridis(i / 8)));
  ramp.style.background = `linear-gradient(90deg, ${stops.join(", ")})`;
  return [ramp, element("div", "ticks", element("span", "", legend.from), element("span", "", legend.to))];
}
