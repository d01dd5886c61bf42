import { useCallback, useEffect, useState } from "react";
import type { RecentDocument } from "../../session/document-library";
import { failureText } from "../../session/failure-text";
import { strings } from "../../strings";
import { useApp } from "../shared/app-context";

/** Returns the documents in the browser's storage, why they cannot be read, and how to remove one; null while the list is being read. */
export function useRecentDocuments() {
  const { library, autosave } = useApp();
  const [documents, setDocuments] = useState<readonly RecentDocument[] | null>(null);
  const [failure, setFailure] = useState<string | null>(null);
  const update = useCallback(async (): Promise<void> => {
    await autosave?.flush();
    setDocuments((await library?.list()) ?? []);
  }, [library, autosave]);
  useEffect(() => {
    update().catch((error: unknown) => setFailure(strings.recent.noList(failureText(error))));
  }, [update]);
  const remove = (id: string): void => {
    library?.storage
      .remove([id])
      .then(update)
      .catch(() => undefined);
  };
  return { documents, failure, remove };
}

/** Returns the address of the picture of a document; null if there is none. */
export function useDocumentPicture(id: string): string | null {
  const { pictures } = useApp();
  const [address, setAddress] = useState<string | null>(null);
  useEffect(() => {
    let made: string | null = null;
    let isOver = false;
    void pictures.read(id).then((picture) => {
      if (isOver || !picture) return;
      made = URL.createObjectURL(picture);
      setAddress(made);
    });
    return () => {
      isOver = true;
      if (made !== null) URL.revokeObjectURL(made);
    };
  }, [pictures, id]);
  return address;
}
