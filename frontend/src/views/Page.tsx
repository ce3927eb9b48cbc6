/** The whole page: the text with its findings on one side, the views on the other. */

import { useEffect, useRef } from "preact/hooks";
import { mount } from "../editor/editor";
import { announcement } from "../state/announcements";
import { t } from "../messages";
import { Banners } from "./Banners";
import { Findings } from "./Findings";
import { Header } from "./Header";
import { Tabs } from "./Tabs";

export function Page() {
  return (
    <>
      <Header />
      <Banners />
      <main>
        <div class="writing">
          <section class="text" aria-labelledby="text-title">
            <h2 id="text-title" class="unseen">
              {t("rules")}
            </h2>
            <Editor />
          </section>
          <Findings />
        </div>
        <Tabs />
      </main>
      <p class={announcement.value.isShown ? "announcement" : "unseen"} aria-live="assertive">
        {announcement.value.text}
      </p>
    </>
  );
}

function Editor() {
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => (host.current ? mount(host.current) : undefined), []);
  return <div class="editor" ref={host} />;
}
