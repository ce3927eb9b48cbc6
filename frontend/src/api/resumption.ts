/** The token, and how the page gets the next one when the server was started again.
 *
 * Each start of the server has another token. Both sides derive it from a secret that the page asks for at the start.
 * The page never sends a token before the server has proved that it knows the secret, so that another program at the
 * same port learns nothing. `sleec_verify/serve/key.py` is the other side.
 */

let token = new URLSearchParams(location.search).get("token") ?? "";
let secret: CryptoKey | null = null;

export const currentToken = (): string => token;

/** Keeps the secret for later. Browsers without `crypto.subtle` continue only with the new address. */
export async function learn(text: string): Promise<void> {
  const bytes = new TextEncoder().encode(text);
  secret = (await window.crypto.subtle?.importKey("raw", bytes, { name: "HMAC", hash: "SHA-256" }, false, ["sign"])) ?? null;
}

/** The page has the token of the present server, or got it now: `here`. `gone`: nothing answers. `other`: what answers
 * does not know the secret. */
export async function resume(): Promise<"here" | "gone" | "other"> {
  const challenge = hexadecimal(crypto.getRandomValues(new Uint8Array(32)));
  let answer: { salt?: unknown; response?: unknown };
  try {
    const response = await fetch(`/api/resumption?challenge=${challenge}`);
    answer = (await response.json().catch(() => ({}))) as typeof answer;
  } catch {
    return "gone";
  }
  if (!secret || typeof answer.salt !== "string") return "other";
  if (answer.response !== (await derived(secret, `response ${location.port} ${answer.salt} ${challenge}`))) return "other";
  token = await derived(secret, `token ${location.port} ${answer.salt}`);
  history.replaceState(null, "", `/?token=${token}`);
  return "here";
}

async function derived(key: CryptoKey, message: string): Promise<string> {
  return hexadecimal(new Uint8Array(await window.crypto.subtle.sign("HMAC", key, new TextEncoder().encode(message))));
}

function hexadecimal(bytes: Uint8Array): string {
  return [...bytes].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}
