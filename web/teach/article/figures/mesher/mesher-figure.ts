/** "Be the mesher": a front in the plane or in space that the reader advances until it closes or stalls, beside the program's mesh. */
import type { Position } from "../../../../document/position";
import { mean } from "../../../../document/vectors";
import { button, digits, element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { Pen } from "../../kit/pen";
import { PlaneView } from "../../kit/plane-view";
import { Camera } from "../../kit/space";
import { Stage, type HandleOptions, type Pixel } from "../../kit/stage";
import type { Values } from "../../kit/values";
import { nodeHandle } from "../pocket/node-handle";
import { Board, measuresOf, type Fault, type MeshMeasures, type Refused } from "./board";
import { levelNames, loadLevel, type Level, type LevelName } from "./levels";
import { MesherDrawing, type Preview, type Sight } from "./mesher-drawing";

const levelLabels: Readonly<Record<LevelName, string>> = {
  five: "Five corners",
  boot: "A boot",
  fine: "A fine corner",
  stretched: "A stretched patch",
  cube: "A cube",
  prism: "A turned prism",
};
/** Nodes of the front to choose from; a letter names each. */
const mostNodes = 8;
const letters = "ABCDEFGH";
/** How near the pointer must be to a node, in pixels. */
const reach = 26;
const smallStage = 500;

const faultTexts: Readonly<Record<Fault, (dimension: 2 | 3) => string>> = {
  behind: (dimension) =>
    dimension === 2
      ? "Refused: the point is behind the side, or nearly in line with it."
      : "Refused: the point is behind the face, or nearly in its plane.",
  crosses: (dimension) =>
    dimension === 2
      ? "Refused: the triangle would cross the red sides."
      : "Refused: the tetrahedron would cross the red faces.",
  encloses: () => "Refused: a node of the front would lie inside, or on the border.",
};

type Choice = number | "new";

export class MesherFigure implements Figure {
  readonly #stage = new Stage(() => this.#draw());
  readonly #pen = new Pen(this.#stage.context);
  readonly #camera = new Camera(this.#stage, { target: [0, 0, 0], distance: 5, yaw: 0.5, pitch: 0.35 });
  readonly #levels = levelNames.map((name) =>
    button({ "data-level": name }, levelLabels[name], () => void this.#open(name, true)),
  );
  readonly #question = element("p", { class: "status", role: "status" });
  readonly #choices = element("div", {
    class: "choices picks",
    role: "group",
    "aria-label": "The next node",
  });
  readonly #result = element("div", { class: "result" });
  #values: Values | null = null;
  #name: LevelName = "five";
  #level: Level | null = null;
  #board: Board | null = null;
  /** Where a new node would be made. */
  #newNode: Position = [0, 0, 0];
  #nodes: readonly number[] = [];
  #hovered: Choice | null = null;
  #lastRefused: Refused | null = null;
  #lit: string | null = null;
  #isHandled = false;
  #opened = 0;

  async mount(host: HTMLElement, values: Values): Promise<void> {
    this.#values = values;
    const levels = element(
      "div",
      { class: "choices levels", role: "group", "aria-label": "Shape" },
      ...this.#levels,
    );
    host.append(levels, this.#stage.element, this.#question, this.#choices, this.#result);
    this.#followPointer();
    await this.#open(values.word("level") as LevelName, false);
  }

  go({ level }: Readonly<Record<string, string>>): void {
    const name = levelNames.find((known) => known === level);
    if (name) void this.#open(name, false);
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#stage.requestDraw();
  }

  async #open(name: LevelName, isHandled: boolean): Promise<void> {
    const opening = ++this.#opened;
    const level = await loadLevel(name);
    if (opening !== this.#opened) return;
    this.#name = name;
    this.#level = level;
    this.#camera.target = mean(level.nodes);
    this.#levels.forEach((each, i) => each.setAttribute("aria-pressed", String(levelNames[i] === name)));
    this.#stage.element.classList.toggle("turns", level.dimension === 3);
    this.#begin(isHandled);
  }

  #begin(isHandled: boolean): void {
    if (!this.#level) return;
    this.#isHandled = isHandled;
    this.#board = new Board(this.#level);
    this.#lastRefused = null;
    this.#ask();
  }

  get #isOver(): boolean {
    return this.#board?.active === null;
  }

  /** Asks for the node of the next element, or shows what has become of the front. */
  #ask(): void {
    const board = this.#board;
    const active = board?.active;
    this.#hovered = null;
    if (board && active) {
      this.#newNode = board.idealOf(active);
      this.#nodes = board.nodesFor(active, mostNodes).toSorted((a, b) => a - b);
    } else this.#nodes = [];
    this.#stage.setHandles(board && active ? [this.#newHandle()] : []);
    this.#showChoices();
    this.#showResult();
    this.#report();
  }

  #newHandle(): HandleOptions {
    const moveTo = (position: Position): void => {
      this.#newNode = position;
      this.#hovered = "new";
      this.#report();
    };
    const begin = (): void => void (this.#hovered = "new");
    if (this.#level?.dimension === 3) {
      const bounds = [-4, 4].map((x): Position => [x, x, x]) as [Position, Position];
      return {
        ...nodeHandle(this.#camera, bounds, { at: () => this.#newNode, moveTo, begin, describe: () => "" }),
        name: "new",
        label: "The new node: arrow keys move it across the view",
      };
    }
    return {
      name: "new",
      label: "The new node",
      look: "new solid",
      at: () => this.#pixel(this.#newNode),
      begin,
      move: (pixel) => moveTo(this.#pointAt(pixel)),
    };
  }

  #showChoices(): void {
    const isFocused = this.#choices.contains(document.activeElement);
    const named = this.#nodes.map((node, i) => this.#choiceButton(node, `Node ${letters[i] ?? ""}`));
    const all = this.#isOver
      ? []
      : [
          ...named,
          this.#choiceButton("new", "New node"),
          button({ "data-choice": "wait", class: "quiet" }, "Leave it for later", () => {
            this.#isHandled = true;
            this.#lastRefused = null;
            this.#board?.wait();
            this.#ask();
          }),
        ];
    this.#choices.replaceChildren(...all);
    this.#choices.hidden = this.#isOver;
    // Enter is enough to go on.
    if (isFocused) (this.#choices.querySelector("button") ?? this.#result.querySelector("button"))?.focus();
  }

  #choiceButton(choice: Choice, label: string): HTMLButtonElement {
    const made = button({ "data-choice": String(choice) }, label, () => this.#choose(choice));
    for (const type of ["pointerenter", "focus"]) made.addEventListener(type, () => this.#hover(choice));
    for (const type of ["pointerleave", "blur"]) made.addEventListener(type, () => this.#hover(null));
    return made;
  }

  /** List and drawing light the same choice. */
  #hover(choice: Choice | null): void {
    if (choice === this.#hovered) return;
    this.#hovered = choice;
    for (const each of this.#choices.querySelectorAll<HTMLElement>("[data-choice]"))
      each.toggleAttribute("data-lit", each.dataset["choice"] === String(choice));
    this.#stage.requestDraw();
  }

  #choose(choice: Choice): void {
    const board = this.#board;
    if (!board || this.#isOver) return;
    this.#isHandled = true;
    this.#lastRefused = board.choose(choice === "new" ? this.#newNode : choice);
    if (this.#lastRefused) this.#report();
    else this.#ask();
  }

  #followPointer(): void {
    const scene = this.#stage.element;
    const nodeAt = (event: PointerEvent | MouseEvent): Choice | null => {
      const { left, top } = this.#stage.canvas.getBoundingClientRect();
      const far = (node: number): number => {
        const [x, y] = this.#pixel(this.#board?.nodes[node] ?? [0, 0, 0]);
        return Math.hypot(event.clientX - left - x, event.clientY - top - y);
      };
      const [nearest] = this.#nodes.toSorted((a, b) => far(a) - far(b));
      return nearest !== undefined && far(nearest) < reach ? nearest : null;
    };
    scene.addEventListener("pointermove", (event) => {
      if (event.buttons === 0) this.#hover(nodeAt(event));
      scene.classList.toggle("picks", this.#hovered !== null);
    });
    scene.addEventListener("pointerleave", () => this.#hover(null));
    let pressed: Pixel = [0, 0];
    scene.addEventListener("pointerdown", (event) => (pressed = [event.clientX, event.clientY]));
    scene.addEventListener("click", (event) => {
      // A drag turns the view.
      if (Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 6) return;
      const choice = nodeAt(event);
      if (choice !== null) this.#choose(choice);
    });
  }

  get #program(): MeshMeasures {
    const { program, nodes } = this.#level ?? { program: { nodes: [], elements: [] }, nodes: [] };
    return measuresOf(program.nodes, program.elements, nodes.length);
  }

  #report(): void {
    const [board, level] = [this.#board, this.#level];
    if (!board || !level) return;
    const own = measuresOf(board.nodes, board.elements, board.givenNodes);
    const program = this.#program;
    this.#values?.put({
      level: this.#name,
      front: board.front.length,
      elements: own.elements,
      newnodes: own.newNodes,
      angle: own.angle,
      refused: board.refused.length,
      closed: board.isClosed,
      stalled: board.isStalled,
      space: level.dimension === 3,
      program: program.elements,
      programnewnodes: program.newNodes,
      programangle: program.angle,
      programrefused: level.programRefused,
      handled: this.#isHandled,
    });
    this.#question.replaceChildren(...this.#questionParts(board, level));
    this.#stage.requestDraw();
  }

  #questionParts(board: Board, { dimension }: Level): readonly (Node | string)[] {
    const strong = (text: string, look = ""): HTMLElement => element("b", { class: look }, text);
    const [facet, facets, what] =
      dimension === 2 ? ["side", "sides", "triangle"] : ["face", "faces", "tetrahedron"];
    if (board.isClosed) return [strong("The front is closed."), " Below, your mesh beside the program’s."];
    const left = board.front.length;
    if (board.isStalled)
      return [
        strong("The front has stalled.", "refused"),
        ` Nothing fits on the ${left} ${facets} that are left.`,
      ];
    if (this.#lastRefused)
      return [strong(faultTexts[this.#lastRefused.fault](dimension), "refused"), " Choose again."];
    return [
      `The ${facet} in blue comes next: which node makes its ${what}? `,
      strong(String(left)),
      ` ${facets} are left.`,
    ];
  }

  #showResult(): void {
    const [board, level] = [this.#board, this.#level];
    this.#result.hidden = !this.#isOver;
    if (!board || !level || !this.#isOver) return this.#result.replaceChildren();
    const own = measuresOf(board.nodes, board.elements, board.givenNodes);
    const program = this.#program;
    const angle = level.dimension === 2 ? "Smallest angle" : "Smallest angle between faces";
    const degrees = ({ angle: value, worst }: MeshMeasures): string =>
      worst === null ? "none" : `${digits(value, 0)}°`;
    const rows = [
      ["elements", level.dimension === 2 ? "Triangles" : "Tetrahedra", own.elements, program.elements],
      ["front", level.dimension === 2 ? "Sides left empty" : "Faces left empty", board.front.length, 0],
      ["nodes", "New nodes", own.newNodes, program.newNodes],
      ["worst", angle, degrees(own), degrees(program)],
      ["refused", "Refused choices", board.refused.length, level.programRefused],
    ] as const;
    const table = element(
      "table",
      { "aria-label": "Your mesh beside the program’s" },
      element(
        "tr",
        {},
        element("td"),
        element("th", { scope: "col" }, "you"),
        element("th", { scope: "col" }, "the program"),
      ),
      ...rows.map(([part, label, mine, theirs]) => {
        const row = element(
          "tr",
          { "data-row": part },
          element("th", { scope: "row" }, label),
          element("td", {}, String(mine)),
          element("td", {}, String(theirs)),
        );
        row.addEventListener("pointerenter", () => this.mark(part));
        row.addEventListener("pointerleave", () => this.mark(null));
        return row;
      }),
    );
    const next = levelNames[levelNames.indexOf(this.#name) + 1];
    const buttons = element(
      "div",
      { class: "choices" },
      button({ "data-result": "again" }, "Again", () => this.#begin(true)),
      ...(next
        ? [
            button(
              { "data-result": "next" },
              `Next: ${levelLabels[next].toLowerCase()}`,
              () => void this.#open(next, true),
            ),
          ]
        : []),
    );
    this.#result.replaceChildren(
      table,
      element("p", { class: "verdict" }, verdictOf(board, own, program, level)),
      buttons,
    );
  }

  /** The window of the shape, as its least and largest x and y. */
  get #view(): PlaneView {
    const level = this.#level;
    const bound = (axis: 0 | 1, pick: (...values: number[]) => number): number =>
      pick(
        ...(level?.nodes ?? [[0, 0, 0] as const]).map(
          (node) => node[axis] * (axis === 0 ? (level?.stretching ?? 1) : 1),
        ),
      );
    const margin = 0.16;
    return new PlaneView(this.#stage, [
      bound(0, Math.min) - margin,
      bound(1, Math.min) - margin,
      bound(0, Math.max) + margin,
      bound(1, Math.max) + margin,
    ]);
  }

  #pixel(position: Position): Pixel {
    if (this.#level?.dimension === 3) return this.#camera.pixel(position);
    return this.#view.pixel([position[0] * (this.#level?.stretching ?? 1), position[1]]);
  }

  #pointAt(pixel: Pixel): Position {
    const view = this.#view;
    const [x, y] = view.inside(view.point(pixel), 0);
    return [x / (this.#level?.stretching ?? 1), y, 0];
  }

  /** How the shape is seen; in one half of the stage if two are compared. */
  #sight(half: 0 | 1 | null): Sight {
    const isSpace = this.#level?.dimension === 3;
    const view = this.#view;
    const { width, height } = this.#stage;
    const isBeside = width >= smallStage || isSpace;
    const stretching = this.#level?.stretching ?? 1;
    const whole = (position: Position): Pixel =>
      isSpace ? this.#camera.pixel(position) : view.pixel([position[0] * stretching, position[1]]);
    const [x0, y0, x1, y1] = view.window;
    const [across, along] = isBeside ? [width / 2, height - 40] : [width, height / 2 - 24];
    const factor = isSpace ? 0.95 : Math.min(across / (x1 - x0), along / (y1 - y0)) / view.scale;
    const centre: Pixel = isBeside
      ? [width * (half === 0 ? 0.25 : 0.75), height / 2]
      : [width / 2, height * (half === 0 ? 0.27 : 0.77)];
    return {
      pixel: (position) => {
        const [x, y] = whole(position);
        if (half === null) return [x, y];
        return [centre[0] + (x - width / 2) * factor, centre[1] + (y - height / 2) * factor];
      },
      depth: (position) => (isSpace ? this.#camera.depth(position) : 0),
      eye: isSpace ? this.#camera.eye : null,
    };
  }

  #draw(): void {
    const [board, level] = [this.#board, this.#level];
    if (!board || !level) return;
    const boldness = this.#stage.width < smallStage ? 0.8 : 1;
    if (this.#isOver) return this.#drawBoth(board, level, 0.85 * boldness);
    const drawing = new MesherDrawing(this.#pen, this.#sight(null), boldness);
    drawing.drawBoard(board, board.active, this.#preview(board), this.#lit);
    if (this.#lit === "refused") drawing.drawRefused(board.refused, true);
    this.#nodes.forEach((node, i) => {
      const at = this.#pixel(board.nodes[node] ?? [0, 0, 0]);
      this.#stage.label(letters[i] ?? "", at, {
        dy: -16,
        look: node === this.#hovered ? "active plate" : "plate",
      });
    });
  }

  #drawBoth(board: Board, { program }: Level, boldness: number): void {
    const left = board.front.map((facet) => board.positions(facet));
    const [own, theirs] = ([0, 1] as const).map((half) => this.#sight(half));
    if (!own || !theirs) return;
    const mine = new MesherDrawing(this.#pen, own, boldness);
    mine.drawMesh(board, left, this.#lit);
    mine.drawRefused(board.refused, this.#lit === "refused");
    new MesherDrawing(this.#pen, theirs, boldness).drawMesh(program, [], this.#lit);
    const { width, height } = this.#stage;
    const isBeside = width >= smallStage || own.eye !== null;
    const places: readonly Pixel[] = isBeside
      ? [
          [width * 0.25, 14],
          [width * 0.75, 14],
        ]
      : [
          [width / 2, 12],
          [width / 2, height / 2 + 8],
        ];
    ["Your mesh", "The program’s mesh"].forEach((name, i) =>
      this.#stage.label(name, places[i] ?? [0, 0], { look: "strong" }),
    );
  }

  /** The element that the hovered choice would make, or the one that was refused. */
  #preview(board: Board): Preview | null {
    if (this.#hovered !== null) {
      const at = this.#hovered === "new" ? this.#newNode : board.nodes[this.#hovered];
      return at ? { at, refused: null } : null;
    }
    return this.#lastRefused && { at: this.#lastRefused.at, refused: this.#lastRefused };
  }
}

/** Says what went wrong, and where it is seen. */
function verdictOf(board: Board, own: MeshMeasures, program: MeshMeasures, { dimension }: Level): string {
  const element = dimension === 2 ? "triangle" : "tetrahedron";
  if (!board.isClosed)
    return `The red rest is a pocket: every node of it makes a ${element} that crosses the front or is flat, and so does every new one. An earlier choice has shaped it.`;
  if (own.angle >= program.angle - 0.5)
    return `No ${element} of yours is thinner than the program’s thinnest, which is blue.`;
  return `Your thinnest ${element} is blue. It closes what earlier choices have left; the program’s has ${digits(program.angle, 0)}°.`;
}
