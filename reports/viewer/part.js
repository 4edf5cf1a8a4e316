// A part of a judged picture, from the page's data (reports/internal/part_data.h). Its pixels take
// the place of an inspection's samples, one to a pixel.

/**
 * @typedef {object} Answer  what a pixel may show
 * @property {number | null} triangle  null: the background, or the mean of several samples
 * @property {([number, number] | null)[]} ranges  [channel]; null: any value
 *
 * @typedef {object} PartPixel
 * @property {number} x  pixels of the file
 * @property {number} y  row of the file
 * @property {number} sample  0
 * @property {number} verdict  index into Part.verdicts; 0 is right
 * @property {string} colour
 * @property {number[]} stored  [channel]
 * @property {Answer[]} answers  the closest first
 * @property {number} more  answers that are left out
 *
 * @typedef {object} Part
 * @property {boolean} isUp  row 0 is the lowest one
 * @property {number | null} flippedHeight  if rows run against window y: the height
 * @property {number} samples  of each pixel
 * @property {{name: string, shows: string, scale: number, isEncoded: boolean,
 *   isHalf: boolean}[]} channels
 * @property {{name: string, meaning: string, colour: string}[]} verdicts
 * @property {string | null} explain
 * @property {PartPixel[]} pixels
 */

const kRight = 0;
const kNotJudged = 6;

/** A stored number of the data, which has texts for what JSON has no number for. */
function storedNumber(value) {
  if (typeof value !== 'string') return Math.fround(value);
  return { inf: Infinity, '-inf': -Infinity }[value] ?? NaN;
}

function rangeFrom(data) {
  if (data === null) return null;
  return Array.isArray(data) ? data.map(storedNumber) : [storedNumber(data), storedNumber(data)];
}

/**
 * @param {string} text  the page's data
 * @returns {Part}
 */
export function parsePart(text) {
  const data = JSON.parse(text);
  const samples = data.pixels.map(([verdict, colour, stored, answers, more], i) => ({
    x: data.left + (i % data.width),
    y: data.top + Math.floor(i / data.width),
    sample: 0,
    verdict,
    colour,
    stored: stored.map(storedNumber),
    answers: answers.map(([triangle, ranges]) => ({ triangle, ranges: ranges.map(rangeFrom) })),
    more,
  }));
  return {
    ...data,
    sample: 0,
    pattern: [[0.5, 0.5]],
    channels: data.channels.map(([name, shows, scale, isEncoded, isHalf]) =>
      ({ name, shows, scale, isEncoded: isEncoded === 1, isHalf: isHalf === 1 })),
    verdicts: data.verdicts.map(([name, meaning, colour]) => ({ name, meaning, colour })),
    triangles: data.outlines.map(([triangle]) => triangle),
    outlines: data.outlines.map(([, points]) => points),
    samples,
  };
}

/** The channels, to be chosen from as values of an inspection are. */
export function channelsOf(part) {
  return part.channels.map(({ name, shows }, attribute) =>
    ({ attribute, name: `${name} (${shows})` }));
}

export function isWrongPixel({ verdict }) {
  return verdict !== kRight && verdict !== kNotJudged;
}

const kFloat = new DataView(new ArrayBuffer(4));
/** The number of a float32, or of a float16, in the order of all of them. */
function orderOf({ isHalf }, value) {
  const size = Math.abs(value);
  kFloat.setFloat32(0, size);
  let order = kFloat.getInt32(0);
  if (isHalf) order = size < 2 ** -14 ? size * 2 ** 24 : (order >> 13) - (112 << 10);
  if (isHalf && size === Infinity) order = 0x7c00;
  return value < 0 ? -order : order;
}

/** Steps from a stored value to a range, signed; 0 within it, NaN for NaN. */
export function stepsFrom(channel, stored, range) {
  if (range === null) return 0;
  if (Number.isNaN(stored)) return NaN;
  const [least, greatest] = range;
  if (stored >= least && stored <= greatest) return 0;
  const end = stored < least ? least : greatest;
  return channel.scale > 1 ? stored - end : orderOf(channel, stored) - orderOf(channel, end);
}

/** Steps of one channel from the closest answer. */
export function channelSteps(part, pixel, channel) {
  const answer = pixel.answers[0];
  return answer ? stepsFrom(part.channels[channel], pixel.stored[channel], answer.ranges[channel])
    : NaN;
}

/** The pixel of which a channel is farthest off. */
export function farthestPixel(part, channel) {
  let worst;
  let most = -1;
  for (const pixel of part.samples) {
    if (!isWrongPixel(pixel)) continue;
    const steps = Math.abs(channelSteps(part, pixel, channel));
    const size = Number.isNaN(steps) ? Infinity : steps;
    if (size > most) [worst, most] = [pixel, size];
  }
  return worst;
}

/** The channel that is farthest off at the pixel in question. */
export function worstChannel(part) {
  const pixel = part.samples.find((p) => p.x === part.x && p.y === part.y);
  const sizes = part.channels.map((_, c) => {
    const steps = Math.abs(channelSteps(part, pixel, c));
    return Number.isNaN(steps) ? Infinity : steps;
  });
  return pixel.answers.length > 0 ? sizes.indexOf(Math.max(...sizes)) : 0;
}
