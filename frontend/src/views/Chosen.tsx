/** What the situation consists of, wherever its switches are. Each part can be taken away. */

import type { Value } from "../api/types";
import { focusNext } from "../focus";
import { t } from "../messages";
import { setValue, situation, toggle } from "../state/situation";
import { spoken } from "../words";

export function Chosen() {
  const { triggers, conditions } = situation.value;
  const values = Object.entries(conditions);
  if (triggers.length + values.length === 0) return null;
  return (
    <ul class="chosen" aria-label={t("situation")}>
      {triggers.map((name) => (
        <Part key={name} name={name} text={spoken(name)} remove={() => toggle(name, false)} />
      ))}
      {values.map(([name, value]) => (
        <Part key={name} name={name} text={inShort(name, value)} remove={() => setValue(name, null)} />
      ))}
    </ul>
  );
}

function inShort(name: string, value: Value): string {
  if (value === true) return spoken(name);
  return `${spoken(name)}: ${typeof value === "string" ? spoken(value) : value}`;
}

function Part({ name, text, remove }: { name: string; text: string; remove: () => void }) {
  return (
    <li title={name}>
      {text}
      <button type="button" aria-label={t("chosenRemove", { name: text })} onClick={() => {
          remove();
          focusNext(".chosen button", ".switches input");
        }}>
        ×
      </button>
    </li>
  );
}
