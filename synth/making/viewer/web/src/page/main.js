/** The page: the data in it shown, chosen from, and moved. */

/** @import { PageData, ShownData } from "./types.js" */
/** @import { Held } from "./dragging.js" */
import { Dragging } from "./dragging.js";
import { forgetColours } from "./colours.js";
import { FlatFolded } from "./flat.js";
import { filled, layout } from "./layout.js";
import { Mechanism } from "./mechanism.js";
import { Model } from "./model.js";
import { Pattern } from "./pattern.js";
import { Playing } from "./playing.js";
import { foldText, objText, saved } from "./saving.js";
import { Sliders } from "./sliders.js";
import { Workbench } from "./workbench.js";
import "./style.css";

/** @type {Record<string, string>} */
const WORDS = { M: "mountain", V: "valley", U: "unassigned", B: "border", C: "cut", F: "flat", J: "join" };
const KINDS = {
  explicit: "explicit: a vertex of panels",
  implicit: "implicit: panels do not reach it",
  finite: "a point",
  infinite: "at infinity: the axes are parallel",
};
/** Faces up to which it is looked after every picture whether panels cross; milliseconds to wait with more. */
const FEW_FACES = 300, RESTED = 150;
/** Pairs of panels that are named. */
const MOST_TOLD = 4;
const NO_WEBGL = "This browser shows no WebGL, so there is no view in space; the drawing and the figures are here.";

/** @type {ShownData} */
const NOTHING = {
  name: "", verdict: "", report: "", notes: [], pictures: {}, moving: null, immobile: [], clusters: [], drawn: null, flat: null,
  on_request: false, answer: "", configuration: null,
};

class Page {
  /** @type {Mechanism | null} */
  #mechanism = null;
  /** @type {Model | null} */
  #model = null;
  /** @type {Workbench | null} */
  bench = null;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  #looking;

  /**
   * @param {HTMLElement} root
   * @param {PageData} data
   */
  constructor(root, { shown, workbench }) {
    this.all = shown;
    this.shown = shown[0] ?? NOTHING;
    this.parts = layout(root);
    this.pattern = new Pattern(this.parts.pattern, (id) => this.#chooseId(id));
    this.flat = new FlatFolded(this.parts.flat, (id) => this.#chooseId(id));
    const mechanism = () => this.#mechanism;
    this.playing = new Playing({
      mechanism,
      speed: () => Number(this.parts.speed.value),
      changed: () => this.#changed(),
      ended: () => { this.parts.play.textContent = "Play"; },
    });
    this.sliders = new Sliders(this.parts.sliders, {
      to: (joint, degrees) => this.#to(joint, degrees),
      along: (degrees) => this.#ask((mechanism) => mechanism.along(degrees)),
    });
    this.#model = this.#modelOrWhy();
    if (this.#model) {
      new Dragging(this.#model, {
        mechanism,
        folds: () => this.parts.folds.checked,
        chosen: (held) => this.#chooseHeld(held),
        changed: () => { this.playing.stop(); this.#changed(); },
      });
    }
    this.#listen();
    this.bench = workbench ? this.#workbench(root) : null;
    this.#listed(0);
  }

  /** @param {HTMLElement} root */
  #workbench(root) {
    return new Workbench(root, this.parts.bench, {
      shown: this.all,
      add: (shown) => { this.all.push(shown); this.#listed(this.all.length - 1); },
      put: (shown, number) => { this.all[number] = shown; this.#listed(number); },
      drop: (number) => { this.all.splice(number, 1); this.#listed(Math.max(0, number - 1)); },
      number: () => this.all.indexOf(this.shown),
      seen: () => this.shown,
      joint: () => this.pattern.marked?.joint ?? null,
      pick: (picked) => { this.pattern.pick = picked; this.parts.pattern.classList.toggle("picking", picked !== null); },
      mark: (places) => this.pattern.markPlaces(places),
    });
  }

  /** @param {number} number - Of the one to show. */
  #listed(number) {
    const { list } = this.parts;
    filled(list, this.all.map(({ name }, value) => ({ value, told: name || `${value}` })), number);
    list.hidden = this.all.length < 2;
    this.#show(number);
  }

  #modelOrWhy() {
    try {
      return new Model(this.parts.model);
    } catch (error) {
      if (!(error instanceof Error) || !/webgl/i.test(error.message)) throw error;
      this.parts.model.textContent = NO_WEBGL;
      return null;
    }
  }

  #listen() {
    const { list, way, driver, play, reset, fit, centres, fold, obj, png, svg, json } = this.parts;
    list.addEventListener("change", () => this.#show(Number(list.value)));
    way.addEventListener("change", () => { this.#mechanism?.take(Number(way.value)); this.#asked(); });
    driver.addEventListener("change", () => { this.#mechanism?.drive(Number(driver.value)); this.#asked(); });
    centres.addEventListener("change", () => this.#model?.showCentres(centres.checked));
    play.addEventListener("click", () => this.#toggle());
    reset.addEventListener("click", () => { this.#mechanism?.reset(); this.#asked(); });
    fit.addEventListener("click", () => this.#model?.fit());
    fold.addEventListener("click", () => this.#save("fold"));
    obj.addEventListener("click", () => this.#save("obj"));
    svg.addEventListener("click", () => this.#saveText(this.shown.pictures.light ?? "", "svg"));
    json.addEventListener("click", () => this.#saveText(this.shown.answer, "json"));
    png.addEventListener("click", async () => {
      const blob = await this.#model?.picture();
      if (blob) saved(blob, this.#file("png"));
    });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      forgetColours();
      this.#model?.coloured();
    });
  }

  /** @param {number} number */
  #show(number) {
    this.playing.stop();
    this.shown = this.all[number] ?? NOTHING;
    const { shown, parts } = this;
    document.title = shown.name || document.title;
    parts.verdict.textContent = shown.verdict;
    parts.report.textContent = shown.report;
    parts.notes.replaceChildren(...shown.notes.map((note) => {
      const item = document.createElement("li");
      item.textContent = note;
      return item;
    }));
    parts.part.textContent = "Click a link or a joint for its number.";
    parts.crossed.textContent = "";
    this.pattern.show(shown);
    this.flat.show(shown.flat);
    this.bench?.changed();
    parts.panes.hidden = parts.part.hidden = parts.details.hidden = parts.told.hidden = this.all.length === 0;
    this.#mechanism = shown.moving ? new Mechanism(shown, shown.moving) : null;
    const moves = this.#mechanism?.moves ?? false;
    parts.model.hidden = !this.#mechanism;
    parts.controls.hidden = !this.#mechanism;
    parts.svg.disabled = !shown.pictures.light;
    parts.centres.checked = !shown.moving?.solver.limited; // on a sheet they hide creases
    this.#model?.showCentres(parts.centres.checked);
    if (parts.centres.parentElement) parts.centres.parentElement.hidden = !shown.moving?.centres.length;
    const moving = [parts.play, parts.driver, parts.way, parts.reset];
    for (const one of moving) one.disabled = !moves;
    if (!this.#mechanism) return;
    const ways = shown.moving?.ways?.all ?? [];
    filled(parts.way, ways.map(({ told }, value) => ({ value, told })), this.#mechanism.way);
    if (parts.way.parentElement) parts.way.parentElement.hidden = ways.length < 2;
    if (this.#model) {
      this.#model.canvas.setAttribute("aria-label", `${shown.name} in space; arrow keys turn it`);
      this.#model.choose({ joint: -1, link: -1 });
      this.#model.show(this.#mechanism);
    }
    this.#asked();
  }

  /** What can be driven, and from where to where. */
  #asked() {
    const mechanism = this.#mechanism;
    if (!mechanism) return;
    const { driver } = this.parts;
    const joints = mechanism.data.joints.map((id, value) => ({ value, told: `joint ${id}` }));
    filled(driver, joints.filter(({ value }) => mechanism.canDrive(value)), mechanism.driver);
    this.sliders.show(mechanism);
    this.#changed();
  }

  /**
   * Bring a joint to an angle, the others with a slider held.
   *
   * @param {number} joint
   * @param {number} degrees
   */
  #to(joint, degrees) {
    if (!Number.isFinite(degrees)) return this.#changed();
    this.#ask((mechanism) => {
      mechanism.drive(joint);
      mechanism.to(degrees);
    });
  }

  /** @param {(mechanism: Mechanism) => void} what */
  #ask(what) {
    this.playing.stop();
    if (this.#mechanism) what(this.#mechanism);
    this.#changed();
    this.#onwards();
  }

  /** Go on with a way that is too long for one picture, unless something else was asked by then. */
  #onwards() {
    const mechanism = this.#mechanism;
    const goal = mechanism?.goal ?? null;
    if (goal === null) return;
    requestAnimationFrame(() => {
      if (this.#mechanism === mechanism && mechanism?.goal === goal) this.#ask(() => mechanism.goOn());
    });
  }

  #toggle() {
    this.playing.toggle();
    this.parts.play.textContent = this.playing.on ? "Pause" : "Play";
  }

  /** Show where everything is. */
  #changed() {
    const mechanism = this.#mechanism;
    if (!mechanism) return;
    const { status, driver } = this.parts;
    this.#model?.moved();
    this.#crossed(mechanism);
    if (!mechanism.moves) {
      status.textContent = "Nothing moves.";
      return;
    }
    this.sliders.moved(mechanism);
    driver.value = String(mechanism.driver);
    const told = `${mechanism.stopped || `joint ${mechanism.data.joints[mechanism.driver]} driven`}; `;
    status.textContent = `${told}loop-closure residual ${mechanism.error ? mechanism.error.toExponential(0) : 0}`;
  }

  /**
   * Say which panels pass through each other; of many panels when they have come to rest.
   *
   * @param {Mechanism} mechanism
   */
  #crossed(mechanism) {
    clearTimeout(this.#looking);
    const look = () => {
      if (mechanism !== this.#mechanism) return;
      const pairs = mechanism.crossings();
      this.#model?.cross(new Set(pairs.flat()));
      const { links } = mechanism.data;
      const told = pairs.slice(0, MOST_TOLD).map((pair) => pair.map((link) => links[link]).join(" and "));
      if (pairs.length > MOST_TOLD) told.push(`${pairs.length - MOST_TOLD} more pairs`);
      this.parts.crossed.textContent = pairs.length ? `Panels pass through each other: ${told.join(", ")}` : "";
    };
    if (mechanism.data.bodies.faces.length <= FEW_FACES) look();
    else this.#looking = setTimeout(look, RESTED);
  }

  /** @param {Held | null} held */
  #chooseHeld(held) {
    const centre = this.shown.moving?.centres[held?.centre ?? -1];
    if (!centre) return this.#choose(held?.joint ?? -1, held?.link ?? -1);
    const joints = centre.joints.map((joint) => this.shown.moving?.joints[joint]).join(", ");
    const shared = centre.loops > 1 ? `, shared by ${centre.loops} loops` : "";
    this.#choose(-1, -1);
    this.parts.part.textContent = `Centre ${held?.centre}, ${KINDS[centre.kind]}; of joints ${joints}${shared}`;
  }

  /** @param {{joint?: string, link?: string} | null} id */
  #chooseId(id) {
    const moving = this.shown.moving;
    if (moving) this.#choose(moving.joints.indexOf(id?.joint ?? ""), moving.links.indexOf(id?.link ?? ""), id);
    else this.#told(id, "");
  }

  /**
   * Mark a joint or a link in both panes, and tell what it is; a joint that can be is driven from now on.
   *
   * @param {number} joint - Its place; -1: none.
   * @param {number} link
   * @param {{joint?: string, link?: string} | null} [id] - In the drawing, where it has one that does not move.
   */
  #choose(joint, link, id = null) {
    const mechanism = this.#mechanism;
    if (!mechanism) return;
    const { joints, links, between } = mechanism.data;
    this.#model?.choose({ joint, link });
    if (joint >= 0) {
      if (mechanism.canDrive(joint) && joint !== mechanism.driver) {
        this.playing.stop();
        mechanism.drive(joint);
        this.#changed();
      }
      const letter = mechanism.data.bodies.edges.find((edge) => edge.joint === joint)?.letter ?? "";
      const ends = between[joint].map((one) => links[one]).join(" and ");
      const what = [WORDS[letter], `${mechanism.angleOf(joint).toFixed(2)}°`, mechanism.immobile.has(joint) && "immobile"];
      this.#told({ joint: joints[joint] }, `between links ${ends}: ${what.filter(Boolean).join(", ")}`);
    } else if (link >= 0) this.#told({ link: links[link] }, this.#clusterTold(mechanism, link));
    else this.#told(id, "");
  }

  /**
   * @param {Mechanism} mechanism
   * @param {number} link
   */
  #clusterTold(mechanism, link) {
    const cluster = mechanism.clusterOf.get(link);
    if (cluster === undefined) return "";
    const others = this.shown.clusters[cluster].length - 1;
    return `moves as one with ${others} other ${others === 1 ? "link" : "links"}`;
  }

  /**
   * @param {{joint?: string, link?: string} | null} id
   * @param {string} more
   */
  #told(id, more) {
    this.pattern.mark(id);
    this.bench?.changed();
    const what = id?.joint !== undefined ? `Joint ${id.joint}` : id?.link !== undefined ? `Link ${id.link}` : "";
    this.parts.part.textContent = what ? `${what} ${more}`.trim() : "Click a link or a joint for its number.";
  }

  /** @param {"fold" | "obj"} kind */
  #save(kind) {
    const mechanism = this.#mechanism;
    if (!mechanism) return;
    this.#saveText(kind === "fold" ? foldText(this.shown, mechanism) : objText(mechanism), kind);
  }

  /**
   * @param {string} text
   * @param {string} kind
   */
  #saveText(text, kind) {
    saved(new Blob([text], { type: "text/plain" }), this.#file(kind));
  }

  /** @param {string} kind */
  #file(kind) {
    return `${(this.shown.name || "pose").replace(/\.\w+$/, "")}.${kind}`;
  }
}

const root = document.getElementById("page");
const data = document.getElementById("data");
if (root && data) {
  const page = new Page(root, JSON.parse(data.textContent ?? "[]"));
  root.dataset.ready = String(page.all.length);
}
