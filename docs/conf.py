"""How Sphinx builds the documentation: ``python -m sphinx -W docs DIR``.

Nothing is fetched: formulas become MathML in the page and are set in the maths font of _static, text in the
reader's own fonts.
"""

import sys
from pathlib import Path

import wearsim

sys.path.insert(0, str(Path(__file__).parent / "_ext"))

project = "wearsim"
author = "The wearsim developers"
release = wearsim.__version__
extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_design",
    "command_text",
    "mathml",
    "equations",
    "gallery",
    "key_tables",
    "root_pages",
    "shared_readings",
    "thumbnails",
]
exclude_patterns = ["_build", "validation_head.md", "measured_head.md", "laws_head.md", "practice_head.md"]
html_theme = "furo"
html_title = f"wearsim {release}"
html_math_renderer = "mathml"
html_static_path = ["_static"]
html_logo = "_static/logo.svg"
html_favicon = "_static/logo.svg"
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#0b57a4", "color-brand-content": "#0b57a4"},
    "dark_css_variables": {"color-brand-primary": "#7db7ff", "color-brand-content": "#7db7ff"},
}
html_css_files = ["site.css", "math.css", "gallery.css", "notebooks.css", "versions.css"]
html_js_files = ["version_switch.js", "scrolling.js", "search_sections.js"]
templates_path = ["_templates"]
html_sidebars = {
    "**": [
        "sidebar/brand.html",
        "versions.html",
        "sidebar/search.html",
        "sidebar/scroll-start.html",
        "sidebar/navigation.html",
        "sidebar/scroll-end.html",
    ]
}
smartquotes = False  # of --set it would make a dash and "set"
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False
myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_heading_anchors = 3
myst_dmath_double_inline = True
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 120
nb_merge_streams = True
autodoc_typehints = "none"
autodoc_member_order = "bysource"
