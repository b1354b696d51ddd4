// SPDX-License-Identifier: BSD-3-Clause
// Colours of values: YlGnBu (Brewer) for sizes, cividis for signed values, as in palette.cpp. On a
// dark page small sizes are dark.

const sequential = [[255, 255, 217], [237, 248, 177], [199, 233, 180], [127, 205, 187], [65, 182, 196],
  [29, 145, 192], [34, 94, 168], [37, 52, 148], [8, 29, 88]];
const signed = [[0, 34, 78], [26, 56, 111], [67, 78, 108], [97, 101, 111], [125, 124, 120], [155, 149, 119],
  [187, 175, 109], [220, 202, 89], [254, 232, 56]];

export function colourScale(isSigned, dark) {
  const anchors = isSigned ? signed : dark ? [...sequential].reverse() : sequential;
  return (fraction) => {
    const place = Math.min(1, Math.max(0, fraction)) * (anchors.length - 1);
    const lower = Math.min(Math.floor(place), anchors.length - 2);
    const weight = place - lower;
    return anchors[lower].map((part, i) => Math.round((1 - weight) * part + weight * anchors[lower + 1][i]));
  };
}

export function cssGradient(scale) {
  const stops = [];
  for (let k = 0; k <= 16; ++k) stops.push(`rgb(${scale(k / 16).join(' ')})`);
  return `linear-gradient(to right, ${stops.join(', ')})`;
}
