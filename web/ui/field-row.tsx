import type { ReactNode } from "react";

/** A label on the left and its fields on the right, as every row of the inspector. */
export function FieldRow({ label, children }: { readonly label: string; readonly children: ReactNode }) {
  return (
    <div className="tf-field">
      <span className="tf-field-label">{label}</span>
      <div className="tf-field-body">{children}</div>
    </div>
  );
}

export function SectionTitle({ children }: { readonly children: ReactNode }) {
  return <h2 className="tf-section">{children}</h2>;
}
