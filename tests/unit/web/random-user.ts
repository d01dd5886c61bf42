import { noSolids } from "../../support/no-solids";
import type { Project } from "tetrafront/project";
import { makers, sourceMakers } from "../../../web/commands/create-menu";
import { setCommonNumber } from "../../../web/document/common-edits";
import { addBackgroundNode, addPoint, emptyProject } from "../../../web/document/create";
import type { ProjectEdit } from "../../../web/document/edit";
import { deleteEntities, moveEntity, renameEntity, setLineType } from "../../../web/document/edits";
import { drawnKinds, recordsOf, type Entity } from "../../../web/document/entities";
import { keepingExpression } from "../../../web/document/expression-edits";
import {
  addGroup,
  colorGroup,
  extendGroup,
  reduceGroup,
  removeGroup,
  renameGroup,
} from "../../../web/document/groups";
import { lineTypes } from "../../../web/document/line-types";
import type { Operation } from "../../../web/document/operations/operation";
import { pieceOperations } from "../../../web/document/operations/pieces";
import { sweepOperations } from "../../../web/document/operations/sweeps";
import { transformOperations } from "../../../web/document/operations/transforms";
import {
  addParameter,
  expressionProblem,
  freeName,
  removeParameter,
  renameParameter,
  setParameter,
} from "../../../web/document/parameters";
import { connectedTo } from "../../../web/document/select-related";
import { ViewStore } from "../../../web/document/selection";
import { scaleSizes, setMeshing } from "../../../web/document/size-edits";
import { DocumentStore } from "../../../web/session/document-store";
import { Operations } from "../../../web/session/operations";
import { randomSource } from "../../support/random";

/** A model with more points than this is not made larger. */
const manyPoints = 250;

/** A user who chooses at random. */
export class RandomUser {
  readonly documents = new DocumentStore(emptyProject("Random"), () => 0);
  readonly view = new ViewStore();
  readonly operations = new Operations(this.documents, this.view, noSolids);
  readonly #next: () => number;
  readonly #actions: readonly (() => void)[] = [
    () => this.#create(addPoint(this.#project, this.#position())),
    () => this.#create(addBackgroundNode(this.#project, this.#position(), 0.1 + this.#below(1))),
    () => this.#select(),
    () => this.#select(),
    () => this.#make(),
    () => this.#operate(pieceOperations),
    () => this.#operate(transformOperations),
    () => this.#operate(sweepOperations),
    () => this.#edit(deleteEntities(this.#project, this.#selection.slice(0, 3))),
    () => this.#editEntity(),
    () => this.#editEntity(),
    () => this.#editGroups(),
    () => this.#editParameters(),
    () => this.#keepExpression(),
    () =>
      this.#edit(this.#choose([scaleSizes(this.#project, 0.5), setMeshing("size", this.#below(2) + 0.01)])),
    () => this.#drag(),
    () => this.documents.undo(),
    () => this.documents.redo(),
    () => this.documents.jumpTo(Math.floor(this.#below(8))),
  ];

  constructor(seed: number) {
    const source = randomSource(seed);
    // The first numbers of neighbouring seeds are alike.
    for (let i = 0; i < 8; ++i) source();
    this.#next = () => source() / 2 ** 32;
  }

  act(): void {
    this.#choose(this.#actions)();
  }

  get #project(): Project {
    return this.documents.project;
  }

  get #selection(): readonly Entity[] {
    return this.view.state
      .getState()
      .selection.filter(({ kind, id }) => recordsOf(this.#project, kind).some((record) => record.id === id));
  }

  #below(limit: number): number {
    return limit * this.#next();
  }

  #choose<Item>(items: readonly Item[]): Item {
    const item = items[Math.floor(this.#below(items.length))];
    if (item === undefined) throw new Error("there is nothing to choose from");
    return item;
  }

  /** On a coarse lattice, so that places coincide. */
  #position(): readonly [number, number, number] {
    const whole = () => Math.floor(this.#below(5)) - 2;
    return [whole(), whole(), whole() / 2];
  }

  #edit(edit: ProjectEdit): void {
    this.documents.edit(edit);
  }

  #create({ edit, entities }: { readonly edit: ProjectEdit; readonly entities: readonly Entity[] }): void {
    this.documents.edit(edit);
    this.view.selectAll(entities);
  }

  #select(): void {
    const all = drawnKinds.flatMap((kind) =>
      recordsOf(this.#project, kind).map(({ id }): Entity => ({ kind, id })),
    );
    if (all.length === 0) return;
    const some = Array.from({ length: 1 + Math.floor(this.#below(5)) }, () => this.#choose(all));
    const kind = this.#choose(all).kind;
    this.view.selectAll(
      this.#choose([
        some,
        some.filter((entity) => entity.kind === kind),
        connectedTo(this.#project, some.slice(0, 1)),
        [],
      ]),
    );
  }

  /** Creates a line, patch, hole, source or tetrahedron from the selection. */
  #make(): void {
    for (const maker of [...makers, ...sourceMakers]) {
      const offer = maker.offer(this.#project, this.#selection);
      if (offer.possible && this.#below(1) < 0.5) return this.#create(offer.creation);
    }
  }

  #operate(list: readonly Operation[]): void {
    if (this.#project.points.length > manyPoints) return;
    this.view.selectAll(this.#selection);
    this.operations.start(this.#choose(list));
    const { open } = this.operations.state.getState();
    if (!open) throw new Error("the panel is closed");
    for (const field of open.operation.fields(open.values, open.subject)) {
      if (this.#below(1) < 0.5) continue;
      const { key, kind } = field;
      if (kind === "switch") this.operations.set(key, this.#below(1) < 0.5);
      else if (kind === "position" || kind === "direction") this.operations.set(key, this.#position());
      // Solids are computed by the kernel, for which a history of this kind cannot wait.
      else if (kind === "choice") {
        if (key !== "makes") this.operations.set(key, this.#choose(field.choices).value);
      } else {
        const value = field.whole === true ? 1 + Math.floor(this.#below(5)) : 0.1 + this.#below(3);
        if (!field.refuse?.(value)) this.operations.set(key, value);
      }
    }
    if (this.#below(1) < 0.3 || !this.operations.accept()) this.operations.cancel();
  }

  #editEntity(): void {
    const entity = this.#selection[0];
    if (!entity) return;
    const { kind, id } = entity;
    if (kind === "line") this.#edit(setLineType(id, this.#choose(lineTypes)));
    else if (kind === "point") this.#edit(moveEntity(kind, id, 1, this.#below(4)));
    this.#edit(renameEntity(entity, this.#choose(["", "a", "b"])));
    const points = this.#selection.filter((one) => one.kind === "point" || one.kind === "background-node");
    if (points.length > 1) this.#edit(setCommonNumber(points, "position.2", this.#below(2), null));
  }

  #editGroups(): void {
    const { groups = [] } = this.#project;
    if (groups.length === 0) return this.#edit(addGroup(this.#project, this.#selection));
    const { id } = this.#choose(groups);
    this.#edit(
      this.#choose([
        addGroup(this.#project, this.#selection),
        extendGroup(this.#project, id, this.#selection),
        reduceGroup(this.#project, id, this.#selection),
        colorGroup(this.#project, id, [this.#below(1), 0, 1]),
        renameGroup(this.#project, id, "renamed"),
        removeGroup(this.#project, id),
      ]),
    );
  }

  #editParameters(): void {
    const { parameters = [] } = this.#project;
    const name = freeName(this.#project);
    if (parameters.length === 0) return this.#edit(addParameter(name, "1/2"));
    const one = this.#choose(parameters);
    const text = `${Math.floor(this.#below(9))} - ${this.#choose(parameters).name}/4`;
    this.#edit(
      this.#choose([
        addParameter(name, `2*${one.name}`),
        ...(expressionProblem(this.#project, one.name, text) === null ? [setParameter(one.name, text)] : []),
        renameParameter(one.name, name),
        removeParameter(this.#project, one.name),
      ]),
    );
  }

  #keepExpression(): void {
    const { points, parameters = [] } = this.#project;
    if (points.length === 0 || parameters.length === 0) return;
    const { id } = this.#choose(points);
    const path = { kind: "point", id, field: "position.0" } as const;
    this.#edit(keepingExpression(moveEntity("point", id, 0, 0), path, `3*${this.#choose(parameters).name}`));
  }

  #drag(): void {
    const [point] = this.#project.points;
    if (!point) return;
    const gesture = this.documents.begin("Drag");
    for (let i = 0; i < 3; ++i) gesture.update(moveEntity("point", point.id, 0, this.#below(3)));
    if (this.#below(1) < 0.5) gesture.commit();
    else gesture.cancel();
  }
}
