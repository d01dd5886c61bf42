import { Anchor, Text, UnstyledButton } from "@mantine/core";
import { useEffect, useRef, type ReactNode } from "react";
import Markdown, { type Components } from "react-markdown";
import remarkGfm from "remark-gfm";
import { headingId, plainText, searchHelp, type HelpSection } from "../../document/help-search";
import { strings } from "../../strings";
import tables from "../../ui/table.module.css";
import { documentOfFile, documents, sections } from "./documents";
import styles from "./help-dialog.module.css";

const texts = strings.help;
const remarkPlugins = [remarkGfm];

/** A place in the help: a document, and the id of a heading in it. */
export interface HelpPlace {
  readonly document: string;
  readonly heading: string | null;
}

interface DocumentProps {
  readonly place: HelpPlace;
  readonly onOpen: (place: HelpPlace) => void;
}

/** A document of the project. Links to other documents open them here. */
export default function HelpDocument({ place, onOpen }: DocumentProps) {
  const box = useRef<HTMLDivElement>(null);
  const { document: id, heading } = place;
  useEffect(() => {
    const target = heading === null ? null : box.current?.querySelector(`#${CSS.escape(`help-${heading}`)}`);
    if (target) target.scrollIntoView({ block: "start" });
    else box.current?.closest('[role="dialog"]')?.scrollTo({ top: 0 });
  }, [id, heading]);
  return (
    <div ref={box} className={styles["document"]} data-testid={`help-document-${id}`}>
      <Markdown remarkPlugins={remarkPlugins} components={componentsOf(id, onOpen)}>
        {documents[id] ?? ""}
      </Markdown>
    </div>
  );
}

const textOf = (children: ReactNode): string =>
  Array.isArray(children)
    ? children.map(textOf).join("")
    : typeof children === "object" && children !== null && "props" in children
      ? textOf((children.props as { readonly children?: ReactNode }).children)
      : typeof children === "string"
        ? children
        : "";

function componentsOf(id: string, onOpen: (place: HelpPlace) => void): Components {
  const heading =
    (Tag: "h3" | "h4" | "h5" | "h6") =>
    ({ children }: { readonly children?: ReactNode }) => (
      <Tag id={`help-${headingId(plainText(textOf(children)))}`}>{children}</Tag>
    );
  return {
    h1: heading("h3"),
    h2: heading("h4"),
    h3: heading("h5"),
    h4: heading("h6"),
    // Pictures are files beside the documents, not of the app.
    img: () => null,
    table: ({ children }) => (
      <div className={styles["tableBox"]} tabIndex={0}>
        <table className={tables["table"]}>{children}</table>
      </div>
    ),
    a: ({ href = "", children }) => <Link href={href} from={id} onOpen={onOpen} text={children} />,
  };
}

interface LinkProps {
  readonly href: string;
  readonly from: string;
  readonly onOpen: (place: HelpPlace) => void;
  readonly text: ReactNode;
}

function Link({ href, from, onOpen, text }: LinkProps) {
  if (/^https?:/.test(href)) {
    return (
      <Anchor href={href} target="_blank" rel="noreferrer" inherit>
        {text}
      </Anchor>
    );
  }
  const [path = "", heading = null] = href.split("#");
  const target = path === "" ? from : documentOfFile(path);
  if (target === null) return text;
  return (
    <Anchor component="button" type="button" inherit onClick={() => onOpen({ document: target, heading })}>
      {text}
    </Anchor>
  );
}

interface ResultsProps {
  readonly query: string;
  /** Keys and mouse actions, as sections. */
  readonly keys: readonly HelpSection[];
  readonly onOpen: (place: HelpPlace) => void;
}

/** Largest number of results shown. */
const maxResults = 40;

/** The sections of all documents that a query finds. */
export function HelpResults({ query, keys, onOpen }: ResultsProps) {
  const found = searchHelp(query, [...keys, ...sections]);
  const shown = found.slice(0, maxResults);
  return (
    <>
      <Text size="sm" c="dimmed" role="status">
        {texts.found(found.length, shown.length)}
      </Text>
      <ul className={styles["results"]} data-testid="help-results">
        {shown.map(({ section, excerpt }) => (
          <li key={`${section.document}-${section.index}`}>
            <UnstyledButton
              className={styles["result"]}
              onClick={() => onOpen({ document: section.document, heading: headingId(section.title) })}
            >
              <Text size="sm" fw={600} component="span">
                {section.title}
              </Text>
              <Text size="xs" c="dimmed" component="span">
                {`${texts.documents[section.document] ?? texts.title} · ${excerpt}`}
              </Text>
            </UnstyledButton>
          </li>
        ))}
      </ul>
    </>
  );
}
