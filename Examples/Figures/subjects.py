# SPDX-License-Identifier: BSD-3-Clause
"""How each volume is shown: names and colours of its materials, cameras, close-ups, and the figures it stands for.

A volume is known by the beginning of its file's name; any other volume gets the general style.
"""
from dataclasses import dataclass, field

PALETTE = ["#e0a94a", "#6ba3d6", "#98c773", "#d97a73", "#a88fc7", "#8cbfba", "#e69ec2", "#b8a885"]


@dataclass
class Subject:
    title: str                # also the dataset's name in the paper's tables
    names: dict               # label: name, the paper's where it has the material
    colours: dict = field(default_factory=dict)
    view: tuple = (0.85, -0.46, 0.26)  # from the volume to the camera
    up: tuple = (0, 0, 1)
    shown: tuple = ()         # labels that are shown opaque; (): all
    veiled: tuple = ()        # labels that are shown as a veil around them
    closeups: tuple = (((0.0, 0.0), 0.25),)  # (to the right, up), width: as parts of the picture's height
    aspect: float = 1.0       # width over height of the pictures of the whole
    apart: tuple = ()         # the labels that are shown by themselves (figure 5)
    cut: bool = False         # cut open in figure 8
    section: tuple = (1, 0, 0)  # along an axis: what is on this side of the middle is cut away (figure 9)
    section_aspect: float = 1.0
    section_closeup: tuple = ((0.0, 0.05), 0.25)
    wall_view: tuple = (0.5, -1.0, 0.4)  # of figure 4
    figures: tuple = ()       # numbers of the paper's figures that have a counterpart

    def colour(self, label):
        return self.colours.get(label) or PALETTE[(label - 1) % len(PALETTE)]

    def name(self, label):
        return self.names.get(label, f"label {label}")


SPHERES = Subject("two spheres", {1: "top", 2: "bottom"}, cut=True, aspect=0.8,
                  section_aspect=0.8, section_closeup=((0.1, -0.14), 0.3), figures=(2, 3, 7, 8, 9),
                  closeups=(((0.0, -0.08), 0.35),))
FROG = Subject("frog", {1: "tissue", 2: "bone", 3: "guts", 4: "brain"},
               {1: "#8fbf6a", 2: "#efe3c2", 3: "#d97a73", 4: "#6ba3d6"},
               view=(0.0, -0.45, 0.9), up=(0, 1, 0), shown=(2, 3, 4), veiled=(1,),
               closeups=(((0.125, -0.155), 0.18), ((-0.3, -0.03), 0.18)), figures=(6, 8, 9), aspect=1.3, section=(0, 0, 1),
               section_aspect=1.3)
BRAIN = Subject("brain", {1: "CSF", 2: "grey matter", 3: "white matter"},
                {1: "#6ba3d6", 2: "#c9a59b", 3: "#efe3c2"}, view=(0.8, 0.5, 0.4),
                closeups=(((0.0, 0.1), 0.2),), figures=(5, 8), apart=(3, 1), shown=(3,), aspect=1.1)
TORSO = Subject("torso", {1: "tissue", 2: "bone", 3: "solid organs", 4: "hollow organs", 5: "lung"},
                {1: "#e3bfa0", 2: "#efe3c2", 3: "#b5615a", 4: "#d9a05b", 5: "#6ba3d6"},
                view=(0.25, -1.0, 0.2), shown=(2, 3, 4, 5), veiled=(1,),
                closeups=(((0.0, 0.1), 0.2), ((-0.15, -0.2), 0.2)), figures=(1, 4, 8, 9))
KNOWN = {"two_spheres": SPHERES, "frog-5material": FROG, "brain-3tissue": BRAIN, "torso-6material": TORSO}


def subject_of(stem):
    for beginning, subject in KNOWN.items():
        if stem.startswith(beginning):
            return subject
    return Subject(stem, {}, figures=(1, 4, 5, 8, 9))
