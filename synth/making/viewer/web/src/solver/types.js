/**
 * What the solver is told of a linkage: docs/theory/viewer.md.
 *
 * @typedef {"finite" | "infinite" | "none"} Centre
 *
 * @typedef {object} LoopData
 * @property {number[]} joints - Places in the list of joints, in loop order.
 * @property {number[]} signs - 1 where the loop goes from a joint's first link to its second, else -1.
 * @property {Centre} centre
 * @property {number[][] | null} frame - Of parallel axes: two directions across them, and theirs.
 *
 * What is zero: graphs/tolerances.py. At a closed configuration, which is solved for in double precision.
 *
 * @typedef {object} Tolerances
 * @property {number} closed - Loops that miss by no more are closed: radians and units of the extent.
 * @property {number} zero - Singular values and eigenvalues below this part of the largest are zero.
 * @property {number} zero_rate - Rates below this part of the largest are none.
 * @property {number} immobile - Radians: a joint that turns by less does not move.
 * @property {number} same_configuration - Radians: angles that differ by less are one.
 *
 * @typedef {object} LinkageData
 * @property {number[][]} points - A point on each axis, in units of the extent, about the middle.
 * @property {number[][]} directions - Unit vectors.
 * @property {number[]} angles - Joint angles at the pose, radians.
 * @property {LoopData[]} loops - Those of one kind and length together, as the equations have them.
 * @property {number[]} order - Where each joint goes in the sparse factor.
 * @property {boolean} limited - Whether joints end at 180 degrees, where panels lie on each other.
 * @property {[number, number, number, number][]} tree - Link, the link beyond, the joint between, its sign.
 * @property {number} links - How many there are.
 * @property {Tolerances} tolerances
 */
export {};
