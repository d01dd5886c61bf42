/**
 * Remembers which document an app has open. The memory survives a reload of the tab, but ends with the tab.
 */
export interface TabMemory {
  read(): string | null;
  write(id: string): void;
}

export class BrowserTabMemory implements TabMemory {
  readonly #key: string;

  /** Two apps on one page need different names. */
  constructor(name: string) {
    this.#key = `tetrafront-open-document-${name}`;
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
}
