# SPDX-License-Identifier: BSD-3-Clause
"""The panels: what every property is documented, grouped and measured in; and that what has no effect is hidden.

Reads the XML that the application makes its panels of, and asks the proxies made from it whether each one is there.
"""
import glob
import os
import re
import sys
import xml.etree.ElementTree

from paraview import servermanager
from paraview.simple import LoadPlugin

LoadPlugin(os.environ["LABELMESH_PLUGIN"], remote=False, ns=globals())

# How a unit is written for the user: in the title of the group, in the documentation or at a component.
UNITS = {"voxels": "voxel", "samples": "sample", "samples per voxel": "samples per voxel", "1 / voxel": "per voxel",
         "length": "length unit of the image", "degrees": "degrees", "GiB": "gibibytes", "ratio": "", "count": "",
         "number": "", "label": "label", "seconds": "seconds"}
AREAS = ("Labels", "Material", "Smoothing", "Sizing", "Particles", "Output")
MODES = ("visibility", "enabled_state")

failures = []


def check(condition, message):
    if not condition:
        failures.append(message)


def text_of(element):
    found = element.find("Documentation")
    return " ".join((found.text or "").split()) if found is not None else ""


def is_number(prop):
    return (re.match(r"(Int|Double|IdType)VectorProperty", prop.tag) is not None
            and prop.find("EnumerationDomain") is None and prop.find("BooleanDomain") is None)


def check_decorators(where, prop, names):
    for decorator in prop.findall("Hints/PropertyWidgetDecorator"):
        other = decorator.get("property")
        check(decorator.get("type") == "GenericDecorator", f"{where}: decorator {decorator.get('type')}")
        check(decorator.get("mode") in MODES, f"{where}: decorator of mode {decorator.get('mode')}")
        check(other in names and other != prop.get("name"), f"{where}: decorator that asks {other}")


def check_unit(where, prop, group):
    unit = prop.find("Hints/Unit")
    check(unit is not None and unit.get("name") in UNITS, f"{where} has no unit that is known")
    if unit is None or unit.get("name") not in UNITS:
        return
    said = " ".join([text_of(prop), group or ""] + [c.get("label") for c in prop.iter("ComponentLabel")]).lower()
    check(UNITS[unit.get("name")] in said, f"{where} does not tell its unit, {unit.get('name')}")


def check_proxy(proxy, is_filter):
    name = proxy.get("name")
    check(len(text_of(proxy)) > 20, f"{name} is not documented")
    properties = [child for child in proxy if child.tag.endswith("Property")]
    names = [prop.get("name") for prop in properties]
    groups = {}
    titles = [group.get("label") for group in proxy.findall("PropertyGroup")]
    check(len(set(titles)) == len(titles), f"{name} has two groups of one title: {titles}")
    for group in proxy.findall("PropertyGroup"):
        check(group.get("label").startswith(AREAS), f"{name}: group '{group.get('label')}'")
        for member in group:
            check(member.get("name") in names, f"{name}: the group {group.get('label')} has no {member.get('name')}")
            check(member.get("name") not in groups, f"{name}.{member.get('name')} is in two groups")
            groups[member.get("name")] = group.get("label")
    for prop in properties:
        where = f"{name}.{prop.get('name')}"
        text = text_of(prop)
        check(len(text) > 20 and text.endswith("."), f"{where} has no sentence of documentation")
        check(prop.get("label") or " " not in re.sub(r"(?<=[a-z])(?=[A-Z])", " ", prop.get("name")),
              f"{where} has no label")
        check_decorators(where, prop, names)
        if prop.tag == "InputProperty" or prop.get("panel_visibility") == "never" or prop.get("information_only"):
            continue
        if is_filter:
            check(prop.get("name") in groups, f"{where} is in no group")
        # The application makes no widget for these.
        check(prop.tag != "IdTypeVectorProperty", f"{where} would not be in the panel")
        if is_number(prop):
            check_unit(where, prop, groups.get(prop.get("name")))
    return len(properties)


manager = servermanager.ProxyManager().SMProxyManager
plugin = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Plugin")
count = 0
for path in sorted(glob.glob(os.path.join(plugin, "*.xml"))):
    for group in xml.etree.ElementTree.parse(path).getroot().iter("ProxyGroup"):
        for proxy in group:
            count += check_proxy(proxy, group.get("name") == "filters")
            check(manager.GetPrototypeProxy(group.get("name"), proxy.get("name")) is not None,
                  f"there is no proxy {group.get('name')}/{proxy.get('name')}")
check(count > 100, f"only {count} properties were found")

print("\n".join(failures) or f"{count} properties are right")
sys.exit(1 if failures else 0)
