import { defineConfig } from "vite";

import { licences } from "./licences.ts";

// One script for the page, which is inlined, and one module for notebooks; fixed names, so that two builds are equal.
export default defineConfig({
  plugins: [licences()],
  build: {
    lib: {
      entry: "src/main.ts",
      formats: ["es", "iife"],
      name: "dalembert",
      fileName: (format) => (format === "es" ? "widget.js" : "page.js"),
    },
    target: "es2022",
    outDir: "../src/dalembert/pages/bundle",
    emptyOutDir: true,
    minify: true,
    rollupOptions: { output: { exports: "named" } },
  },
});
