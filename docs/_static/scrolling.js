// What is wider than its place scrolls by the arrow keys too, once it can have the focus.
"use strict";

const wide = "pre, .table-wrapper, .formula, .cell_output, p:has(> img), .drawing";
const watch = new ResizeObserver((entries) => {
  for (const { target } of entries) {
    if (target.scrollWidth > target.clientWidth) target.tabIndex = 0;
    else target.removeAttribute("tabindex");
  }
});
addEventListener("DOMContentLoaded", () => document.querySelectorAll(wide).forEach((part) => watch.observe(part)));
