/**
 * The data of a page: docs/theory/viewer.md.
 *
 * @import { LinkageData } from "../solver/types.js"
 *
 * @typedef {object} BodyData
 * @property {number[][]} vertices - At the pose of the file, in units of the extent.
 * @property {number[]} owners - The link that carries each; -1 for none.
 * @property {{link: number, vertices: number[]}[]} faces
 * @property {{ends: [number, number], letter: string, joint: number}[]} edges - Joint -1: none.
 * @property {number[][][] | null} [surface] - Corners of triangles of the cone or cylinder that a linkage lies on.
 *
 * @typedef {object} WayData
 * @property {string} told
 * @property {number[]} rates
 * @property {number[]} immobile - Places of joints.
 * @property {number[]} drivers - Of independent ones, one for each freedom; the first begins fastest.
 * @property {number | null} freedoms - Null: not known.
 *
 * @typedef {object} WaysData
 * @property {WayData[]} all
 * @property {boolean} singular
 * @property {number} taken
 *
 * @typedef {object} CentreData
 * @property {"explicit" | "implicit" | "finite" | "infinite"} kind
 * @property {number[]} place - At the pose of the file; of an infinite one among those of its axes that the link carries.
 * @property {number[] | null} direction - Of the axes of an infinite one.
 * @property {number} link - One that carries it.
 * @property {number[]} joints - Those whose axes pass through it.
 * @property {number} loops - How many share it.
 *
 * @typedef {object} MovingData
 * @property {LinkageData} solver
 * @property {BodyData} bodies
 * @property {WaysData | null} ways
 * @property {CentreData[]} centres
 * @property {string[]} joints
 * @property {string[]} links
 * @property {[number, number][]} between - The links that each joint joins, by their places.
 * @property {number} extent
 * @property {number[]} middle
 *
 * @typedef {object} DrawnData
 * @property {number[][]} vertices - Coordinates as the file has them.
 * @property {[number, number][]} edges
 * @property {[number, number][]} places - Of the vertices in the picture, in its unit.
 *
 * @typedef {object} FlatComponentData
 * @property {number[]} panels
 * @property {string} orders - How many there are.
 * @property {Record<string, number[]>[]} listed - Of each order that is listed the cells in which it is another than in the first.
 *
 * @typedef {object} FlatData
 * @property {string} told
 * @property {[number, number][]} nodes - Of the folded image, in units of the extent, seen from the front.
 * @property {number[][]} cells - The nodes round each.
 * @property {boolean[]} flipped - Whether each panel shows its back.
 * @property {number[][]} stacks - The panels over each cell, from the lowest up, in the first order.
 * @property {FlatComponentData[]} components - Those with several orders.
 *
 * @typedef {object} ShownData
 * @property {string} name
 * @property {string} verdict
 * @property {string} report
 * @property {string[]} notes
 * @property {{light?: string, dark?: string}} pictures
 * @property {MovingData | null} moving
 * @property {object | null} configuration - Where it moves from, and on which branch first, as in docs/command-json.md.
 * @property {string[]} immobile
 * @property {string[][]} clusters
 * @property {DrawnData | null} drawn - Of a crease pattern in a plane.
 * @property {FlatData | null} flat - Of a crease pattern that folds flat.
 * @property {boolean} on_request - Whether it is so large that its motion is looked for on request only.
 * @property {string} answer - JSON: what `synth mobility --json` prints.
 *
 * @typedef {object} PageData
 * @property {ShownData[]} shown
 * @property {boolean} workbench - Whether there is a workbench behind the page.
 */
export {};
