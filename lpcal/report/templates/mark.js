// Marks over a picture: a circle, a board's corners, and a mask by box, polygon and brush. Places are the shown picture's pixels; `step` times as many are the image's.
"use strict";
(function () {
  const find = (id) => document.getElementById(id), data = JSON.parse(find("data").textContent), canvas = find("view"), pen = canvas.getContext("2d");
  const mask = document.createElement("canvas"), ink = mask.getContext("2d", { willReadFrequently: true }), past = [];
  const state = { tool: data.sphere ? "circle" : data.board ? "corners" : "box", circle: null, corners: {}, image: data.images[0], step: 1, scale: 1, x: 0, y: 0, polygon: [], box: null, painted: false, changed: { circle: false, mask: false, corners: new Set() } };
  let picture = null, held = null, last = null;
  window.marks = state;

  const address = (path) => `${path}?token=${encodeURIComponent(data.token)}`;
  const toImage = (p) => [p[0] * state.step + (state.step - 1) / 2, p[1] * state.step + (state.step - 1) / 2];

  async function load(name) {
    const answer = await fetch(address(`/image/${encodeURIComponent(name)}`));
    if (!answer.ok) { say(await answer.text(), true); return; }
    const step = Number(answer.headers.get("X-Step"));
    picture = await createImageBitmap(await answer.blob());
    if (!mask.dataset.made) { mask.width = picture.width; mask.height = picture.height; mask.dataset.made = "yes"; state.step = step; for (const [image, at] of Object.entries(data.marks)) state.corners[image] = [0, 2, 4, 6].map((k) => [(at[k] - (step - 1) / 2) / step, (at[k + 1] - (step - 1) / 2) / step]); if (data.hint) state.circle = data.hint.map((v, k) => (k < 2 ? (v - (step - 1) / 2) / step : v / step)); whole(); }
    state.image = name;
    draw();
    document.documentElement.dataset.ready = name;
  }

  function whole() {
    const w = canvas.clientWidth, h = canvas.clientHeight;
    state.scale = Math.min((0.94 * w) / picture.width, (0.94 * h) / picture.height);
    state.x = (w - state.scale * picture.width) / 2; state.y = (h - state.scale * picture.height) / 2;
  }

  // A place on the canvas as the picture's: pixels' middles are whole numbers.
  const place = (event) => { const b = canvas.getBoundingClientRect(); return [(event.clientX - b.left - state.x) / state.scale - 0.5, (event.clientY - b.top - state.y) / state.scale - 0.5]; };

  function draw() {
    const ratio = window.devicePixelRatio || 1, w = canvas.clientWidth, h = canvas.clientHeight;
    if (canvas.width !== Math.round(w * ratio) || canvas.height !== Math.round(h * ratio)) { canvas.width = Math.round(w * ratio); canvas.height = Math.round(h * ratio); }
    pen.setTransform(ratio, 0, 0, ratio, 0, 0); pen.clearRect(0, 0, w, h);
    if (!picture) return;
    pen.setTransform(ratio * state.scale, 0, 0, ratio * state.scale, ratio * state.x, ratio * state.y);
    pen.imageSmoothingEnabled = state.scale < 2;
    pen.drawImage(picture, 0, 0);
    pen.globalAlpha = 0.45; pen.drawImage(mask, 0, 0); pen.globalAlpha = 1;
    pen.lineWidth = 2 / state.scale; pen.strokeStyle = "#f0c766"; pen.fillStyle = "#f0c766";
    if (state.circle) { const [x, y, r] = state.circle; pen.beginPath(); pen.arc(x + 0.5, y + 0.5, r, 0, 7); pen.stroke(); pen.beginPath(); pen.arc(x + 0.5, y + 0.5, 3 / state.scale, 0, 7); pen.fill(); }
    const marked = state.corners[state.image] || [];
    if (marked.length) { pen.beginPath(); marked.forEach((p, k) => (k ? pen.lineTo(p[0] + 0.5, p[1] + 0.5) : pen.moveTo(p[0] + 0.5, p[1] + 0.5))); if (marked.length === 4) pen.closePath(); pen.stroke(); }
    for (const p of marked) { pen.beginPath(); pen.arc(p[0] + 0.5, p[1] + 0.5, 4 / state.scale, 0, 7); pen.stroke(); }
    if (state.box) { const [a, b] = state.box; pen.strokeRect(Math.min(a[0], b[0]) + 0.5, Math.min(a[1], b[1]) + 0.5, Math.abs(b[0] - a[0]), Math.abs(b[1] - a[1])); }
    if (state.polygon.length) { pen.beginPath(); state.polygon.forEach((p, k) => (k ? pen.lineTo(p[0] + 0.5, p[1] + 0.5) : pen.moveTo(p[0] + 0.5, p[1] + 0.5))); pen.stroke(); }
  }

  function remember() { past.push(ink.getImageData(0, 0, mask.width, mask.height)); if (past.length > 12) past.shift(); state.changed.mask = true; }
  function undo() { if (state.polygon.length) state.polygon.pop(); else if (past.length) ink.putImageData(past.pop(), 0, 0); draw(); }
  function fill(path) { remember(); ink.globalCompositeOperation = "source-over"; ink.fillStyle = "#8fbbe8"; path(); draw(); }
  const corner = (p) => [Math.round(p[0]), Math.round(p[1])];
  function closePolygon() { const p = state.polygon; state.polygon = []; if (p.length > 2) fill(() => { ink.beginPath(); p.forEach((q, k) => (k ? ink.lineTo(q[0] + 0.5, q[1] + 0.5) : ink.moveTo(q[0] + 0.5, q[1] + 0.5))); ink.fill(); }); draw(); }

  function stroke(a, b) {
    ink.globalCompositeOperation = state.tool === "erase" ? "destination-out" : "source-over";
    ink.strokeStyle = "#8fbbe8"; ink.fillStyle = "#8fbbe8"; ink.lineCap = "round"; ink.lineWidth = Number(find("width").value);
    ink.beginPath(); ink.arc(b[0] + 0.5, b[1] + 0.5, ink.lineWidth / 2, 0, 7); ink.fill();
    ink.beginPath(); ink.moveTo(a[0] + 0.5, a[1] + 0.5); ink.lineTo(b[0] + 0.5, b[1] + 0.5); ink.stroke();
  }

  function begin(event) {
    const at = place(event);
    if (event.button === 2 || event.button === 1 || event.shiftKey) { held = { kind: "move", x: event.clientX - state.x, y: event.clientY - state.y }; return; }
    if (state.tool === "circle") {
      const c = state.circle, near = c && Math.hypot(at[0] - c[0], at[1] - c[1]) < Math.max(0.4 * c[2], 6 / state.scale), rim = c && Math.abs(Math.hypot(at[0] - c[0], at[1] - c[1]) - c[2]) < Math.max(0.25 * c[2], 6 / state.scale);
      held = near ? { kind: "shift", by: [at[0] - c[0], at[1] - c[1]] } : { kind: "radius" };
      if (!near && !rim) state.circle = [...at, 1];
      state.changed.circle = true;
    } else if (state.tool === "corners") {
      const marked = (state.corners[state.image] = state.corners[state.image] || []), k = marked.findIndex((p) => Math.hypot(p[0] - at[0], p[1] - at[1]) < 9 / state.scale);
      if (k < 0 && marked.length === 4) { last = at; return; }
      if (k < 0) marked.push(at);
      held = { kind: "corner", k: k < 0 ? marked.length - 1 : k }; state.changed.corners.add(state.image);
    } else if (state.tool === "box") { state.box = [at, at]; held = { kind: "box" }; }
    else if (state.tool === "polygon") { state.polygon.push(at); }
    else { remember(); held = { kind: "brush" }; stroke(at, at); }
    last = at; draw();
  }

  function go(event) {
    const at = place(event), image = toImage(at);
    if (picture) find("readout").textContent = `${image[0].toFixed(1)}, ${image[1].toFixed(1)} px`;
    if (!held) return;
    if (held.kind === "move") { state.x = event.clientX - held.x; state.y = event.clientY - held.y; }
    else if (held.kind === "shift") { state.circle[0] = at[0] - held.by[0]; state.circle[1] = at[1] - held.by[1]; }
    else if (held.kind === "radius") state.circle[2] = Math.max(1, Math.hypot(at[0] - state.circle[0], at[1] - state.circle[1]));
    else if (held.kind === "corner") state.corners[state.image][held.k] = at;
    else if (held.kind === "box") state.box[1] = at;
    else stroke(last, at);
    last = at; shown(); draw();
  }

  function end() {
    if (held && held.kind === "box") { const [a, b] = state.box.map(corner); state.box = null; if (a[0] !== b[0] && a[1] !== b[1]) fill(() => ink.fillRect(Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.abs(b[0] - a[0]) + 1, Math.abs(b[1] - a[1]) + 1)); }
    held = null; draw();
  }

  function zoom(k, at) { const scale = Math.max(0.05, Math.min(40, state.scale * k)); state.x = at[0] - ((at[0] - state.x) * scale) / state.scale; state.y = at[1] - ((at[1] - state.y) * scale) / state.scale; state.scale = scale; draw(); }
  function circleInImage() { const [x, y, r] = state.circle; return [...toImage([x, y]), r * state.step]; }
  function shown() { if (state.circle && find("circle")) find("circle").textContent = `hint: [${circleInImage().map((v) => `${v.toFixed(1)} px`).join(", ")}]`; find("width-out").textContent = `${find("width").value} px`; }
  function say(text, wrong) { find("said").textContent = text; find("said").classList.toggle("wrong", Boolean(wrong)); }
  function choose(tool) { state.tool = tool; if (tool !== "polygon") state.polygon = []; for (const b of document.querySelectorAll("[data-tool]")) b.setAttribute("aria-pressed", String(b.dataset.tool === tool)); draw(); }

  async function write() {
    const named = Object.fromEntries([...document.querySelectorAll("[data-of]")].filter((s) => s.value).map((s) => [s.dataset.of, s.value]));
    const marks = Object.fromEntries([...state.changed.corners].filter((image) => state.corners[image].length === 4).map((image) => [image, state.corners[image].flatMap(toImage)]));
    const asked = { marks, circle: state.changed.circle && state.circle ? circleInImage() : null, mask: state.changed.mask ? mask.toDataURL("image/png") : null, named };
    const answer = await fetch(address("/save"), { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(asked) });
    const found = await answer.json();
    if (found.error) say(found.error, true); else { say(found.said.length ? `written:\n${found.said.join("\n")}` : "nothing to write yet"); state.changed = { circle: false, mask: false, corners: new Set() }; }
    document.documentElement.dataset.answer = String(answer.status);
  }

  canvas.addEventListener("pointerdown", (event) => { canvas.setPointerCapture(event.pointerId); begin(event); });
  canvas.addEventListener("pointermove", go);
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, end);
  canvas.addEventListener("dblclick", closePolygon);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => { event.preventDefault(); const b = canvas.getBoundingClientRect(); zoom(Math.exp(-event.deltaY * 0.0015), [event.clientX - b.left, event.clientY - b.top]); }, { passive: false });
  document.addEventListener("keydown", (event) => {
    const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (/SELECT|INPUT/.test(event.target.tagName)) return;
    if ((event.ctrlKey || event.metaKey) && event.key === "z") undo();
    else if (event.key === "Enter" && state.polygon.length && event.target.tagName !== "BUTTON") closePolygon();
    else if (event.key === "Escape") state.polygon = [];
    else if (state.tool === "corners" && (move || event.key === "Backspace") && event.target === canvas && (state.corners[state.image] || []).length) {
      const marked = state.corners[state.image], end = marked[marked.length - 1];
      if (move) { end[0] += move[0]; end[1] += move[1]; } else marked.pop();
      state.changed.corners.add(state.image); event.preventDefault();
    } else if (move && state.circle && event.target === canvas) { state.circle[0] += move[0]; state.circle[1] += move[1]; state.changed.circle = true; event.preventDefault(); }
    else if ((event.key === "[" || event.key === "]") && state.circle) { state.circle[2] = Math.max(1, state.circle[2] + (event.key === "]" ? 1 : -1)); state.changed.circle = true; }
    else if (event.key === "+" || event.key === "-") zoom(event.key === "+" ? 1.2 : 1 / 1.2, [canvas.clientWidth / 2, canvas.clientHeight / 2]);
    else if (event.key === "0") whole();
    else return;
    shown(); draw();
  });
  for (const b of document.querySelectorAll("[data-tool]")) b.addEventListener("click", () => choose(b.dataset.tool));
  find("width").addEventListener("input", shown);
  find("undo").addEventListener("click", undo);
  find("clear").addEventListener("click", () => { remember(); ink.clearRect(0, 0, mask.width, mask.height); state.polygon = []; draw(); });
  find("image").addEventListener("change", () => load(find("image").value));
  find("save").addEventListener("click", write);
  find("done").addEventListener("click", async () => { await fetch(address("/done"), { method: "POST" }); say("The command has ended; this page can be closed."); });
  for (const s of document.querySelectorAll("[data-of]")) if (data.named[s.dataset.of]) s.value = data.named[s.dataset.of];
  new ResizeObserver(draw).observe(canvas);
  choose(state.tool); load(data.images[0]);
})();
