import { fileURLToPath } from "node:url";
import { defineConfig } from "vitest/config";

const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));

/** The browser tests lie in tests/browser; what they import is installed here. */
export default defineConfig({
  root: here("../tests/browser"),
  resolve: {
    alias: {
      "axe-core": here("node_modules/axe-core/axe.js"),
      "playwright-core": here("node_modules/playwright-core/index.mjs"),
      "vt-pbf": here("node_modules/vt-pbf/index.js"),
    },
  },
  server: { fs: { allow: [here("..")] } },
  test: {
    include: ["*.test.ts"],
    environment: "node",
    testTimeout: 120_000,
    hookTimeout: 60_000,
    // They mostly wait for UAVs to fly, so two at a time suit two cores.
    maxWorkers: 2,
    // The tests of a file are the steps of one flight: after a failure the next ones can only fail too.
    bail: 1,
  },
});
