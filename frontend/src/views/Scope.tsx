/** For which reading and which domain the page answers. */

import { useRef } from "preact/hooks";
import { t } from "../messages";
import { analysis } from "../state/analysis";
import { domain, reading, scope } from "../state/situation";

/** The reading of chains of exceptions, and the domain. What the user or a finding chose is never hidden. */
export function Scope() {
  const domains = analysis.value.domains ?? [];
  const isOpen = useRef(false);
  isOpen.current ||= reading.value !== null || scope.value.domain !== null;
  return (
    <details class="settings" open={isOpen.current}>
      <summary>{t("settings")}</summary>
      <label>
        {t("reading")}
        <select value={reading.value ?? ""} onChange={(event) => (reading.value = event.currentTarget.value || null)}>
          <option value="">{t("readingOfFile")}</option>
          <option value="cascade">{t("readingCascade")}</option>
          <option value="priority">{t("readingPriority")}</option>
        </select>
      </label>
      {domains.length > 0 && (
        <label>
          {t("domain")}
          <select value={domain.value ?? ""} onChange={(event) => (domain.value = event.currentTarget.value || null)}>
            <option value="">{t("allDomains")}</option>
            {domains.map((name) => (
              <option key={name} value={name}>
                {name}
              </option>
            ))}
          </select>
        </label>
      )}
    </details>
  );
}
