/** Recognizes files whose content is not that of any mesh format, whatever their names say. */
import { isArrayOf } from "../base/values.js";
import { type ByteSource, piecesOf } from "./byte-source.js";
import { joined } from "./bytes.js";
import { ReadFailure } from "./read-result.js";

/** Number of bytes that tell. */
const HEAD_BYTES = 256;

interface OtherContent {
  /** Text, or a pattern of it. */
  readonly begins: string | RegExp;
  readonly what: string;
  /** Name of the format that has this content. */
  readonly format?: string;
  readonly remedy: string;
}

const OTHERS: readonly OtherContent[] = [
  {
    begins: /^\s*(<!--[^>]*-->\s*)?<(!doctype\s+html|html|head|body)\b/i,
    what: "a web page (HTML)",
    remedy: "Download the file itself: what was saved is a page that shows or announces it.",
  },
  {
    begins: "%PDF-",
    what: "a PDF document",
    remedy: "Export the part from the CAD program in one of the formats that can be read.",
  },
  {
    begins: "\x1f\x8b",
    what: "compressed by gzip",
    remedy: "Unpack it first, for example by gunzip.",
  },
  {
    begins: "PK\x03\x04",
    what: "a ZIP archive",
    format: "3MF",
    remedy: "Unpack it first, and use the file inside.",
  },
];

const isAt = (begins: string | RegExp, text: string): boolean =>
  typeof begins === "string" ? text.startsWith(begins) : begins.test(text);

/** Remembers how a file begins while it is read. */
export class FileHead {
  #bytes = new Uint8Array();

  /** Returns a source of the same bytes. */
  of(source: ByteSource): ByteSource {
    if (isArrayOf(Uint8Array, source)) {
      this.#add(source);
      return source;
    }
    return this.#watched(source);
  }

  async *#watched(source: ByteSource): AsyncGenerator<Uint8Array, void> {
    for await (const piece of piecesOf(source)) {
      this.#add(piece);
      yield piece;
    }
  }

  #add(piece: Uint8Array): void {
    const missing = HEAD_BYTES - this.#bytes.length;
    if (missing > 0) this.#bytes = joined([this.#bytes, piece.subarray(0, missing)]);
  }

  /** Returns why the file cannot be read if its content is of another kind than its format; else the given failure. */
  explained(failure: unknown, format: string): unknown {
    if (!(failure instanceof ReadFailure)) return failure;
    const text = new TextDecoder("latin1").decode(this.#bytes).replace(/^\xef\xbb\xbf/, "");
    const other = OTHERS.find(({ begins, format: own }) => own !== format && isAt(begins, text));
    if (other === undefined) return failure;
    return new ReadFailure({ message: `this is ${other.what}, not ${format}`, remedy: other.remedy });
  }
}
