import { IconFile3d } from "@tabler/icons-react";
import { useDocumentPicture } from "./use-recent";
import styles from "./document-picture.module.css";

/** The picture of a stored document, or a symbol. */
export function DocumentPicture({ id }: { readonly id: string }) {
  const address = useDocumentPicture(id);
  return (
    <span className={styles["picture"]}>
      {address ? <img src={address} alt="" /> : <IconFile3d size={20} stroke={1.4} aria-hidden />}
    </span>
  );
}
