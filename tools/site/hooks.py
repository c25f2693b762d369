"""Hooks of MkDocs for the pages of docs/, which are written for GitHub.

- Headings get the anchors that GitHub makes.
- CHANGELOG.md, which lies beside docs/, is a page of the site.
- Links out of docs/ lead to the changelog or the start page, or become plain text: the site has no sources.
"""

import os
import pathlib
import re

from mkdocs.structure.files import File

ROOT = pathlib.Path(__file__).resolve().parents[2]
CHANGELOG = ROOT / "CHANGELOG.md"
LINK = re.compile(r"(?<!!)\[([^\]]*)\]\(([^\s()]+)\)")


def slug_of(heading, separator):
    return re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", separator)


def on_config(config):
    config["mdx_configs"].setdefault("toc", {})["slugify"] = slug_of
    return config


def on_files(files, config):
    files.append(File(CHANGELOG.name, str(ROOT), config["site_dir"], config["use_directory_urls"]))
    return files


def site_path(file):
    """The path in docs/ of a file of the project; None if the site lacks it."""
    docs = ROOT / "docs"
    if file.is_relative_to(docs):
        return file
    return {CHANGELOG: docs / "CHANGELOG.md", ROOT / "README.md": docs / "index.md"}.get(file)


def on_page_markdown(markdown, page, config, files):
    source = pathlib.Path(page.file.abs_src_path).resolve()
    folder = (site_path(source) or source).parent

    def rewritten(match):
        text, target = match.groups()
        if re.match(r"[a-z]+:|#", target):
            return match[0]
        path, hash_sign, anchor = target.partition("#")
        file = (source.parent / path).resolve()
        place = site_path(file)
        if not place:
            return text
        if file.name == "README.md":
            hash_sign = anchor = ""
        return f"[{text}]({os.path.relpath(place, folder)}{hash_sign}{anchor})"

    return LINK.sub(rewritten, markdown)
