/** The text, the file on disk, and the draft. */

import { computed, effect, signal } from "@preact/signals";
import { keepForBrowser, keepForTab, readDraft, type Draft } from "../api/browser_drafts";
import { ask, Gone, prepareReconnection, Refusal, server } from "../api/requests";
import type { Disk, FileAnswer } from "../api/types";
import { say } from "./announcements";

export const path = signal("");
export const fileName = signal("");
/** The text in the editor. */
export const text = signal("");
/** The text on disk on which the editor's text is based, and its digest. */
export const base = signal<{ text: string; sha256: string | null }>({ text: "", sha256: null });
/** The file on disk, if it is not the one on which the text is based. */
export const conflict = signal<Disk | null>(null);
/** The text of this page is a draft that was found at the start. */
export const draftFound = signal(false);
/** The digest of the file of cases on disk. */
export const casesDigest = signal<string | null>(null);
export const failure = signal<{ message: string; hint: string | null } | null>(null);
export const unsaved = computed(() => text.value !== base.value.text);

/** Replaces the text in the editor, or moves the focus there; set by the editor. Undo brings the old text back. */
export const editorHooks = { replace: (_text: string): void => undefined, focus: (): void => undefined };

const DRAFT_DELAY = 400;
const DISK_INTERVAL = 2000;

export async function open(): Promise<void> {
  await prepareReconnection();
  const file = await ask<FileAnswer>("file");
  path.value = file.path;
  fileName.value = file.name;
  base.value = { text: file.text, sha256: file.sha256 };
  const draft = readDraft(file.path) ?? file.draft;
  text.value = draft && draft.text !== file.text ? draft.text : file.text;
  draftFound.value = text.value !== file.text;
  if (draftFound.value && draft && draft.based_on !== file.sha256) {
    base.value = { text: file.text, sha256: draft.based_on };
    conflict.value = file;
  }
  if (file.problem) failure.value = { message: file.problem, hint: null };
  keepDrafts();
  setInterval(() => void compareWithDisk(), DISK_INTERVAL);
}

function keepDrafts(): void {
  let timer = 0;
  let kept = text.value;
  const keepOnLeaving = (): void => keepForTab(path.value, unsaved.value ? draft() : null);
  const keep = async (now: Draft): Promise<void> => {
    keepOnLeaving();
    try {
      await ask("draft", now);
      kept = now.text;
      keepForBrowser(path.value, null);
    } catch {
      keepForBrowser(path.value, now);
    }
  };
  effect(() => {
    const now = draft();
    // A page that saves the file removes the draft of all pages.
    const isKnown = server.value === "here" && conflict.value === null;
    clearTimeout(timer);
    if (isKnown && now.text === kept) return;
    timer = window.setTimeout(() => void keep(now), DRAFT_DELAY);
  });
  addEventListener("pagehide", keepOnLeaving);
}

function draft(): Draft {
  return { text: text.value, based_on: base.value.sha256 };
}

async function compareWithDisk(): Promise<void> {
  try {
    const disk = await ask<{ sha256: string | null; cases: string | null }>("disk");
    casesDigest.value = disk.cases;
    if (disk.sha256 === base.value.sha256) return void (conflict.value = null);
    if (disk.sha256 === conflict.value?.sha256) return;
    const file = await ask<FileAnswer>("file");
    if (file.sha256 === base.value.sha256) return;
    if (file.text === text.value) base.value = { text: file.text, sha256: file.sha256 };
    else if (!unsaved.value && file.sha256 !== null && !file.problem) {
      takeTheirs(file);
      say("fileReloaded");
    } else {
      conflict.value = file;
      say("conflictFound");
    }
  } catch (error) {
    if (!(error instanceof Gone)) throw error;
  }
}

/** Saves the text. The file on disk must be the one with the digest `basedOn`. */
export async function save(basedOn: string | null = base.value.sha256): Promise<void> {
  const saved = text.value;
  failure.value = null;
  try {
    const { sha256 } = await ask<{ sha256: string }>("save", { text: saved, based_on: basedOn });
    base.value = { text: saved, sha256 };
    conflict.value = null;
    draftFound.value = false;
    keepForBrowser(path.value, null);
    say("savedNow");
  } catch (error) {
    if (error instanceof Refusal && error.status === 409) {
      conflict.value = error.content as unknown as Disk;
      say("conflictFound");
    } else if (error instanceof Refusal) failure.value = { message: error.message, hint: error.hint };
    else if (error instanceof Gone) say("gone", { path: path.value });
    else throw error;
  }
}

export function takeTheirs(disk: Disk): void {
  base.value = { text: disk.text ?? "", sha256: disk.sha256 };
  conflict.value = null;
  draftFound.value = false;
  editorHooks.replace(disk.text ?? "");
}

export function discardDraft(): void {
  draftFound.value = false;
  editorHooks.replace(base.value.text);
}
