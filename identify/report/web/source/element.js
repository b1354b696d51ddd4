// SPDX-License-Identifier: BSD-3-Clause

function filled(node, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith('on')) node.addEventListener(key.slice(2), value);
    else if (value !== null && value !== undefined && value !== false) node.setAttribute(key, value === true ? '' : value);
  }
  node.append(...children);
  return node;
}

/** element('button', {type: 'button', onclick: f}, 'words', child): keys that begin with on are listeners, the others attributes. */
export const element = (name, attributes = {}, ...children) =>
  filled(document.createElement(name), attributes, children);

/** The same for an element of SVG. */
export const svg = (name, attributes = {}, ...children) =>
  filled(document.createElementNS('http://www.w3.org/2000/svg', name), attributes, children);

/** A labelled choice; calls choose(value). */
export function select(label, options, value, choose) {
  const box = element('select', {onchange: () => choose(box.value)},
      ...options.map((option) => element('option', {value: option, selected: option === value}, option)));
  box.value = value;
  return element('label', {class: 'choice'}, `${label} `, box);
}
