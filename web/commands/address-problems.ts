/** What the address of a page asks for and cannot get. Loaded if the address has parameters. */
import type { App } from "../app/app";
import { lessonIn } from "../lessons/lesson-address";
import { rulesNamed } from "../lessons/run-rules";
import { sharedFrontIn } from "../player/shared-front";
import { showNotice } from "../session/shell";
import { addressStrings as texts } from "../strings/address";

/**
 * Returns a sentence for each parameter that cannot be read, about what was expected and what is shown instead. Whether a model,
 * a lesson or a step exists is not known here.
 */
export function addressProblems(query: URLSearchParams): readonly string[] {
  const lesson = lessonIn(query);
  return lesson ? runProblems(query, lesson.runs) : [...frontProblems(query), ...orphans(query)];
}

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

function runProblems(query: URLSearchParams, known: readonly string[]): readonly string[] {
  const unknown = (query.get("runs") ?? "")
    .split(",")
    .map((name) => name.trim())
    .filter((name) => rulesNamed(name) === null);
  return unknown.map((name) => texts.runs(name, known));
}

function frontProblems(query: URLSearchParams): readonly string[] {
  const step = query.get("step");
  if (step === null) return [];
  if (!query.has("model")) return [texts.stepAlone(step)];
  const front = sharedFrontIn(query);
  if (!front) return [texts.step(step)];
  const { order, coloring, candidate, camera } = front;
  const isRead: readonly (readonly [name: keyof typeof texts.ofFront, isRead: boolean])[] = [
    ["order", order !== null],
    ["color", coloring === query.get("color")],
    ["candidate", candidate !== null],
    ["camera", camera !== null],
  ];
  return isRead.flatMap(([name, isKnown]) => {
    const value = query.get(name);
    return value === null || isKnown ? [] : [texts.ofFront[name](value)];
  });
}

/** Parameters that belong to another one, which is missing. */
function orphans(query: URLSearchParams): readonly string[] {
  return query.has("runs") ? [texts.runsAlone] : [];
}
