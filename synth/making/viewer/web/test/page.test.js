/** What the page computes beside the solver; what it shows is tested in a browser: tests/synth/making/viewer. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { farthestFrom, middleOf, middleOfBox, radiusOf, turnBack } from "../src/page/aligned.js";
import { Crossing } from "../src/page/crossing.js";
import { snapped } from "../src/page/editing.js";
import { isConvex, trianglesOf } from "../src/page/geometry.js";
import { Mechanism } from "../src/page/mechanism.js";

test("a turned body is turned back", () => {
  const goals = [0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 3];
  const turned = []; // by 90 degrees about z, and shifted
  for (let n = 0; n < goals.length; n += 3) turned.push(5 - goals[n + 1], goals[n] + 7, goals[n + 2] - 1);
  const [x, y, z, w] = turnBack(turned, goals, [0, 0, 0, 1]);
  assert.ok(Math.abs(x) < 1e-9 && Math.abs(y) < 1e-9);
  assert.ok(Math.abs(2 * Math.atan2(z, w) + Math.PI / 2) < 1e-6);
});

test("a body that did not turn is not turned, whatever its size", () => {
  const places = [0, 0, 0, 1e-9, 0, 0, 0, 1e-9, 0];
  turnBack(places, places, [0, 0, 0, 1]).forEach((x, n) => assert.ok(Math.abs(x - (n === 3 ? 1 : 0)) < 1e-9));
});

test("middle and radius", () => {
  assert.deepEqual(middleOf([0, 0, 0, 2, 4, 6]), [1, 2, 3]);
  assert.equal(radiusOf([-3, 0, 4, 3, 0, -4]), 5);
  assert.deepEqual(middleOfBox([0, 0, 0, 2, 4, 6, 2, 4, 6]), [1, 2, 3]);
  assert.equal(farthestFrom([1, 0, 0], [1, 3, 4, 1, 0, 1]), 5);
});

test("the largest size on the path is that of a parallelogram stretched along its longer links", () => {
  const places = [[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]];
  const name = String;
  const mechanism = new Mechanism(/** @type {any} */ ({ immobile: [], clusters: [] }), /** @type {any} */ ({
    solver: {
      points: places, directions: places.map(() => [0, 0, 1]), angles: [0, 0, 0, 0],
      loops: [{ joints: [0, 1, 2, 3], signs: [1, 1, 1, 1], centre: "infinite", frame: [[1, 0, 0], [0, 1, 0], [0, 0, 1]] }],
      order: [2, 0, 3, 1], limited: false, tree: [[0, 1, 0, 1], [1, 2, 1, 1], [2, 3, 2, 1]], links: 4,
      tolerances: { closed: 1e-12, zero: 1e-9, zero_rate: 1e-7, immobile: 1e-9, same_configuration: 1e-6 },
    },
    bodies: { vertices: places, owners: [0, 1, 2, 3], faces: [], edges: [] },
    ways: { all: [{ told: "", rates: [1, -1, 1, -1], immobile: [], drivers: [0], freedoms: 1 }], singular: false, taken: 0 },
    joints: [0, 1, 2, 3].map(name), links: [0, 1, 2, 3].map(name), centres: [], between: [], extent: 1, middle: [0, 0, 0],
  }));
  const diagonal = (/** @type {Float64Array} */ at) => Math.hypot(at[6] - at[0], at[7] - at[1], at[8] - at[2]);
  const before = [...mechanism.places];
  assert.ok(Math.abs(mechanism.largestOnPath(diagonal) - 3) < 1e-9);
  assert.deepEqual([...mechanism.places], before);
});

for (const turned of [false, true]) {
  test(`a concave panel is cut into triangles of its own area, ${turned ? "clockwise" : "counter-clockwise"}`, () => {
    const around = [[0, 0, 1], [4, 0, 1], [4, 4, 1], [2, 1, 1], [0, 4, 1]];
    const order = turned ? [4, 3, 2, 1, 0] : [0, 1, 2, 3, 4];
    const { corners, faces } = trianglesOf({
      vertices: around, owners: [0, 0, 0, 0, 0], faces: [{ link: 0, vertices: order }], edges: [],
    });
    let area = 0;
    for (let n = 0; n < corners.length; n += 3) {
      const [a, b, c] = [...corners.subarray(n, n + 3)].map((corner) => around[corner]);
      area += ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2;
    }
    assert.equal(faces.length, 3);
    assert.equal(area, turned ? -10 : 10);
  });
}

test("a notch is seen, however short the sides at its corners are", () => {
  const square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]];
  assert.ok(isConvex(square));
  assert.ok(isConvex([...square.slice(0, 3), [0.5, 1, 0], square[3]]));
  const tiny = 1e-6; // corners of the notch are cut off
  const notch = [
    [0.6, 1, 0], [0.6, 0.9 + tiny, 0], [0.6 - tiny, 0.9, 0], [0.4 + tiny, 0.9, 0], [0.4, 0.9 + tiny, 0], [0.4, 1, 0],
  ];
  assert.ok(!isConvex([...square.slice(0, 3), ...notch, square[3]]));
});

/**
 * Two panels: a square in the plane and a triangle that stands on end.
 *
 * @param {number[][]} standing - Corners of the triangle.
 */
function crossings(standing) {
  const vertices = [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], ...standing];
  const faces = [{ link: 0, vertices: [0, 1, 2, 3] }, { link: 1, vertices: [4, 5, 6] }];
  return new Crossing({ vertices, owners: [0, 0, 0, 0, 1, 1, 1], faces, edges: [] }).at(vertices.flat());
}

test("panels cross that pass through each other; not those that touch, lie on each other or are apart", () => {
  assert.deepEqual(crossings([[1, 1, -1], [1.2, 1, 1], [0.8, 1, 1]]), [[0, 1]]);
  assert.deepEqual(crossings([[1, 1, 0], [1.2, 1, 1], [0.8, 1, 1]]), []);
  assert.deepEqual(crossings([[0.5, 0.5, 0], [1.5, 0.5, 0], [1, 1.5, 0]]), []);
  assert.deepEqual(crossings([[3, 1, -1], [3.2, 1, 1], [2.8, 1, 1]]), []);
});

test("a square is crossed along its diagonal", () => {
  assert.deepEqual(crossings([[1, 1, -1], [0.5, 0.5, 1], [1.5, 1.5, 1]]), [[0, 1]]);
});

test("an end of a crease is the vertex near to a click, else a point of the nearest edge", () => {
  /** @type {import("../src/page/types.js").DrawnData} */
  const drawn = {
    vertices: [[0, 0, 1], [2, 0, 1], [2, 1, 1]], edges: [[0, 1], [1, 2]], places: [[10, 90], [90, 90], [90, 50]],
  };
  assert.deepEqual(snapped(drawn, [88, 92], 5), { named: "1", place: [90, 90] });
  assert.deepEqual(snapped(drawn, [50, 80], 5), { named: "1,0,1", place: [50, 90] });
  assert.deepEqual(snapped(drawn, [95, 60], 5), { named: "2,0.75,1", place: [90, 60] });
});
