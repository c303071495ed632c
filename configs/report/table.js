// Tables that sort by a click on a column's title; a second click reverses.

function sortKey(cell) {
  if (cell.dataset.value !== undefined) return Number(cell.dataset.value);
  return cell.classList.contains("none") ? null : cell.textContent;
}

// Numbers before text, empty cells last in either direction.
function compareKeys(a, b, direction) {
  if (a === null || b === null) return (a === null) - (b === null);
  if (typeof a !== typeof b) return typeof a === "number" ? -1 : 1;
  return direction * (typeof a === "number" ? a - b : a.localeCompare(b, "en", {numeric: true}));
}

function sortBy(table, column, descending) {
  const body = table.tBodies[0];
  const keyed = Array.from(body.rows, (row) => [sortKey(row.cells[column]), row]);
  keyed.sort(([a], [b]) => compareKeys(a, b, descending ? -1 : 1));
  body.append(...keyed.map(([, row]) => row));
  Array.from(table.tHead.rows[0].cells, (head, index) => {
    if (index === column) head.setAttribute("aria-sort", descending ? "descending" : "ascending");
    else head.removeAttribute("aria-sort");
  });
}

function makeSortable(table) {
  Array.from(table.tHead.rows[0].cells, (head, column) => {
    const button = element("button", {type: "button", title: "Sort"}, ...head.childNodes);
    head.replaceChildren(button);
    button.addEventListener("click", () => sortBy(table, column, head.getAttribute("aria-sort") === "ascending"));
  });
}
