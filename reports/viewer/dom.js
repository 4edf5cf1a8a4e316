// Making elements.

/**
 * An element with attributes and children. An attribute that is a function listens to the event of
 * its name; false, null and undefined are left out.
 * @param {string} tag
 * @param {Record<string, unknown>} [attributes]
 * @param {...(Node | string)} children
 * @returns {HTMLElement}
 */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === false || value === null || value === undefined) continue;
    if (typeof value === 'function') made.addEventListener(name, value);
    else made.setAttribute(name, value === true ? '' : String(value));
  }
  made.append(...children);
  return made;
}

/** A term and what it is, as in the page's other lists of facts. */
export function fact(term, ...content) {
  return element('div', {}, element('dt', {}, term), element('dd', {}, ...content));
}

let made = 0;
/** An id that nothing else of the page has. */
export function newId(name) {
  made += 1;
  return `${name}-${made}`;
}
