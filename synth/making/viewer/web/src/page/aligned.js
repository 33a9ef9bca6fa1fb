/**
 * How a moved body is turned back to where it was: the rotation that brings corners nearest to their first places.
 *
 * Horn 1987, "Closed-form solution of absolute orientation using unit quaternions": the quaternion is the
 * eigenvector of the largest eigenvalue of a matrix of four rows, found here by a high power of that, from the last
 * quaternion, so that a body seen frame by frame never jumps.
 */

/** Times that the matrix is squared. */
const SQUARED = 10;

/**
 * Return the middle of places, three numbers each.
 *
 * @param {ArrayLike<number>} places
 */
export function middleOf(places) {
  const sum = [0, 0, 0];
  for (let n = 0; n < places.length; n++) sum[n % 3] += places[n];
  return sum.map((x) => x / Math.max(1, places.length / 3));
}

/**
 * Return the middle of the box round places, three numbers each.
 *
 * @param {ArrayLike<number>} places
 */
export function middleOfBox(places) {
  const least = [Infinity, Infinity, Infinity], most = [-Infinity, -Infinity, -Infinity];
  for (let n = 0; n < places.length; n++) {
    least[n % 3] = Math.min(least[n % 3], places[n]);
    most[n % 3] = Math.max(most[n % 3], places[n]);
  }
  return least.map((x, i) => (x + most[i]) / 2);
}

/**
 * Return how far places are from their middle, at most.
 *
 * @param {ArrayLike<number>} places
 */
export function radiusOf(places) {
  return farthestFrom(middleOf(places), places);
}

/**
 * Return how far places are from a point, at most.
 *
 * @param {number[]} point
 * @param {ArrayLike<number>} places
 */
export function farthestFrom([x, y, z], places) {
  let most = 0;
  for (let n = 0; n < places.length; n += 3) {
    most = Math.max(most, Math.hypot(places[n] - x, places[n + 1] - y, places[n + 2] - z));
  }
  return most;
}

/**
 * Return the unit quaternion (x, y, z, w) that turns places, about their middle, nearest to other ones.
 *
 * @param {ArrayLike<number>} places
 * @param {ArrayLike<number>} goals
 * @param {number[]} last - Where the iteration begins.
 */
export function turnBack(places, goals, last) {
  const from = middleOf(places), to = middleOf(goals);
  const s = [0, 0, 0, 0, 0, 0, 0, 0, 0]; // sums of products, row by row
  for (let n = 0; n < places.length; n += 3) {
    for (let i = 0; i < 3; i++) {
      for (let j = 0; j < 3; j++) s[3 * i + j] += (places[n + i] - from[i]) * (goals[n + j] - to[j]);
    }
  }
  const [xx, xy, xz, yx, yy, yz, zx, zy, zz] = s;
  const rows = [
    [xx - yy - zz, xy + yx, zx + xz, yz - zy],
    [xy + yx, yy - xx - zz, yz + zy, zx - xz],
    [zx + xz, yz + zy, zz - xx - yy, xy - yx],
    [yz - zy, zx - xz, xy - yx, xx + yy + zz],
  ];
  const shift = Math.sqrt(3 * s.reduce((sum, x) => sum + x * x, 0)) + 1e-300; // so that the largest counts
  let power = rows.map((row, i) => row.map((x, j) => (x + (i === j ? shift : 0)) / shift));
  for (let n = 0; n < SQUARED; n++) power = squared(power);
  const turned = power.map((row) => row.reduce((sum, x, j) => sum + x * last[j], 0));
  const size = Math.hypot(...turned);
  return size > 0 ? turned.map((x) => x / size) : last;
}

/**
 * Return the square of a symmetric matrix, by which its entries are at most 1.
 *
 * @param {number[][]} matrix
 */
function squared(matrix) {
  const made = matrix.map((row) => matrix.map((other) => row.reduce((sum, x, n) => sum + x * other[n], 0)));
  const most = Math.max(...made.flat().map(Math.abs));
  return made.map((row) => row.map((x) => x / most));
}
