/** The pane of the sheet folded flat: its views, and the orders of its components to go through. */

/** @import { FlatData } from "./types.js" */
/** @import { Shape, View } from "./layered.js" */
import { shapesOf, stacksOf, VIEWS } from "./layered.js";
import { element, filled, labelled } from "./layout.js";

const ASKS = "Click a panel for the layers there.";
const SVG = "http://www.w3.org/2000/svg";
/** Height of exploded layers at first, and at most, in units of the extent; the rim in parts of the size. */
const HEIGHT = 0.8, HIGHEST = 2.4, RIM = 0.03;

export class FlatFolded {
  /** @type {FlatData | null} */
  #flat = null;
  /** @type {number[]} - Which of its listed orders each component has. */
  #chosen = [];
  /** @type {number[][]} */
  #stacks = [];
  /** The cell whose layers are told; -1: none. */
  #cell = -1;

  /**
   * @param {HTMLElement} place
   * @param {(id: {link: string} | null) => void} chosen - A panel was clicked.
   */
  constructor(place, chosen) {
    this.place = place;
    this.told = element("p", { class: "flat-told" });
    this.view = element("select", { "aria-label": "View of the folded sheet" });
    this.height = element("input", { type: "range", min: "0", max: `${HIGHEST}`, step: "any", "aria-label": "Height of the layers" });
    this.component = element("select", { "aria-label": "Component" });
    this.before = element("button", { type: "button", "aria-label": "Order before" }, "‹");
    this.next = element("button", { type: "button", "aria-label": "Next order" }, "›");
    this.order = element("span", { class: "order", role: "status", "aria-live": "polite" });
    this.layers = element("p", { class: "stack", role: "status", "aria-live": "polite" });
    this.pane = element("div", { class: "pane flat-pane", "aria-label": "Folded flat" });
    this.components = element("span", { class: "components" },
      labelled("Component", this.component), this.before, this.order, this.next);
    place.append(this.told,
      element("div", { class: "row" }, labelled("View", this.view), labelled("Height", this.height), this.components), this.pane, this.layers);
    filled(this.view, VIEWS.map((told, value) => ({ value, told })), 0);
    this.height.value = `${HEIGHT}`;
    for (const one of [this.view, this.component]) one.addEventListener("change", () => this.#draw());
    this.height.addEventListener("input", () => this.#draw());
    this.before.addEventListener("click", () => this.#turn(-1));
    this.next.addEventListener("click", () => this.#turn(1));
    this.pane.addEventListener("click", ({ target }) => {
      const shape = target instanceof Element ? target.closest("[data-panel]") : null;
      const { panel, cell } = shape instanceof SVGElement ? shape.dataset : {};
      this.#cell = Number(cell ?? -1);
      this.#tell();
      chosen(panel === undefined ? null : { link: panel });
    });
  }

  /** @param {FlatData | null} flat */
  show(flat) {
    this.#flat = flat;
    this.place.hidden = !flat;
    if (!flat) return;
    const { components } = flat;
    this.#chosen = components.map(() => 0);
    this.#cell = flat.cells.length === 1 ? 0 : -1;
    this.told.textContent = flat.told;
    filled(this.component, components.map(({ panels, orders }, value) => (
      { value, told: `${value + 1} of ${components.length}: ${panels.length} panels, ${orders} orders` })), 0);
    this.components.hidden = components.length === 0;
    this.#draw();
  }

  /** @param {number} step - To another order of the component. */
  #turn(step) {
    const place = Number(this.component.value);
    const count = this.#flat?.components[place].listed.length ?? 1;
    this.#chosen[place] = (this.#chosen[place] + step + count) % count;
    this.#draw();
  }

  #draw() {
    const flat = this.#flat;
    if (!flat) return;
    const view = /** @type {View} */ (VIEWS[Number(this.view.value)]);
    if (this.height.parentElement) this.height.parentElement.hidden = view !== "exploded";
    const component = flat.components[Number(this.component.value)];
    if (component) {
      const { listed, orders } = component;
      const all = listed.length === Number(orders) ? orders : `the first ${listed.length} of ${orders}`;
      this.order.textContent = `order ${this.#chosen[Number(this.component.value)] + 1} of ${all}`;
      for (const one of [this.before, this.next]) one.disabled = listed.length < 2;
    }
    this.#stacks = stacksOf(flat, this.#chosen);
    this.#tell();
    const shapes = shapesOf(flat, this.#stacks, view, Number(this.height.value));
    const svg = document.createElementNS(SVG, "svg");
    svg.setAttribute("viewBox", boxOf(shapes).join(" "));
    svg.setAttribute("class", view);
    svg.append(...shapes.map(drawn));
    this.pane.replaceChildren(svg);
  }

  #tell() {
    const stack = this.#stacks[this.#cell];
    this.layers.textContent = stack ? `Layers there, from below: ${stack.join(", ")}` : ASKS;
  }
}

/** @param {Shape[]} shapes */
function boxOf(shapes) {
  const points = shapes.flatMap((shape) => shape.points);
  const least = [0, 1].map((axis) => points.reduce((low, point) => Math.min(low, point[axis]), Infinity));
  const size = [0, 1].map((axis) => points.reduce((high, point) => Math.max(high, point[axis]), -Infinity) - least[axis]);
  const rim = RIM * Math.max(...size);
  return [least[0] - rim, least[1] - rim, size[0] + 2 * rim, size[1] + 2 * rim];
}

/** @param {Shape} shape */
function drawn({ points, closed, looks, panel, cell, opacity }) {
  const made = document.createElementNS(SVG, "path");
  made.setAttribute("d", `M${points.map((point) => point.map((x) => x.toFixed(5)).join(" ")).join("L")}${closed ? "Z" : ""}`);
  made.setAttribute("class", looks);
  if (opacity < 1) made.setAttribute("opacity", `${opacity}`);
  if (panel >= 0) {
    made.dataset.panel = `${panel}`;
    made.dataset.cell = `${cell}`;
    const title = document.createElementNS(SVG, "title");
    title.textContent = `panel ${panel}`;
    made.append(title);
  }
  return made;
}
