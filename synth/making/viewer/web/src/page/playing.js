/** Play: the mechanism goes on along its path by itself, past turning points, and back where the path ends. */

/** @import { Mechanism } from "./mechanism.js" */

/** Seconds that count, at most, between two pictures: a page in the background does not jump. */
const LONGEST = 0.1;
/** Degrees that are no motion. */
const UNMOVED = 1e-9;

export class Playing {
  #way = 1;
  #last = 0;
  #request = 0;
  /** Whether it has turned and not moved since. */
  #turned = false;

  /**
   * @param {{mechanism: () => Mechanism | null, speed: () => number, changed: () => void, ended: () => void}} page
   */
  constructor(page) {
    this.page = page;
  }

  get on() {
    return this.#request !== 0;
  }

  toggle() {
    if (this.on) this.stop();
    else this.#begin();
  }

  stop() {
    cancelAnimationFrame(this.#request);
    this.#request = 0;
    this.page.ended();
  }

  #begin() {
    const mechanism = this.page.mechanism();
    if (!mechanism?.moves) return;
    this.#way = mechanism.motion.pose === mechanism.motion.start ? this.#first(mechanism) : this.#way;
    this.#turned = false;
    this.#last = performance.now();
    this.#request = requestAnimationFrame((now) => this.#frame(now));
  }

  /**
   * Return which way the driven joint begins on the way that was chosen.
   *
   * @param {Mechanism} mechanism
   */
  #first({ data, way, driver }) {
    const rate = data.ways?.all[way].rates[driver] ?? 1;
    return rate < 0 ? -1 : 1;
  }

  /** @param {number} now */
  #frame(now) {
    const mechanism = this.page.mechanism();
    if (!mechanism) return this.stop();
    const seconds = Math.min(LONGEST, Math.max(0, (now - this.#last) / 1000));
    this.#last = now;
    const before = mechanism.travelled;
    const reached = mechanism.along(before + this.#way * this.page.speed() * seconds);
    const moved = Math.abs(mechanism.travelled - before) > UNMOVED;
    if ((!reached || !moved) && mechanism.goal === null && seconds > 0) {
      if (this.#turned && !moved) return this.stop();
      this.#way = -this.#way;
      this.#turned = true;
    } else if (moved) this.#turned = false;
    this.page.changed();
    this.#request = requestAnimationFrame((later) => this.#frame(later));
  }
}
