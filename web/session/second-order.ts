import type { Mesher, MeshResult } from "tetrafront";
import { inOrder } from "tetrafront/internal";
import { createStore, type StoreApi } from "zustand/vanilla";
import { failureText } from "./failure-text";
import { keptOrder } from "./kept-order";
import type { MeshRun } from "./run";

export interface SecondOrderState {
  /** Whether meshes are shown with second-order elements. */
  readonly isOn: boolean;
  /** Why the shown mesh has none all the same; null without a failure. */
  readonly failure: string | null;
}

/** Curves the edges of the mesh that is shown, while this is switched on. */
export class SecondOrder {
  readonly state: StoreApi<SecondOrderState> = createStore<SecondOrderState>(() => ({
    isOn: keptOrder.isSecond(),
    failure: null,
  }));
  readonly #run: MeshRun;
  readonly #mesher: Promise<Mesher>;
  /** By the mesh with straight edges. */
  readonly #curved = new WeakMap<MeshResult, Promise<MeshResult>>();
  /** By the mesh with curved edges. */
  readonly #straight = new WeakMap<MeshResult, MeshResult>();

  constructor(run: MeshRun, mesher: Promise<Mesher>) {
    this.#run = run;
    this.#mesher = mesher;
    run.state.subscribe((state, before) => {
      if (state.mesh !== before.mesh) void this.#follow();
    });
  }

  setOn(isOn: boolean): void {
    keptOrder.keep(isOn);
    this.state.setState({ isOn, failure: null });
    void this.#follow();
  }

  /** Returns a mesh with second-order elements. Rejects if elements are inverted. */
  curved(mesh: MeshResult): Promise<MeshResult> {
    if (this.#straight.has(mesh)) return Promise.resolve(mesh);
    const known = this.#curved.get(mesh);
    if (known) return known;
    const made = this.#make(mesh);
    this.#curved.set(mesh, made);
    made.catch(() => this.#curved.delete(mesh));
    return made;
  }

  async #make(mesh: MeshResult): Promise<MeshResult> {
    const curved = await inOrder(await this.#mesher, mesh, { elementOrder: 2 }, {});
    if (curved !== mesh) this.#straight.set(curved, mesh);
    return curved;
  }

  /** Shows the mesh in the order that is chosen. */
  async #follow(): Promise<void> {
    const { mesh } = this.#run.state.getState();
    if (!mesh) return;
    const { isOn } = this.state.getState();
    const straight = this.#straight.get(mesh);
    if (!isOn) {
      if (straight) this.#run.exchange(mesh, { mesh: straight });
      return;
    }
    if (straight) return;
    try {
      const curved = await this.curved(mesh);
      if (!this.state.getState().isOn) return;
      this.state.setState({ failure: null });
      if (curved !== mesh) this.#run.exchange(mesh, { mesh: curved });
    } catch (error) {
      this.state.setState({ failure: failureText(error) });
    }
  }
}
