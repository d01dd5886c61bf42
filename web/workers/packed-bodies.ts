import type { Project, ProjectBody } from "tetrafront/project";
import { minLongText, rememberText, textKey } from "../document/long-texts";
import { nextTurn } from "../document/slices";

type TextName = "points" | "triangles" | "trianglePatch" | "trueFaces";

const textNames: readonly TextName[] = ["points", "triangles", "trianglePatch", "trueFaces"];

/** A long text of a body on its way from a worker: its bytes are transferred, and its blob passes without a copy. */
interface PackedText {
  readonly name: TextName;
  readonly key: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
  readonly blob: Blob;
}

/** A body whose long texts are empty, and these texts. */
export interface PackedBody {
  readonly body: ProjectBody;
  readonly texts: readonly PackedText[];
}

/** Packs a body in a worker. */
export function packedBody(body: ProjectBody): PackedBody {
  const long = textNames.filter((name) => (body[name] ?? "").length >= minLongText);
  const texts = long.map((name): PackedText => {
    const text = body[name] ?? "";
    const bytes = new TextEncoder().encode(text);
    return { name, key: textKey(text), bytes, blob: new Blob([bytes]) };
  });
  const emptied = Object.fromEntries(long.map((name) => [name, ""]));
  return { body: { ...body, ...emptied }, texts };
}

/** Returns the buffers of packed bodies, for the transfer list of a message. */
export const buffersOfPacked = (packed: readonly PackedBody[]): ArrayBuffer[] =>
  packed.flatMap(({ texts }) => texts.map(({ bytes }) => bytes.buffer));

/** Restores a body in the page, one text at a time, and notes the keys of its texts. */
export async function unpackedBody({ body, texts }: PackedBody): Promise<ProjectBody> {
  const restored: Partial<Record<TextName, string>> = {};
  for (const { name, key, bytes, blob } of texts) {
    const text = new TextDecoder().decode(bytes);
    rememberText(text, key, blob);
    restored[name] = text;
    await nextTurn();
  }
  return { ...body, ...restored };
}

/** Restores the bodies of a project; undefined without any. */
export async function unpackedBodies(packed: readonly PackedBody[]): Promise<Project["bodies"]> {
  const bodies: ProjectBody[] = [];
  for (const one of packed) bodies.push(await unpackedBody(one));
  return bodies.length > 0 ? bodies : undefined;
}
