/**
 * What a site of an atlas says of its types; it is written by synth.synthesis.atlas.site_pages.
 *
 * @typedef {object} AtlasData
 * @property {string} title
 * @property {string} about How the atlas was made.
 * @property {Record<string, (string | number | boolean | null)[]>} columns A value for each type; `id` and `kind` are there.
 * @property {Record<string, string>} says What a column holds, in words.
 * @property {number} digits Of the numbers in names of files.
 */

/**
 * What a visitor has chosen.
 *
 * @typedef {object} Choice
 * @property {string} text Words that all have to be in id, name or kind.
 * @property {string} kind Or nothing.
 * @property {Record<string, [number, number]>} ranges Least and greatest of a column of numbers.
 * @property {string[]} flags Columns that have to be true.
 * @property {string} sort A column; with `-` before it, falling; or nothing.
 */

export {};
