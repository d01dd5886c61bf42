// @vitest-environment happy-dom
import { act, useRef, type ReactNode } from "react";
import { createRoot, type Root } from "react-dom/client";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { useFirstFocus } from "../../../web/panels/operations/use-first-focus";

/** The first field of a panel gets the focus; of a choice, the chosen option. */

let root: Root;

beforeEach(() => {
  vi.useFakeTimers();
  vi.stubGlobal("IS_REACT_ACT_ENVIRONMENT", true);
  const host = document.createElement("div");
  document.body.append(host);
  root = createRoot(host);
});

afterEach(() => {
  act(() => root.unmount());
  document.body.replaceChildren();
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

function Panel({ children }: { readonly children: ReactNode }) {
  const box = useRef<HTMLElement>(null);
  useFirstFocus(box);
  return <section ref={box}>{children}</section>;
}

const toggle = <input type="checkbox" id="switch" defaultChecked />;
const option = (id: string, isChosen = false) => (
  <input type="radio" name="kind" id={id} defaultChecked={isChosen} />
);

it.each<readonly [string, ReactNode, string]>([
  [
    "the first field",
    <>
      <input id="width" />
      {toggle}
    </>,
    "width",
  ],
  [
    "the chosen option of a choice",
    <>
      {option("first")}
      {option("second", true)}
      {toggle}
    </>,
    "second",
  ],
  [
    "the first option if none is chosen, not a switch",
    <>
      {option("first")}
      {option("second")}
      {toggle}
    </>,
    "first",
  ],
])("gives the focus to %s", (_, children, id) => {
  act(() => root.render(<Panel>{children}</Panel>));
  act(() => void vi.runAllTimers());
  expect(document.activeElement?.id).toBe(id);
});
