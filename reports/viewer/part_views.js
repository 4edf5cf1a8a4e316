// The views of a part of a judged picture: the fills of its pixels, and what their colours mean.

import { element } from './dom.js';
import { item, ramp, swatch } from './legend.js';
import { brief, briefError } from './numbers.js';
import { inkOn, kOddFill } from './palette.js';
import { channelSteps, isWrongPixel } from './part.js';
import { beyond, filled } from './views.js';

export const kPartViews = [
  ['picture', 'Picture'],
  ['verdict', 'Verdict'],
  ['permitted', 'Permitted'],
  ['drawn', 'Drawn'],
  ['compare', 'Compare'],
  ['difference', 'Difference'],
];

/** Steps beyond what is permitted; the page's picture of them has the same colours. */
const kStepKinds = [
  { most: 0, fill: '#404040', label: '0' },
  { most: 1, fill: '#8b5cba', label: '1' },
  { most: 4, fill: '#ce4c8c', label: '≤ 4' },
  { most: 64, fill: '#f57d5f', label: '≤ 64' },
  { most: Infinity, fill: '#ffde8c', label: '> 64' },
];

/** A sign for each verdict, beside its colour. */
const kVerdictSigns = ['', '≠', '△', '+', '−', '?', '·'];

function permittedRange(pixel, channel) {
  return pixel.answers[0]?.ranges[channel] ?? null;
}

/** The range that the colours of a channel run over: of permitted numbers, or of drawn ones. */
function channelRange(part, channel) {
  const finite = (numbers) => numbers.filter((n) => Number.isFinite(n));
  const permitted = finite(part.samples.flatMap((p) => permittedRange(p, channel) ?? []));
  const [low, high] = d3.extent(permitted);
  if (low < high) return [low, high];
  const drawn = finite(part.samples.map((p) => p.stored[channel]));
  const [least, most] = d3.extent([...permitted, ...drawn]);
  return least === undefined ? [0, 1] : [least, most];
}

function channelColours(part, channel) {
  const [low, high] = channelRange(part, channel);
  const domain = low === high ? [low - 1, high + 1] : [low, high];
  return d3.scaleSequential(d3.interpolateViridis).domain(domain).clamp(true);
}

function permittedFills(part, channel) {
  const colour = channelColours(part, channel);
  return part.samples.flatMap((pixel) => {
    const range = permittedRange(pixel, channel);
    if (!range) return [];
    const [least, greatest] = range;
    const middle = Math.max(-Number.MAX_VALUE, least) / 2 +
      Math.min(Number.MAX_VALUE, greatest) / 2;
    const [low, high] = [brief(least), brief(greatest)];
    return [filled(pixel, colour(middle), low === high ? low : `${low}…${high}`)];
  });
}

function drawnFills(part, channel) {
  const colour = channelColours(part, channel);
  const range = channelRange(part, channel);
  return part.samples.map((pixel) => {
    const value = pixel.stored[channel];
    if (!Number.isFinite(value)) return filled(pixel, kOddFill, brief(value), '?');
    const sign = beyond(value, range);
    return filled(pixel, colour(value), brief(value) + sign, sign);
  });
}

function stepFills(part, channel) {
  return part.samples.map((pixel) => {
    const steps = channelSteps(part, pixel, channel);
    if (Number.isNaN(steps)) return filled(pixel, '#ffffff', 'NaN', '?');
    const { fill } = kStepKinds.find(({ most }) => Math.abs(steps) <= most);
    return filled(pixel, fill, briefError(steps), steps === 0 ? '' : steps > 0 ? '▲' : '▼');
  });
}

const colourFills = (part) => part.samples.map((pixel) => filled(pixel, pixel.colour, ''));
const verdictFills = (part) => part.samples.map((pixel) => {
  const sign = kVerdictSigns[pixel.verdict];
  return filled(pixel, part.verdicts[pixel.verdict].colour, sign, sign);
});

/** The layers of a view, as fillsOf() of views.js has them. */
export function partFills(part, view, channel) {
  switch (view) {
    case 'verdict':
      return [{ fills: verdictFills(part), side: 'all' }];
    case 'permitted':
      return [{ fills: permittedFills(part, channel), side: 'all' }];
    case 'drawn':
      return [{ fills: drawnFills(part, channel), side: 'all' }];
    case 'compare':
      return [{ fills: permittedFills(part, channel), side: 'all' },
        { fills: drawnFills(part, channel), side: 'right' }];
    case 'difference':
      return [{ fills: stepFills(part, channel), side: 'all' }];
    default:
      return [{ fills: colourFills(part), side: 'all' }];
  }
}

function verdictItems(part) {
  const seen = new Set(part.samples.map((pixel) => pixel.verdict));
  return part.verdicts.flatMap(({ name, meaning, colour }, i) => {
    if (!seen.has(i)) return [];
    const square = swatch(colour, kVerdictSigns[i]);
    square.style.color = inkOn(colour);
    return [item(square, `${name}: ${meaning}`)];
  });
}

function viewItems(part, view, channel) {
  if (view === 'picture') return [];
  if (view === 'verdict') return verdictItems(part);
  if (view === 'difference') {
    return [item('', 'steps beyond what is permitted:'),
      ...kStepKinds.map(({ fill, label }) => item(swatch(fill), label)),
      item('', '▲ above, ▼ below')];
  }
  const { scale } = part.channels[channel];
  const colours = ramp(...channelRange(part, channel), d3.interpolateViridis,
    scale > 1 ? `stored value, of ${scale}` : 'value');
  const over = item('', '▲ ▼ drawn beyond the range of permitted values');
  return view === 'permitted' ? [colours] : [colours, over];
}

export function partLegend(part, view, channel) {
  const target = element('span', { class: 'target-sign', 'aria-hidden': 'true' });
  const isMarked = part.samples.some(isWrongPixel);
  const mark = isMarked ? [item(target, 'the pixel in question')] : [];
  return [...viewItems(part, view, channel), ...mark];
}
