/** A mechanism that is moved: the solver with its data, which joint is driven, on which way, and where all is. */

/** @import { MovingData, ShownData } from "./types.js" */
import { Motion } from "../solver/motion.js";
import { linkMotions, vertexPlaces } from "../solver/placement.js";

const DEGREES = 180 / Math.PI;
/** Milliseconds between two pictures on a long way. */
const PATIENCE = 80;

/** What is said where a path ends. */
const TOLD = {
  "": "",
  still: "cannot move here",
  "turns back": "turns back here",
  limit: "stops: panels lie on each other",
  lost: "stops: no closed pose is found beyond",
  late: "is on its way",
};

export class Mechanism {
  /**
   * @param {ShownData} shown
   * @param {MovingData} moving
   */
  constructor(shown, moving) {
    this.data = moving;
    this.stiff = new Set(shown.stiff.map((id) => moving.joints.indexOf(id)).filter((place) => place >= 0));
    this.clusterOf = new Map(shown.clusters.flatMap((ids, n) => ids.map((id) => [moving.links.indexOf(id), n])));
    this.way = moving.ways?.taken ?? -1;
    this.driver = moving.ways ? moving.ways.all[this.way].driver : -1;
    this.motion = new Motion(moving.solver, this.#direction());
    this.stopped = "";
    /** @type {number | null} - Degrees that the driven joint is on its way to. */
    this.goal = null;
    this.places = new Float64Array(3 * moving.bodies.vertices.length);
    this.#place();
  }

  /** Whether anything moves. */
  get moves() {
    return this.way >= 0;
  }

  /** Degrees of the driven joint. */
  get value() {
    return this.angleOf(this.driver);
  }

  /** Degrees between which the driven joint may be asked to be. */
  get range() {
    return this.data.solver.limited ? [-180, 180] : [-360, 360];
  }

  /** By how much loops do not close, at most. */
  get error() {
    return this.motion.pose.error;
  }

  /**
   * Return the angle of a joint, degrees.
   *
   * @param {number} joint
   */
  angleOf(joint) {
    return this.motion.pose.angles[joint] * DEGREES;
  }

  /**
   * Tell whether a joint can be driven on the way that was chosen.
   *
   * @param {number} joint
   */
  canDrive(joint) {
    const way = this.data.ways?.all[this.way];
    return way !== undefined && joint >= 0 && !way.still.includes(joint);
  }

  /**
   * Drive another joint.
   *
   * @param {number} joint
   */
  drive(joint) {
    if (!this.canDrive(joint)) return;
    this.driver = joint;
    this.stopped = "";
    this.goal = null;
  }

  /**
   * Bring the driven joint to an angle, or as near as the path leads; tell whether it came there.
   *
   * @param {number} degrees
   */
  to(degrees) {
    if (!this.moves) return false;
    const [least, most] = this.range;
    const goal = Math.min(most, Math.max(least, degrees));
    const end = performance.now() + PATIENCE;
    const stopped = this.motion.to(this.driver, goal / DEGREES, () => performance.now() > end);
    this.goal = stopped === "late" ? goal : null;
    this.stopped = TOLD[stopped];
    this.#place();
    return this.stopped === "";
  }

  /** Go back to the pose of the file. */
  reset() {
    this.motion.reset(this.#direction());
    this.stopped = "";
    this.goal = null;
    this.#place();
  }

  /**
   * Take another way from the pose of the file.
   *
   * @param {number} way
   */
  take(way) {
    if (!this.data.ways) return;
    this.way = way;
    this.driver = this.data.ways.all[way].driver;
    this.reset();
  }

  /**
   * Return where vertices would be if the driven joint turned a little, the others going with it.
   *
   * @param {number} turn - Radians.
   */
  placesBeside(turn) {
    const { pose, start } = this.motion;
    const ways = this.data.ways;
    const chosen = ways?.singular && pose === start ? ways.all[this.way].rates : null;
    const rates = chosen ?? pose.space.leastRates(this.driver, 1);
    const factor = rates[this.driver] ? turn / rates[this.driver] : 0;
    const angles = pose.angles.map((angle, joint) => angle + factor * rates[joint]);
    return this.#placesAt(angles);
  }

  /** @param {Float64Array} angles */
  #placesAt(angles, places = new Float64Array(this.places.length)) {
    const { solver, bodies } = this.data;
    return vertexPlaces(linkMotions(solver, angles), bodies.vertices, bodies.owners, places);
  }

  #place() {
    this.#placesAt(this.motion.pose.angles, this.places);
  }

  #direction() {
    const ways = this.data.ways;
    return ways?.singular ? Float64Array.from(ways.all[this.way].rates) : null;
  }
}
