/** The pane of the drawing: the picture that Python drew, its links and joints to click. */

/** @import { ShownData } from "./types.js" */

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
    pane.addEventListener("click", (event) => chosen(idOf(event.target)));
    dark.addEventListener("change", () => this.#draw());
  }

  /** @param {ShownData} shown */
  show(shown) {
    this.shown = shown;
    this.marked = null;
    this.#draw();
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

  #draw() {
    const { shown, pane } = this;
    if (!shown) return;
    const picture = (dark.matches ? shown.pictures.dark : shown.pictures.light) ?? shown.pictures.light;
    if (!picture) {
      pane.textContent = "No drawing.";
      return;
    }
    const parsed = new DOMParser().parseFromString(picture, "image/svg+xml").documentElement;
    const svg = document.importNode(parsed, true);
    svg.removeAttribute("width");
    svg.removeAttribute("height");
    const stiff = new Set(shown.stiff);
    for (const shape of svg.querySelectorAll("path[data-joint]")) {
      shape.classList.toggle("stiff", stiff.has(/** @type {SVGElement} */ (shape).dataset.joint ?? ""));
    }
    pane.replaceChildren(svg);
    this.mark(this.marked);
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
