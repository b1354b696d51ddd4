// SPDX-License-Identifier: BSD-3-Clause
// Animates the cable, with what was measured over it.
import {element, select, svg} from './element.js';
import {linePath, markerPath, strokeOf} from './marks.js';
import {forPeople} from './numbers.js';
import {plotArea} from './plot_area.js';
import {savePng, saveSvg} from './save.js';

const height = 456;  // px at most
const speeds = ['0.1', '0.25', '0.5', '1', '2', '4'];

export class Player {
  constructor(host, motions, columns, state) {
    Object.assign(this, {host, columns, state});
    this.motions = motions.map((motion) => resolve(motion, columns));
    this.speed = 1;
    this.overlay = false;
    this.running = null;
    this.view = 0;  // rad: where a motion in space is seen from; 0: along across
    this.build();
    state.on('experiment', () => this.load());
    state.on('time', (time) => this.showTime(time));
    this.load();
  }

  build() {
    const button = (words, label, action) =>
      element('button', {type: 'button', title: label, 'aria-label': label, onclick: action}, words);
    this.stage = element('div', {class: 'stage', role: 'img', 'aria-label': 'Animation of the cable: side over down, in metres'});
    this.playButton = button('▶', 'Play', () => this.toggle());
    this.slider = element('input', {type: 'range', min: 0, step: 1, value: 0, 'aria-label': 'Frame',
      oninput: () => this.seekFrame(Number(this.slider.value))});
    this.clock = element('output', {class: 'clock'});
    this.overlayBox = element('input', {type: 'checkbox', onchange: () => {
      this.overlay = this.overlayBox.checked;
      this.paint();
    }});
    this.turn = element('input', {type: 'range', min: -180, max: 180, step: 1, value: 0, 'aria-label': 'View, degrees about the vertical',
      oninput: () => this.look(Number(this.turn.value))});
    this.turnLabel = element('label', {class: 'choice'}, 'View ', this.turn);
    this.key = element('p', {class: 'key'});
    this.controls = element('div', {class: 'controls', role: 'group', 'aria-label': 'Player'},
        button('◀◀', 'To the start', () => this.seekFrame(0)),
        button('−1', '−1 frame', () => this.step(-1)),
        this.playButton,
        button('+1', '+1 frame', () => this.step(1)),
        this.slider, this.clock,
        select('Speed', speeds, '1', (speed) => { this.speed = Number(speed); }),
        this.turnLabel,
        element('label', {class: 'choice'}, this.overlayBox, ' Shapes so far'),
        button('SVG', 'Save this frame as SVG', () => saveSvg(this.fileName(), this.area.svg)),
        button('PNG', 'Save this frame as PNG', () => savePng(this.fileName(), this.area.svg)));
    this.controls.addEventListener('keydown', (event) => this.key_pressed(event));
    this.host.append(this.stage, this.key, this.controls);
    new ResizeObserver(() => this.draw()).observe(this.host);
  }

  load() {
    this.pause();
    this.motion = this.motions.find((motion) => motion.experiment === this.state.experiment) ?? this.motions[0];
    this.slider.max = String(this.motion.time.length - 1);
    this.turnLabel.hidden = !this.motion.across;
    const {measured, before} = this.motion;
    this.key.replaceChildren(
        ...[['simulated', 'c1', '—●'], ...(measured ? [['measured', 'c0', '○']] : []), ...(before ? [['before', 'c2', '- -']] : [])]
            .map(([words, colour, sign]) => element('span', {},
                element('span', {style: `color: var(--${colour})`, 'aria-hidden': 'true'}, sign), ` ${words} `)));
    this.look(this.motion.across ? Number(this.turn.value) : 0);
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

  /** From an angle about the vertical, degrees: at 0 side is to the right, at 90 across is. */
  look(degrees) {
    this.view = degrees * Math.PI / 180;
    this.turn.value = String(degrees);
    this.turn.setAttribute('aria-valuetext', `${degrees} degrees`);
    this.draw();
  }

  fileName() {
    return `frame_${this.clock.textContent.split(' ')[0].replace('.', '_')}_s`;
  }

  /** Axes; what moves is left to paint(). */
  draw() {
    const width = Math.max(240, this.stage.clientWidth);
    const bounds = boundsOf(this.motion);
    this.area = plotArea({width, height, equalAspect: true,
      x: {axis: {label: {0: 'side', 90: 'across'}[this.turn.value] ?? 'to the right', unit: 'm'}, range: bounds.right},
      y: {axis: {label: 'down', unit: 'm'}, range: bounds.down, reversed: true}});
    this.area.svg.prepend(svg('rect', {width: '100%', height: '100%', fill: 'var(--paper)'}));
    this.stage.replaceChildren(this.area.svg);
    this.paint();
  }

  paint() {
    if (!this.area) return;
    const {motion, frame, area, view} = this;
    const now = motion.time[frame];
    const seenPlaces = (part, at) => places(area, part, at, view).filter((place) => place !== null);
    const cable = (part, at, attributes) => svg('path', {fill: 'none', 'stroke-linejoin': 'round',
      d: linePath(seenPlaces(part, at)), ...attributes});
    const drawn = [];
    if (this.overlay) {
      const step = Math.max(0.02, (motion.time.at(-1) - motion.time[0]) / 90);  // 0.02 s in figure 6.10
      for (let at = motion.time[0]; at < now; at += step) {
        drawn.push(cable(motion, nearest(motion.time, at), {stroke: strokeOf(1), opacity: 0.3}));
      }
    }
    if (motion.before) {
      drawn.push(cable(motion.before, nearest(motion.before.time, now), {stroke: strokeOf(2), 'stroke-width': 1.6, 'stroke-dasharray': '7 3'}));
    }
    drawn.push(cable(motion, frame, {stroke: strokeOf(1), 'stroke-width': 2.2}));
    const joints = seenPlaces(motion, frame);
    const small = joints.length > 30 ? 1.5 : 2.5;
    const dots = joints.map((at, k) => (k + 1 === joints.length && motion.loadMass > 0 ? markerPath(0, at, 6) : markerPath(0, at, small)));
    drawn.push(svg('path', {d: dots.join(''), fill: strokeOf(1)}));
    if (joints.length > 0) drawn.push(svg('rect', {x: joints[0][0] - 7, y: joints[0][1] - 4, width: 14, height: 4, fill: 'var(--ink)'}));
    const {measured} = motion;
    const seen = measured ? nearest(measured.time, now) : null;
    // The frame nearest in time, unless it is further away than the recording's step.
    if (measured && Math.abs(measured.time[seen] - now) <= (measured.time.at(-1) - measured.time[0]) / Math.max(1, measured.time.length - 1)) {
      if (measured.connected) drawn.push(cable(measured, seen, {stroke: strokeOf(0), 'stroke-width': 1.4, 'stroke-dasharray': '2 2.5'}));
      const markers = seenPlaces(measured, seen).map((place) => markerPath(0, place, 4.5));
      drawn.push(svg('path', {d: markers.join(''), fill: 'none', stroke: strokeOf(0), 'stroke-width': 1.4}));
    }
    area.inside.replaceChildren(...drawn);
  }
}

/** Places of the points in one frame, seen from `view` (rad); null: not seen. */
const places = (area, part, frame, view) => part.side.map((side, p) => {
  const [x, y, z] = [side[frame], part.down[p][frame], part.across ? part.across[p][frame] : 0];
  return x === null || y === null || z === null ? null : [area.x(x * Math.cos(view) + z * Math.sin(view)), area.y(y)];
});

function resolve(motion, columns) {
  const positions = ({time, side, down, across, ...rest}) => ({...rest, time: columns[time],
    side: side.map((k) => columns[k]), down: down.map((k) => columns[k]), across: across?.map((k) => columns[k])});
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

/** Ends of what is to the right and of down over all times, and a little more. In space the same for all views. */
function boundsOf(motion) {
  let [left, right, top, bottom] = [0, 0, 0, 0];
  for (const part of [motion, motion.measured, motion.before]) {
    part?.side.forEach((row, p) => row.forEach((side, k) => {
      const down = part.down[p][k];
      if (side === null || down === null) return;
      const reach = part.across ? Math.hypot(side, part.across[p][k]) : side;
      [left, right] = [Math.min(left, part.across ? -reach : side), Math.max(right, reach)];
      [top, bottom] = [Math.min(top, down), Math.max(bottom, down)];
    }));
  }
  const margin = 0.06 * Math.max(right - left, bottom - top, 1e-3);
  return {right: [left - margin, right + margin], down: [top - margin, bottom + margin]};
}
