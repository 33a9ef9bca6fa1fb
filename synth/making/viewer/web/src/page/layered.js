/** A sheet folded flat as shapes of a picture: what is seen of the layers, in the orders that are chosen. */

/** @import { FlatData } from "./types.js" */

/** @typedef {"front" | "back" | "x-ray" | "light" | "exploded"} View */
/** @typedef {[number, number]} Place */
/**
 * A polygon or a line; `looks` are classes of the style.
 *
 * @typedef {object} Shape
 * @property {Place[]} points
 * @property {boolean} closed
 * @property {string} looks
 * @property {number} panel - -1: none.
 * @property {number} cell - -1: none.
 * @property {number} opacity
 */

/** @type {View[]} */
export const VIEWS = ["front", "back", "x-ray", "light", "exploded"];
/** Part of the light that a layer lets through. */
const CLEAR = 0.85;
/** How exploded layers are seen: turned by an angle, and foreshortened. */
const TURN = Math.PI / 7, SHORT = 0.5;

/**
 * Return the panels over each cell, from the lowest up, in the chosen order of each component.
 *
 * @param {FlatData} flat
 * @param {number[]} chosen - Which of the listed orders each component has.
 */
export function stacksOf(flat, chosen) {
  return flat.stacks.map((base, cell) => {
    const changed = flat.components.flatMap(({ listed }, place) => {
      const stack = listed[chosen[place]][cell];
      return stack ? [stack] : [];
    });
    return changed.length > 1 ? combined(base, changed) : changed[0] ?? base;
  });
}

/**
 * Return an order with the changes of several others: each pair of panels is changed by one component at most.
 *
 * @param {number[]} base
 * @param {number[][]} changed
 */
function combined(base, changed) {
  const heights = changed.map((stack) => new Map(stack.map((panel, height) => [panel, height])));
  const lies = (/** @type {Map<number, number>} */ of, /** @type {number} */ a, /** @type {number} */ b) =>
    (of.get(a) ?? 0) < (of.get(b) ?? 0);
  const first = new Map(base.map((panel, height) => [panel, height]));
  const below = base.map((panel) => base.filter((other) => {
    if (other === panel) return false;
    const before = lies(first, other, panel);
    return heights.some((of) => lies(of, other, panel) !== before) ? !before : before;
  }).length);
  return base.map((_, place) => place).sort((a, b) => below[a] - below[b]).map((place) => base[place]);
}

/**
 * Return a height of each panel, so that it is above all panels that it lies on; null if they lie on each other in
 * a circle, as round a twist.
 *
 * @param {number[][]} stacks
 */
export function heightsOf(stacks) {
  /** @type {Map<number, Set<number>>} */
  const over = new Map();
  /** @type {Map<number, number>} */
  const waits = new Map();
  for (const stack of stacks) {
    stack.forEach((panel, place) => {
      const above = over.get(panel) ?? new Set();
      over.set(panel, above);
      if (!waits.has(panel)) waits.set(panel, 0);
      const next = stack[place + 1];
      if (next === undefined || above.has(next)) return;
      above.add(next);
      waits.set(next, (waits.get(next) ?? 0) + 1);
    });
  }
  /** @type {Map<number, number>} */
  const heights = new Map();
  const free = [...waits.keys()].filter((panel) => !waits.get(panel));
  for (const panel of free) heights.set(panel, 0);
  for (const panel of free) { // more are added while it runs
    for (const next of over.get(panel) ?? []) {
      heights.set(next, Math.max(heights.get(next) ?? 0, (heights.get(panel) ?? 0) + 1));
      const left = (waits.get(next) ?? 0) - 1;
      waits.set(next, left);
      if (!left) free.push(next);
    }
  }
  return free.length === waits.size ? heights : null;
}

/** The edges of the cells, each with the cells beside it. */
export class Edges {
  /** @param {number[][]} cells - Their nodes. */
  constructor(cells) {
    /** @type {Map<string, {ends: [number, number], beside: number[]}>} */
    const found = new Map();
    cells.forEach((nodes, cell) => nodes.forEach((one, place) => {
      const other = nodes[(place + 1) % nodes.length];
      const ends = /** @type {[number, number]} */ (one < other ? [one, other] : [other, one]);
      const edge = found.get(`${ends}`) ?? { ends, beside: [] };
      edge.beside.push(cell);
      found.set(`${ends}`, edge);
    }));
    this.all = [...found.values()];
  }
}

/**
 * Return what is seen, the farthest first; y goes down.
 *
 * @param {FlatData} flat
 * @param {number[][]} stacks
 * @param {View} view
 * @param {number} height - Of exploded layers together, in units of the extent.
 * @returns {Shape[]}
 */
export function shapesOf(flat, stacks, view, height) {
  const edges = new Edges(flat.cells).all;
  if (view === "exploded") return exploded(flat, stacks, edges, height);
  const back = view === "back";
  const place = (/** @type {number} */ node) => /** @type {Place} */ ([flat.nodes[node][0] * (back ? -1 : 1), -flat.nodes[node][1]]);
  const seen = stacks.map((stack) => (back ? stack[0] : stack.at(-1)) ?? -1);
  /** @type {Shape[]} */
  const areas = flat.cells.map((nodes, cell) => ({
    points: nodes.map(place),
    closed: true,
    looks: view === "light" ? "shade" : looksOf(flat, seen[cell], back),
    panel: seen[cell],
    cell,
    opacity: view === "light" ? 1 - CLEAR ** stacks[cell].length : 1,
  }));
  const lines = edges.flatMap(({ ends, beside }) => {
    const outline = beside.length < 2;
    const changes = outline || seen[beside[0]] !== seen[beside[1]];
    if (!changes && (view === "front" || back)) return [];
    const looks = outline ? "outline" : changes && view !== "light" ? "edge" : "hidden";
    return [lineOf(ends.map(place), looks)];
  });
  return [...areas.filter(({ panel }) => panel >= 0), ...lines];
}

/**
 * @param {Place[]} points
 * @param {string} looks
 * @returns {Shape}
 */
function lineOf(points, looks) {
  return { points, closed: false, looks, panel: -1, cell: -1, opacity: 1 };
}

/**
 * @param {FlatData} flat
 * @param {number} panel
 * @param {boolean} back - Whether it is seen from below.
 */
function looksOf(flat, panel, back) {
  return flat.flipped[panel] === back ? "paper-front" : "paper-back";
}

/**
 * @param {FlatData} flat
 * @param {number[][]} stacks
 * @param {{ends: [number, number], beside: number[]}[]} edges
 * @param {number} whole - Height of all layers.
 */
function exploded(flat, stacks, edges, whole) {
  const heights = heightsOf(stacks);
  const most = heights ? Math.max(...heights.values()) : Math.max(...stacks.map(({ length }) => length - 1));
  const gap = whole / Math.max(most, 1);
  const [cos, sin] = [Math.cos(TURN), Math.sin(TURN)];
  const at = (/** @type {number} */ node, /** @type {number} */ height) => {
    const [x, y] = flat.nodes[node];
    return /** @type {Place} */ ([x * cos - y * sin, -(x * sin + y * cos) * SHORT - height * gap]);
  };
  const heightOf = (/** @type {number} */ cell, /** @type {number} */ panel) =>
    heights?.get(panel) ?? stacks[cell].indexOf(panel);
  /** @type {Map<number, Shape[]>[]} - Areas, then lines, by heights. */
  const drawn = [new Map(), new Map()];
  const add = (/** @type {number} */ kind, /** @type {number} */ height, /** @type {Shape} */ shape) =>
    drawn[kind].set(height, [...drawn[kind].get(height) ?? [], shape]);
  stacks.forEach((stack, cell) => stack.forEach((panel) => {
    const height = heightOf(cell, panel);
    const points = flat.cells[cell].map((node) => at(node, height));
    add(0, height, { points, closed: true, looks: looksOf(flat, panel, false), panel, cell, opacity: 1 });
  }));
  for (const { ends, beside } of edges) {
    beside.forEach((cell, place) => {
      const other = beside[1 - place];
      for (const panel of stacks[cell]) {
        const height = heightOf(cell, panel);
        if (other !== undefined && stacks[other].includes(panel) && heightOf(other, panel) === height) continue;
        add(1, height, lineOf(ends.map((node) => at(node, height)), "edge"));
      }
    });
  }
  return [...drawn[0].keys()].sort((a, b) => a - b)
    .flatMap((height) => [...drawn[0].get(height) ?? [], ...drawn[1].get(height) ?? []]);
}
