/** Cards of types: a window of them at a time, more as the visitor scrolls; pictures load when they come near. */

/** @import { AtlasData } from "./types.js" */

const AT_ONCE = 60;
const SHOWN = ["links", "dof", "centres", "symmetry", "fold_deg"];

export class Cards {
  /**
   * @param {AtlasData} data
   * @param {HTMLElement} place
   */
  constructor(data, place) {
    this.data = data;
    this.place = place;
    /** @type {number[]} */
    this.places = [];
    this.there = 0;
    this.end = document.createElement("div");
    this.end.className = "end";
    place.after(this.end);
    new IntersectionObserver((entries) => {
      if (entries.some((entry) => entry.isIntersecting)) this.more();
    }, { rootMargin: "800px" }).observe(this.end);
  }

  /** @param {number[]} places Of the types to show. */
  show(places) {
    this.places = places;
    this.there = 0;
    this.place.replaceChildren();
    this.more();
  }

  /** Add the next cards, until the end of the window is filled. */
  more() {
    const next = this.places.slice(this.there, this.there + AT_ONCE);
    if (!next.length) return;
    this.there += next.length;
    this.place.append(...next.map((n) => this.card(n)));
  }

  /** @param {number} n */
  card(n) {
    const { columns, digits, says } = this.data;
    const file = String(n + 1).padStart(digits, "0");
    const card = document.createElement("a");
    card.className = "card";
    card.href = `types/${file}.html`;
    const picture = document.createElement("img");
    Object.assign(picture, { loading: "lazy", decoding: "async", width: 200, height: 150, src: `pictures/${file}.svg` });
    picture.alt = "";
    const name = document.createElement("strong");
    name.textContent = String(columns.name?.[n] ?? columns.id[n]);
    const code = document.createElement("code");
    code.textContent = columns.name?.[n] ? String(columns.id[n]) : "";
    const facts = document.createElement("small");
    facts.textContent = [columns.kind[n], ...SHOWN.filter((column) => (columns[column]?.[n] ?? null) !== null)
      .map((column) => `${column.replaceAll("_", " ")} ${round(columns[column][n])}`)].join(", ");
    facts.title = SHOWN.filter((column) => says[column]).map((column) => `${column}: ${says[column]}`).join("\n");
    card.append(picture, name, code, facts);
    return card;
  }
}

/** @param {string | number | boolean | null} value */
function round(value) {
  return typeof value === "number" ? Math.round(value * 10) / 10 : value;
}
