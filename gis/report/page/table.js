// table.js: tables that sort by the column whose head is chosen; and the beginning of it all.

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
    button.textContent = cell.textContent;
    button.addEventListener("click", () => sortTable(table, column));
    cell.replaceChildren(button);
  });
}

for (const table of document.querySelectorAll("table.sortable")) makeSortable(table);
const layer = readLayer(JSON.parse(document.getElementById("map-data").textContent));
if (layer.count > 0) makeMap(layer);
