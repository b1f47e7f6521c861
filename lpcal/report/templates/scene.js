// Line drawings in space on a 2-D canvas: x_view = R (x - centre), weak perspective, far things first. No library, no WebGL.
"use strict";
(function () {
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const unit = (a) => { const n = Math.hypot(a[0], a[1], a[2]) || 1; return [a[0] / n, a[1] / n, a[2] / n]; };
  const VIEWS = { front: [0, 0], side: [-Math.PI / 2, 0], top: [0, 1.5] };

  function scene(box) {
    const data = JSON.parse(box.querySelector("script").textContent);
    const canvas = box.querySelector("canvas"), pen = canvas.getContext("2d");
    const up = unit(data.up);
    const ahead = Math.abs(up[2]) > 0.9 ? [0, 1, 0] : [0, 0, 1];
    const right = unit(cross(ahead, up)), forward = cross(up, right);
    const shown = {};
    let yaw = data.yaw, pitch = data.pitch, zoom = 1, exaggerate = 10, colours = {}, waiting = false;

    function axes() {
      const c = Math.cos(yaw), s = Math.sin(yaw), cp = Math.cos(pitch), sp = Math.sin(pitch);
      const r = [0, 1, 2].map((k) => c * right[k] - s * forward[k]);
      const f = [0, 1, 2].map((k) => s * right[k] + c * forward[k]);
      return { r, u: [0, 1, 2].map((k) => cp * up[k] + sp * f[k]), f: [0, 1, 2].map((k) => cp * f[k] - sp * up[k]) };
    }

    function project(p, view, size) {
      const d = [p[0] - data.centre[0], p[1] - data.centre[1], p[2] - data.centre[2]];
      const depth = dot(d, view.f) / data.radius, scale = size.scale / (1 + 0.22 * depth);
      return [size.w / 2 + dot(d, view.r) * scale, size.h / 2 - dot(d, view.u) * scale, depth];
    }

    function primitives(view, size) {
      const list = [];
      for (const item of data.items) {
        if (shown[item.layer] === false) continue;
        const points = item.kind === "arrow" ? [item.from, item.from.map((x, k) => x + exaggerate * item.by[k])] : item.p;
        const flat = points.map((p) => project(p, view, size));
        const depth = flat.reduce((sum, p) => sum + p[2], 0) / flat.length;
        list.push({ item, flat, depth: item.kind === "label" ? -9 : depth });
      }
      return list.sort((a, b) => b.depth - a.depth);
    }

    function draw() {
      waiting = false;
      const ratio = window.devicePixelRatio || 1, w = canvas.clientWidth, h = canvas.clientHeight;
      if (canvas.width !== Math.round(w * ratio) || canvas.height !== Math.round(h * ratio)) { canvas.width = Math.round(w * ratio); canvas.height = Math.round(h * ratio); }
      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
      pen.clearRect(0, 0, w, h);
      const size = { w, h, scale: zoom * 0.42 * Math.min(w, 1.1 * h) / data.radius };
      pen.lineJoin = pen.lineCap = "round";
      for (const { item, flat } of primitives(axes(), size)) paint(item, flat);
    }

    function paint(item, flat) {
      const colour = colours[item.tone] || colours.ink;
      pen.strokeStyle = pen.fillStyle = colour;
      if (item.kind === "label") {
        pen.font = "600 12px system-ui, sans-serif";
        pen.lineWidth = 3; pen.strokeStyle = colours.plate; pen.strokeText(item.text, flat[0][0] + 9, flat[0][1] - 7);
        pen.fillText(item.text, flat[0][0] + 9, flat[0][1] - 7);
        return;
      }
      pen.beginPath();
      if (item.kind === "point") {
        pen.arc(flat[0][0], flat[0][1], item.r, 0, 7);
        pen.lineWidth = 1.4;
        if (item.hollow) pen.stroke(); else pen.fill();
        return;
      }
      flat.forEach((p, k) => (k ? pen.lineTo(p[0], p[1]) : pen.moveTo(p[0], p[1])));
      if (item.closed) pen.closePath();
      if (item.fill) { pen.globalAlpha = item.fill; pen.fill(); }
      pen.globalAlpha = item.thin ? 0.5 : 0.95;
      pen.lineWidth = item.bold ? 2.2 : item.thin ? 0.9 : 1.4;
      pen.setLineDash(item.dash ? [4, 4] : []);
      pen.stroke();
      pen.setLineDash([]);
      if (item.kind === "arrow") head(flat[0], flat[1]);
      pen.globalAlpha = 1;
    }

    function head(a, b) {
      const angle = Math.atan2(b[1] - a[1], b[0] - a[0]), length = Math.min(9, Math.hypot(b[0] - a[0], b[1] - a[1]) * 0.6);
      pen.beginPath();
      pen.moveTo(b[0], b[1]);
      for (const side of [-0.45, 0.45]) pen.lineTo(b[0] - length * Math.cos(angle + side), b[1] - length * Math.sin(angle + side));
      pen.fill();
    }

    const later = () => { if (!waiting) { waiting = true; requestAnimationFrame(draw); } };
    function restyle() {
      const style = getComputedStyle(document.documentElement);
      const of = (name) => style.getPropertyValue("--" + name).trim();
      colours = { camera: of("ink"), focus: of("poor") };
      for (const name of ["ink", "plate", "light", "board", "x", "y", "z", "designed", "fair", "accent"]) colours[name] = of(name);
      draw();
    }

    const held = new Map();
    canvas.addEventListener("pointerdown", (event) => { held.set(event.pointerId, [event.clientX, event.clientY]); canvas.setPointerCapture(event.pointerId); });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => held.delete(event.pointerId));
    canvas.addEventListener("pointermove", (event) => {
      const last = held.get(event.pointerId);
      if (!last) return;
      yaw += (event.clientX - last[0]) * 0.008;
      pitch = Math.max(-1.5, Math.min(1.5, pitch + (event.clientY - last[1]) * 0.008));
      held.set(event.pointerId, [event.clientX, event.clientY]);
      later();
    });
    canvas.addEventListener("wheel", (event) => { if (!event.ctrlKey) return; event.preventDefault(); zoom *= Math.exp(-event.deltaY * 0.004); later(); }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [-0.08, 0], ArrowRight: [0.08, 0], ArrowUp: [0, -0.08], ArrowDown: [0, 0.08] }[event.key];
      if (!step) return;
      event.preventDefault(); yaw += step[0]; pitch = Math.max(-1.5, Math.min(1.5, pitch + step[1])); later();
    });
    for (const input of box.querySelectorAll("[data-layer]")) {
      shown[input.dataset.layer] = input.checked;
      input.addEventListener("change", () => { shown[input.dataset.layer] = input.checked; later(); });
    }
    const range = box.querySelector("[data-exaggerate]");
    if (range) range.addEventListener("input", () => { exaggerate = Number(range.value); box.querySelector("output").textContent = range.value; later(); });
    for (const button of box.querySelectorAll("[data-view]")) button.addEventListener("click", () => { [yaw, pitch] = VIEWS[button.dataset.view]; later(); });
    for (const button of box.querySelectorAll("[data-zoom]")) button.addEventListener("click", () => { zoom *= Number(button.dataset.zoom); later(); });
    new ResizeObserver(later).observe(canvas);
    for (const query of ["(prefers-color-scheme: dark)", "print"]) window.matchMedia(query).addEventListener("change", restyle);
    window.addEventListener("beforeprint", restyle);
    restyle();
  }

  document.querySelectorAll("[data-scene]").forEach(scene);
})();
