// @vitest-environment happy-dom
import { act } from "react";
import { expect, it } from "vitest";
import type { App } from "../../../web/app/app";
import { ViewStore } from "../../../web/document/selection";
import { AppContext } from "../../../web/panels/shared/app-context";
import { useEntityHover } from "../../../web/panels/shared/use-entity-hover";
import { rootPerTest } from "../../support/react-root";

const render = rootPerTest();

function Row({ id }: { readonly id: number }) {
  return <p id={`row-${id}`} {...useEntityHover({ kind: "line", id })} />;
}

it("the highlight of an entity ends with the pointer, and with an element that is removed under it", () => {
  const view = new ViewStore();
  const show = (ids: readonly number[]) =>
    render(
      <AppContext value={{ view } as App}>
        {ids.map((id) => (
          <Row key={id} id={id} />
        ))}
      </AppContext>,
    );
  const move = (type: "mouseover" | "mouseout", id: number) =>
    act(() => {
      const init = { bubbles: true, relatedTarget: document.body };
      document.getElementById(`row-${id}`)?.dispatchEvent(new MouseEvent(type, init));
    });
  const hovered = () => view.state.getState().hover?.id;
  show([1, 2]);
  move("mouseover", 1);
  expect(hovered()).toBe(1);
  move("mouseout", 1);
  expect(hovered()).toBeUndefined();
  move("mouseover", 1);
  // Another one leaves.
  show([1]);
  expect(hovered()).toBe(1);
  show([]);
  expect(hovered()).toBeUndefined();
});
