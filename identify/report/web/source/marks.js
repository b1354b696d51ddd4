// SPDX-License-Identifier: BSD-3-Clause
// Colours, dashes and markers of series, as in palette.hpp and svg_elements.cpp. The colours
// themselves are in report.css, for light and dark.

const dashes = [[], [], [7, 3], [2, 2.5], [9, 3, 2, 3], [12, 4], [5, 2, 1, 2, 1, 2]];

export const colourIndex = (colour) => (colour <= 0 ? 0 : 1 + ((colour - 1) % 6));
export const hasLine = (series) => series.mark !== 'points';
export const hasPoints = (series) => series.mark === 'points' || series.mark === 'lineWithPoints';

export function dashOf(series) {
  const dash = dashes[colourIndex(series.colour)];
  return series.mark === 'dashes' && dash.length === 0 ? dashes[2] : dash;
}

export function cssColour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

export const seriesColour = (colour) => cssColour(`c${colourIndex(colour)}`);

/** Adds the outline of a series' marker to a path (canvas context or Path2D). */
export function traceMarker(path, colour, x, y, r) {
  const corners = {
    3: [[-1, -1], [1, -1], [1, 1], [-1, 1]],
    4: [[0, -1], [1, 1], [-1, 1]],
    5: [[0, -1], [1, 0], [0, 1], [-1, 0]],
    6: [[0, 1], [1, -1], [-1, -1]],
  };
  const index = colourIndex(colour);
  if (index === 0) {
    path.moveTo(x + r, y);
    path.arc(x, y, r, 0, 2 * Math.PI);
  } else if (index <= 2) {
    const d = index === 2 ? r : 0;
    path.moveTo(x - r, y - d);
    path.lineTo(x + r, y + d);
    path.moveTo(x - d, y + r);
    path.lineTo(x + d, y - r);
  } else {
    corners[index].forEach(([dx, dy], k) => path[k ? 'lineTo' : 'moveTo'](x + r * dx, y + r * dy));
    path.closePath();
  }
}

/** A small canvas that shows how a series is drawn. */
export function drawSample(canvas, series, ratio) {
  const [width, height] = [30, 12];
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  const context = canvas.getContext('2d');
  context.scale(ratio, ratio);
  context.strokeStyle = seriesColour(series.colour);
  if (hasLine(series)) {
    context.lineWidth = 1.6;
    context.setLineDash(dashOf(series));
    context.beginPath();
    context.moveTo(0, height / 2);
    context.lineTo(width, height / 2);
    context.stroke();
  }
  if (hasPoints(series)) {
    context.lineWidth = 1.2;
    context.setLineDash([]);
    context.beginPath();
    traceMarker(context, series.colour, width / 2, height / 2, 3.5);
    context.stroke();
  }
}
