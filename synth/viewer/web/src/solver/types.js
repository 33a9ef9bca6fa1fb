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
 * @typedef {object} LinkageData
 * @property {number[][]} points - A point on each axis, in units of the extent, about the middle.
 * @property {number[][]} directions - Unit vectors.
 * @property {number[]} angles - Joint angles at the pose, radians.
 * @property {LoopData[]} loops - Those of one kind and length together, as the equations have them.
 * @property {number[]} order - Where each joint goes in the sparse factor.
 * @property {boolean} limited - Whether joints end at 180 degrees, where panels lie on each other.
 * @property {[number, number, number, number][]} tree - Link, the link beyond, the joint between, its sign.
 * @property {number} links - How many there are.
 */
export {};
