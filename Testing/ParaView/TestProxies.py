# SPDX-License-Identifier: BSD-3-Clause
"""Every filter is there as a proxy: in the menu, documented, with its class's own defaults and ports."""
import os
import re
import sys
import xml.etree.ElementTree

import labelmesh
from paraview import servermanager
from paraview.simple import LoadPlugin

LoadPlugin(os.environ["LABELMESH_PLUGIN"], remote=False, ns=globals())

FILTERS = ["LabelSplit", "Tighten", "IndicatorReconstruct", "SizingField", "ParticleSampleCells", "DelaunayLabelMesh",
           "GridLabelMesh", "LabelMeshReport", "ExplodeLabels", "LabelMesher", "LabelSurvey"]

failures = []


def check(condition, message):
    if not condition:
        failures.append(message)


def spaced(name):
    return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name)


def properties(proxy):
    iterator = proxy.NewPropertyIterator()
    iterator.Begin()
    while not iterator.IsAtEnd():
        yield iterator.GetKey(), iterator.GetProperty()
        iterator.Next()


def values(prop):
    return [prop.GetElement(i) for i in range(prop.GetNumberOfElements())]


# The application reads the menu, pvpython does not: look at the file. (The test of the application uses the menu.)
here = os.path.dirname(os.path.abspath(__file__))
root = xml.etree.ElementTree.parse(os.path.join(here, "..", "..", "Plugin", "LabelMeshMenu.xml")).getroot()
menu = [entry.get("name") for entry in root.find("Category[@name='LabelMesh']")]

manager = servermanager.ProxyManager().SMProxyManager
for name in FILTERS:
    proxy = manager.NewProxy("filters", name)
    if proxy is None:
        failures.append(f"there is no proxy filters/{name}")
        continue
    algorithm = getattr(labelmesh, "vtk" + name)()

    check(proxy.GetVTKClassName() == "vtk" + name, f"{name} is of class {proxy.GetVTKClassName()}")
    check(proxy.GetXMLLabel() == spaced(name), f"{name} has the label '{proxy.GetXMLLabel()}'")
    check(len(proxy.GetDocumentation().GetDescription().strip()) > 100, f"{name} has no documentation worth the name")
    check(proxy.GetDocumentation().GetShortHelp(), f"{name} has no short help")

    check(name in menu, f"{name} is not in the menu LabelMesh")

    ports = proxy.GetNumberOfOutputPorts()
    check(ports == algorithm.GetNumberOfOutputPorts(), f"{name}: {ports} ports, {algorithm.GetNumberOfOutputPorts()} in C++")
    port_names = {proxy.GetOutputPortName(port) for port in range(ports)}
    check(len(port_names) == ports and all(port_names), f"{name}: its ports are not named apart")

    inputs = 0
    for key, prop in properties(proxy):
        where = f"{name}.{key}"
        documentation = prop.GetDocumentation()
        check(documentation and len((documentation.GetDescription() or "").strip()) > 20, f"{where} is not documented")
        check(prop.GetXMLLabel() == spaced(key), f"{where} has the label '{prop.GetXMLLabel()}'")
        if prop.IsA("vtkSMInputProperty"):
            inputs += 1
            check(prop.FindDomain("vtkSMDataTypeDomain") is not None, f"{where} takes data of any type")
        elif prop.GetInformationOnly() or prop.GetCommand() == "SetInputArrayToProcess":
            pass
        elif prop.GetRepeatCommand():
            check(prop.GetNumberOfElements() == 0, f"{where} is not empty by default")
            check(hasattr(algorithm, prop.GetCommand()), f"{where}: no method {prop.GetCommand()}")
            check(hasattr(algorithm, prop.GetCleanCommand()), f"{where}: no method {prop.GetCleanCommand()}")
        else:
            check(prop.GetCommand() == "Set" + key, f"{where} calls {prop.GetCommand()}")
            check(hasattr(algorithm, "Set" + key), f"{where}: no method Set{key}")
            if hasattr(algorithm, "Get" + key):
                own = getattr(algorithm, "Get" + key)()
                check(values(prop) == [own], f"{where} is {values(prop)} by default, {own} in C++")
            else:
                failures.append(f"{where}: no method Get{key}")
    check(inputs == algorithm.GetNumberOfInputPorts(), f"{name}: {inputs} inputs, {algorithm.GetNumberOfInputPorts()} in C++")

    # And the other way round: what can be set in C++ can be set in ParaView.
    mine = {method for method in vars(type(algorithm)) if re.match(r"(Set|Add)(?!Input)[A-Z]", method)}
    commands = {prop.GetCommand() for _, prop in properties(proxy)}
    for method in sorted(mine - commands):
        # SetSmoothingToTightening is SetSmoothing with a name for the number.
        if re.sub(r"To[A-Z]\w*$", "", method) in commands:
            continue
        failures.append(f"{name}: nothing in ParaView calls {method}")

print("\n".join(failures) or f"{len(FILTERS)} proxies are right")
sys.exit(1 if failures else 0)
