/**
 * A linkage driven by one joint at a time, from where it is: synth/folding/following/leg.py without what the page
 * does not need. A path ends where the driven joint turns back; ranks are not watched.
 *
 * The pose of the file may be singular, as a flat sheet is. Then it is left at the rates of a branch, and come back
 * to exactly: next to it Newton's method only halves its error.
 */

/** @import { LinkageData } from "./types.js" */
/** @import { Step } from "./step.js" */
import { Closure } from "./closure.js";
import { Corrected, Equations } from "./newton.js";
import { Stepping } from "./stepping.js";
import { added, largest } from "./vectors.js";

/** Rates below this part of the largest are none. */
const STILL = 1e-7;
const ROUNDED = 1e-9;
/** Angles this near to 180 degrees, radians, are that if loops close with them; the second is for steps beyond it. */
const FLAT = 1e-4, FLAT_BEYOND = 0.02;
const MOST_STEPS = 2000;
/** This near to a singular start, in radians of the driven joint, the linkage is put there. */
const AT_START = 2e-3;

/**
 * How a path ended.
 *
 * @typedef {"" | "still" | "turns back" | "limit" | "lost" | "late"} Stopped
 * Nothing: it reached its goal. The driven joint cannot move; turns back; panels lie on each other; no closed pose is
 * found beyond; it took too long, and can go on from where it is.
 */

export class Motion {
  /** @type {Stepping | null} */
  #stepping = null;

  /**
   * @param {LinkageData} linkage
   * @param {Float64Array | null} direction - Rates to begin with where the pose is singular; null where it is not.
   */
  constructor(linkage, direction) {
    this.linkage = linkage;
    this.equations = new Equations(new Closure(linkage), linkage.order);
    this.start = this.equations.corrected(Float64Array.from(linkage.angles));
    this.pose = this.start;
    this.direction = direction;
  }

  /** Go back to the pose of the file; take another branch there, if one is given. */
  reset(direction = this.direction) {
    this.direction = direction;
    this.#put(this.start);
  }

  /**
   * Go on until a joint has an angle, or to where that ends.
   *
   * @param {number} joint - Its place.
   * @param {number} value - Radians.
   * @param {() => boolean} [late] - Asked after each step whether it is to end where it is.
   * @returns {Stopped}
   */
  to(joint, value, late = () => false) {
    if (this.direction === null || this.pose === this.start) return this.#along(joint, value, late);
    const zero = this.start.angles[joint];
    const side = Math.sign(this.pose.angles[joint] - zero);
    if (side === 0 || side * (value - zero) > AT_START) return this.#along(joint, value, late);
    const stopped = this.#along(joint, zero + side * AT_START, late);
    if (stopped) return stopped;
    this.#put(this.start);
    return this.#along(joint, Math.abs(value - zero) <= AT_START ? zero : value, late);
  }

  /** @param {Corrected} pose */
  #put(pose) {
    this.pose = pose;
    this.#stepping = null;
  }

  /**
   * @param {number} joint
   * @param {number} value
   * @param {() => boolean} late
   * @returns {Stopped}
   */
  #along(joint, value, late) {
    const way = Math.sign(value - this.pose.angles[joint]);
    if (!way) return "";
    const stepping = this.#towards(joint, way);
    for (let n = 0; n < MOST_STEPS; n++) {
      const stopped = this.#onwards(stepping, way, value);
      if (stopped) return stopped;
      if (this.pose.angles[joint] === value) return "";
      if (late()) return "late";
    }
    return "lost";
  }

  /**
   * Return the steps of a driven joint: those before it, if it was driven before.
   *
   * @param {number} joint
   * @param {number} way
   * @returns {Stepping}
   */
  #towards(joint, way) {
    if (this.#stepping?.driver !== joint) {
      const branch = this.pose === this.start ? this.direction : null;
      const rates = branch && branch[joint] * way < 0 ? branch.map((rate) => -rate) : branch;
      this.#stepping = new Stepping(this.equations, joint, rates);
    } else if (this.pose === this.start && this.direction !== null) {
      this.#put(this.start);
      return this.#towards(joint, way);
    }
    this.#stepping.turnTowards(way);
    return this.#stepping;
  }

  /**
   * Take one step.
   *
   * @param {Stepping} stepping
   * @param {number} way
   * @param {number} value
   * @returns {Stopped}
   */
  #onwards(stepping, way, value) {
    const left = value - this.pose.angles[stepping.driver];
    const rates = stepping.onwards(this.pose, left);
    const speed = way * rates[stepping.driver];
    if (Math.abs(speed) <= STILL) return "still";
    if (speed < 0) return "turns back";
    const step = stepping.taken(this.pose, rates, left);
    return step === null ? "lost" : this.#taken(stepping, step, way, value);
  }

  /**
   * Go to the end of a step, or to the goal or the limit within it.
   *
   * @param {Stepping} stepping
   * @param {Step} step
   * @param {number} way
   * @param {number} value
   * @returns {Stopped}
   */
  #taken(stepping, step, way, value) {
    /** @type {Stopped} */
    let stopped = "";
    const joint = stepping.driver;
    step = this.#flattened(step);
    if (this.#beyond(step.after.angles)) {
      step = step.upTo(step.last((angles) => !this.#beyond(angles)));
      stopped = "limit";
    }
    if (way * (value - step.after.angles[joint]) < 0) {
      const landed = step.landing(joint, value);
      if (landed === null) return "lost";
      step = step.upTo(landed);
      stopped = "";
    }
    if (way * step.arriving[joint] < 0 && way * (value - step.after.angles[joint]) !== 0) {
      step = step.upTo(step.turning(joint, way));
      stopped = "turns back";
    }
    stepping.take(step);
    this.pose = step.after;
    return stopped;
  }

  /**
   * Return the step, its end made exact where panels lie flat on each other: loops tell angles there to the root of
   * their error only.
   *
   * @param {Step} step
   */
  #flattened(step) {
    if (!this.linkage.limited) return step;
    const near = this.#beyond(step.after.angles) ? FLAT_BEYOND : FLAT;
    let folded = false;
    const flat = step.after.angles.map((angle) => {
      const halves = Math.round(angle / Math.PI);
      if (Math.abs(angle - halves * Math.PI) > near) return angle;
      folded ||= halves !== 0;
      return halves * Math.PI;
    });
    if (!folded) return step;
    const exact = this.equations.corrected(flat);
    return exact.closed && exact.steps === 0 ? step.upTo(exact) : step;
  }

  /** @param {Float64Array} angles */
  #beyond(angles) {
    return this.linkage.limited && largest(angles) > Math.PI + ROUNDED;
  }

  /** How far the linkage has moved from the pose of the file: radians of the joint that moved most. */
  get moved() {
    return largest(added(this.pose.angles, -1, this.start.angles));
  }
}
