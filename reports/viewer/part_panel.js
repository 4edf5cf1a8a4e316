// Describes one pixel of a judged picture: its verdict, its stored values, all that it may show.

import { element, fact } from './dom.js';
import { swatch } from './legend.js';
import { shortestFloat32 } from './numbers.js';
import { isWrongPixel, stepsFrom } from './part.js';

const kDecimals = { 255: 3, 65535: 5 };
const kTooManySteps = 1e6; // between floats whose digits say it all
const exactly = (text) => element('span', { class: 'value' }, text);
const aside = (text) => element('small', {}, text);

/** The number that a stored value stands for; of sRGB the integer itself. */
function numberText({ scale, isEncoded }, stored) {
  if (scale === 1 || isEncoded) return shortestFloat32(stored);
  return (stored / scale).toFixed(kDecimals[scale]);
}

function rangeText(texts) {
  return texts[0] === texts[1] ? texts[0] : `${texts[0]} to ${texts[1]}`;
}

/** "0.161 to 0.165" and "41 to 42 of 255". */
function wordsOf(channel, ends) {
  if (ends === null) return ['any value', ''];
  const of = `of ${channel.scale}${channel.isEncoded ? ', sRGB' : ''}`;
  const numbers = rangeText(ends.map((end) => numberText(channel, end)));
  if (channel.scale === 1) return [numbers, ''];
  return channel.isEncoded ? [numbers, of] : [numbers, `${rangeText(ends.map(String))} ${of}`];
}

const fullText = (channel, ends) => wordsOf(channel, ends).filter((text) => text !== '').join(', ');

function answerName(part, { triangle }) {
  if (triangle !== null) return `triangle ${triangle}`;
  return part.samples > 1 ? 'the mean of its samples' : 'the background';
}

function stepsOf(steps) {
  const size = Math.abs(steps);
  if (!(size < kTooManySteps)) return '';
  return size === 1 ? 'off by 1 step' : `off by ${size.toLocaleString('en')} steps`;
}

/** A sentence for each channel that is wrong, by the closest answer. */
function faultsOf(part, pixel) {
  const [closest] = pixel.answers;
  if (!isWrongPixel(pixel) || !closest) return [];
  return part.channels.flatMap((channel, c) => {
    const range = closest.ranges[c];
    const steps = stepsFrom(channel, pixel.stored[c], range);
    if (steps === 0) return [];
    const off = stepsOf(steps);
    const drawn = numberText(channel, pixel.stored[c]);
    return [`${channel.name} was drawn as ${drawn} and must be ${wordsOf(channel, range)[0]}` +
      `${off && `; ${off}`}`];
  });
}

function pixelVerdict(part, pixel) {
  const { name, meaning, colour } = part.verdicts[pixel.verdict];
  return element('p', { class: 'outcome' }, swatch(colour),
    element('strong', { class: isWrongPixel(pixel) ? 'violated' : '' }, name), ' ', aside(meaning));
}

function storedFacts(part, pixel) {
  return element('dl', { class: 'facts' }, ...part.channels.map((channel, c) => {
    const value = pixel.stored[c];
    const [number, note] = wordsOf(channel, [value, value]);
    return fact(`${channel.name} (${channel.shows})`, exactly(number), ' ', aside(note));
  }));
}

function answerFacts(part, pixel, answer) {
  const facts = part.channels.map((channel, c) => {
    const isOff = stepsFrom(channel, pixel.stored[c], answer.ranges[c]) !== 0;
    const [number, note] = wordsOf(channel, answer.ranges[c]);
    const line = fact(`${channel.name} ${isOff ? '✗' : '✓'}`, exactly(number), ' ', aside(note));
    if (isOff) line.classList.add('wrong');
    return line;
  });
  return element('div', { class: 'answer' }, element('h5', {}, answerName(part, answer)),
    element('dl', { class: 'facts' }, ...facts));
}

function explainLine(part, pixel) {
  if (part.explain === null) return [];
  const y = part.flippedHeight === null ? pixel.y : part.flippedHeight - 1 - pixel.y;
  const triangle = pixel.answers[0]?.triangle ?? null;
  const words = triangle === null ? '' : ` --triangle ${triangle}`;
  return [element('p', { class: 'explain' }, 'To explain it: ',
    element('code', {}, `${part.explain} --pixel ${pixel.x},${y}${words}`))];
}

/** All that is known of a pixel. */
export function pixelPanel(part, pixel, channel, isPinned) {
  const title = element('h4', {}, `Pixel (${pixel.x}, ${pixel.y})`, ' ',
    aside(`column ${pixel.x}, row ${pixel.y} of the file${isPinned ? ' · pinned' : ''}`));
  const faults = faultsOf(part, pixel).map((text) => element('li', {}, text));
  const heading = pixel.answers.length === 1 ? 'Permitted is' : 'Permitted is one of';
  const more = pixel.more > 0 ? [element('p', { class: 'absent' }, `and ${pixel.more} more`)] : [];
  return [title, pixelVerdict(part, pixel),
    ...(faults.length > 0 ? [element('ul', { class: 'faults' }, ...faults)] : []),
    element('h5', {}, 'Drawn'), storedFacts(part, pixel),
    element('h5', {}, heading), ...pixel.answers.map((a) => answerFacts(part, pixel, a)), ...more,
    ...explainLine(part, pixel)];
}

/** One line for those who hear it. */
export function spokenPixel(part, pixel, channel) {
  const start = `Pixel ${pixel.x}, ${pixel.y}: ${part.verdicts[pixel.verdict].name}`;
  const faults = faultsOf(part, pixel);
  if (faults.length > 0) return `${start}, ${faults.join('; ')}`;
  const value = fullText(part.channels[channel], [pixel.stored[channel], pixel.stored[channel]]);
  return `${start}, ${part.channels[channel].name} is ${value}`;
}
