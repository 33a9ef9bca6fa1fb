/**
 * Panels that pass through each other at a pose: synth/analysis/folding/panel_collisions.py, as it says of one pose.
 *
 * Two plane convex pieces cross if each has corners on both sides of the other's plane and the stretches that they
 * cut out of the line of both planes overlap. Panels that share a crease, lie on each other or touch do not cross.
 */

/** @import { BodyData } from "./types.js" */
import { isConvex, trianglesOf } from "./geometry.js";

/** In units of the extent: what is no deeper is no crossing. */
const TOUCHING = 1e-7;

/**
 * A plane convex piece of a panel where it is now.
 *
 * @typedef {object} Piece
 * @property {number} link
 * @property {number[]} corners - Places, three numbers each.
 * @property {number[]} normal - Of length 1.
 * @property {number[]} low - Least coordinates.
 * @property {number[]} high
 */

export class Crossing {
  /** @param {BodyData} bodies */
  constructor(bodies) {
    /** @type {{link: number, vertices: number[]}[]} */
    this.pieces = bodies.faces.flatMap((face) => {
      if (isConvex(face.vertices.map((vertex) => bodies.vertices[vertex]))) return [face];
      const { corners } = trianglesOf({ ...bodies, faces: [face] });
      return Array.from({ length: corners.length / 3 }, (_, n) => (
        { link: face.link, vertices: [...corners.subarray(3 * n, 3 * n + 3)] }
      ));
    });
  }

  /**
   * Return the pairs of panels that cross, each once.
   *
   * @param {ArrayLike<number>} places - Of the vertices, three numbers each.
   * @returns {[number, number][]}
   */
  at(places) {
    const now = this.pieces.map((piece) => placed(piece, places)).sort((one, other) => one.low[0] - other.low[0]);
    /** @type {Map<string, [number, number]>} */
    const found = new Map();
    now.forEach((one, n) => {
      for (let m = n + 1; m < now.length && now[m].low[0] - TOUCHING <= one.high[0]; m++) {
        const other = now[m];
        if (one.link === other.link || !boxesMeet(one, other) || !cross(one, other)) continue;
        const pair = one.link < other.link ? [one.link, other.link] : [other.link, one.link];
        found.set(`${pair}`, /** @type {[number, number]} */ (pair));
      }
    });
    return [...found.values()];
  }
}

/**
 * @param {{link: number, vertices: number[]}} piece
 * @param {ArrayLike<number>} places
 * @returns {Piece}
 */
function placed({ link, vertices }, places) {
  const corners = vertices.flatMap((vertex) => [places[3 * vertex], places[3 * vertex + 1], places[3 * vertex + 2]]);
  const normal = [0, 0, 0], low = corners.slice(0, 3), high = corners.slice(0, 3);
  for (let n = 0; n < corners.length; n += 3) {
    const m = (n + 3) % corners.length;
    for (let i = 0; i < 3; i++) {
      const j = (i + 1) % 3, k = (i + 2) % 3;
      normal[i] += corners[n + j] * corners[m + k] - corners[n + k] * corners[m + j];
      low[i] = Math.min(low[i], corners[n + i]);
      high[i] = Math.max(high[i], corners[n + i]);
    }
  }
  return { link, corners, normal: unit(normal), low, high };
}

/**
 * @param {Piece} one
 * @param {Piece} other
 */
function boxesMeet(one, other) {
  for (let i = 1; i < 3; i++) {
    if (one.low[i] - TOUCHING > other.high[i] || other.low[i] - TOUCHING > one.high[i]) return false;
  }
  return true;
}

/**
 * @param {Piece} one
 * @param {Piece} other
 */
function cross(one, other) {
  const [a, b, c] = one.normal, [p, q, r] = other.normal;
  const line = unit([b * r - c * q, c * p - a * r, a * q - b * p]);
  const here = stretch(one, other, line);
  if (here === null) return false;
  const there = stretch(other, one, line);
  return there !== null && Math.min(here[1], there[1]) - Math.max(here[0], there[0]) > TOUCHING;
}

/**
 * Return the ends, along a line, of where a piece meets the plane of another; null where it lies on one side of that
 * or only touches it.
 *
 * @param {Piece} piece
 * @param {Piece} other
 * @param {number[]} line
 * @returns {[number, number] | null}
 */
function stretch({ corners }, other, line) {
  const count = corners.length / 3;
  const heights = [], along = [];
  for (let n = 0; n < count; n++) {
    let height = 0, at = 0;
    for (let i = 0; i < 3; i++) {
      height += (corners[3 * n + i] - other.corners[i]) * other.normal[i];
      at += corners[3 * n + i] * line[i];
    }
    heights.push(height);
    along.push(at);
  }
  if (Math.max(...heights) <= TOUCHING || Math.min(...heights) >= -TOUCHING) return null;
  let low = Infinity, high = -Infinity;
  for (let n = 0; n < count; n++) {
    const m = (n + 1) % count;
    const ends = Math.abs(heights[n]) <= TOUCHING ? [along[n]] : [];
    if (heights[n] * heights[m] < 0) {
      ends.push(along[n] + (heights[n] / (heights[n] - heights[m])) * (along[m] - along[n]));
    }
    low = Math.min(low, ...ends);
    high = Math.max(high, ...ends);
  }
  return [low, high];
}

/** @param {number[]} vector */
function unit(vector) {
  const size = Math.hypot(...vector) || 1;
  return vector.map((x) => x / size);
}
