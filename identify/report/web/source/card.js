// SPDX-License-Identifier: BSD-3-Clause
// The frame of one family of figures: title, choice of variant, legend with values, chart.
import {Chart, isOverTime} from './chart.js';
import {colourScale, cssGradient} from './colour_scale.js';
import {element, select} from './element.js';
import {drawSample} from './marks.js';
import {axisTitle, forPeople, withUnit} from './numbers.js';
import {renderingPixelRatio} from './pixel_ratio.js';

export class Card {
  /** `figures`: all of the family, over experiments and variants. */
  constructor(frame, figures, columns, state) {
    Object.assign(this, {frame, figures, columns, state});
    this.chart = null;
    this.figure = null;
    this.visible = false;
    state.on('experiment', () => this.refresh());
    state.on('variant', () => this.refresh());
    state.on('theme', () => this.repaint());
    state.on('window', (window) => this.chart && isOverTime(this.figure) && this.chart.showWindow(window));
    state.on('time', (time) => this.chart && isOverTime(this.figure) && this.chart.showTime(time));
  }

  /** The figure of the chosen experiment and variant; of variants it lacks, the first. */
  current() {
    const here = this.figures.filter((f) => f.experiment === '' || f.experiment === this.state.experiment);
    return here.find((f) => f.variant === this.state.variant[f.variantKind]) ?? here[0] ?? null;
  }

  /** Charts out of sight are drawn when they come into sight, or for printing. */
  show() {
    this.visible = true;
    this.refresh();
  }

  refresh() {
    if (!this.visible) return;
    const figure = this.current();
    this.frame.hidden = figure === null;
    if (figure === this.figure || figure === null) return;
    this.figure = figure;
    this.build();
  }

  build() {
    this.chart?.destroy();
    const {figure, state} = this;
    const variants = this.figures.filter((f) => f.experiment === figure.experiment && f.variantKind)
        .map((f) => f.variant);
    const plot = element('div', {class: 'plot', role: 'img', 'aria-label': describe(figure)});
    this.legend = element('div', {class: 'legend'});
    this.reading = element('span', {class: 'reading'});
    this.frame.replaceChildren(
        element('figcaption', {},
            element('h3', {}, figure.title),
            element('div', {class: 'tools'},
                ...(variants.length > 1 ? [select(figure.variantKind, variants, figure.variant,
                    (variant) => state.choose(figure.variantKind, variant))] : []),
                element('button', {type: 'button', title: 'Save the numbers as comma-separated values',
                  'aria-label': `Save the numbers of “${figure.title}” as CSV`, onclick: () => save(figure, this.columns)}, 'CSV')),
            figure.caption ? element('p', {}, figure.caption) : ''),
        this.legend, plot);
    this.chart = new Chart(plot, figure, this.columns, {
      zoom: (window) => (isOverTime(figure) ? state.set('window', window) : this.chart.showWindow(window)),
      hover: (readings) => this.showReadings(readings),
      pick: (x) => isOverTime(figure) && state.set('time', x),
    });
    if (isOverTime(figure)) {
      this.chart.showWindow(state.window);
      this.chart.showTime(state.time);
    }
    this.buildLegend();
  }

  buildLegend() {
    const {figure} = this;
    this.values = [];
    this.legend.replaceChildren();
    if (figure.map) {
      const {map} = figure;
      const dark = document.documentElement.dataset.shown === 'dark';
      this.legend.append(
          element('span', {}, `${map.scale.label}: ${map.signed ? forPeople(-map.maximum, 3) : '0'}`),
          element('span', {class: 'bar', style: `background: ${cssGradient(colourScale(map.signed, dark))}`}),
          element('span', {}, withUnit(map.maximum, map.scale, 3)));
    }
    figure.series.forEach((series, k) => {
      const sample = element('canvas', {class: 'sample', 'aria-hidden': 'true'});
      drawSample(sample, series, renderingPixelRatio);
      const value = element('span', {class: 'value'});
      const button = element('button', {type: 'button', class: 'series', 'aria-pressed': 'true',
        title: 'Show or hide', onclick: () => {
          this.chart.toggle(k);
          button.setAttribute('aria-pressed', String(!this.chart.hidden[k]));
        }}, sample, series.name, value);
      this.values.push(value);
      this.legend.append(button);
    });
    this.legend.append(this.reading);
  }

  showReadings(readings) {
    if (!this.values) return;
    const {figure} = this;
    this.values.forEach((node, k) => {
      node.textContent = readings ? withUnit(readings.values[k], figure.y) : '';
    });
    if (!readings) {
      this.reading.textContent = '';
      return;
    }
    const category = figure.x.categories?.[readings.x - 1];
    const at = category ?? `${figure.x.label} ${withUnit(readings.x, figure.x)}`;
    this.reading.textContent = figure.map
        ? readings.row ? `${readings.row}, ${at}: ${withUnit(readings.values[0], figure.map.scale)}` : '' : at;
  }

  repaint() {
    if (!this.chart) return;
    this.chart.repaint();
    this.buildLegend();
  }

  resize() {
    this.chart?.resize();
  }
}

function describe(figure) {
  if (figure.map) {
    return `${figure.title}: ${axisTitle(figure.map.scale)} of ${figure.map.rows.length} rows over ${axisTitle(figure.x)}`;
  }
  const names = figure.series.map((series) => series.name).filter(Boolean).join(', ');
  return `${figure.title}: ${axisTitle(figure.y)} over ${axisTitle(figure.x)}; ${names}`;
}

function save(figure, columns) {
  const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  const number = (value) => value ?? '';
  const lines = [];
  if (figure.map) {
    lines.push(['row', quoted(axisTitle(figure.x)), quoted(axisTitle(figure.map.scale))]);
    figure.map.rows.forEach((row, r) => columns[figure.map.x].forEach((x, k) =>
      lines.push([quoted(row), x, number(columns[figure.map.value[r]][k])])));
  } else {
    lines.push(['series', quoted(axisTitle(figure.x) || 'x'), quoted(axisTitle(figure.y) || 'y')]);
    for (const series of figure.series) {
      columns[series.x].forEach((x, k) => lines.push([quoted(series.name), number(x), number(columns[series.y][k])]));
    }
  }
  const blob = new Blob([lines.map((line) => line.join(',')).join('\n') + '\n'], {type: 'text/csv'});
  const link = element('a', {href: URL.createObjectURL(blob), download: `${figure.id}.csv`});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
