/** Opens the file, and shows the page. */

import { effect } from "@preact/signals";
import { render } from "preact";
import "./page.css";
import { language } from "./messages";
import { server } from "./api/requests";
import { keepChecking } from "./state/analysis";
import { say } from "./state/announcements";
import { fileName, open, save, unsaved } from "./state/document";
import { keepRepairs } from "./state/repairs";
import { keepAnswering } from "./state/situation";
import { keepTiming } from "./state/timeline";
import { Page } from "./views/Page";

async function start(): Promise<void> {
  await open();
  keepChecking();
  keepAnswering();
  keepTiming();
  keepRepairs();
  effect(() => {
    document.title = `${unsaved.value ? "● " : ""}${fileName.value} – sleec-verify`;
  });
  let reachable = true;
  effect(() => {
    if (server.value === "here" && !reachable) say("back");
    reachable = server.value === "here";
  });
  effect(() => {
    document.documentElement.lang = language.value;
  });
  addEventListener("keydown", (event) => {
    if (event.defaultPrevented || event.key.toLowerCase() !== "s" || !(event.ctrlKey || event.metaKey) || event.altKey) return;
    event.preventDefault();
    void save();
  });
  const page = document.getElementById("page");
  if (page) render(<Page />, page);
}

void start();
