/** The candidates over one face of the front in a ball, as the engine has recorded them, and their order for other weights. */
import { effect, untracked } from "@preact/signals-core";
import { loadTrace, type Refusal, type Trace } from "tetrafront/trace";
import type { Position } from "../../../../document/position";
import { length, mean } from "../../../../document/vectors";
import { roundedParts } from "../../../player/recorded-score";
import { colours } from "../../kit/colours";
import { element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { FilmPlayer, type Film } from "../../kit/film-player";
import { Pen } from "../../kit/pen";
import { Camera } from "../../kit/space";
import { Stage } from "../../kit/stage";
import type { Values } from "../../kit/values";
import { CandidateList, type BarPart, type ListedCandidate } from "./candidate-list";
import "./candidates.css";
import { SpaceDrawing } from "./space-drawing";
import {
  frameOf,
  ownWeights,
  partsOf,
  rankBy,
  scoreOf,
  spaceStepAt,
  type SpaceCandidate,
  type SpaceStep,
  type Weights,
} from "./space-rules";

const states: Readonly<Record<string, number>> = { start: 307, new: 307, wedge: 476, crossed: 380 };
const verdicts: Readonly<Record<Refusal | "accepted" | "not tried", string>> = {
  accepted: "taken",
  "not tried": "not tried",
  behind: "behind the face",
  crosses: "crosses a face",
  "too-close": "too close to a face",
};
const letters = "abcdefghijklmnop";
/** Scores have four digits that are right. */
const decimals = 3;

/** The record lies beside the scripts of the site; the development server has it at the root. */
const address = (): string =>
  import.meta.env.DEV
    ? "/traces/ball.tft"
    : new URL(["..", "traces", "ball.tft"].join("/"), import.meta.url).href;

export class CandidatesSpaceFigure implements Figure {
  readonly #stage = new Stage(() => this.#draw());
  readonly #camera = new Camera(this.#stage, { target: [0, 0, 0.22], distance: 5.4, yaw: 0.5, pitch: 0.72 });
  readonly #drawing = new SpaceDrawing(this.#camera, new Pen(this.#stage.context));
  readonly #list = new CandidateList((name) => this.#light(name));
  readonly #status = element("p", { class: "status", role: "status" });
  readonly #player: FilmPlayer = new FilmPlayer({
    beats: ["1", "2", "3", "4", "5"],
    onChange: () => this.#seek(),
    describe: () => `step ${this.#k}, ${this.#step?.candidates.length ?? 0} candidates`,
  });
  #values: Values | null = null;
  #trace: Trace | null = null;
  #step: SpaceStep | null = null;
  #ranking: readonly SpaceCandidate[] = [];
  #lit: string | null = null;
  #shown: string | null = null;
  #isHandled = false;
  #isLed = false;
  /** Whether the text is about a refusal, so that the refused element is shown. */
  #isRefusalTold = false;

  async mount(host: HTMLElement, values: Values): Promise<void> {
    this.#values = values;
    const key = element("p", { class: "bar-key", "aria-hidden": "true" });
    for (const [name, label] of [
      ["shape", "shape"],
      ["closing", "closed sides"],
      ["wedge", "acute angle"],
      ["lost", "what is taken away"],
    ] as const)
      key.append(element("span", { class: `key-${name}` }, label));
    const bars = element("div", { class: "candidate-bars" }, key, this.#list.element);
    host.append(
      element("div", { class: "candidates-split space" }, this.#stage.element, bars),
      this.#player.element,
      this.#status,
    );
    const response = await fetch(address());
    const read = await loadTrace(new Uint8Array(await response.arrayBuffer()));
    if (!read.success) throw new Error("The trace of the ball cannot be read.");
    this.#trace = read.value;
    this.#player.setFilm(filmOf(read.value));
    this.#player.seek((states["start"] ?? 1) - 1);
    let isFirst = true;
    effect(() => {
      for (const name of ["newnode", "wedge", "closing"]) values.number(name);
      if (!isFirst && !this.#isLed) this.#isHandled = true;
      isFirst = false;
      untracked(() => this.#rank());
    });
  }

  go({ step, weights }: Readonly<Record<string, string>>): void {
    this.#isHandled = false;
    this.#isRefusalTold = step === "crossed";
    this.#isLed = true;
    if (weights === "own") {
      this.#values?.ask("newnode", ownWeights.newNode);
      this.#values?.ask("wedge", ownWeights.wedge);
      this.#values?.ask("closing", 100 * ownWeights.closing);
    }
    this.#isLed = false;
    if (step !== undefined) this.#player.glideTo((states[step] ?? Number(step)) - 1, 0);
    else this.#rank();
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#stage.requestDraw();
  }

  get #k(): number {
    return Math.min(this.#trace?.stepCount ?? 1, this.#player.finished + 1);
  }

  get #weights(): Weights {
    const number = (name: string): number => this.#values?.number(name) ?? 0;
    return { newNode: number("newnode"), wedge: number("wedge"), closing: number("closing") / 100 };
  }

  #light(name: string | null): void {
    this.#shown = name;
    this.#show();
  }

  #seek(): void {
    const trace = this.#trace;
    if (!trace) return;
    if (this.#step?.step !== this.#k) this.#step = spaceStepAt(trace, this.#k);
    this.#rank();
  }

  #rank(): void {
    const [step, values] = [this.#step, this.#values];
    if (!step || !values || !this.#trace) return;
    const weights = this.#weights;
    const isOwn =
      weights.newNode === ownWeights.newNode &&
      weights.wedge === ownWeights.wedge &&
      Math.abs(weights.closing - ownWeights.closing) < 1e-9;
    this.#ranking = isOwn ? step.candidates : rankBy(step.candidates, weights);
    const [[first, second], [ownFirst]] = [this.#ranking, step.candidates];
    const accepted = step.candidates.find(({ verdict }) => verdict === "accepted");
    const best = Math.max(...step.candidates.map(({ shape }) => shape));
    values.put({
      step: step.step,
      steps: this.#trace.stepCount,
      ranked: step.candidates.length,
      refused: step.candidates.filter(({ verdict }) => verdict !== "accepted" && verdict !== "not tried")
        .length,
      first: this.#nameOf(first),
      accepted: this.#nameOf(accepted),
      engine: this.#nameOf(ownFirst),
      bestshape: best,
      acceptedshape: accepted?.shape ?? 0,
      bestlost: (accepted?.shape ?? 0) < best,
      newfactor: weights.newNode ** 3,
      bestscore: first ? scoreOf(first, weights) : 0,
      second: this.#nameOf(second),
      secondscore: second ? scoreOf(second, weights) : 0,
      ownweights: isOwn,
      changed: first !== ownFirst,
      newfirst: first?.node === null,
      wedges: step.candidates.filter(({ isWedge }) => isWedge).length,
      handled: this.#isHandled || this.#player.isHandled,
    });
    const told = step.candidates
      .filter(({ verdict }) => verdict !== "not tried")
      .map((each) => `${this.#nameOf(each)} (${verdicts[each.verdict]})`)
      .join(", then ");
    this.#status.replaceChildren(
      `Step ${step.step} of ${this.#trace.stepCount}. The program tried `,
      element("b", {}, told || "none"),
      ".",
      ...(isOwn
        ? []
        : [
            " With your weights, ",
            element("b", {}, this.#nameOf(first)),
            first === ownFirst ? " is still the first." : " would be the first.",
          ]),
    );
    this.#show();
  }

  #nameOf(candidate: SpaceCandidate | undefined): string {
    if (!candidate) return "none";
    if (candidate.node === null)
      return candidate.height === 1 ? "new" : `new ${Math.round(100 * candidate.height)} %`;
    const nodes = (this.#step?.candidates ?? []).filter(({ node }) => node !== null);
    return letters[nodes.findIndex(({ node }) => node === candidate.node)] ?? "";
  }

  #show(): void {
    const weights = this.#weights;
    const listed = this.#ranking.map((candidate): ListedCandidate => {
      const { verdict, shape, node } = candidate;
      const parts = roundedParts({ ...partsOf(candidate, weights) }, decimals);
      const score = scoreOf(candidate, weights);
      const bars: readonly BarPart[] =
        node === null
          ? [
              { kind: "shape", label: "shape", value: Math.min(shape, score) },
              { kind: "lost", label: "new node", value: Math.max(0, -parts.newNode) },
              { kind: "lost", label: "height", value: Math.max(0, -parts.height) },
            ]
          : [
              { kind: "shape", label: "shape", value: parts.shape },
              { kind: "closing", label: "closed sides", value: parts.closing },
              { kind: "wedge", label: "acute angle", value: parts.wedge },
              { kind: "pocket", label: "fills a pocket", value: parts.pocket },
            ];
      return {
        name: this.#nameOf(candidate),
        look: verdict === "accepted" ? "accepted" : verdict === "not tried" ? "idle" : "refused",
        isNew: node === null,
        parts: bars,
        score,
        decimals,
        shape,
        verdict: verdicts[verdict],
      };
    });
    const longest = listed.map(({ score, shape }) => Math.max(Math.min(score, 3.2), shape));
    this.#list.show(listed, { axis: Math.max(1.2, ...longest), lit: this.#shown });
    this.#stage.requestDraw();
  }

  #draw(): void {
    const step = this.#step;
    if (!step) return;
    const c = colours();
    const { to, size } = frameOf(step);
    const trace = this.#trace;
    const at = (node: number): Position =>
      to([0, 1, 2].map((axis) => trace?.nodes.positions[3 * node + axis] ?? 0) as unknown as Position);
    const base = step.base.map(to) as unknown as readonly [Position, Position, Position];
    const named = this.#ranking.map((candidate) => ({
      candidate,
      name: this.#nameOf(candidate),
      apex: to(candidate.at),
    }));
    const accepted = named.find(({ candidate }) => candidate.verdict === "accepted");
    const isRefusedLit = this.#lit === "refused" || (this.#isRefusalTold && !this.#player.isHandled);
    const chosen =
      named.find(({ name }) => name === this.#shown) ??
      (isRefusedLit ? named.find(({ candidate }) => candidate.culprit !== null) : undefined) ??
      accepted;
    const near = step.faces.flatMap(({ index, nodes }) => {
      const corners = nodes.map(at) as unknown as readonly [Position, Position, Position];
      const isCulprit = chosen?.candidate.culprit === index;
      return length(mean(corners)) < 3 ? [{ corners, isCulprit }] : [];
    });
    if (size === 0) return;
    this.#drawing.drawFront(near);
    this.#drawing.drawBase(base, this.#lit === "base");
    // One element at a time; of the others, those that were tried before it are outlines.
    for (const { candidate, apex, name } of named)
      if (name !== chosen?.name && candidate.verdict !== "not tried")
        this.#drawing.drawFan(
          base,
          apex,
          candidate.verdict === "accepted" ? c.new : c.refused,
          0.7,
          candidate.verdict === "accepted" ? [] : [5, 4],
        );
    if (chosen) {
      const { verdict } = chosen.candidate;
      const look = verdict === "accepted" ? "accepted" : verdict === "not tried" ? "idle" : "refused";
      this.#drawing.drawElement(base, { apex: chosen.apex, look });
    }
    this.#drawDots(step, named, chosen?.name ?? null, to);
  }

  #drawDots(
    step: SpaceStep,
    named: readonly { readonly candidate: SpaceCandidate; readonly name: string; readonly apex: Position }[],
    chosen: string | null,
    to: (position: Position) => Position,
  ): void {
    const c = colours();
    const { pen } = this.#drawing;
    for (const { candidate, name, apex } of named) {
      const { verdict, node, height } = candidate;
      // Lower new nodes lie on one line; the one in question is shown.
      if (node === null && height !== 1 && name !== chosen && verdict !== "accepted") {
        pen.circle(this.#camera.pixel(apex), 2.5, c.active, { alpha: 0.7 });
        continue;
      }
      const pixel = this.#camera.pixel(apex);
      const colour = verdict === "accepted" ? c.new : verdict === "not tried" ? c.plate : c.refused;
      pen.circle(pixel, name === chosen ? 7.5 : 6, colour, { stroke: c.ink, width: 2 });
      const look = verdict === "accepted" ? "new" : verdict === "not tried" ? "" : "refused";
      this.#stage.label(name, pixel, { dy: -19, look: `${look} plate big` });
    }
    const ideal = this.#camera.pixel(to(step.ideal));
    const isLit = this.#lit === "ideal";
    if (isLit) pen.circle(ideal, 18, c.active, { alpha: 0.3 });
    pen.circle(ideal, isLit ? 7 : 4.5, null, { stroke: c.active, width: isLit ? 3.5 : 2.25 });
  }
}

function filmOf(trace: Trace): Film {
  const refusals: number[] = [];
  const sizes = [trace.frontAt(0).length];
  for (let k = 1; k <= trace.stepCount; k++) {
    const step = trace.stepAt(k);
    sizes.push((sizes.at(-1) ?? 0) + (step?.addedFaces.length ?? 0) - (step?.removedFaces.length ?? 0));
    if (step?.kind === "advance" && step.candidates.some(({ verdict }) => verdict !== "accepted"))
      refusals.push(k - 1);
  }
  return { stepCount: trace.stepCount - 1, sizes, refusals };
}
