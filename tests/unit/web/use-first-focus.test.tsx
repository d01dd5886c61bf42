// @vitest-environment happy-dom
import { act, useRef, type ReactNode } from "react";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { useFirstFocus } from "../../../web/panels/operations/use-first-focus";
import { rootPerTest } from "../../support/react-root";

/** The first field of a panel gets the focus; of a choice, the chosen option. */

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());
const render = rootPerTest();

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
  render(<Panel>{children}</Panel>);
  act(() => void vi.runAllTimers());
  expect(document.activeElement?.id).toBe(id);
});
