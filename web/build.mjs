// Bundles src/ into the Python package; users need no node. `npm run build`.
import { createHash } from "node:crypto";
import { copyFileSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const out = join(here, "../src/poise/live/dashboard");

rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
await build({
  entryPoints: [join(here, "src/main.ts"), join(here, "src/style.css")],
  bundle: true,
  minify: true,
  format: "esm",
  target: ["chrome110", "firefox115", "safari16"],
  legalComments: "none", // the licences are in LICENSES.txt
  outdir: out,
  entryNames: "[name]",
});
for (const name of ["index.html", "icon.svg"]) copyFileSync(join(here, "src", name), join(out, name));

const licences = ["three", "uplot"].map((name) => {
  const { version, homepage } = JSON.parse(readFileSync(join(here, "node_modules", name, "package.json"), "utf8"));
  return `${name} ${version}${homepage ? ` (${homepage})` : ""}\n\n${readFileSync(join(here, "node_modules", name, "LICENSE"), "utf8").trim()}\n`;
});
writeFileSync(join(out, "LICENSES.txt"), `main.js and style.css contain:\n\n${licences.join("\n" + "-".repeat(80) + "\n\n")}`);

// A test compares this with the sources: a bundle that is older than they are fails there.
const hash = createHash("sha256");
const sources = [...readdirSync(join(here, "src")).map((name) => `src/${name}`), "build.mjs", "package.json", "tsconfig.json"];
for (const name of sources.sort()) hash.update(name + "\0").update(readFileSync(join(here, name))).update("\0");
writeFileSync(join(out, "sources.sha256"), hash.digest("hex") + "\n");
