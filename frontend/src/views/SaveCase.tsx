/** Saves the situation as an expected case. */

import { useEffect, useState } from "preact/hooks";
import { t } from "../messages";
import { casesFile, keepCases, refusal, savedCase, saveCase } from "../state/cases";
import { situation } from "../state/situation";
import { Sentence } from "./Sentence";

export function SaveCase() {
  const [name, setName] = useState("");
  useEffect(keepCases, []);
  const nothing = situation.value.triggers.length === 0;
  return (
    <form
      class="save-case"
      onSubmit={(event) => {
        event.preventDefault();
        void saveCase(name.trim()).then((done) => done && setName(""));
      }}
    >
      <h3>{t("caseSaveTitle")}</h3>
      <p class="hint">{nothing ? t("caseSaveFirst") : t("caseSaveIntro", { path: casesFile.value.path })}</p>
      <div role="status">
        {savedCase.value !== null && <p class="done">✓ {t("caseSaved", { name: savedCase.value, path: casesFile.value.path })}</p>}
      </div>
      {refusal.value !== null && (
        <p role="alert" class="refusal">
          <Sentence text={refusal.value} />
        </p>
      )}
      <div class="toolbar">
        <label>
          {t("caseName")}
          <input type="text" value={name} required onInput={(event) => setName(event.currentTarget.value)} />
        </label>
        <button type="submit" disabled={nothing || !name.trim()}>
          {t("caseSave")}
        </button>
      </div>
    </form>
  );
}
