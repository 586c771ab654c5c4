// Colours and scales of colours, as src/plot/color.cpp has them.

const viridisEntries = [[0.267, 0.005, 0.329], [0.279, 0.175, 0.483], [0.230, 0.322, 0.546], [0.173, 0.449, 0.558],
                        [0.128, 0.567, 0.551], [0.158, 0.684, 0.502], [0.369, 0.789, 0.383], [0.678, 0.864, 0.190],
                        [0.993, 0.906, 0.144]];

// Returns red, green and blue, from 0 to 255, for t from 0 to 1.
export function viridis(t) {
  const last = viridisEntries.length - 1, at = Math.min(1, Math.max(0, t)) * last;
  const i = Math.min(Math.floor(at), last - 1);
  return viridisEntries[i].map((low, k) => Math.round(255 * (low + (at - i) * (viridisEntries[i + 1][k] - low))));
}

// Returns a soft colour that differs clearly from those of neighbouring numbers.
export function distinctColor(number) {
  const hue = number * 0.6180339887498949 % 1;
  return [0, 2 / 3, 1 / 3].map((shift) => {
    const distance = Math.abs((hue + shift) % 1 * 6 - 3) - 1;
    return Math.round(255 * (1 - 0.34 * (1 - Math.min(1, Math.max(0, distance)))));
  });
}

export function cssColor(rgb) {
  return `rgb(${rgb[0]} ${rgb[1]} ${rgb[2]})`;
}
