// draw.js: the layer on a canvas, at a moment between before (0) and after (1).

// Colours of the style sheet, as they are now: in the dark, or on paper.
function readColours() {
  const style = getComputedStyle(document.documentElement), colours = {};
  for (const name of ["ground", "ink", "paper", "unmoved", "fixed", "moved", "stood", "blocked", "skipped", "barrier", "arrow", "link"]) {
    colours[name] = style.getPropertyValue("--" + name).trim();
    colours[name + "Line"] = style.getPropertyValue("--" + name + "-line").trim();
  }
  return colours;
}

// From so many pixels on a feature has a shape, and is no dot; has an outline; an arrow is drawn; where it stood is.
const leastShape = 2.5, leastOutline = 6, leastArrow = 4, leastGhost = 8;
// So many features, or fewer, are drawn one by one, so that overlaps show through; of more so many corners at once
// (browsers fill a few small paths faster than a large one).
const fewFeatures = 4000, manyCorners = 100;

// Puts a feature's rings, moved by a part of its move, into the path that is open. Returns how many corners.
function traceFeature(context, layer, view, f, part) {
  const { ringsOf, cornersOf, corners } = shapesAt(layer, f, part);
  const x = view.x + part * layer.move[2 * f] * view.scale, y = view.y - part * layer.move[2 * f + 1] * view.scale;
  for (let r = ringsOf[f]; r < ringsOf[f + 1]; r++) {
    for (let i = cornersOf[r]; i < cornersOf[r + 1]; i++) {
      const px = x + corners[2 * i] * view.scale, py = y - corners[2 * i + 1] * view.scale;
      if (i === cornersOf[r]) context.moveTo(px, py);
      else context.lineTo(px, py);
    }
    context.closePath();
  }
  return cornersOf[ringsOf[f + 1]] - cornersOf[ringsOf[f]];
}

// Is a feature in the picture then? Gives its larger side in pixels, or 0.
function sizeInView(layer, view, f, part) {
  const box = 4 * f, dx = part * layer.move[2 * f], dy = part * layer.move[2 * f + 1];
  const left = view.x + (layer.boxes[box] + dx) * view.scale, right = view.x + (layer.boxes[box + 2] + dx) * view.scale;
  const top = view.y - (layer.boxes[box + 3] + dy) * view.scale, low = view.y - (layer.boxes[box + 1] + dy) * view.scale;
  if (right < 0 || left > view.width || low < 0 || top > view.height) return 0;
  return Math.max(right - left, low - top, 1e-3);
}

function drawDot(context, layer, view, f, part) {
  const [x0, y0, x1, y1] = layer.boxes.subarray(4 * f, 4 * f + 4);
  const x = view.x + (x0 + part * layer.move[2 * f]) * view.scale, y = view.y - (y1 + part * layer.move[2 * f + 1]) * view.scale;
  context.fillRect(x, y, Math.max(1, (x1 - x0) * view.scale), Math.max(1, (y1 - y0) * view.scale));
}

// Those of one status that are seen: small ones as dots, the others one by one, or many in one path.
function drawFeatures(context, layer, view, features, part, fill, line, few, width) {
  const seen = [];
  context.fillStyle = fill;
  context.strokeStyle = line;
  context.lineWidth = width;
  for (const f of features) {
    const size = sizeInView(layer, view, f, part);
    if (size >= leastShape) seen.push(f);
    else if (size > 0) drawDot(context, layer, view, f, part);
  }
  context.globalAlpha = few ? 0.86 : 1;
  for (let i = 0; i < seen.length;) {
    context.beginPath();
    let outlined = true;
    for (let n = 0; i < seen.length && n < (few ? 1 : manyCorners); i++) {
      n += traceFeature(context, layer, view, seen[i], part);
      outlined = outlined && sizeInView(layer, view, seen[i], part) >= leastOutline;
    }
    context.fill("nonzero");
    if (outlined || few) context.stroke();
  }
  context.globalAlpha = 1;
}

// The outlines that features had, of those that moved, changed or are hidden.
function drawGhosts(context, layer, view, features, line) {
  context.strokeStyle = line;
  context.lineWidth = 1;
  context.setLineDash([3, 2.5]);
  for (const f of features) {
    const length = Math.hypot(layer.move[2 * f], layer.move[2 * f + 1]) * view.scale;
    const differs = length >= 1 || isChanged(layer, f) || statusNames[layer.status[f]] === "hidden";
    if (!differs || sizeInView(layer, view, f, 0) < leastGhost) continue;
    context.beginPath();
    traceFeature(context, layer, view, f, 0);
    context.stroke();
  }
  context.setLineDash([]);
}

function drawArrow(context, x0, y0, x1, y1) {
  const length = Math.hypot(x1 - x0, y1 - y0), head = Math.min(8, length * 0.6);
  const ux = (x1 - x0) / length, uy = (y1 - y0) / length;
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1 - ux * head * 0.8, y1 - uy * head * 0.8);
  context.stroke();
  context.beginPath();
  context.moveTo(x1, y1);
  context.lineTo(x1 - ux * head - uy * head * 0.4, y1 - uy * head + ux * head * 0.4);
  context.lineTo(x1 - ux * head + uy * head * 0.4, y1 - uy * head - ux * head * 0.4);
  context.fill();
}

function drawArrows(context, layer, view, features, colours) {
  context.strokeStyle = context.fillStyle = colours.arrow;
  context.lineWidth = 1.4;
  for (const f of features) {
    const dx = layer.move[2 * f] * view.scale, dy = -layer.move[2 * f + 1] * view.scale;
    const x = view.x + layer.anchor[2 * f] * view.scale, y = view.y - layer.anchor[2 * f + 1] * view.scale;
    const seen = Math.min(x, x + dx) < view.width && Math.max(x, x + dx) > 0 && Math.min(y, y + dy) < view.height &&
      Math.max(y, y + dy) > 0;
    if (seen && Math.hypot(dx, dy) >= leastArrow) drawArrow(context, x, y, x + dx, y + dy);
  }
}

// Marks that would lie on each other are one: each joins the first that is no farther from it than so many pixels, the
// worst conflicts first, so that no two discs of that size overlap. They depend on the scale alone, and stay as they are
// when the map is dragged.
const clusterReach = 30, shortLink = 12;

function makeClusters(conflicts, scale) {
  const clusters = [], squares = new Map(), square = (v) => Math.floor(v / clusterReach);
  for (const { proved, ends } of conflicts) {
    if (Math.hypot(ends[2] - ends[0], ends[3] - ends[1]) * scale > shortLink) continue;
    const x = (ends[0] + ends[2]) / 2 * scale, y = -(ends[1] + ends[3]) / 2 * scale;
    let cluster;
    for (let i = square(x) - 1; i <= square(x) + 1 && !cluster; i++)
      for (let j = square(y) - 1; j <= square(y) + 1 && !cluster; j++)
        cluster = squares.get(i + "," + j)?.find((each) => Math.hypot(each.x - x, each.y - y) < clusterReach);
    if (cluster) {
      cluster.n++;
      cluster.proved = cluster.proved || proved;
      continue;
    }
    clusters.push({ x, y, n: 1, proved });
    const key = square(x) + "," + square(y);
    if (!squares.has(key)) squares.set(key, []);
    squares.get(key).push(clusters[clusters.length - 1]);
  }
  return clusters;
}

// A disc, or a ring if nothing is proved of it; of several a larger one with their number.
function drawCluster(context, view, { x, y, n, proved }, colours) {
  const radius = n === 1 ? 5 : Math.min(clusterReach / 2 - 1, 7 + 1.5 * Math.log2(n));
  context.beginPath();
  context.arc(view.x + x, view.y + y, radius, 0, 2 * Math.PI);
  if (proved || n > 1) {
    context.fillStyle = proved ? colours.link : colours.paper;
    context.fill();
  }
  context.stroke();
  if (n === 1) return;
  context.fillStyle = proved ? colours.paper : colours.link;
  context.fillText(n, view.x + x, view.y + y);
}

// Links of conflicts; where one would be too short to be seen, a disc. layer.marks: how many links and discs are seen.
function drawLinks(context, layer, view, colours) {
  if (layer.clusters?.scale !== view.scale) layer.clusters = { scale: view.scale, all: makeClusters(layer.conflicts, view.scale) };
  context.strokeStyle = colours.link;
  context.lineCap = "round";
  context.lineWidth = 3;
  layer.marks = 0;
  for (const { ends } of layer.conflicts) {
    const x0 = view.x + ends[0] * view.scale, y0 = view.y - ends[1] * view.scale;
    const x1 = view.x + ends[2] * view.scale, y1 = view.y - ends[3] * view.scale;
    if (Math.max(x0, x1) < -9 || Math.min(x0, x1) > view.width + 9 || Math.max(y0, y1) < -9 || Math.min(y0, y1) > view.height + 9)
      continue;
    context.beginPath();
    context.moveTo(x0, y0);
    context.lineTo(x1, y1);
    context.stroke();
    layer.marks += Math.hypot(x1 - x0, y1 - y0) > shortLink;
  }
  context.lineWidth = 2;
  context.font = "600 11px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (const cluster of layer.clusters.all) {
    const x = view.x + cluster.x, y = view.y + cluster.y;
    if (x < -clusterReach || x > view.width + clusterReach || y < -clusterReach || y > view.height + clusterReach) continue;
    drawCluster(context, view, cluster, colours);
    layer.marks++;
  }
}

function tracePart(context, view, part) {
  for (let i = 0; i < part.length; i += 2) {
    const x = view.x + part[i] * view.scale, y = view.y - part[i + 1] * view.scale;
    if (i === 0) context.moveTo(x, y);
    if (i > 0 || part.length === 2) context.lineTo(x, y);
  }
}

function barriersInView(layer, view) {
  return layer.barriers.filter(({ box }) => view.x + box[2] * view.scale >= 0 && view.x + box[0] * view.scale <= view.width &&
    view.y - box[1] * view.scale >= 0 && view.y - box[3] * view.scale <= view.height &&
    Math.max(box[2] - box[0], box[3] - box[1]) * view.scale >= leastShape);
}

// Barriers with their width: rims first, so that roads that meet run into each other. Where a road is hardly wider than
// its rim, or has no width, the rim is all there is.
function drawBarriers(context, layer, view, colours) {
  const rim = 1.6, seen = barriersInView(layer, view);
  context.lineCap = context.lineJoin = "round";
  for (const inner of [false, true]) {
    // Lines of one width, many in one path; areas one by one.
    let corners = 0, last = -1;
    const flush = () => {
      if (corners > 0) context.stroke();
      corners = 0;
    };
    for (const { width, lines, rings } of seen) {
      const wide = width * view.scale;
      if (inner && wide < 1 && rings.length === 0) continue;
      if (wide !== last || corners > manyCorners || rings.length > 0) flush();
      last = wide;
      if (corners === 0) {
        context.lineWidth = inner ? Math.max(wide, 1e-3) : wide + rim;
        context.strokeStyle = inner ? colours.barrier : colours.barrierLine;
        context.beginPath();
      }
      for (const line of lines) {
        tracePart(context, view, line);
        corners += line.length / 2;
      }
      if (rings.length === 0) continue;
      flush();
      context.fillStyle = colours.barrier;
      context.beginPath();
      for (const ring of rings) {
        tracePart(context, view, ring);
        context.closePath();
      }
      if (inner) context.fill("nonzero");
      context.stroke();
    }
    flush();
  }
  context.lineJoin = "miter";
  context.lineCap = "butt";
}

// Where barriers pass under features: a broken line along the middle, in the colour that the barrier itself has there, so
// that it is seen on features alone.
function drawUnderpasses(context, layer, view, colours) {
  const seen = barriersInView(layer, view);
  context.setLineDash([4, 3]);
  for (const { width, lines, rings } of seen) {
    const wide = width * view.scale >= 3 && rings.length === 0;
    context.lineWidth = wide ? 1.2 : 0.8;
    context.strokeStyle = wide ? colours.barrier : colours.barrierLine;
    context.beginPath();
    for (const line of lines) tracePart(context, view, line);
    for (const ring of rings) {
      tracePart(context, view, ring);
      context.closePath();
    }
    context.stroke();
  }
  context.setLineDash([]);
}

// A colour between two, both #rrggbb.
function mix(from, to, part) {
  const channel = (k) => {
    const a = parseInt(from.slice(1 + 2 * k, 3 + 2 * k), 16), b = parseInt(to.slice(1 + 2 * k, 3 + 2 * k), 16);
    return Math.round(a + part * (b - a)).toString(16).padStart(2, "0");
  };
  return "#" + channel(0) + channel(1) + channel(2);
}

// Where features are hidden: as they were up to half way, then dotted.
function drawHidden(context, layer, view, features, part, few, colours) {
  if (part < 0.5) drawFeatures(context, layer, view, features, part, colours.unmoved, colours.unmovedLine, few, 0.8);
  else drawGhosts(context, layer, view, features, colours.skippedLine);
}

// The whole picture. What moved goes from amber to green on its way.
function drawLayer(context, layer, lists, view, part, colours) {
  context.fillStyle = colours.ground;
  context.fillRect(0, 0, view.width, view.height);
  drawBarriers(context, layer, view, colours);
  let seen = 0;
  for (let f = 0; f < layer.count && seen <= fewFeatures; f++) seen += sizeInView(layer, view, f, part) >= leastShape;
  for (const status of drawingOrder) {
    const name = statusNames[status], from = name === "moved" ? "stood" : name;
    if (name === "hidden") {
      drawHidden(context, layer, view, lists[status], part, seen <= fewFeatures, colours);
      continue;
    }
    const fill = part === 1 ? colours[name] : mix(colours[from], colours[name], part);
    const line = part === 1 ? colours[name + "Line"] : mix(colours[from + "Line"], colours[name + "Line"], part);
    drawFeatures(context, layer, view, lists[status], part, fill, line, seen <= fewFeatures, name === "blocked" ? 1.8 : 0.8);
  }
  if (seen <= fewFeatures) drawUnderpasses(context, layer, view, colours);
  if (part > 0)
    for (const status of [0, 2, 1, 3]) {
      drawGhosts(context, layer, view, lists[status], colours.stoodLine);
      drawArrows(context, layer, view, lists[status], colours);
    }
  if (part === 1) drawLinks(context, layer, view, colours);
}
