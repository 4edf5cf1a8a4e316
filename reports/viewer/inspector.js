// What is known of one sample, as lists of facts.

import { element, fact } from './dom.js';
import { glyphPicture } from './glyphs.js';
import { outcomeOf, valueOf, valuesOf } from './inspection.js';
import { bitsOf, shortestFloat32, signed } from './numbers.js';

const kReasons = {
  inside: 'strictly inside every edge',
  tie: 'exactly on an edge: the tie rule decides',
  snapping: 'inside for some placements of the snapped vertices only',
  'clip edge': 'close to an edge that clipping created or moved',
  'w <= 0': 'close to an edge that was cut because some w ≤ 0',
  depth: 'it is left open which fragment is nearest',
  outside: 'beyond an edge, or on one that the triangle does not own',
  clipped: 'beyond a clip plane',
  viewport: 'outside the viewport, scissor or target',
  culled: 'the triangle faces the wrong way',
  degenerate: 'the triangle is seen edge-on',
};

const kSays = {
  right: 'drawn, as it must be',
  empty: 'not drawn, as it must not be',
  missing: 'missing: must be drawn',
  extra: 'extra: must not be drawn',
  'either drawn': 'drawn; may be left out',
  'either empty': 'not drawn; may be drawn',
};

const code = (text) => element('span', { class: 'value' }, text);
const note = (text) => element('small', {}, text);

function verdict(sample) {
  const outcome = outcomeOf(sample);
  return element('p', { class: `outcome ${outcome.replace(' ', '-')}` },
    glyphPicture(outcome, 18), element('strong', {}, kSays[outcome]), ' ',
    note(`${sample.verdict}: ${kReasons[sample.reason] ?? sample.reason}`));
}

/** True if the contract leaves open at which place the value is taken, so that no one value is exact. */
const isRange = (value) => value.exact?.startsWith('[') ?? false;

function valueFacts(value) {
  const facts = [];
  const exact = value.exact ?? 'not defined here';
  facts.push(fact(isRange(value) ? 'must be within' : 'exact', code(exact)));
  if (!isRange(value) && !Number.isNaN(value.nearest) && exact !== String(value.nearest)) {
    facts.push(fact('exact, nearest double', code(String(value.nearest))));
  }
  if (value.hex === null) {
    facts.push(fact('drawn', 'not drawn'));
  } else {
    facts.push(fact('drawn', code(shortestFloat32(value.actual)), ' ',
      note(`${value.hex} = ${bitsOf(value.actual)}`)));
  }
  return facts;
}

const kUnits = {
  scaleError: ['error, scale ULP', 'in float32 spacings at the largest vertex value'],
  localError: ['error, local ULP', 'in float32 spacings at the exact value'],
  excess: ['after allowances', 'scale ULP beyond what the contract allows'],
  kappa: ['κ', 'how relative errors of the weights are amplified'],
  kappaD: ['κ_D', 'how much cancellation the weights went through'],
};

function errorFacts(value) {
  return Object.entries(kUnits)
    .filter(([key]) => value[key] !== null && !(key === 'localError' && isRange(value)))
    .map(([key, [term, what]]) => {
      const text = key.startsWith('kappa') ? value[key] : signed(value[key]);
      return fact(term, element('span', { class: 'figure' }, text), ' ', note(what));
    });
}

/** Each value's name and error, the chosen one's in full. */
function values(inspection, sample, attribute) {
  const chosen = valueOf(sample, attribute);
  const nameOf = (a) => valuesOf(inspection).find((v) => v.attribute === a)?.name ?? `attribute ${a}`;
  if (sample.values.length === 0) return [element('p', { class: 'absent' }, 'No values here.')];
  const others = sample.values.filter((v) => v !== chosen).map((v) =>
    fact(nameOf(v.attribute), `${v.hex === null ? 'not drawn' : shortestFloat32(v.actual)} `,
      note(v.scaleError === null ? '' : `${signed(v.scaleError)} scale ULP`)));
  const full = chosen
    ? [element('h5', {}, nameOf(chosen.attribute)),
      element('dl', { class: 'facts stacked' }, ...valueFacts(chosen)),
      element('dl', { class: 'facts' }, ...errorFacts(chosen))]
    : [];
  const rest = others.length > 0 ? [element('dl', { class: 'facts others' }, ...others)] : [];
  return [...full, ...rest];
}

function edgeFacts(inspection, sample) {
  const facts = [];
  if (sample.distance !== null) {
    facts.push(fact('distance to the boundary', `${sample.distance} `, note('pixels')));
  }
  if (sample.edges) {
    const [, , , sum] = sample.edges;
    sample.edges.slice(0, 3).forEach((edge, i) => facts.push(fact(`e${'₀₁₂'[i]}`, code(edge))));
    facts.push(fact('D = Σ e', code(sum), ' ', note('1/w')));
  }
  return element('dl', { class: 'facts' }, ...facts);
}

/** The rows of Q: e_i = A_i u + B_i v + C_i. */
export function matrixOf(inspection) {
  if (!inspection.q) {
    return element('p', { class: 'absent' }, 'No q-matrix: the triangle is seen edge-on.');
  }
  const rows = inspection.q.map((row, i) => element('tr', {},
    element('th', { scope: 'row' }, `e${'₀₁₂'[i]}`), ...row.map((f) => element('td', {}, code(f)))));
  const head = element('tr', {}, ...['', 'A · u', 'B · v', 'C'].map((t) =>
    element('th', { scope: 'col' }, t)));
  return element('details', { class: 'matrix' },
    element('summary', {}, 'q-matrix of the triangle: e = A u + B v + C'),
    element('table', {}, element('thead', {}, head), element('tbody', {}, ...rows)));
}

/** One line for those who hear it. */
export function spoken(inspection, sample, attribute) {
  const value = valueOf(sample, attribute);
  const error = value?.scaleError ? `, error ${signed(value.scaleError)} scale ULP` : '';
  const of = inspection.pattern.length > 1 ? `, sample ${sample.sample}` : '';
  return `Pixel ${sample.x}, ${sample.y}${of}: ${kSays[outcomeOf(sample)]}${error}`;
}

/** All that is known of a sample. */
export function panelOf(inspection, sample, attribute, isPinned) {
  const [u, v] = inspection.pattern[sample.sample];
  const title = element('h4', {}, `Pixel (${sample.x}, ${sample.y})`,
    inspection.pattern.length > 1 ? `, sample ${sample.sample}` : '', ' ',
    note(`at (${sample.x + u}, ${sample.y + v})${isPinned ? ' · pinned' : ''}`));
  return [title, verdict(sample), ...values(inspection, sample, attribute),
    edgeFacts(inspection, sample)];
}
