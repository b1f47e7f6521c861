// The packed surface, unpacked: normals and depth as numbers, positions by the rays' grid, triangles between neighbours.
async function unpack(data) {
  const raw = atob(data.planes), bytes = new Uint8Array(raw.length);
  for (let k = 0; k < raw.length; k++) bytes[k] = raw.charCodeAt(k);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  const stored = new Uint8Array(await new Response(stream).arrayBuffer());
  const w = data.width, h = data.height, n = w * h;
  let at = 0;
  function plane(wide) {
    const out = wide ? new Uint16Array(n) : new Uint8Array(n), low = wide ? at + n : at;
    for (let y = 0, k = 0; y < h; y++) {
      for (let x = 0, sum = 0; x < w; x++, k++) out[k] = sum += wide ? stored[at + k] * 256 + stored[low + k] : stored[low + k];
    }
    at = low + n;
    return out;
  }
  const u = plane(true), v = plane(true), code = plane(true), colours = [];
  for (let c = 0; c < data.channels; c++) colours.push(plane(false));
  const sigma = plane(false), used = plane(false), component = plane(false);
  const normal = new Float32Array(3 * n), depth = new Float32Array(n), mask = new Uint8Array(n), albedo = new Float32Array(3 * n);
  const [near, far] = data.depth;
  for (let k = 0; k < n; k++) {
    if (!code[k]) continue;
    let x = u[k] / 32767.5 - 1, y = v[k] / 32767.5 - 1;
    const z = Math.abs(x) + Math.abs(y) - 1;
    if (z > 0) [x, y] = [(1 - Math.abs(y)) * (x < 0 ? -1 : 1), (1 - Math.abs(x)) * (y < 0 ? -1 : 1)];
    const length = Math.hypot(x, y, z);
    normal.set([x / length, y / length, z / length], 3 * k);
    depth[k] = near + ((code[k] - 1) / 65534) * (far - near);
    mask[k] = 1;
    for (let c = 0; c < 3; c++) albedo[3 * k + c] = (colours[Math.min(c, data.channels - 1)][k] / 255) ** 2;
  }
  return { data, w, h, n, normal, depth, mask, albedo, sigma, used, component, ...extent(data, w, h, depth, mask) };
}

// Ray of a place in the crop (pixels of the crop), by the grid; outside, by its outermost cells.
function rayAt(data, x, y) {
  const g = data.grid, last = g.size - 2;
  const px = data.origin[0] + (x + 0.5) * data.step - 0.5, py = data.origin[1] + (y + 0.5) * data.step - 0.5;
  const x0 = g.px[0][0][0], x1 = g.px[0][last + 1][0], y0 = g.px[0][0][1], y1 = g.px[last + 1][0][1];
  const i = Math.max(0, Math.min(last, Math.floor(((px - x0) / Math.max(x1 - x0, 1e-9)) * (last + 1))));
  const j = Math.max(0, Math.min(last, Math.floor(((py - y0) / Math.max(y1 - y0, 1e-9)) * (last + 1))));
  const s = (px - g.px[j][i][0]) / Math.max(g.px[j][i + 1][0] - g.px[j][i][0], 1e-9);
  const t = (py - g.px[j][i][1]) / Math.max(g.px[j + 1][i][1] - g.px[j][i][1], 1e-9);
  const mix = (c) => (1 - t) * ((1 - s) * g.ray[j][i][c] + s * g.ray[j][i + 1][c]) + t * ((1 - s) * g.ray[j + 1][i][c] + s * g.ray[j + 1][i + 1][c]);
  return [mix(0), mix(1)];
}

function pointAt(data, ray, depth) {
  return data.perspective ? [ray[0] * depth, ray[1] * depth, depth] : [ray[0], ray[1], depth];
}

// Where the surface lies: its middle, its radius, the depth of its front, the size of a pixel there.
function extent(data, w, h, depth, mask) {
  const low = [1e9, 1e9, 1e9], high = [-1e9, -1e9, -1e9], seen = [];
  for (let y = 0; y < h; y += 3) {
    for (let x = 0; x < w; x += 3) {
      const k = y * w + x;
      if (!mask[k]) continue;
      seen.push(depth[k]);
      const p = pointAt(data, rayAt(data, x, y), depth[k]);
      for (let c = 0; c < 3; c++) { low[c] = Math.min(low[c], p[c]); high[c] = Math.max(high[c], p[c]); }
    }
  }
  if (!seen.length) return { centre: [0, 0, 1], radius: 1, front: 0, middle: 1, pixel: 1 };
  seen.sort((a, b) => a - b);
  const middle = seen[seen.length >> 1], front = seen[Math.floor(seen.length * 0.02)];
  const a = pointAt(data, rayAt(data, w / 2, h / 2), middle), b = pointAt(data, rayAt(data, w / 2 + 1, h / 2), middle);
  return { centre: low.map((x, c) => (x + high[c]) / 2), radius: Math.hypot(high[0] - low[0], high[1] - low[1]) / 2, front, middle, pixel: Math.abs(b[0] - a[0]) };
}

// Vertices every `stride` pixels and the triangles between them; none across the mask's edge or a jump in depth.
function triangles(surface, most) {
  const { w, h, mask, depth, data, pixel } = surface;
  let stride = 1;
  while ((w / stride) * (h / stride) > most) stride++;
  const index = new Int32Array(w * h).fill(-1), vertices = [], faces = [];
  for (let y = 0; y < h; y += stride) {
    for (let x = 0; x < w; x += stride) {
      const k = y * w + x;
      if (!mask[k]) continue;
      index[k] = vertices.length / 5;
      const ray = rayAt(data, x, y);
      vertices.push((x + 0.5) / w, (y + 0.5) / h, ray[0], ray[1], depth[k]);
    }
  }
  const jump = 7 * stride * pixel;
  for (let y = 0; y + stride < h; y += stride) {
    for (let x = 0; x + stride < w; x += stride) {
      const a = y * w + x, b = a + stride, c = a + stride * w, d = c + stride;
      for (const corners of [[a, c, b], [b, c, d]]) {
        if (corners.some((k) => index[k] < 0)) continue;
        const z = corners.map((k) => depth[k]);
        if (Math.max(...z) - Math.min(...z) < jump) faces.push(index[corners[0]], index[corners[1]], index[corners[2]]);
      }
    }
  }
  return { vertices: new Float32Array(vertices), faces: new Uint32Array(faces) };
}

// Values spread a few pixels outwards, so that a smooth lookup at the edge finds no hole.
function spread(values, size, mask, w, h, rounds) {
  let inside = mask.slice();
  for (let round = 0; round < rounds; round++) {
    const next = inside.slice();
    for (let y = 0, k = 0; y < h; y++) {
      for (let x = 0; x < w; x++, k++) {
        if (inside[k]) continue;
        const from = [x > 0 && k - 1, x < w - 1 && k + 1, y > 0 && k - w, y < h - 1 && k + w].filter((j) => j !== false && inside[j]);
        if (!from.length) continue;
        for (let c = 0; c < size; c++) values[size * k + c] = from.reduce((sum, j) => sum + values[size * j + c], 0) / from.length;
        next[k] = 1;
      }
    }
    inside = next;
  }
}
