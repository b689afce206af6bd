# SPDX-License-Identifier: BSD-3-Clause
"""The materials table in the application: edited, applied, saved as a state and read again; and against a server.

TestMaterialsTable.py PARAVIEW PVSERVER: three sessions. What the user does and what the table must then show is a
playback, written here; materials_session.py, inside the application, looks at the mesh. The application's exit code
says whether the playback found all that it looked for.
"""
import os
import socket
import subprocess
import sys
from xml.sax.saxutils import quoteattr

paraview, pvserver = sys.argv[1:3]
here = os.path.dirname(os.path.abspath(__file__))
output = os.environ["LABELMESH_OUTPUT"]

WINDOW = "pqClientMainWindow"
PANEL = WINDOW + "/propertiesDock/propertiesPanel"
GROUP = PANEL + "/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/PropertiesFrame/ProxyPanel/materials_table"
TABS = GROUP + "/Tabs"
MATERIALS = TABS + "/qt_tabwidget_stackedwidget/Materials"
INTERFACES = TABS + "/qt_tabwidget_stackedwidget/Interfaces"
SUMMARY = GROUP + "/Summary"

F2, RETURN, SPACE, DELETE, DOWN = 16777265, 16777220, 32, 16777223, 16777237
SHIFT = 33554432
# Columns of the two tables.
LABEL, COLOR, NAME, RADIUS, LENGTH, VOXELS = range(6)
FIRST, SECOND, FACES, INTERFACE_LENGTH = range(4)


def event(name, command, arguments=""):
    return f"  <pqevent object={quoteattr(name)} command={quoteattr(command)} arguments={quoteattr(str(arguments))}/>"


def check(name, what, arguments):
    return f"  <pqcheck object={quoteattr(name)} property={quoteattr(what)} arguments={quoteattr(str(arguments))}/>"


def shows(table, row, column, text):
    return [check(table, "modelItemData", f"{row}.{column},{text}")]


def select(table, row, column, further=0):
    down = event(table, "keyEvent", f"6,{DOWN},{SHIFT},,0,1")
    return [event(table, "setCurrent", f"{row}.{column}")] + [down] * further


def press(table, key):
    return [event(table, "key", key)]


def type_into(table, text):
    """F2, the text, Return: into the current cell, and so into all selected rows."""
    editor = table + "/qt_scrollarea_viewport/Editor"
    return press(table, F2) + [event(editor, "set_string", text)] + press(editor, RETURN) + pause(200)


def pause(milliseconds):
    return [event(WINDOW, "pause", milliseconds)]


def tab(name):
    return [event(TABS + "/qt_tabwidget_tabbar", "set_tab_with_text", name)]


def apply_and_wait(milliseconds):
    return [event(PANEL + "/Accept", "activate")] + pause(milliseconds)


MENU = [event(WINDOW + "/menubar/menuFilters/LabelMesh", "activate", "Label Mesher")] + pause(1500)

FRESH = (shows(MATERIALS, 0, NAME, "background") + shows(MATERIALS, 1, LABEL, "1") + shows(MATERIALS, 1, NAME, "Label_1") +
         shows(MATERIALS, 2, RADIUS, "0.7") + shows(MATERIALS, 2, LENGTH, "auto") +
         shows(INTERFACES, 2, FIRST, "1 Label_1") + shows(INTERFACES, 2, INTERFACE_LENGTH, "auto") +
         [check(MATERIALS, "modelRowCount", 3), check(INTERFACES, "modelRowCount", 3),
          check(SUMMARY, "text", "2 of 2 materials are meshed, 3 interfaces")])

EDIT = (MENU + FRESH +
        select(MATERIALS, 1, NAME) + type_into(MATERIALS, "upper") +
        select(MATERIALS, 1, COLOR) + type_into(MATERIALS, "#ff0000") +
        select(MATERIALS, 1, RADIUS, further=1) + type_into(MATERIALS, "0.9") +
        shows(MATERIALS, 1, RADIUS, "0.9") + shows(MATERIALS, 2, RADIUS, "0.9") +
        select(MATERIALS, 2, LENGTH) + type_into(MATERIALS, "3") + shows(MATERIALS, 2, LENGTH, "3") +
        press(MATERIALS, DELETE) + shows(MATERIALS, 2, LENGTH, "auto") +
        tab("Interfaces") + shows(INTERFACES, 2, FIRST, "1 upper") +
        select(INTERFACES, 2, INTERFACE_LENGTH) + type_into(INTERFACES, "0.5") + tab("Materials") +
        apply_and_wait(3000) +
        # Switched off, label 2 is background, and the interface between the two is one of label 1 and the background.
        select(MATERIALS, 2, LABEL) + press(MATERIALS, SPACE) +
        [check(SUMMARY, "text", "1 of 2 materials are meshed, 2 interfaces")] + apply_and_wait(3000))

RELOADED = (pause(1500) + shows(MATERIALS, 1, NAME, "upper") + shows(MATERIALS, 1, RADIUS, "0.9") +
            shows(MATERIALS, 2, RADIUS, "0.9") + shows(MATERIALS, 2, LENGTH, "auto") +
            shows(INTERFACES, 1, INTERFACE_LENGTH, "0.5") +
            [check(SUMMARY, "text", "1 of 2 materials are meshed, 2 interfaces")])


def session(name, events, **variables):
    """Runs the application; ends this program where the playback or the session did not find what they look for."""
    script = os.path.join(output, name + ".xml")
    with open(script, "w") as file:
        file.write("\n".join(['<?xml version="1.0" ?>', "<pqevents>", *events, "</pqevents>", ""]))
    verdict = os.path.join(output, name + ".txt")
    if os.path.exists(verdict):
        os.remove(verdict)
    # Settings of the user's own must not reach the test; nor the test's them.
    environment = dict(os.environ, HOME=output, XDG_CONFIG_HOME=os.path.join(output, "config"), LABELMESH_SESSION=name,
                       LABELMESH_VERDICT=verdict, LABELMESH_STATE=os.path.join(output, "table.pvsm"), **variables)
    command = [paraview, "--dr", "--script=" + os.path.join(here, "materials_session.py"), "--test-directory=" + output,
               "--test-script=" + script, "--exit"]
    try:
        code = subprocess.run(command, env=environment, timeout=120).returncode
    except subprocess.TimeoutExpired:
        code = "no exit code after 120 s"
    said = open(verdict).read() if os.path.exists(verdict) else "the session saw no mesh"
    print(f"{name}: {code}; {said}")
    if code != 0 or not said.startswith("passed"):
        sys.exit(1)


session("edit", EDIT)
session("reload", RELOADED)

with socket.socket() as probe:  # a port that is free now
    probe.bind(("127.0.0.1", 0))
    port = probe.getsockname()[1]
server = subprocess.Popen([pvserver, f"--server-port={port}"])
try:
    rename = select(MATERIALS, 1, NAME) + type_into(MATERIALS, "upper")
    session("remote", MENU + FRESH + rename + apply_and_wait(4000), LABELMESH_PORT=str(port))
finally:
    server.terminate()
    server.wait()
