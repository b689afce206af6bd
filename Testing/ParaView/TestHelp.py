# SPDX-License-Identifier: BSD-3-Clause
"""The plugin's help has a page and a picture per filter, with every property; the menu has an icon per filter.

    TestHelp.py LabelMesh.qch PLUGIN
"""
import os
import re
import sqlite3
import sys
import xml.etree.ElementTree
import zlib

help_file, plugin = sys.argv[1:]

failures = []


def check(condition, message):
    if not condition:
        failures.append(message)


def spaced(name):
    return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name)


def files_of(path):
    """Name to contents: Qt's help is a data base of compressed files, each after its length in four bytes."""
    connection = sqlite3.connect(path)
    query = ("SELECT FileNameTable.Name, FileDataTable.Data FROM FileNameTable "
             "JOIN FileDataTable ON FileDataTable.Id = FileNameTable.FileId")
    return {os.path.basename(name): zlib.decompress(data[4:]) if data else b""
            for name, data in connection.execute(query)}


pages = files_of(help_file)
proxies = {}
for path in os.listdir(plugin):
    if path.endswith(".xml"):
        for group in xml.etree.ElementTree.parse(os.path.join(plugin, path)).getroot().iter("ProxyGroup"):
            if group.get("name") == "filters":
                proxies.update((proxy.get("name"), proxy) for proxy in group)
menu = xml.etree.ElementTree.parse(os.path.join(plugin, "LabelMeshMenu.xml")).getroot()
entries = {entry.get("name"): entry for entry in menu.iter("Proxy")}
resources = xml.etree.ElementTree.parse(os.path.join(plugin, "Icons", "labelmesh.qrc")).getroot()
icons = {":" + group.get("prefix") + "/" + file.text: file.text for group in resources for file in group}
check(set(entries) == set(proxies), f"filters without a place in the menu: {set(proxies) - set(entries)}")

for name, proxy in proxies.items():
    page = pages.get(f"filters.{name}.html", b"").decode()
    check(f'<img src="{name}.png"' in page, f"{name} has no page with a picture")
    check(pages.get(name + ".png", b"").startswith(b"\x89PNG"), f"{name} has no picture")
    check(len(pages.get(name + ".png", b"")) < 60000, f"the picture of {name} is large")
    check("<h3>Arrays</h3>" in page and "<h3>Limits</h3>" in page, f"{name}: neither arrays nor limits")
    for prop in proxy:
        if prop.tag.endswith("Property"):
            check(f"<b>{spaced(prop.get('name'))}</b>" in page, f"{name}: nothing about {prop.get('name')}")
    icon = entries[name].get("icon") if name in entries else None
    check(icon in icons and os.path.exists(os.path.join(plugin, "Icons", icons.get(icon, "?"))), f"{name} has no icon")
# Whatever a page links to is there.
for name, contents in pages.items():
    if name.endswith(".html"):
        for link in re.findall(r'(?:src|href)="([^":#]+)"', contents.decode()):
            check(link in pages, f"{name} links to {link}, which is not there")

print("\n".join(failures) or f"{len(proxies)} pages are right")
sys.exit(1 if failures else 0)
