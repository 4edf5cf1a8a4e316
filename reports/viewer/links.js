// Deep links: #property=…, #inspection=3&x=5&y=7&sample=0&view=ulp.

/**
 * @param {string} hash  of a location, with or without "#"
 * @returns {Record<string, string>}
 */
export function parseLink(hash) {
  return Object.fromEntries(new URLSearchParams(hash.replace(/^#/, '')));
}

/**
 * @param {Record<string, string | number>} members
 * @returns {string} with "#"
 */
export function formatLink(members) {
  return '#' + new URLSearchParams(Object.entries(members).map(([k, v]) => [k, String(v)]));
}

const kPause = 120; // ms: browsers take only so many changes of the address
let waiting = 0;

/** Puts the link into the address, when there was no newer one for a moment. */
export function showLink(members) {
  clearTimeout(waiting);
  waiting = setTimeout(() => history.replaceState(null, '', formatLink(members)), kPause);
}
