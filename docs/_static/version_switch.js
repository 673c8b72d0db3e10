// The list of versions lies beside the folder of this one, as docs/site_versions.py writes it.
// Pages that stand alone have no list, and the switch stays hidden.
"use strict";

const root = new URL(document.documentElement.dataset.content_root, location.href);

function showVersions() {
  const field = document.querySelector(".versions");
  const choice = field.querySelector("select");
  for (const version of window.siteVersions) {
    const isThis = version === DOCUMENTATION_OPTIONS.VERSION;
    choice.add(new Option(version, version, isThis, isThis));
  }
  choice.addEventListener("change", () => openVersion(choice.value));
  field.hidden = false;
}

// The same page of another version, or its front page where it has no such page.
async function openVersion(version) {
  const other = new URL(`../${version}/`, root).href;
  const page = other + location.href.slice(root.href.length);
  const exists = await fetch(page, { method: "HEAD" }).then((answer) => answer.ok, () => false);
  location.href = exists ? page : `${other}index.html`;
}

const list = document.createElement("script");
list.src = new URL("../versions.js", root).href;
list.addEventListener("load", showVersions);
document.head.append(list);
