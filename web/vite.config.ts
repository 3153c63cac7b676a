import { defineConfig, type Plugin } from "vite";

/** Only this machine serves the page and its data; images may also be the map tiles that the operator has set. */
const kContentSecurityPolicy = [
  "default-src 'self'",
  "img-src 'self' data: http: https:",
  "object-src 'none'",
  "base-uri 'none'",
  "form-action 'none'",
].join("; ");

/** In the built page alone: Vite's development server injects inline styles. */
function contentSecurityPolicy(): Plugin {
  return {
    name: "content-security-policy",
    apply: "build",
    transformIndexHtml: () => [
      {
        tag: "meta",
        attrs: { "http-equiv": "Content-Security-Policy", content: kContentSecurityPolicy },
        injectTo: "head-prepend",
      },
    ],
  };
}

const kBridge = process.env["SKEIN_BRIDGE"] ?? "http://127.0.0.1:8080";

export default defineConfig({
  plugins: [contentSecurityPolicy()],
  build: { target: "es2022", sourcemap: false, modulePreload: { polyfill: false } },
  // `npm run dev` serves the page and takes its data from a running web-bridge.
  server: { proxy: { "/api": kBridge, "/live": { target: kBridge, ws: true } } },
});
