// The histogram of errors, with the share of errors up to where the pointer is. Without this script
// the page has a picture of the same by octaves.

import { element } from './dom.js';
import { brief } from './numbers.js';

const kChartHeight = 190;
const kChartMargin = { left: 44, top: 12, right: 12, bottom: 38 };
const kDown = -20; // octave of the least border: its bar has all that is smaller but zero

/**
 * @typedef {object} Bar
 * @property {number} from  magnitude, exclusive
 * @property {number} to  inclusive
 * @property {number | null} exponent  of its upper end; null where that is no power of two
 * @property {number} count
 */

/**
 * Octaves of the counts that the page has, from the least that is not empty.
 * @param {{zero: number, octaves: [number, number][], beyond: number}} data  octave k: up to 2^k
 */
function barsOf(data) {
  const octaves = new Map();
  for (const [exponent, count] of data.octaves) octaves.set(exponent, count);
  const first = Math.min(...octaves.keys());
  const last = Math.max(...octaves.keys());
  const bars = octaves.size === 0 ? [] : d3.range(first, last + 1).map((k) => ({
    from: k === kDown ? 0 : 2 ** (k - 1), to: 2 ** k, exponent: k, count: octaves.get(k) ?? 0,
  }));
  if (data.beyond > 0) bars.push({ from: 2 ** 40, to: Infinity, exponent: null, count: data.beyond });
  return bars;
}

const share = (part, whole) => {
  const percent = (100 * part) / whole;
  if (part === whole) return '100%';
  return percent > 99.99 ? '> 99.99%' : `${Number(percent.toPrecision(4))}%`;
};

function spokenOf(bar, data, total, bars) {
  const below = data.zero + d3.sum(bars.filter((b) => b.to <= bar.to), (b) => b.count);
  if (bar.to === Infinity) return `${bar.count.toLocaleString('en')} values with errors above 2^40 scale ULP`;
  const range = bar.from === 0 && bar.to === 0 ? 'error 0' : `error ≤ ${brief(bar.to)} scale ULP`;
  return `${bar.count.toLocaleString('en')} values in this bar; ${range}: ${share(below, total)} of all`;
}

function draw(svg, data, room, say) {
  const width = Math.max(room, 260);
  svg.attr('viewBox', `0 0 ${width} ${kChartHeight}`).attr('width', width).attr('height', kChartHeight)
    .selectAll('*').remove();
  const bars = barsOf(data);
  const all = data.zero > 0 ? [{ from: 0, to: 0, exponent: null, count: data.zero }, ...bars] : bars;
  const total = data.zero + data.beyond + d3.sum(bars, (b) => b.count);
  const x = d3.scaleBand().domain(d3.range(all.length)).padding(0.08)
    .range([kChartMargin.left, Math.min(width - kChartMargin.right, kChartMargin.left + 46 * all.length)]);
  const y = d3.scaleLog().domain([0.5, Math.max(d3.max(all, (b) => b.count) ?? 1, 10)])
    .range([kChartHeight - kChartMargin.bottom, kChartMargin.top]);
  const ticks = y.ticks(4).filter((t) => t >= 1 && Number.isInteger(Math.log10(t)));
  svg.append('g').attr('class', 'axis').attr('transform', `translate(${kChartMargin.left - 4},0)`)
    .call(d3.axisLeft(y).tickValues(ticks).tickFormat(d3.format('~s')).tickSize(kChartMargin.left - 4 - x.range()[1]))
    .call((g) => g.select('.domain').remove());
  svg.append('g').attr('class', 'bars').selectAll('rect').data(all).join('rect')
    .attr('x', (_, i) => x(i)).attr('width', x.bandwidth())
    .attr('y', (b) => (b.count > 0 ? y(b.count) : y(0.5)))
    .attr('height', (b) => (b.count > 0 ? y(0.5) - y(b.count) : 0))
    .on('pointerenter', (b) => say(spokenOf(b, data, total, bars)))
    .append('title').text((b) => spokenOf(b, data, total, bars));
  drawLabels(svg, all, x, y);
  drawLimit(svg, data, all, x, y);
}

/** Powers of two at the bars' right borders, as many as there is room for. */
function drawLabels(svg, all, x, y) {
  const every = Math.ceil(34 / x.step());
  const labelled = all.map((bar, i) => ({ bar, i }))
    .filter(({ bar, i }) => bar.exponent === null || (all.length - 1 - i) % every === 0);
  const label = svg.append('g').attr('class', 'axis').selectAll('text').data(labelled).join('text')
    .attr('y', y(0.5) + 15).attr('text-anchor', 'middle')
    .attr('x', ({ bar, i }) => (bar.exponent === null ? x(i) + x.bandwidth() / 2 : x(i) + x.bandwidth()));
  label.text(({ bar }) => (bar.to === Infinity ? 'more' : bar.exponent === null ? '0' : '2'));
  label.filter(({ bar }) => bar.exponent !== null).append('tspan').attr('dy', '-.4em')
    .style('font-size', '80%').text(({ bar }) => String(bar.exponent).replace('-', '−'));
  svg.append('text').attr('class', 'axis').attr('x', x.range()[0]).attr('y', y(0.5) + 32)
    .text('magnitude, scale ULP; both scales logarithmic');
}

/** A line at the bound, where it lies within the bars. */
function drawLimit(svg, data, all, x, y) {
  const at = all.findIndex((bar) => bar.from < data.limit && data.limit <= bar.to);
  if (at < 0) return;
  const { from, to } = all[at];
  const within = from > 0 && to < Infinity ? Math.log2(data.limit / from) / Math.log2(to / from) : 1;
  const place = x(at) + within * x.bandwidth();
  svg.append('line').attr('class', 'limit').attr('x1', place).attr('x2', place)
    .attr('y1', kChartMargin.top - 4).attr('y2', y(0.5));
  const isRight = place > (x.range()[0] + x.range()[1]) / 2;
  svg.append('text').attr('class', 'limit').attr('x', place + (isRight ? -5 : 5))
    .attr('y', kChartMargin.top + 6).attr('text-anchor', isRight ? 'end' : 'start')
    .text(`${data.limitName} ${brief(data.limit)}`);
}

/** Puts the chart into a figure that has its data, in place of the picture. */
export function makeHistogram(figure) {
  const data = JSON.parse(figure.dataset.histogram);
  const before = figure.querySelector('svg');
  if (!before) return;
  const say = element('p', { class: 'said' }, 'Point at a bar for the share of errors up to it.');
  const svg = d3.create('svg').attr('class', 'histogram').attr('role', 'img')
    .attr('aria-label', before.getAttribute('aria-label'));
  before.replaceWith(svg.node(), say);
  let room = 0;
  new ResizeObserver(() => {
    if (figure.clientWidth === room || figure.clientWidth === 0) return;
    room = figure.clientWidth;
    draw(svg, data, Math.min(room, 560), (text) => {
      say.textContent = text;
    });
  }).observe(figure);
}
