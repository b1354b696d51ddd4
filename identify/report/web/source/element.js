// SPDX-License-Identifier: BSD-3-Clause

/** element('button', {type: 'button', onclick: f}, 'words', child): on... and properties, else attributes. */
export function element(name, attributes = {}, ...children) {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith('on')) node.addEventListener(key.slice(2), value);
    else if (value !== null && value !== undefined && value !== false) node.setAttribute(key, value === true ? '' : value);
  }
  node.append(...children);
  return node;
}

/** A labelled choice; calls choose(value). */
export function select(label, options, value, choose) {
  const box = element('select', {onchange: () => choose(box.value)},
      ...options.map((option) => element('option', {value: option, selected: option === value}, option)));
  box.value = value;
  return element('label', {class: 'choice'}, `${label} `, box);
}
