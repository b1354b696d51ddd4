// SPDX-License-Identifier: BSD-3-Clause
// Animates the cable, with what was measured over it.
import {element, select} from './element.js';
import {cssColour, traceMarker} from './marks.js';
import {forPeople, linearTicks, tickLabels} from './numbers.js';
import {renderingPixelRatio} from './pixel_ratio.js';

const margin = {left: 56, right: 16, top: 12, bottom: 44};  // CSS pixels
const speeds = ['0.1', '0.25', '0.5', '1', '2', '4'];

export class Player {
  constructor(host, motions, columns, state) {
    Object.assign(this, {host, columns, state});
    this.motions = motions.map((motion) => resolve(motion, columns));
    this.speed = 1;
    this.overlay = false;
    this.running = null;
    this.build();
    state.on('experiment', () => this.load());
    state.on('theme', () => this.paint());
    state.on('time', (time) => this.showTime(time));
    this.load();
  }

  build() {
    const button = (words, label, action) =>
      element('button', {type: 'button', title: label, 'aria-label': label, onclick: action}, words);
    this.canvas = element('canvas', {role: 'img', 'aria-label': 'Animation of the cable: side over down, in metres'});
    this.playButton = button('▶', 'Play', () => this.toggle());
    this.slider = element('input', {type: 'range', min: 0, step: 1, value: 0, 'aria-label': 'Frame',
      oninput: () => this.seekFrame(Number(this.slider.value))});
    this.clock = element('output', {class: 'clock'});
    this.overlayBox = element('input', {type: 'checkbox', onchange: () => {
      this.overlay = this.overlayBox.checked;
      this.paint();
    }});
    this.key = element('p', {class: 'key'});
    this.controls = element('div', {class: 'controls', role: 'group', 'aria-label': 'Player'},
        button('◀◀', 'To the start', () => this.seekFrame(0)),
        button('−1', '−1 frame', () => this.step(-1)),
        this.playButton,
        button('+1', '+1 frame', () => this.step(1)),
        this.slider, this.clock,
        select('Speed', speeds, '1', (speed) => { this.speed = Number(speed); }),
        element('label', {class: 'choice'}, this.overlayBox, ' Shapes so far'));
    this.controls.addEventListener('keydown', (event) => this.key_pressed(event));
    this.host.append(this.canvas, this.key, this.controls);
    new ResizeObserver(() => this.paint()).observe(this.host);
  }

  load() {
    this.pause();
    this.motion = this.motions.find((motion) => motion.experiment === this.state.experiment) ?? this.motions[0];
    this.bounds = boundsOf(this.motion);
    this.slider.max = String(this.motion.time.length - 1);
    const {measured, before} = this.motion;
    this.key.replaceChildren(
        ...[['simulated', 'c1', '—●'], ...(measured ? [['measured', 'c0', '○']] : []), ...(before ? [['before', 'c2', '- -']] : [])]
            .map(([words, colour, sign]) => element('span', {},
                element('span', {style: `color: var(--${colour})`, 'aria-hidden': 'true'}, sign), ` ${words} `)));
    this.seekFrame(0);
  }

  get frame() {
    return nearest(this.motion.time, this.state.time ?? this.motion.time[0]);
  }

  seekFrame(frame) {
    const last = this.motion.time.length - 1;
    this.state.set('time', this.motion.time[Math.min(last, Math.max(0, frame))]);
  }

  step(by) {
    this.pause();
    this.seekFrame(this.frame + by);
  }

  toggle() {
    if (this.running !== null) this.pause();
    else this.play();
  }

  play() {
    const {time} = this.motion;
    if (this.frame === time.length - 1) this.seekFrame(0);
    this.setPlaying(true);
    let previous = null;
    let at = this.state.time;
    const advance = (now) => {
      if (previous !== null) at += this.speed * (now - previous) / 1000;
      previous = now;
      if (at >= time.at(-1)) {
        this.state.set('time', time.at(-1));
        this.pause();
        return;
      }
      this.playing = true;
      this.state.set('time', at);
      this.playing = false;
      this.running = requestAnimationFrame(advance);
    };
    this.running = requestAnimationFrame(advance);
  }

  pause() {
    if (this.running !== null) cancelAnimationFrame(this.running);
    this.running = null;
    this.setPlaying(false);
  }

  setPlaying(playing) {
    const label = playing ? 'Pause' : 'Play';
    this.playButton.textContent = playing ? '❚❚' : '▶';
    this.playButton.title = label;
    this.playButton.setAttribute('aria-label', label);
  }

  showTime(time) {
    if (this.running !== null && !this.playing) this.pause();  // somebody else chose a time
    this.slider.value = String(this.frame);
    this.slider.setAttribute('aria-valuetext', `${forPeople(time)} s`);
    this.clock.textContent = `${time.toFixed(2)} s of ${this.motion.time.at(-1).toFixed(2)} s`;
    this.paint();
  }

  key_pressed(event) {
    if (event.target.tagName === 'SELECT' || event.target.tagName === 'INPUT') return;
    const act = {ArrowLeft: () => this.step(-1), ArrowRight: () => this.step(1), Home: () => this.seekFrame(0),
      End: () => this.seekFrame(this.motion.time.length - 1)}[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }

  paint() {
    const width = this.host.clientWidth;
    if (width === 0) return;
    const {bounds, canvas} = this;
    const ratio = renderingPixelRatio;
    const wide = width - margin.left - margin.right;
    const scale = Math.min(wide / (bounds.right - bounds.left), 400 / (bounds.bottom - bounds.top));
    const height = Math.round(scale * (bounds.bottom - bounds.top) + margin.top + margin.bottom);
    canvas.style.height = `${height}px`;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const context = canvas.getContext('2d');
    context.scale(ratio, ratio);
    const offset = margin.left + (wide - scale * (bounds.right - bounds.left)) / 2;
    const place = {
      x: (side) => offset + scale * (side - bounds.left),
      y: (down) => margin.top + scale * (down - bounds.top),
      left: offset, right: offset + scale * (bounds.right - bounds.left), top: margin.top, bottom: height - margin.bottom,
    };
    paintGrid(context, place, bounds);
    context.save();
    context.beginPath();
    context.rect(place.left, place.top, place.right - place.left, place.bottom - place.top);
    context.clip();
    this.paintMotion(context, place);
    context.restore();
  }

  paintMotion(context, place) {
    const {motion, frame} = this;
    const now = motion.time[frame];
    if (this.overlay) {
      const step = Math.max(0.02, (motion.time.at(-1) - motion.time[0]) / 90);  // 0.02 s in figure 6.10
      context.globalAlpha = 0.3;
      for (let at = motion.time[0]; at < now; at += step) {
        paintCable(context, place, motion, nearest(motion.time, at), 'c1', [], 1);
      }
      context.globalAlpha = 1;
    }
    if (motion.before) paintCable(context, place, motion.before, nearest(motion.before.time, now), 'c2', [7, 3], 1.6);
    paintCable(context, place, motion, frame, 'c1', [], 2.2);
    paintJoints(context, place, motion, frame);
    if (motion.measured) paintMeasured(context, place, motion.measured, now);
  }
}

function resolve(motion, columns) {
  const positions = ({time, side, down, ...rest}) => ({...rest, time: columns[time],
    side: side.map((k) => columns[k]), down: down.map((k) => columns[k])});
  return {...positions(motion), measured: motion.measured && positions(motion.measured),
    before: motion.before && positions(motion.before)};
}

function nearest(times, at) {
  let [low, high] = [0, times.length - 1];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] < at) low = middle + 1;
    else high = middle;
  }
  return low > 0 && at - times[low - 1] < times[low] - at ? low - 1 : low;
}

function boundsOf(motion) {
  const bounds = {left: 0, right: 0, top: 0, bottom: 0};
  for (const part of [motion, motion.measured, motion.before]) {
    for (const row of part?.side ?? []) {
      for (const side of row) {
        if (side === null) continue;
        bounds.left = Math.min(bounds.left, side);
        bounds.right = Math.max(bounds.right, side);
      }
    }
    for (const row of part?.down ?? []) {
      for (const down of row) {
        if (down === null) continue;
        bounds.top = Math.min(bounds.top, down);
        bounds.bottom = Math.max(bounds.bottom, down);
      }
    }
  }
  const margin = 0.06 * Math.max(bounds.right - bounds.left, bounds.bottom - bounds.top, 1e-3);
  return {left: bounds.left - margin, right: bounds.right + margin, top: bounds.top - margin, bottom: bounds.bottom + margin};
}

function paintGrid(context, place, bounds) {
  context.strokeStyle = cssColour('grid');
  context.fillStyle = cssColour('ink');
  context.font = '12px system-ui, "Liberation Sans", Arial, sans-serif';
  context.lineWidth = 1;
  const sides = linearTicks(bounds.left, bounds.right, Math.max(2, (place.right - place.left) / 90));
  const downs = linearTicks(bounds.top, bounds.bottom, Math.max(2, (place.bottom - place.top) / 60));
  context.beginPath();
  for (const side of sides) {
    context.moveTo(place.x(side), place.top);
    context.lineTo(place.x(side), place.bottom);
  }
  for (const down of downs) {
    context.moveTo(place.left, place.y(down));
    context.lineTo(place.right, place.y(down));
  }
  context.stroke();
  context.textAlign = 'center';
  tickLabels(sides).forEach((label, k) => context.fillText(label, place.x(sides[k]), place.bottom + 16));
  context.fillText('side / m', (place.left + place.right) / 2, place.bottom + 36);
  context.textAlign = 'right';
  tickLabels(downs).forEach((label, k) => context.fillText(label, place.left - 6, place.y(downs[k]) + 4));
  context.save();
  context.translate(place.left - 42, (place.top + place.bottom) / 2);
  context.rotate(-Math.PI / 2);
  context.textAlign = 'center';
  context.fillText('down / m', 0, 0);
  context.restore();
  context.strokeStyle = cssColour('ink');
  context.strokeRect(place.left, place.top, place.right - place.left, place.bottom - place.top);
}

function paintCable(context, place, motion, frame, colour, dash, width) {
  context.strokeStyle = cssColour(colour);
  context.lineWidth = width;
  context.lineJoin = 'round';
  context.setLineDash(dash);
  context.beginPath();
  motion.side.forEach((side, p) => {
    const [x, y] = [side[frame], motion.down[p][frame]];
    if (x !== null && y !== null) context[p ? 'lineTo' : 'moveTo'](place.x(x), place.y(y));
  });
  context.stroke();
  context.setLineDash([]);
}

function paintJoints(context, place, motion, frame) {
  const last = motion.side.length - 1;
  context.fillStyle = cssColour('c1');
  motion.side.forEach((side, p) => {
    const load = p === last && motion.loadMass > 0;
    const radius = load ? 6 : motion.side.length > 30 ? 1.5 : 2.5;
    context.beginPath();
    context.arc(place.x(side[frame]), place.y(motion.down[p][frame]), radius, 0, 2 * Math.PI);
    context.fill();
  });
  context.fillStyle = cssColour('ink');
  context.fillRect(place.x(motion.side[0][frame]) - 7, place.y(motion.down[0][frame]) - 4, 14, 4);
}

/** The frame nearest in time, unless it is further away than the recording's step. */
function paintMeasured(context, place, measured, now) {
  const frame = nearest(measured.time, now);
  const step = (measured.time.at(-1) - measured.time[0]) / Math.max(1, measured.time.length - 1);
  if (Math.abs(measured.time[frame] - now) > step) return;
  if (measured.connected) paintCable(context, place, measured, frame, 'c0', [2, 2.5], 1.4);
  context.strokeStyle = cssColour('c0');
  context.lineWidth = 1.4;
  context.beginPath();
  measured.side.forEach((side, p) => {
    const [x, y] = [side[frame], measured.down[p][frame]];
    if (x !== null && y !== null) traceMarker(context, 0, place.x(x), place.y(y), 4.5);
  });
  context.stroke();
}
