/**
 * Files dropped on the page, or chosen, and edited: Python behind the page reads and judges them, the page shows what
 * it says. Edits are told with the file each time, so that nothing is kept behind the page, and any can be undone.
 */

/** @import { ShownData } from "./types.js" */
import { Editing } from "./editing.js";
import { element } from "./layout.js";
import { saved } from "./saving.js";

const INVITED = "Drop a crease pattern, a graph or a model here.";
const ENDED = "The workbench has ended; what is shown still moves.";
const NO_ANSWER = "the workbench does not answer";

/**
 * What a mechanism that is shown was read from; no file: the one that the workbench was begun with.
 *
 * @typedef {object} Source
 * @property {string} name
 * @property {Blob | null} file
 * @property {string[]} edits
 * @property {boolean} motion - Whether motion was asked for of what is too large to look for it unasked.
 */

/**
 * What the workbench is told of the page, and asks of it.
 *
 * @typedef {object} Paged
 * @property {ShownData[]} shown - Those that are there when it is begun.
 * @property {(shown: ShownData) => void} add
 * @property {(shown: ShownData, number: number) => void} put
 * @property {(number: number) => void} drop - Show one no longer.
 * @property {() => number} number - Of the one that is seen.
 * @property {() => ShownData} seen
 * @property {() => string | null} joint - That was clicked last.
 * @property {(picked: ((x: number, y: number, near: number) => void) | null) => void} pick - Hand clicks in the
 * drawing on, in its own unit, or do so no longer.
 * @property {(places: [number, number][]) => void} mark - Mark places of the drawing.
 */

export class Workbench {
  /**
   * What Python is asked now, and how far each is.
   *
   * @type {Map<AbortController, {text: string, step: number, of: number}>}
   */
  #asked = new Map();
  /** What is done one after the other; what was begun before a stop is left out. */
  #queue = Promise.resolve();
  #stops = 0;
  /** How many things wait for their turn. */
  #waiting = 0;
  #said = INVITED;
  /** @type {{number: number, before: {source: Source, shown: ShownData} | null}[]} - What was there before each change. */
  #history = [];

  /**
   * @param {HTMLElement} root - Where files may be dropped.
   * @param {HTMLElement} bench - Where it is said what happens.
   * @param {Paged} page
   */
  constructor(root, bench, page) {
    this.page = page;
    /** @type {Source[]} - One for each mechanism that is shown. */
    this.sources = page.shown.map(({ name }) => ({ name, file: null, edits: [], motion: false }));
    this.status = element("span", { role: "status", "aria-live": "polite" }, INVITED);
    this.progress = element("progress", { hidden: "", "aria-label": "How far it is" });
    this.stop = element("button", { type: "button", hidden: "" }, "Stop");
    this.editing = new Editing(page, {
      edit: (edit) => this.#changedBy((source) => ({ ...source, edits: [...source.edits, edit] })),
      undo: () => this.#undone(),
      motion: () => this.#changedBy((source) => ({ ...source, motion: true })),
      template: (kind, size) => this.#print(kind, size),
    });
    const chosen = element("input", { type: "file", multiple: "", "aria-label": "Files to open" });
    this.samples = element("div", { class: "samples", hidden: "" });
    bench.append(chosen, this.status, this.progress, this.stop, this.samples, ...this.editing.parts);
    chosen.addEventListener("change", () => this.#read([...(chosen.files ?? [])]));
    this.stop.addEventListener("click", () => { this.#stops += 1; this.#asked.forEach((_, asked) => asked.abort()); });
    this.#droppable(root);
    this.#present();
    this.changed();
    this.#offered().catch(reportError);
  }

  /** Offer samples to click, and say which formats are read, while nothing is shown. */
  async #offered() {
    const answer = await fetch("samples");
    if (!answer.ok) return;
    const { samples, formats } = /** @type {{samples: {name: string, title: string}[], formats: string[]}} */ (await answer.json());
    const buttons = samples.map(({ name, title }, number) => {
      const made = element("button", { type: "button" }, title);
      made.addEventListener("click", async () => this.#read([new File([await (await fetch(`sample?number=${number}`)).blob()], name)]));
      return made;
    });
    this.samples.replaceChildren(element("p", {}, `Formats: ${formats.join(" ")}. Or begin with a sample:`),
      element("div", { class: "row" }, ...buttons));
    this.changed();
  }

  /** Tell what can be done with what is chosen now. */
  changed() {
    this.editing.changed(this.sources[this.page.number()] ?? null, this.#history.length > 0);
    this.samples.hidden = this.sources.length > 0;
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
    } catch (error) {
      if (!(error instanceof TypeError)) throw error; // the line broke
    }
    this.status.textContent = ENDED;
  }

  /**
   * Do something when all before it is done.
   *
   * @param {() => Promise<void>} what
   */
  #inTurn(what) {
    const stops = this.#stops;
    this.#wait(1);
    this.#queue = this.#queue.then(() => {
      this.#wait(-1);
      return stops === this.#stops ? what() : undefined;
    }).catch(reportError);
  }

  /** @param {number} more */
  #wait(more) {
    this.#waiting += more;
    this.#say(this.#said);
  }

  /**
   * Show what happens, and how many things wait until it is done.
   *
   * @param {string} text
   */
  #say(text) {
    this.#said = text;
    const asked = [...this.#asked.values()];
    const waiting = this.#waiting - Math.max(0, asked.length - 1); // one of those asked is in its turn
    const more = waiting > 0 ? `; ${waiting} more ${waiting === 1 ? "waits" : "wait"}` : "";
    this.status.textContent = (asked.map((one) => one.text).join("; ") || text) + more;
    this.progress.max = Math.max(1, asked.reduce((sum, one) => sum + one.of, 0));
    this.progress.value = asked.reduce((sum, one) => sum + one.step, 0);
    this.progress.hidden = this.stop.hidden = !asked.length;
  }

  /**
   * Read files two at a time, as many as Python judges at once, and show them in their order.
   *
   * @param {File[]} files
   */
  #read(files) {
    /** @type {string[]} */
    const told = [];
    /** @type {Source[]} */
    const sources = files.map((file) => ({ name: file.name, file, edits: [], motion: false }));
    /** @type {Map<Source, Promise<{shown?: ShownData, error?: string}>>} */
    const begun = new Map();
    for (const [place, source] of sources.entries()) {
      this.#inTurn(async () => {
        for (const near of sources.slice(place, place + 2)) if (!begun.has(near)) begun.set(near, this.#judged(near));
        const { shown, error } = await /** @type {Promise<{shown?: ShownData, error?: string}>} */ (begun.get(source));
        if (shown) {
          this.#history.push({ number: this.sources.length, before: null });
          this.sources.push(source);
          this.page.add(shown);
        } else told.push(error ?? NO_ANSWER);
        this.#say(told.join("\n") || INVITED);
      });
    }
  }

  /** @param {(source: Source) => Source} changed */
  #changedBy(changed) {
    const number = this.page.number();
    this.#inTurn(async () => {
      const source = changed({ ...this.sources[number], file: await this.#fileOf(number) });
      const { shown, error } = await this.#judged(source);
      this.#say(error ?? (source.edits.join(", ") || INVITED));
      if (!shown) return;
      this.#history.push({ number, before: { source: this.sources[number], shown: this.page.shown[number] } });
      this.sources[number] = source;
      this.page.put(shown, number);
    });
  }

  /** Take back the last change: an edit, a search for motion, or a file that was opened. */
  #undone() {
    this.#inTurn(async () => {
      const last = this.#history.pop();
      if (!last) return;
      const { number, before } = last;
      if (before) {
        this.sources[number] = before.source;
        this.page.put(before.shown, number);
      } else {
        this.sources.splice(number, 1);
        this.page.drop(number);
      }
      this.#say(before?.source.edits.join(", ") || INVITED);
    });
  }

  /**
   * Save the template of what is seen.
   *
   * @param {string} kind
   * @param {number} size - Millimetres of its longer side.
   */
  #print(kind, size) {
    const number = this.page.number();
    this.#inTurn(async () => {
      const source = { ...this.sources[number], file: await this.#fileOf(number) };
      const asked = this.#begun(source.name);
      let content;
      try {
        const { answer, error } = await this.#answerOf("template", source, [["kind", kind], ["size", `${size}`]], asked);
        content = await answer?.blob();
        this.#say(error ?? INVITED);
      } finally {
        this.#ended(asked);
      }
      if (!content) return;
      const extension = content.type.includes("zip") ? "zip" : kind;
      saved(content, `${source.name.replace(/\.\w+$/, "")}.${extension}`);
    });
  }

  /** @param {number} number */
  async #fileOf(number) {
    return this.sources[number].file ?? (await (await fetch(`given?number=${number}`)).blob());
  }

  /**
   * Return what is to be shown of a file with its edits, or why there is nothing.
   *
   * @param {Source} source
   * @returns {Promise<{shown?: ShownData, error?: string}>}
   */
  async #judged(source) {
    const asked = this.#begun(source.name);
    try {
      const { answer, error } = await this.#answerOf("shown", source, source.motion ? [["motion", "yes"]] : [], asked);
      return answer?.body ? await this.#followed(source.name, answer.body, asked) : { error };
    } catch (broken) {
      return { error: `${source.name}: ${reason(broken)}` };
    } finally {
      this.#ended(asked);
    }
  }

  /**
   * Note that Python is asked something about a file.
   *
   * @param {string} name
   */
  #begun(name) {
    const asked = new AbortController();
    this.#asked.set(asked, { text: `${name}: starting`, step: 0, of: 1 });
    this.#say(this.#said);
    return asked;
  }

  /** @param {AbortController} asked */
  #ended(asked) {
    this.#asked.delete(asked);
    this.#say(this.#said);
  }

  /**
   * Tell how far an answer is, line by line; return the last.
   *
   * @param {string} name
   * @param {ReadableStream<Uint8Array>} body
   * @param {AbortController} asked
   * @returns {Promise<{shown?: ShownData, error?: string}>}
   */
  async #followed(name, body, asked) {
    const reader = body.getReader(), decoder = new TextDecoder();
    let rest = "", last = "{}";
    for (let piece = await reader.read(); !piece.done; piece = await reader.read()) {
      const lines = (rest + decoder.decode(piece.value, { stream: true })).split("\n");
      rest = lines.pop() ?? "";
      for (const line of lines.filter(Boolean)) {
        last = line; // of one that broke off, an error comes after it
        if (line.startsWith('{"doing"')) this.#told(name, JSON.parse(line), asked);
      }
    }
    const answer = JSON.parse(last);
    return answer.shown || answer.error ? answer : { error: `${name}: ${NO_ANSWER}` };
  }

  /**
   * @param {string} name
   * @param {{doing: string, step: number, of: number}} told
   * @param {AbortController} asked
   */
  #told(name, { doing, step, of }, asked) {
    this.#asked.set(asked, { text: `${name}: ${doing} (${Math.round((100 * step) / of)} %)`, step, of });
    this.#say(this.#said);
  }

  /**
   * Ask for something about a file; return why there is no answer.
   *
   * @param {string} what
   * @param {Source} source
   * @param {string[][]} more
   * @param {AbortController} asked
   * @returns {Promise<{answer?: Response, error?: string}>}
   */
  async #answerOf(what, { name, file, edits }, more, asked) {
    try {
      const words = new URLSearchParams([["name", name], ...edits.map((edit) => ["edit", edit]), ...more]);
      const answer = await fetch(`${what}?${words}`, { method: "POST", body: file, signal: asked.signal });
      if (answer.ok) return { answer };
      const told = await answer.text();
      const inWords = answer.headers.get("Content-Type") === "application/json";
      return { error: inWords ? JSON.parse(told).error : `${name}: ${told}` };
    } catch (broken) {
      return { error: `${name}: ${reason(broken)}` };
    }
  }
}

/**
 * Return why a request broke off; what is no such reason is an error of the page.
 *
 * @param {unknown} broken
 */
function reason(broken) {
  if (broken instanceof DOMException && broken.name === "AbortError") return "stopped";
  if (broken instanceof TypeError || broken instanceof SyntaxError) return NO_ANSWER;
  throw broken;
}
