#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs a command on an X display of its own: with_display.sh COMMAND [ARGUMENT...]
# The server chooses a free display number itself (-displayfd), so any number of these can run at once, which xvfb-run
# does not survive. -noreset: a server that starts over when a window closes refuses the next one meanwhile. The exit code
# is the command's.
set -u
numbers=$(mktemp -d) || exit 1
mkfifo "$numbers/display"
# -noreset: when its last client leaves, the server would start anew and refuse who comes meanwhile; ParaView opens a first
# window only to ask what the server can do.
Xvfb -displayfd 3 -screen 0 "${LABELMESH_SCREEN:-1280x1024x24}" -nolisten tcp -noreset 3>"$numbers/display" >"$numbers/log" 2>&1 &
server=$!
trap 'kill "$server" 2>/dev/null; wait "$server" 2>/dev/null; rm -rf "$numbers"' EXIT

# A server that does not start closes the pipe, and read comes back empty.
if ! read -r -t 30 display <"$numbers/display"
then
  echo "with_display.sh: Xvfb did not start:" >&2
  cat "$numbers/log" >&2
  exit 1
fi

# Rendering in software: the same picture on every machine.
DISPLAY=":$display" LIBGL_ALWAYS_SOFTWARE=1 "$@"
