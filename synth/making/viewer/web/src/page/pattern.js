/** The pane of the drawing: the picture that Python drew, its links and joints to click. */

/** @import { ShownData } from "./types.js" */

/** Pixels from a vertex at which that is meant; radius of a mark in the unit of the picture. */
const NEAR = 12, MARK = 4;
/** Letters of a picture that is drawn after the model. */
const LARGE = 100_000;
const dark = matchMedia("(prefers-color-scheme: dark)");

export class Pattern {
  /**
   * @param {HTMLElement} pane
   * @param {(id: {joint?: string, link?: string} | null) => void} chosen
   */
  constructor(pane, chosen) {
    this.pane = pane;
    /** @type {ShownData | null} */
    this.shown = null;
    /** @type {{joint?: string, link?: string} | null} */
    this.marked = null;
    /** @type {((x: number, y: number, near: number) => void) | null} - Takes clicks while places are asked for. */
    this.pick = null;
    /** @type {[number, number][]} */
    this.marks = [];
    pane.addEventListener("click", (event) => {
      if (this.pick) this.#picked(event, this.pick);
      else chosen(idOf(event.target));
    });
    dark.addEventListener("change", () => this.#draw());
  }

  /** @param {ShownData} shown */
  show(shown) {
    this.shown = shown;
    this.marked = null;
    this.marks = [];
    const { length } = this.#picture(shown);
    if (length < LARGE) this.#draw();
    else this.#drawLater(shown);
  }

  /**
   * Draw when the model has been seen: a large drawing takes a second where the machine has no graphics.
   *
   * @param {ShownData} shown
   */
  #drawLater(shown) {
    this.pane.textContent = "Drawing ...";
    requestAnimationFrame(() => setTimeout(() => { if (shown === this.shown) this.#draw(); }));
  }

  /** @param {ShownData} shown */
  #picture({ pictures }) {
    return (dark.matches ? pictures.dark : pictures.light) ?? pictures.light ?? "";
  }

  /**
   * Mark the shapes of a link or a joint.
   *
   * @param {{joint?: string, link?: string} | null} id
   */
  mark(id) {
    this.marked = id;
    for (const shape of this.pane.querySelectorAll("[data-joint], [data-link]")) {
      const { joint, link } = /** @type {SVGElement} */ (shape).dataset;
      const same = id?.joint === undefined ? link !== undefined && link === id?.link : joint === id.joint;
      shape.classList.toggle("chosen", same);
    }
  }

  /**
   * Mark places of the picture.
   *
   * @param {[number, number][]} marks
   */
  markPlaces(marks) {
    this.marks = marks;
    const svg = this.pane.querySelector("svg");
    for (const old of this.pane.querySelectorAll(".place")) old.remove();
    for (const [x, y] of marks) {
      const disc = document.createElementNS("http://www.w3.org/2000/svg", "circle");
      const look = { class: "place", cx: x, cy: y, r: MARK };
      for (const [key, value] of Object.entries(look)) disc.setAttribute(key, `${value}`);
      svg?.append(disc);
    }
  }

  /**
   * @param {MouseEvent} event
   * @param {(x: number, y: number, near: number) => void} pick
   */
  #picked(event, pick) {
    const seen = this.pane.querySelector("svg")?.getScreenCTM();
    if (!seen) return;
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(seen.inverse());
    pick(x, y, NEAR / seen.a);
  }

  #draw() {
    const { shown, pane } = this;
    if (!shown) return;
    const picture = this.#picture(shown);
    if (!picture) {
      pane.textContent = "No drawing.";
      return;
    }
    const parsed = new DOMParser().parseFromString(picture, "image/svg+xml").documentElement;
    const svg = document.importNode(parsed, true);
    svg.removeAttribute("width");
    svg.removeAttribute("height");
    const immobile = new Set(shown.immobile);
    for (const shape of svg.querySelectorAll("path[data-joint]")) {
      shape.classList.toggle("immobile", immobile.has(/** @type {SVGElement} */ (shape).dataset.joint ?? ""));
    }
    pane.replaceChildren(svg);
    this.mark(this.marked);
    this.markPlaces(this.marks);
  }
}

/**
 * Return the link or joint of a shape that was clicked.
 *
 * @param {EventTarget | null} target
 */
function idOf(target) {
  const shape = target instanceof Element ? target.closest("[data-joint], [data-link]") : null;
  if (!(shape instanceof SVGElement)) return null;
  const { joint, link } = shape.dataset;
  return joint === undefined ? { link } : { joint };
}
