// map.js: what is seen of the layer, and how a reader goes about in it: dragging, wheel, two fingers, keys, buttons, the
// slider, and links. A link #at=X,Y,WIDTH shows that piece of the map, in the layer's coordinates; &t=0.5 sets the slider.

const clamp = (value, low, high) => Math.min(high, Math.max(low, value));

// Lengths in words, as the program writes them: four digits, no unit where none is known.
function lengthWords(value, unit, step) {
  const digits = clamp(-Math.floor(Math.log10(Math.max(step, 1e-12))), 0, 12);
  const rounded = Number(Number(value.toPrecision(4)).toFixed(digits));
  return rounded + (unit === "" || unit === "\u00b0" ? unit : "\u00a0" + unit);
}

function makeMap(layer) {
  const box = document.querySelector(".map"), canvas = box.querySelector("canvas"), context = canvas.getContext("2d");
  const slider = document.getElementById("when"), about = box.querySelector(".about"), scaleBar = box.querySelector(".scale");
  const lists = featuresByStatus(layer), whole = Math.max(layer.width, layer.height) || 1;
  // The middle in units of the layer, pixels a unit; what view() makes of it is what drawing wants.
  const state = { x: layer.width / 2, y: layer.height / 2, scale: 1, part: 1, sweep: false, mark: null, drawn: false };
  let colours = readColours(), width = 0, height = 0, wanted = 0, told = 0;

  const view = () => ({
    x: width / 2 - state.x * state.scale, y: height / 2 + state.y * state.scale, scale: state.scale, width, height,
  });

  // ---- Drawing ----
  function drawSide(from, to, part, now) {
    context.save();
    context.beginPath();
    context.rect(from, 0, to - from, height);
    context.clip();
    drawLayer(context, layer, lists, now, part, colours);
    context.restore();
  }

  function drawMark(now) {
    const x = now.x + state.mark[0] * now.scale, y = now.y - state.mark[1] * now.scale;
    context.strokeStyle = colours.ink;
    context.lineWidth = 1;
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      context.beginPath();
      context.moveTo(x + 18 * dx, y + 18 * dy);
      context.lineTo(x + 30 * dx, y + 30 * dy);
      context.stroke();
    }
  }

  function drawScale() {
    const most = 140 / state.scale, power = 10 ** Math.floor(Math.log10(most));
    const length = [5, 2, 1].map((k) => k * power).find((k) => k <= most);
    scaleBar.style.width = length * state.scale + "px";
    scaleBar.firstElementChild.textContent = lengthWords(length, layer.unit, length);
  }

  function draw() {
    wanted = 0;
    const density = window.devicePixelRatio || 1, now = view();
    if (canvas.width !== Math.round(width * density) || canvas.height !== Math.round(height * density)) {
      canvas.width = Math.round(width * density);
      canvas.height = Math.round(height * density);
    }
    context.setTransform(density, 0, 0, density, 0, 0);
    if (!state.sweep) drawLayer(context, layer, lists, now, state.part, colours);
    else {
      const at = width * (1 - state.part); // to the right of it is after
      drawSide(0, at, 0, now);
      drawSide(at, width, 1, now);
      context.fillStyle = colours.ink;
      context.fillRect(at - 1, 0, 2, height);
    }
    if (state.mark) drawMark(now);
    drawScale();
    canvas.dataset.marks = layer.marks ?? 0;
    state.drawn = true;
  }

  function redraw() {
    if (!wanted) wanted = requestAnimationFrame(draw);
  }

  // ---- Going about ----
  const fit = () => 0.94 * Math.min(width / (layer.width || whole), height / (layer.height || whole));

  function zoom(factor, px = width / 2, py = height / 2) {
    const x = state.x + (px - width / 2) / state.scale, y = state.y - (py - height / 2) / state.scale;
    state.scale = clamp(state.scale * factor, fit() / 2, 200 / layer.step);
    state.x = x - (px - width / 2) / state.scale;
    state.y = y + (py - height / 2) / state.scale;
    moved();
  }

  function pan(px, py) {
    state.x = clamp(state.x - px / state.scale, -whole / 2, layer.width + whole / 2);
    state.y = clamp(state.y + py / state.scale, -whole / 2, layer.height + whole / 2);
    moved();
  }

  function showAll() {
    state.x = layer.width / 2;
    state.y = layer.height / 2;
    state.scale = fit();
    state.mark = null;
    moved();
  }

  // The address follows, a moment later, so that it can be copied.
  function moved() {
    redraw();
    clearTimeout(told);
    told = setTimeout(() => {
      const decimals = clamp(2 - Math.floor(Math.log10(layer.step)), 0, 12);
      const at = [layer.origin[0] + state.x, layer.origin[1] + state.y, width / state.scale].map((v) => Number(v.toFixed(decimals)));
      try {
        history.replaceState(null, "", "#at=" + at.join() + (state.part === 1 ? "" : "&t=" + state.part));
      } catch { /* some browsers allow it to no file */ }
    }, 400);
  }

  function setPart(part) {
    state.part = clamp(part, 0, 1);
    slider.value = String(state.part);
    slider.setAttribute("aria-valuetext", state.part === 1 ? "after" : state.part === 0 ? "before" : Math.round(100 * state.part) + " %");
    redraw();
  }

  function followLink() {
    const words = new URLSearchParams(location.hash.slice(1)), at = (words.get("at") || "").split(",").map(Number);
    if (words.has("mode")) setMode(words.get("mode") === "sweep");
    if (words.has("t") && Number.isFinite(Number(words.get("t")))) setPart(Number(words.get("t")));
    if (at.length !== 3 || !at.every(Number.isFinite) || !(at[2] > 0)) return false;
    state.x = at[0] - layer.origin[0];
    state.y = at[1] - layer.origin[1];
    state.scale = clamp(Math.min(width, height * 4 / 3) / at[2], fit() / 2, 200 / layer.step);
    state.mark = [state.x, state.y];
    redraw();
    return true;
  }

  function setMode(sweep) {
    state.sweep = sweep;
    document.querySelector(`input[name=mode][value=${sweep ? "sweep" : "move"}]`).checked = true;
    redraw();
  }

  // ---- What is under the pointer ----
  function holds(f, x, y, part) {
    const { ringsOf, cornersOf, corners } = shapesAt(layer, f, part);
    let inside = false;
    for (let r = ringsOf[f]; r < ringsOf[f + 1]; r++)
      for (let i = cornersOf[r], j = cornersOf[r + 1] - 1; i < cornersOf[r + 1]; j = i++) {
        const yi = corners[2 * i + 1], yj = corners[2 * j + 1];
        if (yi > y !== yj > y && x < corners[2 * i] + (corners[2 * j] - corners[2 * i]) * (y - yi) / (yj - yi)) inside = !inside;
      }
    return inside;
  }

  function featureAt(px, py) {
    const part = !state.sweep ? state.part : px < width * (1 - state.part) ? 0 : 1;
    const x = state.x + (px - width / 2) / state.scale, y = state.y - (py - height / 2) / state.scale;
    for (const status of drawingOrder.slice().reverse())
      for (const f of lists[status]) {
        const u = x - part * layer.move[2 * f], v = y - part * layer.move[2 * f + 1], b = layer.boxes;
        if (u >= b[4 * f] && u <= b[4 * f + 2] && v >= b[4 * f + 1] && v <= b[4 * f + 3] && holds(f, u, v, part)) return f;
      }
    return -1;
  }

  function tell(f) {
    about.hidden = f < 0;
    if (f < 0) return;
    const length = Math.hypot(layer.move[2 * f], layer.move[2 * f + 1]), status = statusNames[layer.status[f]];
    const words = { unmoved: "unmoved", moved: "", fixed: "fixed", blocked: "still in conflict", skipped: "left aside", hidden: "hidden" }[status];
    const way = length > 0 ? "moved by " + lengthWords(length, layer.unit, layer.step) : "";
    const shape = isChanged(layer, f) ? "another shape" : "";
    about.textContent = layer.label[f] + " \u00b7 " + [way, words, shape].filter(Boolean).join(", ");
  }

  // ---- Hands ----
  const pointers = new Map();
  const placeOf = (event) => {
    const edge = canvas.getBoundingClientRect();
    return [event.clientX - edge.left, event.clientY - edge.top];
  };
  const spread = () => {
    const [[ax, ay], [bx, by]] = pointers.values();
    return { x: (ax + bx) / 2, y: (ay + by) / 2, size: Math.hypot(ax - bx, ay - by) };
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, placeOf(event));
    canvas.classList.add("held");
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = pointers.get(event.pointerId), at = placeOf(event);
    if (!last) {
      tell(featureAt(...at));
    } else if (pointers.size === 1) {
      pointers.set(event.pointerId, at);
      pan(at[0] - last[0], at[1] - last[1]);
    } else if (pointers.size === 2) {
      const before = spread();
      pointers.set(event.pointerId, at);
      const after = spread();
      pan(after.x - before.x, after.y - before.y);
      if (before.size > 0 && after.size > 0) zoom(after.size / before.size, after.x, after.y);
    }
  });
  for (const end of ["pointerup", "pointercancel"])
    canvas.addEventListener(end, (event) => {
      pointers.delete(event.pointerId);
      if (pointers.size === 0) canvas.classList.remove("held");
    });
  canvas.addEventListener("pointerleave", () => tell(-1));
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoom(Math.exp(-clamp(event.deltaMode === 1 ? event.deltaY * 30 : event.deltaY, -240, 240) / 300), ...placeOf(event));
  }, { passive: false });
  canvas.addEventListener("dblclick", (event) => zoom(2, ...placeOf(event)));

  const keys = {
    ArrowLeft: () => pan(60, 0), ArrowRight: () => pan(-60, 0), ArrowUp: () => pan(0, 60), ArrowDown: () => pan(0, -60),
    "+": () => zoom(1.5), "=": () => zoom(1.5), "-": () => zoom(1 / 1.5), 0: showAll, Home: showAll,
    b: () => setPart(state.part > 0.5 ? 0 : 1),
  };
  canvas.addEventListener("keydown", (event) => {
    const act = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
  });
  const deeds = { in: () => zoom(1.5), out: () => zoom(1 / 1.5), all: showAll };
  for (const button of box.querySelectorAll("button")) button.addEventListener("click", deeds[button.dataset.do]);
  slider.addEventListener("input", () => setPart(Number(slider.value)));
  for (const radio of document.querySelectorAll("input[name=mode]"))
    radio.addEventListener("change", () => setMode(radio.value === "sweep"));

  document.querySelector(".find").addEventListener("submit", (event) => {
    event.preventDefault();
    const wish = document.getElementById("find").value.trim();
    const f = layer.label.findIndex((l) => l === "FID " + wish || l.startsWith(wish + " (") || l === wish || l.endsWith("(FID " + wish + ")"));
    if (f < 0 || wish === "") {
      about.hidden = false;
      about.textContent = wish === "" ? "Type a FID or an id." : "There is no feature " + wish + " on the map.";
      return;
    }
    const b = layer.boxes.subarray(4 * f, 4 * f + 4);
    state.x = (b[0] + b[2]) / 2 + layer.move[2 * f];
    state.y = (b[1] + b[3]) / 2 + layer.move[2 * f + 1];
    state.scale = Math.min(width, height) / (4 * Math.max(b[2] - b[0], b[3] - b[1], layer.step));
    state.mark = [state.x, state.y];
    tell(f);
    moved();
  });

  // Links to places: the map comes into view, and has the keys.
  window.addEventListener("hashchange", () => {
    if (!followLink()) return;
    box.scrollIntoView({ block: "center" });
    canvas.focus({ preventScroll: true });
  });
  document.addEventListener("click", (event) => { // the same link once more changes no address
    const link = event.target.closest("a.show");
    if (link && link.hash === location.hash) window.dispatchEvent(new HashChangeEvent("hashchange"));
  });

  // ---- Size, light and paper ----
  function recolour() {
    colours = readColours();
    draw();
  }
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", recolour);
  matchMedia("print").addEventListener("change", recolour);
  function resize() {
    const first = width === 0, before = width;
    width = box.clientWidth;
    height = box.clientHeight;
    if (first) {
      if (!followLink()) showAll();
    } else if (width !== before) {
      state.scale *= width / before;
    }
    draw();
  }
  document.querySelector(".still").classList.add("with-map");
  canvas.hidden = false;
  for (const each of document.querySelectorAll(".needs-script")) each.hidden = false;
  new ResizeObserver(resize).observe(box);
  return state;
}
