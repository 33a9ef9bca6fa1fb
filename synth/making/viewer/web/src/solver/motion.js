/**
 * A linkage moved from where it is: synth/analysis/motion/walk/walking.py and events.py without what the page does not need.
 *
 * One joint is driven at a time, while others may be held: so each freedom has a joint of its own. Either the driven
 * joint goes to an angle, and the path ends where it turns back; or the path goes straight on, past such points.
 * Ranks are not watched.
 *
 * The pose of the file may be singular, as a flat sheet is. Then it is left at the rates of a branch, nothing held
 * until it is a little off, and come back to exactly: next to it Newton's method only halves its error.
 */

/** @import { LinkageData } from "./types.js" */
/** @import { Drive } from "./stepping.js" */
/** @import { Step } from "./step.js" */
import { Closure } from "./closure.js";
import { Equations } from "./newton.js";
import { Stepping } from "./stepping.js";
import { added, alike, dot, largest } from "./vectors.js";

/** Angles this near to 180 degrees, radians, are that if loops close with them; the second is for steps beyond it. */
const FLAT = 1e-4, FLAT_BEYOND = 0.02;
const MOST_STEPS = 2000;
/** This near to a singular start, in radians of the joint that moves most, the linkage is put there. */
const AT_START = 2e-3;
/** Where the driven joint comes near to its first angle all others have to be this near to theirs, radians. */
const AROUND_START = 10 * AT_START;
/** Of the rate of the joint that moves most, that of a slow one counts as this part at least. */
const SLOW = 0.05;
/** This near to a singular start, radians, joints are not held: rates that hold them may be none of the branch. */
const LEAVING = 0.05;
/** Farther from a singular start than this, or with a lesser cosine, the path does not lead there yet. */
const AHEAD = 0.5, STRAIGHT = 0.98;

const never = () => false;

/**
 * How a path ended.
 *
 * @typedef {"" | "immobile" | "turns back" | "limit" | "lost" | "late"} Stopped
 * Nothing: it reached its goal. The driven joint cannot move; turns back; panels lie on each other; no closed pose is
 * found beyond; it took too long, and can go on from where it is.
 */

export class Motion {
  /** @type {Stepping | null} */
  #stepping = null;
  /** Whether rates of steps point forwards on the path, 1, or back, -1: the driven joint first grows forwards. */
  #sense = 1;
  /** How far it is along the path from where that began, radians of the joint that moves most. */
  travelled = 0;

  /**
   * @param {LinkageData} linkage
   * @param {Float64Array | null} direction - Rates to begin with where the pose is singular; null where it is not.
   */
  constructor(linkage, direction) {
    this.linkage = linkage;
    this.equations = new Equations(new Closure(linkage), linkage);
    this.start = this.equations.corrected(Float64Array.from(linkage.angles));
    this.pose = this.start;
    this.direction = direction;
  }

  /** Go back to the pose of the file; take another branch there, if one is given. */
  reset(direction = this.direction) {
    this.direction = direction;
    this.#putAtStart();
  }

  /**
   * Go on until a joint has an angle, or to where that ends.
   *
   * @param {Drive} drive
   * @param {number} value - Radians.
   * @param {() => boolean} [late] - Asked after each step whether it is to end where it is.
   * @returns {Stopped}
   */
  to(drive, value, late = never) {
    const zero = this.start.angles[drive.joint];
    const off = this.pose.angles[drive.joint] - zero;
    const side = Math.sign(off);
    const near = this.#nearStart(drive.joint);
    const outwards = side === 0 || side * (value - zero) > near;
    if (this.direction === null || this.pose === this.start || outwards) return this.#to(drive, value, late);
    const stopped = side * off > near ? this.#to(drive, zero + side * near, late) : "";
    if (stopped) return stopped;
    if (this.moved > AROUND_START) return this.#to(drive, value, late);
    this.#putAtStart();
    return this.#to(drive, Math.abs(value - zero) <= near ? zero : value, late);
  }

  /**
   * Go straight on along the path on which a joint is driven, past points where it turns back.
   *
   * @param {Drive} drive
   * @param {number} length - Radians of the joint that moves most; back if negative.
   * @param {() => boolean} [late]
   * @returns {Stopped}
   */
  along(drive, length, late = never) {
    this.#face(drive, Math.sign(length));
    const { immobile } = this.linkage.tolerances;
    let left = Math.abs(length);
    for (let n = 0; n < MOST_STEPS && left > immobile; n++) {
      const before = this.pose;
      const stopped = this.#straightOn(drive, left);
      left -= largest(added(this.pose.angles, -1, before.angles));
      if (stopped) return stopped;
      if (late()) return left > immobile ? "late" : "";
    }
    return left > immobile ? "lost" : "";
  }

  /** How far the linkage has moved from the pose of the file: radians of the joint that moved most. */
  get moved() {
    return largest(added(this.pose.angles, -1, this.start.angles));
  }

  #putAtStart() {
    this.pose = this.start;
    this.#stepping = null;
    this.travelled = 0;
  }

  /**
   * Return how near to its first angle a joint is where the linkage is put at its singular start, radians.
   *
   * @param {number} joint
   */
  #nearStart(joint) {
    const rates = this.direction;
    return rates === null ? 0 : AT_START * Math.max(SLOW, Math.abs(rates[joint]) / largest(rates));
  }

  /**
   * @param {Drive} drive
   * @param {number} value
   * @param {() => boolean} late
   * @returns {Stopped}
   */
  #to(drive, value, late) {
    const way = Math.sign(value - this.pose.angles[drive.joint]);
    if (!way) return "";
    if (!this.#stepping?.begun) this.#stepping = null;
    if (this.#steps(drive, way).turnTowards(way)) this.#sense = -this.#sense;
    for (let n = 0; n < MOST_STEPS; n++) {
      const stopped = this.#onwards(this.#steps(drive, way), way, value);
      if (stopped) return stopped;
      if (this.pose.angles[drive.joint] === value) return "";
      if (late()) return "late";
    }
    return "lost";
  }

  /**
   * Return the steps of a driven joint: those before it, if it was driven before.
   *
   * @param {Drive} drive
   * @param {number} way - In which it goes if they are new: 1 or -1.
   * @param {number} sense - Which way along the path that is.
   * @returns {Stepping}
   */
  #steps({ joint, held }, way, sense = way) {
    const free = this.direction !== null && this.moved < LEAVING;
    const kept = free ? [] : held;
    const old = this.#stepping;
    const same = old?.driver === joint && `${old.held}` === `${kept}`;
    if (old && same) return old;
    const branch = this.pose === this.start ? this.direction : null;
    const rates = branch && branch[joint] * way < 0 ? branch.map((rate) => -rate) : branch;
    this.#stepping = new Stepping(this.equations, { joint, held: kept }, rates);
    this.#sense = sense;
    return this.#stepping;
  }

  /**
   * Turn forwards or back on the path.
   *
   * @param {Drive} drive
   * @param {number} way - 1 or -1.
   */
  #face(drive, way) {
    const stepping = this.#steps(drive, way);
    if (this.#sense === way) return;
    stepping.turnBack();
    this.#sense = way;
  }

  /**
   * Take one step straight on, or one through a singular start.
   *
   * @param {Drive} drive
   * @param {number} most - Its length at most, radians of the joint that moves most.
   * @returns {Stopped}
   */
  #straightOn(drive, most) {
    const way = Math.sign(this.#stepping?.rates?.[drive.joint] ?? 0) || this.#sense; // it may have turned back
    const stepping = this.#steps(drive, way, this.#sense);
    const rates = stepping.straightOn(this.pose, way);
    if (largest(rates) === 0) return "immobile";
    const ahead = this.#startAhead(rates);
    if (ahead <= 1.5 * AT_START) {
      this.#throughStart(drive, rates);
      return "";
    }
    const step = stepping.takenUpTo(this.pose, rates, Math.min(most, ahead - AT_START));
    return step === null ? "lost" : this.#ended(stepping, ...this.#withinLimits(step));
  }

  /**
   * Return how far ahead a singular start is, radians of the joint that moves most; infinite if the path does not
   * lead there.
   *
   * @param {Float64Array} rates
   */
  #startAhead(rates) {
    if (this.direction === null || this.pose === this.start) return Infinity;
    const gap = added(this.start.angles, -1, this.pose.angles);
    const size = largest(gap);
    return size < AHEAD && alike(gap, rates, STRAIGHT) ? size : Infinity;
  }

  /**
   * Put the linkage at its singular start, to go on from there as it came.
   *
   * @param {Drive} drive
   * @param {Float64Array} rates - With which it came.
   */
  #throughStart({ joint }, rates) {
    this.pose = this.start;
    const branch = /** @type {Float64Array} */ (this.direction);
    const onwards = dot(branch, rates) < 0 ? branch.map((rate) => -rate) : branch;
    this.#stepping = new Stepping(this.equations, { joint, held: [] }, onwards);
  }

  /**
   * Take one step towards an angle of the driven joint.
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
    if (Math.abs(speed) <= this.linkage.tolerances.zero_rate) return "immobile";
    if (speed < 0) return "turns back";
    const step = stepping.taken(this.pose, rates, left);
    return step === null ? "lost" : this.#landed(stepping, step, way, value);
  }

  /**
   * Go to the end of a step, or to the goal or the limit within it.
   *
   * @param {Stepping} stepping
   * @param {Step} whole
   * @param {number} way
   * @param {number} value
   * @returns {Stopped}
   */
  #landed(stepping, whole, way, value) {
    const joint = stepping.driver;
    let [step, stopped] = this.#withinLimits(whole);
    const ahead = () => way * (value - step.after.angles[joint]);
    if (ahead() > 0 && step.turns(joint, way)) {
      step = step.upTo(step.turning(joint, way));
      stopped = "turns back";
    }
    if (ahead() < 0) { // also where it passed its goal before it turned back
      const landed = step.landing(joint, value);
      if (landed === null) return "lost";
      step = step.upTo(landed);
      stopped = "";
    }
    return this.#ended(stepping, step, stopped);
  }

  /**
   * Return a step as far as panels lie on each other, and why it ends there.
   *
   * @param {Step} whole
   * @returns {[Step, Stopped]}
   */
  #withinLimits(whole) {
    const step = this.#flattened(whole);
    if (!this.#beyond(step.after.angles)) return [step, ""];
    const ended = this.#flattened(step.upTo(step.last((angles) => !this.#beyond(angles))));
    const stays = largest(added(ended.after.angles, -1, ended.before.angles)) <= FLAT; // but for what loops tell of it
    return [stays ? whole.upTo(whole.before) : ended, "limit"];
  }

  /**
   * @param {Stepping} stepping
   * @param {Step} step
   * @param {Stopped} stopped
   */
  #ended(stepping, step, stopped) {
    stepping.take(step);
    this.pose = step.after;
    this.travelled += this.#sense * largest(added(step.after.angles, -1, step.before.angles));
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
    return this.linkage.limited && largest(angles) > Math.PI + this.linkage.tolerances.immobile;
  }
}
