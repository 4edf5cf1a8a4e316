// The kinds of things that the viewer shows: an inspection of a run, or a part of a judged picture.
// A kind reads the page's data and says what the viewer's controls, picture and panel have.

import { isOdd, parseInspection, valuesOf, worstOf } from './inspection.js';
import { matrixOf, panelOf, spoken } from './inspector.js';
import { legendOf } from './legend.js';
import { channelsOf, farthestPixel, isWrongPixel, parsePart, worstChannel } from './part.js';
import { pixelPanel, spokenPixel } from './part_panel.js';
import { kPartViews, partFills, partLegend } from './part_views.js';
import { fillsOf, kViews } from './views.js';

/**
 * @typedef {object} Kind
 * @property {(text: string) => object} parse  has at least the members of an Inspection that
 *   geometry.js needs, `samples`, `outlines`, and the place looked for
 * @property {[string, string][]} views  name in links, name for readers
 * @property {string} label  of the picture, for those who hear it
 * @property {string} keys  what keys do
 * @property {string} valueName  what is chosen to be shown
 * @property {string} expected  names the left side of a comparison
 * @property {object} jumps  labels of the buttons, and the samples that they lead to
 */

/** @type {Kind} */
export const kInspectionKind = {
  parse: parseInspection,
  views: kViews,
  label: 'Pixels of the inspected part',
  keys: 'Arrow keys move, S selects the pixel’s next sample, Enter pins, Escape unpins.',
  valueName: 'Value',
  expected: 'expected',
  jumps: {
    first: 'Sample in question',
    largest: 'Largest error',
    next: 'Next wrong sample',
    isOdd,
    worstOf,
  },
  firstView: ({ value, attributes }) => ({
    view: value === null ? 'coverage' : 'ulp',
    attribute: value ?? (attributes.length > 0 ? 0 : -1),
  }),
  valuesOf,
  fillsOf,
  legendOf,
  panelOf,
  spoken,
  below: (inspection) => [matrixOf(inspection)],
  hasTarget: () => true,
  hasPoints: (view) => view !== 'coverage',
  hasAllSigns: (view) => view === 'coverage',
  hasOddSigns: (view, side) => side === 'right' || ['ulp', 'difference', 'actual'].includes(view),
  outlineClass: ({ triangle }, _, i) => (i === triangle ? 'outline' : 'outline other'),
};

/** @type {Kind} */
export const kPartKind = {
  parse: parsePart,
  views: kPartViews,
  label: 'Pixels of this part of the picture',
  keys: 'Arrow keys move, Enter pins, Escape unpins. Outlines: the triangles that may be seen.',
  valueName: 'Channel',
  expected: 'permitted',
  jumps: {
    first: 'Pixel in question',
    largest: 'Farthest off',
    next: 'Next wrong pixel',
    isOdd: isWrongPixel,
    worstOf: farthestPixel,
  },
  firstView: (part) => ({
    view: part.samples.some(isWrongPixel) ? 'verdict' : 'picture',
    attribute: worstChannel(part),
  }),
  valuesOf: channelsOf,
  fillsOf: partFills,
  legendOf: partLegend,
  panelOf: pixelPanel,
  spoken: spokenPixel,
  below: () => [],
  hasTarget: (part) => part.samples.some(isWrongPixel),
  hasPoints: () => false,
  hasAllSigns: () => false,
  hasOddSigns: () => false,
  outlineClass: ({ triangles }, pixel, i) =>
    (pixel.answers.some((a) => a.triangle === triangles[i]) ? 'outline' : 'unseen-outline'),
};
