# SPDX-License-Identifier: BSD-3-Clause
"""Help pages from the XML of the proxies, and from what stands beside this file: make_help.py OUTPUT MENU.xml PROXIES.xml...

One page per filter, under the name by which ParaView's Help button looks for it: its text and its properties with units
and defaults from the XML, its picture (filters/NAME.png), its arrays and limits (filters/NAME.html); and a page that lists
them in the order of the menu. Pictures are made by make_pictures.py.
"""
import html
import os
import shutil
import sys
import xml.etree.ElementTree

HERE = os.path.dirname(os.path.abspath(__file__))
UNITS = {"length": "length unit of the image", "ratio": "", "count": "", "number": ""}
PAGE = """<html>
<head><title>{title}</title></head>
<body>
<h1>{title}</h1>
{body}
</body>
</html>
"""


def text_of(element):
    documentation = element.find("Documentation")
    return html.escape(" ".join((documentation.text or "").split()))


def label_of(prop):
    return html.escape(prop.get("label") or prop.get("name"))


def unit_of(prop):
    unit = prop.find("Hints/Unit")
    return "" if unit is None else UNITS.get(unit.get("name"), unit.get("name"))


def default_of(prop):
    if prop.get("repeat_command") or prop.get("information_only") or prop.get("command") == "SetInputArrayToProcess":
        return ""
    value = prop.get("default_values", "")
    for entry in prop.iter("Entry"):
        if entry.get("value") == value:
            return entry.get("text")
    if prop.find("BooleanDomain") is not None:
        return "on" if value == "1" else "off"
    return value


def inputs_of(proxy):
    items = [f"<li><b>{label_of(prop)}</b>: {text_of(prop)}</li>" for prop in proxy.findall("InputProperty")]
    return "<h3>Inputs</h3>\n<ul>\n" + "\n".join(items) + "\n</ul>\n"


def row(cells, kind="td"):
    return "<tr>" + "".join(f"<{kind}>{cell}</{kind}>" for cell in cells) + "</tr>\n"


def properties_of(proxy):
    """A table per group, as in the panel; what the panel does not show comes last."""
    by_name = {prop.get("name"): prop for prop in proxy if prop.tag.endswith("VectorProperty")}
    result = "<h3>Properties</h3>\n"
    groups = [(group.get("label"), [member.get("name") for member in group if member.tag == "Property"])
              for group in proxy.findall("PropertyGroup")]
    grouped = {name for _, names in groups for name in names}
    groups.append(("Others", [name for name in by_name if name not in grouped]))
    for title, names in groups:
        rows = [row([f"<b>{label_of(by_name[name])}</b>" + (
            " (advanced)" if by_name[name].get("panel_visibility") == "advanced" else ""), unit_of(by_name[name]),
            default_of(by_name[name]), text_of(by_name[name])]) for name in names if name in by_name]
        if rows:
            result += (f"<h4>{html.escape(title)}</h4>\n<table border=\"1\" cellpadding=\"4\">\n"
                       + row(["Property", "Unit", "Default", "What it does"], "th") + "".join(rows) + "</table>\n")
    return result


def page_of(proxy):
    name = proxy.get("name")
    with open(os.path.join(HERE, "filters", name + ".html")) as file:
        written = file.read()
    label = html.escape(proxy.get("label"))
    return PAGE.format(title=label, body=f"<p><img src=\"{name}.png\" alt=\"{label}\"/></p>\n<p>{text_of(proxy)}</p>\n"
                       + inputs_of(proxy) + properties_of(proxy) + written)


def main(output, menu, *files):
    os.makedirs(output, exist_ok=True)
    proxies = {proxy.get("name"): proxy for path in files
               for group in xml.etree.ElementTree.parse(path).getroot().iter("ProxyGroup")
               if group.get("name") == "filters" for proxy in group}
    order = [entry.get("name") for entry in xml.etree.ElementTree.parse(menu).getroot().iter("Proxy")]
    items = []
    for name in order:
        with open(os.path.join(output, f"filters.{name}.html"), "w") as file:
            file.write(page_of(proxies[name]))
        short = html.escape(proxies[name].find("Documentation").get("short_help"))
        items.append(f"<li><a href=\"filters.{name}.html\">{html.escape(proxies[name].get('label'))}</a>: {short}</li>")
        shutil.copy(os.path.join(HERE, "filters", name + ".png"), output)
    for name in os.listdir(HERE):
        if name.endswith((".html", ".png")):
            shutil.copy(os.path.join(HERE, name), output)
    body = ("<p>From a volume of labels to a mesh of all its materials. Label Mesher does all of it in one; the stages "
            "after it do it step by step. <a href=\"gallery.html\">Gallery</a></p>\n<ol>\n" + "\n".join(items) + "\n</ol>")
    with open(os.path.join(output, "LabelMesh.html"), "w") as file:
        file.write(PAGE.format(title="LabelMesh", body=body))


if __name__ == "__main__":
    main(*sys.argv[1:])
