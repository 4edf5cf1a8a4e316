// Brings the page to life. All that it says is there without this.

import { makeHistogram } from './histogram.js';
import { kInspectionKind, kPartKind } from './kinds.js';
import { parseLink, showLink } from './links.js';
import { makeSortable } from './sorting.js';
import { Viewer } from './viewer.js';

const viewers = new Map();

function linkOf(number, { x, y, sample, view, attribute, swipe }) {
  const members = { inspection: number, x, y, sample, view, value: attribute };
  return view === 'compare' ? { ...members, swipe } : members;
}

/** The viewer of an inspection's section, made when it is first seen. */
function viewerOf(section) {
  const number = section.dataset.inspection;
  if (viewers.has(number)) return viewers.get(number);
  const data = section.querySelector('script[type="application/json"]');
  if (!data) return null;
  const place = section.querySelector('.viewer-place');
  let isReady = false;
  const kind = section.dataset.kind === 'part' ? kPartKind : kInspectionKind;
  const viewer = new Viewer(place, kind, data.textContent, (state) => {
    if (isReady) showLink(linkOf(number, state));
  });
  isReady = true;
  viewers.set(number, viewer);
  return viewer;
}

/** The members of a link that a viewer knows, as it has them. */
function stateOf(link) {
  const state = {};
  for (const [name, key] of [['x', 'x'], ['y', 'y'], ['sample', 'sample'], ['swipe', 'swipe'],
    ['value', 'attribute']]) {
    if (link[name] !== undefined && /^-?\d+$/.test(link[name])) state[key] = Number(link[name]);
  }
  if (link.view !== undefined) state.view = link.view;
  if (link.x !== undefined) state.isPinned = true;
  return state;
}

function openSection(section) {
  for (let node = section; node; node = node.parentElement?.closest('details')) node.open = true;
  section.scrollIntoView();
}

/** Opens what the address names. */
function follow() {
  const link = parseLink(location.hash);
  if (link.inspection !== undefined) {
    const section = document.querySelector(`[data-inspection="${CSS.escape(link.inspection)}"]`);
    if (!section) return;
    openSection(section);
    viewerOf(section)?.set(stateOf(link));
  } else if (link.property !== undefined) {
    const section = [...document.querySelectorAll('details[data-property]')].find((details) =>
      details.dataset.property === link.property);
    if (section) openSection(section);
  }
}

function start() {
  document.documentElement.classList.add('scripted');
  document.querySelectorAll('table.sortable').forEach(makeSortable);
  document.querySelectorAll('figure[data-histogram]').forEach(makeHistogram);
  for (const section of document.querySelectorAll('details[data-inspection]')) {
    section.addEventListener('toggle', () => section.open && viewerOf(section));
    if (section.open) viewerOf(section);
  }
  for (const section of document.querySelectorAll('details[data-property]')) {
    section.querySelector('summary').addEventListener('click', () => {
      if (!section.open) showLink({ property: section.dataset.property });
    });
  }
  addEventListener('hashchange', follow);
  follow();
}

start();
