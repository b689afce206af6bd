# SPDX-License-Identifier: BSD-3-Clause
"""Pictures for the screen, a tenth of the size of those for print: pictures.py PRINT.png SCREEN.png [WIDTH]"""
import io
import sys
from pathlib import Path

from PIL import Image

WIDTH = 1050  # dots


def for_screen(path, width=WIDTH):
    """A PNG of at most that width, in 256 colours."""
    picture = Image.open(path).convert("RGB")
    if picture.width > width:
        picture = picture.resize((width, round(picture.height * width / picture.width)), Image.LANCZOS)
    output = io.BytesIO()
    picture.quantize(256, dither=Image.Dither.NONE).save(output, "PNG", optimize=True)
    return output.getvalue()


if __name__ == "__main__":
    Path(sys.argv[2]).write_bytes(for_screen(sys.argv[1], *map(int, sys.argv[3:])))
