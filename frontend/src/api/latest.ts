/** Requests of which only the answer to the last one counts. */

import { ask, Gone } from "./requests";

export class Latest {
  private controller: AbortController | null = null;

  /** The answer, or null if a later request of this object came in between, or if the server is gone. */
  async ask<T>(name: string, body: object): Promise<T | null> {
    this.cancel();
    const controller = new AbortController();
    this.controller = controller;
    try {
      const answer = await ask<T>(name, body, controller.signal);
      return controller.signal.aborted ? null : answer;
    } catch (error) {
      if (controller.signal.aborted || error instanceof Gone) return null;
      throw error;
    }
  }

  /** Cancels the present request. */
  cancel(): void {
    this.controller?.abort();
  }
}
