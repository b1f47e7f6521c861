// The measuring tool: two picked pixels, their distance with its sigma, and the section between them.
//   d = |B - A|, A = z r;  sigma^2 = (u . r_A s_A)^2 + (u . r_B s_B)^2 + scale,  u = (B - A) / d
// with the depths' own sigmas s (shape) taken as independent, and of the scale (d s)^2 within a piece, (u . A s)^2 + (u . B s')^2 between two.
function placed(surface, px) {
  const k = px[1] * surface.w + px[0], depth = depthOf(surface, k), said = coarseAt(surface, ...px), p = pointAt(surface, px[0], px[1], depth);
  const ray = surface.data.perspective ? p.map((x) => x / depth) : [0, 0, 1];
  return { px, k, p, ray, sigma: said.depthSigma, piece: said.component, scale: surface.data.perspective ? surface.data.scales[said.component] || 0 : 0 };
}

const dot3 = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

function distanceOf(a, b) {
  const by = b.p.map((x, c) => x - a.p[c]), d = Math.hypot(...by), u = by.map((x) => x / Math.max(d, 1e-12));
  const shape = Math.hypot(dot3(u, a.ray) * a.sigma, dot3(u, b.ray) * b.sigma);
  const scale = a.piece === b.piece ? d * a.scale : Math.hypot(dot3(u, a.p) * a.scale, dot3(u, b.p) * b.scale);
  return { d, u, shape, scale, sigma: Math.hypot(Number.isNaN(shape) ? 0 : shape, scale), known: !Number.isNaN(shape) };
}

// The depth at a place between pixels, from the four about it; the nearest one's where they do not belong together.
function between(surface, [x, y], px) {
  const i = Math.floor(x), j = Math.floor(y), s = x - i, t = y - j, w = surface.w, k = j * w + i, near = px[1] * w + px[0];
  const about = [k, k + (s ? 1 : 0), k + (t ? w : 0), k + (s ? 1 : 0) + (t ? w : 0)];
  if (about.some((q) => !surface.code[q]) || surface.breaks[k] || (s && surface.breaks[about[2]] & 1) || (t && surface.breaks[about[1]] & 2)) return depthOf(surface, near);
  const [a, b, c, d] = about.map((q) => depthOf(surface, q));
  return (1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * c + s * d);
}

// The section: places along the straight line of the image between both, as far along the chord and above it, towards the camera.
function sectionOf(surface, a, b) {
  const { u } = distanceOf(a, b), steps = Math.max(2, Math.min(600, Math.round(Math.hypot(b.px[0] - a.px[0], b.px[1] - a.px[1]))));
  const back = a.ray.map((x, c) => -(x + b.ray[c]) / 2), lean = dot3(back, u), m = back.map((x, c) => x - lean * u[c]), length = Math.hypot(...m) || 1;
  const up = m.map((x) => x / length), rows = [];
  for (let k = 0; k <= steps; k++) {
    const place = [0, 1].map((c) => a.px[c] + (k / steps) * (b.px[c] - a.px[c])), px = place.map(Math.round);
    if (!surface.code[px[1] * surface.w + px[0]]) { rows.push(null); continue; }
    const at = placed(surface, px), p = pointAt(surface, ...place, between(surface, place, px)), by = p.map((x, c) => x - a.p[c]);
    rows.push({ p, along: dot3(by, u), above: dot3(by, up), sigma: Math.abs(dot3(up, at.ray)) * (at.sigma || 0), piece: at.piece });
  }
  return rows;
}

// Runs of a section's places without a gap or a change of piece.
function runsOf(rows) {
  const runs = [[]];
  for (const row of rows) { const run = runs[runs.length - 1]; if (!row || (run.length && run[run.length - 1].piece !== row.piece)) runs.push([]); if (row) runs[runs.length - 1].push(row); }
  return runs.filter((run) => run.length > 1);
}

const plain = (x, digits) => x.toFixed(digits).replace(/^-(0(\.0*)?)$/, "$1");

function chartOf(rows, unit) {
  const W = 240, H = 120, L = 34, B = 22, T = 8, found = rows.filter(Boolean), k = unit.k;
  const xs = found.map((r) => k * r.along), lows = found.map((r) => k * (r.above - r.sigma)), highs = found.map((r) => k * (r.above + r.sigma));
  const [x0, x1] = [Math.min(...xs), Math.max(...xs)], [y0, y1] = [Math.min(...lows), Math.max(...highs)], tall = Math.max(y1 - y0, 1e-6);
  const X = (r) => (L + ((k * r.along - x0) / Math.max(x1 - x0, 1e-9)) * (W - L - 4)).toFixed(1), Y = (v) => (T + ((y1 - k * v) / tall) * (H - T - B)).toFixed(1);
  const parts = runsOf(rows).map((run) => `<path class="band" d="M${run.map((r) => `${X(r)} ${Y(r.above + r.sigma)}`).join("L")}L${[...run].reverse().map((r) => `${X(r)} ${Y(r.above - r.sigma)}`).join("L")}Z"/><path class="run" d="M${run.map((r) => `${X(r)} ${Y(r.above)}`).join("L")}"/>`);
  const say = (v, x, y, anchor) => `<text x="${x}" y="${y}" text-anchor="${anchor}">${v}</text>`;
  return `<svg viewBox="0 0 ${W} ${H}" role="img" aria-label="section: height above the chord against the way along it, ${unit.name}; from ${y0.toFixed(unit.digits)} to ${y1.toFixed(unit.digits)}">${parts.join("")}` +
    say(plain(y1, unit.digits), L - 4, T + 8, "end") + say(plain(y0, unit.digits), L - 4, H - B, "end") + say("0", L, H - 8, "start") + say(`${x1.toFixed(unit.digits)} ${unit.name}`, W - 4, H - 8, "end") + `</svg>`;
}

function csvOf(rows, unit) {
  return [`along_${unit.name},above_${unit.name},sigma_${unit.name}`, ...rows.filter(Boolean).map((r) => [r.along, r.above, r.sigma].map((x) => (unit.k * x).toFixed(5)).join(","))].join("\n") + "\n";
}
