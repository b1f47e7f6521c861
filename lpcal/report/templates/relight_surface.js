// The packed surface, unpacked: textures' bytes for the drawing, depth codes for measuring, triangles by tiles and levels.
// The functions down to `decoded` stand alone: a worker is given their text.
async function inflated(text) {
  let bytes;
  if (Uint8Array.fromBase64) bytes = Uint8Array.fromBase64(text.trim());
  else { const raw = atob(text.trim()); bytes = new Uint8Array(raw.length); for (let k = 0; k < raw.length; k++) bytes[k] = raw.charCodeAt(k); }
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer());
}

// Planes of row differences, summed up again; `wide` says which have 16 bits.
function planesOf(stored, w, h, wide) {
  const n = w * h;
  let at = 0;
  return wide.map((two) => {
    const out = two ? new Uint16Array(n) : new Uint8Array(n), low = two ? at + n : at;
    for (let y = 0, k = 0; y < h; y++) for (let x = 0, sum = 0; x < w; x++, k++) out[k] = sum += two ? stored[at + k] * 256 + stored[low + k] : stored[low + k];
    at = low + n;
    return out;
  });
}

// The 16-bit floats of `count` numbers from `first` on in equal steps, as their bits.
function halves(count, first, step) {
  const real = new Float32Array(1), bits = new Uint32Array(real.buffer), out = new Uint16Array(count);
  for (let k = 0; k < count; k++) {
    real[0] = first + k * step;
    const sign = (bits[0] >>> 16) & 0x8000, e = ((bits[0] >>> 23) & 255) - 112, m = bits[0] & 0x7fffff;
    out[k] = e <= 0 ? (e < -10 ? sign : sign | (((m | 0x800000) >> (1 - e)) + 0x1000) >> 13) : sign | ((e << 10) + ((m + 0x1000) >> 13));
  }
  return out;
}

// What is drawn of normals, depth and albedo: 16-bit floats (normal's two coordinates, depth from -1 to 1, 1 within the mask), and bytes.
function decoded(planes, w, h, bits, into, from) {
  const [u, v, code] = planes, colours = planes.slice(3, -1), n = w * h, ONE = 0x3c00;
  const top = (1 << bits) - 1, octahedral = halves(top + 1, -1, 2 / top), along = halves(65536, -1 - 2 / 65534, 2 / 65534);
  for (let k = 0; k < n; k++) {
    if (!code[k]) continue;
    const g = 4 * (from + k);
    into.geometry[g] = octahedral[u[k]]; into.geometry[g + 1] = octahedral[v[k]]; into.geometry[g + 2] = along[code[k]]; into.geometry[g + 3] = ONE;
    for (let c = 0; c < 3; c++) into.paint[g + c] = colours[Math.min(c, colours.length - 1)][k];
    into.paint[g + 3] = 255;
  }
  into.code.set(code, from); into.breaks.set(planes[planes.length - 1], from);
}

const empty = (n) => ({ geometry: new Uint16Array(4 * n), paint: new Uint8Array(4 * n), code: new Uint16Array(n), breaks: new Uint8Array(n) });

async function coarse(data) {
  const w = data.width, h = data.height, colours = Array(data.channels).fill(false);
  const planes = planesOf(await inflated(data.planes), w, h, [true, true, true, ...colours, false, false, false, false, false]);
  const [sigma, depthSigma, used, component, breaks] = planes.slice(-5), maps = empty(w * h);
  decoded([...planes.slice(0, 3 + data.channels), breaks], w, h, 16, maps, 0);
  return { data, w, h, step: data.step, ...maps, coarse: { w, h, step: data.step, sigma, depthSigma, used, component } };
}

async function whole(texts, full, channels) {
  const maps = empty(full.width * full.height), colours = Array(channels).fill(false);
  let row = 0;
  for (let k = 0; k < texts.length; k++) {
    const planes = planesOf(await inflated(texts[k]), full.width, full.rows[k], [true, true, true, ...colours, false]);
    decoded(planes, full.width, full.rows[k], full.bits, maps, row * full.width);
    row += full.rows[k];
  }
  return maps;
}

// The full size, unpacked in a worker, so that the page goes on meanwhile; on the page where there is no worker.
function wholeAside(texts, full, channels) {
  const parts = [inflated, planesOf, halves, decoded, whole].map(String).join("\n") + `\nconst empty = ${empty};`;
  const talk = `\nonmessage = async (event) => { const maps = await whole(...event.data); postMessage(maps, Object.values(maps).map((a) => a.buffer)); };`;
  return new Promise((done, failed) => {
    let worker;
    try { worker = new Worker(URL.createObjectURL(new Blob([parts + talk], { type: "text/javascript" }))); } catch { whole(texts, full, channels).then(done, failed); return; }
    worker.onmessage = (event) => { worker.terminate(); done(event.data); };
    worker.onerror = (event) => { worker.terminate(); event.preventDefault(); whole(texts, full, channels).then(done, failed); };
    worker.postMessage([texts, full, channels]);
  });
}

// Ray of a place in the crop (the image's pixels, from the crop's first one), by the grid; outside, by its outermost cells.
function rayAt(data, x, y) {
  const g = data.grid, last = g.size - 2, px = data.origin[0] + x, py = data.origin[1] + y;
  const x0 = g.px[0][0][0], x1 = g.px[0][last + 1][0], y0 = g.px[0][0][1], y1 = g.px[last + 1][0][1];
  const i = Math.max(0, Math.min(last, Math.floor(((px - x0) / Math.max(x1 - x0, 1e-9)) * (last + 1))));
  const j = Math.max(0, Math.min(last, Math.floor(((py - y0) / Math.max(y1 - y0, 1e-9)) * (last + 1))));
  const s = (px - g.px[j][i][0]) / Math.max(g.px[j][i + 1][0] - g.px[j][i][0], 1e-9);
  const t = (py - g.px[j][i][1]) / Math.max(g.px[j + 1][i][1] - g.px[j][i][1], 1e-9);
  const mix = (c) => (1 - t) * ((1 - s) * g.ray[j][i][c] + s * g.ray[j][i + 1][c]) + t * ((1 - s) * g.ray[j + 1][i][c] + s * g.ray[j + 1][i + 1][c]);
  return [mix(0), mix(1)];
}

function depthOf(surface, k) { const [near, far] = surface.data.depth; return near + ((surface.code[k] - 1) / 65534) * (far - near); }
// The image's pixel, from the crop's first one, at a place (x, y) of the maps, whose pixels' middles are whole numbers.
function imagePlace(surface, x, y) { return [(x + 0.5) * surface.step - 0.5, (y + 0.5) * surface.step - 0.5]; }

function pointAt(surface, x, y, depth) {
  const ray = rayAt(surface.data, ...imagePlace(surface, x, y));
  return surface.data.perspective ? [ray[0] * depth, ray[1] * depth, depth] : [ray[0], ray[1], depth];
}

// What the coarse maps say at a pixel of the maps.
function coarseAt(surface, x, y) {
  const c = surface.coarse, k = surface.step / c.step;
  const at = Math.min(c.h - 1, Math.floor((y + 0.5) * k)) * c.w + Math.min(c.w - 1, Math.floor((x + 0.5) * k)), d = surface.data;
  const sigma = c.depthSigma[at] ? d.depthSigma.least * 2 ** ((c.depthSigma[at] - 1) / d.depthSigma.scale) : NaN;
  return { sigmaDeg: 2 ** (c.sigma[at] / d.sigmaScale) - 1, depthSigma: sigma, used: c.used[at], component: c.component[at] };
}

function normalAt(surface, k) {
  const half = (b) => { const e = (b >> 10) & 31, m = b & 1023; return (b & 0x8000 ? -1 : 1) * (e ? (1 + m / 1024) * 2 ** (e - 15) : m * 2 ** -24); };
  let x = half(surface.geometry[4 * k]), y = half(surface.geometry[4 * k + 1]);
  const z = Math.abs(x) + Math.abs(y) - 1;
  if (z > 0) [x, y] = [(1 - Math.abs(y)) * (x < 0 ? -1 : 1), (1 - Math.abs(x)) * (y < 0 ? -1 : 1)];
  const length = Math.hypot(x, y, z);
  return [x / length, y / length, z / length];
}

// Where the surface lies: its middle, its radius, the depth of its front, the width of a pixel of the maps there.
function extent(surface) {
  const { w, h, code, step } = surface, low = [1e9, 1e9, 1e9], high = [-1e9, -1e9, -1e9], seen = [], every = Math.max(1, Math.round(Math.sqrt((w * h) / 40000)));
  for (let y = 0; y < h; y += every) {
    for (let x = 0; x < w; x += every) {
      const k = y * w + x;
      if (!code[k]) continue;
      const z = depthOf(surface, k), p = pointAt(surface, x, y, z);
      seen.push(z);
      for (let c = 0; c < 3; c++) { low[c] = Math.min(low[c], p[c]); high[c] = Math.max(high[c], p[c]); }
    }
  }
  if (!seen.length) return { centre: [0, 0, 1], half: [1, 1, 1], radius: 1, size: 1, front: 0, middle: 1, pixel: 1 };
  seen.sort((a, b) => a - b);
  const middle = seen[seen.length >> 1], front = seen[Math.floor(seen.length * 0.02)];
  const a = pointAt(surface, w / 2, h / 2, middle), b = pointAt(surface, w / 2 + 1, h / 2, middle);
  const half = low.map((x, c) => (high[c] - x) / 2);
  return { centre: low.map((x, c) => x + half[c]), half, radius: Math.hypot(half[0], half[1]), size: Math.hypot(...half), front, middle, pixel: Math.abs(b[0] - a[0]) || step };
}

const TILE = 64;

// The triangles of one tile: 64 x 64 cells of `stride` pixels from (x0, y0). Corners outside the mask are put where their neighbours lie:
// the outline is the picture's. None across a break. Its sides hang a little backwards, so that no gap opens towards a coarser neighbour.
function tileShape(surface, x0, y0, stride) {
  const { w, h, code, breaks, coarse: maps } = surface, across = Math.min(TILE, Math.ceil((w - 1 - x0) / stride)), down = Math.min(TILE, Math.ceil((h - 1 - y0) / stride));
  if (across < 1 || down < 1) return null;
  const size = across + 1, count = size * (down + 1), xs = Array.from({ length: size }, (_, i) => Math.min(x0 + i * stride, w - 1)), ys = Array.from({ length: down + 1 }, (_, j) => Math.min(y0 + j * stride, h - 1));
  const depth = new Float32Array(count), inside = new Uint8Array(count), piece = new Uint8Array(count), k = surface.step / maps.step;
  for (let j = 0, at = 0; j <= down; j++) for (let i = 0; i < size; i++, at++) {
    const from = ys[j] * w + xs[i];
    if (!code[from]) continue;
    depth[at] = depthOf(surface, from); inside[at] = 1;
    piece[at] = maps.component[Math.min(maps.h - 1, Math.floor((ys[j] + 0.5) * k)) * maps.w + Math.min(maps.w - 1, Math.floor((xs[i] + 0.5) * k))];
  }
  for (let j = 0, at = 0; j <= down; j++) for (let i = 0; i < size; i++, at++) {
    if (inside[at]) continue;
    let sum = 0, found = 0;
    for (let b = Math.max(0, j - 1); b <= Math.min(down, j + 1); b++) for (let a = Math.max(0, i - 1); a <= Math.min(across, i + 1); a++) { const q = b * size + a; if (inside[q] === 1) { sum += depth[q]; found++; } }
    if (found) { depth[at] = sum / found; inside[at] = 2; }
  }
  const whole = (at, x, y, other, along, bit) => {
    if (!inside[at] || !inside[other]) return false;
    if (inside[at] === 1 && inside[other] === 1 && piece[at] && piece[other] && piece[at] !== piece[other]) return false;
    const pace = bit === 1 ? 1 : w;
    for (let q = y * w + x, end = q + pace * along; q < end; q += pace) if (breaks[q] & bit) return false;
    return true;
  };
  const right = new Uint8Array(count), below = new Uint8Array(count);
  for (let j = 0, at = 0; j <= down; j++) for (let i = 0; i < size; i++, at++) {
    if (i < across) right[at] = whole(at, xs[i], ys[j], at + 1, xs[i + 1] - xs[i], 1);
    if (j < down) below[at] = whole(at, xs[i], ys[j], at + size, ys[j + 1] - ys[j], 2);
  }
  const faces = [], any = (a, b, c) => inside[a] === 1 || inside[b] === 1 || inside[c] === 1;
  for (let j = 0; j < down; j++) for (let i = 0; i < across; i++) {
    const a = j * size + i, b = a + 1, c = a + size, d = c + 1;
    if (Math.abs(depth[b] - depth[c]) <= Math.abs(depth[a] - depth[d])) {
      if (right[a] && below[a] && any(a, b, c)) faces.push(a, c, b);
      if (right[c] && below[b] && any(b, c, d)) faces.push(b, c, d);
    } else {
      if (below[a] && right[c] && any(a, c, d)) faces.push(a, c, d);
      if (right[a] && below[b] && any(a, d, b)) faces.push(a, d, b);
    }
  }
  if (!faces.length) return null;
  const rim = [], skirt = (a, b, open) => { if (open && any(a, b, a)) rim.push(a, b); };
  for (let i = 0; i < across; i++) { skirt(i + 1, i, y0 > 0 && right[i]); skirt(down * size + i, down * size + i + 1, ys[down] < h - 1 && right[down * size + i]); }
  for (let j = 0; j < down; j++) { skirt(j * size, (j + 1) * size, x0 > 0 && below[j * size]); skirt((j + 1) * size + across, j * size + across, xs[across] < w - 1 && below[j * size + across]); }
  const total = count + rim.length, position = new Float32Array(3 * total), cell = new Uint16Array(2 * total), drop = 2 * stride * surface.pixel;
  const put = (to, at, more) => {
    const x = xs[at % size], y = ys[Math.floor(at / size)], p = pointAt(surface, x, y, depth[at] + more);
    position.set(p, 3 * to); cell[2 * to] = x; cell[2 * to + 1] = y;
  };
  for (let at = 0; at < count; at++) if (inside[at]) put(at, at, 0);
  for (let q = 0; q < rim.length; q += 2) {
    put(count + q, rim[q], drop); put(count + q + 1, rim[q + 1], drop);
    faces.push(rim[q], count + q, rim[q + 1], rim[q + 1], count + q, count + q + 1);
  }
  return { position, cell, faces: total < 65536 ? new Uint16Array(faces) : new Uint32Array(faces) };
}
