/** What the address of a page asks for and cannot get. Loaded if the address has parameters. */
import type { App } from "../../app/app";
import { sharedFrontIn } from "../player/shared-front";
import { showNotice } from "../../session/shell";
import { addressStrings as texts } from "../strings/address";

/** Parameters that say how a front is shown. */
const frontNames = ["order", "color", "faces", "elements", "candidate", "beat", "camera"] as const;

/** Shows sentences about the address, after those that are shown already. */
export function showAddressProblems({ shell }: Pick<App, "shell">, problems: readonly string[]): void {
  if (problems.length === 0) return;
  const shown = shell.getState().notices.find(({ key }) => key === "address");
  showNotice(shell, {
    key: "address",
    tone: "warning",
    text: [...(shown ? [shown.text] : []), ...problems].join(" "),
    action: { label: texts.understood, run: () => undefined },
  });
}

/**
 * Returns a sentence for each parameter that cannot be read, about what was expected and what is shown instead. Whether a model
 * or a step exists is not known here.
 */
export function addressProblems(query: URLSearchParams): readonly string[] {
  const step = query.get("step");
  if (step === null) {
    const names = frontNames.filter((name) => query.has(name));
    return names.length === 0 ? [] : [texts.withoutStep(names)];
  }
  if (!query.has("model")) return [texts.stepAlone(step)];
  const front = sharedFrontIn(query);
  if (!front) return [texts.step(step)];
  const { order, coloring, faces, elements, candidate, beat, camera } = front;
  const isRead: Readonly<Record<(typeof frontNames)[number], boolean>> = {
    order: order !== null,
    color: coloring === query.get("color"),
    faces: faces === query.get("faces"),
    elements: elements === query.get("elements"),
    candidate: candidate !== null,
    beat: beat !== null,
    camera: camera !== null,
  };
  return frontNames.flatMap((name) => {
    const value = query.get(name);
    return value === null || isRead[name] ? [] : [texts.ofFront[name](value)];
  });
}
