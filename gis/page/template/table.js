// table.js: tables that sort by the column whose head is chosen, and are one stop for the tabulator; and the beginning of
// it all.

function valueOf(row, column) {
  const cell = row.cells[column], value = cell.dataset.value;
  if (value !== undefined) return Number(value);
  return cell.classList.contains("number") ? null : cell.textContent;
}

// By number, or as people sort texts that hold numbers. What has no value comes last, whichever way it is sorted.
function compareValues(a, b, sign) {
  if (a === null || b === null) return (a === null) - (b === null);
  if (typeof a === "number") return sign * (a - b);
  return sign * a.localeCompare(b, "en", { numeric: true });
}

function sortTable(table, column) {
  const head = table.tHead.rows[0].cells[column], body = table.tBodies[0];
  const ascending = head.getAttribute("aria-sort") !== "ascending";
  for (const cell of table.tHead.rows[0].cells) cell.removeAttribute("aria-sort");
  head.setAttribute("aria-sort", ascending ? "ascending" : "descending");
  const rows = Array.from(body.rows, (row) => ({ row, value: valueOf(row, column) }));
  rows.sort((a, b) => compareValues(a.value, b.value, ascending ? 1 : -1));
  body.append(...rows.map(({ row }) => row));
}

function makeSortable(table) {
  Array.from(table.tHead.rows[0].cells, (cell, column) => {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = cell.dataset.head = cell.textContent; // on paper the head is text: buttons are not repeated there
    button.addEventListener("click", () => sortTable(table, column));
    cell.replaceChildren(button);
  });
}

// What can be chosen in a table, row after row as they stand: the heads, then the link of each row.
function stopsOf(table) {
  return Array.from(table.rows, (row) => Array.from(row.querySelectorAll("button, a"))).filter((row) => row.length > 0);
}

// Where an arrow key leads from a stop; undefined: it is no such key.
function nextStop(rows, key, from) {
  const row = rows.findIndex((each) => each.includes(from)), column = rows[row].indexOf(from);
  const at = (r) => rows[Math.min(Math.max(r, 0), rows.length - 1)];
  const beside = (c) => rows[row][Math.min(Math.max(c, 0), rows[row].length - 1)];
  const under = (r) => at(r)[Math.min(column, at(r).length - 1)];
  return {
    ArrowUp: () => under(row - 1), ArrowDown: () => under(row + 1), ArrowLeft: () => beside(column - 1),
    ArrowRight: () => beside(column + 1), PageUp: () => under(row - 10), PageDown: () => under(row + 10),
    Home: () => under(0), End: () => under(rows.length - 1),
  }[key]?.();
}

// The tabulator comes to a table once, to where it was left; arrow keys go about in it.
function makeOneStop(table) {
  const all = stopsOf(table).flat();
  let stop = all[0];
  for (const each of all) each.tabIndex = each === stop ? 0 : -1;
  table.addEventListener("focusin", (event) => {
    if (!all.includes(event.target)) return;
    stop.tabIndex = -1;
    stop = event.target;
    stop.tabIndex = 0;
  });
  table.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !all.includes(event.target)) return;
    const next = nextStop(stopsOf(table), event.key, event.target);
    if (!next) return;
    event.preventDefault();
    next.focus();
  });
  table.closest(".scroll")?.removeAttribute("tabindex"); // what can be chosen brings the rest into view
}

for (const table of document.querySelectorAll("table.sortable")) {
  makeSortable(table);
  makeOneStop(table);
}
const layer = readLayer(JSON.parse(document.getElementById("map-data").textContent));
if (layer.count > 0) makeMap(layer);
