/**
 * A project with what the view shows of it, in the fragment of an address: JSON, compressed by the browser. Browsers do not send
 * fragments to the server, so the project stays with those who have the link.
 */
import { parseProject, type Project } from "tetrafront/project";
import type { Cut, CutAxis } from "../document/selection";
import type { Position } from "../document/position";
import type { CameraPose } from "../viewer/camera";

export interface LinkedProject {
  readonly project: Project;
  /** Null for a camera that shows the whole model. */
  readonly camera: CameraPose | null;
  /** Null if the mesh is not cut. */
  readonly cut: Cut | null;
  /** What a replay of the project's front says of itself, not checked; null if none is shown. */
  readonly front: Readonly<Record<string, unknown>> | null;
}

/** Why a link cannot be opened; `reason` is the sentence of a project that is not valid. */
export type LinkFailure =
  | { readonly kind: "damaged" }
  | { readonly kind: "invalid"; readonly reason: string };

export type LinkResult = { readonly kind: "linked"; readonly linked: LinkedProject } | LinkFailure;

/**
 * Longest address that is offered. Browsers take more, but mail programs, messengers and office programs cut or refuse longer
 * ones, most of them somewhere above this length.
 */
export const maxLinkLength = 32_000;

const name = "project";
/** Of the content; other versions are not read. */
const version = 1;
/** Largest size of the content, in bytes: a short link may hold any amount of repeated text. */
const maxContentBytes = 64 * 2 ** 20;
const algorithm = "deflate-raw";

/** Returns the address with a project in its fragment, in place of its parameters. */
export async function linkTo(address: string, linked: LinkedProject): Promise<string> {
  const { camera, cut, front, project } = linked;
  const content = {
    version,
    project,
    ...(camera && { camera: [...camera.eye, ...camera.target] }),
    ...(cut && { cut }),
    ...(front && { front }),
  };
  const bytes = new Blob([JSON.stringify(content)]).stream().pipeThrough(new CompressionStream(algorithm));
  const link = new URL(address);
  link.search = "";
  link.hash = `${name}=${encoded(new Uint8Array(await new Response(bytes).arrayBuffer()))}`;
  return link.href;
}

/** Returns an address without a project. */
export function withoutLink(address: string): URL {
  const changed = new URL(address);
  changed.hash = "";
  return changed;
}

/** Returns what the fragment of an address holds; null if it names no project. */
export async function linkedIn(hash: string): Promise<LinkResult | null> {
  const found = new RegExp(`^#${name}=(.*)$`, "s").exec(hash);
  if (!found) return null;
  const content = await contentOf(found[1] ?? "").catch(() => null);
  if (content === null) return { kind: "damaged" };
  const read = parseProject(content["project"]);
  if (!read.success) return { kind: "invalid", reason: read.errors[0].message };
  const linked = {
    project: read.value,
    camera: cameraOf(content["camera"]),
    cut: cutOf(content["cut"]),
    front: isRecord(content["front"]) ? content["front"] : null,
  };
  return { kind: "linked", linked };
}

type Content = Readonly<Record<string, unknown>>;

const isRecord = (value: unknown): value is Content => typeof value === "object" && value !== null;

async function contentOf(text: string): Promise<Content | null> {
  // Mail programs break long lines.
  const bytes = decoded(text.replace(/%20|\s/g, ""));
  const content: unknown = JSON.parse(await inflated(bytes));
  return isRecord(content) && content["version"] === version ? content : null;
}

async function inflated(bytes: Uint8Array<ArrayBuffer>): Promise<string> {
  const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream(algorithm)).getReader();
  const decoder = new TextDecoder("utf-8", { fatal: true });
  let size = 0;
  let text = "";
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    size += part.value.length;
    if (size > maxContentBytes) {
      await reader.cancel();
      throw new RangeError("The content of the link is too large");
    }
    text += decoder.decode(part.value, { stream: true });
  }
  return text + decoder.decode();
}

/** Bytes that are converted at once: functions take a limited number of arguments. */
const chunk = 0x8000;

/** Returns bytes in the alphabet of base64 for addresses (RFC 4648, section 5). */
function encoded(bytes: Uint8Array): string {
  let binary = "";
  for (let at = 0; at < bytes.length; at += chunk)
    binary += String.fromCharCode(...bytes.subarray(at, at + chunk));
  return btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

function decoded(text: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (letter) =>
    letter.charCodeAt(0),
  );
}

const isNumber = (value: unknown): value is number => typeof value === "number" && Number.isFinite(value);

function cameraOf(value: unknown): CameraPose | null {
  if (!Array.isArray(value) || value.length !== 6 || !value.every(isNumber)) return null;
  const [a = 0, b = 0, c = 0, ...target] = value as readonly number[];
  const eye: Position = [a, b, c];
  // A camera needs a direction.
  if (eye.every((x, i) => x === target[i])) return null;
  return { eye, target: [target[0] ?? 0, target[1] ?? 0, target[2] ?? 0] };
}

const axes: readonly CutAxis[] = ["x", "y", "z"];

function cutOf(value: unknown): Cut | null {
  if (!isRecord(value)) return null;
  const { position, flipped } = value;
  const axis = axes.find((each) => each === value["axis"]);
  const isInside = isNumber(position) && position >= 0 && position <= 1;
  return axis && isInside ? { enabled: true, axis, position, flipped: flipped === true } : null;
}
