// SPDX-License-Identifier: BSD-3-Clause
// The frame of every drawing: axes with ticks, labels and names, a grid, and an inside that is clipped.
import {svg} from './element.js';
import {axisTitle, forPeople, linearTicks, logarithmicTicks, tickLabels} from './numbers.js';

export const fontFamily = 'system-ui, "Liberation Sans", Arial, sans-serif';
const fontSize = 12;
const kMostSideBySide = 5;  // names under an axis; more stand aslant

const measuring = document.createElement('canvas').getContext('2d');
let areas = 0;

/** Width of a text in a drawing, px. */
export function textWidth(text) {
  measuring.font = `${fontSize}px ${fontFamily}`;
  return measuring.measureText(text).width;
}

/** Value to place; at.invert: place to value. */
function scaleOf(axis, [low, high], from, to) {
  const linear = axis.logarithmic ? Math.log10 : (value) => value;
  const factor = (to - from) / (linear(high) - linear(low));
  const at = (value) => from + (linear(value) - linear(low)) * factor;
  at.invert = (place) => {
    const value = linear(low) + (place - from) / factor;
    return axis.logarithmic ? 10 ** value : value;
  };
  return at;
}

/** [{at, label}]: the axis's own, the categories for which there is room, or round numbers. */
function ticksOf(axis, [low, high], length, spacing) {
  if (axis.ticks) return axis.ticks;
  if (axis.categories) {
    const stride = Math.max(1, Math.ceil(axis.categories.length * 15 / length));
    return axis.categories.map((label, k) => ({at: k + 1, label})).filter((_, k) => k % stride === 0);
  }
  const about = Math.max(2, length / spacing);
  const at = axis.logarithmic ? logarithmicTicks(low, high, about) : linearTicks(low, high, about);
  const labels = axis.logarithmic ? at.map((value) => forPeople(value)) : tickLabels(at);
  return at.map((value, k) => ({at: value, label: labels[k]}));
}

/**
 * x, y: {axis, range: [low, high], reversed}; size: {width, height, head}: head is left empty above.
 * equalAspect: one unit of x is as long as one of y, and the drawing as low as that makes it.
 * Returns {svg, inside, over, x, y, box}: groups below and above the frame, scales, place of the inside.
 */
export function plotArea({width, height, head = 0, x, y, grid = true, equalAspect = false}) {
  const crowded = (x.axis.categories?.length ?? 0) > kMostSideBySide;
  const below = (axisTitle(x.axis) ? 20 : 4) + (crowded ? 60 : x.axis.categories ? 34 : 22);
  const [top, right] = [head + 8, 14];
  let inner = height - top - below;
  const [across, along] = [x.range[1] - x.range[0], y.range[1] - y.range[0]];
  if (equalAspect) inner = Math.min(inner, (width - 80) * along / across);  // about 80 px beside it
  const yTicks = ticksOf(y.axis, y.range, inner, 45);
  const labelled = Math.max(0, ...yTicks.map((tick) => textWidth(tick.label)));
  let left = Math.ceil(labelled) + 10 + (axisTitle(y.axis) ? 20 : 0);
  let wide = width - left - right;
  if (equalAspect) {
    const scale = Math.min(wide / across, inner / along);
    inner = scale * along;
    left += (wide - scale * across) / 2;
    wide = scale * across;
  }
  const box = {left, top, width: wide, height: inner, right: left + wide, bottom: top + inner};
  const placeX = scaleOf(x.axis, x.range, box.left, box.right);
  const placeY = scaleOf(y.axis, y.range, ...(y.reversed ? [box.top, box.bottom] : [box.bottom, box.top]));

  const text = (words, at, attributes) => svg('text', {x: at[0], y: at[1], fill: 'var(--ink)', ...attributes}, words);
  const [lines, ticks, labels] = [[], [], []];
  for (const {at, label} of ticksOf(x.axis, x.range, wide, 80)) {
    const place = placeX(at).toFixed(1);
    if (grid) lines.push(`M${place} ${box.top}V${box.bottom}`);
    ticks.push(`M${place} ${box.bottom}v5`);
    const words = x.axis.categories && !crowded ? label.split(/ (.*)/, 2) : [label];  // a line for each word
    words.forEach((word, k) => labels.push(crowded
      ? text(word, [place, box.bottom + 16], {'text-anchor': 'end', transform: `rotate(-35 ${place} ${box.bottom + 12})`})
      : text(word, [place, box.bottom + 18 + 14 * k], {'text-anchor': 'middle'})));
  }
  for (const {at, label} of yTicks) {
    const place = placeY(at);
    if (grid) lines.push(`M${box.left} ${place.toFixed(1)}H${box.right}`);
    ticks.push(`M${box.left} ${place.toFixed(1)}h-5`);
    labels.push(text(label, [box.left - 8, (place + 4).toFixed(1)], {'text-anchor': 'end'}));
  }
  const [middle, centre] = [box.left + wide / 2, box.top + inner / 2];
  labels.push(text(axisTitle(x.axis), [middle, box.bottom + below - 6], {'text-anchor': 'middle'}));
  const aside = box.left - labelled - 18;
  labels.push(text(axisTitle(y.axis), [aside, centre], {'text-anchor': 'middle', transform: `rotate(-90 ${aside} ${centre})`}));

  const [inside, over] = [svg('g', {'clip-path': `url(#inside-${++areas})`}), svg('g')];
  const whole = Math.ceil(box.bottom + below);
  const frame = {x: box.left, y: box.top, width: box.width, height: box.height};
  return {
    svg: svg('svg', {xmlns: 'http://www.w3.org/2000/svg', width, height: whole, viewBox: `0 0 ${width} ${whole}`,
      'font-family': fontFamily, 'font-size': fontSize},
    svg('clipPath', {id: `inside-${areas}`}, svg('rect', frame)),
    svg('path', {d: lines.join(''), stroke: 'var(--grid)', fill: 'none'}),
    inside,
    svg('rect', {...frame, stroke: 'var(--ink)', fill: 'none'}),
    svg('path', {d: ticks.join(''), stroke: 'var(--ink)', fill: 'none'}),
    ...labels, over),
    inside, over, x: placeX, y: placeY, box,
  };
}
