"""How the site is built: `./run docs`. Pages are Markdown; tables and figures come from the code, see _extensions."""

from __future__ import annotations

import sys
from datetime import date
from importlib.metadata import version as installed
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "_extensions"))

project = "viscofric"
author = "viscofric developers"
copyright = f"{date.today().year}, {author}"  # noqa: A001 - Sphinx's name
release = version = installed("viscofric")

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx.ext.mathjax",
    "sphinx-mathjax-offline",  # MathJax from the site itself
    "sphinx_copybutton",
    "sphinx_design",
    "sphinx_gallery.gen_gallery",
    "docstrings",
    "generated_pages",
    "offline",
    "search_words",
]
exclude_patterns = ["_build", "_generated", "_extensions", "_templates", "README.md"]
templates_path = ["_templates"]
root_doc = "index"
language = "en"
smartquotes = False  # E'' and --options stay what they are
nitpicky = True
#: Words in the types of docstrings, such as "array", that are no class; what is written as a link must lead somewhere.
nitpick_ignore_regex = [("py:class", r"(?!viscofric).*")]
show_warning_types = True

# Markdown
myst_enable_extensions = ["amsmath", "attrs_inline", "colon_fence", "deflist", "dollarmath", "fieldlist"]
myst_heading_anchors = 4
numfig = True  # equations are numbered through, over all pages

# docstrings
add_module_names = False
autodoc_default_options = {
    "members": True,
    "inherited-members": "BaseModel,Exception,str,tuple",
    "member-order": "bysource",
}
autodoc_typehints = "none"  # docstrings have the types, with shapes and units
autosummary_generate = True
napoleon_google_docstring = False
napoleon_custom_sections = [("Attributes", "params_style")]
toc_object_entries_show_parents = "hide"
napoleon_use_rtype = False
default_role = "py:obj"

# Only what is typed is copied
copybutton_prompt_text = r"\$ |>>> |\.\.\. "
copybutton_prompt_is_regexp = True
copybutton_only_copy_prompt_lines = True

html_theme = "pydata_sphinx_theme"
html_title = f"viscofric {release}"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_show_sourcelink = False
html_copy_source = False
html_theme_options = {
    "logo": {"text": "viscofric", "image_light": "_static/mark.svg", "image_dark": "_static/mark.svg"},
    "navbar_align": "left",
    "header_links_before_dropdown": 7,
    "navigation_with_keys": False,
    "show_prev_next": True,
    "footer_start": ["copyright"],
    "footer_end": [],
    "secondary_sidebar_items": ["page-toc"],
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
}
html_favicon = "_static/mark.svg"
html_sidebars = {
    page: [] for page in ("index", "changes", "faq", "glossary", "installation", "limits", "stability", "verification")
}

# the examples at the root of the checkout, with what they draw
exclude_patterns += ["auto_examples/**/*.py", "auto_examples/**/*.ipynb", "auto_examples/**/*.md5"]
sphinx_gallery_conf = {
    "examples_dirs": ["../examples"],
    "gallery_dirs": ["auto_examples"],
    "filename_pattern": "/plot_",
    "within_subsection_order": "FileNameSortKey",
    "abort_on_example_error": True,
    "capture_repr": (),  # what a script prints is its output; what an expression at its end stands for is not
    "image_scrapers": ("gallery_figures",),
    "download_all_examples": False,
    "min_reported_time": 10_000,  # how long an example took on the machine that built the site says little
    "remove_config_comments": True,
    "show_memory": False,
    "show_signature": False,
    "write_computation_times": False,
}
