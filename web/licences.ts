import { existsSync, readFileSync, readdirSync } from "node:fs";
import { dirname, join } from "node:path";
import type { Plugin } from "vite";

// Writes licences.txt beside a bundle: name, version and licence text of every package with code in it. A package
// without a licence text stops the build.
export function licences(): Plugin {
  return {
    name: "licences",
    generateBundle(_, bundle) {
      const folders = new Set<string>();
      for (const chunk of Object.values(bundle)) {
        if (chunk.type !== "chunk") continue;
        for (const id of Object.keys(chunk.modules)) {
          if (id.includes("node_modules")) folders.add(packageFolder(id.replace(/^\0/, "")));
        }
      }
      const parts = [...folders].map(notice).sort();
      if (parts.length) {
        const source = "Packages in this bundle and their licences.\n\n" + parts.join("\n");
        this.emitFile({ type: "asset", fileName: "licences.txt", source });
      }
    },
  };
}

function packageFolder(file: string): string {
  let folder = dirname(file);
  while (!existsSync(join(folder, "package.json")) || !packageJson(folder).version) folder = dirname(folder);
  return folder;
}

function packageJson(folder: string): { name: string; version: string; license: string } {
  return JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
}

function notice(folder: string): string {
  const { name, version, license } = packageJson(folder);
  const file = readdirSync(folder).find((name) => /^licen[cs]e/i.test(name));
  if (!file) throw new Error(`${name} has no licence text`);
  return `${name} ${version} (${license})\n\n${readFileSync(join(folder, file), "utf8").trim()}\n`;
}
