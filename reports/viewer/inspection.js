// An inspection, from the page's data (reports/internal/inspection_data.h).

import { hexFloat, numberOf } from './numbers.js';

/**
 * @typedef {object} Value  depth or an attribute of one sample
 * @property {number} attribute  its index, -1 for depth
 * @property {string | null} exact  a fraction, or a range of two
 * @property {number} nearest  the double nearest to it; NaN without one
 * @property {string | null} hex  what was drawn, as a hex float; null where nothing was
 * @property {number} actual  the same as a number
 * @property {string | null} scaleError  signed, scale ULP, certain digits
 * @property {string | null} localError
 * @property {string | null} excess
 * @property {string | null} kappa
 * @property {string | null} kappaD
 * @property {number} error  the scale error as a number, NaN without one
 *
 * @typedef {object} Sample
 * @property {number} x  pixels of the window
 * @property {number} y
 * @property {number} sample  index into the pattern
 * @property {string} verdict  required, forbidden, permitted
 * @property {string} reason
 * @property {boolean} drawn
 * @property {string | null} distance  to the boundary that decided, pixels
 * @property {string[] | null} edges  e_0, e_1, e_2, and their sum D
 * @property {Value[]} values
 *
 * @typedef {object} Inspection
 * @property {string} rules
 * @property {boolean} isUp  window y points up
 * @property {[string, string][]} attributes  name and interpolation
 * @property {[number, number][]} pattern
 * @property {number} triangle
 * @property {number} x  of the sample looked for, as the next two
 * @property {number} y
 * @property {number} sample
 * @property {number | null} value  the attribute looked for, -1 for depth, null for coverage
 * @property {string[][] | null} q
 * @property {[number, number][][]} outlines
 * @property {number} left  the part: pixels of the window
 * @property {number} top
 * @property {number} width
 * @property {number} height
 * @property {boolean} shortened
 * @property {Sample[]} samples
 */

const value = ([attribute, exact, nearest, hex, scaleError, localError, excess, kappa, kappaD]) => ({
  attribute,
  exact,
  nearest: nearest === null ? NaN : nearest,
  hex,
  actual: hex === null ? NaN : hexFloat(hex),
  scaleError,
  localError,
  excess,
  kappa,
  kappaD,
  error: numberOf(scaleError),
});

/**
 * @param {string} text  the page's data
 * @returns {Inspection}
 */
export function parseInspection(text) {
  const data = JSON.parse(text);
  const samples = data.samples.map(
    ([x, y, sample, verdict, reason, drawn, distance, edges, values]) => ({
      x: x + data.left,
      y: y + data.top,
      sample,
      verdict,
      reason,
      drawn: drawn === 1,
      distance,
      edges,
      values: values.map(value),
    }),
  );
  return { ...data, isUp: data.rules === 'opengl', samples };
}

/**
 * What may be chosen to be shown: depth, then the attributes.
 * @param {Inspection} inspection
 * @returns {{attribute: number, name: string}[]}
 */
export function valuesOf(inspection) {
  const attributes = inspection.attributes.map(([name, interpolation], attribute) => ({
    attribute,
    name: `${name || `attribute ${attribute}`} (${interpolation})`,
  }));
  return [{ attribute: -1, name: 'depth' }, ...attributes];
}

/** @returns {Sample | undefined} */
export function sampleAt(inspection, x, y, sample) {
  return inspection.samples.find((s) => s.x === x && s.y === y && s.sample === sample);
}

/** @returns {Value | undefined} */
export function valueOf(sample, attribute) {
  return sample.values.find((v) => v.attribute === attribute);
}

/**
 * How a sample came out: what the rules say of it against what was drawn.
 * @param {Sample} sample
 * @returns {'right' | 'empty' | 'missing' | 'extra' | 'either drawn' | 'either empty'}
 */
export function outcomeOf({ verdict, drawn }) {
  if (verdict === 'permitted') return drawn ? 'either drawn' : 'either empty';
  if (verdict === 'required') return drawn ? 'right' : 'missing';
  return drawn ? 'extra' : 'empty';
}

/** Whether more is wrong of a sample than a number can say. */
export function isOdd(sample) {
  const outcome = outcomeOf(sample);
  return outcome === 'missing' || outcome === 'extra' ||
    sample.values.some((v) => v.hex !== null && !Number.isFinite(v.actual));
}

/**
 * The sample whose value is farthest off.
 * @returns {Sample | undefined}
 */
export function worstOf(inspection, attribute) {
  let worst;
  let most = -1;
  for (const sample of inspection.samples) {
    const error = Math.abs(valueOf(sample, attribute)?.error ?? NaN);
    if (error > most) [worst, most] = [sample, error];
  }
  return worst;
}
