// Results of the search lead to the sections that hold the words, and say to which part of the site a page belongs.
"use strict";

const mostSections = 3;

// Own text of a section: that of the sections in it is theirs.
function ownText(section) {
  const copy = section.cloneNode(true);
  copy.querySelectorAll("section, .headerlink").forEach((inner) => inner.remove());
  return copy.textContent.toLowerCase();
}

// Sections with the most of the words, in the order of the page; none where only the whole page has them.
function sectionsWith(article, words) {
  const sections = [...article.querySelectorAll("section section[id]")];
  const held = sections.map((section) => {
    const text = ownText(section);
    return words.filter((word) => text.includes(word)).length;
  });
  const most = Math.max(0, ...held);
  return most ? sections.filter((_, number) => held[number] === most).slice(0, mostSections) : [];
}

function heading(section) {
  const title = section.querySelector("h2, h3, h4, h5").cloneNode(true);
  title.querySelectorAll(".headerlink").forEach((link) => link.remove());
  return title.textContent.trim();
}

function linksTo(sections, page) {
  const list = document.createElement("ul");
  list.className = "found-sections";
  for (const section of sections) {
    const link = document.createElement("a");
    link.href = `${page}#${section.id}`;
    link.textContent = heading(section);
    list.append(Object.assign(document.createElement("li"), { className: "found-section" }));
    list.lastChild.append(link);
  }
  return list;
}

// Captions of the list of all pages, and the one above this page.
const captions = (root) => [...root.querySelectorAll(".sidebar-tree .caption-text")].map((one) => one.textContent);
const partOf = (site) => site.querySelector(".sidebar-tree > ul.current")?.previousElementSibling?.textContent ?? "";

function complete(result, html, words) {
  const site = new DOMParser().parseFromString(html, "text/html");
  const title = result.querySelector("a");
  const part = partOf(site);
  result.dataset.part = part;
  if (part) title.after(Object.assign(document.createElement("span"), { className: "found-part", textContent: part }));
  if (!title.hash) result.append(linksTo(sectionsWith(site.querySelector("[role=main]"), words), title.href));
}

// A choice above the results: those of one part alone.
function addChoice() {
  const choice = document.createElement("select");
  choice.setAttribute("aria-label", "Show results of");
  choice.append(new Option("all parts", ""), ...captions(document).map((name) => new Option(name, name)));
  const results = document.getElementById("search-results");
  choice.addEventListener("change", () => (results.dataset.only = choice.value));
  const style = document.createElement("style");
  style.textContent = captions(document)
    .map((name) => `#search-results[data-only="${name}"] .search > li:not([data-part="${name}"])`)
    .join(", ") + " { display: none; }";
  document.head.append(style);
  results.before(choice);
}

addEventListener("DOMContentLoaded", () => {
  if (typeof Search === "undefined" || !document.getElementById("search-results")) return;
  addChoice();
  const summary = Search.makeSearchSummary;
  Search.makeSearchSummary = (html, terms, anchor) => {
    const found = summary(html, terms, anchor) ?? document.createElement("p");
    // Once it stands in its result, whose link tells the page.
    queueMicrotask(() => complete(found.closest("li"), html, [...terms].map((term) => term.toLowerCase())));
    return found;
  };
});
