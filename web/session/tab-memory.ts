/**
 * Remembers which document an app has open. The memory survives a reload of the tab, but ends with the tab.
 */
export interface TabMemory {
  read(): string | null;
  write(id: string): void;
}

/** A document that a tab has opened by itself and not meshed, because another tab is open. */
export interface UnmeshedStart {
  readonly documentId: string;
  /** Whether the start page is open beside it. */
  readonly startPage: boolean;
}

export class BrowserTabMemory implements TabMemory {
  readonly #key: string;
  readonly #startKey: string;

  /** Two apps on one page need different names. */
  constructor(name: string) {
    this.#key = `tetrafront-open-document-${name}`;
    this.#startKey = `tetrafront-unmeshed-start-${name}`;
  }

  read(): string | null {
    try {
      return sessionStorage.getItem(this.#key);
    } catch {
      return null;
    }
  }

  write(id: string): void {
    try {
      sessionStorage.setItem(this.#key, id);
    } catch {
      // Without session storage, a reload opens the document changed last.
    }
  }

  /** Returns what `writeStart` has kept; null if there is nothing. */
  readStart(): UnmeshedStart | null {
    try {
      const kept: unknown = JSON.parse(sessionStorage.getItem(this.#startKey) ?? "null");
      if (typeof kept !== "object" || kept === null) return null;
      const { documentId, startPage } = kept as Partial<UnmeshedStart>;
      return typeof documentId === "string" ? { documentId, startPage: startPage === true } : null;
    } catch {
      return null;
    }
  }

  /** Null: the document has been meshed or left. */
  writeStart(start: UnmeshedStart | null): void {
    try {
      if (start === null) sessionStorage.removeItem(this.#startKey);
      else sessionStorage.setItem(this.#startKey, JSON.stringify(start));
    } catch {
      // Without session storage, a reload meshes the document.
    }
  }
}
