/** The solver on small linkages whose motion is known; what Python says of others: tests/synth/making/viewer. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { Closure } from "../src/solver/closure.js";
import { NormalPattern } from "../src/solver/cholesky.js";
import { Motion } from "../src/solver/motion.js";
import { linkMotions, vertexPlaces } from "../src/solver/placement.js";

/** @import { LinkageData, Centre } from "../src/solver/types.js" */

/** @param {number} joint */
const one = (joint) => ({ joint, held: [] });

/**
 * A parallelogram in the plane, 2 by 1.
 *
 * @param {Centre} centre
 * @returns {LinkageData}
 */
function parallelogram(centre) {
  return {
    points: [[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]],
    directions: Array.from({ length: 4 }, () => [0, 0, 1]),
    angles: [0, 0, 0, 0],
    loops: [{ joints: [0, 1, 2, 3], signs: [1, 1, 1, 1], centre, frame: [[1, 0, 0], [0, 1, 0], [0, 0, 1]] }],
    order: [2, 0, 3, 1],
    limited: false,
    tree: [[0, 1, 0, 1], [1, 2, 1, 1], [2, 3, 2, 1]],
    links: 4,
    tolerances: { closed: 1e-12, zero: 1e-9, zero_rate: 1e-7, immobile: 1e-9, same_configuration: 1e-6 },
  };
}

for (const centre of /** @type {Centre[]} */ (["infinite", "none"])) {
  test(`a parallelogram turns opposite joints alike, its loop's centre ${centre}`, () => {
    const motion = new Motion(parallelogram(centre), null);
    assert.equal(motion.to(one(0), 1.2), "");
    const expected = [1.2, -1.2, 1.2, -1.2];
    expected.forEach((angle, joint) => assert.ok(Math.abs(motion.pose.angles[joint] - angle) < 1e-10));
    assert.ok(motion.pose.error <= 1e-12);
  });
}

test("derivatives are what residuals do beside a pose", () => {
  const closure = new Closure(parallelogram("none"));
  const angles = Float64Array.of(0.3, -0.2, 0.4, -0.35);
  const { derivatives } = closure.at(Float64Array.of(0, 0, 0, 0));
  const small = angles.map((angle) => 1e-6 * angle);
  const linear = closure.image(derivatives, small);
  closure.at(small).residual.forEach((off, row) => assert.ok(Math.abs(off - linear[row]) < 1e-11));
});

test("a factor solves the regularised normal equations", () => {
  const closure = new Closure(parallelogram("none"));
  const { derivatives } = closure.at(Float64Array.of(0.3, -0.2, 0.4, -0.35));
  const pattern = new NormalPattern(4, closure.loops, [2, 0, 3, 1]);
  const { solve, regular } = pattern.solver(closure.loops, derivatives, 1e-3);
  const given = Float64Array.of(1, 2, 3, 5);
  const found = solve(given.slice());
  const back = closure.gathered(derivatives, closure.image(derivatives, found));
  let most = 1;
  for (let joint = 0; joint < 4; joint++) {
    const unit = new Float64Array(4);
    unit[joint] = 1;
    const image = closure.image(derivatives, unit);
    most = Math.max(most, image.reduce((sum, x) => sum + x * x, 0));
  }
  assert.ok(Math.abs(regular - 1e-3 * most) < 1e-15);
  given.forEach((x, joint) => assert.ok(Math.abs(back[joint] + regular * found[joint] - x) < 1e-9));
});

test("a joint ends where panels lie on each other", () => {
  const hinge = { ...parallelogram("none"), points: [[0, 0, 0]], directions: [[0, 0, 1]], angles: [0], loops: [] };
  /** @type {LinkageData} */
  const linkage = { ...hinge, order: [0], tree: [[0, 1, 0, 1]], links: 2, limited: true };
  const motion = new Motion(linkage, null);
  assert.equal(motion.to(one(0), 4), "limit");
  assert.ok(Math.abs(motion.pose.angles[0] - Math.PI) < 1e-6);
  assert.equal(motion.to(one(0), 1), "");
  assert.equal(motion.pose.angles[0], 1);
});

test("a long way can be broken off, and gone on with from there", () => {
  const whole = new Motion(parallelogram("infinite"), null), pieces = new Motion(parallelogram("infinite"), null);
  whole.to(one(0), 1.5);
  let count = 0;
  while (pieces.to(one(0), 1.5, () => true) === "late") count += 1;
  assert.ok(count > 3);
  assert.deepEqual([...pieces.pose.angles], [...whole.pose.angles]);
});

test("a rocker turns back, and can be driven the other way from there", () => {
  const linkage = { ...parallelogram("infinite"), points: [[0, 0, 0], [1, 0, 0], [3, 2, 0], [0, 3, 0]] };
  const motion = new Motion(linkage, null);
  const stops = [motion.to(one(3), 6), motion.to(one(3), -6)];
  assert.deepEqual(stops, ["turns back", "turns back"]);
  assert.ok(motion.pose.error <= 1e-12);
});

test("a joint comes to angles just before it turns back, also if a step leads past both", () => {
  for (const [points, joint, way] of /** @type {[number[][], number, number][]} */ ([
    [[[4, 5, 0], [2, 3, 0], [4, 0, 0], [0, 3, 0]], 3, -1],
    [[[4, 0, 0], [2, 0, 0], [2, 4, 0], [3, 5, 0]], 2, -1],
  ])) {
    const linkage = { ...parallelogram("infinite"), points };
    const whole = new Motion(linkage, null);
    assert.equal(whole.to(one(joint), 7 * way), "turns back");
    for (const before of [1e-3, 3e-4, 1e-4, 3e-5, 1e-5]) {
      const motion = new Motion(linkage, null), goal = whole.pose.angles[joint] - way * before;
      assert.equal(motion.to(one(joint), goal), "");
      assert.equal(motion.pose.angles[joint], goal);
    }
  }
});

/** Five bars in the plane: two freedoms. */
function fiveBar() {
  return {
    ...parallelogram("infinite"),
    points: [[0, 0, 0], [2, 0, 0], [3, 2, 0], [1, 3, 0], [-1, 2, 0]],
    directions: Array.from({ length: 5 }, () => [0, 0, 1]),
    angles: [0, 0, 0, 0, 0],
    loops: [{
      joints: [0, 1, 2, 3, 4], signs: [1, 1, 1, 1, 1], centre: /** @type {Centre} */ ("infinite"),
      frame: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
    }],
    order: [0, 1, 2, 3, 4],
    tree: /** @type {LinkageData["tree"]} */ ([[0, 1, 0, 1], [1, 2, 1, 1], [2, 3, 2, 1], [3, 4, 3, 1]]),
    links: 5,
  };
}

test("a joint that is held stays while another is driven, in whatever order", () => {
  const poses = [[0, 1], [1, 0]].map(([first, second]) => {
    const motion = new Motion(fiveBar(), null);
    const goals = [0.3, -0.2];
    for (const joint of [first, second]) {
      assert.equal(motion.to({ joint, held: [1 - joint] }, goals[joint]), "");
      assert.equal(motion.pose.angles[1 - joint], joint === first ? 0 : goals[1 - joint]);
      assert.ok(motion.pose.error <= 1e-12);
    }
    return motion.pose.angles;
  });
  poses[0].forEach((angle, joint) => assert.ok(Math.abs(angle - poses[1][joint]) < 1e-9));
});

test("a joint cannot move where all others are held", () => {
  const motion = new Motion(fiveBar(), null);
  assert.equal(motion.to({ joint: 0, held: [1, 2] }, 0.3), "immobile");
  assert.deepEqual([...motion.pose.angles], [0, 0, 0, 0, 0]);
});

test("a joint is made of those that have a freedom", () => {
  const { space } = new Motion(fiveBar(), null).pose;
  const [of3, of4] = space.madeOf(2, [3, 4]);
  const rates = space.leastRates(2, 1, []);
  assert.ok(Math.abs(of3 * rates[3] + of4 * rates[4] - 1) < 1e-9);
});

test("along the path it goes past where the driven joint turns back, and back the same way", () => {
  const linkage = { ...parallelogram("infinite"), points: [[0, 0, 0], [1, 0, 0], [3, 2, 0], [0, 3, 0]] };
  const motion = new Motion(linkage, null);
  assert.equal(motion.to(one(3), 6), "turns back");
  const top = motion.pose.angles[3], there = motion.travelled;
  assert.equal(motion.along(one(3), 1), "");
  assert.ok(motion.pose.angles[3] < top - 0.05);
  assert.ok(Math.abs(motion.travelled - there - 1) < 1e-9);
  assert.ok(motion.pose.error <= 1e-12);
  assert.equal(motion.along(one(3), -1 - there), "");
  assert.ok(Math.max(...motion.pose.angles.map(Math.abs)) < 0.02);
});

test("a linkage is put at its singular start only if all of it is there", () => {
  const flaps = { ...parallelogram("none"), loops: [], angles: [0, 0], order: [0, 1], links: 3 };
  /** @type {LinkageData} */
  const linkage = {
    ...flaps, points: [[0, 0, 0], [1, 0, 0]], directions: [[0, 0, 1], [0, 0, 1]], tree: [[0, 1, 0, 1], [1, 2, 1, 1]],
  };
  const motion = new Motion(linkage, Float64Array.of(1, 1));
  motion.to(one(0), 0.5);
  motion.to(one(1), 1);
  assert.equal(motion.to(one(0), 0), "");
  assert.deepEqual([...motion.pose.angles], [0, 1]);
  motion.to(one(1), 0);
  assert.equal(motion.pose, motion.start);
});

test("along the path it goes through a singular start, and on on the same branch", () => {
  const motion = new Motion(parallelogram("infinite"), Float64Array.of(1, -1, 1, -1));
  motion.to(one(0), 0.3);
  assert.equal(motion.along(one(0), -0.6), "");
  [-0.3, 0.3, -0.3, 0.3].forEach((angle, joint) => assert.ok(Math.abs(motion.pose.angles[joint] - angle) < 0.01));
});

test("vertices go with their links; those of no link stay", () => {
  const linkage = parallelogram("infinite");
  const motions = linkMotions(linkage, Float64Array.of(Math.PI / 2, 0, 0, 0));
  const places = vertexPlaces(motions, [[1, 0, 0], [1, 0, 0], [7, 8, 9]], [0, 1, -1]);
  [1, 0, 0, 0, 1, 0, 7, 8, 9].forEach((x, n) => assert.ok(Math.abs(places[n] - x) < 1e-15));
});
