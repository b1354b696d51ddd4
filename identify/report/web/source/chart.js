// SPDX-License-Identifier: BSD-3-Clause
// One figure as an interactive chart: lines and points, or a heat map, by uPlot.
import uPlot from 'uplot';
import {colourScale} from './colour_scale.js';
import {cssColour, dashOf, hasLine, hasPoints, seriesColour, traceMarker} from './marks.js';
import {axisTitle, forPeople, linearTicks, logarithmicTicks, tickLabels} from './numbers.js';
import {renderingPixelRatio} from './pixel_ratio.js';

const font = '12px system-ui, "Liberation Sans", Arial, sans-serif';

const kMostSideBySide = 5;  // names under an axis; more stand aslant

export const isOverTime = (figure) => figure.x.label === 'time' && figure.x.unit === 's';

/**
 * Draws the figure into `host`. `columns` are the report's lists of numbers; `on` has the functions
 *   zoom([from, to] or null)  the reader chose a stretch of x
 *   hover(readings)           values under the cursor, one per series (or null), and where
 *   pick(x)                   the reader clicked
 */
export class Chart {
  constructor(host, figure, columns, on) {
    this.host = host;
    this.figure = figure;
    this.on = on;
    this.columns = columns;
    this.hidden = figure.series.map(() => false);
    const x = figure.map ? [columns[figure.map.x]] : figure.series.map((series) => columns[series.x]);
    this.extent = extentOf([...x, figure.rules.filter((rule) => rule.vertical).map((rule) => rule.at)], figure.x);
    if (figure.map && !figure.x.categories) {
      const step = x[0].length < 2 ? 1 : (x[0].at(-1) - x[0][0]) / (x[0].length - 1);
      this.extent = [this.extent[0] - step / 2, this.extent[1] + step / 2];
    }
    if (!figure.map && !figure.x.categories && figure.series.some(hasPoints) && !isOverTime(figure)) {
      this.extent = withMargin(this.extent, figure.x.logarithmic);
    }
    this.window = null;
    this.plot = new uPlot(this.options(), this.data(), host);
    this.line = document.createElement('div');
    this.line.className = 'player-line';
    this.line.hidden = true;
    this.plot.over.append(this.line);
    let pressed = 0;  // a drag chooses a stretch of x; it ends in a click, too
    this.plot.over.addEventListener('mousedown', (event) => { pressed = event.clientX; });
    this.plot.over.addEventListener('click', (event) => {
      if (Math.abs(event.clientX - pressed) < 2) this.on.pick(this.plot.posToVal(event.offsetX, 'x'));
    });
    this.plot.over.addEventListener('dblclick', () => this.on.zoom(null));
  }

  data() {
    const {figure, columns} = this;
    if (figure.map) return [columns[figure.map.x], columns[figure.map.x].map(() => null)];
    const usable = (axis, value) => (axis.logarithmic && value !== null && value <= 0 ? null : value);
    const tables = figure.series.map((series) => {
      const y = columns[series.y].map((value) => usable(figure.y, value));
      const order = columns[series.x].map((x, k) => k).filter((k) => columns[series.x][k] !== null);
      order.sort((a, b) => columns[series.x][a] - columns[series.x][b]);
      return [order.map((k) => columns[series.x][k]), order.map((k) => y[k])];
    });
    if (tables.length === 0) return [[]];
    return tables.length === 1 ? tables[0] : uPlot.join(tables);
  }

  options() {
    const {figure} = this;
    const rows = figure.map ? figure.map.rows : null;
    const categories = rows ?? figure.y.categories;
    const crowded = (figure.x.categories?.length ?? 0) > kMostSideBySide;
    this.height = figure.map ? Math.max(280, Math.min(420, 18 * rows.length + 70)) : 280;
    return {
      width: Math.max(240, this.host.clientWidth),
      height: this.height,
      legend: {show: false},
      cursor: {
        drag: {x: true, y: false},
        points: {size: 7},
        sync: isOverTime(figure) ? {key: 'time', scales: ['x', null]} : undefined,
        dataIdx: (plot, seriesIndex, closest) => nearestValue(plot.data[seriesIndex], closest),
      },
      scales: {
        x: {time: false, distr: figure.x.logarithmic ? 3 : 1, range: () => this.window ?? this.extent},
        y: categories
            ? {range: [0.5, categories.length + 0.5], dir: rows || figure.yDownwards ? -1 : 1}
            : {distr: figure.y.logarithmic ? 3 : 1, range: (plot, low, high) => this.yRange(low, high)},
      },
      axes: [
        {...this.axis(figure.x, figure.x.categories, 80), size: crowded ? 84 : figure.x.categories ? 42 : 28, rotate: crowded ? 35 : 0},
        {...this.axis(rows ? {label: '', unit: ''} : figure.y, categories, 45), size: widthOfLabels},
      ],
      series: [{}, ...(figure.map ? [{show: true, paths: () => null, points: {show: false}}]
                                  : figure.series.map((series) => this.series(series)))],
      hooks: {
        drawClear: [(plot) => figure.map && this.paintMap(plot)],
        draw: [(plot) => this.paintMarks(plot)],
        setSelect: [(plot) => this.select(plot)],
        setCursor: [(plot) => this.readings(plot)],
      },
    };
  }

  axis(axis, categories, space) {
    const ticks = axis.logarithmic ? logarithmicTicks : linearTicks;
    const splits = (plot, which, low, high) =>
      ticks(low, high, Math.max(2, (which === 0 ? plot.bbox.width : plot.bbox.height) / renderingPixelRatio / space));
    const labels = axis.logarithmic ? (plot, at) => at.map((tick) => forPeople(tick)) : (plot, at) => tickLabels(at);
    return {
      label: axisTitle(axis) || undefined,
      labelSize: axisTitle(axis) ? 20 : 0,
      font,
      labelFont: font,
      stroke: () => cssColour('ink'),
      grid: {stroke: () => cssColour('grid'), width: 1, show: !this.figure.map},
      ticks: {stroke: () => cssColour('ink'), width: 1, size: 5},
      ...(categories ? {
        splits: () => thinned(categories, this.height).map((k) => k + 1),
        // A line for each word: names under an axis stand side by side.
        values: (plot, splits) => splits.map((at) =>
          axis === this.figure.x && categories.length <= kMostSideBySide ? categories[at - 1].replace(' ', '\n')
                                                                         : categories[at - 1]),
      } : {splits, values: labels, filter: (plot, at) => at}),
    };
  }

  series(series) {
    return {
      label: series.name,
      stroke: () => seriesColour(series.colour),
      width: 1.6,
      dash: dashOf(series),
      paths: hasLine(series) ? uPlot.paths.linear() : () => null,
      points: {show: false},
    };
  }

  yRange(low, high) {
    if (low === null || low === undefined) return this.figure.y.logarithmic ? [0.1, 1] : [0, 1];
    for (const rule of this.figure.rules) {
      if (rule.vertical || (this.figure.y.logarithmic && rule.at <= 0)) continue;
      low = Math.min(low, rule.at);
      high = Math.max(high, rule.at);
    }
    if (this.figure.y.logarithmic) {
      const factor = low === high ? 2 : (high / low) ** 0.05;
      return [low / factor, high * factor];
    }
    const size = Math.max(Math.abs(low), Math.abs(high));
    const margin = high - low > 1e-12 * size ? 0.05 * (high - low) : size / 2 || 1;
    return [low - margin, high + margin];
  }

  /** Markers, which uPlot has only one shape of, and rules. */
  paintMarks(plot) {
    const context = plot.ctx;
    const ratio = renderingPixelRatio;
    context.save();
    context.beginPath();
    context.rect(plot.bbox.left, plot.bbox.top, plot.bbox.width, plot.bbox.height);
    context.clip();
    context.lineWidth = 1.2 * ratio;
    this.figure.series.forEach((series, k) => {
      if (!hasPoints(series) || this.hidden[k]) return;
      const [xs, ys] = [this.columns[series.x], this.columns[series.y]];
      context.strokeStyle = seriesColour(series.colour);
      context.beginPath();
      const [low, high] = [plot.scales.x.min, plot.scales.x.max];
      let last = null;  // markers that would cover one another are left out
      xs.forEach((x, i) => {
        if (x === null || ys[i] === null || x < low || x > high) return;
        if (this.figure.y.logarithmic && ys[i] <= 0) return;
        const at = [plot.valToPos(x, 'x', true), plot.valToPos(ys[i], 'y', true)];
        if (last && Math.hypot(at[0] - last[0], at[1] - last[1]) < 4 * ratio) return;
        last = at;
        traceMarker(context, series.colour, ...at, 3 * ratio);
      });
      context.stroke();
    });
    context.strokeStyle = cssColour('ink');
    context.fillStyle = cssColour('ink');
    context.font = font.replace('12px', `${12 * ratio}px`);
    context.lineWidth = ratio;
    context.setLineDash([4 * ratio, 4 * ratio]);
    for (const rule of this.figure.rules) this.paintRule(plot, context, rule, ratio);
    context.restore();
  }

  paintRule(plot, context, rule, ratio) {
    const {left, top, width, height} = plot.bbox;
    const at = plot.valToPos(rule.at, rule.vertical ? 'x' : 'y', true);
    context.save();
    context.beginPath();
    if (rule.vertical) {
      context.moveTo(at, top);
      context.lineTo(at, top + height);
    } else {
      context.moveTo(left, at);
      context.lineTo(left + width, at);
    }
    context.stroke();
    context.textAlign = rule.vertical ? 'left' : 'right';
    context.textBaseline = 'alphabetic';
    const [x, y] = rule.vertical ? [at + 4 * ratio, top + 12 * ratio] : [left + width - 4 * ratio, at - 4 * ratio];
    context.setLineDash([]);  // paper around the words, whatever they stand on
    context.strokeStyle = cssColour('paper');
    context.lineWidth = 4 * ratio;
    context.strokeText(rule.label, x, y);
    context.fillText(rule.label, x, y);
    context.restore();
  }

  /** A column of the picture for each column of pixels: the nearest x. */
  paintMap(plot) {
    const {map} = this.figure;
    const {left, top, width, height} = plot.bbox;
    const x = this.columns[map.x];
    const rows = map.value.map((column) => this.columns[column]);
    if (rows.length === 0 || x.length === 0) return;
    const scale = colourScale(map.signed, document.documentElement.dataset.shown === 'dark');
    const picture = new ImageData(Math.max(1, Math.round(width)), rows.length);
    let k = 0;
    for (let column = 0; column < picture.width; ++column) {
      const at = plot.posToVal(left + column + 0.5, 'x', true);
      while (k + 1 < x.length && Math.abs(x[k + 1] - at) <= Math.abs(x[k] - at)) ++k;
      rows.forEach((row, r) => {
        const value = row[k];
        if (value === null) return;
        const colour = scale(map.signed ? (value / (map.maximum || 1) + 1) / 2 : value / (map.maximum || 1));
        picture.data.set([...colour, 255], 4 * (r * picture.width + column));
      });
    }
    const canvas = document.createElement('canvas');
    canvas.width = picture.width;
    canvas.height = picture.height;
    canvas.getContext('2d').putImageData(picture, 0, 0);
    plot.ctx.imageSmoothingEnabled = false;
    plot.ctx.drawImage(canvas, left, top, width, height);
  }

  select(plot) {
    if (plot.select.width < 2) return;
    const from = plot.posToVal(plot.select.left, 'x');
    const to = plot.posToVal(plot.select.left + plot.select.width, 'x');
    plot.setSelect({width: 0, height: 0}, false);
    if (to > from) this.on.zoom([from, to]);
  }

  readings(plot) {
    const {idxs, left, top} = plot.cursor;
    const {figure} = this;
    if (left === null || left < 0 || idxs[0] === null || idxs[0] === undefined) return this.on.hover(null);
    const x = plot.data[0][idxs[0]];
    if (figure.map) {
      const row = Math.round(plot.posToVal(top, 'y')) - 1;
      const value = figure.map.rows[row] === undefined ? null : this.columns[figure.map.value[row]][idxs[0]];
      return this.on.hover({x, row: figure.map.rows[row], values: [value]});
    }
    return this.on.hover({x, values: figure.series.map((series, k) => {
      const index = idxs[k + 1];
      return index === null || index === undefined ? null : plot.data[k + 1][index];
    })});
  }

  showWindow(window) {
    this.window = window && [Math.max(window[0], this.extent[0]), Math.min(window[1], this.extent[1])];
    if (this.window && this.window[0] >= this.window[1]) this.window = null;
    this.plot.setData(this.plot.data, true);
    this.showTime(this.time);
  }

  showTime(time) {
    this.time = time;
    const {min, max} = this.plot.scales.x;
    const inside = time !== null && time !== undefined && time >= min && time <= max;
    this.line.hidden = !inside;
    if (inside) this.line.style.transform = `translateX(${this.plot.valToPos(time, 'x')}px)`;
  }

  toggle(k) {
    this.hidden[k] = !this.hidden[k];
    this.plot.setSeries(k + 1, {show: !this.hidden[k]});
  }

  resize() {
    const width = Math.max(240, this.host.clientWidth);
    if (width !== this.plot.width) this.plot.setSize({width, height: this.plot.height});
    this.showTime(this.time);
  }

  repaint() {
    this.plot.redraw(false, true);
  }

  destroy() {
    this.plot.destroy();
  }
}

function extentOf(lists, axis) {
  if (axis.categories) return [0.5, axis.categories.length + 0.5];
  let [low, high] = [Infinity, -Infinity];
  for (const list of lists) {
    for (const value of list) {
      if (value === null || (axis.logarithmic && value <= 0)) continue;
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  if (low > high) return axis.logarithmic ? [1, 10] : [0, 1];
  if (low < high) return [low, high];
  return axis.logarithmic ? [low / 2, high * 2] : [low - 0.5, high + 0.5];
}

/** Room for the markers at the ends. */
function withMargin([low, high], logarithmic) {
  if (!logarithmic) return [low - 0.02 * (high - low), high + 0.02 * (high - low)];
  const factor = (high / low) ** 0.02;
  return [low / factor, high * factor];
}

/** Index of the value nearest to `closest` that is there: series have times of their own. */
function nearestValue(values, closest) {
  if (!values || (values[closest] !== null && values[closest] !== undefined)) return closest;
  for (let step = 1; step < 12; ++step) {
    for (const k of [closest - step, closest + step]) {
      if (values[k] !== null && values[k] !== undefined) return k;
    }
  }
  return closest;
}

/** Indices of the labels for which there is room. */
function thinned(labels, height) {
  const most = Math.max(2, Math.floor(Math.max(height, 160) / 15));
  const stride = Math.max(1, Math.ceil(labels.length / most));
  return labels.map((_, k) => k).filter((k) => k % stride === 0);
}

/** Width of an axis in CSS pixels: that of its longest label. */
function widthOfLabels(plot, labels) {
  if (!labels) return 40;
  plot.ctx.save();
  plot.ctx.font = font;
  const widest = Math.max(0, ...labels.map((label) => plot.ctx.measureText(label ?? '').width));
  plot.ctx.restore();
  return Math.ceil(widest) + 14;
}
