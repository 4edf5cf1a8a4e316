// The picture of an inspection: the pixel grid, its samples, the triangle.

import { geometryOf, labelStep } from './geometry.js';
import { glyphOf } from './glyphs.js';
import { outcomeOf } from './inspection.js';
import { newId } from './dom.js';

const kLeastFont = 7; // CSS pixels
const kLetter = 0.62; // of the font's size, a digit's width

/** The size of a text's font that a sample's side has room for; 0: none. */
function fontFor(text, side) {
  const size = Math.min(13, side * 0.36, (side - 3) / (kLetter * text.length));
  return size >= kLeastFont ? size : 0;
}

function drawAxes(svg, inspection, g) {
  const { left, top, width, height } = inspection;
  const step = labelStep(g.pixel);
  const labelled = (first, count) => d3.range(first, first + count).filter((i) => i % step === 0);
  const axis = svg.append('g').attr('class', 'axis');
  axis.selectAll('.across').data(labelled(left, width)).join('text')
    .attr('x', (i) => g.x(i + 0.5)).attr('y', g.height - 7).attr('text-anchor', 'middle')
    .text((i) => i);
  axis.selectAll('.down').data(labelled(top, height)).join('text')
    .attr('x', g.plot.x - 6).attr('y', (j) => g.y(j + 0.5)).attr('dy', '.35em')
    .attr('text-anchor', 'end').text((j) => j);
}

function drawGrid(svg, inspection, g) {
  const { left, top, width, height } = inspection;
  const lines = [
    ...d3.range(left, left + width + 1).map((i) => [g.x(i), g.plot.y, g.x(i), g.y(top + height)]),
    ...d3.range(top, top + height + 1).map((j) => [g.plot.x, g.y(j), g.x(left + width), g.y(j)]),
  ];
  // Vertical lines run to the plot's other end, wherever window y points.
  const bottom = g.plot.y + g.plot.height;
  svg.append('g').attr('class', 'grid').selectAll('line').data(lines).join('line')
    .attr('x1', (l) => l[0]).attr('x2', (l) => l[2])
    .attr('y1', (l) => (l[0] === l[2] ? g.plot.y : l[1]))
    .attr('y2', (l) => (l[0] === l[2] ? bottom : l[3]));
}

function drawFills(layer, inspection, g, fills) {
  const cell = layer.selectAll('g').data(fills.filter((f) => f.fill)).join('g')
    .attr('transform', (f) => `translate(${cellCentre(inspection, g, f.sample)})`);
  cell.append('rect').attr('x', -g.side / 2).attr('y', -g.side / 2)
    .attr('width', g.side).attr('height', g.side).style('fill', (f) => f.fill);
  const write = (part, text, size) => part.append('text').attr('class', 'in-cell')
    .attr('dy', '.36em').attr('text-anchor', 'middle').style('fill', (f) => f.ink)
    .style('font-size', (f) => `${size(f)}px`).text(text);
  const hasRoom = (f) => fontFor(f.text, g.side) > 0;
  write(cell.filter(hasRoom), (f) => f.text, (f) => fontFor(f.text, g.side));
  write(cell.filter((f) => !hasRoom(f) && f.isSign), (f) => f.sign,
    () => Math.max(g.side * 0.6, 6));
}

/** Of one sample a pixel the cell is the pixel; of several they are around their samples. */
function cellCentre(inspection, g, sample) {
  if (inspection.pattern.length > 1) return g.place(sample);
  return [g.x(sample.x + 0.5), g.y(sample.y + 0.5)];
}

function drawSigns(layer, inspection, g, shown) {
  const signs = inspection.samples.filter((sample) => shown(outcomeOf(sample)));
  layer.selectAll('g').data(signs).join('g')
    .attr('transform', (s) => `translate(${cellCentre(inspection, g, s)})`)
    .each(function draw(sample) {
      this.append(...glyphOf(outcomeOf(sample), g.side));
    });
}

function drawOutlines(svg, inspection, g, clip) {
  const line = d3.line().x((p) => g.x(p[0])).y((p) => g.y(p[1]));
  return svg.append('g').attr('clip-path', `url(#${clip})`).selectAll('path').data(inspection.outlines)
    .join('path').attr('class', 'outline')
    .attr('d', (points) => (points.length > 0 ? line(points) + 'Z' : ''));
}

function drawSamplePoints(svg, inspection, g) {
  if (g.side < 12) return;
  svg.append('g').attr('class', 'points').selectAll('circle').data(inspection.samples)
    .join('circle').attr('r', 1.2).attr('cx', (s) => g.place(s)[0])
    .attr('cy', (s) => g.place(s)[1]);
}

function drawTarget(svg, inspection, g) {
  const [x, y] = cellCentre(inspection, g, inspection);
  svg.append('circle').attr('class', 'target').attr('cx', x).attr('cy', y)
    .attr('r', Math.max(g.side * 0.62, 7));
}

/**
 * @param {import('./inspection.js').Inspection} inspection
 * @param {import('./kinds.js').Kind} kind
 */
export class Picture {
  constructor(inspection, kind) {
    this.inspection = inspection;
    this.kind = kind;
    this.svg = d3.create('svg').attr('class', 'picture').attr('aria-hidden', 'true');
    this.node = this.svg.node();
    this.clip = newId('part');
    this.swipe = newId('swipe');
  }

  /**
   * Draws a view; show() and swipeTo() then move what is on top of it.
   * @param {{view: string, attribute: number}} state
   * @param {number} room  CSS pixels
   */
  draw({ view, attribute }, room) {
    const { svg, inspection, kind } = this;
    const g = geometryOf(inspection, room);
    this.geometry = g;
    svg.attr('viewBox', `0 0 ${g.width} ${g.height}`).attr('width', g.width)
      .attr('height', g.height).style('width', `${g.width}px`).selectAll('*').remove();
    const defs = svg.append('defs');
    const plot = (id) => defs.append('clipPath').attr('id', id).append('rect')
      .attr('x', g.plot.x).attr('y', g.plot.y).attr('width', g.plot.width)
      .attr('height', g.plot.height);
    plot(this.clip);
    this.right = plot(this.swipe);
    svg.append('rect').attr('class', 'plot').attr('x', g.plot.x).attr('y', g.plot.y)
      .attr('width', g.plot.width).attr('height', g.plot.height);
    if (kind.hasPoints(view)) drawSamplePoints(svg, inspection, g);
    for (const { fills, side } of kind.fillsOf(inspection, view, attribute)) {
      const layer = svg.append('g');
      if (side === 'right') layer.attr('clip-path', `url(#${this.swipe})`);
      if (side === 'right') this.coverUp(layer, g);
      drawFills(layer.append('g'), inspection, g, fills);
      if (kind.hasOddSigns(view, side)) {
        drawSigns(layer.append('g'), inspection, g, (o) => o === 'missing' || o === 'extra');
      }
    }
    drawGrid(svg, inspection, g);
    if (kind.hasAllSigns(view)) drawSigns(svg.append('g'), inspection, g, () => true);
    this.outlines = drawOutlines(svg, inspection, g, this.clip);
    if (kind.hasTarget(inspection)) drawTarget(svg, inspection, g);
    drawAxes(svg, inspection, g);
    this.divider = svg.append('line').attr('class', 'divider').attr('y1', g.plot.y)
      .attr('y2', g.plot.y + g.plot.height).attr('visibility', view === 'compare' ? null : 'hidden');
    this.cursor = svg.append('g').attr('class', 'cursor');
  }

  /** The right side of a comparison hides what is under it. */
  coverUp(layer, g) {
    layer.append('rect').attr('class', 'plot').attr('x', g.plot.x).attr('y', g.plot.y)
      .attr('width', g.plot.width).attr('height', g.plot.height);
  }

  /** Expected up to `share` of the width, actual beyond. */
  swipeTo(share) {
    const { plot } = this.geometry;
    const at = plot.x + share * plot.width;
    this.right.attr('x', at).attr('width', plot.x + plot.width - at);
    this.divider.attr('x1', at).attr('x2', at);
  }

  /** Puts the cursor on a sample. */
  show(sample, isPinned) {
    const g = this.geometry;
    const [x, y] = g.corner(sample.x, sample.y);
    const [u, v] = g.place(sample);
    this.outlines.attr('class', (_, i) => this.kind.outlineClass(this.inspection, sample, i));
    this.cursor.classed('pinned', isPinned).selectAll('*').remove();
    for (const name of ['halo', 'line']) {
      this.cursor.append('rect').attr('class', name).attr('x', x).attr('y', y)
        .attr('width', g.pixel).attr('height', g.pixel);
    }
    if (this.inspection.pattern.length === 1) return;
    this.cursor.append('circle').attr('class', 'line').attr('cx', u).attr('cy', v)
      .attr('r', Math.max(2.5, Math.min(g.side * 0.2, 6)));
  }
}
