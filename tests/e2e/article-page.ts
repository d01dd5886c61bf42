/** A page of a lesson, driven as readers do: by mouse, finger and keys. */
import { expect, type Locator, type Page } from "@playwright/test";

type Values = Readonly<Record<string, number | string>>;
export type Pixel = readonly [number, number];

/** What the page offers to tests. */
interface LessonWindow {
  readonly lesson?: { values(): Readonly<Record<string, Values>> };
}

export class ArticlePage {
  readonly errors: string[] = [];

  constructor(
    readonly page: Page,
    /** Whether drags are those of a finger. */
    readonly isTouched: boolean,
  ) {
    page.on("console", (message) => {
      if (message.type() === "error" || message.type() === "warning") this.errors.push(message.text());
    });
    page.on("pageerror", (error) => this.errors.push(error.message));
  }

  async open(lesson: number | string): Promise<void> {
    await this.page.goto(`./lessons/${lesson}/`);
    await this.page.evaluate(() => document.fonts.ready);
  }

  figure(letter: string): Locator {
    return this.page.getByTestId(`figure-${letter}`);
  }

  task(number: number): Locator {
    return this.page.getByTestId(`task-${number}`);
  }

  /** Scrolls a figure into view and waits until it is there. */
  async see(letter: string): Promise<void> {
    const figure = this.figure(letter);
    await figure.evaluate((node) => {
      const { top, height } = node.getBoundingClientRect();
      window.scrollBy(0, top - Math.max(8, (window.innerHeight - height) / 2));
    });
    await expect(figure).toHaveAttribute("data-ready", "true");
    await expect(figure).not.toHaveAttribute("data-docked");
  }

  async values(letter: string): Promise<Values> {
    const all = await this.page.evaluate(() => (window as unknown as LessonWindow).lesson?.values());
    return all?.[letter] ?? {};
  }

  async value(letter: string, name: string): Promise<number> {
    return Number((await this.values(letter))[name]);
  }

  handle(letter: string, name: string): Locator {
    return this.figure(letter).locator(`[data-handle="${name}"]`);
  }

  /** Returns the middle of an element in the window, once it rests there: pages scroll and figures move. */
  async middle(locator: Locator): Promise<Pixel> {
    let before: Pixel | null = null;
    for (let i = 0; i < 100; i++) {
      const box = await locator.boundingBox();
      if (!box) throw new Error("The element is not visible");
      const now: Pixel = [box.x + box.width / 2, box.y + box.height / 2];
      if (before && Math.hypot(now[0] - before[0], now[1] - before[1]) < 0.25) return now;
      before = now;
      await this.page.evaluate(
        () => new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next))),
      );
    }
    throw new Error("The element does not come to rest");
  }

  /** Drags from a pixel to another one; `held` runs before the end. */
  async drag(from: Pixel, to: Pixel, held: () => Promise<void> = () => Promise.resolve()): Promise<void> {
    const steps = 8;
    const at = (i: number): Pixel => [
      from[0] + ((to[0] - from[0]) * i) / steps,
      from[1] + ((to[1] - from[1]) * i) / steps,
    ];
    if (this.isTouched) return this.#dragByFinger(at, steps, held);
    await this.page.mouse.move(...from);
    await this.page.mouse.down();
    for (let i = 1; i <= steps; i++) await this.page.mouse.move(...at(i));
    await held();
    await this.page.mouse.up();
  }

  async #dragByFinger(at: (i: number) => Pixel, steps: number, held: () => Promise<void>): Promise<void> {
    const session = await this.page.context().newCDPSession(this.page);
    const send = (type: "touchStart" | "touchMove" | "touchEnd", points: readonly Pixel[]) =>
      session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y]) => ({ x, y })) });
    await send("touchStart", [at(0)]);
    for (let i = 1; i <= steps; i++) await send("touchMove", [at(i)]);
    await held();
    await send("touchEnd", []);
    await session.detach();
  }

  async dragHandle(letter: string, name: string, to: Pixel): Promise<void> {
    await this.drag(await this.middle(this.handle(letter, name)), to);
  }

  async done(number: number): Promise<void> {
    await expect(this.task(number)).toHaveAttribute("data-done", "true");
    await expect(this.task(number).locator(".because p")).not.toHaveAttribute("hidden");
  }

  async isUndone(): Promise<void> {
    await expect(this.page.locator(".task[data-done]")).toHaveCount(0);
  }
}
