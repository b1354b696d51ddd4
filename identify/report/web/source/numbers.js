// SPDX-License-Identifier: BSD-3-Clause
// Numbers as people read them, and round numbers for axes.

const superscripts = {'-': '⁻', 0: '⁰', 1: '¹', 2: '²', 3: '³', 4: '⁴', 5: '⁵', 6: '⁶', 7: '⁷', 8: '⁸', 9: '⁹'};

export function forPeople(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return '–';
  if (value === 0) return '0';
  const [mantissa, power] = value.toExponential(digits - 1).split('e');
  const exponent = Number(power);
  if (exponent >= -4 && exponent < 6) {
    return withMinus(trimmed(value.toFixed(Math.max(0, digits - 1 - exponent))));
  }
  const raised = '10' + [...String(exponent)].map((c) => superscripts[c]).join('');
  const leading = trimmed(mantissa);
  return withMinus(leading === '1' ? raised : leading === '-1' ? '-' + raised : `${leading}×${raised}`);
}

/** Labels of evenly spaced ticks: as many decimals as the step needs. */
export function tickLabels(ticks) {
  const step = ticks.length > 1 ? Math.abs(ticks[1] - ticks[0]) : Math.abs(ticks[0] ?? 1) || 1;
  const largest = Math.max(...ticks.map(Math.abs), step);
  if (largest >= 1e6 || step < 1e-5) return ticks.map((tick) => forPeople(tick, 6));
  const decimals = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9));
  return ticks.map((tick) => withMinus(tick === 0 ? '0' : tick.toFixed(decimals)));
}

/** Multiples of 1, 2 or 5 times a power of ten in low..high, about so many. */
export function linearTicks(low, high, about) {
  if (!(high > low)) return [low];
  const raw = (high - low) / Math.max(1, about);
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= raw * 0.7);
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) ticks.push(k === 0 ? 0 : k * step);
  return ticks;
}

/** Powers of ten in low..high, thinned; where there are fewer than two, 1, 2, 5 times powers of ten. */
export function logarithmicTicks(low, high, about) {
  const first = Math.ceil(Math.log10(low) - 1e-9);
  const last = Math.floor(Math.log10(high) + 1e-9);
  const stride = Math.max(1, Math.ceil((last - first) / Math.max(1, about)));
  const ticks = [];
  for (let decade = first - 1; decade <= last; ++decade) {
    for (const factor of last - first < 1 ? [1, 2, 5] : [1]) {
      const at = factor * 10 ** decade;
      if (at >= low * (1 - 1e-9) && at <= high * (1 + 1e-9) && (last - first < 1 || (decade - first) % stride === 0)) ticks.push(at);
    }
  }
  return ticks;
}

export function axisTitle(axis) {
  if (!axis.unit || axis.unit === '1') return axis.label;
  return axis.label ? `${axis.label} / ${axis.unit}` : axis.unit;
}

export function withUnit(value, axis, digits = 4) {
  const text = forPeople(value, digits);
  return axis.unit && axis.unit !== '1' && text !== '–' ? `${text} ${axis.unit}` : text;
}

function trimmed(text) {
  return text.includes('.') ? text.replace(/\.?0+$/, '').replace(/^-0$/, '0') : text;
}

function withMinus(text) {
  return text.replace(/^-/, '−');
}
