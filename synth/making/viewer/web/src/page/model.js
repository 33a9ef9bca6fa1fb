/** The pane in space: panels and creases of a mechanism, seen from where one likes. */

/** @import { Mechanism } from "./mechanism.js" */
import * as three from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { farthestFrom, middleOf, middleOfBox, radiusOf, turnBack } from "./aligned.js";
import { Centres } from "./centres.js";
import { clusterColour, colour, letterColour } from "./colours.js";
import { gathered, trianglesOf } from "./geometry.js";

const LINE = 2, CHOSEN = 5;
const EAST = new three.Vector3(1, 0, 0);
/** From where a model is looked at first. */
const FROM = new three.Vector3(0.45, -1.15, 1.05).normalize();
/** Of what is shown, in units of the extent, at least. */
const LEAST = 0.2;
const TURN = 0.1, ZOOM = 1.1;
/** The axis of a cone or a cylinder is y in its data, and upwards on the page. */
const UPRIGHT = new three.Quaternion().setFromAxisAngle(EAST, Math.PI / 2);
const LYING = new three.Quaternion();
const SEEN_THROUGH = 0.22;
/** How bright the back of a marked panel is, of its front. */
const BACK = 0.6;

export class Model {
  /** The request to draw that is not yet answered; 0: none. */
  #drawing = 0;

  /**
   * @param {HTMLElement} pane
   * @throws {Error} If there is no WebGL.
   */
  constructor(pane) {
    this.renderer = new three.WebGLRenderer({ antialias: true });
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    pane.append(this.canvas);
    this.pane = pane;
    this.scene = new three.Scene();
    this.camera = new three.PerspectiveCamera(32, 1, 0.01, 100);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.addEventListener("change", () => this.render());
    this.light = new three.DirectionalLight(0xffffff, 2.2);
    this.scene.add(new three.HemisphereLight(0xffffff, 0x888888, 1.6), this.light);
    this.group = new three.Group();
    /** @type {number[]} - A quaternion. */
    this.turn = [0, 0, 0, 1];
    this.scene.add(this.group);
    this.upright = LYING;
    /** @type {number[] | null} - Corners of triangles of the cone or cylinder. */
    this.surface = null;
    this.chosen = { joint: -1, link: -1 };
    /** @type {Set<number>} - Links that pass through others. */
    this.crossed = new Set();
    this.centres = new Centres();
    this.fitted = LEAST;
    this.canvas.addEventListener("keydown", (event) => this.#key(event));
    new ResizeObserver(() => this.#resize()).observe(pane);
  }

  /**
   * Show a mechanism.
   *
   * @param {Mechanism} mechanism
   */
  show(mechanism) {
    this.mechanism = mechanism;
    const { bodies } = mechanism.data;
    this.first = Float64Array.from(bodies.vertices.flat());
    this.turn = [0, 0, 0, 1];
    this.triangles = trianglesOf(bodies);
    this.drawn = bodies.edges.filter((edge) => edge.joint >= 0 || "BC|".includes(edge.letter));
    this.ends = Int32Array.from(this.drawn.flatMap((edge) => edge.ends));
    const panels = new three.BufferGeometry();
    for (const name of ["position", "color"]) {
      panels.setAttribute(name, new three.BufferAttribute(new Float32Array(3 * this.triangles.corners.length), 3));
    }
    this.panels = panels;
    this.backs = new three.BufferGeometry();
    this.backs.setAttribute("position", panels.attributes.position);
    this.backs.setAttribute("color", panels.attributes.color.clone());
    const look = { vertexColors: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2 };
    const front = new three.MeshLambertMaterial({ ...look, side: three.FrontSide });
    const back = new three.MeshLambertMaterial({ ...look, side: three.BackSide });
    this.mesh = new three.Mesh(panels, front);
    const pen = new LineMaterial({ linewidth: LINE, vertexColors: true });
    this.lines = new LineSegments2(new LineSegmentsGeometry(), pen);
    this.mark = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({ linewidth: CHOSEN }));
    this.group.clear();
    this.upright = bodies.surface ? UPRIGHT : LYING;
    this.surface = bodies.surface ? bodies.surface.flat(2) : null;
    if (this.surface) this.group.add(surfaceMesh(this.surface));
    this.centres.show(mechanism.data.centres);
    this.group.add(this.mesh, new three.Mesh(this.backs, back), this.lines, this.mark, this.centres.group);
    this.crossed = new Set();
    this.coloured();
    this.fit();
  }

  /** Look at all of the mechanism wherever the driven joint takes it, as it was looked at first. */
  fit() {
    const over = this.mechanism?.largestOnPath((places) => this.#radius(places)) ?? 0;
    const radius = Math.max(LEAST, over, this.#radius(this.mechanism?.places ?? []));
    this.fitted = radius;
    const half = Math.atan(Math.tan((this.camera.fov * Math.PI) / 360) * Math.min(1, this.camera.aspect));
    this.camera.position.copy(FROM).multiplyScalar(radius / Math.sin(half));
    this.controls.target.set(0, 0, 0);
    this.controls.update();
    this.moved();
  }

  /** Show where everything is now. */
  moved() {
    const { mechanism, panels, triangles, ends, first, turn, lines } = this;
    if (!mechanism || !panels || !triangles || !ends || !first || !turn || !lines) return;
    gathered(mechanism.places, triangles.corners, /** @type {Float32Array} */ (panels.attributes.position.array));
    panels.attributes.position.needsUpdate = true;
    panels.computeVertexNormals();
    panels.computeBoundingSphere();
    this.backs?.setAttribute("normal", panels.attributes.normal);
    if (this.backs) this.backs.boundingSphere = panels.boundingSphere;
    const row = new Float32Array(3 * ends.length);
    gathered(mechanism.places, ends, row);
    lines.geometry.setPositions(row);
    this.centres.moved(mechanism);
    // A surface stays, and links move from it
    this.turn = this.surface ? turn : turnBack(mechanism.places, first, turn);
    const [x, y, z, w] = this.turn;
    this.group.quaternion.set(x, y, z, w).premultiply(this.upright);
    const [a, b, c] = this.surface ? middleOfBox(this.surface) : middleOf(mechanism.places);
    this.group.position.copy(new three.Vector3(a, b, c).applyQuaternion(this.group.quaternion).negate());
    this.group.updateMatrixWorld();
    this.#marked();
    this.#kept();
    this.render();
  }

  /** Give everything its colour: of clusters, letters, immobile joints, and of what is chosen. */
  coloured() {
    const { mechanism, panels, triangles, lines, drawn } = this;
    if (!mechanism || !panels || !triangles || !lines || !drawn) return;
    this.scene.background = new three.Color(colour("pane"));
    for (const side of /** @type {const} */ (["front", "back"])) {
      const colours = (side === "front" ? panels : this.backs ?? panels).attributes.color;
      triangles.faces.forEach((face, n) => {
        const shade = this.#faceColour(mechanism.data.bodies.faces[face].link, side);
        for (let corner = 3 * n; corner < 3 * n + 3; corner++) colours.setXYZ(corner, shade.r, shade.g, shade.b);
      });
      colours.needsUpdate = true;
    }
    const row = drawn.flatMap(({ letter, joint }) => {
      const shade = new three.Color(mechanism.immobile.has(joint) ? colour("immobile") : letterColour(letter));
      return [shade.r, shade.g, shade.b, shade.r, shade.g, shade.b];
    });
    const positions = new Float32Array(3 * (this.ends?.length ?? 0));
    gathered(mechanism.places, this.ends ?? [], positions);
    lines.geometry.setPositions(positions);
    lines.geometry.setColors(row);
    this.mark?.material.color.set(colour("chosen"));
    this.centres.coloured();
    this.#marked();
    this.render();
  }

  /**
   * Mark a joint or a link; -1: none.
   *
   * @param {{joint: number, link: number}} chosen
   */
  choose(chosen) {
    this.chosen = chosen;
    this.coloured();
  }

  /**
   * Colour the links that pass through others.
   *
   * @param {Set<number>} links
   */
  cross(links) {
    if (links.size === this.crossed.size && [...links].every((link) => this.crossed.has(link))) return;
    this.crossed = links;
    this.coloured();
  }

  /** @param {boolean} shown - Whether centres are. */
  showCentres(shown) {
    this.centres.group.visible = shown;
    this.render();
  }

  /**
   * Return where on the canvas a place of the mechanism is seen, in pixels of the page, and how far off it is.
   *
   * @param {ArrayLike<number>} places
   * @param {number} vertex
   */
  seen(places, vertex) {
    return this.seenAt(new three.Vector3(places[3 * vertex], places[3 * vertex + 1], places[3 * vertex + 2]));
  }

  /** @param {three.Vector3} place */
  seenAt(place) {
    const { width, height, left, top } = this.canvas.getBoundingClientRect();
    const at = place.clone().applyMatrix4(this.group.matrixWorld).project(this.camera);
    return { x: left + ((at.x + 1) / 2) * width, y: top + ((1 - at.y) / 2) * height, depth: at.z };
  }

  /**
   * Return the panel under a place of the page, with the triangle and the place of it that are hit.
   *
   * @param {number} x
   * @param {number} y
   */
  panelAt(x, y) {
    const { mesh, triangles, mechanism } = this;
    if (!mesh || !triangles || !mechanism) return null;
    const { width, height, left, top } = this.canvas.getBoundingClientRect();
    const pointer = new three.Vector2(((x - left) / width) * 2 - 1, 1 - ((y - top) / height) * 2);
    const caster = new three.Raycaster();
    caster.setFromCamera(pointer, this.camera);
    const sides = this.group.children.filter((one) => one instanceof three.Mesh && [this.panels, this.backs].includes(one.geometry));
    const [hit] = caster.intersectObjects(sides, false);
    if (!hit || hit.faceIndex == null) return null;
    const face = mechanism.data.bodies.faces[triangles.faces[hit.faceIndex]];
    const corners = [...triangles.corners.subarray(3 * hit.faceIndex, 3 * hit.faceIndex + 3)];
    const place = this.group.worldToLocal(hit.point.clone());
    return { link: face.link, corners, place, depth: hit.point.project(this.camera).z };
  }

  /** Draw it before the next picture, once, however much changes until then. */
  render() {
    this.#drawing ||= requestAnimationFrame(() => this.#draw());
  }

  /** Return what is seen now, as PNG. */
  picture() {
    this.#draw();
    return new Promise((/** @type {(blob: Blob | null) => void} */ made) => this.canvas.toBlob(made));
  }

  #draw() {
    cancelAnimationFrame(this.#drawing);
    this.#drawing = 0;
    this.light.position.copy(this.camera.position).add(new three.Vector3(0.4, 0.2, 0.9));
    this.renderer.render(this.scene, this.camera);
  }

  #marked() {
    const { mechanism, drawn, mark } = this;
    if (!mechanism || !drawn || !mark) return;
    const joint = this.chosen.joint;
    const ends = drawn.filter((edge) => edge.joint === joint && joint >= 0).flatMap((edge) => edge.ends);
    mark.visible = ends.length > 0;
    if (!ends.length) return;
    const row = new Float32Array(3 * ends.length);
    gathered(mechanism.places, ends, row);
    mark.geometry.setPositions(row);
  }

  /**
   * Return the colour of a side of a link: of panels as in pictures, unless they are marked.
   *
   * @param {number} link
   * @param {"front" | "back"} side
   */
  #faceColour(link, side) {
    const { mechanism } = this, sheet = mechanism?.data.solver.limited ?? false;
    const marked = this.#markColour(link);
    if (marked === null) return new three.Color(colour(sheet ? `paper-${side}` : "panel"));
    return new three.Color(marked).multiplyScalar(sheet && side === "back" ? BACK : 1);
  }

  /** @param {number} link */
  #markColour(link) {
    if (link === this.chosen.link) return colour("chosen-panel");
    if (this.crossed.has(link)) return colour("crossed");
    if (this.mechanism?.data.bodies.surface) return clusterColour(link);
    const cluster = this.mechanism?.clusterOf.get(link);
    return cluster === undefined ? null : clusterColour(cluster);
  }

  /** Go farther off where a mechanism grows beyond what was fitted. */
  #kept() {
    const radius = this.#radius(this.mechanism?.places ?? []);
    if (radius <= this.fitted) return;
    const { target } = this.controls;
    this.camera.position.sub(target).multiplyScalar(radius / this.fitted).add(target);
    this.fitted = radius;
    this.controls.update();
  }

  /**
   * Return the radius of what is shown, about the middle of the view.
   *
   * @param {ArrayLike<number>} places - Of the corners.
   */
  #radius(places) {
    if (!this.surface) return radiusOf(places);
    const middle = middleOfBox(this.surface);
    return Math.max(farthestFrom(middle, this.surface), farthestFrom(middle, places));
  }

  #resize() {
    const { clientWidth, clientHeight } = this.pane;
    if (!clientWidth || !clientHeight) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(clientWidth, clientHeight);
    const before = this.camera.aspect;
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    if (before === 1) this.fit();
    else this.render();
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const upwards = this.camera.position.clone().applyAxisAngle(EAST, -Math.PI / 2); // spherical ones have y up
    const at = new three.Spherical().setFromVector3(upwards);
    if (event.key === "ArrowLeft") at.theta -= TURN;
    else if (event.key === "ArrowRight") at.theta += TURN;
    else if (event.key === "ArrowUp") at.phi -= TURN;
    else if (event.key === "ArrowDown") at.phi += TURN;
    else if (event.key === "+") at.radius /= ZOOM;
    else if (event.key === "-") at.radius *= ZOOM;
    else return;
    event.preventDefault();
    at.makeSafe();
    this.camera.position.setFromSpherical(at).applyAxisAngle(EAST, Math.PI / 2);
    this.controls.update();
    this.render();
  }
}

/**
 * Return a surface through which links behind it are seen.
 *
 * @param {number[]} corners - Of its triangles, three numbers each.
 */
function surfaceMesh(corners) {
  const geometry = new three.BufferGeometry();
  geometry.setAttribute("position", new three.BufferAttribute(Float32Array.from(corners), 3));
  geometry.computeVertexNormals();
  const look = { color: 0x888888, transparent: true, opacity: SEEN_THROUGH, depthWrite: false };
  return new three.Mesh(geometry, new three.MeshLambertMaterial({ ...look, side: three.DoubleSide }));
}
