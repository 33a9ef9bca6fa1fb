/**
 * Panels and creases dragged: the driven joint is turned so that what is held follows the pointer on the screen.
 *
 * A crease that is dragged becomes the driven joint. Where what is held hardly moves on the screen, as a flat sheet
 * seen from above, the pointer going up folds.
 */

/** @import { Mechanism } from "./mechanism.js" */
/** @import { Model } from "./model.js" */
import { Vector3 } from "three";

/** Pixels from a crease at which it is hit: by a mouse, by a finger. */
const NEAR = { mouse: 8, touch: 16 };
/** Pixels from a centre at which that is hit, before the creases that meet there. */
const NEAR_CENTRE = { mouse: 6, touch: 12 };
const DEPTH = 0.003;
/** Pixels before a press is a drag. */
const DRAGGED = 4;
const BESIDE = 1e-4;
/** Pixels a radian below which the pointer going up counts, and what it counts there. */
const HARDLY = 40, UPWARDS = 160;
/** Radians that one move of the pointer turns at most. */
const MOST = 0.25;

/**
 * What is held: weights of the corners of a triangle, or the middle of a crease; the centre that was hit, -1: none.
 *
 * @typedef {{joint: number, link: number, corners: number[], weights: number[], centre: number}} Held
 */

export class Dragging {
  /** @type {{held: Held, x: number, y: number, moved: boolean} | null} */
  #drag = null;

  /**
   * @param {Model} model
   * @param {{mechanism: () => Mechanism | null, folds: () => boolean, chosen: (held: Held | null) => void,
   *          changed: () => void}} page
   */
  constructor(model, page) {
    this.model = model;
    this.page = page;
    const canvas = model.canvas;
    canvas.addEventListener("pointerdown", (event) => this.#down(event), { capture: true });
    canvas.addEventListener("pointermove", (event) => this.#move(event), { capture: true });
    for (const name of /** @type {const} */ (["pointerup", "pointercancel"])) {
      canvas.addEventListener(name, (event) => this.#up(event), { capture: true });
    }
  }

  /** @param {PointerEvent} event */
  #down(event) {
    const mechanism = this.page.mechanism();
    if (event.button !== 0 || !event.isPrimary || !mechanism) return;
    const held = this.#hit(mechanism, event);
    this.#drag = held && { held, x: event.clientX, y: event.clientY, moved: false };
    if (!held?.corners.length || !this.page.folds() || !mechanism.moves) return;
    this.model.controls.enabled = false;
    this.model.canvas.setPointerCapture(event.pointerId);
  }

  /** @param {PointerEvent} event */
  #move(event) {
    const mechanism = this.page.mechanism();
    const drag = this.#drag;
    if (!drag || !mechanism) return;
    const [dx, dy] = [event.clientX - drag.x, event.clientY - drag.y];
    if (!drag.moved && Math.hypot(dx, dy) < DRAGGED) return;
    if (!drag.moved) {
      drag.moved = true;
      if (this.model.controls.enabled) return;
      if (drag.held.joint >= 0) mechanism.drive(drag.held.joint);
    }
    if (this.model.controls.enabled) return;
    const turn = this.#turn(mechanism, drag.held, dx, dy);
    mechanism.pull(mechanism.value + (Math.min(MOST, Math.max(-MOST, turn)) * 180) / Math.PI);
    [drag.x, drag.y] = [event.clientX, event.clientY];
    this.page.changed();
  }

  /** @param {PointerEvent} event */
  #up(event) {
    const drag = this.#drag;
    this.#drag = null;
    this.model.controls.enabled = true;
    if (drag ? !drag.moved : this.page.mechanism() && event.type === "pointerup" && !this.#wandered(event)) {
      this.page.chosen(drag?.held ?? null);
    }
  }

  /**
   * Tell whether the view was turned, so that nothing was clicked.
   *
   * @param {PointerEvent} event
   */
  #wandered(event) {
    return event.button !== 0 || this.model.panelAt(event.clientX, event.clientY) !== null;
  }

  /**
   * Return by how much the driven joint has to turn for what is held to move on the screen, radians.
   *
   * @param {Mechanism} mechanism
   * @param {Held} held
   * @param {number} dx
   * @param {number} dy
   */
  #turn(mechanism, held, dx, dy) {
    const here = this.#seen(mechanism.places, held);
    const there = this.#seen(mechanism.placesBeside(BESIDE), held);
    const [vx, vy] = [(there.x - here.x) / BESIDE, (there.y - here.y) / BESIDE];
    const speed = Math.hypot(vx, vy);
    return speed < HARDLY ? -dy / UPWARDS : (dx * vx + dy * vy) / (speed * speed);
  }

  /**
   * @param {Float64Array} places
   * @param {Held} held
   */
  #seen(places, { corners, weights }) {
    const place = new Vector3();
    corners.forEach((corner, n) => {
      const [x, y, z] = places.subarray(3 * corner, 3 * corner + 3);
      place.addScaledVector(new Vector3(x, y, z), weights[n]);
    });
    return this.model.seenAt(place);
  }

  /**
   * @param {Mechanism} mechanism
   * @param {PointerEvent} event
   * @returns {Held | null}
   */
  #hit(mechanism, { clientX: x, clientY: y, pointerType }) {
    const panel = this.model.panelAt(x, y);
    const near = pointerType === "touch" ? NEAR.touch : NEAR.mouse;
    let best = near;
    /** @type {Held | null} */
    let held = null;
    for (const { ends, joint } of mechanism.data.bodies.edges) {
      if (joint < 0) continue;
      const [a, b] = ends.map((vertex) => this.model.seen(mechanism.places, vertex));
      const [ux, uy] = [b.x - a.x, b.y - a.y];
      const part = Math.min(1, Math.max(0, ((x - a.x) * ux + (y - a.y) * uy) / (ux * ux + uy * uy || 1)));
      const off = Math.hypot(x - a.x - part * ux, y - a.y - part * uy);
      const depth = a.depth + part * (b.depth - a.depth);
      if (off >= best || (panel && depth > panel.depth + DEPTH)) continue;
      best = off;
      held = { joint, link: -1, corners: ends, weights: [1 - part, part], centre: -1 };
    }
    const centre = this.#centreAt(mechanism, x, y, pointerType === "touch" ? NEAR_CENTRE.touch : NEAR_CENTRE.mouse);
    if (held) return { ...held, centre };
    if (!panel) return centre < 0 ? null : { joint: -1, link: -1, corners: [], weights: [], centre };
    const weights = this.#weights(mechanism, panel);
    return { joint: -1, link: panel.link, corners: panel.corners, weights, centre };
  }

  /**
   * @param {Mechanism} mechanism
   * @param {number} x
   * @param {number} y
   * @param {number} near - Pixels.
   */
  #centreAt(mechanism, x, y, near) {
    const { centres } = this.model;
    if (!centres.group.visible) return -1;
    let best = near, found = -1;
    mechanism.data.centres.forEach((_, n) => {
      const at = this.model.seenAt(centres.placeOf(n));
      const off = Math.hypot(x - at.x, y - at.y);
      if (off < best) [best, found] = [off, n];
    });
    return found;
  }

  /**
   * Return the weights of the corners of a triangle at a place on it.
   *
   * @param {Mechanism} mechanism
   * @param {{corners: number[], place: Vector3}} panel
   */
  #weights({ places }, { corners, place }) {
    const [a, b, c] = corners.map((n) => new Vector3(places[3 * n], places[3 * n + 1], places[3 * n + 2]));
    const normal = b.clone().sub(a).cross(c.clone().sub(a));
    const size = normal.lengthSq() || 1;
    const one = c.clone().sub(b).cross(place.clone().sub(b)).dot(normal) / size;
    const other = a.clone().sub(c).cross(place.clone().sub(c)).dot(normal) / size;
    return [one, other, 1 - one - other];
  }
}
