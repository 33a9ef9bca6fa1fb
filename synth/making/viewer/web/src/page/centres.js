/** Spherical centres seen in space: discs for vertices of panels, rings for points, lines for directions. */

/** @import { CentreData } from "./types.js" */
/** @import { Mechanism } from "./mechanism.js" */
import * as three from "three";
import { colour } from "./colours.js";
import { gathered } from "./geometry.js";

/** Pixels of a mark; of the picture it is made of. */
const SIZE = 8, PICTURE = 64;
/** Half the length of the line of an infinite centre, in units of the extent. */
const HALF = 0.25;
/** Drawn after panels, through which they are seen. */
const LAST = 1;

export class Centres {
  constructor() {
    this.group = new three.Group();
    const looks = { sizeAttenuation: false, size: SIZE * Math.min(devicePixelRatio, 2), alphaTest: 0.5 };
    this.discs = new three.Points(
      new three.BufferGeometry(), new three.PointsMaterial({ ...looks, map: picture(false), depthTest: false }));
    this.rings = new three.Points(
      new three.BufferGeometry(), new three.PointsMaterial({ ...looks, map: picture(true), depthTest: false }));
    this.lines = new three.LineSegments(new three.BufferGeometry(), new three.LineDashedMaterial({
      dashSize: 0.02, gapSize: 0.015, depthTest: false }));
    for (const one of [this.discs, this.rings, this.lines]) one.renderOrder = LAST;
    this.group.add(this.discs, this.rings, this.lines);
    /** @type {number[][]} - Points at the pose of the file: one of each centre, two of an infinite one. */
    this.points = [];
    /** @type {number[]} */
    this.owners = [];
    /** @type {number[]} - The point of each centre. */
    this.first = [];
    /** @type {ArrayLike<number>} */
    this.places = [];
  }

  /** @param {CentreData[]} centres */
  show(centres) {
    [this.points, this.owners, this.first] = [[], [], []];
    for (const { place, direction, link } of centres) {
      this.first.push(this.points.length);
      const ends = direction === null ? [place] : [-HALF, HALF].map((t) => place.map((x, i) => x + t * direction[i]));
      this.points.push(...ends);
      this.owners.push(...ends.map(() => link));
    }
    const numbers = this.points.map((_, n) => n);
    const of = (/** @type {string[]} */ ...kinds) => Int32Array.from(centres.flatMap(({ kind }, n) => (
      kinds.includes(kind) ? numbers.slice(this.first[n], this.first[n + 1]) : [])));
    this.drawn = /** @type {[three.Points | three.LineSegments, Int32Array][]} */ ([
      [this.discs, of("explicit")], [this.rings, of("implicit", "finite")], [this.lines, of("infinite")],
    ]);
    for (const [shape, corners] of this.drawn) {
      shape.geometry.dispose();
      shape.geometry = new three.BufferGeometry();
      shape.geometry.setAttribute("position", new three.BufferAttribute(new Float32Array(3 * corners.length), 3));
      shape.visible = corners.length > 0;
      shape.frustumCulled = false;
    }
  }

  /** @param {Mechanism} mechanism */
  moved(mechanism) {
    this.places = mechanism.carried(this.points, this.owners);
    for (const [shape, corners] of this.drawn ?? []) {
      const position = shape.geometry.attributes.position;
      gathered(this.places, corners, /** @type {Float32Array} */ (position.array));
      position.needsUpdate = true;
    }
    if (this.lines.visible) this.lines.computeLineDistances();
  }

  coloured() {
    for (const one of [this.discs, this.rings, this.lines]) one.material.color.set(colour("centre"));
  }

  /**
   * Return where a centre is, or the middle of its line.
   *
   * @param {number} centre
   */
  placeOf(centre) {
    const from = this.first[centre], to = this.first[centre + 1] ?? this.points.length;
    const place = new three.Vector3();
    for (let n = from; n < to; n++) {
      place.add(new three.Vector3().fromArray(this.places, 3 * n).divideScalar(to - from));
    }
    return place;
  }
}

/**
 * Return the picture of a disc or a ring.
 *
 * @param {boolean} hollow
 */
function picture(hollow) {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = PICTURE;
  const pen = canvas.getContext("2d");
  if (pen) {
    pen.arc(PICTURE / 2, PICTURE / 2, (hollow ? 0.36 : 0.46) * PICTURE, 0, 2 * Math.PI);
    pen.fillStyle = pen.strokeStyle = "#ffffff";
    pen.lineWidth = 0.2 * PICTURE;
    if (hollow) pen.stroke();
    else pen.fill();
  }
  return new three.CanvasTexture(canvas);
}
