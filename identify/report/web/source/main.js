// SPDX-License-Identifier: BSD-3-Clause
// Puts charts and player into the page that catena wrote (page.html), and joins them.
import './report.css';
import {Card} from './card.js';
import {element, select} from './element.js';
import {typeset} from './equations.js';
import {Player} from './player.js';
import {State} from './state.js';

const page = document.documentElement;
const systemDark = matchMedia('(prefers-color-scheme: dark)');
let theme = 'system';
let printing = false;

function showTheme(state) {
  const dark = !printing && (theme === 'dark' || (theme === 'system' && systemDark.matches));
  page.dataset.shown = dark ? 'dark' : 'light';
  state.set('theme');
}

function buildControls(state, experiments) {
  const controls = document.getElementById('controls');
  if (experiments.length > 1) {
    controls.append(select('Experiment', experiments, state.experiment, (name) => {
      state.experiment = name;
      state.set('window', null);
      state.set('experiment', name);
    }));
  }
  const whole = element('button', {type: 'button', disabled: true, onclick: () => state.set('window', null)}, 'Whole time');
  state.on('window', (window) => { whole.disabled = window === null; });
  controls.append(whole, select('Theme', ['system', 'light', 'dark'], theme, (chosen) => {
    theme = chosen;
    showTheme(state);
  }));
}

function start() {
  const data = JSON.parse(document.getElementById('data').textContent);
  const state = new State();
  const named = [...data.motions, ...data.figures].map((part) => part.experiment).filter((name) => name !== '');
  const experiments = [...new Set(named)];
  state.experiment = experiments[0] ?? '';
  showTheme(state);
  buildControls(state, experiments);

  const cards = new Map();
  for (const frame of document.querySelectorAll('figure[data-family]')) {
    const figures = data.figures.filter((figure) => figure.family === frame.dataset.family);
    if (figures.length > 0) cards.set(frame, new Card(frame, figures, data.columns, state));
  }
  const watcher = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      if (!entry.isIntersecting) continue;
      watcher.unobserve(entry.target);
      cards.get(entry.target).show();
    }
  }, {rootMargin: '400px'});
  for (const frame of cards.keys()) watcher.observe(frame);

  const host = document.getElementById('player');
  if (host && data.motions.length > 0) new Player(host, data.motions, data.columns, state);

  setTimeout(typeset);  // charts and player first

  const resize = () => cards.forEach((card) => card.resize());
  addEventListener('resize', resize);
  systemDark.addEventListener('change', () => showTheme(state));
  const closed = [];
  addEventListener('beforeprint', () => {
    printing = true;
    page.classList.add('printing');  // the width of the paper, before the charts are measured
    for (const details of document.querySelectorAll('details:not([open])')) {
      details.open = true;
      closed.push(details);
    }
    showTheme(state);
    cards.forEach((card) => card.show());
    resize();
  });
  addEventListener('afterprint', () => {
    printing = false;
    page.classList.remove('printing');
    for (const details of closed.splice(0)) details.open = false;
    showTheme(state);
    resize();
  });
}

start();
