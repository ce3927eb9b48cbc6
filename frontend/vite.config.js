// The same sources give the same bytes: exact versions, fixed file names, no times and no absolute paths.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";

/** Adds `assets/licenses.txt`: the licences of all packages in the bundle, which each of them asks for. */
function licences() {
  return {
    name: "licences",
    generateBundle(_options, bundle) {
      const folders = new Set();
      for (const chunk of Object.values(bundle))
        for (const id of Object.keys(chunk.modules ?? {})) {
          const found = /^.*\/node_modules\/(@[^/]+\/)?[^/]+/.exec(id);
          if (found) folders.add(found[0]);
        }
      const texts = [...folders].map((folder) => {
        const { name, version } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
        const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
        if (!file) throw new Error(`${name} has no licence`);
        return `${name} ${version}\n\n${readFileSync(join(folder, file), "utf8").trim()}\n`;
      });
      this.emitFile({ type: "asset", fileName: "assets/licenses.txt", source: texts.sort().join("\n---\n\n") });
    },
  };
}

export default {
  base: "./",
  plugins: [licences()],
  esbuild: { jsx: "automatic", jsxImportSource: "preact", legalComments: "none" },
  build: {
    outDir: "../sleec_verify/serve/page",
    emptyOutDir: true,
    target: "es2022",
    modulePreload: { polyfill: false },
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 1000,
    rollupOptions: {
      output: { entryFileNames: "assets/page.js", chunkFileNames: "assets/[name].js", assetFileNames: "assets/page[extname]" },
    },
  },
};
