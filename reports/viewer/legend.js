// What the colours and signs of a view mean.

import { element } from './dom.js';
import { glyphPicture } from './glyphs.js';
import { isOdd, outcomeOf } from './inspection.js';
import { brief } from './numbers.js';
import { kErrorSteps, kOddFill, kOutcomes } from './palette.js';
import { differenceColours, largestDifference, rangeOf } from './views.js';

export const swatch = (fill, sign = '') => {
  const node = element('span', { class: 'swatch', 'aria-hidden': 'true' }, sign);
  node.style.background = fill;
  return node;
};
export const item = (sign, ...text) => element('li', {}, sign, ...text);

/** A bar of colours between its two ends. */
export function ramp(low, high, colour, what) {
  const stops = d3.range(0, 1.01, 0.125).map((t) => colour(t));
  const bar = element('span', { class: 'ramp', 'aria-hidden': 'true' });
  bar.style.background = `linear-gradient(to right, ${stops.join(',')})`;
  return element('li', { class: 'wide' }, brief(low), bar, brief(high), ` ${what}`);
}

function outcomes(inspection, wanted) {
  const seen = new Set(inspection.samples.map(outcomeOf));
  return kOutcomes.filter(([name]) => wanted(name) && seen.has(name))
    .map(([name, text]) => item(glyphPicture(name, 16), text));
}

function oddItems(inspection) {
  if (!inspection.samples.some(isOdd)) return [];
  const hasOdd = inspection.samples.some((s) =>
    s.values.some((v) => v.hex !== null && !Number.isFinite(v.actual)));
  const wrong = outcomes(inspection, (name) => name === 'missing' || name === 'extra');
  return hasOdd ? [...wrong, item(swatch(kOddFill, '?'), 'drawn: NaN or ∞')] : wrong;
}

function ofView(inspection, view, attribute) {
  if (view === 'coverage') return outcomes(inspection, () => true);
  if (view === 'ulp') {
    const steps = kErrorSteps.map(({ fill, label }) => item(swatch(fill), label));
    return [element('li', { class: 'title' }, 'scale ULP:'), ...steps,
      item('', '▲ above, ▼ below the exact value by more than ½'), ...oddItems(inspection)];
  }
  if (view === 'difference') {
    const most = largestDifference(inspection, attribute);
    const colour = differenceColours(1);
    return [ramp(-most, most, (t) => colour(2 * t - 1), 'drawn − exact'),
      ...oddItems(inspection)];
  }
  const values = ramp(...rangeOf(inspection, attribute), d3.interpolateViridis, 'value');
  const beyond = item('', '▲ ▼ drawn beyond the range of exact values');
  return view === 'expected' ? [values] : [values, beyond, ...oddItems(inspection)];
}

/** The legend of a view. */
export function legendOf(inspection, view, attribute) {
  const target = element('span', { class: 'target-sign', 'aria-hidden': 'true' });
  return [...ofView(inspection, view, attribute), item(target, 'the sample in question')];
}
