// data.js: the map's data, from the texts that the program wrote (report/map_data.c) to arrays of numbers. Coordinates
// are in units of the layer, from the lower left corner of its box.

// Variable-length quantities in base 64, as in source maps.
const letterValue = new Int8Array(128).fill(-1);
for (let i = 0; i < 64; i++)
  letterValue["ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/".charCodeAt(i)] = i;

// Reads one number after the other. No shifts: numbers may have more bits than these have.
function numberReader(text) {
  let at = 0;
  return {
    more: () => at < text.length,
    next() {
      let value = 0, place = 1, digit;
      do {
        digit = letterValue[text.charCodeAt(at++)];
        value += (digit & 31) * place;
        place *= 32;
      } while (digit & 32);
      return value % 2 ? -(value - 1) / 2 : value / 2;
    },
  };
}

// In the order of the digits of `status`.
const statusNames = ["unmoved", "moved", "fixed", "blocked", "skipped", "hidden"];

// A feature f has the rings [ringsOf[f], ringsOf[f + 1]), a ring r the corners [cornersOf[r], cornersOf[r + 1]).
function readShapes(text, count, step) {
  const reader = numberReader(text), ringsOf = new Uint32Array(count + 1), cornersOf = [0], corners = [];
  let x = 0, y = 0;
  for (let f = 0; f < count; f++) {
    for (let n = reader.next(); n > 0; n = reader.next()) {
      for (let i = 0; i < n; i++) {
        x += reader.next();
        y += reader.next();
        corners.push(x * step, y * step);
      }
      cornersOf.push(corners.length / 2);
    }
    ringsOf[f + 1] = cornersOf.length - 1;
  }
  return { ringsOf, cornersOf: Uint32Array.from(cornersOf), corners: Float64Array.from(corners) };
}

// Barriers: a width, lines, rings, each a flat list of coordinates; and the box of it all, the width included.
function readBarriers(text, step) {
  const reader = numberReader(text), barriers = [];
  let x = 0, y = 0;
  while (reader.more()) {
    const barrier = { width: reader.next() * step, lines: [], rings: [] }, xs = [], ys = [];
    for (const parts of [barrier.lines, barrier.rings])
      for (let n = reader.next(); n > 0; n = reader.next()) {
        const part = new Float64Array(2 * n);
        for (let i = 0; i < 2 * n; i += 2) {
          xs.push(part[i] = (x += reader.next()) * step);
          ys.push(part[i + 1] = (y += reader.next()) * step);
        }
        parts.push(part);
      }
    const least = (values) => values.reduce((a, b) => Math.min(a, b), Infinity) - barrier.width / 2;
    const most = (values) => values.reduce((a, b) => Math.max(a, b), -Infinity) + barrier.width / 2;
    barriers.push(Object.assign(barrier, { box: [least(xs), least(ys), most(xs), most(ys)] }));
  }
  return barriers.sort((a, b) => a.width - b.width); // so that many can be drawn at once
}

// The boxes of features, before and after together.
function boxesOf(before, after, count) {
  const boxes = new Float64Array(4 * count);
  for (let f = 0; f < count; f++) {
    let x0 = Infinity, y0 = Infinity, x1 = -Infinity, y1 = -Infinity;
    for (const shapes of [before, after])
      for (let i = shapes.cornersOf[shapes.ringsOf[f]]; i < shapes.cornersOf[shapes.ringsOf[f + 1]]; i++) {
        const x = shapes.corners[2 * i], y = shapes.corners[2 * i + 1];
        if (x < x0) x0 = x;
        if (x > x1) x1 = x;
        if (y < y0) y0 = y;
        if (y > y1) y1 = y;
      }
    boxes.set([x0, y0, x1, y1], 4 * f);
  }
  return boxes;
}

function readLayer(data) {
  const count = data.label.length, step = data.step;
  const layer = { count, step, unit: data.unit, origin: [data.box[0], data.box[1]], label: data.label };
  layer.width = data.box[2] - data.box[0];
  layer.height = data.box[3] - data.box[1];
  layer.status = Uint8Array.from(data.status, Number);
  layer.move = new Float64Array(2 * count);
  const moves = numberReader(data.move);
  for (let i = 0; i < 2 * count; i++) layer.move[i] = moves.next() * step;
  layer.anchor = new Float64Array(2 * count);
  const anchors = numberReader(data.anchor);
  for (let f = 0, x = 0, y = 0; f < count; f++) {
    if (layer.move[2 * f] === 0 && layer.move[2 * f + 1] === 0) continue;
    x += anchors.next();
    y += anchors.next();
    layer.anchor.set([x * step, y * step], 2 * f);
  }
  layer.shapes = readShapes(data.shape, count, step);
  layer.after = readShapes(data.after || "A".repeat(count), count, step);
  layer.boxes = boxesOf(layer.shapes, layer.after, count);
  layer.barriers = readBarriers(data.barrier, step);
  layer.conflicts = [];
  const links = numberReader(data.conflict);
  for (let x = 0, y = 0; links.more();) {
    const proved = links.next() !== 0, ends = [];
    for (let k = 0; k < 2; k++) {
      x += links.next();
      y += links.next();
      ends.push(x * step, y * step);
    }
    layer.conflicts.push({ proved, ends });
  }
  return layer;
}

// Did the feature become larger or smaller? From half way on it is drawn with its shape in the result.
const isChanged = (layer, f) => layer.after.ringsOf[f + 1] > layer.after.ringsOf[f];
const shapesAt = (layer, f, part) => part >= 0.5 && isChanged(layer, f) ? layer.after : layer.shapes;

// The features that are drawn together: what stands still lies lowest, what is in conflict on top.
const drawingOrder = [5, 4, 0, 2, 1, 3];

function featuresByStatus(layer) {
  const lists = statusNames.map(() => []);
  for (let f = 0; f < layer.count; f++) lists[layer.status[f]].push(f);
  return lists;
}
