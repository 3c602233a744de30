// The instant that the whole page shows, and playing through the run.

export class Timeline {
  /** @param t instants of the run, increasing */
  constructor(t) {
    this.start = t.length > 0 ? t[0] : 0;
    this.end = t.length > 0 ? t[t.length - 1] : 0;
    this.now = this.start;
    this.playing = false;
    // A run plays in about 40 s whatever its length.
    this.speed = Math.max(1, this.span / 40);
    this.listeners = [];
  }

  get span() { return this.end - this.start; }

  onChange(listener) { this.listeners.push(listener); }

  set(instant) {
    this.now = Math.min(this.end, Math.max(this.start, instant));
    this.notify();
  }

  notify() { for (const listener of this.listeners) listener(this.now); }

  toggle() { if (this.playing) this.pause(); else this.play(); }

  pause() {
    this.playing = false;
    this.notify();
  }

  play() {
    this.playing = true;
    if (this.now >= this.end) this.now = this.start;
    let before = performance.now();
    const step = (clock) => {
      if (!this.playing) return;
      const next = this.now + Math.max(0, clock - before) / 1000 * this.speed;
      before = clock;
      if (next >= this.end) this.playing = false;
      this.set(next);
      if (this.playing) requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
    this.notify();
  }
}
