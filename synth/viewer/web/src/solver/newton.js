/**
 * Newton's method for closure equations: synth/folding/newton.py, with at most one joint held.
 *
 * The equations may depend on each other and leave freedoms, so each step is the least one in the sense of least
 * squares, by normal equations with a trace of regularisation.
 */

/** @import { Closure } from "./closure.js" */
import { NormalPattern } from "./cholesky.js";
import { added, largest, put } from "./vectors.js";

/** Loops that close to this, radians and units of the extent, are closed. */
export const CLOSED = 1e-12;
/** Part of the largest diagonal entry of the normal equations that is added to all. */
const REGULAR = 1e-9;
const STEPS = 12;
/** Corrections after a held joint was put back. */
const HOLDS = 2;
/** A step that leaves more of the error than this is the last with its derivatives. */
const SLOW = 0.1;
/** Squares of lengths of projected unit vectors below this are of joints that cannot move. */
const STILL = 1e-9;
const MISSED = 1e-4;

/** The equations of one linkage, with what all their factors share. */
export class Equations {
  /**
   * @param {Closure} closure
   * @param {number[]} order - Where each joint goes in factors.
   */
  constructor(closure, order) {
    this.closure = closure;
    this.pattern = new NormalPattern(closure.joints, closure.loops, order);
  }

  /**
   * Return joint angles near given ones at which all loops close.
   *
   * @param {Float64Array} angles - Radians.
   * @param {number} [held] - Place of a joint that stays as it is, if the others can follow.
   * @returns {Corrected}
   */
  corrected(angles, held = -1) {
    let { residual, derivatives } = this.closure.at(angles);
    let best = new Corrected(this, angles, largest(residual), 0, derivatives);
    let off = residual, fresh = true;
    /** @type {TangentSpace | null} */
    let space = null;
    for (let steps = 1; steps <= STEPS; steps++) {
      if (best.error <= CLOSED / 100) break;
      space ??= best.space;
      const moved = added(best.angles, 1, space.step(off, held));
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
   * Return a pose with a held joint at its angle to the last digit; its error is that of the angles it has.
   *
   * @param {Corrected} pose - Found with the joint held.
   * @param {number} held
   * @param {number} value - Radians.
   */
  exactlyHeld(pose, held, value) {
    for (let n = 0; n < HOLDS; n++) {
      if (pose.angles[held] === value) return pose;
      pose = this.corrected(put(pose.angles, held, value), held);
    }
    const angles = put(pose.angles, held, value);
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
    return this.error <= CLOSED;
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
  constructor({ closure, pattern }, derivatives) {
    this.closure = closure;
    this.derivatives = derivatives;
    this.solve = pattern.solver(closure.loops, derivatives, REGULAR);
  }

  /**
   * Return the least change of joint angles that takes a residual away to first order.
   *
   * @param {Float64Array} residual
   * @param {number} held - Place of a joint that is not to move, if it need not; -1: none.
   */
  step(residual, held) {
    const change = this.solve(this.closure.gathered(this.derivatives, residual)).map((x) => -x);
    if (held < 0) return change;
    const move = this.#move(held);
    return move[held] === 0 ? change : added(change, -change[held] / move[held], move);
  }

  /**
   * Return the rates nearest to given ones at which all loops stay closed to first order.
   *
   * @param {Float64Array} rates
   */
  projected(rates) {
    let kept = rates;
    for (let n = 0; n < 2; n++) { // the second takes off what regularisation left
      const image = this.closure.image(this.derivatives, kept);
      kept = added(kept, -1, this.solve(this.closure.gathered(this.derivatives, image)));
    }
    return kept;
  }

  /**
   * Return the least rates at which a joint has a wanted one; zeros if it cannot.
   *
   * @param {number} joint
   * @param {number} wanted
   */
  leastRates(joint, wanted) {
    const move = this.#move(joint);
    const share = move[joint] === 0 ? 0 : wanted / move[joint];
    const possible = Math.abs(share * move[joint] - wanted) <= MISSED * Math.abs(wanted) && move[joint] > STILL;
    return move.map((rate) => (possible ? share * rate : 0));
  }

  /** @param {number} joint */
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
