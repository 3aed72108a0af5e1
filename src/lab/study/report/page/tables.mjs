// SPDX-License-Identifier: Apache-2.0
// Numbers, words and tables of a report. A table is sorted by the column that its data name, or by the column whose head the
// reader clicks: ascending, descending, and then in the order of the data. Text in the table's search field, or in that of the whole page, filters the rows.
import { element } from "../../../../explorer/page/dom.mjs";

const dash = "–", fewRows = 8, manyIntervals = 5, manyColumns = 8; // beyond these, intervals are below values
const wideColumns = 6; // beyond this, the first column keeps room for names on narrow screens
const longRows = 40; // beyond this, the rows scroll below the head

// ---- Numbers and words

// Formats a number like %.<digits>g in C.
function general(value, digits) {
  if (value === 0) return "0";
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e").map((part, i) => i ? +part : part);
  const trimmed = text => text.includes(".") ? text.replace(/\.?0+$/, "") : text;
  if (exponent >= -4 && exponent < digits) return trimmed(value.toFixed(digits - 1 - exponent));
  return `${trimmed(mantissa)}e${exponent < 0 ? "-" : "+"}${String(Math.abs(exponent)).padStart(2, "0")}`;
}

const shown = (value, column) =>
  column.decimals === undefined ? general(value, column.digits ?? 4) : value.toFixed(column.decimals);

export const words = runs => runs.map(run => {
  if (typeof run === "string") return run;
  return run.style ? element(run.style, {}, run.text) : run.text;
});

export const plain = runs => runs.map(run => run.text ?? run).join("");

const taken = new Map(); // how often each id occurred; studies of several plans may repeat ids
export function unique(id) {
  if (!id) return null;
  const number = (taken.get(id) ?? 0) + 1;
  taken.set(id, number);
  return number === 1 ? id : `${id}-${number}`;
}

// ---- Tables

const small = text => element("span", { class: "pm" }, text);

// The text after a value: its interval or its standard deviation.
function spread({ value, low, high, sd }, column) {
  const half = h => column.decimals === undefined || h < 0.5 * 10 ** -column.decimals ? general(h, 2) : h.toFixed(column.decimals);
  if (typeof sd === "number") return [" ", small(`± ${general(sd, 2)}`)];
  if (typeof low === "number" && high - low <= 1e-12 * Math.abs(value)) return []; // rounding
  if (typeof low !== "number" || typeof high !== "number") return column.type === "interval" ? [" ", small("± ?")] : [];
  if (Math.abs(high - value - (value - low)) < 1e-6 * (high - low)) return [" ", small(`± ${half(high - value)}`)];
  return [" ", small(`${half(low)} …`), " ", small(half(high))]; // a narrow column breaks between the two
}

// The mark of a verdict with z or the relative change after it.
function verdictMark(cell) {
  if (cell.verdict === "new" || cell.verdict === "waiting") return cell.verdict === "new" ? "new" : "not yet";
  const signed = (v, digits) => /[1-9]/.test(v.toFixed(digits)) ? `${v < 0 ? "" : "+"}${v.toFixed(digits)}` : (0).toFixed(digits); // no -0.0
  const number = cell.z === undefined ? `${signed(100 * cell.change, 0)}\u00a0%` : signed(cell.z, 1);
  const mark = cell.verdict === "fitted" ? "fitted" : cell.note ? `note ${cell.note}` : cell.verdict === "unexplained" ? "✗" : "✓";
  const name = { fitted: "note", explained: "note", untested: "note", unexplained: "bad" }[cell.verdict] ?? "good";
  return element("span", { class: name }, cell.verdict === "untested" ? mark : `${mark}\u00a0${number}`);
}

// A text that may break between the parts of a name ("sobol:" "scramble=" "owen"), not within a word or a number.
const nameParts = text => text.split(/(?<=[_:=,/])(?=[^\s_:=,./])|(?<=\.)(?=[^\s_:=,./\d])/).flatMap((part, i) => i ? [element("wbr", {}), part] : [part]);

// The content of a cell, whose data are a text, a number, [value, low, high], or an object with more fields.
function cellContent(cell, column) {
  if (typeof cell === "string") return nameParts(cell);
  if (typeof cell === "number") return [shown(cell, column)];
  const data = Array.isArray(cell) ? { value: cell[0], low: cell[1], high: cell[2] } : cell ?? {};
  if (column.type === "verdict") return [verdictMark(data)];
  const content = [];
  if (data.text !== undefined) content.push(...nameParts(data.text));
  else if (typeof data.value === "number") content.push(shown(data.value, column), ...spread(data, column));
  else content.push(dash);
  if (data.sets) content.push(" ", small(`(${data.sets} set${data.sets > 1 ? "s" : ""})`));
  if (data.verdict) content.push(" ", verdictMark(data));
  else if (data.note) content.push("\u00a0", element("sup", { class: "note" }, data.note)); // else copied digits run together
  return content;
}

// The number of rows, from this one on, that a cell of a merged column spans; 0: a cell above spans this row.
function span(rows, row, column) {
  const same = i => rows[i] && rows[i][column] === rows[row][column];
  if (same(row - 1)) return 0;
  let n = 1;
  while (same(row + n)) n++;
  return n;
}

function groupHeads(columns) {
  const heads = [];
  for (const { group = "" } of columns) {
    if (heads.length && group && heads.at(-1).group === group) heads.at(-1).n++;
    else heads.push({ group, n: 1 });
  }
  return element("tr", {}, ...heads.map(({ group, n }) => element("th", { colspan: n > 1 ? n : null, scope: group ? "colgroup" : null }, group)));
}

// The key by which a row is sorted; null if the cell has no value.
const sortKey = cell => (Array.isArray(cell) ? cell[0] : cell !== null && typeof cell === "object" ? cell.value : cell) ?? null;

// Sorts rows by a column. Rows without a value come last; rows with equal values keep their order.
function sorted(rows, { c, descending }) {
  const sign = descending ? -1 : 1, keys = new Map(rows.map(r => [r, sortKey(r.row[c])]));
  return [...rows].sort((r, s) => {
    const [a, b] = [keys.get(r), keys.get(s)];
    if (a === null || b === null) return (a === null) - (b === null);
    return sign * (typeof a === "string" || typeof b === "string" ? String(a).localeCompare(String(b)) : a - b);
  });
}

// The order of the rows after a click on the head of a column.
const nextOrder = (order, c) => order?.c !== c ? { c } : order.descending ? null : { c, descending: true };

const filters = []; // one function per table, called when the search field of the page changes

export function filterTables(text) {
  filters.forEach(filter => filter(text));
}

// Makes row r of a table; `rows` are all rows, because a merged cell spans rows below it.
function rowNode(rows, r, visible) {
  const rest = visible[0].merged && !span(rows, r, visible[0].c); // a cell above spans this row
  return element("tr", { class: rest ? "rest" : null }, ...visible.map((column, i) => {
    const cell = rows[r][column.c];
    if (cell === undefined) return null;
    const spanned = column.merged ? span(rows, r, column.c) : 1, name = column.type === "text" ? "name" : null;
    if (!spanned) return null;
    if (column.merged) return element("th", { scope: "rowgroup", rowspan: spanned, class: "name" }, ...cellContent(cell, column));
    return element(i === 0 && name ? "th" : "td", { class: name, scope: i === 0 && name ? "row" : null }, ...cellContent(cell, column));
  }));
}

export function table(block) {
  const visible = block.columns.map((column, c) => ({ ...column, c })).filter(column => !column.hidden);
  const rows = block.rows.map((row, r) => ({ row, node: rowNode(block.rows, r, visible), text: row.filter(c => typeof c === "string").join(" ").toLowerCase() }));
  const body = element("tbody", {}), state = element("output", {}), field = element("input", { type: "search", size: 16 });
  const moves = rows.length > 2 && !visible.some(column => column.merged);
  let order = block.sort ? { ...block.sort, c: block.columns.findIndex(column => column.name === block.sort.column) } : null, wanted = "";
  // Chromium repeats the head of a table on each printed page, but without its buttons, so CSS prints data-head.
  const heads = visible.map(column => element("th", { scope: "col", class: column.type === "text" ? "name" : null, "data-head": moves ? column.title ?? column.name : null },
    ...(moves ? [element("button", { type: "button" }, ...nameParts(column.title ?? column.name))] : nameParts(column.title ?? column.name))));
  const show = () => {
    const has = [wanted, field.value.trim().toLowerCase()], shown = (order ? sorted(rows, order) : rows).filter(r => has.every(text => r.text.includes(text)));
    body.replaceChildren(...(moves ? shown : rows).map(r => r.node));
    state.textContent = moves ? `${shown.length === rows.length ? rows.length : `${shown.length} of ${rows.length}`} rows.` : "";
    heads.forEach((head, i) => {
      const mine = order?.c === visible[i].c, name = !mine ? null : order.descending ? "descending" : "ascending";
      if (name) head.setAttribute("aria-sort", name);
      else head.removeAttribute("aria-sort");
    });
  };
  heads.forEach((head, i) => head.firstChild.addEventListener?.("click", () => { order = nextOrder(order, visible[i].c); show(); }));
  field.addEventListener("input", show);
  if (moves) filters.push(text => { wanted = text; show(); });
  show();
  const tools = moves ? element("div", { class: "tools" }, rows.length > fewRows ? element("label", {}, "rows with ", field) : null, state) : null;
  const grouped = visible.some(column => column.group);
  const node = element("div", { class: rows.length > longRows ? "scroll long" : "scroll", tabindex: 0, role: "region", "aria-label": `table ${block.name}` },
    element("table", { class: visible.filter(c => c.type === "interval").length > manyIntervals || visible.length > manyColumns ? "many wide" : grouped || visible.length > wideColumns ? "wide" : null }, element("thead", {}, grouped ? groupHeads(visible) : null, element("tr", {}, ...heads)), body));
  return [tools, node].filter(Boolean);
}
