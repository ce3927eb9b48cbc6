/** The look of the editor. It is a shadow tree, so that its style sheets need no exception from the security policy. */

import { EditorView } from "@codemirror/view";

export const theme = EditorView.theme({
  "&": { height: "100%", fontSize: "1rem", backgroundColor: "#fff", color: "#1b2327" },
  "&.cm-focused": { outline: "3px solid #0b6b74", outlineOffset: "-3px" },
  ".cm-scroller": { fontFamily: "ui-monospace, 'DejaVu Sans Mono', Menlo, Consolas, monospace", lineHeight: "1.65" },
  ".cm-content": { paddingBlock: "0.75rem", caretColor: "#0b4f56" },
  ".cm-gutters": { backgroundColor: "#f4f6f5", color: "#59636b", borderRight: "1px solid #d5dcda" },
  ".cm-activeLine": { backgroundColor: "#eef5f488" },
  ".cm-activeLineGutter": { backgroundColor: "#e2ecea" },
  ".mark-error, .mark-problem": { textDecoration: "underline wavy #b3261e 1.5px", textUnderlineOffset: "4px" },
  ".mark-warning": { textDecoration: "underline dashed #8a5300 1.5px", textUnderlineOffset: "4px" },
  ".mark-note": { textDecoration: "underline dotted #45606b 1.5px", textUnderlineOffset: "4px" },
  ".mark-deciding": { backgroundColor: "#d9f0e4", boxShadow: "inset 0 -2px 0 #1b7f4f, inset 0 2px 0 #1b7f4f" },
  ".mark-selected": { outline: "2px solid #0b6b74", outlineOffset: "1px", borderRadius: "2px" },
  ".cm-specialChar": { color: "#a3160f", fontWeight: "bold" },
  ".tooltip": { maxWidth: "32rem", padding: "0.25rem 0.75rem", fontFamily: "system-ui, sans-serif", fontSize: "0.9rem" },
  ".tooltip p": { margin: "0.35rem 0" },
  ".cm-tooltip": { backgroundColor: "#fff", border: "1px solid #8b9996", borderRadius: "6px", boxShadow: "0 2px 10px #0003" },
  ".cm-collapsedLines.cm-collapsedLines:before, .cm-collapsedLines.cm-collapsedLines:after": { content: '"↕"' },
  ".cm-panel.cm-search": { padding: "0.4rem 2rem 0.4rem 0.5rem", fontFamily: "system-ui, sans-serif" },
  ".cm-panel.cm-search input, .cm-panel.cm-search button, .cm-panel.cm-search label": { fontSize: "0.95rem" },
  ".cm-panel.cm-search .cm-button, .cm-panel.cm-search .cm-textfield": {
    minHeight: "2rem",
    border: "1px solid #7d8b88",
    borderRadius: "0.3rem",
    backgroundColor: "#fff",
    backgroundImage: "none",
  },
  ".cm-panel.cm-search [name=close]": { minWidth: "1.8rem", minHeight: "1.8rem", fontSize: "1.2rem" },
  // Backgrounds and shadows are not shown there.
  "@media (forced-colors: active)": {
    ".mark-deciding": { outline: "2px dashed CanvasText", outlineOffset: "1px" },
    ".mark-selected": { outline: "3px solid Highlight" },
    ".cm-selectionBackground": { backgroundColor: "Highlight !important", forcedColorAdjust: "none" },
  },
});
