// SPDX-License-Identifier: BSD-3-Clause
// One figure as an interactive drawing: series, or a heat map.
import {pictureOfScale, pictureOfMap} from './colour_scale.js';
import {svg} from './element.js';
import {hasPoints, marksOf, sampleOf} from './marks.js';
import {axisTitle, forPeople, withUnit} from './numbers.js';
import {plotArea, textWidth} from './plot_area.js';

export const isOverTime = (figure) => figure.x.label === 'time' && figure.x.unit === 's';

/**
 * Draws the figure into `host`. `columns` are the report's lists of numbers; `on` has the functions
 *   zoom([from, to] or null)  the reader chose a stretch of x
 *   point(x, row)             the cursor is there (null: nowhere)
 *   pick(x)                   the reader clicked
 */
export class Chart {
  constructor(host, figure, columns, on) {
    Object.assign(this, {host, figure, on});
    this.series = figure.series.map((series) => ({...series, x: columns[series.x], y: columns[series.y]}));
    this.map = figure.map && {...figure.map, x: columns[figure.map.x], value: figure.map.value.map((row) => columns[row])};
    this.hidden = new Set();  // names
    this.window = null;       // of x; null: all of it
    host.classList.add('chart');
    host.addEventListener('pointerdown', (event) => this.press(event));
    host.addEventListener('pointermove', (event) => this.move(event));
    host.addEventListener('pointerup', (event) => this.release(event));
    host.addEventListener('pointerleave', () => { this.pressed = null; this.on.point(null); });
    host.addEventListener('dblclick', () => this.on.zoom(null));
    this.draw();
  }

  get shown() {
    return this.series.filter((series) => !this.hidden.has(series.name));
  }

  rangeOfX() {
    const {figure, map} = this;
    if (figure.x.categories) return [0.5, figure.x.categories.length + 0.5];
    const rules = figure.rules.filter((rule) => rule.vertical).map((rule) => rule.at);
    const ticks = (figure.x.ticks ?? []).map((tick) => tick.at);
    const range = extentOf([...(map ? [map.x] : this.series.map((series) => series.x)), rules, ticks], figure.x);
    if (map) {
      const half = map.x.length < 2 ? 0.5 : (range[1] - range[0]) / (map.x.length - 1) / 2;
      return [range[0] - half, range[1] + half];
    }
    if (figure.equalAspect) return withMargin(range, figure.x, 0.05);
    return isOverTime(figure) || !figure.series.some(hasPoints) ? range : withMargin(range, figure.x, 0.02);
  }

  /** Of what is shown within the stretch of x. */
  rangeOfY([from, to]) {
    const {figure} = this;
    const categories = this.map?.rows ?? figure.y.categories;
    if (categories) return [0.5, categories.length + 0.5];
    const values = this.shown.map((series) => series.y.filter((_, k) => series.x[k] >= from && series.x[k] <= to));
    const rules = figure.rules.filter((rule) => !rule.vertical).map((rule) => rule.at);
    return withMargin(extentOf([...values, rules], figure.y), figure.y, 0.05);
  }

  /** The drawing; with `heading`, title and legend are in it. */
  drawing(width, heading = false) {
    const {figure, map} = this;
    const x = this.window ?? this.rangeOfX();
    const legend = heading ? this.legendRows(width) : [];
    const head = heading ? 26 + 18 * legend.length : 0;
    const height = map ? Math.max(280, Math.min(420, 18 * map.rows.length + 70)) : figure.equalAspect ? 480 : 280;
    const area = plotArea({
      width, height: height + head, head, grid: !map, equalAspect: figure.equalAspect,
      x: {axis: figure.x, range: x},
      y: {axis: map ? {label: '', unit: '', categories: map.rows} : figure.y, range: this.rangeOfY(x),
        reversed: Boolean(map) || figure.yDownwards},
    });
    if (map) area.inside.append(pictureOfMap(map, area));
    const usable = (axis, value) => value !== null && (!axis.logarithmic || value > 0);
    for (const series of this.shown) {
      const places = series.x.map((at, k) => (usable(figure.x, at) && usable(figure.y, series.y[k])
        ? [area.x(at), area.y(series.y[k])] : null));
      area.inside.append(...marksOf(series, places, {zero: area.x(0), row: Math.abs(area.y(2) - area.y(1))}));
    }
    area.inside.append(...figure.rules.flatMap((rule) => drawnRule(rule, area)));
    if (heading) {
      area.svg.prepend(svg('rect', {width: '100%', height: '100%', fill: 'var(--paper)'}));
      area.svg.append(svg('text', {x: 8, y: 18, 'font-size': 14, 'font-weight': 600, fill: 'var(--ink)'}, figure.title), ...legend.flat());
    }
    return area;
  }

  draw() {
    this.width = Math.max(240, this.host.clientWidth);
    this.area = this.drawing(this.width);
    this.host.replaceChildren(this.area.svg);
    const line = (className) => svg('line', {class: className, y1: this.area.box.top, y2: this.area.box.bottom, visibility: 'hidden'});
    this.cursor = line('cursor');
    this.player = line('player-line');
    this.selection = svg('rect', {class: 'selection', y: this.area.box.top, height: this.area.box.height, width: 0});
    this.area.over.append(this.selection, this.cursor, this.player);
    this.showTime(this.time);
  }

  /** [{name, series}] of every name once, as the legend lists them. */
  legend() {
    return this.series.filter((series, k) => series.name && this.series.findIndex((other) => other.name === series.name) === k);
  }

  /** Words and samples of a heat map's colours. */
  legendOfMap() {
    const {map} = this;
    return [`${map.scale.label}: ${map.signed ? forPeople(-map.maximum, 3) : '0'}`,
      pictureOfScale(map), withUnit(map.maximum, map.scale, 3)];
  }

  /** The legend's parts below the title, in as many rows as it takes. */
  legendRows(width) {
    const parts = this.map ? this.legendOfMap()
                           : this.legend().filter((series) => !this.hidden.has(series.name)).flatMap((series) => [sampleOf(series), series.name]);
    const rows = [[]];
    let x = 8;
    parts.forEach((part, k) => {
      const isText = typeof part === 'string';
      const needed = isText ? textWidth(part) + 14 : Number(part.getAttribute('width')) + 6 + textWidth(parts[k + 1] ?? '');
      if (x > 8 && x + needed > width && !isText) {
        rows.push([]);
        x = 8;
      }
      const y = 38 + 18 * (rows.length - 1);
      if (!isText) {
        part.setAttribute('x', x);
        part.setAttribute('y', y - 10);
      }
      rows.at(-1).push(isText ? svg('text', {x, y, fill: 'var(--ink)'}, part) : part);
      x += isText ? needed : Number(part.getAttribute('width')) + 6;
    });
    return rows;
  }

  placeOf(event) {
    const place = this.host.getBoundingClientRect();
    return [event.clientX - place.left, event.clientY - place.top];
  }

  press(event) {
    const [x, y] = this.placeOf(event);
    const {box} = this.area;
    this.pressed = event.button === 0 && x >= box.left && x <= box.right && y >= box.top && y <= box.bottom ? x : null;
  }

  move(event) {
    const [x, y] = this.placeOf(event);
    const {box} = this.area;
    if (this.pressed !== null && this.pressed !== undefined && !this.figure.equalAspect) {
      const [from, to] = [this.pressed, x].map((at) => Math.min(box.right, Math.max(box.left, at))).sort((a, b) => a - b);
      this.selection.setAttribute('x', from);
      this.selection.setAttribute('width', to - from);
    }
    const inside = x >= box.left && x <= box.right && y >= box.top && y <= box.bottom;
    this.on.point(inside ? this.area.x.invert(x) : null, inside && this.map ? Math.round(this.area.y.invert(y)) - 1 : null);
  }

  /** A drag chooses a stretch of x; what is no drag is a click. */
  release(event) {
    if (this.pressed === null || this.pressed === undefined) return;
    const [x] = this.placeOf(event);
    const wide = Number(this.selection.getAttribute('width'));
    const from = Number(this.selection.getAttribute('x'));
    this.selection.setAttribute('width', 0);
    this.pressed = null;
    if (wide >= 2) this.on.zoom([this.area.x.invert(from), this.area.x.invert(from + wide)]);
    else this.on.pick(this.area.x.invert(x));
  }

  /** The cursor's line at x; returns the values nearest to it: {x, values: by legend entry}. */
  showCursor(x) {
    this.place(this.cursor, x);
    if (x === null || this.figure.equalAspect) return null;
    const nearest = (list) => {
      let best = -1;
      list.forEach((at, k) => {
        if (at !== null && (best < 0 || Math.abs(at - x) < Math.abs(list[best] - x))) best = k;
      });
      return best;
    };
    if (this.map) {
      const k = nearest(this.map.x);
      return {x: this.map.x[k], values: this.map.value.map((row) => row[k])};
    }
    const found = this.legend().map((series) => [series, nearest(series.x.map((at, k) => (series.y[k] === null ? null : at)))]);
    const places = found.filter(([, k]) => k >= 0).map(([series, k]) => series.x[k]);
    const at = places.reduce((best, place) => (Math.abs(place - x) < Math.abs(best - x) ? place : best), places[0] ?? x);
    return {x: at, values: found.map(([series, k]) => (k >= 0 ? series.y[k] : null))};
  }

  showTime(time) {
    this.time = time ?? null;
    this.place(this.player, this.time);
  }

  place(line, x) {
    const {box} = this.area;
    const at = x === null ? NaN : this.area.x(x);
    const seen = at >= box.left && at <= box.right;
    line.setAttribute('visibility', seen ? 'visible' : 'hidden');
    if (seen) line.setAttribute('transform', `translate(${at.toFixed(1)} 0)`);
  }

  showWindow(window) {
    const [low, high] = this.rangeOfX();
    this.window = window && [Math.max(window[0], low), Math.min(window[1], high)];
    if (this.window && this.window[0] >= this.window[1]) this.window = null;
    this.draw();
  }

  toggle(name) {
    if (!this.hidden.delete(name)) this.hidden.add(name);
    this.draw();
  }

  resize() {
    if (Math.max(240, this.host.clientWidth) !== this.width) this.draw();
  }
}

/** What the chart shows, in words. */
export function describe(figure) {
  if (figure.map) {
    return `${figure.title}: ${axisTitle(figure.map.scale)} of ${figure.map.rows.length} rows over ${axisTitle(figure.x)}`;
  }
  const names = [...new Set(figure.series.map((series) => series.name).filter(Boolean))].join(', ');
  return `${figure.title}: ${axisTitle(figure.y)} over ${axisTitle(figure.x)}; ${names}`;
}

/** A line across the inside, with its words on paper. */
function drawnRule(rule, {x, y, box}) {
  const at = rule.vertical ? x(rule.at) : y(rule.at);
  if (!Number.isFinite(at)) return [];  // zero on a logarithmic axis
  const [words, anchor] = rule.vertical ? [[at + 4, box.top + 13], 'start'] : [[box.right - 4, at - 4], 'end'];
  return [
    svg('path', {d: rule.vertical ? `M${at} ${box.top}V${box.bottom}` : `M${box.left} ${at}H${box.right}`,
      stroke: 'var(--ink)', 'stroke-dasharray': '6 4'}),
    svg('text', {x: words[0], y: words[1], 'text-anchor': anchor, fill: 'var(--ink)', stroke: 'var(--paper)', 'stroke-width': 4,
      'paint-order': 'stroke', 'stroke-linejoin': 'round'}, rule.label),
  ];
}

function extentOf(lists, axis) {
  let [low, high] = [Infinity, -Infinity];
  for (const list of lists) {
    for (const value of list) {
      if (value === null || (axis.logarithmic && value <= 0)) continue;
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  if (low > high) return axis.logarithmic ? [1, 10] : [0, 1];
  if (high - low > 1e-12 * Math.max(Math.abs(low), Math.abs(high))) return [low, high];
  return axis.logarithmic ? [low / 2, high * 2] : [low - (Math.abs(low) / 2 || 0.5), high + (Math.abs(high) / 2 || 0.5)];
}

function withMargin([low, high], axis, share) {
  if (!axis.logarithmic) return [low - share * (high - low), high + share * (high - low)];
  const factor = (high / low) ** share;
  return [low / factor, high * factor];
}
