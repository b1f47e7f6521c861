// Drawing in space with three.js: the surface by tiles and levels, the viewer's camera, and what is seen under a pointer.
// Largest levels, tiles that are kept, milliseconds a frame for building them (while a processor draws, between pictures), and the screen pixels of a
// coarse pixel up to which the coarse surface stands in for the whole one while a processor draws what moves.
const STRIDES = 8, KEPT = 700, BUILD_MS = 7, SLOW_BUILD_MS = 14, COARSE_PX = 3;

function software() {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) return null;
  const told = gl.getExtension("WEBGL_debug_renderer_info"), name = told ? gl.getParameter(told.UNMASKED_RENDERER_WEBGL) : "";
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

let soft = false;

function texture(values, w, h, format, type, filter, mips) {
  const made = new THREE.DataTexture(values, w, h, format, type);
  made.magFilter = filter; made.minFilter = !mips ? filter : soft ? THREE.LinearMipmapNearestFilter : THREE.LinearMipmapLinearFilter; made.generateMipmaps = mips;
  made.unpackAlignment = 1; made.needsUpdate = true;
  return made;
}

// Least squares of values (two columns) over terms of (u, v) or of rays, on a grid of 9 x 9 places; Gauss-Jordan.
function fitted(terms, rows) {
  const A = Array.from({ length: terms }, () => new Float64Array(terms + 2));
  for (const { row, value } of rows) for (let a = 0; a < terms; a++) { for (let b = 0; b < terms; b++) A[a][b] += row[a] * row[b]; A[a][terms] += row[a] * value[0]; A[a][terms + 1] += row[a] * value[1]; }
  for (let a = 0; a < terms; a++) {
    const best = A.slice(a).reduce((m, row, k) => (Math.abs(row[a]) > Math.abs(A[m][a]) ? k + a : m), a);
    [A[a], A[best]] = [A[best], A[a]];
    for (let b = 0; b < terms; b++) if (b !== a) { const f = A[b][a] / A[a][a]; for (let c = a; c < terms + 2; c++) A[b][c] -= f * A[a][c]; }
  }
  return A.map((row, a) => new THREE.Vector2(row[terms] / row[a], row[terms + 1] / row[a]));
}

function grid(surface) {
  const found = [];
  for (let j = 0; j < 9; j++) for (let i = 0; i < 9; i++) { const u = i / 8, v = j / 8; found.push({ u, v, ray: rayAt(surface.data, ...imagePlace(surface, u * surface.w - 0.5, v * surface.h - 0.5)) }); }
  return found;
}

// Where in the picture a point is seen, uv = c0 + c1 x + c2 y + (c3 x + c4 y) (x^2 + y^2) of its ray (x, y); and the ray of a place, a cubic.
function placing(surface) {
  const rows = grid(surface), terms = surface.data.perspective ? 5 : 3, zero = new THREE.Vector2();
  const place = fitted(terms, rows.map(({ u, v, ray: [x, y] }) => ({ row: [1, x, y, x * (x * x + y * y), y * (x * x + y * y)].slice(0, terms), value: [u, v] })));
  const rays = fitted(10, rows.map(({ u, v, ray }) => ({ row: [1, u, v, u * u, u * v, v * v, u ** 3, u * u * v, u * v * v, v ** 3], value: ray })));
  return { place: [...place, zero, zero].slice(0, 5), rays };
}

// The coarse maps of doubt, and the lobes of the calibrated lights.
function steadyTextures(surface) {
  const { w, h, sigma, depthSigma } = surface.coarse, doubt = new Uint8Array(2 * w * h);
  for (let k = 0; k < w * h; k++) { doubt[2 * k] = sigma[k]; doubt[2 * k + 1] = depthSigma[k]; }
  const lamps = surface.data.lights.filter((l) => l.lobe);
  return {
    doubt: texture(doubt, w, h, THREE.RGFormat, THREE.UnsignedByteType, THREE.LinearFilter, false),
    lobes: texture(new Float32Array(lamps.length ? lamps.flatMap((l) => l.lobe) : [1, 1]), lamps.length ? lamps[0].lobe.length : 2, Math.max(lamps.length, 1), THREE.RedFormat, THREE.FloatType, THREE.NearestFilter, false),
    depthSigmaSpan: Math.max(1, depthSigma.reduce((m, x) => Math.max(m, x), 0) - 1),
  };
}

async function bendTexture(data) {
  const b = data.bend;
  if (!b) return null;
  const [f, x, y] = planesOf(await inflated(b.planes), b.width, b.height, [true, true, true]), n = b.width * b.height, values = new Uint16Array(4 * n), half = halves(65536, -32768 / 32767, 1 / 32767);
  for (let k = 0; k < n; k++) if (f[k]) { values[4 * k] = half[f[k]]; values[4 * k + 1] = half[x[k]]; values[4 * k + 2] = half[y[k]]; values[4 * k + 3] = 0x3c00; }
  return texture(values, b.width, b.height, THREE.RGBAFormat, THREE.HalfFloatType, THREE.LinearFilter, false);
}

// The surface as a tree of tiles: each is drawn by its own triangles, or by its four children where a cell is larger on the screen than asked.
class Tiles {
  constructor(surface, material) {
    Object.assign(this, { surface, material, group: new THREE.Group(), nodes: new Map(), built: 0, waiting: 0, turn: 0 });
    let level = 0;
    while (TILE * 2 ** level < Math.max(surface.w, surface.h) - 1 && level < STRIDES) level++;
    this.top = level;
    this.cells = 0;
  }
  node(level, i, j) {
    const key = `${level}/${i}/${j}`;
    let node = this.nodes.get(key);
    if (!node) { node = { key, level, i, j, mesh: null, built: false, at: 0 }; this.nodes.set(key, node); }
    return node;
  }
  build(node) {
    const stride = 2 ** node.level, shape = tileShape(this.surface, node.i * TILE * stride, node.j * TILE * stride, stride);
    node.built = true;
    if (!shape) return;
    const made = new THREE.BufferGeometry(), used = [], low = [Infinity, Infinity, Infinity], high = low.map((x) => -x);
    made.setAttribute("position", new THREE.BufferAttribute(shape.position, 3)); made.setAttribute("cell", new THREE.BufferAttribute(shape.cell, 2)); made.setIndex(new THREE.BufferAttribute(shape.faces, 1));
    for (const k of shape.faces) for (let c = 0; c < 3; c++) { const x = shape.position[3 * k + c]; if (x < low[c]) low[c] = x; if (x > high[c]) high[c] = x; }
    const middle = low.map((x, c) => (x + high[c]) / 2);
    made.boundingSphere = new THREE.Sphere(new THREE.Vector3(...middle), Math.hypot(...low.map((x, c) => (high[c] - x) / 2)));
    node.mesh = new THREE.Mesh(made, this.material); node.mesh.visible = false; node.mesh.matrixAutoUpdate = false;
    this.group.add(node.mesh); this.built++;
  }
  drop(node) { this.group.remove(node.mesh); node.mesh.geometry.dispose(); node.mesh = null; node.built = false; this.built--; }
  // Chooses what is drawn from `eye` (null: parallel rays) with `focal` screen pixels a unit at distance 1, of what lies in the frustum `seen`; true when
  // all that is wanted is built.
  choose(eye, focal, cellPx, seen, buildMs) {
    const end = performance.now() + buildMs, wanted = [];
    this.turn++; this.cells = 0;
    for (const node of this.nodes.values()) if (node.mesh) node.mesh.visible = false;
    const ready = (node) => {
      if (!node.built && (performance.now() < end || node.level === this.top)) this.build(node);
      if (!node.built) wanted.push(node);
      return node.built;
    };
    const visit = (node) => {
      node.at = this.turn;
      const stride = 2 ** node.level, ball = node.mesh && node.mesh.geometry.boundingSphere;
      if (!ball || (seen && !seen.intersectsSphere(ball))) return;
      const away = eye ? Math.max(ball.center.distanceTo(eye) - ball.radius, this.surface.pixel) : 1;
      if (node.level > 0 && (stride * this.surface.pixel * focal) / away > cellPx) {
        const children = [0, 1, 2, 3].map((q) => this.node(node.level - 1, 2 * node.i + (q & 1), 2 * node.j + (q >> 1))).filter((n) => n.i * TILE * 2 ** n.level < this.surface.w - 1 && n.j * TILE * 2 ** n.level < this.surface.h - 1);
        if (children.map(ready).every(Boolean)) { children.forEach(visit); return; }
      }
      node.mesh.visible = true; this.cells += TILE * TILE;
    };
    const root = this.node(this.top, 0, 0);
    for (let j = 0; j * TILE * 2 ** this.top < this.surface.h - 1; j++) for (let i = 0; i * TILE * 2 ** this.top < this.surface.w - 1; i++) { const node = this.node(this.top, i, j); ready(node); visit(node); }
    if (this.built > KEPT) for (const node of [...this.nodes.values()].filter((n) => n.mesh && !n.mesh.visible && n !== root && n.at < this.turn - 30).sort((a, b) => a.at - b.at).slice(0, this.built - KEPT)) this.drop(node);
    return !wanted.length;
  }
  dispose() { for (const node of this.nodes.values()) if (node.mesh) this.drop(node); this.nodes.clear(); }
}

// A surface on the graphics side: its textures, its material (what all layers share comes as `common`) and its tiles.
class Layer {
  constructor(surface, common, bend) {
    const { w, h, data } = surface, value = (x) => ({ value: x }), found = placing(surface), k = surface.step, b = bend && data.bend;
    this.surface = surface;
    this.own = {
      geometry: value(texture(surface.geometry, w, h, THREE.RGBAFormat, THREE.HalfFloatType, THREE.LinearFilter, true)),
      paint: value(texture(surface.paint, w, h, THREE.RGBAFormat, THREE.UnsignedByteType, THREE.LinearFilter, true)),
      quickNormal: value(null), quickPaint: value(null),
      codes: value(texture(surface.code, w, h, THREE.RedIntegerFormat, THREE.UnsignedShortType, THREE.NearestFilter, false)),
      size: value(new THREE.Vector2(w, h)), pixel: value(surface.pixel), reach: value(2 * surface.radius), place: value(found.place), rays: value(found.rays),
      bendPlace: value(b ? new THREE.Vector4((w * k) / (b.step * b.width), (h * k) / (b.step * b.height), -b.offset[0] / (b.step * b.width), -b.offset[1] / (b.step * b.height)) : new THREE.Vector4(1, 1, 0, 0)),
    };
    this.own.codes.value.internalFormat = "R16UI";
    this.material = new THREE.RawShaderMaterial({ glslVersion: THREE.GLSL3, vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms: { ...common, ...this.own }, side: THREE.DoubleSide });
    this.tiles = new Tiles(surface, this.material);
  }
  // Normals and colours in 8 bit, each pixel's own, for the shader of what moves.
  quicken() {
    if (this.own.quickNormal.value) return;
    const { w, h, code, paint } = this.surface, normals = new Uint8Array(4 * w * h), nearest = (values) => {
      const made = texture(values, w, h, THREE.RGBAFormat, THREE.UnsignedByteType, THREE.NearestFilter, true);
      made.minFilter = THREE.NearestMipmapNearestFilter;
      return { value: made };
    };
    for (let k = 0; k < w * h; k++) if (code[k]) { const n = normalAt(this.surface, k); for (let c = 0; c < 3; c++) normals[4 * k + c] = Math.round(127.5 + 127.5 * n[c]); normals[4 * k + 3] = 255; }
    this.own.quickNormal.value = nearest(normals).value; this.own.quickPaint.value = nearest(paint).value;
  }
  define(defines) { if (JSON.stringify(defines) !== JSON.stringify(this.material.defines)) { this.material.defines = defines; this.material.needsUpdate = true; } }
  dispose() { this.tiles.dispose(); this.material.dispose(); for (const name of ["geometry", "paint", "codes", "quickNormal", "quickPaint"]) this.own[name].value?.dispose(); }
}

function glRenderer(canvas, first, bend) {
  soft = software();
  if (soft === null) return null;
  const data = first.data, gl = new THREE.WebGLRenderer({ canvas, antialias: !soft, alpha: true, powerPreference: "high-performance" });
  gl.debug.checkShaderErrors = true; gl.setClearColor(0, 0); gl.info.autoReset = true;
  const half = Math.max(data.depth[1] - data.depth[0], 1e-9) / 2, steady = steadyTextures(first);
  const value = (x) => ({ value: x }), blank = () => Array.from({ length: MOST_LIGHTS }, () => new THREE.Vector4());
  const u = {
    doubt: value(steady.doubt), lobes: value(steady.lobes), bend: value(bend), bendStrength: value(bend ? data.bend.strength : 0), bendTurn: value(bend ? data.bend.turn : 0), bent: value(0),
    count: value(0), steps: value(0), eye: value(new THREE.Vector4()), scale: value(new THREE.Vector3((data.depth[0] + data.depth[1]) / 2, half, 0.5)),
    source: value(blank()), axis: value(blank()), power: value(Array.from({ length: MOST_LIGHTS }, () => new THREE.Vector3())),
    exposure: value(1), gloss: value(0), lobeStop: value(data.lobeStop), contour: value(1), depthSigmaSpan: value(steady.depthSigmaSpan), palette: value([]),
  };
  function definesOf(state) {
    const defines = { MODE: MODES.indexOf(state.mode), SIGMA_SCALE: data.sigmaScale.toFixed(3) }, litMode = defines.MODE < 2;
    if (data.perspective) defines.PERSPECTIVE = 1;
    if (litMode && state.shadows) defines.SHADOWS = 1;
    if (litMode && state.gloss > 0) defines.GLOSS = 1;
    if (litMode && state.lights.some((l) => l.axis[3] >= 0)) defines.LOBES = 1;
    if (state.ofDepth && litMode | (state.mode === "normals")) defines.OF_DEPTH = 1;
    if (bend && state.bent > 0) defines.BENT = 1;
    if (soft && state.moving && litMode && !state.shadows && !(defines.OF_DEPTH || defines.BENT)) { defines.QUICK = 1; delete defines.GLOSS; }
    return defines;
  }
  const scene = new THREE.Scene(), overlay = new THREE.Scene(), caster = new THREE.Raycaster(), coarseLayer = new Layer(first, u, bend), seen = new THREE.Frustum(), along = new THREE.Matrix4();
  let whole = null, shown = coarseLayer, size = [0, 0, 0], drawnOnce = null;
  scene.add(coarseLayer.tiles.group);

  return {
    turns: true, soft, overlay,
    // The surface at full size; the coarse one stays, for what moves where the processor draws.
    take(surface) { whole = new Layer(surface, u, bend); scene.add(whole.tiles.group); },
    get drawn() { return { tiles: shown.tiles.built, triangles: gl.info.render.triangles, calls: gl.info.render.calls, textures: gl.info.memory.textures, level: shown === whole ? "whole" : "coarse" }; },
    // True where all is drawn as finely as asked; else there is more to build, and another frame is due.
    draw(state) {
      const { camera, lights, width, height, ratio } = state, perspective = camera.isPerspectiveCamera;
      const focal = perspective ? (height * ratio * camera.zoom) / (2 * Math.tan((camera.fov * Math.PI) / 360)) : (height * ratio * camera.zoom) / (camera.top - camera.bottom);
      const away = perspective ? Math.max(camera.position.distanceTo(new THREE.Vector3(...first.centre)) - first.size, 0.05 * first.size) : 1;
      const layer = whole && !(soft && state.moving && (first.pixel * focal) / away < COARSE_PX) ? whole : coarseLayer;
      camera.updateMatrixWorld();
      seen.setFromProjectionMatrix(along.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse));
      const done = layer.tiles.choose(perspective ? camera.position : null, focal, state.cellPx, state.bent > 0 ? null : seen, soft && !state.moving ? SLOW_BUILD_MS : BUILD_MS);
      // A picture that a processor draws takes longer than many tiles: it waits until they are all there.
      if (soft && !done && !state.moving && drawnOnce) return false;
      drawnOnce = true;
      if (width !== size[0] || height !== size[1] || ratio !== size[2]) { size = [width, height, ratio]; gl.setPixelRatio(ratio); gl.setSize(width, height, false); }
      shown = layer;
      for (const one of [coarseLayer, whole]) if (one) one.tiles.group.visible = one === layer;
      const defines = definesOf(state);
      if (defines.QUICK) { if (layer === coarseLayer) layer.quicken(); else delete defines.QUICK; }
      layer.define(defines);
      u.steps.value = state.shadows; u.exposure.value = state.exposure; u.gloss.value = state.gloss; u.contour.value = state.contour; u.bent.value = state.bent;
      u.palette.value = (PALETTES[state.mode] || PALETTES.depth).map((hex) => new THREE.Vector3(...rgb(hex)));
      u.count.value = lights.length;
      lights.forEach((l, k) => { u.source.value[k].set(...l.source); u.axis.value[k].set(...l.axis); u.power.value[k].set(...l.power); });
      if (perspective) u.eye.value.set(...camera.position.toArray(), 1);
      else u.eye.value.set(...camera.getWorldDirection(new THREE.Vector3()).negate().toArray(), 0);
      gl.autoClear = true; gl.render(scene, camera);
      if (overlay.children.length) { gl.autoClear = false; gl.clearDepth(); gl.render(overlay, camera); }
      return done;
    },
    // The pixel of the finest maps that a place of the canvas (from -1 to 1, upwards) shows; null beside the surface.
    under(x, y, camera) {
      caster.setFromCamera(new THREE.Vector2(x, y), camera);
      const fine = (whole || coarseLayer).surface, scale = shown.surface.step / fine.step;
      for (const hit of caster.intersectObjects(shown.tiles.group.children.filter((m) => m.visible), false)) {
        const cell = hit.object.geometry.attributes.cell, { a, b, c } = hit.face, t = hit.barycoord;
        const px = [fine.w, fine.h].map((most, k) => Math.min(most - 1, Math.round((t.x * cell.getComponent(a, k) + t.y * cell.getComponent(b, k) + t.z * cell.getComponent(c, k) + 0.5) * scale - 0.5)));
        if (fine.code[px[1] * fine.w + px[0]]) return px;
      }
      return null;
    },
  };
}

// Without WebGL2: the same near light and Lambert's law on a plain canvas; no gloss, no shadows, no turning.
function plainRenderer(canvas, surface) {
  const pen = canvas.getContext("2d"), { w, h, code, paint, coarse: maps, data } = surface, n = w * h;
  const sheet = document.createElement("canvas"); sheet.width = w; sheet.height = h;
  const ink = sheet.getContext("2d"), image = ink.createImageData(w, h), points = new Float32Array(3 * n), normal = new Float32Array(3 * n);
  for (let k = 0; k < n; k++) if (code[k]) { points.set(pointAt(surface, k % w, Math.floor(k / w), depthOf(surface, k)), 3 * k); normal.set(normalAt(surface, k), 3 * k); }
  const mixed = (name, t) => { const at = Math.min(Math.max(t, 0), 1) * 3.999, k = Math.floor(at), a = rgb(PALETTES[name][k]), b = rgb(PALETTES[name][k + 1]); return a.map((x, c) => x + (at - k) * (b[c] - x)); };
  function colour(k, state) {
    const nx = normal[3 * k], ny = normal[3 * k + 1], nz = normal[3 * k + 2];
    if (state.mode === "normals") return [0.5 + 0.5 * nx, 0.5 - 0.5 * ny, 0.5 - 0.5 * nz];
    if (state.mode === "depth") return mixed("depth", (code[k] - 1) / 65534);
    if (state.mode === "sigma") return mixed("sigma", (2 ** (maps.sigma[k] / data.sigmaScale) - 1) / SIGMA_STOP);
    if (state.mode === "depthSigma") return mixed("sigma", (maps.depthSigma[k] - 1) / 255);
    const base = [0, 1, 2].map((c) => (state.mode === "shading" ? 0.62 : 0.85 * (paint[4 * k + c] / 255) ** 2)), sum = [0, 0, 0];
    if (state.mode === "albedo") return base.map((x) => x ** (1 / 2.2));
    for (const light of state.lights) {
      const near = light.source[3], d = [0, 1, 2].map((c) => light.source[c] - near * points[3 * k + c]), r = Math.hypot(...d);
      const nl = Math.max(0, (nx * d[0] + ny * d[1] + nz * d[2]) / r) / (near ? r * r : 1);
      for (let c = 0; c < 3; c++) sum[c] += light.power[c] * nl * base[c];
    }
    return sum.map((x) => Math.min(1, state.exposure * x) ** (1 / 2.2));
  }
  const frame = () => { const scale = Math.min((0.84 * canvas.width) / w, (0.84 * canvas.height) / h); return { scale, x: (canvas.width - scale * w) / 2, y: (canvas.height - scale * h) / 2 }; };
  return {
    turns: false, soft: true, take() {},
    draw(state) {
      canvas.width = Math.round(state.width * state.ratio); canvas.height = Math.round(state.height * state.ratio);
      for (let k = 0; k < n; k++) if (code[k]) { const c = colour(k, state); for (let j = 0; j < 3; j++) image.data[4 * k + j] = 255 * c[j]; image.data[4 * k + 3] = 255; }
      ink.putImageData(image, 0, 0);
      const f = frame();
      pen.clearRect(0, 0, canvas.width, canvas.height);
      pen.drawImage(sheet, f.x, f.y, f.scale * w, f.scale * h);
      return true;
    },
    under(x, y) {
      const f = frame(), px = [Math.floor((((x + 1) / 2) * canvas.width - f.x) / f.scale), Math.floor((((1 - y) / 2) * canvas.height - f.y) / f.scale)];
      return px[0] >= 0 && px[1] >= 0 && px[0] < w && px[1] < h && code[px[1] * w + px[0]] ? px : null;
    },
  };
}
