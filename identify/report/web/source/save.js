// SPDX-License-Identifier: BSD-3-Clause
// A chart as a file: its numbers (CSV), its drawing (SVG) or a picture of it (PNG).
import {element} from './element.js';
import {cssColour} from './marks.js';
import {axisTitle} from './numbers.js';

const kPixelRatio = 3;  // about 300 dots per inch where the drawing is 160 mm wide

const kKeptMilliseconds = 60_000;  // a busy browser may begin to read a file seconds after the click

function download(name, url) {
  element('a', {href: url, download: name}).click();
  setTimeout(() => URL.revokeObjectURL(url), kKeptMilliseconds);
}

/** The drawing as text that needs no style sheet: colours are those shown. */
const svgText = (drawing) =>
  new XMLSerializer().serializeToString(drawing).replace(/var\(--(\w+)\)/g, (_, name) => cssColour(name));

export function saveSvg(name, drawing) {
  download(`${name}.svg`, URL.createObjectURL(new Blob([svgText(drawing)], {type: 'image/svg+xml'})));
}

export async function savePng(name, drawing) {
  const image = new Image();
  // Image.decode() now and then refuses a drawing that it took a moment before.
  await new Promise((loaded, failed) => {
    image.onload = loaded;
    image.onerror = failed;
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svgText(drawing))}`;
  });
  const canvas = element('canvas', {width: kPixelRatio * image.width, height: kPixelRatio * image.height});
  canvas.getContext('2d').drawImage(image, 0, 0, canvas.width, canvas.height);
  canvas.toBlob((blob) => download(`${name}.png`, URL.createObjectURL(blob)));
}

export function saveCsv(figure, columns) {
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
  download(`${figure.id}.csv`, URL.createObjectURL(
      new Blob([lines.map((line) => line.join(',')).join('\n') + '\n'], {type: 'text/csv'})));
}
