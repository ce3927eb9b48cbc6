/** Requests to the server. Each says whether the server answers, so that the page can show that it is gone. */

import { signal } from "@preact/signals";
import { language } from "../messages";
import { currentToken, learn, resume } from "./resumption";

/** `here`: it answers. `gone`: nothing answers. `other`: what answers does not know this page. */
export const server = signal<"here" | "gone" | "other">("here");

/** What the server refuses, with the sentence that it gives. `content` is the whole answer. */
export class Refusal extends Error {
  constructor(
    message: string,
    readonly hint: string | null,
    readonly status: number,
    readonly content: Record<string, unknown>,
  ) {
    super(message);
  }
}

/** The server does not answer. */
export class Gone extends Error {}

/** The answer to a request. If the server was started again in the meantime, the request is sent again.
 *
 * Raises `Refusal`, `Gone`, or an `AbortError`.
 */
export async function ask<T>(name: string, body?: object, abort?: AbortSignal): Promise<T> {
  let response = await send(name, body, abort);
  if (response.status === 403) {
    await reconnect();
    response = await send(name, body, abort);
  }
  if (response.status === 403) {
    server.value = "other";
    throw new Gone();
  }
  const content = (await response.json().catch(() => ({}))) as Record<string, unknown>;
  if (!response.ok)
    throw new Refusal(
      typeof content["message"] === "string" ? content["message"] : response.statusText,
      typeof content["hint"] === "string" ? content["hint"] : null,
      response.status,
      content,
    );
  return content as T;
}

async function send(name: string, body?: object, abort?: AbortSignal): Promise<Response> {
  if (server.value !== "here") await reconnect();
  try {
    return await fetch(`/api/${name}`, {
      method: body ? "POST" : "GET",
      headers: { "X-Sleec-Token": currentToken(), "Content-Type": "application/json" },
      ...(body && { body: JSON.stringify({ ...body, language: language.value }) }),
      ...(abort && { signal: abort }),
    });
  } catch (error) {
    if (error instanceof DOMException && error.name === "AbortError") throw error;
    server.value = "gone";
    throw new Gone();
  }
}

/** Looks for the server again, after it was gone. Raises `Gone` if it is not back. */
async function reconnect(): Promise<void> {
  server.value = await resume();
  if (server.value !== "here") throw new Gone();
}

/** Gets what the page needs to reconnect. */
export async function prepareReconnection(): Promise<void> {
  await learn((await ask<{ secret: string }>("secret")).secret);
}
