/**
 * Steps along a path, each no longer than can be trusted: synth/analysis/motion/walk/walking.py, one joint driven.
 *
 * A step goes along rates at which loops stay closed, bent as the last step was, and is corrected by Newton's
 * method. It is halved if its end does not close, lies far from where it was expected, or goes on in another
 * direction: paths that come near each other are not confused.
 */

/** @import { Corrected, Equations } from "./newton.js" */
import { Step } from "./step.js";
import { added, alike, dot, largest, put } from "./vectors.js";

/** Steps, radians of the joint that moves most. */
const FIRST = 0.02, LARGEST = 0.2, LEAST = 1e-6;
/**
 * A corrected pose is at most this part of its step from where it was expected; the second is for a step that begins
 * at a singular pose: rates there are chosen to second order only.
 */
const STRAY = 0.25, STRAY_FIRST = 0.5;
/** Cosine of the angle between directions before and after a step, at least. */
const ALIKE = 0.6;
/** A driven joint that has less than this part of the largest rate may be about to turn back. */
const HARDLY = 0.05;
/** Steps of Newton's method after which a step of the path may be longer. */
const EASY = 5;

export class Stepping {
  #length = FIRST;
  /** Whether a step was taken. */
  begun = false;

  /**
   * @param {Equations} equations
   * @param {Drive} drive
   * @param {Float64Array | null} direction - Rates to begin with at a singular pose; null: the least ones.
   */
  constructor(equations, drive, direction) {
    this.equations = equations;
    this.driver = drive.joint;
    this.held = drive.held;
    this.rates = direction;
    this.bend = new Float64Array(equations.closure.joints);
  }

  /**
   * Go back along the path if the driven joint does not go the way it is to go; tell whether it does so.
   *
   * @param {number} way - 1 or -1.
   */
  turnTowards(way) {
    const back = this.begun && this.rates !== null && way * this.rates[this.driver] < 0;
    if (back) this.turnBack();
    return back;
  }

  /** Go back along the path. */
  turnBack() {
    this.rates = this.rates?.map((rate) => -rate) ?? null;
  }

  /**
   * Return the rates to go on with so that the driven joint moves, the largest 1 or -1; zeros if nothing moves.
   *
   * @param {Corrected} here
   * @param {number} left - How far the driven joint has to go, radians.
   */
  onwards(here, left) {
    return scaled(this.#onwards(here, left));
  }

  /**
   * Return the rates to go straight on with, the largest 1 or -1, whatever the driven joint does; zeros if nothing
   * moves.
   *
   * @param {Corrected} here
   * @param {number} way - Where it begins: in which the driven joint goes, 1 or -1.
   */
  straightOn(here, way) {
    if (this.rates === null) return scaled(here.space.leastRates(this.driver, way, this.held));
    return scaled(this.begun ? here.space.projected(this.rates, this.held) : this.rates);
  }

  /**
   * @param {Corrected} here
   * @param {number} left
   */
  #onwards(here, left) {
    const before = this.rates;
    if (before !== null && !this.begun) return before; // at a singular pose: it was chosen
    const least = here.space.leastRates(this.driver, left, this.held);
    if (before === null) return least;
    const sign = Math.sign(dot(least, before));
    const towards = least.map((rate) => sign * rate);
    const hardly = Math.abs(towards[this.driver]) <= HARDLY * largest(towards);
    return hardly || !alike(towards, before, ALIKE) ? here.space.projected(before, this.held) : towards;
  }

  /**
   * Take one step of the length that can be trusted, at most to what is left of the driven joint's way.
   *
   * @param {Corrected} here
   * @param {Float64Array} rates - The largest 1 or -1.
   * @param {number} left - Radians.
   * @returns {Step | null} Null if no closed pose is found.
   */
  taken(here, rates, left) {
    const most = reach(rates[this.driver], this.bend[this.driver], left);
    return this.#taken(here, rates, most, here.angles[this.driver] + left);
  }

  /**
   * Take one step of the length that can be trusted, and not longer than given.
   *
   * @param {Corrected} here
   * @param {Float64Array} rates - The largest 1 or -1.
   * @param {number} most - Radians of the joint that moves most.
   * @returns {Step | null} Null if no closed pose is found.
   */
  takenUpTo(here, rates, most) {
    return this.#taken(here, rates, most, null);
  }

  /**
   * @param {Corrected} here
   * @param {Float64Array} rates
   * @param {number} most - Length of a step, at most.
   * @param {number | null} goal - Angle of the driven joint after a step of that length; null: any.
   */
  #taken(here, rates, most, goal) {
    const joint = this.driver, stray = this.begun ? STRAY : STRAY_FIRST;
    while (this.#length >= LEAST) {
      const whole = this.#length >= most;
      const length = whole ? most : this.#length;
      const bent = (length * length) / 2;
      const free = here.angles.map((angle, i) => angle + length * rates[i] + bent * this.bend[i]);
      const lands = whole && goal !== null;
      const expected = lands ? put(free, joint, goal) : free;
      const held = lands ? [joint, ...this.held] : this.held;
      for (const one of this.held) expected[one] = here.angles[one];
      let end = this.equations.corrected(expected, held);
      if (end.closed && largest(added(end.angles, -1, expected)) <= stray * length) {
        const arriving = end.space.projected(rates, this.held);
        const easy = end.steps <= EASY && !whole;
        if (held.length) end = this.equations.exactlyHeld(end, held, expected);
        if (end.closed && alike(arriving, rates, ALIKE)) {
          if (easy) this.#length = Math.min(1.5 * this.#length, LARGEST);
          return new Step(this, here, end, rates, arriving);
        }
      }
      this.#length = length / 2;
    }
    this.#length = FIRST;
    return null;
  }

  /**
   * Go on from the end of a step.
   *
   * @param {Step} step
   */
  take(step) {
    this.begun = true;
    const length = largest(added(step.after.angles, -1, step.before.angles));
    if (!length) return;
    this.rates = step.arriving;
    const speed = Math.max(largest(step.arriving), LEAST);
    const bend = step.arriving.map((rate, i) => (rate / speed - step.leaving[i]) / length);
    this.bend = largest(bend) * this.#length <= STRAY ? bend : bend.map(() => 0);
  }
}

/** @typedef {{joint: number, held: number[]}} Drive - A joint that is driven while others stay, by their places. */

/** @param {Float64Array} rates */
function scaled(rates) {
  const size = largest(rates);
  return size ? rates.map((rate) => rate / size) : rates;
}

/**
 * Return after which length a joint has gone as far as it is to go; infinite if it turns back before.
 *
 * @param {number} speed
 * @param {number} bend
 * @param {number} left
 */
function reach(speed, bend, left) {
  if (left < 0) [speed, bend, left] = [-speed, -bend, -left];
  const square = speed * speed + 2 * bend * left;
  if (square <= 0 || speed + Math.sqrt(square) <= 0) return Infinity;
  return (2 * left) / (speed + Math.sqrt(square));
}
