/** Edits of what is seen on the workbench: creases locked, removed, added; ride-alongs taken off; templates. */

/** @import { DrawnData } from "./types.js" */
/** @import { Paged, Source } from "./workbench.js" */
import { element } from "./layout.js";

const TYPED = "vertex, or x,y";
/** Millimetres. */
const SIZE = "150";

/**
 * What is asked of the workbench.
 *
 * @typedef {object} Asked
 * @property {(edit: string) => void} edit
 * @property {() => void} undo
 * @property {() => void} motion
 * @property {(kind: string, size: number) => void} template
 */

export class Editing {
  /**
   * @param {Paged} page
   * @param {Asked} asked
   */
  constructor(page, asked) {
    this.page = page;
    this.asked = asked;
    /** @type {DrawnData | null} - The pattern that is seen. */
    this.drawn = null;
    /** @type {Map<string, [number, number]>} - Where in the drawing ends of creases are. */
    this.picked = new Map();
    this.motion = button("Look for its motion", () => asked.motion());
    this.lock = button("Lock joint", () => this.#edit("lock"));
    this.remove = button("Remove joint", () => this.#edit("remove"));
    this.add = button("Add crease ...", () => this.#open(Boolean(this.form.hidden)));
    this.rideAlongs = button("Ride-alongs off", () => asked.edit("ride-alongs"));
    this.undo = button("Undo", () => asked.undo());
    this.from = element("input", { type: "text", size: "14", "aria-label": "Crease from", placeholder: TYPED });
    this.to = element("input", { type: "text", size: "14", "aria-label": "Crease to", placeholder: TYPED });
    this.form = element("form", { class: "row", hidden: "" }, "Click two places in the drawing, or type: from",
      this.from, "to", this.to, element("button", { type: "submit" }, "Crease"));
    this.size = element("input", { type: "number", min: "1", value: SIZE, "aria-label": "Size of the template, mm" });
    const kinds = ["PDF", "SVG", "DXF"].map((kind) => button(kind, () => this.#print(kind.toLowerCase())));
    this.template = element("span", { class: "save" }, "Template", this.size, "mm", ...kinds);
    this.group = element("div", { class: "row edits", role: "group", "aria-label": "Edits" },
      this.motion, this.lock, this.remove, this.add, this.rideAlongs, this.undo, this.template);
    this.form.addEventListener("submit", (event) => { event.preventDefault(); this.#crease(); });
    for (const field of [this.from, this.to]) field.addEventListener("input", () => this.#mark());
  }

  get parts() {
    return [this.group, this.form];
  }

  /**
   * Tell what can be done with what is seen now.
   *
   * @param {Source | null} source
   * @param {boolean} undoable - Whether there is a change to take back.
   */
  changed(source, undoable) {
    const seen = this.page.seen();
    this.group.hidden = !source;
    this.lock.disabled = this.remove.disabled = this.page.joint() === null;
    this.undo.disabled = !undoable;
    this.motion.hidden = !seen.on_request;
    if (!source) this.#open(false);
    if (this.drawn !== seen.drawn) this.#clear();
    this.drawn = seen.drawn;
  }

  /** Forget the ends of a crease: they were of another pattern, or have been used. */
  #clear() {
    this.from.value = this.to.value = "";
    this.picked.clear();
  }

  /** @param {"lock" | "remove"} what - Is done with the joint that was clicked last. */
  #edit(what) {
    const joint = this.page.joint();
    if (joint !== null) this.asked.edit(`${what}:${joint}`);
  }

  /** @param {boolean} open - Whether ends of a crease are asked for. */
  #open(open) {
    this.form.hidden = !open;
    this.#clear();
    this.page.pick(open ? (x, y, near) => this.#picked(x, y, near) : null);
    this.#mark();
    if (open) this.from.focus();
  }

  /**
   * @param {number} x
   * @param {number} y
   * @param {number} near - How near a vertex is to be.
   */
  #picked(x, y, near) {
    if (!this.drawn) return;
    const field = this.from.value && !this.to.value ? this.to : this.from;
    if (field === this.from) this.to.value = "";
    const { named, place } = snapped(this.drawn, [x, y], near);
    field.value = named;
    this.picked.set(named, place);
    this.#mark();
  }

  /** Mark the ends that are known in the drawing: vertices, and points that were clicked there. */
  #mark() {
    const ends = [this.from, this.to].map(({ value }) => this.picked.get(value) ?? this.drawn?.places[Number(value || -1)]);
    this.page.mark(ends.filter((place) => place !== undefined));
  }

  #crease() {
    const [from, to] = [this.from, this.to].map((field) => field.value.replace(/\s/g, ""));
    if (!from || !to) return;
    this.asked.edit(`crease:${from}~${to}`);
    this.#open(false);
  }

  /** @param {string} kind */
  #print(kind) {
    if (this.size.reportValidity()) this.asked.template(kind, this.size.valueAsNumber);
  }
}

/**
 * @param {string} told
 * @param {() => void} pressed
 */
function button(told, pressed) {
  const made = element("button", { type: "button" }, told);
  made.addEventListener("click", pressed);
  return made;
}

/**
 * Return the vertex near to a place of the drawing, or the nearest point of an edge: as edits name it, and where in
 * the drawing it is.
 *
 * @param {DrawnData} drawn
 * @param {[number, number]} place
 * @param {number} near
 * @returns {{named: string, place: [number, number]}}
 */
export function snapped({ vertices, edges, places }, [x, y], near) {
  const offs = places.map(([px, py]) => Math.hypot(px - x, py - y));
  const nearest = offs.indexOf(Math.min(...offs));
  let found = { named: String(nearest), place: places[nearest] };
  if (offs[nearest] <= near) return found;
  let best = offs[nearest];
  for (const [a, b] of edges) {
    const [ax, ay] = places[a], [bx, by] = places[b];
    const [ux, uy] = [bx - ax, by - ay];
    const part = Math.min(1, Math.max(0, ((x - ax) * ux + (y - ay) * uy) / (ux * ux + uy * uy || 1)));
    const off = Math.hypot(ax + part * ux - x, ay + part * uy - y);
    if (off >= best) continue;
    best = off;
    const point = vertices[a].map((from, i) => from + part * (vertices[b][i] - from));
    found = { named: point.join(","), place: [ax + part * ux, ay + part * uy] };
  }
  return found;
}
