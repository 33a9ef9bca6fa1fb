/** Sliders: one for each freedom of a mechanism, and one along its path. */

/** @import { Mechanism } from "./mechanism.js" */
import { element } from "./layout.js";

/** Degrees along the path that the slider begins with; it grows by as many. */
const AROUND = 360;

/**
 * What is asked of the page.
 *
 * @typedef {object} Asked
 * @property {(joint: number, degrees: number) => void} to - A joint is to have an angle.
 * @property {(degrees: number) => void} along - A place along the path.
 */

/**
 * The slider and the number of a joint; while somebody types the number it is not renewed.
 *
 * @typedef {{joint: number, row: HTMLElement, slider: HTMLInputElement, angle: HTMLInputElement, typed: boolean}} Row
 */

export class Sliders {
  /** @type {Row[]} */
  #rows = [];

  /**
   * @param {HTMLElement} place
   * @param {Asked} asked
   */
  constructor(place, asked) {
    this.place = place;
    this.asked = asked;
    this.path = element("input", { type: "range", step: "any", "aria-label": "Along the path" });
    this.path.addEventListener("input", () => asked.along(Number(this.path.value)));
    this.travelled = element("span", { class: "travelled" });
    this.pathRow = element("div", { class: "drive path" },
      element("span", { class: "name" }, "path"), this.path, this.travelled);
  }

  /**
   * Show the sliders of a mechanism.
   *
   * @param {Mechanism} mechanism
   */
  show(mechanism) {
    const [least, most] = mechanism.range.map(String);
    this.#rows = mechanism.drivers.map((joint) => this.#made(joint, mechanism.data.joints[joint], least, most));
    const { freedoms, drivers } = mechanism;
    const more = freedoms !== null && freedoms > drivers.length
      ? [element("p", {}, `${freedoms} freedoms: ${drivers.length} joints have sliders; drag others, or choose them below.`)]
      : [];
    this.place.replaceChildren(...this.#rows.map(({ row }) => row), ...more, this.pathRow);
    this.place.hidden = !mechanism.moves;
  }

  /**
   * Show where the joints are; other joints may have become the driven ones.
   *
   * @param {Mechanism} mechanism
   */
  moved(mechanism) {
    if (`${mechanism.drivers}` !== `${this.#rows.map(({ joint }) => joint)}`) this.show(mechanism);
    const { goal, driver } = mechanism;
    for (const { joint, row, slider, angle, typed } of this.#rows) {
      const degrees = mechanism.angleOf(joint);
      slider.value = String(goal && !goal.along && goal.driver === joint ? goal.degrees : degrees);
      slider.setAttribute("aria-valuetext", `${degrees.toFixed(1)} degrees`);
      if (!typed) angle.value = degrees.toFixed(2);
      row.classList.toggle("driven", joint === driver);
    }
    const travelled = goal?.along ? goal.degrees : mechanism.travelled;
    const reach = AROUND * Math.max(1, Math.ceil(Math.abs(travelled) / AROUND));
    [this.path.min, this.path.max] = [String(-reach), String(reach)];
    this.path.value = String(travelled);
    this.path.setAttribute("aria-valuetext", `${travelled.toFixed(1)} degrees from where joint `
      + `${mechanism.data.joints[driver]} began`);
    this.travelled.textContent = `${travelled.toFixed(1)}°`;
  }

  /**
   * @param {number} joint
   * @param {string} id
   * @param {string} least
   * @param {string} most
   * @returns {Row}
   */
  #made(joint, id, least, most) {
    const slider = element("input",
      { type: "range", step: "any", min: least, max: most, "aria-label": `Joint ${id}, degrees` });
    const angle = element("input", { type: "number", step: "any", "aria-label": `Angle of joint ${id}, degrees` });
    const row = element("div", { class: "drive" }, element("span", { class: "name" }, `joint ${id}`), slider,
      element("span", { class: "angle" }, angle, "°"));
    const made = { joint, row, slider, angle, typed: false };
    slider.addEventListener("input", () => this.asked.to(joint, Number(slider.value)));
    angle.addEventListener("input", () => { made.typed = true; });
    angle.addEventListener("change", () => {
      made.typed = false;
      this.asked.to(joint, angle.valueAsNumber);
    });
    return made;
  }
}
