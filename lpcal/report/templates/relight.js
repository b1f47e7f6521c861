// The page: what pointers, keys and controls do to the light, the view and the measurement, and when it draws.
const find = (id) => document.getElementById(id), all = (what) => [...document.querySelectorAll(what)];
const data = JSON.parse(find("data").textContent), canvas = find("view");
const START = { does: "light", mode: "lit", distance: 0.42, exposure: 0, gloss: 0, chosen: null, azimuth: 135, elevation: 8, bent: 0, ofDepth: false };
const state = { ...START, shadows: true, pointer: null, touched: false };
const UNIT = data.perspective ? { name: "mm", k: 1000, digits: 1 } : { name: "px", k: 1, digits: 1 };
// How a moving picture is thinned where frames take longer than 33 ms: shares of the screen's pixels, steps of a shadow, screen pixels a cell.
// A processor takes some microseconds a triangle: there the cells are large, and each pixel's own normal carries the relief.
const MOVING = [[1, 44, 2.5], [1, 16, 3], [1, 0, 4], [0.75, 0, 12], [0.55, 0, 16], [0.4, 0, 16]], RESTING_MS = 260, MOST_RESTING_MS = 1500, LONGEST_MS = 32, SHORTEST_MS = 15;
let surface, renderer, camera, controls, begun = 0, waiting = false, stirred = false, moved = -1e9, rest = 0, pace = { last: 0, mean: 25, level: 0, frames: 0 }, picked = [], section = null;

const apart = () => surface.radius * 0.12 * Math.pow(66, state.distance);
const millimetres = (metres, digits = UNIT.digits) => `${(UNIT.k * metres).toFixed(digits)} ${UNIT.name}`;
const clamp = (x, low, high) => Math.max(low, Math.min(high, x));

// The view: the camera's own at first, turned about the surface's middle.
function look() {
  const flat = !data.perspective || !renderer.turns;
  if (!renderer.turns) return;
  const up = new THREE.Vector3(0, -1, 0);
  camera = flat ? new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 10) : new THREE.PerspectiveCamera(40, 1, 0.01, 10);
  camera.up.copy(up);
  controls = new THREE.OrbitControls(camera, canvas);
  controls.enableDamping = false; controls.zoomToCursor = true; controls.screenSpacePanning = true; controls.rotateSpeed = 0.8;
  controls.minPolarAngle = 0.02; controls.maxPolarAngle = Math.PI - 0.02; controls.minZoom = 0.3; controls.maxZoom = 60;
  front();
  controls.addEventListener("change", () => { state.touched = true; stir(); });
}

function front() {
  if (!renderer.turns) return;
  const c = new THREE.Vector3(...surface.centre);
  camera.position.copy(data.perspective ? new THREE.Vector3(0, 0, 0) : c.clone().add(new THREE.Vector3(0, 0, -6 * surface.size)));
  camera.zoom = 1;
  controls.target.copy(c); fit(); controls.update();
  controls.minDistance = 0.05 * surface.size; controls.maxDistance = Math.max(20 * surface.size, 3 * c.length());
}

function fit() {
  const w = Math.max(1, canvas.clientWidth), h = Math.max(1, canvas.clientHeight), [a, b] = surface.half, tall = Math.max(b, (a * h) / w) / 0.84;
  if (camera.isPerspectiveCamera) { camera.aspect = w / h; camera.fov = (360 / Math.PI) * Math.atan(tall / Math.max(surface.front, 1e-9)); }
  else Object.assign(camera, { left: (-tall * w) / h, right: (tall * w) / h, top: tall, bottom: -tall });
  const away = camera.position.distanceTo(new THREE.Vector3(...surface.centre)), reach = 1.6 * surface.size + (state.bent && data.bend ? data.bend.strength * surface.middle : 0);
  camera.near = Math.max(away - reach, 0.01 * surface.size); camera.far = away + reach;
  camera.updateProjectionMatrix();
}

function turn(yaw, pitch) {
  const by = camera.position.clone().sub(controls.target), up = camera.up, side = new THREE.Vector3().crossVectors(up, by).normalize();
  const polar = by.angleTo(up), next = clamp(polar + pitch, 0.03, Math.PI - 0.03);
  by.applyQuaternion(new THREE.Quaternion().setFromAxisAngle(side, next - polar)).applyQuaternion(new THREE.Quaternion().setFromAxisAngle(up, yaw));
  camera.position.copy(controls.target).add(by); controls.update(); stir();
}

function pan(x, y) {
  const scale = camera.isPerspectiveCamera ? camera.position.distanceTo(controls.target) * Math.tan((camera.fov * Math.PI) / 360) : (camera.top - camera.bottom) / (2 * camera.zoom);
  const right = new THREE.Vector3().setFromMatrixColumn(camera.matrix, 0), up = new THREE.Vector3().setFromMatrixColumn(camera.matrix, 1), by = right.multiplyScalar(x * scale).add(up.multiplyScalar(y * scale));
  camera.position.add(by); controls.target.add(by); controls.update(); stir();
}

function zoom(k) {
  if (camera.isPerspectiveCamera) { const by = camera.position.clone().sub(controls.target); by.setLength(clamp(by.length() / k, controls.minDistance, controls.maxDistance)); camera.position.copy(controls.target).add(by); }
  else { camera.zoom = clamp(camera.zoom * k, controls.minZoom, controls.maxZoom); camera.updateProjectionMatrix(); }
  controls.update(); stir();
}

// The pointer's light: over the place it points at, `apart` before the surface's front, on the viewer's side; as bright on its middle at any distance.
function pointerLight() {
  const at = state.pointer || [0.34, 0.2], lift = surface.middle - surface.front + apart();
  let p, back;
  if (renderer.turns) {
    back = camera.getWorldDirection(new THREE.Vector3()).negate();
    const near = new THREE.Vector3(2 * at[0] - 1, 1 - 2 * at[1], -1).unproject(camera), ray = new THREE.Vector3(2 * at[0] - 1, 1 - 2 * at[1], 1).unproject(camera).sub(near).normalize();
    const far = new THREE.Vector3(...surface.centre).sub(near).dot(back) / ray.dot(back);
    p = near.addScaledVector(ray, far); back = back.toArray(); p = p.toArray();
  } else { p = pointAt(surface, at[0] * surface.w, at[1] * surface.h, surface.middle); back = [0, 0, -1]; }
  return [{ source: [...p.map((x, c) => x + lift * back[c]), 1], axis: [0, 0, 1, -1], power: [1, 1, 1].map(() => lift * lift) }];
}

// A distant light that grazes the surface's mean plane; azimuth from the image's right, counted counter-clockwise.
function rakingLight() {
  const n = surface.facing, a = (state.azimuth * Math.PI) / 180, e = (state.elevation * Math.PI) / 180, want = [Math.cos(a), -Math.sin(a), 0];
  const lean = dot3(want, n), flat = want.map((x, c) => x - lean * n[c]), length = Math.hypot(...flat) || 1;
  return [{ source: [...flat.map((x, c) => (Math.cos(e) * x) / length + Math.sin(e) * n[c]), 0], axis: [0, 0, 1, -1], power: [1.3, 1.3, 1.3] }];
}

function calibratedLights(chosen) {
  const rows = data.lights.filter((l) => l.lobe);
  const strength = (l) => {
    if (!l.source) return Math.max(...l.intensity);
    const d = l.source.map((x, c) => x - surface.centre[c]);
    return Math.max(...l.intensity) / dot3(d, d);
  };
  const unit = chosen.length > 1 ? chosen.reduce((sum, l) => sum + strength(l), 0) : 1.15 * Math.max(...data.lights.map(strength));
  return chosen.slice(0, MOST_LIGHTS).map((l) => ({ source: l.source ? [...l.source, 1] : [...l.direction, 0], axis: l.source ? [...l.axis, rows.indexOf(l)] : [0, 0, 1, -1], power: l.intensity.map((x) => x / unit) }));
}

function lights() {
  if (state.chosen === null) return pointerLight();
  if (state.chosen === "raking") return rakingLight();
  if (state.chosen !== "all") return calibratedLights([data.lights[state.chosen]]);
  const every = Math.ceil(data.lights.length / MOST_LIGHTS);
  return calibratedLights(data.lights.filter((_, k) => k % every === 0));
}

function draw(time) {
  waiting = false;
  // What moves is drawn as moving however late its frame comes: a machine that is busy must not be given its longest pictures.
  const now = performance.now(), resting = clamp(4 * pace.mean, RESTING_MS, MOST_RESTING_MS), moving = stirred || now - moved < resting, screen = Math.min(window.devicePixelRatio || 1, 2);
  stirred = false;
  if (moving && time && now - pace.last < 10000) {
    pace.mean += 0.2 * (now - pace.last - pace.mean); pace.frames++;
    if (pace.mean > LONGEST_MS && (pace.frames > 4 || pace.mean > 4 * LONGEST_MS) && pace.level < MOVING.length - 1) { pace.level = pace.mean > 4 * LONGEST_MS ? MOVING.length - 1 : pace.level + 1; pace.frames = 0; pace.mean = 25; }
    else if (pace.mean < SHORTEST_MS && pace.frames > 60 && pace.level > 0) { pace.level--; pace.frames = 0; pace.mean = 25; }
  }
  pace.last = now;
  const [share, steps, cellPx] = moving ? MOVING[pace.level] : [1, renderer.soft ? 12 : 44, renderer.soft ? 4 : 2];
  const width = Math.max(1, canvas.clientWidth), height = Math.max(1, canvas.clientHeight), step = niceStep((data.depth[1] - data.depth[0]) / 24);
  if (renderer.turns) fit();
  const done = renderer.draw({ ...state, camera, lights: lights(), width, height, moving, ratio: share * screen, shadows: state.shadows ? steps : 0, cellPx, exposure: 2 ** state.exposure, contour: step });
  legend(step); overlay();
  viewer.frames++;
  clearTimeout(rest);
  if (!done) later(); else if (moving) rest = setTimeout(later, resting + 20);
  document.documentElement.dataset.rest = String(done && !moving);
  return done;
}

function later() { if (!waiting && renderer) { waiting = true; requestAnimationFrame(draw); } }
function stir() { moved = performance.now(); stirred = true; document.documentElement.dataset.rest = "false"; later(); }
// The picture as it is at rest, at once.
function still() { do { moved = -1e9; stirred = false; } while (!draw(0)); }
function niceStep(raw) { const power = 10 ** Math.floor(Math.log10(raw)); return [1, 2, 5, 10].map((k) => k * power).find((s) => s >= raw * 0.999); }

function legend(step) {
  const box = find("legend"), palette = PALETTES[state.mode];
  box.hidden = !palette;
  if (!palette) return;
  const [low, high] = box.querySelectorAll("span"), most = data.depthSigma.least * 2 ** (renderer.span / data.depthSigma.scale);
  box.querySelector("i").style.background = `linear-gradient(90deg, ${palette.join(", ")})`;
  const ends = { depth: [millimetres(data.depth[0]), millimetres(data.depth[1])], depthSigma: [millimetres(data.depthSigma.least, 3), millimetres(most, 3)] }[state.mode] || ["0°", `${SIGMA_STOP}° or more`];
  [low.textContent, high.textContent] = ends;
  box.title = { depth: `a line every ${millimetres(step)}`, sigma: "standard deviation of the normal, per axis", depthSigma: "standard deviation of the depth's shape, each colour twice the one before", apart: "angle between the measured normals and those of the depth" }[state.mode];
}

// Pixels of the image that a place of the screen shows, in the maps' own pixels; null beside the surface.
function seen(at) { return renderer.under(2 * at[0] - 1, 1 - 2 * at[1], camera); }

function readout(at) {
  const px = at && seen(at);
  if (!px) { find("readout").textContent = ""; return; }
  const k = px[1] * surface.w + px[0], n = normalAt(surface, k), said = coarseAt(surface, ...px), tilt = (Math.acos(clamp(-n[2], -1, 1)) * 180) / Math.PI;
  const where = imagePlace(surface, ...px).map((x, c) => Math.round(x) + data.origin[c]);
  find("readout").textContent = `pixel ${where.join(", ")}   depth ${millimetres(depthOf(surface, k))}   tilt ${tilt.toFixed(1)}°` + (said.sigmaDeg > 0 ? ` ± ${said.sigmaDeg.toFixed(1)}°` : "") + (said.used ? `   ${said.used} lights` : "");
}

function pick(at) {
  const px = seen(at);
  if (!px) return;
  picked = picked.length === 1 ? [picked[0], placed(surface, px)] : [placed(surface, px)];
  measured();
}

function measured() {
  section = null;
  find("section").innerHTML = ""; find("found").textContent = picked.length ? "pick the second point" : "pick two points on the surface";
  find("save-section").hidden = find("clear").hidden = picked.length < 2;
  if (picked.length === 2) {
    const { d, sigma, shape, scale, known } = distanceOf(...picked), digits = sigma > 0 ? clamp(1 - Math.floor(Math.log10(UNIT.k * sigma)), 0, 4) : 2, say = (x) => (UNIT.k * x).toFixed(digits);
    find("found").innerHTML = `<b>${say(d)}${sigma > 0 ? ` ± ${say(sigma)}` : ""} ${UNIT.name}</b>` + (sigma > 0 && scale > 0 ? `<br>shape ${known ? say(shape) : "not known"}, scale ${say(scale)}` : "");
    section = sectionOf(surface, ...picked);
    find("section").innerHTML = chartOf(section, UNIT);
  }
  viewer.measured = picked.length === 2 ? distanceOf(...picked) : null;
  overlay();
}

// What is picked and the section's line, drawn over the picture.
function overlay() {
  const box = find("over"), w = canvas.clientWidth, h = canvas.clientHeight;
  if (!picked.length || !renderer.turns) { box.innerHTML = ""; return; }
  const screen = (p) => { const q = new THREE.Vector3(...bentPoint(p)).project(camera); return [((q.x + 1) / 2) * w, ((1 - q.y) / 2) * h].map((x) => x.toFixed(1)).join(" "); };
  box.setAttribute("viewBox", `0 0 ${w} ${h}`);
  const lines = section ? runsOf(section).map((run) => `<path d="M${run.map((r) => screen(r.p)).join("L")}"/>`) : [];
  box.innerHTML = lines.join("") + picked.map((one, k) => { const [x, y] = screen(one.p).split(" "); return `<circle cx="${x}" cy="${y}" r="5"/><text x="${Number(x) + 9}" y="${Number(y) - 8}">${"AB"[k]}</text>`; }).join("");
}
const bentPoint = (p) => p;

function press(group, key, value) { for (const button of all(`button${group}`)) button.setAttribute("aria-pressed", String(button.dataset[key] === String(value))); }

function show() {
  press("[data-does]", "does", state.does); press("[data-mode]", "mode", state.mode); press("[data-light]", "light", state.chosen === null ? "pointer" : state.chosen);
  press("[data-shape]", "shape", state.bentGoal ?? state.bent); press("[data-normals]", "normals", state.ofDepth ? "depth" : "measured");
  canvas.dataset.does = state.does;
  find("raking").hidden = state.chosen !== "raking"; find("measure").hidden = state.does !== "measure";
  find("distance-row").hidden = state.chosen !== null;
  for (const key of ["distance", "exposure", "gloss", "azimuth", "elevation"]) find(key).value = state[key];
  find("distance-out").textContent = millimetres(apart());
  find("exposure-out").textContent = (state.exposure > 0 ? "+" : state.exposure < 0 ? "−" : "") + Math.abs(state.exposure).toFixed(1);
  find("gloss-out").textContent = state.gloss.toFixed(2);
  find("azimuth-out").textContent = `${Math.round(state.azimuth)}°`; find("elevation-out").textContent = `${Math.round(state.elevation)}°`;
  if (controls) { controls.enableRotate = state.does !== "light"; controls.touches.ONE = state.does === "light" ? null : 0; }
  stir();
}

function set(changes) { Object.assign(state, { touched: true }, changes); show(); }

// The shape goes over in a third of a second, so that the eye sees what bends; at once where reduced motion is asked for.
function bend(goal) {
  const from = state.bent, start = performance.now(), still = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
  state.bentGoal = goal;
  const step = () => { const t = still ? 1 : Math.min(1, (performance.now() - start) / 350); if (state.bentGoal !== goal) return; set({ bent: from + (goal - from) * t * t * (3 - 2 * t) }); if (t < 1) requestAnimationFrame(step); };
  step();
}

function reset() { picked = []; measured(); set({ ...START, does: state.does, mode: state.mode, bentGoal: 0, pointer: null }); front(); }

function rake(at) { const x = at[0] - 0.5, y = 0.5 - at[1]; set({ azimuth: (((Math.atan2(y, x) * 180) / Math.PI) + 360) % 360, elevation: clamp(45 * (1 - 2 * Math.hypot(x, y)), 1, 45) }); }

function pointers() {
  const held = new Map();
  let down = null, hover = null, looking = false;
  const place = (event) => { const box = canvas.getBoundingClientRect(); return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height]; };
  const light = (at) => (state.chosen === "raking" ? rake(at) : set({ pointer: at, chosen: null }));
  canvas.addEventListener("pointerdown", (event) => {
    held.set(event.pointerId, place(event)); down = [event.clientX, event.clientY];
    if (!renderer.turns) canvas.setPointerCapture(event.pointerId);
    if (state.does === "light" && held.size === 1 && event.button === 0 && !event.shiftKey) light(place(event));
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => {
    const still = down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 5;
    held.delete(event.pointerId);
    if (end === "pointerup" && still && state.does === "measure" && event.button === 0) pick(place(event));
  });
  canvas.addEventListener("pointermove", (event) => {
    const at = place(event), pressed = held.has(event.pointerId);
    hover = at;
    if (!looking) { looking = true; requestAnimationFrame(() => { looking = false; readout(hover); }); }
    if (state.does !== "light" || held.size > 1 || (pressed && event.buttons !== 1) || event.shiftKey) return;
    if (pressed || (event.pointerType === "mouse" && state.chosen === null && !event.buttons)) light(at);
  });
  canvas.addEventListener("pointerleave", () => { hover = null; find("readout").textContent = ""; });
  canvas.addEventListener("wheel", (event) => {
    if (state.does !== "light" || event.ctrlKey || state.chosen !== null) return;
    event.preventDefault(); event.stopImmediatePropagation();
    set({ distance: clamp(state.distance + event.deltaY * 0.0006, 0, 1) });
  }, { passive: false });
  canvas.addEventListener("dblclick", reset);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  document.addEventListener("keydown", keys);
}

function keys(event) {
  const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key], tool = { l: "light", t: "turn", m: "measure" }[event.key];
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "INPUT" || (event.key === "Enter" && event.target !== canvas)) return;
  if (move && event.shiftKey) { if (camera) pan(0.06 * move[0], -0.06 * move[1]); }
  else if (move && state.does !== "light") { if (camera) turn(-0.08 * move[0], -0.08 * move[1]); }
  else if (move && state.chosen === "raking") set({ azimuth: (state.azimuth - 5 * move[0] + 360) % 360, elevation: clamp(state.elevation - 2 * move[1], 1, 45) });
  else if (move) { const at = state.pointer || [0.5, 0.5]; set({ pointer: [clamp(at[0] + 0.03 * move[0], 0, 1), clamp(at[1] + 0.03 * move[1], 0, 1)], chosen: null }); }
  else if (event.key === "+" || event.key === "=") { if (camera) zoom(1.15); }
  else if (event.key === "-") { if (camera) zoom(1 / 1.15); }
  else if (event.key === "0" || event.key === "Home") reset();
  else if (event.key === "Escape") { picked = []; measured(); }
  else if (event.key === "Enter" && state.does === "measure") pick([0.5, 0.5]);
  else if (tool && (tool === "light" || renderer.turns)) set({ does: tool });
  else return;
  event.preventDefault();
}

function saved(href, name) { const link = document.createElement("a"); link.href = href; link.download = name; link.click(); }

function controlsOf() {
  for (const [key, change] of [["does", (v) => ({ does: v })], ["mode", (v) => ({ mode: v })], ["normals", (v) => ({ ofDepth: v === "depth" })], ["light", (v) => ({ chosen: v === "pointer" ? null : v === "raking" || v === "all" ? v : Number(v) })]])
    document.addEventListener("click", (event) => { const button = event.target.closest(`[data-${key}]`); if (button && button.tagName === "BUTTON") set(change(button.dataset[key])); });
  for (const button of all("[data-shape]")) button.addEventListener("click", () => bend(Number(button.dataset.shape)));
  for (const key of ["distance", "exposure", "gloss", "azimuth", "elevation"]) find(key).addEventListener("input", () => set({ [key]: Number(find(key).value) }));
  find("shadows").addEventListener("change", () => set({ shadows: find("shadows").checked }));
  find("reset").addEventListener("click", reset); find("nearer").addEventListener("click", () => camera && zoom(1.25)); find("further").addEventListener("click", () => camera && zoom(0.8));
  find("clear").addEventListener("click", () => { picked = []; measured(); });
  find("save").addEventListener("click", () => { still(); saved(canvas.toDataURL("image/png"), `${data.name}.png`); });
  find("save-section").addEventListener("click", () => saved(URL.createObjectURL(new Blob([csvOf(section, UNIT)], { type: "text/csv" })), `${data.name}_section.csv`));
  if (data.bend && renderer.turns) {
    find("shapes").hidden = false;
    find("bowl").textContent = `${data.bend.solved ? "solved so from the same images" : "predicted from the surface and the lights' field"}: ${millimetres(data.bend.bowl, 2)} rms off`;
  }
  if (!data.lights.length) return;
  const add = (box, value, label, title) => { const button = document.createElement("button"); button.type = "button"; button.dataset.light = value; button.textContent = label; button.title = title; if (!label) button.setAttribute("aria-label", title); box.append(button); return button; };
  find("map").hidden = false;
  const furthest = Math.max(...data.lights.map((l) => Math.hypot(l.direction[0], l.direction[1])), 1e-6);
  data.lights.forEach((light, k) => {
    const dot = add(find("map"), k, "", `as ${light.name} lit it`);
    dot.style.left = `${50 + (40 * light.direction[0]) / furthest}%`; dot.style.top = `${50 + (40 * light.direction[1]) / furthest}%`;
    if (data.lights.length <= 24) add(find("names"), k, light.name, `as ${light.name} lit it`);
  });
  add(find("names"), "all", "all", "all calibrated lights together");
}

// A view may be asked for in the address: relight.html#mode=normals&does=turn&yaw=0.6, #light=L0, #light=raking&azimuth=90, #shape=1
function asked() {
  let yaw = 0, pitch = 0;
  for (const [key, value] of new URLSearchParams(location.hash.slice(1))) {
    const light = data.lights.findIndex((l) => l.name === value), figure = Number(value);
    if (key === "light" && (light >= 0 || ["all", "raking"].includes(value))) state.chosen = light >= 0 ? light : value;
    else if ((key === "mode" && MODES.includes(value)) || (key === "does" && ["light", "turn", "measure"].includes(value))) state[key] = value;
    else if (key === "normals") state.ofDepth = value === "depth";
    else if (!Number.isFinite(figure)) continue;
    else if (["distance", "exposure", "gloss", "azimuth", "elevation"].includes(key)) state[key] = figure;
    else if (key === "shape" && data.bend) state.bent = state.bentGoal = clamp(figure, 0, 1);
    else if (key === "yaw") yaw = figure;
    else if (key === "pitch") pitch = figure;
    else if (key === "zoom" && camera) zoom(clamp(figure, 0.3, 60));
    else continue;
    state.touched = true;
  }
  if (camera && (yaw || pitch)) turn(yaw, pitch);
}

// Until someone takes it, the light goes round once, slowly; not where reduced motion is asked for, or where the processor draws.
function wander(time) {
  if (state.touched || renderer.soft || window.matchMedia("(prefers-reduced-motion: reduce)").matches) return;
  begun = begun || time;
  const t = (time - begun) / 2600 - 2.2;
  state.pointer = [0.5 + 0.3 * Math.cos(t), 0.46 + 0.3 * Math.sin(t)];
  stir();
  if (time - begun < 2600 * 2 * Math.PI) requestAnimationFrame(wander);
}

function message(text) { find("message").textContent = text; find("message").hidden = false; }

// The mean way in which the surface faces.
function facing() {
  const sum = [0, 0, 0], every = Math.max(1, Math.round((surface.w * surface.h) / 20000));
  for (let k = 0; k < surface.w * surface.h; k += every) if (surface.code[k]) normalAt(surface, k).forEach((x, c) => { sum[c] += x; });
  const length = Math.hypot(...sum);
  return length > 0 ? sum.map((x) => x / length) : [0, 0, -1];
}

async function refine() {
  if (!data.full || !renderer.turns) { viewer.level = "whole"; return; }
  if (document.readyState === "loading") await new Promise((go) => document.addEventListener("DOMContentLoaded", go));
  const maps = await wholeAside(all("script.band").map((s) => s.textContent), data.full, data.channels);
  for (const s of all("script.band")) s.remove();
  const fine = { ...surface, ...maps, w: data.full.width, h: data.full.height, step: data.full.step, pixel: (surface.pixel * data.full.step) / surface.step };
  surface = fine; picked = []; measured();
  renderer.take(fine); later();
  viewer.level = "whole";
}

const viewer = { frames: 0, level: "coarse", measured: null, state, pace, get drawn() { return renderer.drawn; }, get camera() { return camera; }, get surface() { return surface; }, redraw() { still(); }, frame() { draw(0); } };
window.viewer = viewer;

async function begin() {
  if (typeof DecompressionStream === "undefined") { message("This browser is too old to unpack the surface (no DecompressionStream); the still picture is all it can show."); return; }
  const [text, first] = await Promise.all([inflated(find("three").textContent), coarse(data)]);
  (0, eval)(new TextDecoder().decode(text));
  surface = first; Object.assign(surface, extent(surface)); surface.facing = facing();
  canvas.hidden = false;
  pointers();
  renderer = glRenderer(canvas, surface, await bendTexture(data));
  if (!renderer) { renderer = plainRenderer(canvas, surface); message("Drawn without WebGL2: no gloss, no shadows, no turning, no measuring."); for (const box of all(".gl")) box.hidden = true; }
  renderer.span = surface.coarse.depthSigma.reduce((m, x) => Math.max(m, x), 1) - 1;
  pace.level = renderer.soft ? 3 : 0;
  look(); asked(); controlsOf(); show(); draw(0);
  find("poster").hidden = true;
  new ResizeObserver(later).observe(canvas);
  requestAnimationFrame(wander);
  document.documentElement.dataset.ready = renderer.turns ? "webgl2" : "canvas";
  viewer.first = performance.now();
  await refine();
  document.documentElement.dataset.level = viewer.level;
}
begin().catch((error) => { canvas.hidden = true; find("poster").hidden = false; message(`The surface cannot be drawn here: ${error.message}`); console.error(error); });
