/** A sheet folded flat: orders of components put together, heights of panels, shapes of each view. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { Edges, heightsOf, shapesOf, stacksOf, VIEWS } from "../src/page/layered.js";

/**
 * Two squares side by side; panels 0 and 1 over the first, 0, 2, 3 and 4 over the second.
 *
 * @type {import("../src/page/types.js").FlatData}
 */
const FLAT = {
  told: "Folds flat",
  nodes: [[0, 0], [1, 0], [2, 0], [2, 1], [1, 1], [0, 1]],
  cells: [[0, 1, 4, 5], [1, 2, 3, 4]],
  flipped: [false, true, true, false, true],
  stacks: [[0, 1], [0, 2, 3, 4]],
  components: [
    { panels: [0, 2], orders: "2", listed: [{}, { 1: [2, 0, 3, 4] }] },
    { panels: [3, 4], orders: "2", listed: [{}, { 1: [0, 2, 4, 3] }] },
  ],
};

test("orders of two components in one cell go together", () => {
  assert.deepEqual(stacksOf(FLAT, [0, 0]), FLAT.stacks);
  assert.deepEqual(stacksOf(FLAT, [1, 0])[1], [2, 0, 3, 4]);
  assert.deepEqual(stacksOf(FLAT, [0, 1])[1], [0, 2, 4, 3]);
  assert.deepEqual(stacksOf(FLAT, [1, 1])[1], [2, 0, 4, 3]);
});

test("a panel is higher than all that it lies on; in a circle there are no heights", () => {
  assert.deepEqual(heightsOf([[0, 1], [0, 2, 3], [1, 2]]), new Map([[0, 0], [1, 1], [2, 2], [3, 3]]));
  assert.equal(heightsOf([[0, 1], [1, 2], [2, 0]]), null);
});

test("an edge between two cells is one", () => {
  const edges = new Edges(FLAT.cells).all;
  assert.equal(edges.length, 7);
  assert.deepEqual(edges.filter(({ beside }) => beside.length === 2), [{ ends: [1, 4], beside: [0, 1] }]);
});

test("what is on top is seen, from the back what is below, mirrored", () => {
  const areas = (/** @type {import("../src/page/layered.js").View} */ view) =>
    shapesOf(FLAT, FLAT.stacks, view, 0.1).filter(({ closed }) => closed);
  assert.deepEqual(areas("front").map(({ panel, looks }) => [panel, looks]), [[1, "paper-back"], [4, "paper-back"]]);
  assert.deepEqual(areas("back").map(({ panel, looks }) => [panel, looks]), [[0, "paper-back"], [0, "paper-back"]]);
  assert.deepEqual(areas("back")[0].points[1], [-1, -0]);
  assert.deepEqual(areas("light").map(({ opacity }) => opacity), [1 - 0.85 ** 2, 1 - 0.85 ** 4]);
});

test("from the back no line is drawn within one panel, against the light all are", () => {
  const lines = VIEWS.map((view) => shapesOf(FLAT, FLAT.stacks, view, 0.1).filter(({ closed }) => !closed).length);
  assert.deepEqual(lines, [7, 6, 7, 7, 4 + 6 + 4 + 4 + 4]);
});

test("exploded, each layer of a cell is there, the lowest first, and as high as is asked", () => {
  const shapes = shapesOf(FLAT, FLAT.stacks, "exploded", 0.75);
  const areas = shapes.filter(({ closed }) => closed);
  assert.equal(areas.length, 6);
  assert.equal(areas[0].panel, 0);
  const [two, four] = [2, 4].map((panel) => areas.find((area) => area.panel === panel));
  assert.ok(two && four);
  assert.ok(Math.abs(two.points[0][1] - four.points[0][1] - 2 * 0.25) < 1e-12);
});
