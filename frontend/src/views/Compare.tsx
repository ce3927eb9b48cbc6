/** Two versions side by side, and what changed in what the rules require. */

import { useEffect, useRef } from "preact/hooks";
import { sideBySide } from "../editor/side_by_side";
import { language, t, type Message } from "../messages";
import { waiting } from "../state/analysis";
import { against, compareMeaning, earlier, keepVersion, kept, sentences } from "../state/comparison";
import { conflict, text } from "../state/document";
import { Sentence } from "./Sentence";

/** The title of what the text is compared with. */
const SIDES: Record<string, Message> = { saved: "compareSavedTitle", disk: "compareDiskTitle" };

export function Compare() {
  const same = earlier.value === text.value;
  const answer = sentences.value;
  const current = answer && answer.old === earlier.value && answer.new === text.value && answer.language === language.value ? answer : null;
  return (
    <div class="compare">
      <p class="intro">{t("compareIntro")}</p>
      <div class="toolbar">
        <label>
          {t("compareWith")}
          <select value={against.value} onChange={(event) => (against.value = event.currentTarget.value)}>
            <option value="saved">{t("compareSaved")}</option>
            {conflict.value && <option value="disk">{t("compareDisk")}</option>}
            {kept.value.map((version) => (
              <option key={version.id} value={version.id}>
                {t("compareOther", { time: version.time })}
              </option>
            ))}
          </select>
        </label>
        <button type="button" onClick={keepVersion}>
          {t("keepVersion")}
        </button>
        <button type="button" class="main" disabled={same || waiting.value} onClick={() => void compareMeaning()}>
          {t("compareButton")}
        </button>
      </div>
      <div role="status">
        {same && <p class="empty">{t("compareSame")}</p>}
        {current && (
          <ul class="differences">
            {current.lines.map((line, number) => (
              <li key={number}><Sentence text={line} /></li>
            ))}
          </ul>
        )}
      </div>
      {!same && <Sides />}
    </div>
  );
}

function Sides() {
  const host = useRef<HTMLDivElement>(null);
  const [before, after] = [earlier.value, text.value];
  const [left, right] = [t(SIDES[against.value] ?? "compareOld"), t("compareNew")];
  useEffect(() => (host.current ? sideBySide(host.current, before, after, [left, right]) : undefined), [before, after, left, right]);
  return (
    <>
      <p class="side-titles">
        <span>{left}</span>
        <span>{right}</span>
      </p>
      <div class="sides">
        <div ref={host} />
      </div>
    </>
  );
}
