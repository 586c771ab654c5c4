// Small charts in SVG. Their colours come from page.css.

const frame = {width: 340, height: 112, left: 8, right: 8, top: 8, bottom: 22};

export function svgElement(name, attributes = {}, ...children) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

// Returns a number as people read it: with at most `digits` digits, and powers of ten where they are shorter.
export function numberText(value, digits = 4) {
  if (!Number.isFinite(value)) return String(value);
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) {
    const [mantissa, power] = value.toExponential(digits - 1).split("e");
    return `${Number(mantissa)}e${Number(power)}`;
  }
  return String(Number(value.toPrecision(digits)));
}

export function countText(count) {
  return count.toLocaleString("en-US");
}

function emptyChart(label, height = frame.height) {
  return svgElement("svg", {viewBox: `0 0 ${frame.width} ${height}`, role: "img", "aria-label": label, class: "chart"});
}

function axisText(x, y, text, anchor) {
  return svgElement("text", {x, y, "text-anchor": anchor, class: "axis"}, text);
}

// Returns a chart of the counts of equal parts of [from, to], with `parts` + 1 numbers below. `format` makes the text
// of a value, `color` the CSS colour of a bar from its share of the way.
export function barChart({label, counts, from, to, parts = 4, format = (value) => numberText(value, 3),
                          color = () => null}) {
  const chart = emptyChart(label), most = Math.max(1, ...counts), total = counts.reduce((sum, n) => sum + n, 0);
  const width = (frame.width - frame.left - frame.right) / counts.length;
  const room = frame.height - frame.top - frame.bottom, ground = frame.height - frame.bottom;
  counts.forEach((count, i) => {
    // What is there must be seen.
    const height = count > 0 ? Math.max(1.5, room * count / most) : 0;
    const low = from + (to - from) * i / counts.length, high = from + (to - from) * (i + 1) / counts.length;
    const share = total > 0 ? 100 * count / total : 0;
    const bar = svgElement("rect", {x: frame.left + i * width + 0.5, y: ground - height,
                                    width: Math.max(0.5, width - 1), height, class: "bar"},
                           svgElement("title", {}, `${format(low)} to ${format(high)}: ${countText(count)} ` +
                                                   `(${numberText(share, 3)} %)`));
    const fill = color((i + 0.5) / counts.length);
    if (fill) bar.style.fill = fill;
    chart.append(bar);
  });
  chart.append(svgElement("line", {x1: frame.left, x2: frame.width - frame.right, y1: ground, y2: ground,
                                   class: "ground"}));
  for (let k = 0; k <= parts; ++k) {
    const x = frame.left + (frame.width - frame.left - frame.right) * k / parts;
    chart.append(axisText(x, frame.height - 7, format(from + (to - from) * k / parts),
                          k === 0 ? "start" : k === parts ? "end" : "middle"));
  }
  return chart;
}

// Returns a chart of curves over [0, 1], with powers of ten upwards. A curve has a name, a CSS colour, and x and y per
// point. onPick(curve, point) is called where somebody clicks near a point.
export function curveChart({label, curves, onPick}) {
  const height = 150, left = 40, ground = height - frame.bottom, right = frame.width - frame.right;
  const chart = emptyChart(label, height);
  let low = Infinity, high = -Infinity;
  for (const {y} of curves)
    for (const value of y)
      if (value > 0 && Number.isFinite(value)) {
        low = Math.min(low, Math.log10(value));
        high = Math.max(high, Math.log10(value));
      }
  if (!(low <= high)) [low, high] = [0, 1];
  const middle = 0.5 * (low + high), half = Math.max(0.5, 0.55 * (high - low));
  [low, high] = [middle - half, middle + half];
  const placeX = (share) => left + share * (right - left);
  const placeY = (value) => ground - (Math.log10(value) - low) / (high - low) * (ground - frame.top);
  const step = Math.max(1, Math.ceil((high - low) / 5));
  for (let power = Math.ceil(low); power <= high; power += step) {
    const y = placeY(10 ** power);
    chart.append(svgElement("line", {x1: left, x2: right, y1: y, y2: y, class: "grid"}),
                 axisText(left - 5, y + 3.5, `1e${power}`, "end"));
  }
  for (const {name, color, x, y} of curves) {
    let path = "";
    for (let i = 0; i < x.length; ++i)
      if (y[i] > 0 && Number.isFinite(y[i]))
        path += `${path ? "L" : "M"}${placeX(x[i]).toFixed(1)} ${placeY(y[i]).toFixed(1)}`;
    chart.append(svgElement("path", {d: path, class: "curve", stroke: color}, svgElement("title", {}, name)));
  }
  for (const [share, text, anchor] of [[0, "0", "start"], [0.5, "share of the outline", "middle"], [1, "1", "end"]])
    chart.append(axisText(placeX(share), height - 7, text, anchor));
  chart.addEventListener("click", (event) => {
    const bounds = chart.getBoundingClientRect(), unit = frame.width / bounds.width;
    const px = (event.clientX - bounds.left) * unit, py = (event.clientY - bounds.top) * unit;
    let nearest = 30, found = null;
    for (const curve of curves)
      curve.x.forEach((share, i) => {
        const distance = Math.hypot(placeX(share) - px, placeY(curve.y[i]) - py);
        if (distance < nearest) [nearest, found] = [distance, [curve, i]];
      });
    if (found) onPick(...found);
  });
  return chart;
}
