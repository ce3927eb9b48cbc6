/** Characters that nobody sees, or that change the order in which a line is seen, are shown as a mark. */

import { highlightSpecialChars } from "@codemirror/view";

/** With the embeddings and isolates of the bidirectional algorithm that CodeMirror leaves out. */
export const unusualCharacters = highlightSpecialChars({ addSpecialChars: /[\u202a-\u202c\u2068]/ });
