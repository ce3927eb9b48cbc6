/** What needs a decision or attention before anything else: a draft, a conflict, a server that is gone, a failure. */

import type { ComponentChildren } from "preact";
import { server } from "../api/requests";
import { t } from "../messages";
import { goToView } from "../focus";
import { against } from "../state/comparison";
import { conflict, discardDraft, draftFound, editorHooks, failure, fileName, path, save, takeTheirs } from "../state/document";

/** The pressed button goes with its banner, so the focus moves to the text. */
function toText(_done: unknown): void {
  editorHooks.focus();
}

/** A path as shells read it. */
function asArgument(path: string): string {
  return /\s/.test(path) ? `"${path}"` : path;
}

function show(which: "saved" | "disk"): void {
  against.value = which;
  goToView("compare");
}

export function Banners() {
  const disk = conflict.value;
  const isDeleted = disk?.sha256 === null && !disk.problem;
  const hasText = disk !== null && disk.sha256 !== null && !disk.problem;
  return (
    <div class="banners">
      {server.value !== "here" && (
        <Banner kind="alert">
          <p>{server.value === "gone" ? t("gone", { path: asArgument(path.value) }) : t("lost")}</p>
        </Banner>
      )}
      {disk && (
        <Banner kind="alert">
          <p>{t(isDeleted ? "conflictDeleted" : disk.problem ? "conflictProblem" : "conflictText", { name: fileName.value })}</p>
          {disk.problem && <p>{disk.problem}</p>}
          {hasText && (
            <button type="button" onClick={() => show("disk")}>
              {t("draftDifference")}
            </button>
          )}
          {!disk.problem && (
            <button type="button" onClick={() => void save(disk.sha256).then(toText)}>
              {t(isDeleted ? "conflictSave" : "conflictKeep")}
            </button>
          )}
          {hasText && (
            <button type="button" onClick={() => toText(takeTheirs(disk))}>
              {t("conflictTake")}
            </button>
          )}
        </Banner>
      )}
      {draftFound.value && !disk && (
        <Banner kind="status">
          <p>{t("draftFound", { name: fileName.value })}</p>
          <button type="button" onClick={() => show("saved")}>
            {t("draftDifference")}
          </button>
          <button type="button" onClick={() => toText((draftFound.value = false))}>
            {t("draftKeep")}
          </button>
          <button type="button" onClick={() => toText(discardDraft())}>
            {t("draftDiscard")}
          </button>
        </Banner>
      )}
      {failure.value && (
        <Banner kind="alert">
          <p>
            {failure.value.message}
            {failure.value.hint && ` (${failure.value.hint})`}
          </p>
          <button type="button" onClick={() => toText((failure.value = null))}>
            {t("close")}
          </button>
        </Banner>
      )}
    </div>
  );
}

function Banner({ kind, children }: { kind: "alert" | "status"; children: ComponentChildren }) {
  return (
    <div class={`banner ${kind}`} role={kind}>
      {children}
    </div>
  );
}
