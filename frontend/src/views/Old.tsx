/** Says that what follows is for an earlier text. */

import { server } from "../api/requests";
import { t } from "../messages";
import { goodText, unanswered, waiting } from "../state/analysis";

export function Old() {
  if (goodText.value === null) return null;
  if (server.value !== "here") return <p class="old">{t("answerWaits")}</p>;
  if (waiting.value) return <p class="old">{t("answerOld")}</p>;
  return unanswered.value ? <p class="old">{t("answerLate")}</p> : null;
}
