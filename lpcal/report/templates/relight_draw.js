// Drawing: one WebGL2 program for the picture and the turning mesh; the same formula, pixel by pixel, on a plain canvas where WebGL2 is missing.
const MOST_LIGHTS = 24;
const PALETTES = {
  depth: ["#f4e7b0", "#8fc487", "#3b918f", "#2b5685", "#1d2250"],
  sigma: ["#17324d", "#2e7d86", "#9bc26c", "#f0bf4a", "#cf4f2e"],
};
const MODES = ["lit", "shading", "albedo", "normals", "depth", "sigma"];
const SIGMA_STOP = 10;
const rgb = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16) / 255);

const VERTEX = `#version 300 es
layout(location = 0) in vec2 uvIn; layout(location = 1) in vec2 rayIn; layout(location = 2) in float depthIn;
uniform vec4 frame; uniform bool turning, perspective; uniform mat3 turn; uniform vec3 centre; uniform vec4 lens;
out vec2 uv; out vec2 ray;
void main() {
  uv = uvIn; ray = rayIn;
  vec3 p = perspective ? vec3(rayIn, 1.0) * depthIn : vec3(rayIn, depthIn);
  vec3 q = turn * (p - centre);
  float away = q.z + lens.z;
  gl_Position = turning ? vec4(lens.x * q.x, -lens.y * q.y, (q.z / lens.w) * away, away) : vec4(frame.xy * uvIn + frame.zw, 0.0, 1.0);
}`;

const FRAGMENT = `#version 300 es
precision highp float;
in vec2 uv; in vec2 ray; out vec4 painted;
uniform sampler2D geometry, paint, doubt, lobes;
uniform bool turning, perspective, shadows; uniform int mode, count; uniform vec4 eye; uniform vec3 scale;
uniform vec4 source[${MOST_LIGHTS}]; uniform vec4 axis[${MOST_LIGHTS}]; uniform vec3 power[${MOST_LIGHTS}];
uniform float exposure, gloss, lobeStop, pixel, reach, contour; uniform vec2 place[5]; uniform vec3 palette[5];

float depthOf(vec2 where) { return scale.x + scale.y * texture(geometry, where).w; }
vec2 placeOf(vec3 p) {
  vec2 r = perspective ? p.xy / p.z : p.xy;
  return place[0] + place[1] * r.x + place[2] * r.y + (place[3] * r.x + place[4] * r.y) * dot(r, r);
}
float lobeAt(float angle, float row) {
  float at = angle / lobeStop * float(textureSize(lobes, 0).x - 1);
  if (at >= float(textureSize(lobes, 0).x - 1)) return 0.0;
  int k = int(at);
  return mix(texelFetch(lobes, ivec2(k, int(row)), 0).r, texelFetch(lobes, ivec2(k + 1, int(row)), 0).r, fract(at));
}
float lit(vec3 p, vec3 n, vec3 d, float far) {
  if (!shadows || mode > 1) return 1.0;
  float open = 1.0, noise = fract(52.9829 * fract(dot(gl_FragCoord.xy, vec2(0.06711, 0.00584))));
  float stop = min(far, reach);
  vec3 start = p + n * 2.5 * pixel;
  for (int k = 0; k < 44; k++) {
    float t = (float(k) + noise) / 44.0; t = t * t * stop + 2.0 * pixel;
    vec3 q = start + d * t; vec2 where = placeOf(q);
    if (any(lessThan(where, vec2(0.0))) || any(greaterThan(where, vec2(1.0)))) break;
    if (texture(paint, where).a < 0.9) continue;
    float inside = q.z - depthOf(where);
    if (inside < 0.55 * reach) open = min(open, 1.0 - smoothstep(1.5 * pixel, 3.0 * pixel + 0.07 * t, inside));
  }
  return open;
}
vec3 ramp(float t) { float at = clamp(t, 0.0, 1.0) * 3.999; int k = int(at); return mix(palette[k], palette[k + 1], fract(at)); }
float ggx(vec3 n, vec3 d, vec3 v, float alpha) {
  vec3 h = normalize(d + v); float nh = max(dot(n, h), 0.0), nl = max(dot(n, d), 1e-3), nv = max(dot(n, v), 1e-3), a2 = alpha * alpha;
  float b = nh * nh * (a2 - 1.0) + 1.0, D = a2 / (b * b);
  float G = 2.0 / (nl * sqrt(a2 + (1.0 - a2) * nv * nv) + nv * sqrt(a2 + (1.0 - a2) * nl * nl));
  return D * G * (0.04 + 0.96 * pow(1.0 - max(dot(d, h), 0.0), 5.0)) / 4.0;
}
void main() {
  vec4 colour = texture(paint, uv);
  float alpha = turning ? 1.0 : smoothstep(0.25, 0.75, colour.a);
  if (alpha <= 0.0) discard;
  vec3 n = normalize(texture(geometry, uv).xyz);
  float depth = depthOf(uv);
  vec3 p = perspective ? vec3(ray, 1.0) * depth : vec3(ray, depth);
  vec3 v = normalize(eye.w > 0.0 ? eye.xyz - p : eye.xyz);
  vec3 shown;
  if (mode == 2) shown = pow(0.85 * colour.rgb, vec3(1.0 / 2.2));
  else if (mode == 3) shown = 0.5 + 0.5 * vec3(n.x, -n.y, -n.z);
  else if (mode == 4) {
    shown = ramp((depth - scale.x) / (2.0 * scale.y) + scale.z);
    float line = abs(fract(depth / contour - 0.5) - 0.5) / max(fwidth(depth / contour), 1e-6);
    shown *= 0.72 + 0.28 * smoothstep(0.4, 1.2, line);
  } else if (mode == 5) shown = ramp(texture(doubt, uv).r * 255.0 / ${SIGMA_STOP}.0);
  else {
    vec3 base = mode == 1 ? vec3(0.62) : 0.85 * colour.rgb, sum = vec3(0.0);
    for (int k = 0; k < count; k++) {
      vec3 to = source[k].w > 0.0 ? source[k].xyz - p : source[k].xyz;
      float far = source[k].w > 0.0 ? length(to) : 1e9; vec3 d = normalize(to);
      float fall = source[k].w > 0.0 ? 1.0 / (far * far) : 1.0;
      if (axis[k].w >= 0.0) fall *= lobeAt(acos(clamp(-dot(d, axis[k].xyz), -1.0, 1.0)), axis[k].w);
      float nl = max(dot(n, d), 0.0);
      if (nl > 0.0) sum += power[k] * fall * nl * lit(p, n, d, far) * (base + gloss * gloss * 5.0 * ggx(n, d, v, mix(0.5, 0.13, gloss)));
    }
    sum = exposure * sum + 0.012 * base;
    sum = mix(sum, 0.75 + 0.25 * (1.0 - exp((0.75 - sum) / 0.25)), step(0.75, sum));
    shown = pow(sum, vec3(1.0 / 2.2));
  }
  if (turning && dot(n, v) < -0.25) shown = vec3(0.09, 0.1, 0.11);
  painted = vec4(shown * alpha, alpha);
}`;

function glRenderer(canvas, surface) {
  const gl = canvas.getContext("webgl2", { alpha: true, antialias: true, preserveDrawingBuffer: true });
  if (!gl) return null;
  const program = link(gl), at = {}, { w, h, data } = surface;
  for (let k = 0; k < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); k++) { const name = gl.getActiveUniform(program, k).name; at[name.replace("[0]", "")] = gl.getUniformLocation(program, name); }
  gl.useProgram(program);
  const half = Math.max(data.depth[1] - data.depth[0], 1e-9) / 2, middle = (data.depth[0] + data.depth[1]) / 2;
  textures(gl, at, surface, middle, half);
  const flat = buffers(gl, picture(surface)), mesh = buffers(gl, triangles(surface, 260000));
  gl.uniform1i(at.perspective, data.perspective); gl.uniform3f(at.scale, middle, half, 0.5);
  gl.uniform1f(at.lobeStop, data.lobeStop); gl.uniform1f(at.pixel, surface.pixel); gl.uniform1f(at.reach, 2 * surface.radius);
  gl.uniform2fv(at.place, placing(surface)); gl.uniform3fv(at.centre, surface.centre);
  gl.enable(gl.BLEND); gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);

  return {
    turns: true,
    draw(state) {
      gl.viewport(0, 0, canvas.width, canvas.height);
      gl.clearColor(0, 0, 0, 0); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      const turning = state.does === "turn", f = state.frame;
      gl.uniform1i(at.turning, turning); gl.uniform1i(at.mode, MODES.indexOf(state.mode)); gl.uniform1i(at.shadows, state.shadows);
      gl.uniform4f(at.frame, (2 * f.scale * w) / f.width, (-2 * f.scale * h) / f.height, (2 * f.x) / f.width - 1, 1 - (2 * f.y) / f.height);
      gl.uniformMatrix3fv(at.turn, true, state.turn.matrix); gl.uniform4fv(at.lens, state.turn.lens); gl.uniform4fv(at.eye, state.eye);
      gl.uniform1f(at.exposure, state.exposure); gl.uniform1f(at.gloss, state.gloss); gl.uniform1f(at.contour, state.contour);
      gl.uniform3fv(at.palette, (PALETTES[state.mode] || PALETTES.depth).flatMap(rgb));
      const lights = state.lights;
      gl.uniform1i(at.count, lights.length);
      gl.uniform4fv(at.source, lights.flatMap((l) => l.source)); gl.uniform4fv(at.axis, lights.flatMap((l) => l.axis)); gl.uniform3fv(at.power, lights.flatMap((l) => l.power));
      if (turning) gl.enable(gl.DEPTH_TEST); else gl.disable(gl.DEPTH_TEST);
      const shape = turning ? mesh : flat;
      gl.bindVertexArray(shape.array);
      gl.drawElements(gl.TRIANGLES, shape.count, gl.UNSIGNED_INT, 0);
    },
  };
}

function link(gl) {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text); gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  return program;
}

function textures(gl, at, surface, middle, half) {
  const { w, h, n, normal, depth, mask, albedo, sigma } = surface;
  const geometry = new Float32Array(4 * n), paint = new Float32Array(3 * n);
  for (let k = 0; k < n; k++) if (mask[k]) { geometry.set([normal[3 * k], normal[3 * k + 1], normal[3 * k + 2], (depth[k] - middle) / half], 4 * k); paint.set(albedo.subarray(3 * k, 3 * k + 3), 3 * k); }
  spread(geometry, 4, mask, w, h, 3); spread(paint, 3, mask, w, h, 3);
  const bytes = new Uint8Array(4 * n), doubt = new Uint8Array(n);
  for (let k = 0; k < n; k++) { for (let c = 0; c < 3; c++) bytes[4 * k + c] = Math.round(255 * Math.min(1, paint[3 * k + c])); bytes[4 * k + 3] = 255 * mask[k]; doubt[k] = Math.min(255, Math.round(2 ** (sigma[k] / surface.data.sigmaScale) - 1)); }
  const lamps = surface.data.lights.filter((l) => l.lobe), knots = lamps.length ? lamps[0].lobe.length : 2;
  const lobes = new Float32Array(lamps.length ? lamps.flatMap((l) => l.lobe) : [1, 1]);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  const all = [
    ["geometry", gl.RGBA16F, gl.RGBA, gl.FLOAT, geometry, w, h, gl.LINEAR], ["paint", gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, bytes, w, h, gl.LINEAR],
    ["doubt", gl.R8, gl.RED, gl.UNSIGNED_BYTE, doubt, w, h, gl.LINEAR], ["lobes", gl.R32F, gl.RED, gl.FLOAT, lobes, knots, Math.max(lamps.length, 1), gl.NEAREST],
  ];
  all.forEach(([name, inside, format, type, values, wide, high, filter], unit) => {
    gl.activeTexture(gl.TEXTURE0 + unit); gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texImage2D(gl.TEXTURE_2D, 0, inside, wide, high, 0, format, type, values);
    for (const key of ["MIN", "MAG"]) gl.texParameteri(gl.TEXTURE_2D, gl[`TEXTURE_${key}_FILTER`], filter);
    for (const key of ["S", "T"]) gl.texParameteri(gl.TEXTURE_2D, gl[`TEXTURE_WRAP_${key}`], gl.CLAMP_TO_EDGE);
    gl.uniform1i(at[name], unit);
  });
}

// The picture as a grid of cells that carry the rays.
function picture(surface) {
  const { w, h, data } = surface, size = data.grid.size, vertices = [], faces = [];
  for (let j = 0; j < size; j++) for (let i = 0; i < size; i++) {
    const x = (i / (size - 1)) * w, y = (j / (size - 1)) * h;
    vertices.push(x / w, y / h, ...rayAt(data, x - 0.5, y - 0.5), surface.middle);
    if (i < size - 1 && j < size - 1) { const k = j * size + i; faces.push(k, k + size, k + 1, k + 1, k + size, k + size + 1); }
  }
  return { vertices: new Float32Array(vertices), faces: new Uint32Array(faces) };
}

function buffers(gl, shape) {
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer()); gl.bufferData(gl.ARRAY_BUFFER, shape.vertices, gl.STATIC_DRAW);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer()); gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, shape.faces, gl.STATIC_DRAW);
  [[2, 0], [2, 8], [1, 16]].forEach(([size, offset], k) => { gl.enableVertexAttribArray(k); gl.vertexAttribPointer(k, size, gl.FLOAT, false, 20, offset); });
  return { array, count: shape.faces.length };
}

// Where in the picture a point is seen: uv = c0 + c1 x + c2 y + (c3 x + c4 y) (x^2 + y^2) of its ray (x, y), by least squares over the grid.
function placing(surface) {
  const { w, h, data } = surface, terms = data.perspective ? 5 : 3, A = Array.from({ length: terms }, () => new Float64Array(terms + 2));
  for (let j = 0; j < 9; j++) for (let i = 0; i < 9; i++) {
    const u = i / 8, v = j / 8, [x, y] = rayAt(data, u * w - 0.5, v * h - 0.5), r2 = x * x + y * y;
    const row = [1, x, y, x * r2, y * r2].slice(0, terms);
    for (let a = 0; a < terms; a++) { for (let b = 0; b < terms; b++) A[a][b] += row[a] * row[b]; A[a][terms] += row[a] * u; A[a][terms + 1] += row[a] * v; }
  }
  for (let a = 0; a < terms; a++) {
    const best = A.slice(a).reduce((m, row, k) => (Math.abs(row[a]) > Math.abs(A[m][a]) ? k + a : m), a);
    [A[a], A[best]] = [A[best], A[a]];
    for (let b = 0; b < terms; b++) if (b !== a) { const f = A[b][a] / A[a][a]; for (let c = a; c < terms + 2; c++) A[b][c] -= f * A[a][c]; }
  }
  const out = new Float32Array(10);
  for (let a = 0; a < terms; a++) { out[2 * a] = A[a][terms] / A[a][a]; out[2 * a + 1] = A[a][terms + 1] / A[a][a]; }
  return out;
}

// Without WebGL2: the same near light and Lambert's law on a plain canvas; no gloss, no shadows, no turning.
function plainRenderer(canvas, surface) {
  const pen = canvas.getContext("2d"), { w, h, n, data, mask, normal, depth, albedo, sigma } = surface;
  const sheet = document.createElement("canvas"); sheet.width = w; sheet.height = h;
  const ink = sheet.getContext("2d"), image = ink.createImageData(w, h), points = new Float32Array(3 * n);
  for (let k = 0; k < n; k++) if (mask[k]) points.set(pointAt(data, rayAt(data, k % w, Math.floor(k / w)), depth[k]), 3 * k);
  const mixed = (name, t) => { const at = Math.min(Math.max(t, 0), 1) * 3.999, k = Math.floor(at), a = rgb(PALETTES[name][k]), b = rgb(PALETTES[name][k + 1]); return a.map((x, c) => x + (at - k) * (b[c] - x)); };
  function colour(k, state) {
    const nx = normal[3 * k], ny = normal[3 * k + 1], nz = normal[3 * k + 2];
    if (state.mode === "normals") return [0.5 + 0.5 * nx, 0.5 - 0.5 * ny, 0.5 - 0.5 * nz];
    if (state.mode === "depth") return mixed("depth", (depth[k] - data.depth[0]) / (data.depth[1] - data.depth[0]));
    if (state.mode === "sigma") return mixed("sigma", (2 ** (sigma[k] / data.sigmaScale) - 1) / SIGMA_STOP);
    const base = [0, 1, 2].map((c) => (state.mode === "shading" ? 0.62 : 0.85 * albedo[3 * k + c])), sum = [0, 0, 0];
    if (state.mode === "albedo") return base.map((x) => x ** (1 / 2.2));
    for (const light of state.lights) {
      const near = light.source[3], d = [0, 1, 2].map((c) => light.source[c] - near * points[3 * k + c]), r = Math.hypot(...d);
      const nl = Math.max(0, (nx * d[0] + ny * d[1] + nz * d[2]) / r) / (near ? r * r : 1);
      for (let c = 0; c < 3; c++) sum[c] += light.power[c] * nl * base[c];
    }
    return sum.map((x) => Math.min(1, state.exposure * x) ** (1 / 2.2));
  }
  return {
    turns: false,
    draw(state) {
      for (let k = 0; k < n; k++) if (mask[k]) { const c = colour(k, state); for (let j = 0; j < 3; j++) image.data[4 * k + j] = 255 * c[j]; image.data[4 * k + 3] = 255; }
      ink.putImageData(image, 0, 0);
      const f = state.frame;
      pen.clearRect(0, 0, canvas.width, canvas.height);
      pen.drawImage(sheet, f.x, f.y, f.scale * w, f.scale * h);
    },
  };
}
