// Triangles that stand for others, where there is no time to draw all of them.

function smoothStep(from, to, value) {
  const t = Math.max(0, Math.min(1, (value - from) / (to - from)));
  return t * t * (3 - 2 * t);
}

// Triangles of which each stands for a group of neighbours, as vertices of three words each: x and y in pixels from the
// middle of the view, as floats, and the colour. They are few, and programs that draw without a graphics card take
// longer for each vertex of a shader that looks up three points than this takes for a triangle.
export class RoughTriangles {
  constructor() {
    this.length = 0;
    this.reserve(1 << 19);
  }

  reserve(words) {
    if (this.words && words <= this.words.length) return;
    const before = this.words;
    this.words = new Uint32Array(2 * words);
    if (before) this.words.set(before);
    this.floats = new Float32Array(this.words.buffer);
  }

  // Sets what the next triangles have in common: `style` as {width, strength, tone, edge} of edges, and the length that
  // long and thin ones may get.
  begin(style, reach) {
    Object.assign(this, {length: 0, style, reach});
  }

  // Returns a colour with as much of the edges' as a whole picture shows in such triangles on average.
  mixed(red, green, blue, round, area, height) {
    const {width, strength, tone, edge} = this.style;
    const shown = smoothStep(1.5 * width, 7 * width, height), plain = tone * (1 - shown);
    const inside = Math.max(0, 1 - 0.25 * width * round / area), lines = 1 - inside * inside;
    const share = strength * (plain + lines * Math.max(0, shown - plain)), rest = 1 - share;
    return (red * rest + edge[0] * share) | (green * rest + edge[1] * share) << 8 |
           (blue * rest + edge[2] * share) << 16;
  }

  vertex(x, y, color) {
    this.floats[this.length] = x;
    this.floats[this.length + 1] = y;
    this.words[this.length + 2] = color;
    this.length += 3;
  }

  // Adds a box that triangles fill, each of an area.
  addBox(x0, y0, x1, y1, area, red, green, blue) {
    const side = Math.sqrt(area / 0.433), color = this.mixed(red, green, blue, 3 * side, area, 2 * area / side);
    for (const [x, y] of [[x0, y0], [x1, y0], [x1, y1], [x0, y0], [x1, y1], [x0, y1]]) this.vertex(x, y, color);
  }

  // Adds a triangle, (ax, ay), (bx, by), (cx, cy), that stands for `many`, itself included: as large as all of them
  // together, but no longer than the reach where it is long and thin, so that it gets higher instead.
  add(ax, ay, bx, by, cx, cy, many, red, green, blue) {
    const mx = (ax + bx + cx) / 3, my = (ay + by + cy) / 3;
    const ab = Math.hypot(bx - ax, by - ay), bc = Math.hypot(cx - bx, cy - by), ca = Math.hypot(ax - cx, ay - cy);
    const longest = Math.max(ab, bc, ca, 1e-20);
    let ux = (ax - cx) / longest, uy = (ay - cy) / longest;
    if (ab === longest) {
      ux = (bx - ax) / longest;
      uy = (by - ay) / longest;
    } else if (bc === longest) {
      ux = (cx - bx) / longest;
      uy = (cy - by) / longest;
    }
    const area = Math.max(0.5 * Math.abs((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)), 1e-20);
    const height = 2 * area / longest, longer = Math.max(1, Math.min(Math.sqrt(many), this.reach / longest));
    const higher = Math.min(Math.max(many / longer, 1 / height), Math.max(1, this.reach / height));
    const color = this.mixed(red, green, blue, ab + bc + ca, area, height);
    const place = (x, y) => {
      const along = ((x - mx) * ux + (y - my) * uy) * longer, across = ((y - my) * ux - (x - mx) * uy) * higher;
      this.vertex(mx + along * ux - across * uy, my + along * uy + across * ux, color);
    };
    place(ax, ay);
    place(bx, by);
    place(cx, cy);
  }
}
