/** Poses saved: as a FOLD file, as an OBJ file, as a picture. */

/** @import { Mechanism } from "./mechanism.js" */
/** @import { ShownData } from "./types.js" */

const DEGREES = 180 / Math.PI;
/** Letters that FOLD knows; sides of bodies are borders. */
const LETTERS = "BMVFCUJ";

/**
 * Return the pose as FOLD (file_spec 1.2).
 *
 * @param {ShownData} shown
 * @param {Mechanism} mechanism
 */
export function foldText(shown, mechanism) {
  const { edges, faces } = mechanism.data.bodies;
  return JSON.stringify({
    file_spec: 1.2,
    file_creator: "synthedra",
    file_title: shown.name,
    frame_classes: ["foldedForm"],
    frame_attributes: ["3D"],
    vertices_coords: placesOf(mechanism),
    edges_vertices: edges.map(({ ends }) => ends),
    edges_assignment: edges.map(({ letter }) => (LETTERS.includes(letter) ? letter : "B")),
    edges_foldAngle: edges.map(({ joint }) => (joint < 0 ? null : mechanism.motion.pose.angles[joint] * DEGREES)),
    faces_vertices: faces.map(({ vertices }) => vertices),
  });
}

/**
 * Return the pose as OBJ.
 *
 * @param {Mechanism} mechanism
 */
export function objText(mechanism) {
  const places = placesOf(mechanism).map((place) => `v ${place.join(" ")}`);
  const faces = mechanism.data.bodies.faces.map(({ vertices }) => `f ${vertices.map((n) => n + 1).join(" ")}`);
  return [...places, ...faces, ""].join("\n");
}

/**
 * Return where vertices are, in the unit of the file.
 *
 * @param {Mechanism} mechanism
 */
export function placesOf({ places, data }) {
  return data.bodies.vertices.map((_, n) => data.middle.map((x, i) => x + data.extent * places[3 * n + i]));
}

/**
 * Give what was made to the reader of the page.
 *
 * @param {Blob} blob
 * @param {string} name - Of the file, its extension included.
 */
export function saved(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name.replace(/[^\w.-]+/g, "_");
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
