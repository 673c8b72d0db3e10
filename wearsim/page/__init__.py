"""A local page to try designs: a case is edited in the browser, its answer follows."""
