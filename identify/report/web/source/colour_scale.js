// SPDX-License-Identifier: BSD-3-Clause
// Colours of values, their lightness falling steadily: YlGnBu (Brewer) for sizes, cividis (Nuñez et
// al. 2018) for signed values. On a dark page small sizes are dark.
import {svg} from './element.js';

export const sequential = [[255, 255, 217], [237, 248, 177], [199, 233, 180], [127, 205, 187], [65, 182, 196],
  [29, 145, 192], [34, 94, 168], [37, 52, 148], [8, 29, 88]];
export const signed = [[0, 34, 78], [26, 56, 111], [67, 78, 108], [97, 101, 111], [125, 124, 120], [155, 149, 119],
  [187, 175, 109], [220, 202, 89], [254, 232, 56]];

/** Colour [red, green, blue] of a value of the map. */
function colourOf(map) {
  const dark = document.documentElement.dataset.shown === 'dark';
  const anchors = map.signed ? signed : dark ? [...sequential].reverse() : sequential;
  return (value) => {
    const share = value / (map.maximum || 1);
    const place = Math.min(1, Math.max(0, map.signed ? (share + 1) / 2 : share)) * (anchors.length - 1);
    const lower = Math.min(Math.floor(place), anchors.length - 2);
    const weight = place - lower;
    return anchors[lower].map((part, i) => Math.round((1 - weight) * part + weight * anchors[lower + 1][i]));
  };
}

/** An image of columns x rows pixels stretched over the place; value(column, row) may be null: left blank. */
function picture(map, columns, rows, value, place) {
  const colour = colourOf(map);
  const pixels = new ImageData(columns, rows);
  for (let column = 0; column < columns; ++column) {
    for (let row = 0; row < rows; ++row) {
      const at = value(column, row);
      if (at !== null) pixels.data.set([...colour(at), 255], 4 * (row * columns + column));
    }
  }
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [columns, rows];
  canvas.getContext('2d').putImageData(pixels, 0, 0);
  return svg('image', {...place, href: canvas.toDataURL(), preserveAspectRatio: 'none', style: 'image-rendering: pixelated'});
}

/** A column of pixels for each pixel of the place's width: of the nearest x. */
export function pictureOfMap(map, {x, box}) {
  const columns = Math.max(1, Math.round(box.width));
  const nearest = [];
  for (let column = 0, k = 0; column < columns; ++column) {
    const at = x.invert(box.left + column + 0.5);
    while (k + 1 < map.x.length && Math.abs(map.x[k + 1] - at) <= Math.abs(map.x[k] - at)) ++k;
    nearest.push(k);
  }
  return picture(map, columns, map.rows.length, (column, row) => map.value[row][nearest[column]],
      {x: box.left, y: box.top, width: box.width, height: box.height});
}

/** The colours from one end of the scale to the other. */
export function pictureOfScale(map) {
  const [low, high] = [map.signed ? -map.maximum : 0, map.maximum];
  const bar = picture(map, 64, 1, (column) => low + (high - low) * (column + 0.5) / 64, {width: 140, height: 12});
  return svg('svg', {class: 'bar', width: 140, height: 12}, bar);
}
