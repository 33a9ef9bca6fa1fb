/** Where links and vertices are at joint angles: synth/analysis/motion/linkage.py. */

/** @import { LinkageData } from "./types.js" */

/**
 * Return how each link has moved from the pose of the file: twelve numbers a link, a rotation row by row and a shift.
 *
 * @param {LinkageData} linkage
 * @param {Float64Array} angles - Radians.
 */
export function linkMotions(linkage, angles) {
  const made = new Float64Array(12 * linkage.links);
  for (let link = 0; link < linkage.links; link++) made[12 * link] = made[12 * link + 4] = made[12 * link + 8] = 1;
  for (const [near, far, joint, sign] of linkage.tree) {
    const [x, y, z] = linkage.directions[joint];
    const [p, q, r] = linkage.points[joint];
    const angle = sign * (angles[joint] - linkage.angles[joint]);
    const c = Math.cos(angle), s = Math.sin(angle), v = 1 - c;
    const turn = [
      c + x * x * v, x * y * v - z * s, x * z * v + y * s,
      x * y * v + z * s, c + y * y * v, y * z * v - x * s,
      x * z * v - y * s, y * z * v + x * s, c + z * z * v,
    ];
    const from = 12 * near, to = 12 * far;
    const dx = p - (turn[0] * p + turn[1] * q + turn[2] * r);
    const dy = q - (turn[3] * p + turn[4] * q + turn[5] * r);
    const dz = r - (turn[6] * p + turn[7] * q + turn[8] * r);
    for (let i = 0; i < 3; i++) {
      const a = made[from + 3 * i], b = made[from + 3 * i + 1], g = made[from + 3 * i + 2];
      for (let j = 0; j < 3; j++) made[to + 3 * i + j] = a * turn[j] + b * turn[3 + j] + g * turn[6 + j];
      made[to + 9 + i] = made[from + 9 + i] + a * dx + b * dy + g * dz;
    }
  }
  return made;
}

/**
 * Return where vertices are, each carried by a link: three numbers a vertex, in units of the extent.
 *
 * @param {Float64Array} motions - Of `linkMotions`.
 * @param {number[][]} vertices - At the pose of the file.
 * @param {number[]} owners - The link of each; -1: it stays.
 * @param {Float64Array} [places] - Written to, where there is one already.
 */
export function vertexPlaces(motions, vertices, owners, places = new Float64Array(3 * vertices.length)) {
  for (let n = 0; n < vertices.length; n++) {
    const [x, y, z] = vertices[n];
    const at = 12 * owners[n];
    for (let i = 0; i < 3; i++) {
      const stays = vertices[n][i];
      places[3 * n + i] = at < 0 ? stays
        : motions[at + 3 * i] * x + motions[at + 3 * i + 1] * y + motions[at + 3 * i + 2] * z + motions[at + 9 + i];
    }
  }
  return places;
}
