/** What a visitor has chosen, as the end of an address, and the types that fulfil it. */

/** @import { AtlasData, Choice } from "./types.js" */

/** Columns of numbers that a range is chosen of. */
export const RANGES = ["links", "joints", "dof", "centres", "symmetry", "ride_alongs", "fold_deg"];
/** Columns that are true or not; a name counts as true. */
export const FLAGS = ["all_explicit", "realised", "name"];

/** @returns {Choice} One of everything. */
export function everything() {
  return { text: "", kind: "", ranges: {}, flags: [], sort: "" };
}

/**
 * Read the end of an address; what it does not know, or is no number, is left out.
 *
 * @param {string} hash With or without `#`.
 * @returns {Choice}
 */
export function choiceOf(hash) {
  const choice = everything();
  for (const [name, value] of new URLSearchParams(hash.replace(/^#/, ""))) {
    if (name === "text" || name === "kind" || name === "sort") choice[name] = value;
    else if (FLAGS.includes(name) && value === "yes") choice.flags.push(name);
    else if (RANGES.includes(name)) {
      const [least, greatest = least] = value.split("..");
      /** @type {[number, number]} */
      const range = [least ? Number(least) : -Infinity, greatest ? Number(greatest) : Infinity];
      if (!range.some(Number.isNaN)) choice.ranges[name] = range;
    }
  }
  return choice;
}

/**
 * @param {Choice} choice
 * @returns {string} The end of an address, without `#`.
 */
export function hashOf(choice) {
  const parts = new URLSearchParams();
  if (choice.text) parts.set("text", choice.text);
  if (choice.kind) parts.set("kind", choice.kind);
  for (const [name, [least, greatest]] of Object.entries(choice.ranges)) {
    parts.set(name, `${Number.isFinite(least) ? least : ""}..${Number.isFinite(greatest) ? greatest : ""}`);
  }
  for (const name of choice.flags) parts.set(name, "yes");
  if (choice.sort) parts.set("sort", choice.sort);
  return parts.toString();
}

/**
 * @param {AtlasData} data
 * @returns {string[]} Of each type, what words are looked for in.
 */
export function searchedText(data) {
  const { id, kind, name } = data.columns;
  return id.map((code, n) => `${code} ${kind[n]} ${name?.[n] ?? ""}`.toLowerCase());
}

/**
 * @param {AtlasData} data
 * @param {string[]} searched What `searchedText` gives.
 * @param {Choice} choice
 * @returns {number[]} Places of the types that fulfil it, in its order; those without a value there come last.
 */
export function chosen(data, searched, choice) {
  const words = choice.text.toLowerCase().split(/\s+/).filter(Boolean);
  const ranges = Object.entries(choice.ranges).filter(([name]) => data.columns[name]);
  const flags = choice.flags.filter((name) => data.columns[name]);
  const found = [];
  for (let n = 0; n < searched.length; n++) {
    if (choice.kind && data.columns.kind[n] !== choice.kind) continue;
    if (!words.every((word) => searched[n].includes(word))) continue;
    if (!flags.every((name) => data.columns[name][n])) continue;
    if (ranges.every(([name, range]) => isWithin(data.columns[name][n], range))) found.push(n);
  }
  return choice.sort ? sorted(found, data, choice.sort) : found;
}

/**
 * @param {string | number | boolean | null} value
 * @param {[number, number]} range
 */
function isWithin(value, [least, greatest]) {
  return typeof value === "number" && value >= least && value <= greatest;
}

/**
 * @param {number[]} places
 * @param {AtlasData} data
 * @param {string} sort
 */
function sorted(places, data, sort) {
  const falling = sort.startsWith("-");
  const values = data.columns[sort.replace(/^-/, "")];
  if (!values) return places;
  const known = places.filter((n) => values[n] !== null);
  const rest = places.filter((n) => values[n] === null);
  known.sort((a, b) => {
    const [one, other] = [values[a], values[b]];
    const order = one === other ? a - b : /** @type {any} */ (one) < /** @type {any} */ (other) ? -1 : 1;
    return falling && one !== other ? -order : order;
  });
  return [...known, ...rest];
}
