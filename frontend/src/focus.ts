/** Moves the focus after the page has changed, so that it is never lost with an element that goes. */

import { view, type View } from "./state/selection";

/** Focuses the first element that one of the selectors finds, as soon as the page is drawn. */
export function focusNext(...selectors: string[]): void {
  requestAnimationFrame(() =>
    requestAnimationFrame(() => {
      for (const selector of selectors) {
        const found = document.querySelector<HTMLElement>(selector);
        if (found) return found.focus();
      }
    }),
  );
}

/** Shows a view and goes there. On a narrow screen, it is far below what the user pressed. */
export function goToView(next: View): void {
  view.value = next;
  focusNext("#panel");
}
