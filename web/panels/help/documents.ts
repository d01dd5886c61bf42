/** The documents of the project, as the help shows them. Loaded when they are opened. */
import changelog from "../../../CHANGELOG.md?raw";
import readme from "../../../README.md?raw";
import actions from "../../../docs/ACTIONS.md?raw";
import adaptive from "../../../docs/ADAPTIVE.md?raw";
import architecture from "../../../docs/ARCHITECTURE.md?raw";
import benchmarks from "../../../docs/BENCHMARKS.md?raw";
import cad from "../../../docs/CAD.md?raw";
import design from "../../../docs/DESIGN.md?raw";
import format from "../../../docs/FORMAT.md?raw";
import lessons from "../../../docs/LESSONS.md?raw";
import paper from "../../../docs/PAPER.md?raw";
import trace from "../../../docs/TRACE.md?raw";
import { sectionsOf, type HelpSection } from "../../document/help-search";

/** The text of the package, which has its own README beside its sources. */
const packageReadme = Object.values(
  import.meta.glob<string>("../../../wasm/README.md", { query: "?raw", import: "default", eager: true }),
).join("");

/** Texts by the id of the document, in the order of the list. */
export const documents: Readonly<Record<string, string>> = {
  readme,
  format,
  package: packageReadme,
  adaptive,
  lessons,
  trace,
  paper,
  design,
  architecture,
  benchmarks,
  cad,
  actions,
  changelog,
};

/** Ids of documents by the names of their files, to which links lead. */
export const documentOfFile = (path: string): string | null => {
  const name = path.replace(/^(\.\.?\/)*/, "").toLowerCase();
  if (name.startsWith("wasm/readme")) return "package";
  const id = name.replace(/^docs\//, "").replace(/\.md$/, "");
  return id in documents ? id : null;
};

export const sections: readonly HelpSection[] = Object.entries(documents).flatMap(([id, text]) =>
  sectionsOf(id, text),
);
