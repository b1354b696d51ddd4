// SPDX-License-Identifier: BSD-3-Clause
// Colours, dashes and markers of series: a different one of each for every colour number, so that
// grey prints can be read. The colours themselves are in report.css, for light and dark.
import {svg} from './element.js';

const dashes = ['', '', '7 3', '2 2.5', '9 3 2 3', '12 4', '5 2 1 2 1 2'];
const corners = {
  3: [[-1, -1], [1, -1], [1, 1], [-1, 1]],
  4: [[0, -1], [1, 1], [-1, 1]],
  5: [[0, -1], [1, 0], [0, 1], [-1, 0]],
  6: [[0, 1], [1, -1], [-1, -1]],
};

const indexOf = (colour) => (colour <= 0 ? 0 : 1 + ((colour - 1) % 6));
const hasBars = (series) => series.mark === 'bars';
export const hasLine = (series) => series.mark !== 'points' && !hasBars(series);
export const hasPoints = (series) => series.mark !== 'line' && !hasBars(series);
const barThickness = 0.3;  // of a row; as in figure.hpp
export const strokeOf = (colour) => `var(--c${indexOf(colour)})`;

/** The value of a colour of the style sheet, in the theme that is shown. */
export const cssColour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** Path through the places [x, y]; null interrupts it. */
export function linePath(places) {
  let [path, pen] = ['', 'M'];
  for (const at of places) {
    if (at) path += `${pen}${at[0].toFixed(1)} ${at[1].toFixed(1)}`;
    pen = at ? 'L' : 'M';
  }
  return path;
}

/** Path of a series' marker of radius r. */
export function markerPath(colour, [x, y], r) {
  const index = indexOf(colour);
  const at = (dx, dy) => `${(x + r * dx).toFixed(1)} ${(y + r * dy).toFixed(1)}`;
  if (index === 0) return `M${at(1, 0)}A${r} ${r} 0 1 1 ${at(-1, 0)}A${r} ${r} 0 1 1 ${at(1, 0)}Z`;
  if (index === 1) return `M${at(-1, 0)}L${at(1, 0)}M${at(0, -1)}L${at(0, 1)}`;
  if (index === 2) return `M${at(-1, -1)}L${at(1, 1)}M${at(-1, 1)}L${at(1, -1)}`;
  return `M${corners[index].map(([dx, dy]) => at(dx, dy)).join('L')}Z`;
}

/** Line and markers of a series through the places; or its bars, from `zero` on, in rows `row` px high. */
export function marksOf(series, places, {radius = 3, zero = 0, row = 0} = {}) {
  const stroke = {fill: 'none', stroke: strokeOf(series.colour)};
  const seen = places.filter((at) => at !== null);
  const half = barThickness * row / 2;
  return [
    ...(hasBars(series) ? [svg('path', {...stroke, fill: strokeOf(series.colour), 'fill-opacity': series.colour % 2 ? 0.8 : 0.25,
      d: seen.map(([x, y]) => `M${zero.toFixed(1)} ${(y - half).toFixed(1)}H${x.toFixed(1)}v${(2 * half).toFixed(1)}H${zero.toFixed(1)}Z`).join('')})] : []),
    ...(hasLine(series) ? [svg('path', {...stroke, 'stroke-width': 1.6, 'stroke-linejoin': 'round',
      'stroke-dasharray': dashes[indexOf(series.colour)] || null, d: linePath(places)})] : []),
    ...(hasPoints(series) ? [svg('path', {...stroke, 'stroke-width': 1.2,
      d: seen.map((at) => markerPath(series.colour, at, radius)).join('')})] : []),
  ];
}

/** A small drawing that shows how a series is drawn. */
export function sampleOf(series) {
  const ends = hasLine(series) ? marksOf({...series, mark: 'line'}, [[0, 6], [30, 6]]) : [];
  const middle = hasPoints(series) ? marksOf({...series, mark: 'points'}, [[15, 6]], {radius: 3.5}) : [];
  const bar = hasBars(series) ? marksOf(series, [[28, 6]], {zero: 2, row: 8 / barThickness}) : [];
  return svg('svg', {class: 'sample', width: 30, height: 12, 'aria-hidden': 'true'}, ...ends, ...middle, ...bar);
}
