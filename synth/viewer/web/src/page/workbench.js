/**
 * Files dropped on the page, or chosen, and edited: Python behind the page reads and judges them, the page shows what
 * it says. Edits are told with the file each time, so that nothing is kept behind the page, and any can be undone.
 */

/** @import { ShownData } from "./types.js" */
import { element } from "./layout.js";

const INVITED = "Drop a crease pattern, a graph or a model here.";

/**
 * What a mechanism that is shown was read from; no file: the one that the workbench was begun with.
 *
 * @typedef {{name: string, file: Blob | null, edits: string[]}} Source
 */

export class Workbench {
  /** @type {AbortController | null} */
  #asked = null;

  /**
   * @param {HTMLElement} root - Where files may be dropped.
   * @param {HTMLElement} bench - Where it is said what happens.
   * @param {{shown: ShownData[], add: (shown: ShownData) => void, put: (shown: ShownData, number: number) => void,
   *          number: () => number, joint: () => string | null}} page
   */
  constructor(root, bench, page) {
    this.page = page;
    /** @type {Source[]} - One for each mechanism that is shown. */
    this.sources = page.shown.map(({ name }) => ({ name, file: null, edits: [] }));
    this.status = element("span", { role: "status", "aria-live": "polite" }, INVITED);
    this.stop = element("button", { type: "button", hidden: "" }, "Stop");
    this.lock = element("button", { type: "button" }, "Lock joint");
    this.remove = element("button", { type: "button" }, "Remove joint");
    this.undo = element("button", { type: "button" }, "Undo");
    const chosen = element("input", { type: "file", multiple: "", "aria-label": "Files to open" });
    bench.append(chosen, this.lock, this.remove, this.undo, this.status, this.stop);
    chosen.addEventListener("change", () => this.#read([...(chosen.files ?? [])]));
    this.stop.addEventListener("click", () => this.#asked?.abort());
    this.lock.addEventListener("click", () => this.#edit("lock"));
    this.remove.addEventListener("click", () => this.#edit("remove"));
    this.undo.addEventListener("click", () => this.#edited((edits) => edits.slice(0, -1)));
    this.#droppable(root);
    this.#present();
    this.changed();
  }

  /** Tell what can be done with what is chosen now. */
  changed() {
    const source = this.sources[this.page.number()];
    const joint = this.page.joint();
    this.lock.disabled = this.remove.disabled = !source || joint === null;
    this.undo.disabled = !source?.edits.length;
    for (const one of [this.lock, this.remove, this.undo]) one.hidden = !source;
  }

  /** @param {HTMLElement} root */
  #droppable(root) {
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
      const source = { name: file.name, file, edits: [] };
      const { shown, error } = await this.#judged(source);
      if (shown) {
        this.sources.push(source);
        this.page.add(shown);
      } else told.push(error);
    }
    this.status.textContent = told.join("\n") || INVITED;
  }

  /** @param {"lock" | "remove"} what - Is done with the joint that was clicked last. */
  #edit(what) {
    const joint = this.page.joint();
    if (joint !== null) this.#edited((edits) => [...edits, `${what}:${joint}`]);
  }

  /** @param {(edits: string[]) => string[]} next */
  async #edited(next) {
    const number = this.page.number();
    const source = this.sources[number];
    const file = source.file ?? (await (await fetch(`given?number=${number}`)).blob());
    const changed = { ...source, file, edits: next(source.edits) };
    const { shown, error } = await this.#judged(changed);
    this.status.textContent = error ?? (changed.edits.join(", ") || INVITED);
    if (!shown) return;
    this.sources[number] = changed;
    this.page.put(shown, number);
  }

  /**
   * Return what is to be shown of a file with its edits, or why there is nothing.
   *
   * @param {Source} source
   * @returns {Promise<{shown?: ShownData, error?: string}>}
   */
  async #judged({ name, file, edits }) {
    this.#asked?.abort();
    this.#asked = new AbortController();
    this.status.textContent = `Reading ${name} ...`;
    this.stop.hidden = false;
    try {
      const words = new URLSearchParams([["name", name], ...edits.map((edit) => ["edit", edit])]);
      const answer = await fetch(`shown?${words}`, { method: "POST", body: file, signal: this.#asked.signal });
      return answer.ok ? await answer.json() : { error: `${name}: ${await answer.text()}` };
    } catch (error) {
      if (!(error instanceof DOMException) && !(error instanceof TypeError)) throw error;
      return { error: `${name}: ${error.name === "AbortError" ? "stopped" : "the workbench does not answer"}` };
    } finally {
      this.stop.hidden = true;
    }
  }
}
