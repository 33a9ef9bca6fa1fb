/** What a site of an atlas chooses; what it shows is tested in a browser: tests/synth/synthesis/atlas. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { choiceOf, chosen, everything, hashOf, searchedText } from "../src/gallery/choice.js";

const data = {
  title: "", about: "", says: {}, digits: 1,
  columns: {
    id: ["k1:Cr", "m1:ab", "m1:a-", "RR-R"],
    kind: ["chain", "sc", "scd", "string"],
    name: ["four-bar", null, "Watt; six bar", "UR"],
    links: [4, 4, 6, 4],
    centres: [null, 1, 2, null],
    all_explicit: [null, null, true, null],
  },
};
const searched = searchedText(data);
/** @param {Partial<import("../src/gallery/types.js").Choice>} said */
const places = (said) => chosen(data, searched, { ...everything(), ...said });

test("words have all to be there, in any order and case", () => {
  assert.deepEqual(places({ text: "WATT six" }), [2]);
  assert.deepEqual(places({ text: "watt eight" }), []);
  assert.deepEqual(places({ text: "m1:" }), [1, 2]);
});

test("kinds, ranges and flags", () => {
  assert.deepEqual(places({ kind: "sc" }), [1]);
  assert.deepEqual(places({ ranges: { links: [4, 5] } }), [0, 1, 3]);
  assert.deepEqual(places({ ranges: { centres: [-Infinity, 1] } }), [1]);
  assert.deepEqual(places({ flags: ["all_explicit"] }), [2]);
  assert.deepEqual(places({ flags: ["name"] }), [0, 2, 3]);
});

test("what has no value comes last, however it is sorted", () => {
  assert.deepEqual(places({ sort: "centres" }), [1, 2, 0, 3]);
  assert.deepEqual(places({ sort: "-centres" }), [2, 1, 0, 3]);
  assert.deepEqual(places({ sort: "-links" }), [2, 0, 1, 3]);
  assert.deepEqual(places({ sort: "nothing" }), [0, 1, 2, 3]);
});

test("an address says what was chosen, and is read again", () => {
  const choice = { text: "a&b = c", kind: "scd", ranges: { links: [6, Infinity], dof: [1, 1] }, flags: ["realised"], sort: "-dof" };
  assert.deepEqual(choiceOf(`#${hashOf(/** @type {any} */ (choice))}`), choice);
  assert.deepEqual(choiceOf("#links=6"), { ...everything(), ranges: { links: [6, 6] } });
  assert.deepEqual(choiceOf("#links=x..&nothing=1&all_explicit=no"), everything());
});

test("ten thousand types are filtered in a moment", () => {
  const many = 10_000;
  /** @param {any[]} values */
  const repeated = (values) => Array.from({ length: many }, (_, n) => values[n % values.length]);
  const large = { ...data, columns: Object.fromEntries(Object.entries(data.columns).map(([name, values]) => [name, repeated(values)])) };
  const text = searchedText(large);
  assert.equal(chosen(large, text, { ...everything(), text: "m1", sort: "-links" }).length, many / 2);
});
