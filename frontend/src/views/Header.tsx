/** The name of the file, whether it is saved, and what one does with the text as a whole. */

import { redoChange, undoChange } from "../editor/editor";
import { language, LANGUAGES, setLanguage, t } from "../messages";
import { fileName, path, save, unsaved } from "../state/document";

export function Header() {
  return (
    <header>
      <h1 title={path.value}>{fileName.value}</h1>
      <span class={unsaved.value ? "state unsaved" : "state"}>{unsaved.value ? `● ${t("notSaved")}` : `✓ ${t("saved")}`}</span>
      <span class="actions">
        <button type="button" onClick={undoChange}>
          {t("undo")}
        </button>
        <button type="button" onClick={redoChange}>
          {t("redo")}
        </button>
        <button type="button" class="main" title="Ctrl+S" onClick={() => void save()}>
          {t("save")}
        </button>
        <label class="language">
          <span>{t("language")}</span>
          <select value={language.value} onChange={(event) => setLanguage(event.currentTarget.value)}>
            {Object.entries(LANGUAGES).map(([code, name]) => (
              <option key={code} value={code} lang={code}>
                {name}
              </option>
            ))}
          </select>
        </label>
      </span>
    </header>
  );
}
