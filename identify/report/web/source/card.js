// SPDX-License-Identifier: BSD-3-Clause
// The frame of one family of figures: title, choice of variant, legend with values, chart.
import {Chart, describe, isOverTime} from './chart.js';
import {element, select} from './element.js';
import {sampleOf} from './marks.js';
import {withUnit} from './numbers.js';
import {saveCsv, savePng, saveSvg} from './save.js';

const kSavedWidth = 640;  // px of a saved drawing; of a wide one as many as it has on the page

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
    state.on('cursor', (x) => this.chart && isOverTime(this.figure) && this.showReadings(x));
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
    const {figure, state} = this;
    const variants = this.figures.filter((f) => f.experiment === figure.experiment && f.variantKind)
        .map((f) => f.variant);
    const plot = element('div', {role: 'img', 'aria-label': describe(figure)});
    this.legend = element('div', {class: 'legend'});
    this.reading = element('span', {class: 'reading'});
    const save = (format, what, action) => element('button', {type: 'button', title: `Save ${what} as ${format}`,
      'aria-label': `Save ${what} of “${figure.title}” as ${format}`, onclick: action}, format);
    const drawing = () => this.chart.drawing(Math.max(kSavedWidth, figure.wide ? this.chart.width : 0), true).svg;
    this.frame.replaceChildren(
        element('figcaption', {},
            element('h3', {}, figure.title),
            element('div', {class: 'tools'},
                ...(variants.length > 1 ? [select(figure.variantKind, variants, figure.variant,
                    (variant) => state.choose(figure.variantKind, variant))] : []),
                save('CSV', 'the numbers', () => saveCsv(figure, this.columns)),
                save('SVG', 'the drawing', () => saveSvg(figure.id, drawing())),
                save('PNG', 'a picture', () => savePng(figure.id, drawing()))),
            figure.caption ? element('p', {}, figure.caption) : ''),
        this.legend, plot);
    this.chart = new Chart(plot, figure, this.columns, {
      zoom: (window) => (isOverTime(figure) ? state.set('window', window) : this.chart.showWindow(window)),
      point: (x, row) => {
        this.row = row;
        if (isOverTime(figure)) state.set('cursor', x);
        else this.showReadings(x);
      },
      pick: (x) => isOverTime(figure) && state.set('time', x),
    });
    if (isOverTime(figure)) {
      this.chart.showWindow(state.window);
      this.chart.showTime(state.time);
    }
    this.buildLegend();
  }

  buildLegend() {
    const {chart} = this;
    this.values = [];
    this.legend.replaceChildren();
    if (chart.map) this.legend.append(...chart.legendOfMap());
    for (const series of chart.legend()) {
      const value = element('span', {class: 'value'});
      const button = element('button', {type: 'button', class: 'series', 'aria-pressed': String(!chart.hidden.has(series.name)),
        title: 'Show or hide', onclick: () => {
          chart.toggle(series.name);
          button.setAttribute('aria-pressed', String(!chart.hidden.has(series.name)));
        }}, sampleOf(series), series.name, value);
      this.values.push(value);
      this.legend.append(button);
    }
    this.legend.append(this.reading);
  }

  showReadings(x) {
    const {figure} = this;
    const found = this.chart.showCursor(x);
    this.values.forEach((node, k) => {
      node.textContent = found ? withUnit(found.values[k], figure.y) : '';
    });
    this.reading.textContent = '';
    if (!found) return;
    const at = figure.x.categories?.[found.x - 1] ?? `${figure.x.label} ${withUnit(found.x, figure.x)}`;
    const row = figure.map?.rows[this.row];
    if (row) this.reading.textContent = `${row}, ${at}: ${withUnit(found.values[this.row], figure.map.scale)}`;
    else if (!figure.map) this.reading.textContent = at;
  }

  /** The colours of a heat map are those of the theme. */
  repaint() {
    if (!this.chart?.map) return;
    this.chart.draw();
    this.buildLegend();
  }

  resize() {
    this.chart?.resize();
  }
}
