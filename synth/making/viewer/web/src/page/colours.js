/** Colours of the page, read from its style: light and dark are told there alone. */

/** @type {Map<string, string>} - Those that were asked for: to look one up takes as long as to draw a panel. */
const found = new Map();

/**
 * Return a colour of the style.
 *
 * @param {string} name - Without its dashes.
 */
export function colour(name) {
  const known = found.get(name);
  if (known !== undefined) return known;
  const read = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  found.set(name, read);
  return read;
}

/** Look colours up anew, since the style has become light or dark. */
export function forgetColours() {
  found.clear();
}

/** Names of the colours of clusters, which are used again where there are more. */
const CLUSTERS = 6;

/** @param {number} cluster */
export function clusterColour(cluster) {
  return colour(`cluster-${cluster % CLUSTERS}`);
}

/** @type {Record<string, string>} */
const LETTERS = { M: "mountain", V: "valley", B: "border", C: "cut", F: "flat", J: "flat", "-": "axis", "|": "side" };

/** @param {string} letter - Of an edge. */
export function letterColour(letter) {
  return colour(LETTERS[letter] ?? "unassigned");
}
