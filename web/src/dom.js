// Small helpers to build elements. Texts are always set as text, never parsed as HTML: names come from logs.

export const byId = (id) => document.getElementById(id);

/** el('td', {class: 'number'}, 'text', childElement, ...) */
export function el(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? '' : value);
  }
  element.append(...children.filter((child) => child !== undefined && child !== null));
  return element;
}

/** A panel with a title, an optional read-out at its right, and what belongs in it. */
export function card(title, ...children) {
  const now = el('span', { class: 'now' });
  const element = el('section', { class: 'card' }, el('h2', {}, title, now), ...children);
  return { element, now };
}

/** Tool-tip of a chart: ECharts takes an element as it is, and a string as HTML. */
export function tip(title, rows) {
  const line = ([name, value, color]) =>
    el('div', { class: 'tip-row' },
      el('span', { class: 'dot', style: color ? `background:${color}` : 'visibility:hidden' }),
      el('span', {}, name), el('b', {}, value));
  return el('div', { class: 'tip' }, el('div', { class: 'tip-title' }, title), ...rows.map(line));
}

/** rows: arrays of cells; a cell is text or {text, class}. */
export function table(header, rows) {
  const cell = (tag) => (value, column) =>
    el(tag, { class: column > 0 && header.length > 1 ? 'number' : undefined }, String(value));
  return el('div', { class: 'scroll' }, el('table', {},
    el('thead', {}, el('tr', {}, ...header.map(cell('th')))),
    el('tbody', {}, ...rows.map((row) => el('tr', {}, ...row.map(cell('td')))))));
}
