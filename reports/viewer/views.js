// What each view of an inspection fills its samples with.

import { valueOf } from './inspection.js';
import { brief, briefError } from './numbers.js';
import { errorSign, errorStep, inkOn, kOddFill, kOddInk } from './palette.js';

/** The views, in the order in which they are offered: [name in links, name for readers]. */
export const kViews = [
  ['coverage', 'Coverage'],
  ['expected', 'Expected'],
  ['actual', 'Drawn'],
  ['compare', 'Compare'],
  ['difference', 'Difference'],
  ['ulp', 'ULP'],
];

/**
 * @typedef {object} Fill
 * @property {import('./inspection.js').Sample} sample
 * @property {string | null} fill  null: nothing
 * @property {string} ink  of its text
 * @property {string} text  a number, where there is room
 * @property {string} sign  where there is not
 * @property {boolean} isSign  whether it has one
 */
export const filled = (sample, fill, text, sign = '') => ({
  sample,
  fill,
  ink: fill === kOddFill ? kOddInk : inkOn(fill),
  text,
  sign,
  isSign: sign !== '',
});

/**
 * The range that colours run over: of exact values, which drawn ones may leave; of both where exact
 * ones are all the same.
 */
export function rangeOf(inspection, attribute) {
  const values = inspection.samples.flatMap((s) => valueOf(s, attribute) ?? []);
  const finite = (numbers) => numbers.filter((n) => Number.isFinite(n));
  const exact = finite(values.map((v) => v.nearest));
  const [low, high] = d3.extent(exact);
  if (low < high) return [low, high];
  const [least, most] = d3.extent([...exact, ...finite(values.map((v) => v.actual))]);
  return least === undefined ? [0, 1] : [least, most];
}

/** ▲ and ▼ for what is beyond a range. */
export function beyond(value, [low, high]) {
  return value > high ? '▲' : value < low ? '▼' : '';
}

export function valueColours(inspection, attribute) {
  const [low, high] = rangeOf(inspection, attribute);
  const domain = low === high ? [low - 1, high + 1] : [low, high];
  return d3.scaleSequential(d3.interpolateViridis).domain(domain).clamp(true);
}

/** How far values are off at most, in their own unit. */
export function largestDifference(inspection, attribute) {
  return d3.max(inspection.samples, (s) => {
    const value = valueOf(s, attribute);
    const size = value ? Math.abs(value.actual - value.nearest) : NaN;
    return Number.isFinite(size) ? size : 0;
  }) || 0;
}

export function differenceColours(most) {
  return d3.scaleLinear().domain([-most, 0, most]).range(['#d55e00', '#f7f7f4', '#0072b2'])
    .interpolate(d3.interpolateLab);
}

function fillsBy(inspection, attribute, fillOf) {
  return inspection.samples.flatMap((sample) => {
    const value = valueOf(sample, attribute);
    const fill = value && fillOf(value, sample);
    return fill ? [fill] : [];
  });
}

function expectedFills(inspection, attribute) {
  const colour = valueColours(inspection, attribute);
  return fillsBy(inspection, attribute, (value, sample) =>
    Number.isFinite(value.nearest) && sample.verdict !== 'forbidden' &&
      filled(sample, colour(value.nearest), brief(value.nearest)));
}

function oddFill(value, sample) {
  return filled(sample, kOddFill, brief(value.actual), Number.isNaN(value.actual) ? '?' : '∞');
}

function actualFills(inspection, attribute) {
  const colour = valueColours(inspection, attribute);
  const range = rangeOf(inspection, attribute);
  return fillsBy(inspection, attribute, (value, sample) => {
    if (value.hex === null) return null;
    if (!Number.isFinite(value.actual)) return oddFill(value, sample);
    const sign = beyond(Math.abs(value.error) > 0.5 ? value.actual : range[0], range);
    return filled(sample, colour(value.actual), brief(value.actual) + sign, sign);
  });
}

function differenceFills(inspection, attribute) {
  const colour = differenceColours(largestDifference(inspection, attribute) || 1);
  return fillsBy(inspection, attribute, (value, sample) => {
    if (value.hex === null) return null;
    if (!Number.isFinite(value.actual)) return oddFill(value, sample);
    const difference = value.actual - value.nearest;
    if (!Number.isFinite(difference)) return null;
    const sign = difference === 0 ? '' : difference > 0 ? '+' : '−';
    return filled(sample, colour(difference), brief(difference, 2), sign);
  });
}

function errorFills(inspection, attribute) {
  return fillsBy(inspection, attribute, (value, sample) => {
    if (value.hex === null) return null;
    if (!Number.isFinite(value.actual)) return oddFill(value, sample);
    const step = errorStep(value.error);
    if (!step) return null;
    const fill = filled(sample, step.fill, briefError(value.error), errorSign(value.error));
    return { ...fill, ink: step.ink };
  });
}

/**
 * The layers of a view, from below; of a comparison the second is on its right side only.
 * @returns {{fills: Fill[], side: 'all' | 'right'}[]}
 */
export function fillsOf(inspection, view, attribute) {
  const all = (fills, side = 'all') => ({ fills: fills(inspection, attribute), side });
  switch (view) {
    case 'expected':
      return [all(expectedFills)];
    case 'actual':
      return [all(actualFills)];
    case 'compare':
      return [all(expectedFills), all(actualFills, 'right')];
    case 'difference':
      return [all(differenceFills)];
    case 'ulp':
      return [all(errorFills)];
    default:
      return [];
  }
}
