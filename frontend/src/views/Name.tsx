/** A name as words, with the identifier as a tooltip. */

import { spoken } from "../words";

export function Name({ name }: { name: string }) {
  return <span title={name}>{spoken(name)}</span>;
}

export function NameList({ names }: { names: readonly string[] }) {
  return (
    <ul class="names">
      {names.map((name) => (
        <li key={name}>
          <Name name={name} />
        </li>
      ))}
    </ul>
  );
}
