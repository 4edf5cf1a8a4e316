// Colours and signs of samples. Colours are those of Okabe and Ito, which readers with any kind of
// colour vision tell apart; a sign or a number always says the same.

/** What a sample's coverage is shown as: [name, what a legend says of it]. */
export const kOutcomes = [
  ['right', 'must be drawn, and is'],
  ['empty', 'must not be drawn, and is not'],
  ['missing', 'missing: must be drawn, and is not'],
  ['extra', 'extra: must not be drawn, and is'],
  ['either drawn', 'may be drawn or not, and is'],
  ['either empty', 'may be drawn or not, and is not'],
];

/** Errors by magnitude in scale ULP: up to which, both of them inclusive, and the fill. */
export const kErrorSteps = [
  { most: 0, fill: '#dcecf7', ink: '#16324a', label: '0' },
  { most: 0.5, fill: '#8cc2e8', ink: '#0c2a42', label: '≤ ½' },
  { most: 1, fill: '#f4e66a', ink: '#3c3300', label: '≤ 1' },
  { most: 4, fill: '#e69f00', ink: '#2e1f00', label: '≤ 4' },
  { most: 64, fill: '#d55e00', ink: '#ffffff', label: '≤ 64' },
  { most: Infinity, fill: '#7d2a00', ink: '#ffffff', label: '> 64' },
];

/** @returns the step of an error; undefined where that is no number */
export function errorStep(error) {
  return kErrorSteps.find(({ most }) => Math.abs(error) <= most);
}

/** ▲ and ▼ for what is off by more than correct rounding is, nothing for the rest. */
export function errorSign(error) {
  if (!(Math.abs(error) > 0.5)) return '';
  return error > 0 ? '▲' : '▼';
}

export const kOddFill = '#cc79a7'; // what is no finite number
export const kOddInk = '#2b0d1f';

/** The ink that is read on a fill. */
export function inkOn(fill) {
  const { r, g, b } = d3.rgb(fill);
  return 0.299 * r + 0.587 * g + 0.114 * b > 140 ? '#101418' : '#ffffff';
}
