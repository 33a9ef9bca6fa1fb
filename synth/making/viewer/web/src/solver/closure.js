/**
 * Closure equations of a linkage and their derivatives: synth/analysis/motion/closure.py, line by line.
 *
 * A loop closes if the product of its joint rotations, each about its axis as it lies at the pose, is the identity.
 * About a finite centre that are three equations (a rotation), about an infinite one three (a motion in a plane),
 * else six (a screw). The derivative by a joint angle is the axis of the joint where it is now.
 */

/** @import { LinkageData, LoopData, Centre } from "./types.js" */

/**
 * A loop with its numbers in rows.
 *
 * @typedef {object} Loop
 * @property {Int32Array} joints
 * @property {Float64Array} signs
 * @property {Float64Array} axes - Three numbers a joint.
 * @property {Float64Array} points
 * @property {Centre} centre
 * @property {number[][] | null} frame
 * @property {number} equations
 * @property {number} row - Its first equation.
 * @property {number} start - Where its derivatives begin: equations by joints, row after row.
 */

/**
 * What does not close at a pose, and its derivatives.
 *
 * @typedef {object} Evaluated
 * @property {Float64Array} residual - Radians, and lengths in units of the extent.
 * @property {Float64Array} derivatives - Of each loop a full block; `Loop.start` says where.
 */

/** Sines below this belong to an angle whose axis is not known, or are that angle to the last digit. */
const SMALL = 1e-8;

export class Closure {
  /** @param {LinkageData} linkage */
  constructor(linkage) {
    this.zero = Float64Array.from(linkage.angles);
    this.joints = linkage.angles.length;
    this.rows = 0;
    this.entries = 0;
    /** @type {Loop[]} */
    this.loops = linkage.loops.map((loop) => {
      const made = packed(loop, linkage, this.rows, this.entries);
      this.rows += made.equations;
      this.entries += made.equations * made.joints.length;
      return made;
    });
    const longest = Math.max(0, ...this.loops.map((loop) => loop.joints.length));
    this.twists = new Float64Array(6 * longest);
  }

  /**
   * Return what does not close at joint angles, and its derivatives by them.
   *
   * @param {Float64Array} angles - Radians, from the zero of each joint.
   * @returns {Evaluated}
   */
  at(angles) {
    const residual = new Float64Array(this.rows);
    const derivatives = new Float64Array(this.entries);
    for (const loop of this.loops) {
      const off = evaluated(loop, angles, this.zero, this.twists);
      if (loop.centre === "infinite") inPlane(loop, off, this.twists, residual, derivatives);
      else copied(loop, off, this.twists, residual, derivatives);
    }
    return { residual, derivatives };
  }

  /**
   * Return by what loops part at some rates: the derivatives times these.
   *
   * @param {Float64Array} derivatives
   * @param {Float64Array} rates
   */
  image(derivatives, rates) {
    const made = new Float64Array(this.rows);
    for (const { joints, equations, row, start } of this.loops) {
      const k = joints.length;
      for (let e = 0; e < equations; e++) {
        let sum = 0;
        for (let i = 0; i < k; i++) sum += derivatives[start + e * k + i] * rates[joints[i]];
        made[row + e] = sum;
      }
    }
    return made;
  }

  /**
   * Return the transposed derivatives times what is given for each equation.
   *
   * @param {Float64Array} derivatives
   * @param {Float64Array} given
   */
  gathered(derivatives, given) {
    const made = new Float64Array(this.joints);
    for (const { joints, equations, row, start } of this.loops) {
      const k = joints.length;
      for (let e = 0; e < equations; e++) {
        const factor = given[row + e];
        for (let i = 0; i < k; i++) made[joints[i]] += derivatives[start + e * k + i] * factor;
      }
    }
    return made;
  }

  /**
   * Return the transposed derivatives times what rates leave of given amounts, divided: a sum of rows.
   *
   * @param {Float64Array} derivatives
   * @param {Float64Array} given - By what loops part.
   * @param {Float64Array} rates
   * @param {number} divisor
   */
  gatheredRest(derivatives, given, rates, divisor) {
    const made = new Float64Array(this.joints);
    for (const { joints, equations, row, start } of this.loops) {
      const k = joints.length;
      for (let e = 0, from = start; e < equations; e++, from += k) {
        let sum = 0;
        for (let i = 0; i < k; i++) sum += derivatives[from + i] * rates[joints[i]];
        const factor = (given[row + e] - sum) / divisor;
        for (let i = 0; i < k; i++) made[joints[i]] += derivatives[from + i] * factor;
      }
    }
    return made;
  }
}

/**
 * @param {LoopData} loop
 * @param {LinkageData} linkage
 * @param {number} row
 * @param {number} start
 * @returns {Loop}
 */
function packed(loop, linkage, row, start) {
  return {
    joints: Int32Array.from(loop.joints),
    signs: Float64Array.from(loop.signs),
    axes: Float64Array.from(loop.joints.flatMap((joint) => linkage.directions[joint])),
    points: Float64Array.from(loop.joints.flatMap((joint) => linkage.points[joint])),
    centre: loop.centre,
    frame: loop.frame,
    equations: loop.centre === "none" ? 6 : 3,
    row,
    start,
  };
}

/**
 * Return by what turn (a rotation vector) and shift a loop does not close; write the twists of its joints, each a
 * direction and a moment, one row a coordinate.
 *
 * @param {Loop} loop
 * @param {Float64Array} angles
 * @param {Float64Array} zero
 * @param {Float64Array} twists
 * @returns {number[]}
 */
function evaluated(loop, angles, zero, twists) {
  const { joints, signs, axes, points } = loop;
  const k = joints.length;
  const shifts = loop.centre !== "finite";
  let [a, b, c, d, e, f, g, h, i] = [1, 0, 0, 0, 1, 0, 0, 0, 1]; // the turns so far, row by row
  let [mx, my, mz] = [0, 0, 0]; // the shift so far
  for (let n = 0; n < k; n++) {
    const x = axes[3 * n], y = axes[3 * n + 1], z = axes[3 * n + 2], sign = signs[n];
    const ax = a * x + b * y + c * z, ay = d * x + e * y + f * z, az = g * x + h * y + i * z;
    twists[n] = sign * ax;
    twists[k + n] = sign * ay;
    twists[2 * k + n] = sign * az;
    const angle = (angles[joints[n]] - zero[joints[n]]) * sign;
    const cos = Math.cos(angle), s = Math.sin(angle), v = 1 - cos;
    const r00 = cos + x * x * v, r01 = x * y * v - z * s, r02 = x * z * v + y * s;
    const r10 = x * y * v + z * s, r11 = cos + y * y * v, r12 = y * z * v - x * s;
    const r20 = x * z * v - y * s, r21 = y * z * v + x * s, r22 = cos + z * z * v;
    if (shifts) {
      const p = points[3 * n], q = points[3 * n + 1], r = points[3 * n + 2];
      const px = a * p + b * q + c * r + mx, py = d * p + e * q + f * r + my, pz = g * p + h * q + i * r + mz;
      twists[3 * k + n] = sign * (py * az - pz * ay);
      twists[4 * k + n] = sign * (pz * ax - px * az);
      twists[5 * k + n] = sign * (px * ay - py * ax);
      const dx = p - (r00 * p + r01 * q + r02 * r);
      const dy = q - (r10 * p + r11 * q + r12 * r);
      const dz = r - (r20 * p + r21 * q + r22 * r);
      mx += a * dx + b * dy + c * dz;
      my += d * dx + e * dy + f * dz;
      mz += g * dx + h * dy + i * dz;
    }
    [a, b, c] = [a * r00 + b * r10 + c * r20, a * r01 + b * r11 + c * r21, a * r02 + b * r12 + c * r22];
    [d, e, f] = [d * r00 + e * r10 + f * r20, d * r01 + e * r11 + f * r21, d * r02 + e * r12 + f * r22];
    [g, h, i] = [g * r00 + h * r10 + i * r20, g * r01 + h * r11 + i * r21, g * r02 + h * r12 + i * r22];
  }
  const sx = (h - f) / 2, sy = (c - g) / 2, sz = (d - b) / 2;
  const s = Math.sqrt(sx * sx + sy * sy + sz * sz);
  const factor = s < SMALL ? 1 : Math.atan2(s, (a + e + i - 1) / 2) / s;
  return [sx * factor, sy * factor, sz * factor, mx, my, mz];
}

/**
 * @param {Loop} loop
 * @param {number[]} off
 * @param {Float64Array} twists
 * @param {Float64Array} residual
 * @param {Float64Array} derivatives
 */
function copied(loop, off, twists, residual, derivatives) {
  for (let e = 0; e < loop.equations; e++) residual[loop.row + e] = off[e];
  const entries = loop.equations * loop.joints.length;
  for (let n = 0; n < entries; n++) derivatives[loop.start + n] = twists[n];
}

/**
 * Write the turn about parallel axes and the shift across them.
 *
 * @param {Loop} loop
 * @param {number[]} off
 * @param {Float64Array} twists
 * @param {Float64Array} residual
 * @param {Float64Array} derivatives
 */
function inPlane(loop, off, twists, residual, derivatives) {
  if (loop.frame === null) throw new Error("a loop of parallel axes has no frame");
  const [one, other, along] = loop.frame;
  const k = loop.joints.length;
  const kept = /** @type {[number[], number][]} */ ([[along, 0], [one, 3], [other, 3]]);
  kept.forEach(([direction, from], e) => {
    const [x, y, z] = direction;
    residual[loop.row + e] = x * off[from] + y * off[from + 1] + z * off[from + 2];
    for (let n = 0; n < k; n++) {
      const at = from * k + n;
      derivatives[loop.start + e * k + n] = x * twists[at] + y * twists[at + k] + z * twists[at + 2 * k];
    }
  });
}
