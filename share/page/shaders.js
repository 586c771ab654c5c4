// The programs that draw a view with WebGL 2, and the memory of the graphics card that they read.
//
// Single precision would let the picture jitter from some 1e-5 of the coordinates on. So a coordinate is kept as two
// floats whose sum has 48 bits, and so is the middle of the view; the shader subtracts high from high and low from low
// parts, which is exact where the view is small.
const textureWidth = 2048, textureShift = 11;

export const cellShader = `#version 300 es
precision highp float;
precision highp int;
precision highp usampler2D;
precision highp sampler2D;
uniform usampler2D corners;
uniform sampler2D points;
uniform sampler2D fills;
uniform vec4 middle;   // of the view: high parts, low parts
uniform vec2 scale;    // to the view's coordinates from -1 to 1
uniform float pixels;  // per unit of length
flat out vec3 fill;
flat out float height;  // the smallest of the triangle, in pixels
flat out vec3 edges[3]; // (n, c): a pixel at p from the middle is at |n.p + c| from an edge
ivec2 texel(int i) { return ivec2(i & ${textureWidth - 1}, i >> ${textureShift}); }
vec2 between(vec4 a, vec4 b) { return (b.xy - a.xy) + (b.zw - a.zw); }
void main() {
  int triangle = gl_VertexID / 3, corner = gl_VertexID - 3 * triangle;
  uvec4 c = texelFetch(corners, texel(triangle), 0);
  vec4 p[3];
  vec2 at[3];
  for (int k = 0; k < 3; ++k) {
    p[k] = texelFetch(points, texel(int(c[k])), 0);
    at[k] = between(middle, p[k]) * pixels;
  }
  float longest = 1e-20;
  vec2 along[3];
  for (int k = 0; k < 3; ++k) {
    int from = (k + 1) % 3, to = (k + 2) % 3;
    along[k] = between(p[from], p[to]) * pixels;
    float size = length(along[k]);
    longest = max(longest, size);
    edges[k] = vec3(0.0, 0.0, 1e6);
    if (size == 0.0 || (c.w >> k & 1u) == 1u) continue;
    vec2 normal = vec2(-along[k].y, along[k].x) / size;
    vec2 near = dot(at[from], at[from]) < dot(at[to], at[to]) ? at[from] : at[to];
    edges[k] = vec3(normal, -dot(normal, near));
  }
  height = abs(along[0].x * along[1].y - along[0].y * along[1].x) / longest;
  fill = texelFetch(fills, texel(triangle), 0).rgb;
  gl_Position = vec4(between(middle, p[corner]) * scale, 0.0, 1.0);
}`;

export const cellPainter = `#version 300 es
precision highp float;
flat in vec3 fill;
flat in float height;
flat in vec3 edges[3];
uniform vec4 edge;    // colour and strength of edges
uniform vec2 extent;  // of the picture, in pixels
uniform float width;  // of edges, in pixels
uniform float tone;   // how much of the edges' colour small triangles get
out vec4 color;
void main() {
  vec3 here = vec3(gl_FragCoord.xy - 0.5 * extent, 1.0);
  float nearest = min(abs(dot(edges[0], here)), min(abs(dot(edges[1], here)), abs(dot(edges[2], here))));
  float line = 1.0 - smoothstep(0.5 * width - 0.5, 0.5 * width + 0.5, nearest);
  float shown = smoothstep(1.5 * width, 7.0 * width, height);
  color = vec4(mix(fill, edge.rgb, edge.a * max(line * shown, tone * (1.0 - shown))), 1.0);
}`;

export const roughShader = `#version 300 es
precision highp float;
in vec2 place;         // in pixels from the middle
in vec4 paint;
uniform vec2 extent;
flat out vec3 fill;
void main() {
  fill = paint.rgb;
  gl_Position = vec4(2.0 * place / extent, 0.0, 1.0);
}`;

export const roughPainter = `#version 300 es
precision highp float;
flat in vec3 fill;
out vec4 color;
void main() { color = vec4(fill, 1.0); }`;

export const pointShader = `#version 300 es
precision highp float;
in vec2 place;
in vec3 paint;
uniform float size;
out vec3 fill;
void main() {
  fill = paint;
  gl_PointSize = size;
  gl_Position = vec4(place, 0.0, 1.0);
}`;

export const pointPainter = `#version 300 es
precision highp float;
in vec3 fill;
out vec4 color;
void main() { color = vec4(fill, 1.0); }`;

export const copyShader = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`;

export const copyPainter = `#version 300 es
precision highp float;
uniform sampler2D image;
uniform vec4 place;    // of the image on the canvas: left and lower end, width and height
out vec4 color;
void main() { color = texture(image, (gl_FragCoord.xy - place.xy) / place.zw); }`;

export function makeProgram(gl, vertexSource, fragmentSource) {
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertexSource], [gl.FRAGMENT_SHADER, fragmentSource]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error(gl.getProgramInfoLog(program) || "a shader does not compile");
  const uniforms = {};
  for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
    const {name} = gl.getActiveUniform(program, i);
    uniforms[name] = gl.getUniformLocation(program, name);
  }
  return {program, uniforms};
}

// Makes a texture of one texel per entry, and binds it to a unit; `values` has four numbers per entry.
export function makeTexture(gl, unit, internalFormat, format, type, values) {
  const rows = Math.max(1, Math.ceil(values.length / 4 / textureWidth));
  const texels = new values.constructor(4 * textureWidth * rows);
  texels.set(values);
  gl.activeTexture(gl.TEXTURE0 + unit);
  gl.deleteTexture(gl.getParameter(gl.TEXTURE_BINDING_2D));
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texImage2D(gl.TEXTURE_2D, 0, internalFormat, textureWidth, rows, 0, format, type, texels);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
}

// Returns the high and low parts of both coordinates of all points: four floats per point.
export function splitPoints(points) {
  const parts = new Float32Array(2 * points.length);
  for (let i = 0; i < points.length; i += 2) {
    parts[2 * i] = points[i];
    parts[2 * i + 1] = points[i + 1];
    parts[2 * i + 2] = points[i] - parts[2 * i];
    parts[2 * i + 3] = points[i + 1] - parts[2 * i + 1];
  }
  return parts;
}
