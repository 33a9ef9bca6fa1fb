/** Rows of numbers: what the solver does with them. */

/**
 * @param {Float64Array} one
 * @param {Float64Array} other
 */
export function dot(one, other) {
  let sum = 0;
  for (let i = 0; i < one.length; i++) sum += one[i] * other[i];
  return sum;
}

/**
 * Return the largest size of a row of numbers.
 *
 * @param {Float64Array} row
 */
export function largest(row) {
  let most = 0;
  for (let i = 0; i < row.length; i++) {
    const size = Math.abs(row[i]);
    if (!(size <= most)) most = size; // what is no number is larger than all
  }
  return most;
}

/**
 * @param {Float64Array} one
 * @param {number} factor
 * @param {Float64Array} other
 */
export function added(one, factor, other) {
  const sum = new Float64Array(one.length);
  for (let i = 0; i < sum.length; i++) sum[i] = one[i] + factor * other[i];
  return sum;
}

/**
 * Take a row off another one, in its place.
 *
 * @param {Float64Array} whole
 * @param {Float64Array} part
 */
export function takeOff(whole, part) {
  for (let i = 0; i < whole.length; i++) whole[i] -= part[i];
  return whole;
}

/**
 * @param {Float64Array} angles
 * @param {number} joint
 * @param {number} value
 */
export function put(angles, joint, value) {
  const made = Float64Array.from(angles);
  made[joint] = value;
  return made;
}

/**
 * Return angles of which some joints have other values.
 *
 * @param {Float64Array} angles
 * @param {number[]} joints
 * @param {Float64Array} values - Of all joints.
 */
export function putAll(angles, joints, values) {
  const made = Float64Array.from(angles);
  for (const joint of joints) made[joint] = values[joint];
  return made;
}

/**
 * Tell whether two directions are alike.
 *
 * @param {Float64Array} one
 * @param {Float64Array} other
 * @param {number} cosine - Of the angle between them, at least.
 */
export function alike(one, other, cosine) {
  return dot(one, other) > cosine * Math.sqrt(dot(one, one)) * Math.sqrt(dot(other, other));
}
