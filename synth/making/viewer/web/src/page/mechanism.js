/** A mechanism that is moved: the solver with its data, which joints are driven, on which way, and where all is. */

/** @import { MovingData, ShownData } from "./types.js" */
/** @import { Stopped } from "../solver/motion.js" */
import { Motion } from "../solver/motion.js";
import { linkMotions, vertexPlaces } from "../solver/placement.js";
import { Crossing } from "./crossing.js";

const DEGREES = 180 / Math.PI;
/** Milliseconds between two pictures on a long way. */
const PATIENCE = 80;
/** Radians beside a singular pose where it is looked at how joints go together. */
const BESIDE_START = 0.05;

/** Degrees along the path between poses whose size counts, and those up to which it is followed each way. */
const SIZED_EVERY = 10, SIZED_UP_TO = 360;
/** Steps of the solver each way to find sizes, at most, times joints. */
const SIZING = 10_000;

/**
 * Where it is on its way to.
 *
 * @typedef {object} Goal
 * @property {number} driver - The driven joint.
 * @property {number[]} held - Joints that stay.
 * @property {number} degrees - Of the driven joint, or along the path.
 * @property {boolean} along - Whether along the path.
 */

export class Mechanism {
  /** @type {Crossing | null} */
  #crossing = null;

  /**
   * @param {ShownData} shown
   * @param {MovingData} moving
   */
  constructor(shown, moving) {
    this.data = moving;
    this.immobile = new Set(shown.immobile.map((id) => moving.joints.indexOf(id)).filter((place) => place >= 0));
    this.clusterOf = new Map(shown.clusters.flatMap((ids, n) => ids.map((id) => [moving.links.indexOf(id), n])));
    this.way = moving.ways?.taken ?? -1;
    /** @type {number[]} - Places of independent joints, one for each freedom. */
    this.drivers = [...(moving.ways?.all[this.way].drivers ?? [])];
    this.driver = this.drivers[0] ?? -1;
    this.motion = new Motion(moving.solver, this.#direction());
    this.stopped = "";
    /** @type {Goal | null} */
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

  /** Degrees between which joints may be asked to be. */
  get range() {
    return this.data.solver.limited ? [-180, 180] : [-360, 360];
  }

  /** By how much loops do not close, at most. */
  get error() {
    return this.motion.pose.error;
  }

  /** Degrees along the path since the driven joint was chosen, of the joint that moved most. */
  get travelled() {
    return this.motion.travelled * DEGREES;
  }

  /** Freedoms of the way, where they are known. */
  get freedoms() {
    return this.data.ways?.all[this.way].freedoms ?? null;
  }

  /** The other joints with a freedom of their own. */
  get held() {
    return this.drivers.filter((joint) => joint !== this.driver);
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
    return way !== undefined && joint >= 0 && !way.immobile.includes(joint);
  }

  /**
   * Drive another joint; one that has no freedom of its own takes that of the joint it goes with most.
   *
   * @param {number} joint
   */
  drive(joint) {
    if (!this.canDrive(joint) || joint === this.driver) return;
    if (!this.drivers.includes(joint)) {
      const shares = this.#besideStart().space.madeOf(joint, this.drivers).map(Math.abs);
      const most = Math.max(...shares);
      this.drivers[most > 0 ? shares.indexOf(most) : this.drivers.indexOf(this.driver)] = joint;
    }
    this.driver = joint;
    this.motion.travelled = 0;
    this.stopped = "";
    this.goal = null;
  }

  /**
   * Bring the driven joint to an angle, or as near as the path leads, the other driven joints held; tell whether it
   * came there.
   *
   * @param {number} degrees
   */
  to(degrees) {
    return this.#towards({ driver: this.driver, held: this.held, degrees: this.#inRange(degrees), along: false });
  }

  /**
   * Bring the driven joint to an angle as `to` does, but all others following as little as may be.
   *
   * @param {number} degrees
   */
  pull(degrees) {
    return this.#towards({ driver: this.driver, held: [], degrees: this.#inRange(degrees), along: false });
  }

  /**
   * Go to a place along the path, also past points where the driven joint turns back; tell whether it came there.
   *
   * @param {number} degrees - As `travelled` tells them.
   */
  along(degrees) {
    return this.#towards({ driver: this.driver, held: this.held, degrees, along: true });
  }

  /** Go on to where it is on its way to. */
  goOn() {
    if (this.goal) this.#towards(this.goal);
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
    this.drivers = [...this.data.ways.all[way].drivers];
    this.driver = this.drivers[0];
    this.reset();
  }

  /**
   * Return the largest size at the pose of the file and on the path of the driven joint, both ways. Of a mechanism of
   * many joints only the path near that pose is followed.
   *
   * @param {(places: Float64Array) => number} sizeOf
   */
  largestOnPath(sizeOf) {
    const motion = new Motion(this.data.solver, this.#direction());
    const drive = { joint: this.driver, held: this.held };
    const places = new Float64Array(this.places.length);
    let largest = sizeOf(this.#placesAt(motion.pose.angles, places));
    for (const way of this.moves ? [1, -1] : []) {
      motion.reset();
      let steps = Math.ceil(SIZING / this.data.joints.length), stopped = "";
      for (let degrees = 0; degrees < SIZED_UP_TO && !stopped; degrees += SIZED_EVERY) {
        stopped = motion.along(drive, (way * SIZED_EVERY) / DEGREES, () => --steps < 0);
        largest = Math.max(largest, sizeOf(this.#placesAt(motion.pose.angles, places)));
      }
    }
    return largest;
  }

  /** Return the pairs of panels that pass through each other; bodies made for axes alone are not looked at. */
  crossings() {
    if (!this.data.solver.limited) return [];
    this.#crossing ??= new Crossing(this.data.bodies);
    return this.#crossing.at(this.places);
  }

  /**
   * Return where vertices would be if the driven joint turned a little, the others going with it.
   *
   * @param {number} turn - Radians.
   */
  placesBeside(turn) {
    const { pose } = this.motion;
    const rates = this.#chosenRates() ?? pose.space.leastRates(this.driver, 1);
    const factor = rates[this.driver] ? turn / rates[this.driver] : 0;
    const angles = pose.angles.map((angle, joint) => angle + factor * rates[joint]);
    return this.#placesAt(angles);
  }

  /**
   * Return places of points that links carry, at the pose it has.
   *
   * @param {number[][]} points - At the pose of the file.
   * @param {number[]} owners
   */
  carried(points, owners) {
    return vertexPlaces(linkMotions(this.data.solver, this.motion.pose.angles), points, owners);
  }

  /** @param {number} degrees */
  #inRange(degrees) {
    const [least, most] = this.range;
    return Math.min(most, Math.max(least, degrees));
  }

  /** @param {Goal} goal */
  #towards(goal) {
    if (!this.moves) return false;
    const { motion } = this, drive = { joint: goal.driver, held: goal.held };
    const end = performance.now() + PATIENCE;
    const late = () => performance.now() > end;
    const stopped = goal.along
      ? motion.along(drive, goal.degrees / DEGREES - motion.travelled, late)
      : motion.to(drive, goal.degrees / DEGREES, late);
    this.goal = stopped === "late" ? goal : null;
    this.stopped = this.#told(stopped, goal.held);
    this.#place();
    return this.stopped === "";
  }

  /**
   * Return in words why it stopped.
   *
   * @param {Stopped} stopped
   * @param {number[]} held
   */
  #told(stopped, held) {
    const { joints } = this.data;
    const name = `joint ${joints[this.driver]}`;
    switch (stopped) {
      case "": return "";
      case "immobile":
        return held.length ? `${name} cannot move here while joints ${held.map((joint) => joints[joint]).join(", ")} stay`
          : `${name} cannot move here`;
      case "turns back": return `${name} turns back here; along the path it goes on`;
      case "limit": return `stops: panels lie on each other at joint ${this.#atLimit().join(", ")}`;
      case "lost": return "stops: no closed configuration is found beyond";
      case "late": return `${name} is on its way`;
    }
  }

  #atLimit() {
    const { angles } = this.motion.pose;
    const { same_configuration: near } = this.data.solver.tolerances;
    return this.data.joints.filter((_, joint) => Math.abs(angles[joint]) > Math.PI - near);
  }

  /** Return the rates of the way that was chosen, at a singular pose; null elsewhere. */
  #chosenRates() {
    const ways = this.data.ways;
    return ways?.singular && this.motion.pose === this.motion.start ? ways.all[this.way].rates : null;
  }

  /** Return a pose at which it is told how joints go together: of a singular one, one beside it. */
  #besideStart() {
    const { motion } = this;
    const rates = this.#chosenRates();
    if (rates === null) return motion.pose;
    return motion.equations.corrected(motion.pose.angles.map((angle, joint) => angle + BESIDE_START * rates[joint]));
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
