/** Files dropped on the page, or chosen: Python behind the page reads and judges them, the page shows what it says. */

/** @import { ShownData } from "./types.js" */
import { element } from "./layout.js";

const INVITED = "Drop a crease pattern, a graph or a model here.";

export class Workbench {
  /** @type {AbortController | null} */
  #asked = null;

  /**
   * @param {HTMLElement} root - Where files may be dropped.
   * @param {HTMLElement} bench - Where it is said what happens.
   * @param {(shown: ShownData) => void} add
   */
  constructor(root, bench, add) {
    this.root = root;
    this.add = add;
    this.status = element("span", { role: "status", "aria-live": "polite" }, INVITED);
    this.stop = element("button", { type: "button", hidden: "" }, "Stop");
    const chosen = element("input", { type: "file", multiple: "", "aria-label": "Files to open" });
    bench.append(chosen, this.status, this.stop);
    chosen.addEventListener("change", () => this.#read([...(chosen.files ?? [])]));
    this.stop.addEventListener("click", () => this.#asked?.abort());
    for (const name of /** @type {const} */ (["dragenter", "dragover"])) {
      document.addEventListener(name, (event) => { event.preventDefault(); root.classList.add("over"); });
    }
    document.addEventListener("dragleave", (event) => {
      if (event.relatedTarget === null) root.classList.remove("over");
    });
    document.addEventListener("drop", (event) => {
      event.preventDefault();
      root.classList.remove("over");
      this.#read([...(event.dataTransfer?.files ?? [])]);
    });
    this.#present();
  }

  /** Keep a line open for as long as the page is: the workbench ends some time after the last one. */
  async #present() {
    try {
      const reader = (await fetch("open")).body?.getReader();
      while (reader && !(await reader.read()).done);
    } finally {
      this.status.textContent = "The workbench has ended; what is shown still moves.";
    }
  }

  /** @param {File[]} files */
  async #read(files) {
    const told = [];
    for (const file of files) {
      const why = await this.#one(file);
      if (why) told.push(why);
    }
    this.status.textContent = told.join("\n") || INVITED;
  }

  /**
   * Return why a file is not shown, or nothing.
   *
   * @param {File} file
   * @returns {Promise<string>}
   */
  async #one(file) {
    this.#asked = new AbortController();
    this.status.textContent = `Reading ${file.name} ...`;
    this.stop.hidden = false;
    try {
      const address = `shown?name=${encodeURIComponent(file.name)}`;
      const answer = await fetch(address, { method: "POST", body: file, signal: this.#asked.signal });
      if (!answer.ok) return `${file.name}: ${await answer.text()}`;
      const { shown, error } = await answer.json();
      if (error === undefined) this.add(shown);
      return error ?? "";
    } catch (error) {
      if (!(error instanceof DOMException) && !(error instanceof TypeError)) throw error;
      return `${file.name}: ${error.name === "AbortError" ? "stopped" : "the workbench does not answer"}`;
    } finally {
      this.stop.hidden = true;
    }
  }
}
