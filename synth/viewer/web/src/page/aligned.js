/**
 * How a moved body is turned back to where it was: the rotation that brings corners nearest to their first places.
 *
 * Horn 1987, "Closed-form solution of absolute orientation using unit quaternions": the quaternion is the
 * eigenvector of the largest eigenvalue of a matrix of four rows, found here by power iteration from the last one, so
 * that a body seen frame by frame never jumps.
 */

const ITERATIONS = 40;

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
  let q = last;
  for (let n = 0; n < ITERATIONS; n++) {
    const next = rows.map((row, i) => row.reduce((sum, x, j) => sum + x * q[j], shift * q[i]));
    const size = Math.hypot(...next);
    q = next.map((x) => x / size);
  }
  return q;
}
