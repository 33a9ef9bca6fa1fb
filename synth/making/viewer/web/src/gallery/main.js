/** The first page of a site of an atlas: search and filter as one types, sort, cards. */

import { Cards } from "./cards.js";
import { choiceOf, chosen, everything, FLAGS, hashOf, RANGES, searchedText } from "./choice.js";
import "./style.css";

/** @import { AtlasData, Choice } from "./types.js" */

const FLAG_WORDS = /** @type {Record<string, string>} */ ({
  all_explicit: "one sheet without holes", realised: "with coordinates", name: "with a name",
});

/** @param {string} html */
function element(html) {
  const made = document.createElement("template");
  made.innerHTML = html;
  return /** @type {HTMLElement} */ (made.content.firstElementChild);
}

class Gallery {
  /** @param {AtlasData} data */
  constructor(data) {
    this.data = data;
    this.searched = searchedText(data);
    this.ranges = RANGES.filter((name) => data.columns[name]?.some((value) => typeof value === "number"));
    this.flags = FLAGS.filter((name) => data.columns[name]?.some(Boolean));
    const main = /** @type {HTMLElement} */ (document.getElementById("gallery"));
    main.append(this.form(), element('<p class="status" role="status"></p>'), element('<div class="cards"></div>'));
    this.form_ = /** @type {HTMLFormElement} */ (main.querySelector("form"));
    this.status = /** @type {HTMLElement} */ (main.querySelector(".status"));
    this.cards = new Cards(data, /** @type {HTMLElement} */ (main.querySelector(".cards")));
    this.form_.addEventListener("input", () => this.update(this.read()));
    this.form_.addEventListener("submit", (event) => event.preventDefault());
    this.form_.addEventListener("reset", () => setTimeout(() => this.update(everything())));
    window.addEventListener("hashchange", () => this.follow());
    this.follow();
  }

  form() {
    const kinds = [...new Set(this.data.columns.kind)].map((kind) => `<option>${kind}</option>`).join("");
    const form = element(`<form role="search">
      <label class="text"><span>Search</span><input type="search" name="text" autocomplete="off" placeholder="words in id, name, kind"></label>
      <label><span>Kind</span><select name="kind"><option value="">all</option>${kinds}</select></label>
      <label><span>Sort by</span><select name="sort"><option value="">as listed</option></select></label>
      <button type="reset">All types</button><details><summary>More</summary><div class="more"></div></details></form>`);
    const sort = /** @type {HTMLSelectElement} */ (form.querySelector("[name=sort]"));
    const more = /** @type {HTMLElement} */ (form.querySelector(".more"));
    for (const name of this.ranges) {
      const words = name.replaceAll("_", " ");
      sort.append(new Option(`${words}, rising`, name), new Option(`${words}, falling`, `-${name}`));
      const field = element(`<fieldset><legend></legend><input type="number" step="any" name="${name}.least" aria-label="least ${words}"
        placeholder="from"><input type="number" step="any" name="${name}.greatest" aria-label="greatest ${words}" placeholder="to"></fieldset>`);
      /** @type {HTMLElement} */ (field.querySelector("legend")).textContent = words;
      field.title = this.data.says[name] ?? "";
      more.append(field);
    }
    for (const name of this.flags) {
      more.append(element(`<label class="flag"><input type="checkbox" name="${name}"><span>${FLAG_WORDS[name]}</span></label>`));
    }
    return form;
  }

  /** @returns {Choice} What the form says. */
  read() {
    const said = new FormData(this.form_);
    const choice = everything();
    for (const name of /** @type {const} */ (["text", "kind", "sort"])) choice[name] = String(said.get(name) ?? "");
    for (const name of this.ranges) {
      const [least, greatest] = [said.get(`${name}.least`), said.get(`${name}.greatest`)].map(String);
      if (least || greatest) choice.ranges[name] = [least ? Number(least) : -Infinity, greatest ? Number(greatest) : Infinity];
    }
    choice.flags = this.flags.filter((name) => said.has(name));
    return choice;
  }

  /** Show what the address says. */
  follow() {
    const choice = choiceOf(location.hash);
    /** @param {string} name @param {string} value */
    const set = (name, value) => {
      const field = this.form_.elements.namedItem(name);
      if (field instanceof HTMLInputElement || field instanceof HTMLSelectElement) field.value = value;
    };
    for (const name of /** @type {const} */ (["text", "kind", "sort"])) set(name, choice[name]);
    for (const name of this.ranges) {
      const [least, greatest] = choice.ranges[name] ?? [-Infinity, Infinity];
      set(`${name}.least`, Number.isFinite(least) ? String(least) : "");
      set(`${name}.greatest`, Number.isFinite(greatest) ? String(greatest) : "");
    }
    for (const name of this.flags) {
      const field = this.form_.elements.namedItem(name);
      if (field instanceof HTMLInputElement) field.checked = choice.flags.includes(name);
    }
    if (choice.flags.length || Object.keys(choice.ranges).length) {
      /** @type {HTMLDetailsElement} */ (this.form_.querySelector("details")).open = true;
    }
    this.show(choice);
  }

  /** @param {Choice} choice */
  update(choice) {
    const hash = hashOf(choice);
    history.replaceState(null, "", hash ? `#${hash}` : location.pathname + location.search);
    this.show(choice);
  }

  /** @param {Choice} choice */
  show(choice) {
    const places = chosen(this.data, this.searched, choice);
    const every = this.searched.length;
    this.status.textContent = places.length === every ? `${every} types` : `${places.length} of ${every} types`;
    this.cards.show(places);
  }
}

new Gallery(/** @type {any} */ (window).atlasData);
