/** The candidates over one side, by the engine's front in the plane. The reader drags the nodes of the front. */
import { effect, untracked } from "@preact/signals-core";
import { loadPlaneFront, type EdgeRefusal, type PlaneFront } from "tetrafront/trace";
import { colours } from "../../kit/colours";
import { element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { Motion } from "../../kit/motion";
import { between, Pen, widths } from "../../kit/pen";
import { PlaneView, type PlanePoint } from "../../kit/plane-view";
import { Stage, type Pixel } from "../../kit/stage";
import type { Values } from "../../kit/values";
import { CandidateList, type BarPart, type ListedCandidate } from "./candidate-list";
import "./candidates.css";
import { captureRadius, firstStep, type PlaneCandidate, type PlaneStep } from "./plane-rules";

/** Smallest x and y, largest x and y of what is shown. */
const frame = [-2.05, -0.35, 2.05, 2.15] as const;
const names = "abcdefghijklmn";
const verdicts: Readonly<Record<EdgeRefusal | "accepted" | "not tried", string>> = {
  accepted: "taken",
  "not tried": "not needed",
  behind: "behind the side",
  crosses: "crosses a side",
  "too-close": "too close to a side",
  "same-node": "already a node",
  outside: "outside",
};
/** Length of a whole bar: the best score. */
const axis = 2;

const near: readonly PlanePoint[] = [
  [-0.5, 0],
  [0.5, 0],
  [1.3, 0.12],
  [1.72, 0.9],
  [1.12, 1.42],
  [0.26, 1.12],
  [-0.42, 1.78],
  [-1.22, 1.5],
  [-1.72, 0.82],
  [-1.26, 0.14],
];
const moved = (changes: Readonly<Record<number, PlanePoint>>): readonly PlanePoint[] =>
  near.map((point, i) => changes[i] ?? point);
const poses: Readonly<Record<string, readonly PlanePoint[]>> = {
  near,
  far: moved({ 5: [0.5, 1.5] }),
  blocked: moved({ 5: [0.1, 1.06], 6: [-0.2, 0.42] }),
  narrow: moved({ 4: [0.95, 1.62], 5: [0.62, 1.36], 6: [-0.62, 1.36] }),
};

export class CandidatesFigure implements Figure {
  readonly #stage = new Stage(() => this.#draw());
  readonly #view = new PlaneView(this.#stage, frame);
  readonly #pen = new Pen(this.#stage.context);
  readonly #list = new CandidateList((name) => this.#light(name));
  readonly #notice = element("div", { class: "notice", role: "status" });
  readonly #motion = new Motion();
  #values: Values | null = null;
  #engine: PlaneFront | null = null;
  #corners = near;
  /** The last possible corners, to which an impossible shape springs back. */
  #sound = near;
  #step: PlaneStep | null = null;
  #lit: string | null = null;
  /** The candidate under the pointer, by its name. */
  #shown: string | null = null;
  #isHandled = false;
  #isLed = false;

  async mount(host: HTMLElement, values: Values): Promise<void> {
    this.#values = values;
    const key = element("p", { class: "bar-key", "aria-hidden": "true" });
    for (const [name, label] of [
      ["ideal", "2 for a place in the ring"],
      ["lost", "less the distance"],
      ["shape", "shape"],
    ] as const)
      key.append(element("span", { class: `key-${name}` }, label));
    const bars = element("div", { class: "candidate-bars" }, key, this.#list.element);
    host.append(element("div", { class: "candidates-split" }, this.#stage.element, bars), this.#notice);
    this.#engine = await loadPlaneFront();
    this.#stage.setHandles(
      near.map((_point, corner) => ({
        name: `corner-${corner}`,
        label: corner < 2 ? `End ${corner + 1} of the active side` : `Node ${names[corner - 2] ?? ""}`,
        look: corner < 2 ? "active solid" : "node",
        at: () => this.#view.pixel(this.#corners[corner] ?? [0, 0]),
        begin: () => this.#motion.stop(),
        move: (pixel) => this.#moveCorner(corner, this.#view.point(pixel)),
        end: () => this.#springBack(),
      })),
    );
    let isFirst = true;
    effect(() => {
      values.number("size");
      if (!isFirst && !this.#isLed) this.#isHandled = true;
      isFirst = false;
      untracked(() => this.#compute());
    });
  }

  go({ pose, size }: Readonly<Record<string, string>>): void {
    this.#isHandled = false;
    this.#isLed = true;
    if (size !== undefined) this.#values?.ask("size", Number(size));
    this.#isLed = false;
    const [from, to] = [this.#corners, poses[pose ?? ""] ?? this.#corners];
    this.#motion.run(700, (t) => {
      this.#corners = from.map((point, i) => between(point, to[i] ?? point, t));
      this.#compute();
    });
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#stage.requestDraw();
  }

  #light(name: string | null): void {
    this.#shown = name;
    this.#show();
  }

  #moveCorner(corner: number, to: PlanePoint): void {
    this.#isHandled = true;
    const inside = this.#view.inside(to, 0.06);
    this.#corners = this.#corners.map((point, i) => (i === corner ? inside : point));
    this.#compute();
  }

  #springBack(): void {
    if (this.#notice.textContent === "") return;
    const [from, to] = [this.#corners, this.#sound];
    this.#motion.run(300, (t) => {
      this.#corners = from.map((point, i) => between(point, to[i] ?? point, t));
      if (t === 1) this.#compute();
      else this.#stage.requestDraw();
    });
  }

  #compute(): void {
    const [engine, values] = [this.#engine, this.#values];
    if (!engine || !values) return;
    const step = firstStep(engine, this.#corners, values.number("size"));
    this.#notice.textContent = typeof step === "string" ? step : "";
    if (typeof step === "string") return this.#stage.requestDraw();
    this.#sound = this.#corners;
    this.#step = step;
    const { candidates } = step;
    const accepted = candidates.find(({ verdict }) => verdict === "accepted");
    const acceptedIndex = accepted ? candidates.indexOf(accepted) : -1;
    const best = candidates.reduce((most, each) => (each.shape > most.shape ? each : most));
    const nearest = candidates.find(({ corner }) => corner !== null);
    const fresh = candidates.find(({ corner }) => corner === null);
    const awayOf = (candidate: PlaneCandidate | undefined): number =>
      candidate
        ? Math.hypot(candidate.at[0] - step.ideal[0], candidate.at[1] - step.ideal[1]) / step.target
        : 0;
    const count = (verdict: string): number => candidates.filter((each) => each.verdict === verdict).length;
    values.put({
      ranked: candidates.length,
      refused: candidates.filter(({ verdict }) => verdict !== "accepted" && verdict !== "not tried").length,
      crossed: count("crosses"),
      tooclose: count("too-close"),
      first: this.#nameOf(candidates[0]),
      accepted: this.#nameOf(accepted),
      bestshape: best.shape,
      acceptedshape: accepted?.shape ?? 0,
      bestlost: best !== accepted,
      newwins:
        accepted?.corner === null &&
        candidates.some(
          ({ corner, verdict }, i) => corner !== null && i > acceptedIndex && verdict === "not tried",
        ),
      takesring: accepted !== undefined && accepted.corner !== null && awayOf(accepted) < captureRadius,
      takesnew: accepted?.corner === null,
      takesnone: accepted === undefined,
      acceptedscore: accepted?.score ?? 0,
      acceptedaway: awayOf(accepted),
      newshape: fresh?.shape ?? 0,
      newscore: fresh?.score ?? 0,
      score: nearest?.score ?? 0,
      away: awayOf(nearest),
      handled: this.#isHandled,
    });
    this.#show();
  }

  #nameOf(candidate: PlaneCandidate | undefined): string {
    if (!candidate) return "none";
    if (candidate.corner !== null) return names[candidate.corner - 2] ?? "";
    const fresh = this.#step?.candidates.filter(({ corner }) => corner === null) ?? [];
    return fresh.indexOf(candidate) > 0 ? "new, lower" : "new";
  }

  #show(): void {
    const candidates = this.#step?.candidates ?? [];
    this.#list.show(
      candidates.map((candidate): ListedCandidate => {
        const { shape, ideal, distance } = candidate.parts;
        const parts: readonly BarPart[] =
          ideal > 0
            ? [
                { kind: "ideal", label: "at the ideal point", value: ideal + distance },
                { kind: "lost", label: "distance", value: -distance },
              ]
            : [{ kind: "shape", label: "shape", value: shape }];
        const { verdict } = candidate;
        return {
          name: this.#nameOf(candidate),
          look: verdict === "accepted" ? "accepted" : verdict === "not tried" ? "idle" : "refused",
          isNew: candidate.corner === null,
          parts,
          score: candidate.score,
          decimals: 2,
          shape: candidate.shape,
          verdict: verdicts[verdict],
          triangle: [this.#corners[0] ?? [0, 0], this.#corners[1] ?? [0, 0], candidate.at],
        };
      }),
      { axis, threshold: axis - captureRadius, lit: this.#shown },
    );
    this.#stage.requestDraw();
  }

  #draw(): void {
    const c = colours();
    const pen = this.#pen;
    const at = (point: PlanePoint): Pixel => this.#view.pixel(point);
    const outline = this.#corners.map(at);
    const { context } = this.#stage;
    // What is filled: a warm band around what is empty.
    pen.path(outline);
    context.strokeStyle = `rgb(${c.stone.join(" ")})`;
    context.lineWidth = 0.34 * this.#view.scale;
    context.stroke();
    pen.polygon(outline, c.void);
    const [a, b] = [outline[0] ?? [0, 0], outline[1] ?? [0, 0]] as [Pixel, Pixel];
    const step = this.#step;
    const isSound = this.#notice.textContent === "";
    if (step && isSound) {
      this.#drawReach(step);
      this.#drawFans(step, a, b);
    }
    pen.polygon(outline, null, 1, { colour: isSound ? c.ink : c.refused, width: widths.front });
    pen.glow(a, b, c.active, this.#lit === "base" ? 1.4 : 1);
    if (step && isSound) {
      for (const candidate of step.candidates) this.#drawVerdict(candidate, a, b);
      this.#drawIdeal(step, between(a, b, 0.5));
      this.#drawNames(step, between(a, b, 0.5));
    }
  }

  #drawReach({ ideal, target }: PlaneStep): void {
    const c = colours();
    const isLit = this.#lit === "reach";
    this.#pen.circle(this.#view.pixel(ideal), captureRadius * target * this.#view.scale, c.active, {
      alpha: isLit ? 0.2 : 0.09,
      stroke: c.active,
      width: isLit ? 3 : 1.25,
      strokeAlpha: isLit ? 1 : 0.6,
      dash: [2, 5],
    });
  }

  #drawFans({ candidates }: PlaneStep, a: Pixel, b: Pixel): void {
    const c = colours();
    const pen = this.#pen;
    for (const candidate of [...candidates].reverse()) {
      const to = this.#view.pixel(candidate.at);
      const isShown = this.#shown === this.#nameOf(candidate);
      const isAccepted = candidate.verdict === "accepted";
      if (isAccepted) {
        const isLit = this.#lit === "accepted";
        pen.polygon([a, b, to], c["new-soft"], isLit ? 1 : 0.85, { colour: c.new, width: isLit ? 4.5 : 3 });
      } else if (candidate.verdict === "not tried") {
        if (isShown) pen.polygon([a, b, to], c.ink, 0.12);
        for (const end of [a, b])
          pen.line(end, to, c.ink, isShown ? 2.25 : 1.1, {
            alpha: isShown ? 0.9 : 0.34,
            dash: isShown ? [] : [2, 5],
          });
      }
      if (isShown && isAccepted) pen.polygon([a, b, to], c.new, 0.3, { colour: c.new, width: 4.5 });
    }
  }

  #drawVerdict(candidate: PlaneCandidate, a: Pixel, b: Pixel): void {
    const { verdict, culprit, at } = candidate;
    if (verdict === "accepted" || verdict === "not tried") return;
    const c = colours();
    const pen = this.#pen;
    const to = this.#view.pixel(at);
    const isStrong = this.#shown === this.#nameOf(candidate) || this.#lit === "refused";
    pen.polygon([a, b, to], c.refused, isStrong ? 0.2 : 0.07);
    for (const end of [a, b])
      pen.line(end, to, c.refused, isStrong ? 3 : 1.8, { dash: [6, 5], alpha: isStrong ? 1 : 0.8 });
    if (!culprit) return;
    const [from, end] = culprit.map((point) => this.#view.pixel(point)) as [Pixel, Pixel];
    pen.line(from, end, c.refused, 5);
    const inside = [from, end].find((pixel) => pixel !== to && isInside(pixel, [a, b, to]));
    pen.cross(inside ?? between(from, end, 0.5), 7.5, c.refused, 3.25);
  }

  #drawIdeal({ ideal, candidates }: PlaneStep, middle: Pixel): void {
    const c = colours();
    const at = this.#view.pixel(ideal);
    const isLit = this.#lit === "ideal";
    const isNew = candidates.some(({ corner, verdict }) => corner === null && verdict === "accepted");
    this.#pen.line(middle, at, c.active, isLit ? 3 : 1.5, { alpha: 0.75 });
    if (isLit) this.#pen.circle(at, 17, c.active, { alpha: 0.28 });
    this.#pen.circle(at, 7, isNew ? c.new : c.plate, { stroke: isNew ? c.ink : c.active, width: 2.5 });
    for (const { corner, at: lower, verdict } of candidates)
      if (corner === null && lower[1] !== ideal[1])
        this.#pen.circle(this.#view.pixel(lower), 6, verdict === "accepted" ? c.new : c.plate, {
          stroke: c.ink,
          width: 2,
        });
  }

  #drawNames({ candidates }: PlaneStep, middle: Pixel): void {
    const listed = new Map(candidates.map((each) => [each.corner, each]));
    this.#corners.forEach((corner, index) => {
      if (index < 2) return;
      const [x, y] = this.#view.pixel(corner);
      const away = Math.hypot(x - middle[0], y - middle[1]) || 1;
      const candidate = listed.get(index);
      const look =
        candidate?.verdict === "accepted"
          ? "new big"
          : candidate
            ? candidate.verdict === "not tried"
              ? "big"
              : "refused big"
            : "soft big";
      this.#stage.label(
        names[index - 2] ?? "",
        [x + ((x - middle[0]) / away) * 22, y + ((y - middle[1]) / away) * 22],
        { look },
      );
    });
    const fresh = candidates.find(({ corner }) => corner === null);
    if (!fresh) return;
    const look =
      fresh.verdict === "accepted" ? "new big" : fresh.verdict === "not tried" ? "active big" : "refused big";
    this.#stage.label("new", this.#view.pixel(fresh.at), { dx: -28, dy: 0, look });
  }
}

/** Returns whether a pixel lies inside a triangle, not at its corners. */
function isInside([x, y]: Pixel, corners: readonly [Pixel, Pixel, Pixel]): boolean {
  const signs = corners.map((from, i) => {
    const to = corners[(i + 1) % 3] ?? from;
    return Math.sign(Math.round((to[0] - from[0]) * (y - from[1]) - (to[1] - from[1]) * (x - from[0])));
  });
  return signs[0] !== 0 && signs.every((sign) => sign === signs[0]);
}
