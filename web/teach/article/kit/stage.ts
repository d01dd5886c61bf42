/**
 * The ground of a figure: a canvas in CSS pixels, and over it handles and labels as elements, so that keys, screen readers and
 * style sheets reach them.
 */
import { onTheme } from "./colours";
import { element, rich } from "./dom";

export type Pixel = readonly [number, number];

export interface HandleOptions {
  /** Name for tests and styles, unique within the stage. */
  readonly name: string;
  readonly label: string;
  /** Style of the handle: `active`, `new`, `plain` or `ghost`. */
  readonly look?: string;
  at(): Pixel;
  /** Moves the point to a pixel. */
  move(to: Pixel): void;
  /** The reader begins or ends a movement. */
  begin?(): void;
  end?(): void;
  /** Removes the point; asked for by the keys Delete and Backspace. */
  remove?(): void;
  /** What a screen reader says after a movement. */
  describe?(): string;
}

/** Pixels of a canvas per pixel of the page: two at least, because the drawing is also printed. */
export const canvasRatio = (): number => Math.max(2, Math.min(3, devicePixelRatio));

export class Handle {
  readonly node: HTMLButtonElement;
  isHeld = false;

  constructor(
    readonly options: HandleOptions,
    stage: Stage,
  ) {
    const { name, label, look = "plain" } = options;
    this.node = element("button", {
      type: "button",
      class: `handle ${look}`,
      "data-handle": name,
      "aria-label": label,
      "aria-roledescription": "movable point",
    });
    this.node.addEventListener("pointerdown", (event) => this.#hold(event, stage));
    this.node.addEventListener("keydown", (event) => this.#keys(event, stage));
    for (const type of ["pointerenter", "pointerleave", "focus", "blur"])
      this.node.addEventListener(type, () => stage.requestDraw());
  }

  get isHot(): boolean {
    return this.isHeld || this.node.matches(":hover, :focus-visible");
  }

  place(): void {
    const [x, y] = this.options.at();
    this.node.style.transform = `translate(${x.toFixed(2)}px, ${y.toFixed(2)}px)`;
    const text = this.options.describe?.();
    if (text !== undefined) this.node.setAttribute("aria-label", `${this.options.label}, ${text}`);
  }

  #hold(event: PointerEvent, stage: Stage): void {
    if (event.button !== 0) return;
    event.preventDefault();
    this.node.focus({ preventScroll: true });
    this.node.setPointerCapture(event.pointerId);
    // The point stays under the finger where it was taken.
    const [x, y] = this.options.at();
    const offset = [x - event.clientX, y - event.clientY] as const;
    this.isHeld = true;
    this.node.classList.add("held");
    this.options.begin?.();
    const move = ({ clientX, clientY }: PointerEvent): void => {
      const { left, top } = stage.canvas.getBoundingClientRect();
      const moved = [left - start.left, top - start.top] as const;
      this.options.move([clientX + offset[0] - moved[0], clientY + offset[1] - moved[1]]);
    };
    const start = stage.canvas.getBoundingClientRect();
    const end = (): void => {
      this.isHeld = false;
      this.node.classList.remove("held");
      this.node.removeEventListener("pointermove", move);
      this.options.end?.();
      stage.requestDraw();
    };
    this.node.addEventListener("pointermove", move);
    for (const type of ["pointerup", "pointercancel"]) this.node.addEventListener(type, end, { once: true });
  }

  #keys(event: KeyboardEvent, stage: Stage): void {
    if (this.options.remove && (event.key === "Delete" || event.key === "Backspace")) {
      event.preventDefault();
      this.options.remove();
      return;
    }
    const direction = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[
      event.key
    ];
    if (!direction) return;
    event.preventDefault();
    const by = event.shiftKey ? 24 : 6;
    const [x, y] = this.options.at();
    this.options.begin?.();
    this.options.move([x + (direction[0] ?? 0) * by, y + (direction[1] ?? 0) * by]);
    this.options.end?.();
    stage.requestDraw();
  }
}

export interface LabelOptions {
  readonly dx?: number;
  readonly dy?: number;
  /** Style: a colour role, or `strong`. */
  readonly look?: string;
}

interface Label {
  readonly node: HTMLSpanElement;
  text: string;
  look: string;
  /** Width in pixels; 0 until it is measured. */
  width: number;
  at: Pixel;
}

export class Stage {
  readonly element = element("div", { class: "scene" });
  readonly canvas = element("canvas", { "aria-hidden": "true" });
  readonly context: CanvasRenderingContext2D;
  width = 0;
  height = 0;
  readonly #layer = element("div", { class: "layer" });
  readonly #handles = new Map<string, Handle>();
  readonly #labels: Label[] = [];
  #usedLabels = 0;
  #frame = 0;
  #isNear = true;

  /** @param draw Draws everything; called once per frame when something has changed. */
  constructor(readonly draw: () => void) {
    const context = this.canvas.getContext("2d");
    if (!context) throw new Error("The browser has no canvas.");
    this.context = context;
    this.element.append(this.canvas, this.#layer);
    new ResizeObserver(() => this.#resize()).observe(this.element);
    new IntersectionObserver(
      (entries) => {
        this.#isNear = entries.at(-1)?.isIntersecting ?? true;
        if (this.#isNear) this.requestDraw();
      },
      { rootMargin: "200px" },
    ).observe(this.element);
    onTheme(() => this.requestDraw());
    document.fonts.addEventListener("loadingdone", () => {
      for (const label of this.#labels) label.width = 0;
      this.requestDraw();
    });
    window.addEventListener("beforeprint", () => this.#drawNow());
  }

  /** Draws in the next frame. Far from the window, only the handles are placed, so that they are right when they come into view. */
  requestDraw(): void {
    if (this.#frame !== 0) return;
    this.#frame = requestAnimationFrame(() => {
      if (this.#isNear) return this.#drawNow();
      this.#frame = 0;
      if (this.width > 0) this.#placeHandles();
    });
  }

  #placeHandles(): void {
    for (const handle of this.#handles.values()) handle.place();
  }

  /** Replaces all handles by these; those with a known name keep their element, and with it the focus. */
  setHandles(all: readonly HandleOptions[]): void {
    const names = new Set(all.map(({ name }) => name));
    for (const [name, handle] of this.#handles)
      if (!names.has(name)) {
        handle.node.remove();
        this.#handles.delete(name);
      }
    for (const options of all)
      if (!this.#handles.has(options.name)) {
        const handle = new Handle(options, this);
        this.#handles.set(options.name, handle);
        this.#layer.append(handle.node);
      }
    this.requestDraw();
  }

  handle(name: string): Handle | undefined {
    return this.#handles.get(name);
  }

  /** Puts a label at a pixel, inside the stage; only while drawing. `text` is as for `rich`. */
  label(text: string, [x, y]: Pixel, { dx = 0, dy = 0, look = "" }: LabelOptions = {}): void {
    let label = this.#labels[this.#usedLabels];
    if (!label) {
      label = { node: element("span", { class: "label" }), text: "", look: "", width: 0, at: [0, 0] };
      this.#labels.push(label);
      this.#layer.prepend(label.node);
    }
    this.#usedLabels++;
    label.node.hidden = false;
    label.at = [x + dx, y + dy];
    if (label.text === text && label.look === look) return;
    if (label.text !== text) label.node.replaceChildren(rich(text));
    if (label.look !== look) label.node.className = `label ${look}`;
    Object.assign(label, { text, look, width: 0 });
  }

  /** Measures the labels that are new, all of them at once, and moves every label to its place. */
  #placeLabels(): void {
    const used = this.#labels.slice(0, this.#usedLabels);
    for (const { node } of this.#labels.slice(this.#usedLabels)) node.hidden = true;
    for (const label of used) if (label.width === 0) label.width = label.node.offsetWidth;
    for (const { node, width, at } of used) {
      const half = width / 2 + 4;
      const left = Math.min(this.width - half, Math.max(half, at[0]));
      const top = Math.min(this.height - 12, Math.max(12, at[1]));
      node.style.transform = `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px) translate(-50%, -50%)`;
    }
  }

  #drawNow(): void {
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    if (this.width === 0) return;
    this.context.clearRect(0, 0, this.width, this.height);
    this.#usedLabels = 0;
    this.draw();
    this.#placeLabels();
    this.#placeHandles();
  }

  #resize(): void {
    const { clientWidth, clientHeight } = this.element;
    if (clientWidth === 0 || clientHeight === 0) return;
    const ratio = canvasRatio();
    this.width = clientWidth;
    this.height = clientHeight;
    this.canvas.width = Math.round(clientWidth * ratio);
    this.canvas.height = Math.round(clientHeight * ratio);
    // A new size resets the context.
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.context.lineCap = "round";
    this.context.lineJoin = "round";
    this.#drawNow();
  }
}
