// The page: what the pointer, the wheel and the controls do to the light, and what is drawn.
const find = (id) => document.getElementById(id);
const data = JSON.parse(find("data").textContent), canvas = find("view");
const START = { does: "light", mode: "lit", distance: 0.42, exposure: 0, gloss: 0, yaw: 0, pitch: 0, zoom: 1, chosen: null };
const state = { ...START, shadows: true, pointer: null, touched: false };
let surface, renderer, begun = 0, waiting = false;

function apart() { return surface.radius * 0.12 * Math.pow(66, state.distance); }
function millimetres(metres) { return data.perspective ? `${(1000 * metres).toFixed(1)} mm` : `${metres.toFixed(1)} px`; }

function frame() {
  const width = canvas.width, height = canvas.height, scale = state.zoom * Math.min((0.84 * width) / surface.w, (0.84 * height) / surface.h);
  return { width, height, scale, x: (width - scale * surface.w) / 2, y: (height - scale * surface.h) / 2 };
}

// The pointer's light: over the place it points at, `apart` before the surface's front; as bright on its middle at any distance.
function pointerLight() {
  const f = frame(), at = state.pointer || [0.34 * f.width, 0.2 * f.height];
  const ray = rayAt(data, (at[0] - f.x) / f.scale - 0.5, (at[1] - f.y) / f.scale - 0.5);
  const lift = surface.middle - surface.front + apart(), p = pointAt(data, ray, surface.middle);
  return [{ source: [p[0], p[1], p[2] - lift, 1], axis: [0, 0, 1, -1], power: [1, 1, 1].map(() => lift * lift) }];
}

function calibratedLights(names) {
  const rows = data.lights.filter((l) => l.lobe);
  const strength = (l) => {
    if (!l.source) return Math.max(...l.intensity);
    const d = l.source.map((x, c) => x - surface.centre[c]), r2 = d[0] ** 2 + d[1] ** 2 + d[2] ** 2;
    return Math.max(...l.intensity) / r2;
  };
  const unit = names.length > 1 ? names.reduce((sum, l) => sum + strength(l), 0) : 1.15 * Math.max(...data.lights.map(strength));
  return names.slice(0, MOST_LIGHTS).map((l) => ({
    source: l.source ? [...l.source, 1] : [...l.direction, 0], axis: l.source ? [...l.axis, rows.indexOf(l)] : [0, 0, 1, -1], power: l.intensity.map((x) => x / unit),
  }));
}

function lights() {
  if (state.chosen === null) return pointerLight();
  if (state.chosen !== "all") return calibratedLights([data.lights[state.chosen]]);
  const every = Math.ceil(data.lights.length / MOST_LIGHTS);
  return calibratedLights(data.lights.filter((_, k) => k % every === 0));
}

function turned() {
  const cy = Math.cos(state.yaw), sy = Math.sin(state.yaw), cp = Math.cos(state.pitch), sp = Math.sin(state.pitch);
  const size = Math.max(surface.radius, (data.depth[1] - data.depth[0]) / 2), far = 4.2 * size;
  const matrix = [cy, 0, -sy, -sp * sy, cp, -sp * cy, cp * sy, sp, cp * cy];
  const f = state.zoom * 3.9 * Math.min(canvas.width, canvas.height);
  const eye = [0, 1, 2].map((c) => surface.centre[c] - far * matrix[6 + c]);
  return { matrix, lens: [f / canvas.width, f / canvas.height, far, 3 * size], eye: [...eye, 1] };
}

function draw() {
  waiting = false;
  const ratio = Math.min(window.devicePixelRatio || 1, 2), w = Math.max(1, Math.round(canvas.clientWidth * ratio)), h = Math.max(1, Math.round(canvas.clientHeight * ratio));
  if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
  const turn = turned(), step = niceStep((data.depth[1] - data.depth[0]) / 24);
  const eye = state.does === "turn" ? turn.eye : data.perspective ? [0, 0, 0, 1] : [0, 0, -1, 0];
  renderer.draw({ does: state.does, mode: state.mode, shadows: state.shadows, gloss: state.gloss, frame: frame(), lights: lights(), turn, eye, exposure: 2 ** state.exposure, contour: step });
  legend(step);
}

function later() { if (!waiting && renderer) { waiting = true; requestAnimationFrame(draw); } }
function niceStep(raw) { const power = 10 ** Math.floor(Math.log10(raw)); return [1, 2, 5, 10].map((k) => k * power).find((s) => s >= raw * 0.999); }

function legend(step) {
  const box = find("legend"), palette = PALETTES[state.mode];
  box.hidden = !palette;
  if (!palette) return;
  const [low, high] = box.querySelectorAll("span");
  box.querySelector("i").style.background = `linear-gradient(90deg, ${palette.join(", ")})`;
  low.textContent = state.mode === "depth" ? millimetres(data.depth[0]) : "0°";
  high.textContent = state.mode === "depth" ? millimetres(data.depth[1]) : `${SIGMA_STOP}° or more`;
  box.title = state.mode === "depth" ? `a line every ${millimetres(step)}` : "standard deviation of the normal, per axis";
}

function readout(x, y) {
  const f = frame(), px = Math.floor((x - f.x) / f.scale), py = Math.floor((y - f.y) / f.scale), k = py * surface.w + px;
  if (state.does === "turn" || px < 0 || py < 0 || px >= surface.w || py >= surface.h || !surface.mask[k]) { find("readout").textContent = ""; return; }
  const tilt = (Math.acos(Math.min(1, -surface.normal[3 * k + 2])) * 180) / Math.PI, sigma = 2 ** (surface.sigma[k] / data.sigmaScale) - 1;
  const where = [data.origin[0] + px * data.step, data.origin[1] + py * data.step];
  find("readout").textContent = `pixel ${where.join(", ")}   depth ${millimetres(surface.depth[k])}   tilt ${tilt.toFixed(1)}°` + (sigma > 0 ? ` ± ${sigma.toFixed(1)}°` : "") + (surface.used[k] ? `   ${surface.used[k]} lights` : "");
}

function press(group, key, value) { for (const button of document.querySelectorAll(group)) button.setAttribute("aria-pressed", String(button.dataset[key] === String(value))); }

function show() {
  press("[data-does]", "does", state.does); press("[data-mode]", "mode", state.mode); press("[data-light]", "light", state.chosen);
  canvas.classList.toggle("turn", state.does === "turn");
  for (const key of ["distance", "exposure", "gloss"]) find(key).value = state[key];
  find("distance-out").textContent = millimetres(apart());
  find("exposure-out").textContent = (state.exposure > 0 ? "+" : state.exposure < 0 ? "−" : "") + Math.abs(state.exposure).toFixed(1);
  find("gloss-out").textContent = state.gloss.toFixed(2);
  later();
}

function set(changes) { Object.assign(state, { touched: true }, changes); show(); }

function pointers() {
  const held = new Map();
  const place = (event) => { const box = canvas.getBoundingClientRect(), k = canvas.width / box.width; return [(event.clientX - box.left) * k, (event.clientY - box.top) * k]; };
  canvas.addEventListener("pointerdown", (event) => { held.set(event.pointerId, place(event)); canvas.setPointerCapture(event.pointerId); if (state.does === "light") set({ pointer: place(event), chosen: null }); });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => held.delete(event.pointerId));
  canvas.addEventListener("pointermove", (event) => {
    const at = place(event), last = held.get(event.pointerId);
    readout(...at);
    if (state.does === "turn") {
      if (!last) return;
      const k = 4 / Math.min(canvas.width, canvas.height);
      set({ yaw: state.yaw + k * (at[0] - last[0]), pitch: Math.max(-1.5, Math.min(1.5, state.pitch - k * (at[1] - last[1]))) });
      held.set(event.pointerId, at);
    } else if (last || (event.pointerType === "mouse" && state.chosen === null)) set({ pointer: at, chosen: null });
  });
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    if (event.ctrlKey || state.does === "turn") set({ zoom: Math.max(0.4, Math.min(12, state.zoom * Math.exp(-event.deltaY * (event.ctrlKey ? 0.006 : 0.0015)))) });
    else set({ distance: Math.max(0, Math.min(1, state.distance + event.deltaY * 0.0006)) });
  }, { passive: false });
  canvas.addEventListener("dblclick", () => set({ ...START, does: state.does, mode: state.mode, pointer: null }));
  canvas.addEventListener("keydown", (event) => {
    const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!move) return;
    event.preventDefault();
    if (state.does === "turn") { set({ yaw: state.yaw + 0.08 * move[0], pitch: Math.max(-1.5, Math.min(1.5, state.pitch - 0.08 * move[1])) }); return; }
    const at = state.pointer || [canvas.width / 2, canvas.height / 2], k = 0.02 * canvas.width;
    set({ pointer: [at[0] + k * move[0], at[1] + k * move[1]], chosen: null });
  });
}

function controls() {
  for (const button of document.querySelectorAll("[data-does]")) button.addEventListener("click", () => set({ does: button.dataset.does }));
  for (const button of document.querySelectorAll("[data-mode]")) button.addEventListener("click", () => set({ mode: button.dataset.mode }));
  for (const key of ["distance", "exposure", "gloss"]) find(key).addEventListener("input", () => set({ [key]: Number(find(key).value) }));
  find("shadows").addEventListener("change", () => set({ shadows: find("shadows").checked }));
  find("save").addEventListener("click", () => { draw(); const link = document.createElement("a"); link.href = canvas.toDataURL("image/png"); link.download = `${data.name}.png`; link.click(); });
  if (!data.lights.length) return;
  find("panel").hidden = false;
  const add = (box, value, label, title) => { const button = document.createElement("button"); button.type = "button"; button.dataset.light = value; button.textContent = label; button.title = title; button.setAttribute("aria-label", title); button.addEventListener("click", () => set({ chosen: value === "pointer" ? null : value })); box.append(button); return button; };
  const furthest = Math.max(...data.lights.map((l) => Math.hypot(l.direction[0], l.direction[1])), 1e-6);
  data.lights.forEach((light, k) => {
    const dot = add(find("map"), k, "", `as ${light.name} lit it`);
    dot.style.left = `${50 + (40 * light.direction[0]) / furthest}%`; dot.style.top = `${50 + (40 * light.direction[1]) / furthest}%`;
    if (data.lights.length <= 24) add(find("names"), k, light.name, `as ${light.name} lit it`);
  });
  add(find("names"), "all", "all", "all calibrated lights together");
}

// A view may be asked for in the address: relight.html#mode=normals&does=turn&yaw=0.6, #light=L0, #distance=0.2&gloss=0.7
function asked() {
  for (const [key, value] of new URLSearchParams(location.hash.slice(1))) {
    const light = data.lights.findIndex((l) => l.name === value);
    if (key === "light" && (light >= 0 || value === "all")) state.chosen = value === "all" ? value : light;
    else if ((key === "mode" && MODES.includes(value)) || (key === "does" && ["light", "turn"].includes(value))) state[key] = value;
    else if (["distance", "exposure", "gloss", "yaw", "pitch", "zoom"].includes(key) && Number.isFinite(Number(value))) state[key] = Number(value);
    else continue;
    state.touched = true;
  }
}

// Until someone takes it, the light goes round once, slowly; not where reduced motion is asked for.
function wander(time) {
  if (state.touched || window.matchMedia("(prefers-reduced-motion: reduce)").matches) return;
  begun = begun || time;
  const t = (time - begun) / 2600 - 2.2;
  state.pointer = [canvas.width * (0.5 + 0.3 * Math.cos(t)), canvas.height * (0.46 + 0.3 * Math.sin(t))];
  later();
  if (time - begun < 2600 * 2 * Math.PI) requestAnimationFrame(wander);
}

function message(text) { find("message").textContent = text; find("message").hidden = false; }

async function begin() {
  if (typeof DecompressionStream === "undefined") { message("This browser is too old to unpack the surface (no DecompressionStream); the still picture is all it can show."); return; }
  surface = await unpack(data);
  canvas.hidden = false;
  renderer = glRenderer(canvas, surface);
  if (!renderer) { renderer = plainRenderer(canvas, surface); message("Drawn without WebGL2: no gloss, no shadows, no turning."); find("does").hidden = true; }
  find("poster").hidden = true;
  asked(); pointers(); controls(); show(); draw();
  new ResizeObserver(later).observe(canvas);
  requestAnimationFrame(wander);
  document.documentElement.dataset.ready = renderer.turns ? "webgl2" : "canvas";
}
begin().catch((error) => { canvas.hidden = true; find("poster").hidden = false; message(`The surface cannot be drawn here: ${error.message}`); console.error(error); });
