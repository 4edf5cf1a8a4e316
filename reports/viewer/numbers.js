// Numbers as the page has them: certain decimals, hex floats.

/**
 * The number of a text: "0.25", "inf", the middle of "[0.25, 0.5]"; NaN for null.
 * @param {string | null} text
 * @returns {number}
 */
export function numberOf(text) {
  if (text === null) return NaN;
  if (text.startsWith('[')) {
    const [low, high] = text.slice(1, -1).split(',').map((end) => numberOf(end.trim()));
    return low / 2 + high / 2;
  }
  if (text === 'inf') return Infinity;
  if (text === '-inf') return -Infinity;
  return Number(text);
}

/**
 * The value of a C99 hex float, of "nan", "inf" or "-inf".
 * @param {string} text
 * @returns {number}
 */
export function hexFloat(text) {
  const parts = /^(-?)0x([0-9a-f]+)(?:\.([0-9a-f]*))?p([+-]?\d+)$/i.exec(text);
  if (!parts) return text === 'inf' ? Infinity : text === '-inf' ? -Infinity : NaN;
  const [, sign, whole, fraction = '', exponent] = parts;
  const digits = parseInt(whole + fraction, 16) * 2 ** (Number(exponent) - 4 * fraction.length);
  return sign ? -digits : digits;
}

/**
 * The fewest decimals that name a float32.
 * @param {number} value
 * @returns {string}
 */
export function shortestFloat32(value) {
  if (Object.is(value, -0)) return '-0';
  if (!Number.isFinite(value)) return Number.isNaN(value) ? 'NaN' : value > 0 ? '+∞' : '−∞';
  for (let digits = 1; digits < 9; ++digits) {
    const text = value.toPrecision(digits);
    if (Math.fround(Number(text)) === value) return String(Number(text));
  }
  return String(Number(value.toPrecision(9)));
}

/**
 * The bits of a float32, as "0x3f800000".
 * @param {number} value
 * @returns {string}
 */
export function bitsOf(value) {
  const view = new DataView(new ArrayBuffer(4));
  view.setFloat32(0, value);
  return '0x' + view.getUint32(0).toString(16).padStart(8, '0');
}

/**
 * A certain decimal with its sign, as errors are shown.
 * @param {string | null} text
 * @returns {string}
 */
export function signed(text) {
  if (text === null) return '–';
  if (text === '0' || text.startsWith('[')) return text;
  return text.startsWith('-') ? '−' + text.slice(1) : '+' + text;
}

/**
 * An error for a cell: two decimals, or two digits of a large one, as "2.9M".
 * @param {number} value
 * @returns {string}
 */
export function briefError(value) {
  if (Math.abs(value) >= 1e15) return value.toExponential(0).replace('-', '−').replace('+', '');
  if (Math.abs(value) >= 1000) return d3.format('.2~s')(value).replace('-', '−');
  if (!(Math.abs(value) < 10)) return brief(value, 2);
  return String(Number(value.toFixed(2)) + 0).replace('-', '−');
}

/**
 * A number for axes and cells.
 * @param {number} value
 * @param {number} [digits]  at most
 * @returns {string}
 */
export function brief(value, digits = 3) {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? 'NaN' : value > 0 ? '∞' : '−∞';
  return String(Number(value.toPrecision(digits))).replace('-', '−');
}
