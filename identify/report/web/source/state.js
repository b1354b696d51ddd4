// SPDX-License-Identifier: BSD-3-Clause
// What the reader has chosen. Charts and player subscribe; nobody else keeps a copy.

export class State {
  constructor() {
    this.experiment = '';
    this.variant = {};     // by kind: {Point: 'marker 3'}
    this.window = null;    // [from, to] in s, or null: all
    this.time = null;      // s, of the player
    this.cursor = null;    // s, under the pointer, or null
    this.listeners = {experiment: [], variant: [], window: [], time: [], cursor: [], theme: []};
  }

  on(event, listener) {
    this.listeners[event].push(listener);
  }

  /** Sets what has the event's name (the theme is on the document) and tells who listens. */
  set(event, value) {
    if (event !== 'theme') this[event] = value;
    for (const listener of this.listeners[event]) listener(value);
  }

  choose(kind, variant) {
    this.variant[kind] = variant;
    this.set('variant', this.variant);
  }
}
