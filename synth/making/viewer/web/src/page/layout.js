/** The elements of the page. */

/**
 * Make an element.
 *
 * @template {keyof HTMLElementTagNameMap} Name
 * @param {Name} name
 * @param {Record<string, string>} attributes
 * @param {(Node | string)[]} inside
 * @returns {HTMLElementTagNameMap[Name]}
 */
export function element(name, attributes = {}, ...inside) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...inside);
  return made;
}

/**
 * Put the page together and return what is asked and told.
 *
 * @param {HTMLElement} root
 */
export function layout(root) {
  const made = {
    list: element("select", { "aria-label": "Mechanism" }),
    verdict: element("p", { class: "verdict" }),
    pattern: element("div", { class: "pane pattern", "aria-label": "Drawing" }),
    model: element("div", { class: "pane model" }),
    way: element("select", { "aria-label": "Motion branch" }),
    driver: element("select", { "aria-label": "Driven joint" }),
    play: element("button", { type: "button", class: "play" }, "Play"),
    speed: element("select", { "aria-label": "Speed" }, ...speeds()),
    sliders: element("div", { class: "sliders", role: "group", "aria-label": "A slider for each freedom" }),
    centres: element("input", { type: "checkbox", checked: "" }),
    crossed: element("p", { class: "crossed", role: "status", "aria-live": "polite" }),
    reset: element("button", { type: "button" }, "Reset"),
    fit: element("button", { type: "button" }, "Fit"),
    folds: element("input", { type: "checkbox", checked: "" }),
    fold: element("button", { type: "button" }, "FOLD"),
    obj: element("button", { type: "button" }, "OBJ"),
    png: element("button", { type: "button" }, "PNG"),
    svg: element("button", { type: "button" }, "SVG"),
    json: element("button", { type: "button" }, "JSON"),
    status: element("p", { class: "status", role: "status", "aria-live": "polite" }),
    part: element("p", { class: "part", role: "status", "aria-live": "polite" }),
    notes: element("ul", { class: "notes" }),
    report: element("pre"),
    panes: element("div", { class: "panes" }),
    details: element("details", {}, element("summary", {}, "Freedoms and equations")),
    bench: element("div", { class: "bench" }),
    flat: element("section", { class: "flat", "aria-label": "Folded flat" }),
  };
  const choose = element("div", { class: "row" },
    made.play, made.reset, made.fit,
    labelled("Drive", made.driver), labelled("Branch", made.way), labelled("Speed", made.speed),
    element("label", { class: "check" }, made.folds, "drag folds"),
    element("label", { class: "check" }, made.centres, "centres"),
    element("span", { class: "save" }, "Pose ", made.fold, made.obj, made.png));
  const told = element("div", { class: "row" },
    element("span", { class: "save" }, "Drawing ", made.svg, " Answer ", made.json));
  const controls = element("section", { class: "controls", "aria-label": "Motion" },
    made.sliders, choose, made.crossed, made.status);
  made.panes.append(made.pattern, made.model);
  made.details.append(made.report);
  const header = element("header", {}, made.bench, made.list, made.verdict);
  root.append(header, made.panes, controls, made.part, made.flat, made.notes, made.details, told);
  return { ...made, controls, told };
}

/** @typedef {ReturnType<typeof layout>} Layout */

/**
 * @param {string} text
 * @param {HTMLElement} field
 */
export function labelled(text, field) {
  return element("label", {}, element("span", {}, text), field);
}

function speeds() {
  return [15, 30, 60, 120].map((speed) => {
    const option = element("option", { value: String(speed) }, `${speed}°/s`);
    option.selected = speed === 30;
    return option;
  });
}

/**
 * Fill a list to choose from.
 *
 * @param {HTMLSelectElement} list
 * @param {{value: number, told: string}[]} options
 * @param {number} taken
 */
export function filled(list, options, taken) {
  list.replaceChildren(...options.map(({ value, told }) => element("option", { value: String(value) }, told)));
  list.value = String(taken);
}
