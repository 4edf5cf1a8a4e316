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

/** Sorts a table by a column: its bodies, if a body is a row with its details, or else its rows. Equal ones stay. */
function sortBy(table, column, direction, numeric) {
  const bodies = [...table.tBodies];
  const isByBody = bodies.length > 1 || bodies[0].querySelector(':scope > tr.more') !== null;
  const parts = isByBody ? bodies : [...bodies[0].rows];
  const keyed = parts.map((part) => {
    const row = part.rows ? part.rows[0] : part;
    return { part, key: keyOf(row.cells[column], numeric) };
  });
  keyed.sort((a, b) => direction * compare(a.key, b.key));
  (isByBody ? table : bodies[0]).append(...keyed.map(({ part }) => part));
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
