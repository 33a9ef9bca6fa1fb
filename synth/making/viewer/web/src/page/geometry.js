/** Faces and lines as the graphics card takes them: rows of corners, renewed where bodies move. */

/** @import { BodyData } from "./types.js" */
import { ShapeUtils, Vector2 } from "three";

/**
 * Triangles of all faces.
 *
 * @typedef {object} Triangles
 * @property {Int32Array} corners - Three vertices each.
 * @property {Int32Array} faces - The face that each is of.
 */

/**
 * Return the faces cut into triangles, in the planes they have at the pose of the file.
 *
 * @param {BodyData} bodies
 * @returns {Triangles}
 */
export function trianglesOf({ vertices, faces }) {
  /** @type {number[]} */
  const corners = [];
  /** @type {number[]} */
  const of = [];
  faces.forEach((face, number) => {
    for (const triangle of cut(face.vertices.map((vertex) => vertices[vertex]))) {
      for (const corner of triangle) corners.push(face.vertices[corner]);
      of.push(number);
    }
  });
  return { corners: Int32Array.from(corners), faces: Int32Array.from(of) };
}

/**
 * Write the places of corners in a row.
 *
 * @param {ArrayLike<number>} places - Of the vertices, three numbers each.
 * @param {ArrayLike<number>} corners
 * @param {Float32Array} row
 */
export function gathered(places, corners, row) {
  for (let n = 0; n < corners.length; n++) {
    for (let i = 0; i < 3; i++) row[3 * n + i] = places[3 * corners[n] + i];
  }
}

/** A sine: corners that turn in by less are in line but for rounding, however short their sides are. */
const IN_LINE = 1e-9;

/**
 * Tell whether a plane polygon is convex.
 *
 * @param {number[][]} around
 */
export function isConvex(around) {
  const [x, y] = largestPlane(around);
  const count = around.length;
  const turns = around.map((here, n) => {
    const next = around[(n + 1) % count], last = around[(n + 2) % count];
    const side = [next[x] - here[x], next[y] - here[y]], after = [last[x] - next[x], last[y] - next[y]];
    return (side[0] * after[1] - side[1] * after[0]) / (Math.hypot(...side) * Math.hypot(...after) || 1);
  });
  return turns.every((turn) => turn >= -IN_LINE) || turns.every((turn) => turn <= IN_LINE);
}

/**
 * @param {number[][]} around
 * @returns {number[][]}
 */
function cut(around) {
  if (around.length === 3) return [[0, 1, 2]];
  const [x, y] = largestPlane(around);
  const flat = around.map((place) => new Vector2(place[x], place[y]));
  if (!ShapeUtils.isClockWise(flat)) return ShapeUtils.triangulateShape(flat, []);
  const mirrored = ShapeUtils.triangulateShape(flat.reverse(), []);
  return mirrored.map((one) => one.map((corner) => around.length - 1 - corner).reverse());
}

/**
 * Return the two coordinates in which a polygon is seen largest.
 *
 * @param {number[][]} around
 */
function largestPlane(around) {
  const pairs = [[0, 1], [1, 2], [2, 0]];
  const areas = pairs.map(([x, y]) => {
    let sum = 0;
    around.forEach((here, n) => {
      const next = around[(n + 1) % around.length];
      sum += here[x] * next[y] - next[x] * here[y];
    });
    return Math.abs(sum);
  });
  return pairs[areas.indexOf(Math.max(...areas))];
}
