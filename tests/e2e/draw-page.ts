import { expect } from "@playwright/test";
import { defectsOf } from "../support/check-mesh";
import { parseVtu } from "../support/mesh-files";
import { readProject } from "tetrafront/project";
import { countActions, expectActions, forgetActions } from "./actions";
import { AppPage, type Position } from "./app-page";
import { downloaded, downloadMesh } from "./downloads";

/** The view of a new project, drawn in with the pointer and the keyboard alone. */
export class DrawPage extends AppPage {
  async openNew(): Promise<void> {
    const chooseStraightLines = async (): Promise<void> => {
      await this.page.getByTestId("tool-line").click();
      await this.page.getByTestId("drawing-bar").getByText("straight", { exact: true }).click();
      await this.page.getByTestId("tool-select").click();
    };
    if (await this.openEmptyAgain(chooseStraightLines)) return forgetActions(this.page);
    await countActions(this.page);
    await this.page.addInitScript(() => {
      Reflect.deleteProperty(window, "showOpenFilePicker");
      Reflect.deleteProperty(window, "showSaveFilePicker");
    });
    await this.page.goto("./?test=1&new=1");
    await expect(this.viewport).toHaveAttribute("data-points", "0");
    await expect(this.viewport).toHaveAttribute("data-frames", /./);
  }

  async hover(position: Position): Promise<void> {
    const { x, y } = await this.at(position);
    await this.page.mouse.move(x, y);
  }

  async typeCoordinates(...texts: readonly string[]): Promise<void> {
    for (const text of texts) {
      await this.page.keyboard.type(text);
      await expect(this.page.getByTestId("coordinates")).toHaveValue(text);
      await this.page.keyboard.press("Enter");
      await expect(this.page.getByTestId("coordinates")).toBeHidden();
    }
  }

  /** The positions of all points, in a downloaded project. */
  async savedPositions(): Promise<readonly Position[]> {
    const saved = await downloaded(this.page, () => this.page.keyboard.press("Control+s"));
    const read = readProject(Buffer.from(saved).toString());
    if (!read.success) throw new Error(read.errors[0].message);
    return read.value.points.map(({ position }) => position);
  }

  /** Length in the model of the handles at a position: they have the same size on the screen at any distance. */
  async handleLength(middle: Position): Promise<number> {
    const small = 1e-3;
    const centre = await this.at(middle);
    let squares = 0;
    for (const axis of [0, 1, 2]) {
      const beside = await this.at(middle.map((x, k) => (k === axis ? x + small : x)) as unknown as Position);
      squares += ((beside.x - centre.x) ** 2 + (beside.y - centre.y) ** 2) / small ** 2;
    }
    // Seen from anywhere, the squares of the lengths of three perpendicular units sum to two.
    const pixel = Math.sqrt(2 / squares);
    const { height } = (await this.viewport.boundingBox()) ?? { height: 0 };
    // Three draws a unit of its handles with 1.9 / 8 of the height of the view.
    return (1.9 / 8) * height * pixel;
  }

  async counts(points: number, lines: number, patches: number): Promise<void> {
    await expect(this.viewport).toHaveAttribute("data-points", String(points));
    await expect(this.viewport).toHaveAttribute("data-lines", String(lines));
    await expect(this.viewport).toHaveAttribute("data-patches", String(patches));
  }

  /** Sets a uniform size, meshes, and returns the downloaded mesh with its defects by an independent check. */
  async downloadedMesh(size: string, task: string) {
    await this.page.keyboard.press("Escape");
    await this.page.keyboard.press("Escape");
    await this.page.getByText("Uniform", { exact: true }).click();
    await this.type("uniform-size", size);
    await this.generate();
    await expectActions(this.page, task);
    const { points, tetrahedra } = parseVtu(await downloadMesh(this.page, /VTU/));
    const mesh = {
      points: Float64Array.from(points),
      tetrahedra: Uint32Array.from(tetrahedra.flat()),
    };
    const { extraFaces: _, ...defects } = defectsOf(mesh, {
      points: new Float64Array(),
      triangles: new Uint32Array(),
    });
    return { mesh, defects };
  }
}
