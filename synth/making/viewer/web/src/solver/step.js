/**
 * One step of a path, and the poses on it: synth/analysis/motion/walk/step.py.
 *
 * A cubic through both ends with the rates of both keeps to the path to the fourth power of the step.
 */

/** @import { Corrected, Equations } from "./newton.js" */
import { added, dot, largest, put } from "./vectors.js";

/** Parts of a step that are told apart; of turning points, that are seen. */
const NEAR = 1e-9, SEEN = 1e-3;
const HALVINGS = 40;
/** Part of a step before its end: where that is singular, rates there are more than the path's. */
const SHORT_OF_END = 0.999;

export class Step {
  /**
   * @param {{equations: Equations, held: number[]}} path - Its equations, and places of joints that stay on it.
   * @param {Corrected} before
   * @param {Corrected} after
   * @param {Float64Array} leaving - Rates along the path where it begins.
   * @param {Float64Array} arriving - Where it ends.
   */
  constructor(path, before, after, leaving, arriving) {
    this.path = path;
    this.before = before;
    this.after = after;
    this.leaving = leaving;
    this.arriving = arriving;
  }

  /**
   * Return joint angles at a part of the step, 0 to 1, to fourth order.
   *
   * @param {number} part
   */
  expected(part) {
    const chord = added(this.after.angles, -1, this.before.angles);
    const size = Math.sqrt(dot(chord, chord));
    const out = size / Math.sqrt(dot(this.leaving, this.leaving));
    const back = size / Math.sqrt(dot(this.arriving, this.arriving));
    const rest = 1 - part;
    return chord.map((along, i) => {
      const bulge = rest * (this.leaving[i] * out - along) - part * (this.arriving[i] * back - along);
      return this.before.angles[i] + part * along + part * rest * bulge;
    });
  }

  /**
   * Return the pose at a part of the step.
   *
   * @param {number} part
   */
  #at(part) {
    return this.path.equations.corrected(this.expected(part), this.path.held);
  }

  /**
   * Return the step as far as a closed pose on it.
   *
   * @param {Corrected} end
   */
  upTo(end) {
    return new Step(this.path, this.before, end, this.leaving, end.space.projected(this.leaving, this.path.held));
  }

  /**
   * Return the pose within the step at which a joint has an angle between those it has at the ends.
   *
   * @param {number} joint
   * @param {number} value - Radians.
   * @returns {Corrected | null} Null if there is no closed one.
   */
  landing(joint, value) {
    const { equations } = this.path, all = [joint, ...this.path.held];
    let low = 0, high = 1;
    let [lowest, highest] = [this.before.angles[joint], this.after.angles[joint]];
    const length = largest(added(this.after.angles, -1, this.before.angles));
    for (let n = 0; n < HALVINGS; n++) {
      const guess = low + ((high - low) * (value - lowest)) / (highest - lowest);
      const expected = put(this.expected(guess), joint, value);
      const held = equations.exactlyHeld(equations.corrected(expected, all), all, expected);
      const stray = largest(added(held.angles, -1, expected));
      if (held.closed && stray <= length * (high - low)) return held;
      const part = (low + high) / 2;
      const middle = this.#at(part).angles[joint];
      if ((middle - value) * (lowest - value) > 0) [low, lowest] = [part, middle];
      else [high, highest] = [part, middle];
    }
    return null;
  }

  /**
   * Return the last closed pose of the step whose angles are as they should, the first one being so.
   *
   * @param {(angles: Float64Array) => boolean} holds
   */
  last(holds) {
    let low = 0, high = 1, kept = this.before;
    while (high - low > NEAR) {
      const middle = (low + high) / 2;
      const between = this.#at(middle);
      if (between.closed && holds(between.angles)) [low, kept] = [middle, between];
      else high = middle;
    }
    return kept;
  }

  /**
   * Tell whether a joint turns back on the step, not only among the rates of a singular end.
   *
   * @param {number} joint
   * @param {number} way - In which it went: 1 or -1.
   */
  turns(joint, way) {
    return way * this.arriving[joint] < 0 && way * this.#speed(this.#at(SHORT_OF_END), joint) < 0;
  }

  /**
   * Return the rate of a joint at a pose of the step.
   *
   * @param {Corrected} place
   * @param {number} joint
   */
  #speed(place, joint) {
    return place.space.projected(this.leaving, this.path.held)[joint];
  }

  /**
   * Return a pose just before a joint turns back, which it does on this step.
   *
   * @param {number} joint
   * @param {number} way - In which it went: 1 or -1.
   */
  turning(joint, way) {
    let low = 0, high = 1, kept = this.before;
    while (high - low > SEEN) {
      const middle = (low + high) / 2;
      const between = this.#at(middle);
      if (between.closed && way * this.#speed(between, joint) > 0) [low, kept] = [middle, between];
      else high = middle;
    }
    return kept;
  }
}
