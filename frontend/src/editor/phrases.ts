/** The texts of CodeMirror in the language of the page. */

import { EditorState, type Extension } from "@codemirror/state";
import { t } from "../messages";

export function phrases(): Extension {
  return EditorState.phrases.of({
    Find: t("find"),
    Replace: t("replaceWith"),
    next: t("findNext"),
    previous: t("findPrevious"),
    all: t("findAll"),
    "match case": t("findCase"),
    regexp: t("findPattern"),
    "by word": t("findWord"),
    replace: t("replaceOne"),
    "replace all": t("replaceAll"),
    close: t("close"),
    "$ unchanged lines": t("unchangedLines"),
  });
}
