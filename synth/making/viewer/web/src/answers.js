/**
 * The solver asked from outside: questions as JSON on standard input, answers on standard output.
 *
 * So Python compares it with its own, and its speed is measured. The page does not use it. What three.js is needed for
 * is imported where panels are asked about, so that the solver answers wherever node is.
 */

/** @import { LinkageData } from "./solver/types.js" */
import { readFileSync } from "node:fs";
import { Closure } from "./solver/closure.js";
import { Motion } from "./solver/motion.js";
import { Equations } from "./solver/newton.js";
import { linkMotions, vertexPlaces } from "./solver/placement.js";

/**
 * @typedef {object} Question
 * @property {LinkageData} linkage
 * @property {number[]} anywhere - Angles at which residual and derivatives are asked for.
 * @property {number[]} near - Angles from which Newton's method begins.
 * @property {number[] | null} direction - Rates to begin with.
 * @property {number} driver
 * @property {number[]} held - Joints that stay.
 * @property {number[]} goals - Its angles, one after the other.
 * @property {number[][]} vertices
 * @property {number[]} owners
 * @property {{link: number, vertices: number[]}[]} faces - Panels that may cross.
 */

/** @param {Question} question */
async function answered({ linkage, anywhere, near, direction, driver, held, goals, vertices, owners, faces }) {
  const closure = new Closure(linkage);
  const { residual, derivatives } = closure.at(Float64Array.from(anywhere));
  const corrected = new Equations(closure, linkage).corrected(Float64Array.from(near));
  const motion = new Motion(linkage, direction && Float64Array.from(direction));
  const crossing = faces.length ? new (await import("./page/crossing.js")).Crossing({ vertices, owners, faces, edges: [] }) : null;
  const frames = goals.map((goal) => {
    const before = process.cpuUsage();
    const stopped = motion.to({ joint: driver, held }, goal);
    const used = process.cpuUsage(before);
    const took = (used.user + used.system) / 1000; // milliseconds of the processor
    const { angles, error } = motion.pose;
    const places = vertexPlaces(linkMotions(linkage, angles), vertices, owners);
    return { stopped, took, error, angles: [...angles], places: [...places], crossings: crossing?.at(places) ?? [] };
  });
  return {
    residual: [...residual],
    gathered: [...closure.gathered(derivatives, residual)],
    corrected: { angles: [...corrected.angles], error: corrected.error },
    frames,
  };
}

/** @type {Question[]} */
const questions = JSON.parse(readFileSync(0, "utf-8"));
process.stdout.write(JSON.stringify(await Promise.all(questions.map(answered))));
