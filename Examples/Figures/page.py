# SPDX-License-Identifier: BSD-3-Clause
"""One page per volume, with its pictures inside the file."""
import base64
import html

from pictures import for_screen

STYLE = """body { font: 15px/1.45 sans-serif; max-width: 1080px; margin: 2em auto; padding: 0 1em; color: #222 }
figure { margin: 2.2em 0 } figure img { max-width: 100%; display: block; margin: auto }
figcaption, caption { font-size: 14px; color: #444; text-align: left; margin-top: .5em }
table { border-collapse: collapse; margin: 2em 0; font-size: 13px; display: block; overflow-x: auto }
caption { display: table-caption; margin-bottom: .5em; min-width: 40em }
td, th { border-bottom: 1px solid #ddd; padding: 3px 9px; text-align: right } td:first-child, th:first-child { text-align: left }
th { border-bottom: 1px solid #888; vertical-align: bottom }"""


def page(title, lead, figures, tables):
    """`figures`: (heading, path of a PNG, caption); `tables`: of tables.py."""
    parts = [f"<!DOCTYPE html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>{html.escape(title)}</title>"
             f"<style>{STYLE}</style></head><body><h1>{html.escape(title)}</h1><p>{html.escape(lead)}</p>"]
    for heading, path, caption in figures:
        data = base64.b64encode(for_screen(path)).decode()
        parts.append(f"<figure><img alt=\"{html.escape(heading)}\" src=\"data:image/png;base64,{data}\">"
                     f"<figcaption><b>{html.escape(heading)}.</b> {html.escape(caption)}</figcaption></figure>")
    parts += [table.html() for table in tables]
    return "\n".join(parts) + "\n</body></html>\n"
