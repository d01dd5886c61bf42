/** "Be the mesher": a front in the plane or in space that the reader advances until it closes or stalls, beside the program's mesh. */
import type { Position } from "../../../../document/position";
import { addScaled, distance, dot, mean, subtract, unit } from "../../../../document/vectors";
import { button, digits, element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { Motion } from "../../kit/motion";
import { Pen } from "../../kit/pen";
import { PlaneView } from "../../kit/plane-view";
import { Camera } from "../../kit/space";
import { Stage, type HandleOptions, type Pixel } from "../../kit/stage";
import type { Values } from "../../kit/values";
import { nodeHandle } from "../pocket/node-handle";
import { Board, cornersOf, measuresOf, type Fault, type MeshMeasures, type Refused } from "./board";
import { levelNames, loadLevel, type Level, type LevelName } from "./levels";
import { MesherDrawing, type Preview, type Sight } from "./mesher-drawing";
import { MesherPanel, type Choice, type Offer } from "./mesher-panel";
import { carefulChoice, outlookOf } from "./outlook";
import { heightOver, normalOf, smallestAngleOf } from "./simplices";

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
const reach = 30;
/** A press that moves less than this, in pixels, is no drag. */
const stillness = 5;
const smallStage = 500;
/** Distance of the camera from a shape in space, as a multiple of the shape's radius. */
const cameraReach = 4.3;
/** A face is seen edge-on if the cosine between its normal and the view is less. */
const leastOpenness = 0.42;
/** Turns of the view that are tried, in radians, the least first. */
const turns = Array.from({ length: 21 }, (_none, i) => (i % 2 === 0 ? 1 : -1) * 0.15 * Math.ceil(i / 2));
/** A corner sharper than this, in degrees, is a warning. */
const sharp = 25;

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

export class MesherFigure implements Figure {
  readonly #stage = new Stage(() => this.#draw());
  readonly #pen = new Pen(this.#stage.context);
  readonly #camera = new Camera(this.#stage, { target: [0, 0, 0], distance: 5, yaw: 0.5, pitch: 0.35 });
  readonly #levels = levelNames.map((name) =>
    button({ "data-level": name }, levelLabels[name], () => void this.#open(name, true)),
  );
  readonly #panel = new MesherPanel({
    choose: (choice) => this.#choose(choice),
    hover: (choice) => this.#hover(choice),
    wait: () => this.#change((board) => board.wait()),
    undo: () => this.#change((board) => board.undo()),
    hint: () => this.#hint(),
    again: () => this.#begin(true),
    next: () => {
      const next = this.#nextLevel;
      if (next) void this.#open(next, true);
    },
    light: (part) => this.mark(part),
  });
  #values: Values | null = null;
  #name: LevelName = "five";
  #level: Level | null = null;
  #board: Board | null = null;
  /** Where a new node would be made. */
  #newNode: Position = [0, 0, 0];
  #nodes: readonly number[] = [];
  #hovered: Choice | null = null;
  #lastRefused: Refused | null = null;
  /** Choices that were refused over the active facet. */
  #refusedHere = new Set<Choice>();
  readonly #motion = new Motion();
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
    const body = element("div", { class: "mesher-body" }, this.#stage.element, this.#panel.element);
    host.append(levels, body);
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
    this.#camera.distance =
      cameraReach * Math.max(...level.nodes.map((node) => distance(node, mean(level.nodes))));
    this.#levels.forEach((each, i) => each.setAttribute("aria-pressed", String(levelNames[i] === name)));
    this.#stage.element.classList.toggle("turns", level.dimension === 3);
    this.#begin(isHandled);
  }

  #begin(isHandled: boolean): void {
    if (!this.#level) return;
    this.#isHandled = isHandled;
    this.#board = new Board(this.#level);
    this.#ask();
  }

  get #isOver(): boolean {
    return this.#board?.active === null;
  }

  get #nextLevel(): LevelName | undefined {
    return levelNames[levelNames.indexOf(this.#name) + 1];
  }

  /** Asks for the node of the next element, or shows what has become of the front. */
  #ask(): void {
    const board = this.#board;
    const active = board?.active;
    this.#hovered = null;
    this.#lastRefused = null;
    this.#refusedHere = new Set();
    if (board && active) {
      this.#newNode = board.proposalFor(active);
      this.#nodes = board.nodesFor(active, mostNodes).toSorted((a, b) => a - b);
      this.#turnTo(board.positions(active));
    } else this.#nodes = [];
    this.#stage.setHandles(board && active ? [this.#newHandle()] : []);
    this.#report();
  }

  /** Turns the view, as little as is needed, until a face is not seen edge-on. */
  #turnTo(facet: readonly Position[]): void {
    if (facet.length < 3) return;
    const normal = unit(normalOf(facet)) ?? [0, 0, 1];
    const { yaw } = this.#camera;
    const openness = (turn: number): number => {
      this.#camera.yaw = yaw + turn;
      return Math.abs(dot(this.#camera.axes[2], normal));
    };
    const open = turns.find((turn) => openness(turn) >= leastOpenness);
    this.#camera.yaw = yaw;
    if (open === undefined || open === 0) return;
    this.#motion.run(400, (t) => {
      this.#camera.yaw = yaw + open * t;
      this.#stage.requestDraw();
    });
  }

  /** The golden point: a drag moves it, a press takes it. */
  #newHandle(): HandleOptions {
    const moveTo = (position: Position): void => {
      this.#newNode = position;
      this.#refusedHere.delete("new");
      this.#report();
    };
    let [pressed, hasMoved]: [Pixel, boolean] = [[0, 0], false];
    const press = {
      begin: (): void => {
        [pressed, hasMoved] = [this.#pixel(this.#newNode), false];
        this.#hover("new");
      },
      end: (): void => {
        if (!hasMoved) this.#choose("new");
      },
    };
    const follow = (move: (pixel: Pixel) => void) => (pixel: Pixel) => {
      hasMoved ||= Math.hypot(pixel[0] - pressed[0], pixel[1] - pressed[1]) > stillness;
      if (hasMoved) move(pixel);
    };
    const named = { name: "new", label: "The new node: drag it, or press to take it", look: "new solid" };
    if (this.#level?.dimension === 3) {
      const bounds = [-4, 4].map((x): Position => [x, x, x]) as [Position, Position];
      const handle = nodeHandle(this.#camera, bounds, {
        at: () => this.#newNode,
        moveTo,
        begin: press.begin,
        describe: () => "",
      });
      return { ...handle, ...named, ...press, move: follow((pixel) => handle.move(pixel)) };
    }
    return {
      ...named,
      ...press,
      at: () => this.#pixel(this.#newNode),
      move: follow((pixel) => moveTo(this.#pointAt(pixel))),
    };
  }

  #offers(board: Board): readonly Offer[] {
    const facet = board.active;
    if (!facet) return [];
    const corners = board.positions(facet);
    return [...this.#nodes, "new" as const].map((choice, i) => {
      const at = this.#positionOf(choice);
      const isBehind = heightOver(corners, at) <= 0;
      return {
        choice,
        name: letters[i] ?? "",
        angle: isBehind ? null : smallestAngleOf([...corners, at]),
        isRefused: this.#refusedHere.has(choice),
      };
    });
  }

  #positionOf(choice: Choice): Position {
    return choice === "new" ? this.#newNode : (this.#board?.nodes[choice] ?? this.#newNode);
  }

  /** List and drawing light the same choice. */
  #hover(choice: Choice | null): void {
    if (choice === this.#hovered) return;
    this.#hovered = choice;
    this.#panel.lightPick(choice);
    this.#stage.requestDraw();
  }

  #choose(choice: Choice): void {
    const board = this.#board;
    if (!board || this.#isOver) return;
    this.#isHandled = true;
    const refused = board.choose(choice === "new" ? this.#newNode : choice);
    if (!refused) return this.#ask();
    this.#lastRefused = refused;
    this.#refusedHere.add(choice);
    this.#report();
  }

  #change(act: (board: Board) => void): void {
    if (!this.#board) return;
    this.#isHandled = true;
    act(this.#board);
    this.#ask();
  }

  /** Lights what a careful player would choose; the choice is left to the reader. */
  #hint(): void {
    const active = this.#board?.active;
    if (!this.#board || !active) return;
    this.#lastRefused = null;
    const nodes = this.#board.nodesFor(active, mostNodes);
    this.#hover(carefulChoice(this.#board, nodes, this.#newNode));
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
      scene.classList.toggle("picks-node", this.#hovered !== null);
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
      stage: 1 + levelNames.indexOf(this.#name),
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
    if (board.isClosed)
      this.#levels[levelNames.indexOf(this.#name)]?.setAttribute("data-closed", digits(own.angle, 0));
    this.#panel.question.replaceChildren(...this.#questionParts(board, level));
    this.#panel.offer(this.#offers(board), board.canUndo);
    this.#panel.lightPick(this.#hovered);
    this.#panel.showScore(
      { ...own, refused: board.refused.length, front: board.front.length },
      { ...program, refused: level.programRefused, front: 0 },
      level.dimension,
    );
    const next = this.#nextLevel;
    this.#panel.showEnd(
      this.#isOver
        ? {
            verdict: verdictOf(board, own, program, level),
            next: next ? `Next: ${levelLabels[next].toLowerCase()}` : null,
          }
        : null,
    );
    this.#stage.requestDraw();
  }

  #questionParts(board: Board, { dimension }: Level): readonly (Node | string)[] {
    const strong = (text: string, look = ""): HTMLElement => element("b", { class: look }, text);
    const [facet, facets, what] =
      dimension === 2 ? ["side", "sides", "triangle"] : ["face", "faces", "tetrahedron"];
    if (board.isClosed) return [strong("Closed.")];
    if (board.isStalled)
      return [
        strong("Stalled.", "refused"),
        ` Nothing fits on the ${board.front.length} ${facets} that are left.`,
      ];
    if (this.#lastRefused)
      return [strong(faultTexts[this.#lastRefused.fault](dimension), "refused"), " Choose again."];
    return [strong(`The blue ${facet} is next.`, "active"), ` Which node completes its ${what}?`];
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

  /** Pixels from the middle of the stage that hold a shape in space however it is turned, with its elements pulled apart. */
  get #radius(): number {
    const { target, axes } = this.#camera;
    const pixels = this.#camera.pixel(addScaled(target, axes[0], 1))[0] - this.#stage.width / 2;
    const reaches = (this.#level?.nodes ?? []).map((node) => Math.hypot(...subtract(node, target)));
    return 1.15 * pixels * Math.max(...reaches, 1e-9);
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
    const isBeside = width >= smallStage;
    const stretching = this.#level?.stretching ?? 1;
    const whole = (position: Position): Pixel =>
      isSpace ? this.#camera.pixel(position) : view.pixel([position[0] * stretching, position[1]]);
    const [x0, y0, x1, y1] = view.window;
    const [across, along] = isBeside ? [width / 2, height - 40] : [width, height / 2 - 24];
    const factor = isSpace
      ? Math.min(0.95, Math.min(across, along) / 2 / this.#radius)
      : Math.min(across / (x1 - x0), along / (y1 - y0)) / view.scale;
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
    const preview = this.#preview();
    drawing.drawBoard(board, board.active, preview, this.#newNode, this.#lit);
    if (this.#lit === "refused") drawing.drawRefused(board.refused, true);
    if (preview && !preview.refused) this.#labelPreview(board, preview.at);
    this.#nodes.forEach((node, i) => {
      const look = node === this.#hovered ? " lit" : this.#refusedHere.has(node) ? " refused" : "";
      this.#stage.label(letters[i] ?? "", this.#pixel(this.#positionOf(node)), { look: `spot${look}` });
    });
  }

  /** Says the angle of the element that a choice would make, and where it leaves a sharp corner. */
  #labelPreview(board: Board, at: Position): void {
    const facet = board.active;
    if (!facet || this.#hovered === null) return;
    const corners = [...board.positions(facet), at];
    const angle = smallestAngleOf(corners);
    if (heightOver(board.positions(facet), at) <= 0 || angle < 0.5) return;
    this.#stage.label(`${digits(angle, 0)}°`, this.#pixel(mean(corners)), { look: "new strong" });
    const outlook = outlookOf(board, this.#hovered === "new" ? this.#newNode : this.#hovered);
    if (outlook?.left === null || outlook?.corner == null || outlook.left > sharp) return;
    const corner = outlook.corner < board.nodes.length ? board.positions([outlook.corner])[0] : this.#newNode;
    this.#stage.label(`leaves ${digits(outlook.left, 0)}°`, this.#pixel(corner ?? at), {
      dy: 28,
      look: "refused plate",
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
    const isBeside = width >= smallStage;
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
    for (const [{ nodes, elements }, sight] of [[board, own] as const, [program, theirs] as const]) {
      const { worst, angle } = measuresOf(nodes, elements, 0);
      if (worst === null || sight.eye !== null) continue;
      const middle = mean(cornersOf(nodes, elements[worst] ?? []));
      this.#stage.label(`${digits(angle, 0)}°`, sight.pixel(middle), { look: "active plate" });
    }
  }

  /** The element that the hovered choice would make, or the one that was refused. */
  #preview(): Preview | null {
    if (this.#hovered !== null && !this.#refusedHere.has(this.#hovered))
      return { at: this.#positionOf(this.#hovered), refused: null };
    return this.#lastRefused && { at: this.#lastRefused.at, refused: this.#lastRefused };
  }
}

/** Says what went wrong, and where it is seen. */
function verdictOf(board: Board, own: MeshMeasures, program: MeshMeasures, { dimension }: Level): string {
  const element = dimension === 2 ? "triangle" : "tetrahedron";
  if (!board.isClosed)
    return `The red rest is a pocket: whatever node it takes, the ${element} crosses the front or is flat. Undo, and look for the choice that made it.`;
  if (own.angle >= program.angle - 0.5)
    return `As good as the program, or better. The thinnest ${element} of each is blue.`;
  return `Your thinnest ${element} is blue. It had to take what earlier choices have left.`;
}
