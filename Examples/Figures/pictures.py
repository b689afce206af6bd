# SPDX-License-Identifier: BSD-3-Clause
"""Pictures for the screen, a tenth of the size of those for print: pictures.py PRINT.png SCREEN.png [WIDTH]"""
import io
import sys
from pathlib import Path

from PIL import Image, ImageColor

WIDTH = 1050               # dots
FRAME_COLOUR = "#c03028"   # around what a close-up shows


def for_screen(path, width=WIDTH):
    """A PNG of at most that width, in 256 colours. Frames keep theirs, which are too rare to be chosen."""
    picture = Image.open(path).convert("RGB")
    if picture.width > width:
        picture = picture.resize((width, round(picture.height * width / picture.width)), Image.LANCZOS)
    frequent = picture.quantize(255).getpalette()[:3 * 255]
    frequent = [255 if value >= 248 else value for value in frequent]  # paper is white
    colours = Image.new("P", (1, 1))
    colours.putpalette(frequent + list(ImageColor.getrgb(FRAME_COLOUR)))
    output = io.BytesIO()
    picture.quantize(palette=colours, dither=Image.Dither.NONE).save(output, "PNG", optimize=True)
    return output.getvalue()


if __name__ == "__main__":
    Path(sys.argv[2]).write_bytes(for_screen(sys.argv[1], *map(int, sys.argv[3:])))
