import { copyFileSync } from "node:fs";
import { defineConfig } from "vite";

import { licences } from "./licences.ts";

// One script for the studio, served beside its page; fixed names, so that two builds are equal.
export default defineConfig({
  build: {
    lib: { entry: "studio/main.ts", formats: ["iife"], name: "studio", fileName: () => "studio.js" },
    target: "es2022",
    outDir: "../src/dalembert/studio/bundle",
    emptyOutDir: true,
    minify: true,
  },
  plugins: [
    licences(),
    {
      name: "page",
      closeBundle: () => copyFileSync("studio/index.html", "../src/dalembert/studio/bundle/index.html"),
    },
  ],
});
