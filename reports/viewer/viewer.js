// The viewer of one inspection, or of one part of a judged picture: controls, picture, what is known
// of the sample pointed at. What is shown of it is its kind's (kinds.js).

import { element, newId } from './dom.js';
import { sampleAt } from './inspection.js';
import { Picture } from './picture.js';

const kLeastRoom = 240; // CSS pixels

/**
 * @typedef {object} State
 * @property {number} x
 * @property {number} y
 * @property {number} sample
 * @property {string} view
 * @property {number} attribute  -1 for depth
 * @property {number} swipe  percent of the width that is expected, in a comparison
 * @property {boolean} isPinned  pointing does not move it
 */
export class Viewer {
  /**
   * @param {HTMLElement} place  what it is put into
   * @param {import('./kinds.js').Kind} kind
   * @param {string} data  of the page
   * @param {(state: State) => void} onChange
   */
  constructor(place, kind, data, onChange) {
    this.kind = kind;
    this.inspection = kind.parse(data);
    this.onChange = onChange;
    this.picture = new Picture(this.inspection, kind);
    this.state = this.firstState();
    place.append(this.build());
    this.draw();
    new ResizeObserver(() => this.fit()).observe(this.frame);
  }

  firstState() {
    const { x, y, sample } = this.inspection;
    return { x, y, sample, ...this.kind.firstView(this.inspection), swipe: 50, isPinned: false };
  }

  /** The sample that the state is at. */
  current() {
    const { x, y, sample } = this.state;
    return sampleAt(this.inspection, x, y, sample) ?? this.inspection.samples[0];
  }

  /**
   * Takes in new members of the state, as far as they mean something here.
   * @param {Partial<State>} change
   */
  set(change) {
    const next = { ...this.state, ...change };
    if (!this.kind.views.some(([view]) => view === next.view)) next.view = this.state.view;
    if (!this.kind.valuesOf(this.inspection).some((v) => v.attribute === next.attribute)) {
      next.attribute = this.state.attribute;
    }
    if (!sampleAt(this.inspection, next.x, next.y, next.sample)) {
      Object.assign(next, { x: this.state.x, y: this.state.y, sample: this.state.sample });
    }
    const isOther = next.view !== this.state.view || next.attribute !== this.state.attribute;
    this.state = next;
    if (isOther) this.draw();
    else this.move();
    this.onChange(next);
  }

  build() {
    const help = newId('help');
    this.frame = element('div', {
      class: 'frame',
      tabindex: 0,
      role: 'application',
      'aria-label': this.kind.label,
      'aria-describedby': help,
      keydown: (event) => this.onKey(event),
      pointermove: (event) => this.onPoint(event, false),
      pointerdown: (event) => this.onPoint(event, true),
    }, this.picture.node);
    this.legend = element('ul', { class: 'legend', 'aria-label': 'Legend' });
    this.panel = element('div', { class: 'panel' });
    this.live = element('p', { class: 'spoken', 'aria-live': 'polite' });
    return element('div', { class: 'viewer' },
      element('div', { class: 'controls' }, this.buildViews(), this.buildValues()),
      element('div', { class: 'looked-at' },
        element('div', { class: 'left' }, this.frame, this.buildSwipe(), this.legend,
          element('p', { class: 'keys', id: help }, this.kind.keys)),
        element('div', { class: 'right' }, this.buildJumps(), this.panel,
          ...this.kind.below(this.inspection), this.live)));
  }

  buildViews() {
    const group = newId('view');
    const choices = this.kind.views.map(([view, name]) => {
      const id = newId('view');
      const input = element('input', {
        type: 'radio', name: group, id, value: view, change: () => this.set({ view }),
      });
      return element('span', {}, input, element('label', { for: id }, name));
    });
    this.views = choices.map((choice) => choice.firstChild);
    return element('fieldset', { class: 'views' },
      element('legend', {}, 'Picture'), ...choices);
  }

  buildValues() {
    const id = newId('value');
    this.values = element('select', {
      id, change: () => this.set({ attribute: Number(this.values.value) }),
    }, ...this.kind.valuesOf(this.inspection).map(({ attribute, name }) =>
      element('option', { value: attribute }, name)));
    return element('p', { class: 'choice' }, element('label', { for: id }, this.kind.valueName), this.values);
  }

  buildSwipe() {
    const id = newId('swipe');
    this.swipe = element('input', {
      type: 'range', id, min: 0, max: 100, step: 1,
      input: () => this.set({ swipe: Number(this.swipe.value) }),
    });
    this.swipeRow = element('p', { class: 'swipe' },
      element('span', { 'aria-hidden': 'true' }, this.kind.expected), this.swipe,
      element('label', { for: id }, 'drawn',
        element('span', { class: 'unseen' },
          `: percent of the picture that shows ${this.kind.expected} values`)));
    return this.swipeRow;
  }

  buildJumps() {
    const jump = (text, target) => element('button', {
      type: 'button',
      click: () => {
        const sample = target();
        if (sample) this.set({ x: sample.x, y: sample.y, sample: sample.sample, isPinned: true });
      },
    }, text);
    const { samples } = this.inspection;
    const { first, largest, next, isOdd, worstOf } = this.kind.jumps;
    const odd = samples.filter(isOdd);
    const jumps = [jump(first, () => sampleAt(this.inspection, this.inspection.x,
      this.inspection.y, this.inspection.sample)),
    jump(largest, () => worstOf(this.inspection, this.state.attribute))];
    if (odd.length > 0) {
      jumps.push(jump(`${next} (${odd.length})`,
        () => odd[(odd.indexOf(this.current()) + 1) % odd.length]));
    }
    const row = element('p', { class: 'jumps' }, 'Go to: ', ...jumps);
    if (this.inspection.pattern.length > 1) row.append(this.buildSamples());
    return row;
  }

  buildSamples() {
    const id = newId('sample');
    this.samples = element('select', {
      id, change: () => this.set({ sample: Number(this.samples.value), isPinned: true }),
    }, ...this.inspection.pattern.map((_, i) => element('option', { value: i }, String(i))));
    return element('span', { class: 'choice' }, element('label', { for: id }, 'Sample'),
      this.samples);
  }

  /** Draws for the width that there is. */
  fit() {
    if (this.frame.clientWidth !== this.room) this.draw();
  }

  draw() {
    this.room = this.frame.clientWidth;
    const { view, attribute } = this.state;
    this.picture.draw(this.state, Math.max(this.room, kLeastRoom));
    this.legend.replaceChildren(...this.kind.legendOf(this.inspection, view, attribute));
    this.swipeRow.hidden = view !== 'compare';
    for (const input of this.views) input.checked = input.value === view;
    this.values.value = String(attribute);
    this.move();
  }

  /** What may change without another picture. */
  move() {
    const { attribute, swipe, isPinned } = this.state;
    const sample = this.current();
    this.swipe.value = String(swipe);
    this.picture.swipeTo(swipe / 100);
    this.picture.show(sample, isPinned);
    this.panel.replaceChildren(...this.kind.panelOf(this.inspection, sample, attribute, isPinned));
    this.live.textContent = this.kind.spoken(this.inspection, sample, attribute);
    if (this.samples) this.samples.value = String(sample.sample);
  }

  onKey(event) {
    const { x, y, sample, isPinned } = this.state;
    const up = this.inspection.isUp ? 1 : -1;
    const changes = {
      ArrowLeft: { x: x - 1 },
      ArrowRight: { x: x + 1 },
      ArrowUp: { y: y + up },
      ArrowDown: { y: y - up },
      Enter: { isPinned: !isPinned },
      Escape: { isPinned: false },
      s: { sample: (sample + 1) % this.inspection.pattern.length },
    };
    const change = changes[event.key];
    if (!change || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    this.set({ isPinned: true, ...change });
  }

  onPoint(event, isPick) {
    if (this.state.isPinned && !isPick) return;
    const box = this.picture.node.getBoundingClientRect();
    const [u, v] = this.picture.geometry.window(event.clientX - box.left, event.clientY - box.top);
    const sample = this.nearestSample(u, v);
    if (!sample) return;
    const isSame = sample === this.current();
    if (isSame && !isPick) return;
    const isPinned = isPick && !(isSame && this.state.isPinned);
    this.set({ x: sample.x, y: sample.y, sample: sample.sample, isPinned });
  }

  /** Of the pixel that a point of the window is in, the sample closest to it. */
  nearestSample(u, v) {
    const [x, y] = [Math.floor(u), Math.floor(v)];
    const away = this.inspection.pattern.map(([a, b]) => (x + a - u) ** 2 + (y + b - v) ** 2);
    return sampleAt(this.inspection, x, y, away.indexOf(Math.min(...away)));
  }
}
