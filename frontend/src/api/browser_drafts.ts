/** Drafts in the browser: of this tab, for a reload, and of all tabs, while the server cannot keep them. */

export interface Draft {
  text: string;
  based_on: string | null;
}

const key = (path: string): string => `sleec-verify draft ${path}`;

export function readDraft(path: string): Draft | null {
  return read(sessionStorage, path) ?? read(localStorage, path);
}

/** Null removes the draft. */
export function keepForTab(path: string, draft: Draft | null): void {
  write(sessionStorage, path, draft);
}

export function keepForBrowser(path: string, draft: Draft | null): void {
  write(localStorage, path, draft);
}

function read(storage: Storage, path: string): Draft | null {
  try {
    const found = JSON.parse(storage.getItem(key(path)) ?? "null") as Draft | null;
    return found && typeof found.text === "string" ? found : null;
  } catch {
    return null;
  }
}

function write(storage: Storage, path: string, draft: Draft | null): void {
  try {
    if (draft) storage.setItem(key(path), JSON.stringify(draft));
    else storage.removeItem(key(path));
  } catch {
    // The storage is full or switched off. The text is still on the page.
  }
}
