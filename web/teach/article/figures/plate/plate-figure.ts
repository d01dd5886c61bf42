/** A plate with a hole: solved on an even mesh, and on one that the reader makes finer in one place, or of needles. */
import { effect, untracked } from "@preact/signals-core";
import { loadPlaneFront, type PlaneFront } from "tetrafront/trace";
import { colours } from "../../kit/colours";
import { element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { Motion } from "../../kit/motion";
import type { PlanePoint } from "../../kit/plane-view";
import type { HandleOptions } from "../../kit/stage";
import type { Values } from "../../kit/values";
import { highestStress, type Hole } from "./exact-plate";
import "./plate.css";
import { meshPlate, plate, spotRadius, withinPlate, type MeshPlan } from "./plate-mesh";
import { PlatePanel } from "./plate-panel";
import { solvePlate, type SolvedPlate } from "./solve-plate";

const holes: Readonly<Record<string, Hole>> = {
  round: { at: [0, 0], a: 0.16, b: 0.16 },
  slit: { at: [0, 0], a: 0.05, b: 0.2 },
  flat: { at: [0, 0], a: 0.24, b: 0.06 },
};
const roundHole: Hole = { at: [0, 0], a: 0.16, b: 0.16 };
const spotCorner: PlanePoint = [0.62, 0.3];
const curtains: Readonly<Record<string, number>> = { middle: 0, mesh: plate[0], truth: -plate[0] };
/** Where the line begins that shows and sets the needles. */
const needleOrigin: PlanePoint = [0.45, -0.05];
/** Length of this line without a stretch, and with the largest. */
const needleReach = [0.1, 0.4] as const;

export class PlateFigure implements Figure {
  #values: Values | null = null;
  #engine: PlaneFront | null = null;
  readonly #motion = new Motion();
  readonly #panels: PlatePanel[] = [];
  readonly #solved: (SolvedPlate | null)[] = [];
  #hole = roundHole;
  #spot = spotCorner;
  #curtain = 0;
  #lit: string | null = null;
  #isHandled = false;
  #isLed = false;
  #frame = 0;
  readonly #changed = new Set<number>();

  constructor(readonly kind: "truth" | "spot" | "needles") {}

  async mount(host: HTMLElement, values: Values): Promise<void> {
    this.#values = values;
    const isAlone = this.kind === "truth";
    const second = { truth: undefined, spot: "Yours", needles: "Needles" }[this.kind];
    this.#panels.push(new PlatePanel(isAlone ? "Highest stress" : "Even"));
    if (second !== undefined) this.#panels.push(new PlatePanel(second, (panel) => this.#drawOwn(panel)));
    host.append(
      element(
        "div",
        { class: isAlone ? "plates alone" : "plates" },
        ...this.#panels.map((panel) => panel.element),
      ),
    );
    this.#panels.forEach((panel, index) => panel.stage.setHandles(this.#handlesOf(panel, index)));
    this.#engine = await loadPlaneFront();
    this.#follow(["even"], 0);
    if (!isAlone) this.#follow(["own", "factor", "stretch", "angle"], 1);
    this.#solveChanged();
  }

  go(entries: Readonly<Record<string, string>>): void {
    const values = this.#values;
    if (!values) return;
    this.#isHandled = false;
    this.#isLed = true;
    for (const name of ["even", "own", "factor", "stretch", "angle"])
      if (entries[name] !== undefined) values.ask(name, Number(entries[name]));
    this.#isLed = false;
    const { hole, spot, curtain } = entries;
    const from = { hole: this.#hole, spot: this.#spot, curtain: this.#curtain };
    const target = holes[hole ?? ""] ?? from.hole;
    const places: Readonly<Record<string, PlanePoint>> = {
      corner: spotCorner,
      top: [target.at[0], target.at[1] + target.b],
      flank: [target.at[0] + target.a, target.at[1]],
    };
    const to = {
      hole: target,
      spot: places[spot ?? ""] ?? from.spot,
      curtain: curtains[curtain ?? ""] ?? from.curtain,
    };
    const at = (a: number, b: number, t: number): number => a + (b - a) * t;
    this.#motion.run(600, (t) => {
      this.#hole = {
        at: [at(from.hole.at[0], to.hole.at[0], t), at(from.hole.at[1], to.hole.at[1], t)],
        a: at(from.hole.a, to.hole.a, t),
        b: at(from.hole.b, to.hole.b, t),
      };
      this.#spot = [at(from.spot[0], to.spot[0], t), at(from.spot[1], to.spot[1], t)];
      this.#curtain = at(from.curtain, to.curtain, t);
      this.#mark(hole === undefined ? [] : [0, 1], spot === undefined ? [] : [1]);
    });
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#show();
  }

  /** Solves again in the next frame whenever one of these inputs changes. */
  #follow(names: readonly string[], panel: number): void {
    let isFirst = true;
    effect(() => {
      for (const name of names) this.#values?.number(name);
      untracked(() => {
        if (!isFirst && !this.#isLed) this.#isHandled = true;
        isFirst = false;
        this.#mark([panel]);
      });
    });
  }

  /** Notes which panels must be solved again; several changes within a frame count once. */
  #mark(...panels: readonly (readonly number[])[]): void {
    for (const panel of panels.flat()) if (panel < this.#panels.length) this.#changed.add(panel);
    this.#frame ||= requestAnimationFrame(() => this.#solveChanged());
  }

  #solveChanged(): void {
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    for (const panel of this.#changed) this.#solve(panel);
    this.#changed.clear();
    this.#report();
    this.#show();
  }

  #planOf(panel: number): MeshPlan {
    const values = this.#values;
    const number = (name: string): number => values?.number(name) ?? 0;
    const hole = this.#hole;
    if (panel === 0) return { hole, count: number("even") };
    const count = number("own");
    if (this.kind === "spot") return { hole, count, spot: { at: this.#spot, factor: number("factor") } };
    return { hole, count, needles: { stretch: number("stretch"), angle: number("angle") } };
  }

  #solve(panel: number): void {
    if (!this.#engine) return;
    const hole = this.#hole;
    this.#solved[panel] = solvePlate(meshPlate(this.#engine, this.#planOf(panel)), hole);
  }

  #handlesOf(panel: PlatePanel, index: number): readonly HandleOptions[] {
    const begin = (): void => this.#motion.stop();
    const hole = panel.holeHandles(
      () => this.#hole,
      (changed) => {
        this.#isHandled = true;
        this.#hole = withinPlate(changed);
        this.#mark([0, 1]);
      },
      begin,
    );
    if (index === 0) return this.kind === "truth" ? [...hole, this.#curtainHandle(panel)] : hole;
    return [...hole, this.kind === "spot" ? this.#spotHandle(panel) : this.#needleHandle(panel)];
  }

  #curtainHandle(panel: PlatePanel): HandleOptions {
    return {
      name: "curtain",
      label: "Line between the mesh and the truth",
      look: "active solid",
      at: () => panel.view.pixel([this.#curtain, -plate[1]]),
      begin: () => this.#motion.stop(),
      move: (pixel) => {
        this.#isHandled = true;
        this.#curtain = Math.min(plate[0], Math.max(-plate[0], panel.view.point(pixel)[0]));
        this.#report();
        this.#show();
      },
      describe: () => `${Math.round(50 * (1 + this.#curtain / plate[0]))} per cent mesh`,
    };
  }

  #spotHandle(panel: PlatePanel): HandleOptions {
    return {
      name: "spot",
      label: "Place of the small triangles",
      look: "active ring",
      at: () => panel.view.pixel(this.#spot),
      begin: () => this.#motion.stop(),
      move: (pixel) => {
        const [x, y] = panel.view.point(pixel);
        this.#isHandled = true;
        this.#spot = [Math.min(plate[0], Math.max(-plate[0], x)), Math.min(plate[1], Math.max(-plate[1], y))];
        this.#mark([1]);
      },
      describe: () => `${this.#spot[0].toFixed(2)}, ${this.#spot[1].toFixed(2)}`,
    };
  }

  #needleHandle(panel: PlatePanel): HandleOptions {
    return {
      name: "needle",
      label: "Length and direction of the needles",
      look: "active solid",
      at: () => panel.view.pixel(this.#needleEnd),
      begin: () => this.#motion.stop(),
      move: (pixel) => {
        const values = this.#values;
        const most = values?.range("stretch")?.max ?? 2;
        const [x, y] = panel.view.point(pixel);
        const [dx, dy] = [x - needleOrigin[0], y - needleOrigin[1]];
        const share = (Math.hypot(dx, dy) - needleReach[0]) / (needleReach[1] - needleReach[0]);
        values?.ask("stretch", 1 + share * (most - 1));
        values?.ask("angle", ((Math.atan2(dy, dx) * 180) / Math.PI + 540) % 180);
      },
      describe: () =>
        `stretch ${this.#values?.number("stretch") ?? 1}, ${this.#values?.number("angle") ?? 0} degrees`,
    };
  }

  get #needleEnd(): PlanePoint {
    const stretch = this.#values?.number("stretch") ?? 1;
    const most = this.#values?.range("stretch")?.max ?? 2;
    const angle = ((this.#values?.number("angle") ?? 0) * Math.PI) / 180;
    const reach = needleReach[0] + ((stretch - 1) / (most - 1)) * (needleReach[1] - needleReach[0]);
    return [needleOrigin[0] + reach * Math.cos(angle), needleOrigin[1] + reach * Math.sin(angle)];
  }

  #drawOwn({ view, pen }: PlatePanel): void {
    const c = colours();
    if (this.kind === "spot") {
      const isLit = this.#lit === "spot";
      pen.circle(view.pixel(this.#spot), (spotRadius + 0.03) * view.scale + 4, null, {
        stroke: c.active,
        width: isLit ? 5 : 2.5,
      });
      return;
    }
    pen.line(view.pixel(needleOrigin), view.pixel(this.#needleEnd), c.active, 3);
    pen.circle(view.pixel(needleOrigin), 4, c.active);
  }

  #report(): void {
    const [even, own] = this.#solved;
    if (!even || !this.#values) return;
    this.#values.put({
      truth: highestStress(this.#hole),
      evencount: even.mesh.triangles.length / 3,
      evenanswer: even.answer,
      evenerror: even.error,
      unknowns: even.mesh.points.length,
      ...(own
        ? {
            owncount: own.mesh.triangles.length / 3,
            ownanswer: own.answer,
            ownerror: own.error,
            better: own.error < even.error ? "better" : own.error > even.error ? "worse" : "as good",
          }
        : {}),
      x: this.#hole.at[0],
      y: this.#hole.at[1],
      wide: 2 * this.#hole.a,
      high: 2 * this.#hole.b,
      ...(this.kind === "truth" ? { curtain: this.#curtain } : {}),
      handled: this.#isHandled,
    });
  }

  #show(): void {
    const [even, own] = this.#solved;
    this.#panels.forEach((panel, index) => {
      const solved = this.#solved[index];
      if (!solved) return;
      const other = index === 0 ? own : even;
      panel.show(
        {
          hole: this.#hole,
          solved,
          curtain: this.kind === "truth" ? this.#curtain : null,
          lit: this.#lit,
        },
        other ? solved.error < other.error - 0.05 : false,
      );
    });
  }
}
