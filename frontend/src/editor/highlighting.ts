/** Colours and weights for both languages of rules: structured English, and the DSL. */

import { HighlightStyle, StreamLanguage, syntaxHighlighting } from "@codemirror/language";
import { tags } from "@lezer/highlight";

const ENGLISH = new Set(
  (
    "MEASURE CONSTANT TRIGGER CONDITION OBLIGATION EVENT WHEN IF RULE DOMAIN READING CONCERN PURPOSE ALWAYS EXCLUSIVE " +
    "NEVER ASSUME RELATION WITHIN EVENTUALLY OTHERWISE ELSE EXISTS WHILE MEANWHILE UNTIL THEN UNLESS IN WHICH CASE AND OR NOT"
  ).split(" "),
);
const DSL = new Set(
  (
    "def_start def_end rule_start rule_end concern_start concern_end purpose_start purpose_end relation_start relation_end " +
    "event measure constant exists while meanwhile until for when then unless within otherwise else not and or eventually true false"
  ).split(" "),
);
const DECLARING = new Set(["RULE", "DOMAIN", "READING"]);

interface State {
  dsl: boolean;
  block: boolean;
  label: boolean;
}

const rules = StreamLanguage.define<State>({
  name: "sleec",
  startState: () => ({ dsl: false, block: false, label: false }),
  token(stream, state) {
    if (state.block || stream.match("/*")) {
      state.block = !stream.match(/^.*?\*\//);
      if (state.block) stream.skipToEnd();
      return "comment";
    }
    if (stream.match("//") || (!state.dsl && stream.match("#"))) {
      stream.skipToEnd();
      return "comment";
    }
    if (stream.match(/^\d+(\.\d+)?/)) return "number";
    const found = stream.match(/^[\p{L}_][\p{L}\p{M}\p{N}_'.’-]*/u);
    if (found && found !== true) {
      const word = found[0];
      if (state.label) {
        state.label = false;
        return "heading";
      }
      if (word === "def_start" || word === "rule_start") state.dsl = true;
      if (!(state.dsl ? DSL : ENGLISH).has(word)) return "name";
      state.label = DECLARING.has(word);
      return "keyword";
    }
    if (stream.match(/^(<=|>=|!=|[<>=])/)) return "operator";
    stream.next();
    return null;
  },
  languageData: { commentTokens: { line: "//" } },
});

const style = HighlightStyle.define([
  { tag: tags.keyword, color: "#0b4f56", fontWeight: "700" },
  { tag: tags.heading, color: "#6d2c0d", fontWeight: "600", textDecoration: "none" },
  { tag: tags.comment, color: "#59636b", fontStyle: "italic" },
  { tag: tags.number, color: "#5b2a86" },
  { tag: tags.operator, color: "#5b2a86" },
]);

export const highlighting = [rules, syntaxHighlighting(style)];
