// The model in space: its vertices with what each rests on, the views, their way, the stops to come; distances and sections with sigma.
const find = (id) => document.getElementById(id), all = (what) => [...document.querySelectorAll(what)];
const data = JSON.parse(find("data").textContent), canvas = find("view");
const state = { does: "turn", mode: "albedo", layers: { views: true, path: true, next: true } };
const RAMP = [[0.16, 0.32, 0.55], [0.28, 0.62, 0.66], [0.85, 0.83, 0.55], [0.92, 0.55, 0.25], [0.75, 0.18, 0.2]];
let gl, space, camera, controls, mesh, lines = [], values, picked = [], section = null, waiting = false;

async function inflated(text) {
  const raw = atob(text.trim()), bytes = Uint8Array.from(raw, (c) => c.charCodeAt(0));
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer());
}

// Codes back to numbers: positions in 16 bits over the bounds, normals in 8, sigma and disagreement as bytes of a logarithm.
async function unpacked() {
  const bytes = await inflated(data.mesh), V = data.vertices, F = data.faces;
  let at = 0;
  const take = (kind, count) => { const n = count * kind.BYTES_PER_ELEMENT, part = new kind(bytes.slice(at, at + n).buffer); at += n; return part; };
  const code = take(Uint16Array, 3 * V), faces = take(Uint32Array, 3 * F), n = take(Int8Array, 3 * V), albedo = take(Uint8Array, 3 * V), sigma = take(Uint8Array, V), apart = take(Uint8Array, V), seen = take(Uint8Array, V);
  const position = Float32Array.from(code, (x, k) => data.low[k % 3] + (x / 65535) * data.span[k % 3] - data.centre[k % 3]);
  return { position, faces, normal: Float32Array.from(n, (x) => x / 127), albedo, sigma, apart, seen };
}
const metresOf = (byte) => (byte ? data.least * 2 ** ((byte - 1) / data.steps) : 0);
const say = (metres, digits = 2) => `${(1000 * metres).toFixed(digits)} mm`;

function ramp(t) { const x = Math.max(0, Math.min(0.9999, t)) * (RAMP.length - 1), k = Math.floor(x), f = x - k; return RAMP[k].map((a, c) => a + f * (RAMP[k + 1][c] - a)); }

function colours() {
  const V = data.vertices, out = new Float32Array(3 * V), most = Math.max(...[...new Set(values.seen)], 1);
  for (let k = 0; k < V; k++) {
    let c = [0.75, 0.75, 0.75];
    if (state.mode === "albedo") c = [0, 1, 2].map((i) => values.albedo[3 * k + i] / 255);
    else if (state.mode === "normals") c = [0, 1, 2].map((i) => 0.5 + 0.5 * values.normal[3 * k + i]);
    else if (state.mode === "seen") c = ramp(1 - values.seen[k] / most);
    else if (state.mode !== "shading") c = ramp(((state.mode === "sigma" ? values.sigma : values.apart)[k] - 1) / (data.top - 1));
    out.set(c, 3 * k);
  }
  mesh.geometry.setAttribute("colour", new THREE.BufferAttribute(out, 3));
  mesh.material.uniforms.lit.value = state.mode === "normals" ? 0 : state.mode === "albedo" || state.mode === "shading" ? 1 : 0.35;
  const box = find("legend"), [low, high] = box.querySelectorAll("span");
  box.hidden = !["sigma", "apart", "seen"].includes(state.mode);
  const bar = RAMP.map((c) => `rgb(${c.map((x) => Math.round(255 * x)).join(" ")})`);
  box.querySelector("i").style.background = `linear-gradient(90deg, ${(state.mode === "seen" ? bar.reverse() : bar).join(", ")})`;
  [low.textContent, high.textContent] = state.mode === "seen" ? ["none", `${most} views`] : [say(data.least, 3), say(metresOf(data.top))];
}

function material() {
  return new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3, side: THREE.DoubleSide, uniforms: { lit: { value: 1 } },
    vertexShader: `precision highp float; uniform mat4 modelViewMatrix, projectionMatrix; in vec3 position, normal, colour; out vec3 n, c, p;
      void main() { vec4 q = modelViewMatrix * vec4(position, 1.0); p = q.xyz; n = (modelViewMatrix * vec4(normal, 0.0)).xyz; c = colour; gl_Position = projectionMatrix * q; }`,
    fragmentShader: `precision highp float; uniform float lit; in vec3 n, c, p; out vec4 o;
      void main() { float d = max(dot(normalize(n), normalize(-p)), 0.0); float s = gl_FrontFacing ? 0.12 + 0.88 * d : 0.08; o = vec4(c * mix(1.0, s, lit), 1.0); }`,
  });
}

function line(points, colour, width, dashed) {
  const made = new THREE.LineSegments2(new THREE.LineSegmentsGeometry().setPositions(points.flat().map((x, k) => x - data.centre[k % 3])), new THREE.LineMaterial({ color: new THREE.Color(colour), linewidth: width, dashed, dashSize: 0.01, gapSize: 0.006 }));
  if (dashed) made.computeLineDistances();
  lines.push(made.material);
  return made;
}

// A camera as a small pyramid: its place, and the four corners of what it sees, so far away that it does not hide the model.
function pyramid(view, colour) {
  const H = view.H, at = [0, 1, 2].map((k) => H[k][3]), place = (x, y, z) => [0, 1, 2].map((k) => H[k][0] * x + H[k][1] * y + H[k][2] * z + H[k][3]);
  const z = 0.18 * data.radius * 2, corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([i, j]) => place(i * z * data.half[0], j * z * data.half[1], z)), points = [];
  corners.forEach((corner, k) => points.push(at, corner, corner, corners[(k + 1) % 4]));
  return line(points, colour, 1.4, false);
}

// How far from the model's middle the views and the stops to come stand at most: zooming out ends beyond them.
function around() {
  return Math.max(data.radius, ...[...data.views, ...data.next].map((one) => Math.hypot(one.H[0][3], one.H[1][3], one.H[2][3])));
}

function beside() {
  for (const old of space.children.filter((one) => one !== mesh)) space.remove(old);
  lines = [];
  if (state.layers.views) for (const view of data.views) space.add(pyramid(view, view.used ? "#8fbbe8" : "#e07a5f"));
  const used = data.views.filter((view) => view.used).map((view) => [0, 1, 2].map((k) => view.H[k][3]));
  if (state.layers.path && used.length > 1) space.add(line(used.slice(1).flatMap((p, k) => [used[k], p]), "#5f6b78", 1.2, true));
  if (state.layers.next) for (const stop of data.next) space.add(pyramid(stop, "#f0c766"));
}

function see() {
  const r = data.radius, up = new THREE.Vector3(...data.up);
  camera.up.copy(up); controls.target.set(0, 0, 0);
  camera.position.copy(new THREE.Vector3(...data.from).multiplyScalar(4.2 * r)); controls.update();
}

function draw() {
  waiting = false;
  const w = Math.max(1, canvas.clientWidth), h = Math.max(1, canvas.clientHeight), away = camera.position.length();
  gl.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2)); gl.setSize(w, h, false);
  for (const one of lines) one.resolution.set(w, h);
  camera.aspect = w / h; camera.near = Math.max(0.02 * data.radius, away - Math.max(12 * data.radius, 1.5 * around())); camera.far = away + Math.max(12 * data.radius, 1.5 * around()); camera.updateProjectionMatrix();
  gl.render(space, camera); overlay(w, h);
  document.documentElement.dataset.drawn = "yes";
}
const later = () => { if (!waiting && gl) { waiting = true; requestAnimationFrame(draw); } };

// What a place of the screen shows: the point, its normal, what is known of it.
function under(at) {
  const ray = new THREE.Raycaster();
  ray.setFromCamera(new THREE.Vector2(2 * at[0] - 1, 1 - 2 * at[1]), camera);
  const hit = ray.intersectObject(mesh)[0];
  if (!hit) return null;
  const corners = [hit.face.a, hit.face.b, hit.face.c], near = corners.reduce((best, k) => (far(k, hit.point) < far(best, hit.point) ? k : best));
  return { p: hit.point.toArray(), n: [0, 1, 2].map((c) => values.normal[3 * near + c]), sigma: metresOf(values.sigma[near]), apart: metresOf(values.apart[near]), seen: values.seen[near] };
}
const far = (k, p) => [p.x, p.y, p.z].reduce((sum, x, c) => sum + (x - values.position[3 * k + c]) ** 2, 0);
const dot3 = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

// d = |B - A|; each end is known along its normal, and what all distances are off by together counts in full.
function distanceOf(a, b) {
  const by = b.p.map((x, c) => x - a.p[c]), d = Math.hypot(...by), u = by.map((x) => x / Math.max(d, 1e-12));
  const own = Math.hypot(dot3(u, a.n) * a.sigma, dot3(u, b.n) * b.sigma), scale = d * data.scale;
  return { d, u, own, scale, sigma: Math.hypot(own, scale) };
}

// The model cut by the plane through both points that holds their mean normal, between them: pairs of places along the chord and above it.
function sectionOf(a, b) {
  const { d, u } = distanceOf(a, b), m = a.n.map((x, c) => x + b.n[c]), lean = dot3(m, u), up = m.map((x, c) => x - lean * u[c]), long = Math.hypot(...up) || 1, v = up.map((x) => x / long);
  const across = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]], V = data.vertices, side = new Float32Array(V), P = values.position, cuts = [];
  for (let k = 0; k < V; k++) side[k] = across[0] * (P[3 * k] - a.p[0]) + across[1] * (P[3 * k + 1] - a.p[1]) + across[2] * (P[3 * k + 2] - a.p[2]);
  for (let f = 0; f < data.faces; f++) {
    const c = [0, 1, 2].map((i) => values.faces[3 * f + i]), ends = [];
    for (let i = 0; i < 3; i++) {
      const s = c[i], t = c[(i + 1) % 3];
      if (side[s] < 0 === side[t] < 0) continue;
      const w = side[s] / (side[s] - side[t]), q = [0, 1, 2].map((x) => P[3 * s + x] + w * (P[3 * t + x] - P[3 * s + x])), by = q.map((x, i2) => x - a.p[i2]);
      ends.push({ p: q, along: dot3(by, u), above: dot3(by, v), sigma: metresOf(Math.max(values.sigma[s], values.sigma[t])), facing: dot3([0, 1, 2].map((x) => values.normal[3 * s + x]), v) });
    }
    if (ends.length === 2 && ends.every((e) => e.along >= -1e-4 && e.along <= d + 1e-4 && e.facing > 0)) cuts.push(ends);
  }
  return cuts;
}

function chartOf(cuts) {
  const W = 240, H = 120, L = 34, B = 22, T = 8, every = cuts.flat(), xs = every.map((e) => 1000 * e.along), ys = every.flatMap((e) => [1000 * (e.above - e.sigma), 1000 * (e.above + e.sigma)]);
  const x0 = Math.min(...xs), x1 = Math.max(...xs), y0 = Math.min(...ys), y1 = Math.max(...ys), X = (e) => (L + ((1000 * e.along - x0) / Math.max(x1 - x0, 1e-9)) * (W - L - 4)).toFixed(1), Y = (m) => (T + ((y1 - 1000 * m) / Math.max(y1 - y0, 1e-9)) * (H - T - B)).toFixed(1);
  const band = cuts.map(([e, f]) => `<path class="band" d="M${X(e)} ${Y(e.above + e.sigma)}L${X(f)} ${Y(f.above + f.sigma)}L${X(f)} ${Y(f.above - f.sigma)}L${X(e)} ${Y(e.above - e.sigma)}Z"/>`);
  const run = `<path class="run" d="${cuts.map(([e, f]) => `M${X(e)} ${Y(e.above)}L${X(f)} ${Y(f.above)}`).join("")}"/>`, text = (t, x, y, anchor) => `<text x="${x}" y="${y}" text-anchor="${anchor}">${t}</text>`;
  return `<svg viewBox="0 0 ${W} ${H}" role="img" aria-label="section: height above the chord against the way along it, mm">${band.join("")}${run}${text(y1.toFixed(1), L - 4, T + 8, "end")}${text(y0.toFixed(1), L - 4, H - B, "end")}${text(`${x1.toFixed(1)} mm`, W - 4, H - 8, "end")}</svg>`;
}

function measured() {
  section = null; find("section").innerHTML = "";
  find("found").textContent = picked.length ? "pick the second point" : "pick two points on the model";
  find("clear").hidden = find("save-section").hidden = picked.length < 2;
  if (picked.length === 2) {
    const { d, own, scale, sigma } = distanceOf(...picked), digits = Math.max(0, Math.min(4, 1 - Math.floor(Math.log10(1000 * Math.max(sigma, 1e-7)))));
    find("found").innerHTML = `<b>${(1000 * d).toFixed(digits)} ± ${say(sigma, digits)}</b><br>ends ${say(own, digits)}, scale ${say(scale, digits)}`;
    section = sectionOf(...picked);
    if (section.length > 1) find("section").innerHTML = chartOf(section);
  }
  later();
}

function overlay(w, h) {
  const box = find("over"), screen = (p) => { const q = new THREE.Vector3(...p).project(camera); return [((q.x + 1) / 2) * w, ((1 - q.y) / 2) * h]; };
  box.setAttribute("viewBox", `0 0 ${w} ${h}`);
  const cut = section ? `<path d="${section.map((pair) => `M${pair.map((e) => screen(e.p).map((x) => x.toFixed(1)).join(" ")).join("L")}`).join("")}"/>` : "";
  box.innerHTML = cut + picked.map((one, k) => { const [x, y] = screen(one.p); return `<circle cx="${x}" cy="${y}" r="5"/><text x="${x + 9}" y="${y - 8}">${"AB"[k]}</text>`; }).join("");
}

function readout(at) {
  const hit = under(at);
  find("readout").textContent = hit ? `${hit.p.map((x, c) => (1000 * (x + data.centre[c])).toFixed(1)).join(", ")} mm   ± ${say(hit.sigma)}   ${hit.seen} views${hit.apart ? `, ${say(hit.apart)} apart` : ""}` : "";
}

function show() {
  for (const key of ["does", "mode"]) for (const button of all(`button[data-${key}]`)) button.setAttribute("aria-pressed", String(button.dataset[key] === state[key]));
  canvas.dataset.does = state.does; find("measure").hidden = state.does !== "measure";
  later();
}

function turn(yaw, pitch) {
  const by = camera.position.clone().sub(controls.target), side = new THREE.Vector3().crossVectors(camera.up, by).normalize(), polar = by.angleTo(camera.up), next = Math.max(0.05, Math.min(3.09, polar + pitch));
  by.applyQuaternion(new THREE.Quaternion().setFromAxisAngle(side, next - polar)).applyQuaternion(new THREE.Quaternion().setFromAxisAngle(camera.up, yaw));
  camera.position.copy(controls.target).add(by); controls.update(); later();
}
function zoom(k) { const by = camera.position.clone().sub(controls.target); by.multiplyScalar(1 / k); camera.position.copy(controls.target).add(by); controls.update(); later(); }
function saved(text, name) { const link = document.createElement("a"); link.href = URL.createObjectURL(new Blob([text], { type: "text/csv" })); link.download = name; link.click(); }

function hands() {
  let down = null;
  const place = (event) => { const box = canvas.getBoundingClientRect(); return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height]; };
  canvas.addEventListener("pointerdown", (event) => { down = [event.clientX, event.clientY]; });
  canvas.addEventListener("pointerup", (event) => {
    if (state.does !== "measure" || !down || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4) return;
    const hit = under(place(event));
    if (hit) { picked = picked.length === 1 ? [picked[0], hit] : [hit]; measured(); }
  });
  let last = 0;
  canvas.addEventListener("pointermove", (event) => { const now = performance.now(); if (!event.buttons && now - last > 120) { last = now; readout(place(event)); } });
  canvas.addEventListener("dblclick", () => { if (state.does === "turn") see(); });
  document.addEventListener("keydown", (event) => {
    const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "INPUT" || (event.key === "Enter" && event.target !== canvas)) return;
    if (move) turn(-0.08 * move[0], -0.08 * move[1]);
    else if (event.key === "+" || event.key === "=") zoom(1.15);
    else if (event.key === "-") zoom(1 / 1.15);
    else if (event.key === "0" || event.key === "Home") see();
    else if (event.key === "m" || event.key === "t") { state.does = event.key === "m" ? "measure" : "turn"; show(); }
    else if (event.key === "Enter" && state.does === "measure") { const hit = under([0.5, 0.5]); if (hit) { picked = picked.length === 1 ? [picked[0], hit] : [hit]; measured(); } }
    else if (event.key === "Escape") { picked = []; measured(); }
    else return;
    event.preventDefault();
  });
  document.addEventListener("click", (event) => {
    const button = event.target.closest("button");
    if (button && button.dataset.mode) { state.mode = button.dataset.mode; colours(); show(); }
    else if (button && button.dataset.does) { state.does = button.dataset.does; show(); }
  });
  for (const input of all("[data-layer]")) input.addEventListener("change", () => { state.layers[input.dataset.layer] = input.checked; beside(); later(); });
  find("reset").addEventListener("click", see); find("nearer").addEventListener("click", () => zoom(1.25)); find("further").addEventListener("click", () => zoom(0.8));
  find("clear").addEventListener("click", () => { picked = []; measured(); });
  find("save-section").addEventListener("click", () => saved(["along_mm,above_mm,sigma_mm", ...section.flat().sort((a, b) => a.along - b.along).map((e) => [e.along, e.above, e.sigma].map((x) => (1000 * x).toFixed(4)).join(","))].join("\n") + "\n", `${data.name}_section.csv`));
}

async function begin() {
  (0, eval)(new TextDecoder().decode(await inflated(find("three").textContent)));
  values = await unpacked();
  gl = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
  gl.setClearColor(0x0d0f12);
  space = new THREE.Scene(); camera = new THREE.PerspectiveCamera(28, 1, 0.01, 10);
  const shape = new THREE.BufferGeometry();
  shape.setAttribute("position", new THREE.BufferAttribute(values.position, 3)); shape.setAttribute("normal", new THREE.BufferAttribute(values.normal, 3)); shape.setIndex(new THREE.BufferAttribute(values.faces, 1));
  mesh = new THREE.Mesh(shape, material()); space.add(mesh);
  controls = new THREE.OrbitControls(camera, canvas); controls.addEventListener("change", later);
  controls.minDistance = 0.2 * data.radius; controls.maxDistance = Math.max(20 * data.radius, 5 * around());
  colours(); beside(); see(); hands(); show();
  new ResizeObserver(later).observe(canvas);
}

begin().catch((error) => { find("message").textContent = `Not drawn here: ${error.message}. The meshes beside this page hold all of it.`; find("message").hidden = false; document.documentElement.dataset.drawn = "no"; });
