// The rig and the room in space, with three.js: lines, points, labels, arrows, ellipsoids and the light's field on a plane.
"use strict";
(function () {
  const boxes = [...document.querySelectorAll("[data-scene]")], packed = document.getElementById("three");
  const VIEWS = { front: [0, 0], side: [-Math.PI / 2, 0], top: [0, 1.5] };
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const unit = (a) => { const n = Math.hypot(...a) || 1; return a.map((x) => x / n); };

  async function library() {
    const raw = atob(packed.textContent.trim()), bytes = Uint8Array.from(raw, (c) => c.charCodeAt(0));
    (0, eval)(await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).text());
  }

  function scene(box) {
    const data = JSON.parse(box.querySelector("script").textContent), canvas = box.querySelector("canvas"), labels = box.querySelector(".labels");
    const gl = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    const space = new THREE.Scene(), camera = new THREE.PerspectiveCamera(24, 1, 0.01, 100), centre = new THREE.Vector3(...data.centre), up = unit(data.up);
    const ahead = Math.abs(up[2]) > 0.9 ? [0, 1, 0] : [0, 0, 1], right = unit(cross(ahead, up)), forward = cross(up, right);
    const ball = new THREE.SphereGeometry(1, 20, 14), shown = {}, lines = [];
    let exaggerate = 10, colours = {}, waiting = false, tags = [], field = null;
    gl.setClearColor(0, 0); camera.up.set(...up);
    canvas.addEventListener("wheel", (event) => { if (!event.ctrlKey) event.stopImmediatePropagation(); }, { passive: true });
    const controls = new THREE.OrbitControls(camera, canvas);
    canvas.style.touchAction = "pan-y"; controls.minPolarAngle = 0.05; controls.maxPolarAngle = Math.PI - 0.05; controls.minDistance = 0.3 * data.radius; controls.maxDistance = 30 * data.radius;

    function see(yaw, pitch, keep) {
      const c = Math.cos(yaw), s = Math.sin(yaw), away = keep ? camera.position.distanceTo(controls.target) : 5.2 * data.radius;
      const f = [0, 1, 2].map((k) => Math.cos(pitch) * (s * right[k] + c * forward[k]) - Math.sin(pitch) * up[k]);
      controls.target.copy(centre); camera.position.copy(centre).addScaledVector(new THREE.Vector3(...f), -away); controls.update();
    }

    function build() {
      space.clear(); labels.textContent = ""; tags = []; lines.length = 0;
      const merged = new Map();
      const segment = (item, a, b) => {
        const width = item.bold ? 2.6 : item.thin ? 1 : 1.7, key = [item.layer, item.tone, width, Boolean(item.dash), Boolean(item.thin)].join();
        if (!merged.has(key)) merged.set(key, { item, width, points: [] });
        merged.get(key).points.push(...a, ...b);
      };
      for (const item of data.items) {
        if (shown[item.layer] === false) continue;
        const colour = colours[item.tone] || colours.ink;
        if (item.kind === "line") {
          for (let k = 0; k + 1 < item.p.length; k++) segment(item, item.p[k], item.p[k + 1]);
          if (item.closed) segment(item, item.p[item.p.length - 1], item.p[0]);
          if (item.fill) space.add(sheet(item, colour));
        } else if (item.kind === "arrow") {
          const end = item.from.map((x, k) => x + exaggerate * item.by[k]);
          segment({ ...item, bold: true }, item.from, end); space.add(dotAt(end, 0.009, colour, 1));
        } else if (item.kind === "point") space.add(dotAt(item.p[0], 0.003 * item.r, colour, item.hollow ? 0.35 : 1));
        else if (item.kind === "ellipsoid") space.add(ellipsoid(item, colour));
        else { const tag = document.createElement("span"); tag.textContent = item.text; tag.style.color = colour; labels.append(tag); tags.push([tag, new THREE.Vector3(...item.p[0])]); }
      }
      for (const { item, width, points } of merged.values()) {
        const material = new THREE.LineMaterial({ color: new THREE.Color(colours[item.tone] || colours.ink), linewidth: width, transparent: true, opacity: item.thin ? 0.6 : 1, dashed: Boolean(item.dash), dashSize: 0.02 * data.radius, gapSize: 0.02 * data.radius });
        const made = new THREE.LineSegments2(new THREE.LineSegmentsGeometry().setPositions(points), material);
        if (item.dash) made.computeLineDistances();
        lines.push(material); space.add(made);
      }
      if (field !== null && data.field) space.add(...plane(data.field, field));
    }

    function dotAt(p, size, colour, opacity) {
      const made = new THREE.Mesh(ball, new THREE.MeshBasicMaterial({ color: new THREE.Color(colour), transparent: opacity < 1, opacity }));
      made.position.set(...p); made.scale.setScalar(size * data.radius);
      return made;
    }

    function ellipsoid(item, colour) {
      const made = new THREE.Mesh(ball, new THREE.MeshBasicMaterial({ color: new THREE.Color(colour), transparent: true, opacity: 0.28, depthWrite: false })), [a, b, c] = item.axes.map((v) => v.map((x) => exaggerate * x));
      made.matrixAutoUpdate = false;
      made.matrix.set(a[0], b[0], c[0], item.p[0][0], a[1], b[1], c[1], item.p[0][1], a[2], b[2], c[2], item.p[0][2], 0, 0, 0, 1);
      return made;
    }

    function sheet(item, colour) {
      const faces = [];
      for (let k = 1; k + 1 < item.p.length; k++) faces.push(0, k, k + 1);
      const shape = new THREE.BufferGeometry();
      shape.setAttribute("position", new THREE.BufferAttribute(new Float32Array(item.p.flat()), 3)); shape.setIndex(faces);
      return new THREE.Mesh(shape, new THREE.MeshBasicMaterial({ color: new THREE.Color(colour), transparent: true, opacity: item.fill, side: THREE.DoubleSide, depthWrite: false }));
    }

    // One light's irradiance over the plane: bright where it is strong; a line along each tenth of the strongest would be too fine.
    function plane(f, k) {
      const n = f.size, values = f.lights[k].values, bytes = new Uint8Array(4 * n * n), strong = new THREE.Color(colours.light);
      for (let q = 0; q < n * n; q++) { bytes.set([255 * strong.r, 255 * strong.g, 255 * strong.b, 30 + 2.1 * values[q]], 4 * q); }
      const map = new THREE.DataTexture(bytes, n, n), shape = new THREE.BufferGeometry(), [a, b, c, d] = f.corners;
      map.magFilter = THREE.LinearFilter; map.needsUpdate = true;
      shape.setAttribute("position", new THREE.BufferAttribute(new Float32Array([...a, ...b, ...c, ...d]), 3)); shape.setAttribute("uv", new THREE.BufferAttribute(new Float32Array([0, 0, 1, 0, 1, 1, 0, 1]), 2)); shape.setIndex([0, 1, 2, 0, 2, 3]);
      return [new THREE.Mesh(shape, new THREE.MeshBasicMaterial({ map, transparent: true, side: THREE.DoubleSide, depthWrite: false }))];
    }

    function draw() {
      waiting = false;
      const w = Math.max(1, canvas.clientWidth), h = Math.max(1, canvas.clientHeight);
      gl.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2)); gl.setSize(w, h, false);
      for (const material of lines) material.resolution.set(w, h);
      camera.aspect = w / h; camera.fov = w > h ? 24 : (360 / Math.PI) * Math.atan((Math.tan((12 * Math.PI) / 180) * h) / w);
      const away = camera.position.distanceTo(centre);
      camera.near = Math.max(away - 6 * data.radius, 0.02 * data.radius); camera.far = away + 6 * data.radius; camera.updateProjectionMatrix();
      gl.render(space, camera);
      const stand = [], high = 13;  // labels that stand already: one that would lie on another goes below it
      for (const [tag, at] of tags) {
        const p = at.clone().project(camera), wide = tag.textContent.length * 8;
        tag.hidden = Math.abs(p.x) > 1 || Math.abs(p.y) > 1;
        if (tag.hidden) continue;
        const x = Math.min(((p.x + 1) / 2) * w + 8, w - wide);
        let y = ((1 - p.y) / 2) * h - 18;
        for (let k = 0; k < 3; k++) for (const other of stand) if (Math.abs(other.y - y) < high && x < other.x + other.wide && other.x < x + wide) y = other.y + high;
        stand.push({ x, y, wide });
        tag.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
      }
    }

    const later = () => { if (!waiting) { waiting = true; requestAnimationFrame(draw); } };
    function restyle() {
      const style = getComputedStyle(document.documentElement), of = (name) => style.getPropertyValue("--" + name).trim();
      colours = { camera: of("ink"), focus: of("poor") };
      for (const name of ["ink", "plate", "light", "board", "x", "y", "z", "designed", "fair", "poor", "accent"]) colours[name] = of(name);
      build(); draw();
    }

    function turn(yaw, pitch) {
      const by = camera.position.clone().sub(controls.target), side = new THREE.Vector3().crossVectors(camera.up, by).normalize(), polar = by.angleTo(camera.up), next = Math.max(0.06, Math.min(Math.PI - 0.06, polar + pitch));
      by.applyQuaternion(new THREE.Quaternion().setFromAxisAngle(side, next - polar)).applyQuaternion(new THREE.Quaternion().setFromAxisAngle(camera.up, yaw));
      camera.position.copy(controls.target).add(by); controls.update();
    }
    function pan(x, y) {
      const k = 0.4 * camera.position.distanceTo(controls.target) * Math.tan((camera.fov * Math.PI) / 360), by = new THREE.Vector3().setFromMatrixColumn(camera.matrix, 0).multiplyScalar(k * x).add(new THREE.Vector3().setFromMatrixColumn(camera.matrix, 1).multiplyScalar(k * y));
      camera.position.add(by); controls.target.add(by); controls.update();
    }
    function zoom(k) { const by = camera.position.clone().sub(controls.target); by.setLength(Math.max(controls.minDistance, Math.min(controls.maxDistance, by.length() / k))); camera.position.copy(controls.target).add(by); controls.update(); }

    canvas.addEventListener("keydown", (event) => {
      const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (move && event.shiftKey) pan(0.2 * move[0], -0.2 * move[1]);
      else if (move) turn(-0.08 * move[0], -0.08 * move[1]);
      else if (event.key === "+" || event.key === "=") zoom(1.15);
      else if (event.key === "-") zoom(1 / 1.15);
      else if (event.key === "0" || event.key === "Home") see(data.yaw, data.pitch);
      else return;
      event.preventDefault(); later();
    });
    controls.addEventListener("change", later);
    canvas.addEventListener("dblclick", () => { see(data.yaw, data.pitch); later(); });
    for (const input of box.querySelectorAll("[data-layer]")) {
      shown[input.dataset.layer] = input.checked;
      input.addEventListener("change", () => { shown[input.dataset.layer] = input.checked; build(); later(); });
    }
    const range = box.querySelector("[data-exaggerate]"), chooser = box.querySelector("[data-field]");
    if (range) range.addEventListener("input", () => { exaggerate = Number(range.value); box.querySelector("output").textContent = range.value; build(); later(); });
    if (chooser) chooser.addEventListener("change", () => { field = chooser.value === "" ? null : Number(chooser.value); build(); later(); });
    for (const button of box.querySelectorAll("[data-view]")) button.addEventListener("click", () => { see(...(VIEWS[button.dataset.view] || [data.yaw, data.pitch]), button.dataset.view in VIEWS); later(); });
    for (const button of box.querySelectorAll("[data-zoom]")) button.addEventListener("click", () => { zoom(Number(button.dataset.zoom)); later(); });
    see(data.yaw, data.pitch);
    new ResizeObserver(later).observe(canvas);
    for (const query of ["(prefers-color-scheme: dark)", "print"]) window.matchMedia(query).addEventListener("change", restyle);
    window.addEventListener("beforeprint", restyle);
    restyle();
    box.view = { camera, space, draw };
  }

  function without(box, why) { const said = document.createElement("p"); said.className = "note"; said.textContent = `Not drawn here: ${why}. The tables hold all of it.`; box.querySelector("canvas").replaceWith(said); }

  if (boxes.length) library().then(() => {
    for (const box of boxes) try { scene(box); } catch (error) { without(box, "this browser has no WebGL2"); }
    document.documentElement.dataset.drawn = "yes";
  }, (error) => boxes.forEach((box) => without(box, error.message)));
})();
