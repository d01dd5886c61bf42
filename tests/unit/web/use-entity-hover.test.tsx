// @vitest-environment happy-dom
import { act } from "react";
import { createRoot, type Root } from "react-dom/client";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import type { App } from "../../../web/app/app";
import { ViewStore } from "../../../web/document/selection";
import { AppContext } from "../../../web/panels/shared/app-context";
import { useEntityHover } from "../../../web/panels/shared/use-entity-hover";

let root: Root;
let view: ViewStore;

beforeEach(() => {
  vi.stubGlobal("IS_REACT_ACT_ENVIRONMENT", true);
  const host = document.createElement("div");
  document.body.append(host);
  root = createRoot(host);
  view = new ViewStore();
});

afterEach(() => {
  act(() => root.unmount());
  document.body.replaceChildren();
  vi.unstubAllGlobals();
});

function Row({ id }: { readonly id: number }) {
  return <p id={`row-${id}`} {...useEntityHover({ kind: "line", id })} />;
}

it("the highlight of an entity ends with the pointer, and with an element that is removed under it", () => {
  const show = (ids: readonly number[]) =>
    act(() =>
      root.render(
        <AppContext value={{ view } as App}>
          {ids.map((id) => (
            <Row key={id} id={id} />
          ))}
        </AppContext>,
      ),
    );
  const enter = (id: number) =>
    act(() => {
      document
        .getElementById(`row-${id}`)
        ?.dispatchEvent(new MouseEvent("mouseover", { bubbles: true, relatedTarget: document.body }));
    });
  const hovered = () => view.state.getState().hover?.id;
  show([1, 2]);
  enter(1);
  expect(hovered()).toBe(1);
  // Another one leaves.
  show([1]);
  expect(hovered()).toBe(1);
  show([]);
  expect(hovered()).toBeUndefined();
});
