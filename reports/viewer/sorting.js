// Tables that are sorted by their headers.

import { element } from './dom.js';

const kNumber = /^[^\d−-]*([−-]?[\d,]*\.?\d+(?:e[+-]?\d+)?)/i;

/**
 * What a cell is sorted by: its number, or its text.
 * @param {HTMLTableCellElement} cell
 * @param {boolean} numeric
 * @returns {number | string}
 */
export function keyOf(cell, numeric) {
  const text = cell.textContent.trim();
  if (!numeric) return text.toLowerCase();
  const number = kNumber.exec(text);
  if (!number) return /^\W*inf/i.test(text) ? Infinity : -Infinity;
  return Number(number[1].replaceAll(',', '').replace('−', '-'));
}

function compare(a, b) {
  return a < b ? -1 : a > b ? 1 : 0;
}

/** Sorts a table's rows by a column; equal ones stay as they are. */
function sortBy(table, column, direction, numeric) {
  const body = table.tBodies[0];
  const rows = [...body.rows].map((row) => ({ row, key: keyOf(row.cells[column], numeric) }));
  rows.sort((a, b) => direction * compare(a.key, b.key));
  body.append(...rows.map(({ row }) => row));
}

/** Makes the headers of a table sort it. Numbers come largest first. */
export function makeSortable(table) {
  const headers = [...table.tHead.rows[0].cells];
  headers.forEach((header, column) => {
    const numeric = header.classList.contains('number');
    const button = element('button', { type: 'button', class: 'sort' }, ...header.childNodes);
    header.replaceChildren(button);
    header.setAttribute('aria-sort', 'none');
    button.addEventListener('click', () => {
      const was = header.getAttribute('aria-sort');
      const first = numeric ? 'descending' : 'ascending';
      const other = numeric ? 'ascending' : 'descending';
      const now = was === first ? other : first;
      headers.forEach((h) => h.setAttribute('aria-sort', h === header ? now : 'none'));
      sortBy(table, column, now === 'ascending' ? 1 : -1, numeric);
    });
  });
}
