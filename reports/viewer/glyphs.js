// The sign of a sample's coverage, the same in pictures and legends.

const kNamespace = 'http://www.w3.org/2000/svg';

function shape(tag, attributes) {
  const made = document.createElementNS(kNamespace, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}

function disc(name, radius) {
  return shape('circle', { class: name, r: radius });
}

/**
 * A sign around the origin, within `size` units.
 * @param {string} outcome  of inspection.js
 * @param {number} size
 * @returns {SVGElement[]}
 */
export function glyphOf(outcome, size) {
  const h = size / 2;
  switch (outcome) {
    case 'right':
      return [
        shape('rect', { class: 'g-right-area', x: -h, y: -h, width: size, height: size }),
        disc('g-right', 0.34 * h),
      ];
    case 'missing':
      return [
        shape('rect', { class: 'g-missing-area', x: -h, y: -h, width: size, height: size }),
        shape('path', {
          class: 'g-missing',
          d: `M${-0.55 * h} ${-0.55 * h}L${0.55 * h} ${0.55 * h}` +
            `M${0.55 * h} ${-0.55 * h}L${-0.55 * h} ${0.55 * h}`,
        }),
      ];
    case 'extra':
      return [
        shape('path', {
          class: 'g-extra',
          d: `M0 ${-0.75 * h}L${0.75 * h} 0L0 ${0.75 * h}L${-0.75 * h} 0Z`,
        }),
      ];
    case 'either drawn':
      return [disc('g-either', 0.55 * h), disc('g-either-in', 0.26 * h)];
    case 'either empty':
      return [disc('g-either', 0.55 * h)];
    default:
      return [disc('g-empty', Math.max(0.08 * h, 0.7))];
  }
}

/** The sign as a picture of its own. */
export function glyphPicture(outcome, size) {
  const svg = shape('svg', {
    viewBox: `${-size / 2} ${-size / 2} ${size} ${size}`,
    width: size,
    height: size,
    class: 'glyph',
    'aria-hidden': 'true',
  });
  svg.append(...glyphOf(outcome, size - 2));
  return svg;
}
