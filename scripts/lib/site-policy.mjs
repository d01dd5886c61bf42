// The Content-Security-Policy of every page of the built site, in the page itself, so that it holds on any host.
import { createHash } from "node:crypto";

/**
 * Scripts, workers and data come from the site alone. WebAssembly may be compiled, text may not be run as a script. Pictures
 * are also made by the page (data: and blob:). Styles and scripts within a page are permitted by their hashes.
 */
const policyOf = ({ scripts, styles }) => ({
  "default-src": ["'none'"],
  "script-src": ["'self'", "'wasm-unsafe-eval'", ...scripts],
  "worker-src": ["'self'"],
  "style-src": ["'self'", ...styles],
  "img-src": ["'self'", "data:", "blob:"],
  "font-src": ["'self'"],
  "connect-src": ["'self'"],
  "manifest-src": ["'self'"],
  "object-src": ["'none'"],
  "base-uri": ["'none'"],
  "form-action": ["'none'"],
});

const hashOf = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

const hashesOf = (html, element) => [...html.matchAll(element)].map(([, text]) => hashOf(text));

/**
 * Returns the page with its policy, which precedes everything that it governs.
 * @param {string} html
 * @returns {string}
 */
export function withPolicy(html) {
  const policy = policyOf({
    scripts: hashesOf(html, /<script>([^]*?)<\/script>/g),
    styles: hashesOf(html, /<style>([^]*?)<\/style>/g),
  });
  const content = Object.entries(policy)
    .map(([directive, sources]) => `${directive} ${sources.join(" ")}`)
    .join("; ");
  const charset = /<meta charset="utf-8" \/>/;
  if (!charset.test(html)) throw new Error("The page has no charset, after which its policy belongs");
  return html.replace(
    charset,
    (found) => `${found}\n    <meta http-equiv="Content-Security-Policy" content="${content}" />`,
  );
}

/** Adds the policy to the pages of the built site. The development server needs scripts of its own. */
export function contentSecurityPolicy() {
  return {
    name: "tetrafront:content-security-policy",
    apply: "build",
    enforce: "post",
    // After all that changes the styles and scripts of the page.
    transformIndexHtml: { order: "post", handler: withPolicy },
  };
}
