/**
 * Newton's method for closure equations: synth/analysis/motion/closure.py.
 *
 * The equations may depend on each other and leave freedoms, so each step is the least one in the sense of least
 * squares, by normal equations with a trace of regularisation.
 */

/** @import { Closure } from "./closure.js" */
/** @import { Tolerances } from "./types.js" */
import { NormalPattern } from "./cholesky.js";
import { solvedSymmetric } from "./small.js";
import { added, largest, putAll, takeOff } from "./vectors.js";

/**
 * Part of the largest diagonal entry of the normal equations that is added to all. Rounding along freedoms is
 * multiplied by its inverse.
 */
const REGULAR = 1e-9;
const STEPS = 12;
/** Corrections after a held joint was put back. */
const HOLDS = 2;
/** A step that leaves more of the error than this is the last with its derivatives. */
const SLOW = 0.1;

/** The equations of one linkage, with what all their factors share. */
export class Equations {
  /**
   * @param {Closure} closure
   * @param {{order: number[], tolerances: Tolerances}} linkage - Where each joint goes in factors; what is zero.
   */
  constructor(closure, { order, tolerances }) {
    this.closure = closure;
    this.tolerances = tolerances;
    this.pattern = new NormalPattern(closure.joints, closure.loops, order);
  }

  /**
   * Return joint angles near given ones at which all loops close.
   *
   * @param {Float64Array} angles - Radians.
   * @param {number[]} [held] - Places of joints that stay as they are, if the others can follow.
   * @returns {Corrected}
   */
  corrected(angles, held = []) {
    let { residual, derivatives } = this.closure.at(angles);
    let best = new Corrected(this, angles, largest(residual), 0, derivatives);
    let off = residual, fresh = true;
    /** @type {TangentSpace | null} */
    let space = null;
    for (let steps = 1; steps <= STEPS; steps++) {
      if (best.error <= this.tolerances.closed / 100) break;
      space ??= best.space;
      const moved = added(best.angles, -1, space.step(off, held));
      ({ residual, derivatives } = this.closure.at(moved));
      const tried = new Corrected(this, moved, largest(residual), steps, derivatives);
      const slow = !(tried.error <= SLOW * best.error);
      if (tried.error < best.error) {
        [best, off, fresh] = [tried, residual, false];
      } else if (fresh) break;
      if (slow) {
        if (best.closed) break;
        [space, fresh] = [null, true];
      }
    }
    return best;
  }

  /**
   * Return a pose with held joints at their angles to the last digit; its error is that of the angles it has.
   *
   * @param {Corrected} pose - Found with the joints held.
   * @param {number[]} held - Their places.
   * @param {Float64Array} values - Angles of all joints; those of the held ones count. Radians.
   */
  exactlyHeld(pose, held, values) {
    for (let n = 0; n < HOLDS; n++) {
      if (held.every((joint) => pose.angles[joint] === values[joint])) return pose;
      pose = this.corrected(putAll(pose.angles, held, values), held);
    }
    const angles = putAll(pose.angles, held, values);
    const { residual, derivatives } = this.closure.at(angles);
    return new Corrected(this, angles, largest(residual), pose.steps, derivatives);
  }
}

/** Where Newton's method came to. */
export class Corrected {
  /** @type {TangentSpace | null} */
  #space = null;

  /**
   * @param {Equations} equations
   * @param {Float64Array} angles - Radians.
   * @param {number} error - By how much loops do not close, at most.
   * @param {number} steps
   * @param {Float64Array} derivatives
   */
  constructor(equations, angles, error, steps, derivatives) {
    this.equations = equations;
    this.angles = angles;
    this.error = error;
    this.steps = steps;
    this.derivatives = derivatives;
  }

  /** Whether all loops close. */
  get closed() {
    return this.error <= this.equations.tolerances.closed;
  }

  /** Rates there. */
  get space() {
    this.#space ??= new TangentSpace(this.equations, this.derivatives);
    return this.#space;
  }
}

/** Least-squares solutions with the derivatives of closure equations at one place. */
export class TangentSpace {
  /** @type {Map<number, Float64Array>} */
  #moves = new Map();

  /**
   * @param {Equations} equations
   * @param {Float64Array} derivatives
   */
  constructor({ closure, pattern, tolerances }, derivatives) {
    this.closure = closure;
    this.derivatives = derivatives;
    this.zero = tolerances.zero;
    const { solve, regular } = pattern.solver(closure.loops, derivatives, REGULAR);
    this.solve = solve;
    this.regular = regular;
  }

  /**
   * Return the least change of joint angles that makes a residual to first order: taken off, it closes loops.
   *
   * @param {Float64Array} residual
   * @param {number[]} held - Places of joints that are not to move, if they need not.
   */
  step(residual, held) {
    return this.#without(this.#leastExactly(residual), held);
  }

  /**
   * Return the rates nearest to given ones at which all loops stay closed to first order.
   *
   * @param {Float64Array} rates
   * @param {number[]} [held] - Places of joints that have none, if they need not.
   * @returns {Float64Array}
   */
  projected(rates, held = []) {
    const kept = rates.slice();
    for (let n = 0; n < 2; n++) { // the second takes off what regularisation left
      takeOff(kept, this.#least(this.closure.image(this.derivatives, kept)));
    }
    return this.#without(kept, held);
  }

  /**
   * Return the least rates at which loops part by given amounts: none of them along freedoms.
   *
   * The solution x of (A' A + m) x = A' b is A' (b - A x) / m too. Solved for, it has rounding along freedoms that
   * was divided by m; a sum of rows of A has no part along freedoms. Across them half the digits are lost.
   *
   * @param {Float64Array} off - Of each equation.
   */
  #least(off) {
    const rates = this.solve(this.closure.gathered(this.derivatives, off));
    return this.closure.gatheredRest(this.derivatives, off, rates, this.regular);
  }

  /**
   * Return the same with all digits: what two solutions differ by has the lost ones across freedoms.
   *
   * @param {Float64Array} off
   */
  #leastExactly(off) {
    const rates = this.solve(this.closure.gathered(this.derivatives, off));
    const least = this.closure.gatheredRest(this.derivatives, off, rates, this.regular);
    return takeOff(least, this.#least(this.closure.image(this.derivatives, added(least, -1, rates))));
  }

  /**
   * Return the least rates at which a joint has a wanted one and others none; zeros if it cannot.
   *
   * @param {number} joint
   * @param {number} wanted
   * @param {number[]} [held] - Places of the others.
   */
  leastRates(joint, wanted, held = []) {
    const joints = [joint, ...held];
    const rates = this.#combined(joints, this.#shares(joints, joints.map((_, n) => (n ? 0 : wanted))));
    const most = Math.max(...joints.map((one) => Math.abs(this.#move(one)[joint])));
    const missed = Math.max(...joints.map((one, n) => Math.abs(rates[one] - (n ? 0 : wanted))));
    // normal equations keep half the digits
    return missed <= Math.sqrt(this.zero) * Math.abs(wanted) && most > this.zero ? rates : rates.fill(0);
  }

  /**
   * Return what a joint's rate is made of: how much of it comes with the rate of each of others.
   *
   * @param {number} joint
   * @param {number[]} others - Places of independent joints that say how all move.
   */
  madeOf(joint, others) {
    return this.#shares(others, others.map((one) => this.#move(one)[joint]));
  }

  /**
   * Return rates less those that held joints have in them.
   *
   * @param {Float64Array} rates
   * @param {number[]} held
   * @returns {Float64Array}
   */
  #without(rates, held) {
    if (!held.length) return rates;
    return added(rates, -1, this.#combined(held, this.#shares(held, held.map((joint) => rates[joint]))));
  }

  /**
   * Return the shares of the moves of joints with which these have given rates.
   *
   * @param {number[]} joints
   * @param {number[]} given
   * @returns {number[]}
   */
  #shares(joints, given) {
    const moves = joints.map((one) => joints.map((other) => this.#move(other)[one]));
    return solvedSymmetric(moves, given, this.zero);
  }

  /**
   * @param {number[]} joints
   * @param {number[]} shares
   */
  #combined(joints, shares) {
    let sum = new Float64Array(this.closure.joints);
    joints.forEach((joint, n) => { sum = added(sum, shares[n], this.#move(joint)); });
    return sum;
  }

  /**
   * @param {number} joint
   * @returns {Float64Array}
   */
  #move(joint) {
    let move = this.#moves.get(joint);
    if (move === undefined) {
      const unit = new Float64Array(this.closure.joints);
      unit[joint] = 1;
      move = this.projected(unit);
      this.#moves.set(joint, move);
    }
    return move;
  }
}
