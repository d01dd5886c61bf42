/**
 * Names and colours of the faces and solids of a STEP file, from its text: the kernel hands out shapes only. A solid of the kernel is
 * that of the text with the same kinds of surfaces in the same order; if several have them and look different, none is taken.
 */
import { plainText } from "./step-strings.js";
import type { CadColor, FaceSurface, TrimmedModel } from "./trimmed-model.js";

/** The name, empty if the file has none, and the colour of a face or a solid. */
interface Look {
  readonly name: string;
  readonly color: CadColor | undefined;
}

export interface SolidLooks {
  readonly solid: Look;
  readonly faces: readonly Look[];
}

interface Entity {
  readonly type: string;
  readonly name: string;
  readonly refs: readonly string[];
  readonly text: string;
}

const INSTANCE = /#(\d+)\s*=\s*((?:[^;']|'[^']*')*);/g;
const SOLID = /^(MANIFOLD_SOLID_BREP|BREP_WITH_VOIDS|FACETED_BREP)$/;
const COLOR = /COLOUR_RGB\s*\(\s*'(?:[^']|'')*'\s*,\s*([-+\d.E]+)\s*,\s*([-+\d.E]+)\s*,\s*([-+\d.E]+)/i;
const NAMED_COLOR = /DRAUGHTING_PRE_DEFINED_COLOUR\s*\(\s*'(\w+)'/i;
/** ISO 10303-46. */
const NAMED: Readonly<Record<string, CadColor>> = {
  red: [1, 0, 0],
  green: [0, 1, 0],
  blue: [0, 0, 1],
  yellow: [1, 1, 0],
  magenta: [1, 0, 1],
  cyan: [0, 1, 1],
  black: [0, 0, 0],
  white: [1, 1, 1],
};
/** Steps from a style to its colour; more are another style's. */
const MAX_STEPS = 8;

const KINDS: Readonly<Record<string, FaceSurface["kind"]>> = {
  PLANE: "plane",
  CYLINDRICAL_SURFACE: "cylinder",
  CONICAL_SURFACE: "cone",
  SPHERICAL_SURFACE: "sphere",
  TOROIDAL_SURFACE: "torus",
  DEGENERATE_TOROIDAL_SURFACE: "torus",
  SURFACE_OF_LINEAR_EXTRUSION: "extrusion",
  SURFACE_OF_REVOLUTION: "revolution",
};

/** Returns a model with the names and colours of its STEP file. Solids whose faces were cut or left out keep none. O(bytes). */
export function withLooks(model: TrimmedModel, text: string): TrimmedModel {
  const kinds = model.solids.map(() => [] as FaceSurface["kind"][]);
  const places = model.faces.map(({ solid, surface }) => {
    const ofSolid = kinds[solid] ?? [];
    return ofSolid.push(model.surfaces[surface]?.kind ?? "plane") - 1;
  });
  const looks = looksOf(text, kinds);
  return {
    ...model,
    faces: model.faces.map((face, f) => ({ ...face, ...looks[face.solid]?.faces[places[f] ?? 0] })),
    solids: model.solids.map((solid, s) => ({ ...solid, name: looks[s]?.solid.name ?? "" })),
  };
}

/**
 * Returns the looks of solids, given by the kinds of their surfaces. A solid that is not found among those of the text has the look
 * of that at its place, if there are as many, and its faces that of the solid; else undefined. O(bytes).
 */
export function looksOf(text: string, solids: readonly (readonly string[])[]): (SolidLooks | undefined)[] {
  const found = new Map<string, SolidLooks | undefined>();
  const all = new StepLooks(text).solids();
  for (const { kinds, looks } of all) {
    const key = kinds.join();
    const isKnown = found.has(key);
    const isSame = isKnown && JSON.stringify(found.get(key)) === JSON.stringify(looks);
    found.set(key, isKnown && !isSame ? undefined : looks);
  }
  return solids.map((kinds, s) => {
    const known = found.get(kinds.join());
    const at = solids.length === all.length ? all[s] : undefined;
    if (known !== undefined || at === undefined) return known;
    if (at.kinds.length === kinds.length) return at.looks;
    const { solid } = at.looks;
    return { solid, faces: kinds.map(() => ({ name: "", color: solid.color })) };
  });
}

/** Returns the name of a face; undefined for what programs write where it has none. */
export const ownName = (name: string): string | undefined => (/^(NONE)?$/i.test(name) ? undefined : name);

class StepLooks {
  readonly #entities = new Map<string, Entity>();
  readonly #colors = new Map<string, CadColor>();

  constructor(text: string) {
    for (const [, id = "", definition = ""] of text.matchAll(INSTANCE)) {
      const type = /^\s*(\w+)/.exec(definition)?.[1] ?? "";
      const name = /^[^']*'((?:[^']|'')*)'/.exec(definition)?.[1] ?? "";
      const refs = Array.from(definition.replace(/'[^']*'/g, "").matchAll(/#(\d+)/g), ([, ref = ""]) => ref);
      this.#entities.set(id, { type, name: plainText(name), refs, text: definition });
    }
    for (const { type, refs } of this.#entities.values()) {
      if (!/^(OVER_RIDING_)?STYLED_ITEM$/.test(type)) continue;
      // Its styles, then the item, then the style that it replaces.
      const item = refs.at(type === "STYLED_ITEM" ? -1 : -2);
      const color = this.#colorOf(refs.slice(0, type === "STYLED_ITEM" ? -1 : -2));
      if (item !== undefined && color !== undefined) this.#colors.set(item, color);
    }
  }

  solids(): { readonly kinds: readonly string[]; readonly looks: SolidLooks }[] {
    return [...this.#entities]
      .filter(([, { type }]) => SOLID.test(type))
      .map(([id, { name, refs }]) => {
        const solid = { name, color: this.#colors.get(id) };
        const faces = refs.flatMap((shell) => this.#facesOf(shell, 0));
        const looks = faces.map((face) => ({
          name: this.#entities.get(face)?.name ?? "",
          color: this.#colors.get(face) ?? solid.color,
        }));
        return { kinds: faces.map((face) => this.#kindOf(face)), looks: { solid, faces: looks } };
      });
  }

  #facesOf(shell: string, depth: number): readonly string[] {
    const { type = "", refs = [] } = this.#entities.get(shell) ?? {};
    if (type !== "ORIENTED_CLOSED_SHELL" || depth > MAX_STEPS) return refs;
    return refs.flatMap((inner) => this.#facesOf(inner, depth + 1));
  }

  #kindOf(face: string): string {
    const surface = this.#entities.get(this.#entities.get(face)?.refs.at(-1) ?? "");
    return KINDS[surface?.type ?? ""] ?? "spline";
  }

  #colorOf(styles: readonly string[]): CadColor | undefined {
    let open = styles;
    for (let step = 0; step < MAX_STEPS && open.length > 0; step++) {
      const entities = open.map((id) => this.#entities.get(id)).filter((entity) => entity !== undefined);
      for (const { text } of entities) {
        const [, red, green, blue] = COLOR.exec(text) ?? [];
        if (blue !== undefined) return [Number(red), Number(green), Number(blue)];
        const named = NAMED[NAMED_COLOR.exec(text)?.[1]?.toLowerCase() ?? ""];
        if (named !== undefined) return named;
      }
      open = entities.filter(({ type }) => !type.startsWith("CURVE_STYLE")).flatMap(({ refs }) => refs);
    }
    return undefined;
  }
}
